"""Rasters of costs and elevations: masked arrays, and those of xarray and rasterio; neither is imported."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import ArgumentError

__all__ = ["like_raster", "read", "read_elevation"]

_CODE = "argument"

_DEGREES = (
    "{name}: the coordinates are degrees, and the width of a cell differs from row to row: project it to "
    "meters first, for instance by {name}.rio.reproject({name}.rio.estimate_utm_crs()); or give cell_size=, "
    "(height, width) in meters, if the map is so small that one size is right for all rows"
)

_EVEN = 1e-3
"""The greatest difference between two spacings of coordinates, as a part of them."""


def read(
    name: str, raster: Any, nodata: Any, cell_size: Any, transform: Any
) -> tuple[NDArray[Any], NDArray[np.bool_], Any]:
    """Take a raster apart: its numbers, the cells that are blocked, and the size of a cell if it is known."""
    if cell_size is not None and transform is not None:
        raise ArgumentError("transform: it says the size of a cell: leave out cell_size", _CODE)
    blocks = _numbers("nodata", nodata)
    if transform is not None:
        cell_size = _size_of_transform(transform)
    dataset, band = _dataset_of(name, raster)
    if dataset is not None:
        if cell_size is None:
            if getattr(dataset.crs, "is_geographic", False):
                raise ArgumentError(_DEGREES.format(name=name), _CODE)
            cell_size = _size_of_transform(dataset.transform)
        raster = dataset.read(band, masked=True)
    elif _is_data_array(raster):
        blocks = blocks + _nodata_of(raster)
        if cell_size is None:
            cell_size = _size_of_coordinates(name, raster)
        raster = raster.data if isinstance(raster.data, np.ndarray) else raster.values
    numbers, blocked = _plane(name, raster)
    for value in blocks:
        if np.isnan(value):
            blocked |= np.isnan(numbers)
        else:
            blocked |= _equal(numbers, value)
    return numbers, blocked, cell_size


def read_elevation(
    elevation: Any, friction: Any, nodata: Any, cell_size: Any, transform: Any
) -> tuple[NDArray[np.float64], NDArray[np.float64] | None, Any]:
    """Take elevations and frictions apart, with no number where a cell is blocked, and the size of a cell."""
    numbers, blocked, size = read("elevation", elevation, nodata, cell_size, transform)
    if size is None:
        raise ArgumentError(
            "cell_size: give the side of a cell in the unit of the elevations, or transform=", _CODE
        )
    heights, frictions = _floats(numbers), None
    if friction is not None:
        rough, holes, _ = read("friction", friction, None, size, None)
        if rough.shape != heights.shape:
            raise ArgumentError(
                f"friction: expected the shape of the elevations, {heights.shape}, found {rough.shape}", _CODE
            )
        frictions = _floats(rough)
        blocked |= holes | np.isnan(frictions)
    return (np.where(blocked, np.nan, heights) if blocked.any() else heights), frictions, size


def like_raster(values: NDArray[np.float64], like: Any, name: str) -> Any:
    """Make a DataArray of these values with the coordinates of another one."""
    if not _is_data_array(like):
        raise TypeError(f"like: expected a DataArray of xarray, found {type(like).__name__}")
    if like.shape != values.shape:
        raise ArgumentError(f"like: expected one of shape {values.shape}, found {tuple(like.shape)}", _CODE)
    kept = {key: like.attrs[key] for key in ("crs", "transform", "res", "grid_mapping") if key in like.attrs}
    return type(like)(values, coords=like.coords, dims=like.dims, name=name, attrs=kept)


def _floats(numbers: NDArray[Any]) -> NDArray[np.float64]:
    """Give numbers as those of 64 bits, without a copy if they are."""
    return np.asarray(numbers, dtype=np.float64)


def _dataset_of(name: str, value: Any) -> tuple[Any, Any]:
    """Give the dataset of rasterio and the number of its band, if the value is one or is of one."""
    band = getattr(value, "bidx", None)
    dataset = value if band is None else value.ds
    if not all(hasattr(dataset, part) for part in ("read", "transform", "crs", "count")):
        return None, None
    if band is None:
        if dataset.count != 1:
            raise ArgumentError(
                f"{name}: expected a dataset of one band, found {dataset.count}: give one of them by "
                "rasterio.band(dataset, 1)",
                _CODE,
            )
        band = 1
    return dataset, band


def _plane(name: str, raster: Any) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """Give the numbers of an array of rows and columns, where they are, and those that are masked."""
    mask: Any = np.ma.getmask(raster) if isinstance(raster, np.ma.MaskedArray) else np.ma.nomask
    try:
        numbers = np.asarray(raster)
    except (TypeError, ValueError, OverflowError) as error:
        raise ArgumentError(f"{name}: expected rows of the same length, found no array", _CODE) from error
    if numbers.ndim == 3 and numbers.shape[0] == 1:  # A raster of one band.
        numbers, mask = numbers[0], mask if mask is np.ma.nomask else mask[0]
    if numbers.ndim != 2:
        raise ArgumentError(
            f"{name}: expected an array of rows and columns, found one of shape {numbers.shape}", _CODE
        )
    if numbers.dtype.kind not in "iuf":
        what = ": an array of bool says which cells are blocked: Grid(array)" * (numbers.dtype.kind == "b")
        raise TypeError(f"{name}: expected numbers, found {numbers.dtype}{what}")
    blocked = np.zeros(numbers.shape, dtype=bool)
    if mask is not np.ma.nomask:
        blocked |= mask
    return numbers, blocked


def _numbers(name: str, value: Any) -> list[float]:
    """Take one number or several; None is none."""
    if value is None:
        return []
    try:
        shape: tuple[int, ...] = np.shape(value)
        items = list(value) if isinstance(value, Iterable) and shape else [value]
        return [float(item) for item in items]
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name}: expected a number or several, found {type(value).__name__}") from None


def _equal(numbers: NDArray[Any], value: float) -> Any:
    """Say where an array has a value, which is rounded to its type, as a raster rounds it."""
    if numbers.dtype.kind == "f":
        with np.errstate(over="ignore"):
            return numbers == np.asarray(value, dtype="f8").astype(numbers.dtype)
    return numbers == value


def _is_data_array(value: Any) -> bool:
    """Whether it is a raster of xarray, or like one."""
    return all(hasattr(value, name) for name in ("dims", "coords", "attrs", "values", "data"))


def _nodata_of(raster: Any) -> list[float]:
    """Give the values that a raster says are no data."""
    found: list[Any] = []
    for where in (raster.attrs, getattr(raster, "encoding", {})):
        for key in ("_FillValue", "missing_value", "nodata"):
            found.append(where.get(key))
        found.extend(np.ravel(where.get("nodatavals", ())))
    rio = getattr(raster, "rio", None)
    found.append(getattr(rio, "nodata", None))
    numbers = [number for value in found if value is not None for number in _numbers("nodata", value)]
    # A raster that was read with its no-data as `nan` has the value of the file in its encoding.
    return [*numbers, float("nan")] if numbers and raster.dtype.kind == "f" else numbers


def _size_of_coordinates(table: str, raster: Any) -> tuple[float, float] | None:
    """Give the height and the width of a cell, by the coordinates of rows and columns."""
    sizes: list[float | None] = []
    for name in raster.dims[-2:]:
        size = None
        if name in raster.coords:
            coordinate = raster.coords[name]
            units = str(coordinate.attrs.get("units", "")).lower()
            if units.startswith("degree") or str(name).lower() in ("lat", "lon", "latitude", "longitude"):
                raise ArgumentError(_DEGREES.format(name=table), _CODE)
            if coordinate.size > 1:
                size = _spacing(table, str(name), np.asarray(coordinate.values, dtype="f8"))
        sizes.append(size)
    if _is_geographic(raster):
        raise ArgumentError(_DEGREES.format(name=table), _CODE)
    # Of one row or one column nothing is known: cells are square.
    known = [size for size in sizes if size is not None]
    return (sizes[0] or known[0], sizes[-1] or known[-1]) if known else None


def _spacing(table: str, name: str, places: NDArray[np.float64]) -> float:
    """Give the even spacing of coordinates."""
    steps = np.diff(places)
    mean = float(steps.mean())
    if not (np.isfinite(mean) and mean != 0 and np.all(np.abs(steps - mean) <= _EVEN * abs(mean))):
        raise ArgumentError(
            f"{table}: the coordinate {name!r} is not evenly spaced: resample the raster, or give cell_size=",
            _CODE,
        )
    return abs(mean)


def _is_geographic(raster: Any) -> bool:
    """Whether a raster says that its coordinates are degrees."""
    crs = getattr(getattr(raster, "rio", None), "crs", None)
    if crs is not None and hasattr(crs, "is_geographic"):
        return bool(crs.is_geographic)
    texts = [str(raster.attrs.get("crs", ""))]
    if "spatial_ref" in raster.coords:
        attrs = raster.coords["spatial_ref"].attrs
        texts += [str(attrs.get(key, "")) for key in ("crs_wkt", "spatial_ref")]
    starts = ("GEOGCS", "GEOGCRS", "GEODCRS", "EPSG:4326", "+INIT=EPSG:4326", "+PROJ=LONGLAT")
    return any(text.strip().upper().startswith(starts) for text in texts)


def _size_of_transform(transform: Any) -> tuple[float, float]:
    """Give the height and the width of a cell, by the transform of rasterio."""
    try:
        a, b, _, d, e, _ = [float(number) for number in tuple(transform)[:6]]
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(
            f"transform: expected that of a dataset of rasterio, found {type(transform).__name__}"
        ) from error
    if b != 0 or d != 0:
        raise ArgumentError("transform: it turns the cells: give cell_size=, their height and width", _CODE)
    return abs(e), abs(a)
