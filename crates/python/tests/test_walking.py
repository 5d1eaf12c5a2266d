"""Walking over elevation: times against slow references and GRASS; headings; arrays; what is refused."""

from __future__ import annotations

import copy
import math
import pickle
import re
import typing
from pathlib import Path

import calls
import mediant
import numpy as np
import pytest
import scipy.sparse
import slow

RULES = [rule for rule in slow.RULES if rule[0] == "center"]


def tobler(slope):
    """Seconds a meter."""
    return 3.6 / (6 * math.exp(-3.5 * abs(slope + 0.05)))


def langmuir(slope):
    """The same by `r.walk`, with its own coefficients."""
    return 0.72 + slope * (6.0 if slope >= 0 else 1.9998 if slope >= -0.2125 else -1.9998)


def times(elevation, friction, pace, cell_size, rule, k):
    """The times from each cell to each other one, by Dijkstra's algorithm over straight and diagonal moves.

    Those from and to blocked cells are infinite.
    """
    walls = slow.Slow(np.isnan(elevation), rule)
    number = {at: i for i, at in enumerate(walls.vertices())}
    graph = scipy.sparse.dok_array((len(number), len(number)))
    for at, i in number.items():
        for move in slow.moves(k):
            to = (at[0] + move[0], at[1] + move[1])
            if walls.is_free(at) and walls.sees(at, to):
                length = math.hypot(move[0] * cell_size[0], move[1] * cell_size[1])
                rough = (friction[at] + friction[to]) / 2
                graph[i, number[to]] = length * (pace((elevation[to] - elevation[at]) / length) + rough)
    found = scipy.sparse.csgraph.dijkstra(graph.tocsr())
    blocked = np.flatnonzero(np.isnan(elevation))
    found[blocked, blocked] = math.inf
    return found.reshape(elevation.shape * 2)


def random_ground(rng, rows=6, columns=8):
    """Elevations, with holes, and frictions."""
    elevation = rng.uniform(100, 118, size=(rows, columns))
    elevation[slow.random_map(rng, rows, columns, 0.2)] = np.nan
    return elevation, rng.uniform(0, 1.5, size=elevation.shape) * rng.integers(2)


@pytest.mark.parametrize("rule", RULES, ids="-".join)
@pytest.mark.parametrize("k", [2, 3])
def test_times_are_those_of_a_slow_reference(rng, rule, k):
    """Queries, tables, fields of both headings, and the times of their paths."""
    differing = 0
    for name, pace, exact in (("tobler", tobler, 1.6e-6), ("langmuir", langmuir, 1e-7)):
        for cell_size in ((30.0, 30.0), (20.0, 35.0)):
            elevation, friction = random_ground(rng)
            wanted = times(elevation, friction, pace, cell_size, rule, k)
            land = mediant.Grid.from_elevation(elevation, pace=name, friction=friction, cell_size=cell_size)
            how = {"k": k, **slow.motion(rule)}
            note = (name, cell_size, elevation.tolist(), friction.tolist())
            free = np.argwhere(~np.isnan(elevation))
            index = land.prepare(**how)
            table = index.table(free, free)
            every = wanted[tuple(free.T)][(slice(None), *free.T)]
            assert np.allclose(table, every, rtol=exact), note
            differing += int((~np.isclose(table, table.T, rtol=1e-3)).sum())
            for source in free[rng.integers(len(free), size=3)]:
                leave, reach = wanted[tuple(source)], wanted[(slice(None), slice(None), *source)]
                outward, inward = (land.field(source, heading=way, **how) for way in ("from", "to"))
                assert np.allclose(outward.distances(), leave, rtol=exact), note
                assert np.allclose(inward.distances(), reach, rtol=exact), note
                assert np.allclose(land.distances(source, **how), reach, rtol=exact), note
                limit = float(np.median(leave[np.isfinite(leave)])) * 1.01
                assert np.array_equal(land.reach(source, limit, **how), leave <= limit), note
                for goal in map(tuple, free):
                    answer = land.find(source, goal, **how)
                    assert answer.distance == outward.get(goal) == index.distance(source, goal), note
                    path, back = outward.path_to(goal), inward.path_from(goal)
                    assert (path is None) == (answer.path is None) == math.isinf(leave[goal]), note
                    assert (back is None) == math.isinf(reach[goal]), note
                    for found, total in (
                        (path, leave[goal]),
                        (answer.path, leave[goal]),
                        (back, reach[goal]),
                    ):
                        if found is not None:
                            assert time_of(found, elevation, friction, pace, cell_size) == pytest.approx(
                                total, rel=exact
                            ), note
                sums = outward.corridor(inward)
                assert np.allclose(sums, leave + reach, rtol=exact), note
    assert differing > 100


