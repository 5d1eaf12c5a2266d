"""Rasters of xarray and rasterio: by likenesses always, by themselves where they are installed."""

from __future__ import annotations

import calls
import mediant
import numpy as np
import pytest


class Coordinate:
    def __init__(self, values, **attrs):
        self.values, self.attrs, self.size = np.asarray(values), attrs, len(values)


COSTS = np.array([[1.0, 2.0, 4.0], [-9.0, 3.0, 1.0]])
UTM = {"y": Coordinate([130, 100]), "x": Coordinate([500, 520, 540])}


def test_cells_are_those_of_coordinates():
    """The height and the width of a cell; columns alone, rows alone, and none."""
    for coords, wanted in [
        (UTM, (30, 20)),
        ({"x": UTM["x"]}, (20, 20)),
        ({"y": UTM["y"]}, (30, 30)),
        ({}, (1, 1)),
        ({"y": Coordinate([5, 5 - 1e-9]), "x": Coordinate([1, 2, 3])}, None),
    ]:
        make = lambda coords=coords: mediant.Grid.from_costs(calls.Raster(COSTS, coords), nodata=-9)  # noqa: E731
        if wanted is None:
            with pytest.raises(mediant.ArgumentError, match="cell_size"):
                make()
        else:
            assert make() == mediant.Grid(COSTS < 0, costs=COSTS, cell_size=wanted)
    raster = calls.Raster(COSTS, UTM)
    assert mediant.Grid.from_costs(raster, nodata=-9, cell_size=7).cell_size == (7.0, 7.0)
    with pytest.raises(mediant.ArgumentError, match="not evenly spaced"):
        mediant.Grid.from_costs(calls.Raster(COSTS, {"x": Coordinate([0, 1, 3])}), nodata=-9)


@pytest.mark.parametrize(
    ("dims", "coords", "attrs"),
    [
        (("lat", "lon"), {"lat": Coordinate([50, 49]), "lon": Coordinate([1, 2, 3])}, {}),
        (("y", "x"), {"y": Coordinate([50, 49], units="degrees_north")}, {}),
        (("y", "x"), UTM, {"crs": "EPSG:4326"}),
        (("y", "x"), {**UTM, "spatial_ref": Coordinate([0], crs_wkt='GEOGCS["WGS 84"]')}, {}),
    ],
)
def test_degrees_are_refused(dims, coords, attrs):
    raster = calls.Raster(COSTS, coords, dims, attrs=attrs)
    with pytest.raises(mediant.ArgumentError, match=r"costs: .*degrees.*project it"):
        mediant.Grid.from_costs(raster, nodata=-9)
    assert mediant.Grid.from_costs(raster, nodata=-9, cell_size=(30, 20)).cell_size == (30.0, 20.0)


@pytest.mark.parametrize("attrs", [{"_FillValue": -9}, {"nodatavals": (-9.0,)}, {"missing_value": [-9]}])
def test_no_data_is_what_attributes_say(attrs):
    assert mediant.Grid.from_costs(calls.Raster(COSTS, attrs=attrs)) == mediant.Grid(COSTS < 0, costs=COSTS)
    # Whoever read it may have put no number there.
    holes = np.where(COSTS < 0, np.nan, COSTS)
    assert mediant.Grid.from_costs(calls.Raster(holes, attrs=attrs)).to_numpy().sum() == 1
    with pytest.raises(mediant.MapError, match="nodata"):
        mediant.Grid.from_costs(calls.Raster(holes))


def test_fields_have_the_coordinates_of_a_raster():
    raster = calls.Raster(COSTS, UTM, attrs={"crs": "EPSG:32632", "_FillValue": -9.0})
    field = mediant.Grid.from_costs(raster).field((0, 0))
    again = field.to_xarray(raster)
    assert np.array_equal(again.values, field.distances()) and again.coords is raster.coords
    assert again.name == "cost" and again.attrs == {"crs": "EPSG:32632"}
    assert mediant.Grid(COSTS < 0).field((0, 0)).to_xarray(raster).name == "distance"
    with pytest.raises(mediant.ArgumentError, match="like: "):
        mediant.Grid.from_costs(np.ones((3, 3))).field((0, 0)).to_xarray(raster)
    with pytest.raises(TypeError, match="like: "):
        field.to_xarray(COSTS)


def test_rasters_of_xarray(tmp_path):
    xarray = pytest.importorskip("xarray", reason="xarray is not installed")
    raster = xarray.DataArray(
        COSTS, dims=("y", "x"), coords={"y": [130.0, 100.0], "x": [500.0, 520.0, 540.0]}, name="friction"
    )
    raster.attrs["_FillValue"] = -9.0
    wanted = mediant.Grid(COSTS < 0, costs=COSTS, cell_size=(30, 20))
    assert mediant.Grid.from_costs(raster) == wanted
    assert mediant.Grid.from_costs(raster.expand_dims(band=[1])) == wanted
    assert mediant.Grid.from_costs(raster.T) == mediant.Grid(COSTS.T < 0, costs=COSTS.T, cell_size=(20, 30))
    # As a file gives it back: the value of holes is in the encoding.
    masked = raster.where(raster > 0)
    masked.attrs.clear()
    with pytest.raises(mediant.MapError, match="nodata"):
        mediant.Grid.from_costs(masked)
    masked.encoding["_FillValue"] = -9.0
    assert mediant.Grid.from_costs(masked) == wanted
    field = wanted.field((0, 0))
    costs = field.to_xarray(raster)
    assert isinstance(costs, xarray.DataArray) and costs.name == "cost" and costs.attrs == {}
    assert float(costs.sel(x=520, y=130)) == 30.0 and np.isinf(costs.sel(x=500, y=100))
    assert costs.coords.equals(raster.coords)
    with pytest.raises(mediant.ArgumentError, match="degrees"):
        mediant.Grid.from_costs(raster.rename(y="lat", x="lon"))


def test_rasters_of_rasterio(tmp_path):
    rasterio = pytest.importorskip("rasterio", reason="rasterio is not installed")
    transform = rasterio.transform.from_origin(500, 130, 20, 30)
    how = {"driver": "GTiff", "height": 2, "width": 3, "count": 1, "dtype": "float32", "nodata": -9.0}
    with rasterio.open(tmp_path / "f.tif", "w", crs="EPSG:32632", transform=transform, **how) as file:
        file.write(COSTS.astype("f4"), 1)
    with rasterio.open(tmp_path / "f.tif") as dataset:
        grid = mediant.Grid.from_costs(dataset.read(1, masked=True), transform=dataset.transform)
        assert grid == mediant.Grid.from_costs(dataset.read(masked=True), transform=tuple(dataset.transform))
    assert grid == mediant.Grid(COSTS < 0, costs=COSTS, cell_size=(30, 20))
