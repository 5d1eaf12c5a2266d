"""Distance fields, clearance and agents of a size, held to graphs and to scipy.ndimage."""

from __future__ import annotations

import math
from fractions import Fraction

import mediant
import numpy as np
import pytest
import slow

ndimage = pytest.importorskip("scipy.ndimage")


def free_vertices(oracle):
    return [at for at in oracle.vertices() if oracle.is_free(at)]


@pytest.mark.parametrize("rule", slow.RULES)
@pytest.mark.parametrize("k", [2, 3, 4, 5, "any"])
def test_fields(rng, rule, k):
    """Distances, directions, next vertices and paths of a field from several sources."""
    if k == "any" and rule[0] == "center":
        pytest.skip("no engine is exact there")
    blocked = slow.random_map(rng, 8, 13, 0.3)
    grid, oracle, how = mediant.Grid(blocked), slow.Slow(blocked, rule), {"k": k, **slow.motion(rule)}
    free = free_vertices(oracle)
    sources = [free[i] for i in rng.integers(len(free), size=3)]
    wanted = oracle.distances(k, sources).min(axis=0)
    field = grid.field(sources, **how)
    assert field.shape == oracle.shape
    assert field.distances() == pytest.approx(wanted, abs=1e-7)
    assert np.array_equal(grid.distances(np.array(sources), **how), field.distances())
    assert np.array_equal(grid.flow(sources, **how), field.flow(), equal_nan=True)
    check_steps(oracle, k, field, (wanted, sources))


def check_steps(oracle, k, field, target):
    wanted, sources = target
    flow, following = field.flow(), field.next()
    assert flow.shape == following.shape == (*oracle.shape, 2)
    assert (flow.dtype, following.dtype) == (np.float64, np.int32)
    for at in oracle.vertices():
        after, path = tuple(following[at].tolist()), field.path_from(at)
        if math.isinf(wanted[at]):
            assert after == (-1, -1) and np.isnan(flow[at]).all()
            assert path is None and field.nearest_source(at) is None
            continue
        assert (tuple(path[0]), tuple(path[-1])) == (at, field.nearest_source(at))
        assert field.nearest_source(at) in sources
        assert slow.length(path) == pytest.approx(wanted[at], abs=1e-7)
        assert oracle.is_path(path[: None if wanted[at] else 1], k) is None, (at, path.tolist())
        if wanted[at] == 0:
            assert after == at and (flow[at] == 0).all()
        else:
            assert oracle.is_path([at, after], k) is None or oracle.name == "closed"
            assert math.dist(at, after) + wanted[after] == pytest.approx(wanted[at], abs=1e-7)
            straight = np.array(after) - at
            assert flow[at] == pytest.approx(straight / np.hypot(*straight), abs=1e-9)


def test_limit_of_field(rng):
    blocked = slow.random_map(rng, 12, 9, 0.2)
    grid, oracle = mediant.Grid(blocked), slow.Slow(blocked, ("center", "never"))
    source = free_vertices(oracle)[0]
    for k in (2, 3, 4):
        whole = grid.distances(source, k=k)
        for limit in (0, 1, 2.5, 7, np.inf):
            within = grid.distances(source, limit=limit, k=k)
            # Limits leave room for rounding.
            near = np.isfinite(whole) & (whole <= limit * (1 + 2**-31))
            assert np.array_equal(within, np.where(near, whole, np.inf)), (k, limit)
            assert np.array_equal(grid.reach(source, limit, k=k), near)
            assert grid.reach(source, limit, k=k).dtype == bool


@pytest.mark.parametrize("how", [{"k": 2}, {"k": 3}, {"k": 5}, {"k": 3, "gap": "open"}, {"k": "any"}])
def test_distances_are_one_number_and_reach_what_they_measure(rng, how):
    grid = mediant.Grid(slow.random_map(rng, 9, 9, 0.1))
    field = grid.field((0, 0), **how) if grid.is_free((0, 0), **how) else None
    if field is None:
        pytest.skip("the corner is blocked")
    index = grid.prepare(**how)
    known = field.distances()
    places = np.argwhere(np.isfinite(known))
    wanted = [known[tuple(at)] for at in places]
    measured = [
        [grid.distance((0, 0), at, **how) for at in places],
        [grid.find((0, 0), at, **how).distance for at in places],
        [index.distance((0, 0), at) for at in places],
        index.distances((0, 0), places).tolist(),
        index.paths((0, 0), places).distances.tolist(),
        index.table([(0, 0)], places)[0].tolist(),
    ]
    for numbers in measured:
        # At any angle the last digits can differ.
        assert numbers == (pytest.approx(wanted, rel=2**-31) if how["k"] == "any" else wanted)
        for at, distance in zip(places, numbers):
            assert grid.reach((0, 0), distance, **how)[tuple(at)], (at, distance)