def time_of(path, elevation, friction, pace, cell_size):
    """The time of a path of straight and diagonal moves."""
    total = 0.0
    for a, b in zip(path, path[1:]):
        steps = int(np.abs(b - a).max())
        for i in range(steps):
            at, to = (tuple(a + (b - a) // steps * j) for j in (i, i + 1))
            length = math.hypot(*((np.array(to) - at) * cell_size))
            slope = (elevation[to] - elevation[at]) / length
            total += length * (pace(slope) + (friction[at] + friction[to]) / 2)
    return total


def test_a_ridge_is_crossed_by_pieces():
    """A knight's move climbs the ridge that it passes, and a straight slope costs what its formula says."""
    ridge = np.array([[0, 0], [2, 2], [0, 0]])
    land = mediant.Grid.from_elevation(ridge, cell_size=10)
    half = math.hypot(10, 5)
    wanted = half * (tobler(2 / half) + tobler(-2 / half))
    assert land.distance((0, 0), (2, 1), k=4) == pytest.approx(wanted, rel=2e-6)
    rows, columns = np.mgrid[:9, :9]
    hill = mediant.Grid.from_elevation(3 * rows + columns, cell_size=(20, 10))
    for goal in ((8, 0), (0, 8), (8, 8), (8, 4), (4, 8), (6, 2)):
        length = math.hypot(goal[0] * 20, goal[1] * 10)
        slope = (3 * goal[0] + goal[1]) / length
        assert hill.distance((0, 0), goal, k=6) <= length * tobler(slope) * (1 + 2e-6)


def test_times_are_those_of_r_walk():
    """Those that GRASS printed for 8 neighbors, with friction and without."""
    file = Path(__file__).parents[2] / "costs" / "tests" / "it" / "walking" / "r.walk.txt"
    number = lambda word: math.nan if word == "*" else float(word)  # noqa: E731
    blocks = [
        np.array([[number(word) for word in line.split()] for line in block.strip().splitlines()])
        for block in file.read_text(encoding="utf-8").split("\n\n")[1:]
    ]
    compared = 0
    for first in range(0, len(blocks), 7):
        head, elevation, friction, *wanted = blocks[first : first + 5]
        width, height, column, row = head[0]
        for factor, known in zip((0, 1), wanted):
            land = mediant.Grid.from_elevation(
                elevation, pace="langmuir", friction=factor * friction, cell_size=(height, width)
            )
            found = land.distances((int(row), int(column)), heading="from", corners="always")
            assert np.allclose(found, np.where(np.isnan(known), np.inf, known), rtol=0, atol=5e-9)
            compared += np.isfinite(found).sum()
    assert compared == 2 * (36 + 25 + 55)


def test_a_table_is_a_pace(rng):
    elevation, friction = random_ground(rng)
    knots = [(-0.9, 3.0), (-0.31, 0.9), (-0.05, 0.4), (0.03, 0.5), (0.8, 7.0)]
    pace = lambda slope: float(np.interp(slope, *zip(*knots)))  # noqa: E731
    land = mediant.Grid.from_elevation(elevation, pace=knots, friction=friction, cell_size=30)
    free = np.argwhere(~np.isnan(elevation))
    wanted = times(elevation, friction, pace, (30, 30), RULES[0], 3)
    assert np.allclose(land.distances(free[0], heading="from"), wanted[tuple(free[0])], rtol=1e-7)
    assert np.array_equal(land.pace, knots) and land == pickle.loads(pickle.dumps(land))
    assert mediant.Grid.from_elevation(elevation, cell_size=30).pace == "tobler"


def test_paces_have_the_names_of_the_stub():
    parameter = next(
        p for c in calls.all_calls() if c.name == "from_elevation" for p in c.parameters if p.name == "pace"
    )
    names = re.findall(r"'(\w+)'", parameter.type.split("]")[0])
    with pytest.raises(mediant.OptionError, match="pace: expected one of " + ", ".join(names)):
        mediant.Grid.from_elevation([[1.0]], pace="naismith", cell_size=1)
    for name in names:
        assert mediant.Grid.from_elevation([[1.0, 2.0]], pace=name, cell_size=9).pace == name


def test_fields_of_several_sources(rng):
    """The nearest source of each cell, of both headings, and directions towards it."""
    elevation, friction = random_ground(rng, 9, 11)
    land = mediant.Grid.from_elevation(elevation, friction=friction, cell_size=30)
    free = np.argwhere(~np.isnan(elevation))
    sources = free[rng.choice(len(free), size=3, replace=False)]
    for way in ("from", "to"):
        field = land.field(sources, heading=way, k=4)
        each = np.array([land.distances(source, heading=way, k=4) for source in sources])
        assert np.array_equal(field.distances(), each.min(axis=0))
        numbers = field.allocation()
        assert np.array_equal(numbers == -1, np.isinf(field.distances()))
        next_of, links, flow = field.next(), field.directions("degrees"), field.flow()
        for at in map(tuple, free[np.isfinite(field.distances()[tuple(free.T)])]):
            assert each[numbers[at]][at] == field.get(at) and field.nearest_source(at) == tuple(
                sources[numbers[at]]
            )
            if field.get(at) > 0:
                assert field.get(next_of[at]) < field.get(at) and np.isfinite(flow[at]).all()
                down, right = next_of[at] - at
                assert links[at] == pytest.approx(math.degrees(math.atan2(right, -down)) % 360 or 360)
    batch = pytest.importorskip("mediant.batch")
    found = batch.fields({"all": sources}, land, heading="from", k=4)["all"]
    assert np.array_equal(found, land.distances(sources, heading="from", k=4))
    assert not np.array_equal(found, batch.fields({"all": sources}, land, k=4)["all"])


def test_headings_agree_where_ways_do(rng):
    """On grids without elevation both headings are one."""
    blocked = slow.random_map(rng, 8, 9, 0.2)
    start = np.argwhere(~blocked)[0]
    for grid in (mediant.Grid(blocked), mediant.Grid(blocked, costs=rng.uniform(1, 3, size=blocked.shape))):
        for k in (3, 5):
            to, leave = (grid.field(start, heading=way, k=k) for way in ("to", "from"))
            assert np.array_equal(to.distances(), leave.distances())
            assert np.array_equal(to.flow(), leave.flow(), equal_nan=True)
            for at in np.argwhere(np.isfinite(to.distances())):
                assert np.array_equal(to.path_to(at)[::-1], leave.path_from(at))


def test_arrays_of_any_kind(rng):
    numbers = rng.integers(0, 100, size=(5, 7))
    holes = rng.random((5, 7)) < 0.3
    floats = np.where(holes, np.nan, numbers)
    wanted = mediant.Grid.from_elevation(floats, cell_size=30)
    assert np.array_equal(wanted.to_numpy(), holes)
    assert np.array_equal(wanted.elevation, floats, equal_nan=True) and wanted.friction is None
    assert wanted.costs is None and not wanted.has_costs and wanted.cell_size == (30.0, 30.0)
    again = [
        mediant.Grid.from_elevation(np.ma.masked_array(numbers, mask=holes), cell_size=(30, 30)),
        mediant.Grid.from_elevation(np.where(holes, -99, numbers).astype(">i2"), nodata=-99, cell_size=30),
        mediant.Grid.from_elevation(
            np.asfortranarray(floats, dtype="f4")[None], transform=(30, 0, 5, 0, -30, 7)
        ),
        mediant.Grid.from_elevation(calls.Raster(floats), cell_size=30),
        mediant.Grid.from_elevation(floats.tolist(), cell_size=30, friction=np.zeros((5, 7), "u1")),
        mediant.Grid.from_elevation(
            np.where(holes, 5, numbers), cell_size=30, friction=np.where(holes, np.nan, 0)
        ),
    ]
    for grid in again:
        assert grid == wanted and grid.id == wanted.id and hash(grid) == hash(wanted)
    rough = np.ma.masked_array(np.full((5, 7), 0.5), mask=holes)
    grid = mediant.Grid.from_elevation(numbers, cell_size=30, friction=rough)
    assert np.array_equal(grid.friction, np.where(holes, np.nan, 0.5), equal_nan=True) and grid != wanted
    before = floats.copy()
    mediant.Grid.from_elevation(floats, friction=np.where(numbers > 50, np.nan, 0.5), cell_size=30)
    assert np.array_equal(floats, before, equal_nan=True), "arrays stay as they are"


class Dataset:
    """What is read of a dataset of rasterio."""

    def __init__(self, *bands, geographic=False):
        self.bands, self.count, self.transform = bands, len(bands), (20.0, 0, 500, 0, -30.0, 130)
        self.crs = type("Crs", (), {"is_geographic": geographic})()

    def read(self, band, masked):
        assert masked
        return np.ma.masked_less(self.bands[band - 1], 0)


class Band(typing.NamedTuple):
    ds: Dataset
    bidx: int


def test_rasters_say_the_size_of_cells():
    heights = np.array([[1.0, 2.0, 4.0], [-9.0, 3.0, 1.0]])
    wanted = mediant.Grid.from_elevation(heights, nodata=-9, cell_size=(30, 20))
    two = Dataset(heights + 1, heights)
    for raster in (Dataset(heights), Band(two, 2)):
        assert mediant.Grid.from_elevation(raster) == wanted
    assert mediant.Grid.from_elevation(Dataset(heights), friction=Dataset(heights)).friction[0, 2] == 4
    assert mediant.Grid.from_costs(Dataset(heights)) == mediant.Grid.from_costs(
        heights, nodata=-9, cell_size=(30, 20)
    )
    with pytest.raises(mediant.ArgumentError, match=r"elevation: .*one band.*rasterio.band"):
        mediant.Grid.from_elevation(two)
    with pytest.raises(mediant.ArgumentError, match=r"elevation: .*degrees.*elevation.rio"):
        mediant.Grid.from_elevation(Dataset(heights, geographic=True))
    assert mediant.Grid.from_elevation(Dataset(heights, geographic=True), cell_size=7).cell_size == (7.0, 7.0)
    xarray = pytest.importorskip("xarray", reason="xarray is not installed")
    coords = {"y": [130.0, 100.0], "x": [500.0, 520.0, 540.0]}
    raster = xarray.DataArray(heights, dims=("y", "x"), coords=coords, attrs={"_FillValue": -9.0})
    land = mediant.Grid.from_elevation(raster, friction=raster.where(raster > 0) / 9)
    assert land == mediant.Grid.from_elevation(
        heights, nodata=-9, cell_size=(30, 20), friction=np.where(heights < 0, np.nan, heights / 9)
    )
    again = land.field((0, 0), heading="from").to_xarray(raster)
    assert again.name == "cost" and again.coords.equals(raster.coords)


def test_bands_of_rasterio(tmp_path):
    rasterio = pytest.importorskip("rasterio", reason="rasterio is not installed")
    heights = np.array([[1.0, 2.0, 4.0], [-9.0, 3.0, 1.0]], dtype="f4")
    transform = rasterio.transform.from_origin(500, 130, 20, 30)
    how = {"driver": "GTiff", "height": 2, "width": 3, "count": 1, "dtype": "float32", "nodata": -9.0}
    with rasterio.open(tmp_path / "f.tif", "w", crs="EPSG:32632", transform=transform, **how) as file:
        file.write(heights, 1)
    with rasterio.open(tmp_path / "f.tif") as dataset:
        one, other = (mediant.Grid.from_elevation(of) for of in (dataset, rasterio.band(dataset, 1)))
    assert one == other == mediant.Grid.from_elevation(heights, nodata=-9, cell_size=(30, 20))


def test_grids_are_values(rng):
    """Equal, hashed, pickled and copied, with their place in the world, and their indexes too."""
    for _ in range(10):
        elevation, friction = random_ground(rng)
        world = mediant.World(30, (1, 2), shape=elevation.shape)
        land = mediant.Grid.from_elevation(
            elevation, friction=friction, cell_size=(30, 31), pace="langmuir", world=world
        )
        for again in (pickle.loads(pickle.dumps(land)), copy.copy(land), copy.deepcopy(land)):
            assert again == land and hash(again) == hash(land) and again.id == land.id
            assert again.world == world and repr(again) == repr(land) and again.pace == "langmuir"
            assert np.array_equal(again.elevation, land.elevation, equal_nan=True)
            assert again.cell_size == (30.0, 31.0)
        elsewhere = land.with_world(None)
        assert elsewhere.world is None and elsewhere.id == land.id and elsewhere != land
        ends = tuple(np.argwhere(~np.isnan(elevation))[[0, -1]])
        index = pickle.loads(pickle.dumps(land.prepare(k=5)))
        assert index.grid == land and index.distance(*ends) == land.distance(*ends, k=5)
        others = [
            mediant.Grid.from_elevation(elevation, friction=friction, cell_size=(30, 31), world=world),
            mediant.Grid.from_elevation(elevation + 0.5 * (friction > 9), cell_size=(31, 30), world=world),
            mediant.Grid(np.isnan(elevation), world=world),
        ]
        assert land not in others and land.id not in [other.id for other in others]
        repaired = index.repair(others[0])
        assert repaired.grid == others[0] and repaired.distance(*ends) == others[0].distance(*ends, k=5)
    assert land._repr_png_().startswith(b"\x89PNG")
    assert land.field(ends[0], heading="from")._repr_png_().startswith(b"\x89PNG")
    make, (heights, rough, place, bounds, size, pace) = land.__reduce__()
    nothing = ((math.nan, math.inf), (-1.0, 0.0))
    assert make(heights, rough, place, nothing, size, pace).shape == land.shape
    for odd in (
        (heights, np.zeros((1, 8))),
        (heights[0], rough),
        (heights.astype("f4"), rough),
        (None, rough),
    ):
        with pytest.raises((mediant.ArgumentError, TypeError)):
            make(*odd, place, bounds, size, pace)


@pytest.mark.parametrize(
    ("how", "error", "words"),
    [
        ({}, mediant.ArgumentError, "cell_size: .*unit of the elevations"),
        ({"elevation": [[1, np.inf]]}, mediant.MapError, r"elevation: .*\(0, 1\) is inf.*nodata"),
        ({"friction": [[0, 0], [-1, 0]]}, mediant.MapError, r"friction: .*\(1, 0\) is -1.*from 0 on"),
        ({"friction": [[0, 0], [0, np.inf]]}, mediant.MapError, r"friction: .*\(1, 1\) is inf"),
        ({"friction": [[0, 0]]}, mediant.ArgumentError, r"friction: .*\(2, 2\).*\(1, 2\)"),
        ({"friction": 3}, mediant.ArgumentError, "friction: .*rows and columns"),
        ({"elevation": [1, 2]}, mediant.ArgumentError, "elevation: .*rows and columns"),
        ({"elevation": [[True]]}, TypeError, "elevation: expected numbers, found bool"),
        ({"elevation": np.ones((0, 3))}, mediant.MapError, "elevation: .*0 rows"),
        ({"elevation": [[0, 1e9]]}, mediant.MapError, "elevation: .*too far apart.*steep"),
        ({"pace": "x"}, mediant.OptionError, "pace: .*tobler, langmuir"),
        ({"pace": [(0, 1), (-1, 1)]}, mediant.ArgumentError, "pace: .*increasing"),
        ({"pace": [(0, -1)]}, mediant.ArgumentError, "pace: .*positive"),
        ({"pace": np.zeros((0, 2))}, mediant.ArgumentError, "pace: "),
        ({"pace": [1, 2, 3]}, mediant.ArgumentError, r"pace: .*\(n, 2\)"),
        ({"pace": object()}, TypeError, "pace: expected one of tobler"),
        ({"cell_size": 0}, mediant.ArgumentError, "cell_size"),
        ({"cell_size": (1, np.nan)}, mediant.ArgumentError, "cell_size"),
        ({"transform": (1, 0, 0, 0, 1, 0), "cell_size": 1}, mediant.ArgumentError, "transform"),
        ({"world": mediant.World(1, shape=(9, 9))}, mediant.ArgumentError, "world"),
        ({"costs": 3}, TypeError, "costs"),
    ],
)
def test_mistakes_say_what_to_do(how, error, words):
    how = {"elevation": [[1, 2], [3, 4]], **({"cell_size": 10} if how else {}), **how}
    with pytest.raises(error, match=words):
        mediant.Grid.from_elevation(how.pop("elevation"), **how)


def test_what_there_is_not_over_elevation_is_refused(tmp_path):
    land = mediant.Grid.from_elevation(np.arange(12.0).reshape(3, 4), cell_size=10)
    index, ends = land.prepare(), ((0, 0), (2, 3))
    for call in [
        lambda: land.path(*ends, k="any"),
        lambda: land.path(*ends, k=9),
        lambda: land.path(*ends, placement="corner"),
        lambda: land.path(*ends, engine="jps"),
        lambda: land.prepare("landmarks"),
        lambda: land.path(*ends, smooth="linear"),
        lambda: land.widest_path(*ends, surplus=0.1),
        lambda: land.disc(1.0),
        lambda: land.for_disc(1.0),
        lambda: land.for_square(2),
        lambda: land.inflated(inflation_radius=2),
        lambda: land.edit((0, 0), [[True]]),
        lambda: land.edit_cells((0, 0), True),
        lambda: land.index_from_bytes(b"x"),
        lambda: land.load(tmp_path / "index"),
        lambda: index.save(tmp_path / "index"),
        lambda: index.find_except(*ends, blocked=[(1, 1)]),
    ]:
        with pytest.raises(mediant.OptionError):
            call()
    with pytest.raises(mediant.MapError, match="no costs"):
        land.edit_costs((0, 0), 3)
    with pytest.raises(mediant.OptionError, match="heading: expected one of to, from"):
        land.field((0, 0), heading="away")
    to, leave = (land.field((0, 0), heading=way) for way in ("to", "from"))
    for call, words in [
        (lambda: to.path_to((1, 1)), "this field has path_from.*heading='from'"),
        (lambda: leave.path_from((1, 1)), "this field has path_to.*heading='to'"),
        (lambda: to.corridor(to), "from its sources and .* to its sources"),
        (lambda: leave.corridor(leave), "from its sources and .* to its sources"),
    ]:
        with pytest.raises(mediant.MismatchError, match=words):
            call()


def test_searches_in_steps_and_wishes():
    land = mediant.Grid.from_elevation(np.arange(20.0).reshape(4, 5) ** 1.5, cell_size=10)
    least = land.distance((0, 0), (3, 4))
    assert least > land.distance((3, 4), (0, 0))
    search = land.prepare("dijkstra").search((0, 0), (3, 4), trace=True)
    while search.step(3) is None:
        assert search.lower_bound <= least
    assert search.answer.cost == least and search.answer.length < least
    assert land.find((0, 0), (3, 4), max_cost=least).status == "found"
    assert land.find((0, 0), (3, 4), max_cost=least * 0.99).stopped_by == "cost"
    assert land.find((0, 0), (3, 4), tolerance=2).cost < least
    assert land.paths([(0, 0)], [(3, 4)]).distances.tolist() == [least]
    assert land.prepare().nearest([(0, 0)], [(3, 4), (0, 1)])[0].tolist() == [1]
    assert land.find((0, 0), (3, 4)).any_angle_lower_bound is None