def test_limits_include_what_lies_exactly_there():
    assert mediant.Grid.from_rows(["..", ".."]).reach((0, 0), 2**0.5).all()
    # Two steps straight ahead of the goal, and one diagonal one.
    path = mediant.Grid.from_rows(["....", "....", "...."]).path((0, 0), (2, 3), tolerance=2**0.5)
    assert path[-1].tolist() in [[1, 2], [2, 2], [0, 2], [1, 3]]


def test_points_outside_a_field():
    field = mediant.Grid.from_rows(["...", "..#"]).field((0, 0))
    assert field.path_from((5, 5)) is None
    assert field.path_from((1, 2)) is None
    assert field.nearest_source((-1, 0)) is None
    assert field.path_from((0, 2), points="vertices").tolist() == [[0, 2], [0, 1], [0, 0]]


@pytest.mark.parametrize("seed", range(6))
def test_clearance(rng, seed):
    """From centers of cells to the nearest point of an obstacle: the transform of a finer picture."""
    rows, columns = int(rng.integers(3, 14)), int(rng.integers(3, 25))
    blocked = slow.random_map(rng, rows, columns, [0.02, 0.1, 0.3][seed % 3])
    grid = mediant.Grid(blocked)
    for outside in ("open", "blocked"):
        for fit in ("centers", "whole-cells"):
            wanted = slow_clearance(blocked, fit, outside)
            assert grid.clearance(fit=fit, outside=outside) == pytest.approx(wanted, abs=1e-12), (
                fit,
                outside,
            )
    assert np.array_equal(grid.clearance(), grid.clearance(fit="centers", outside="blocked"))


def slow_clearance(blocked, fit, outside):
    """By the distance transform of the half-cell lattice: obstacles are closed squares of 3 x 3 points."""
    wide = 1 if outside == "blocked" else 0
    blocked = np.pad(blocked, wide, constant_values=True)
    if not blocked.any():
        return np.full(blocked.shape, np.inf)
    rows, columns = blocked.shape
    points = np.zeros((2 * rows + 1, 2 * columns + 1), dtype=bool)
    for row, column in np.argwhere(blocked):
        points[2 * row : 2 * row + 3, 2 * column : 2 * column + 3] = True
    distances = ndimage.distance_transform_edt(~points) / 2
    if fit == "centers":
        result = distances[1::2, 1::2]
    else:
        # A cell's nearest point to an obstacle of the lattice is one of its corners.
        corners = distances[::2, ::2]
        result = np.minimum.reduce([corners[:-1, :-1], corners[1:, :-1], corners[:-1, 1:], corners[1:, 1:]])
    result = np.where(blocked, 0, result)
    return result[wide : rows - wide, wide : columns - wide]


def test_no_obstacle():
    grid = mediant.Grid(np.zeros((3, 7), dtype=bool))
    assert np.isinf(grid.clearance(outside="open")).all()
    assert np.array_equal(grid.for_disc(1e6, outside="open").to_numpy(), np.zeros((3, 7), dtype=bool))


@pytest.mark.parametrize("rule", slow.RULES)
def test_for_disc(rng, rule):
    """A cell is free where the disc fits: around its center, or around all of its points."""
    blocked = slow.random_map(rng, 13, 21, 0.08)
    grid = mediant.Grid(blocked)
    for radius in (0, 0.5, 0.500001, 1, 1.5, math.sqrt(5), 2.5):
        for outside in ("open", "blocked"):
            for fit in ("centers", "whole-cells"):
                # Exactly: squares are multiples of a quarter, and sqrt(5) is a little too large.
                squares = 4 * slow_clearance(blocked, fit, outside) ** 2
                least = math.ceil(4 * Fraction(radius) ** 2)
                fits = np.round(squares) >= least
                disc = grid.for_disc(radius, fit=fit, outside=outside, **slow.motion(rule))
                assert np.array_equal(disc.to_numpy(), ~fits | blocked), (radius, outside, fit)


def test_disc_keeps_its_distance(rng):
    """Along the path of a disc no obstacle is nearer than its radius."""
    blocked = slow.random_map(rng, 22, 34, 0.04)
    grid, radius = mediant.Grid(blocked), 1.3
    for k, rule in ((3, slow.RULES[0]), (4, slow.RULES[2]), ("any", slow.RULES[3])):
        how, checked = {"k": k, **slow.motion(rule)}, 0
        disc = grid.for_disc(radius, **how)
        oracle = slow.Slow(disc.to_numpy(), rule)
        free = free_vertices(oracle)
        for _ in range(20):
            start, goal = (free[i] for i in rng.integers(len(free), size=2))
            path = disc.path(start, goal, **how)
            if path is None or len(path) < 2:
                continue
            shift = 0.5 if rule[0] == "center" else 0
            dense = [a + (b - a) * t for a, b in zip(path, path[1:]) for t in np.linspace(0, 1, 50)]
            assert nearest_obstacle(np.array(dense) + shift, blocked).min() >= radius - 1e-9
            checked += 1
        assert checked > 5


def nearest_obstacle(points, blocked):
    """The distance of each point to the nearest blocked square; the outside of the map is one."""
    rows, columns = blocked.shape
    outside = np.min([points[:, 0], points[:, 1], rows - points[:, 0], columns - points[:, 1]], axis=0)
    cells = np.argwhere(blocked)
    beyond = np.maximum(np.maximum(cells - points[:, None], points[:, None] - cells - 1), 0)
    return np.minimum(
        np.maximum(outside, 0), np.hypot(beyond[..., 0], beyond[..., 1]).min(axis=1, initial=np.inf)
    )


def test_for_square(rng):
    """Free where all cells below and to the right of the place are."""
    blocked = slow.random_map(rng, 9, 17, 0.1)
    for side in (1, 2, 3, 9, 10, 10**9):
        wanted = np.ones_like(blocked)
        for row in range(9 - side + 1):
            for column in range(17 - side + 1):
                wanted[row, column] = blocked[row : row + side, column : column + side].any()
        assert np.array_equal(mediant.Grid(blocked).for_square(side).to_numpy(), wanted), side


def test_widest_path(rng):
    """No larger disc has a path that is short enough, and the path keeps its radius."""
    blocked = slow.random_map(rng, 16, 25, 0.07)
    grid, oracle = mediant.Grid(blocked), slow.Slow(blocked, ("center", "never"))
    free, checked = free_vertices(oracle), 0
    radii = sorted({*grid.clearance().ravel().tolist()} - {0.0})
    for _ in range(12):
        start, goal = (free[i] for i in rng.integers(len(free), size=2))
        shortest = grid.distance(start, goal)
        for surplus in (0, 0.2, 1):
            widest = grid.widest_path(start, goal, surplus=surplus)
            if math.isinf(shortest):
                assert widest is None
                continue
            path, radius = widest
            assert slow.length(path) <= (1 + surplus) * shortest + 1e-6
            assert oracle.is_path(path[: None if start != goal else 1], 3) is None
            if start != goal:
                dense = [a + (b - a) * t for a, b in zip(path, path[1:]) for t in np.linspace(0, 1, 50)]
                assert nearest_obstacle(np.array(dense) + 0.5, blocked).min() >= radius - 1e-9
            for larger in (r for r in radii if r > radius + 1e-9):
                disc = grid.for_disc(larger)
                if disc.is_free(start) and disc.is_free(goal):
                    assert disc.distance(start, goal) > (1 + surplus) * shortest - 1e-6
            checked += 1
    assert checked


def code_of(code, d_row, d_column):
    """The number of a direction; None if the code has none."""
    if code == "arcgis":
        clockwise = [(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)]
        return clockwise.index((d_row, d_column)) + 1 if (d_row, d_column) in clockwise else None
    angle = math.degrees(math.atan2(-d_row, d_column))  # Counterclockwise from east.
    if code == "grass" and sorted((abs(d_row), abs(d_column))) == [1, 2]:
        angle = round(angle / 22.5) * 22.5
    return (90 - angle if code == "degrees" else angle) % 360 or 360.0


@pytest.mark.parametrize("how", [{"k": 2}, {"k": 3}, {"k": 4}, {"k": 3, "placement": "corner"}, {"k": "any"}])
def test_directions_as_numbers(rng, how):
    """They lead to the next vertex, on maps and on costs."""
    for has_costs in (False, True):
        if has_costs and how["k"] == "any":
            continue
        blocked = slow.random_map(rng, 9, 12, 0.25)
        costs = rng.integers(1, 9, size=blocked.shape) if has_costs else None
        grid = mediant.Grid(blocked, costs=costs)
        free = [at for at in np.argwhere(~blocked).tolist() if grid.is_free(at, **how)]
        field = grid.field([free[0], free[-1]], **how)
        distances, after = field.distances(), field.next()
        for code, source in (("arcgis", 0.0), ("degrees", 0.0), ("grass", None)):
            found, numbers = field.directions(code), set()
            assert found.shape == field.shape and found.dtype == np.float64
            for at in np.ndindex(field.shape):
                wanted = source
                if not np.isfinite(distances[at]):
                    wanted = None
                elif distances[at] > 0:
                    wanted = code_of(code, *(after[at] - at).tolist())
                assert found[at] == pytest.approx(np.nan if wanted is None else wanted, nan_ok=True)
                numbers.add(wanted)
            assert len(numbers) >= 4
    with pytest.raises(mediant.OptionError, match=r"code.*arcgis, degrees, grass"):
        field.directions("north")
