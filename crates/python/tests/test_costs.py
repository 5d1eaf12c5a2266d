"""Costs of cells: answers against the slow graph; arrays of all kinds; grids as values; what is refused."""

from __future__ import annotations

import copy
import json
import math
import pickle

import mediant
import numpy as np
import pytest
import slow

SIZES = [(1.0, 1.0), (3.0, 2.0), (0.5, 0.5)]


def random_costs(rng, rows, columns):
    """A random map with costs: small integers, wide integers, or fractions."""
    blocked = slow.random_map(rng, rows, columns, rng.choice([0.0, 0.2, 0.4]))
    kind = rng.integers(3)
    if kind == 0:
        costs = rng.integers(1, 4, size=blocked.shape)
    elif kind == 1:
        costs = rng.integers(1, 5000, size=blocked.shape)
    else:
        costs = rng.uniform(0.1, 9.0, size=blocked.shape)
    return blocked, costs


def pairs_of(rng, oracle, count):
    free = [at for at in oracle.vertices() if oracle.is_free(at)]
    return [tuple(free[i] for i in rng.integers(len(free), size=2)) for _ in range(count)]


def near(found, wanted):
    """Costs are exact but for one rounding of each move and of each cost: some 2**-31."""
    return np.allclose(found, wanted, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("rule", slow.RULES, ids="-".join)
@pytest.mark.parametrize("k", [2, 3, 4, 5])
def test_every_query_has_the_least_cost(rng, rule, k):
    """Paths, distances, tables, fields and searches in steps."""
    reached = 0
    for _ in range(6):
        blocked, costs = random_costs(rng, 6, 9)
        cell_size = SIZES[rng.integers(3)]
        oracle = slow.SlowCosts(blocked, rule, costs, cell_size)
        grid = mediant.Grid(blocked, costs=costs, cell_size=cell_size)
        how = {"k": k, **slow.motion(rule)}
        index = grid.prepare(**how)
        pairs = pairs_of(rng, oracle, 5)
        wanted = oracle.distances(k, [start for start, _ in pairs])
        costs_of_pairs = [wanted[(i, *goal)] for i, (_, goal) in enumerate(pairs)]
        note = (blocked.tolist(), costs.tolist(), cell_size, pairs)
        starts, goals = (np.array(ends) for ends in zip(*pairs))
        assert near(index.distances(starts, goals), costs_of_pairs), note
        assert near(index.distances(starts, goals, nearest=False, tolerance=0.1), costs_of_pairs), note
        assert near(np.diag(index.table(starts, goals)), costs_of_pairs), note
        assert near(grid.paths(starts, goals, **how).distances, costs_of_pairs), note
        for i, ((start, goal), least) in enumerate(zip(pairs, costs_of_pairs)):
            assert near(grid.distance(start, goal, **how), least), note
            assert near(index.distance(start, [goal], max_expansions=10**6), least), note
            answer = grid.find(start, goal, **how)
            assert near([answer.distance, answer.cost], [least, least]), note
            field = grid.field(start, **how)
            assert near(field.distances(), wanted[i]) and near(field.get(goal), least), note
            assert near(grid.distances(start, **how), wanted[i]), note
            if math.isinf(least):
                assert answer.path is None and math.isinf(answer.length), note
                continue
            for path in (answer.path, field.path_from(goal), index.search(start, goal).finish().path):
                assert oracle.is_path(path, k) is None and near(oracle.path_cost(path, k), least), note
            assert answer.length == pytest.approx(slow.length(answer.path)), note
            reached += start != goal
            limit = 0.618034 * least  # No cost is so near to it that rounding matters.
            assert np.array_equal(grid.reach(start, limit, **how), wanted[i] <= limit), note
            numbers = field.allocation()
            assert np.array_equal(numbers == 0, np.isfinite(wanted[i])), note
    assert reached > 8


def test_costs_of_one_are_lengths(rng):
    blocked = slow.random_map(rng, 11, 15, 0.25)
    plain, ones = mediant.Grid(blocked), mediant.Grid(blocked, costs=np.ones(blocked.shape))
    free = np.argwhere(~blocked)
    for k in (2, 3, 5):
        for start, goal in rng.choice(free, size=(20, 2)):
            a, b = (grid.find(start, goal, k=k) for grid in (plain, ones))
            assert (a.status, a.distance, a.cost) == (b.status, b.distance, b.cost)
            assert a.cost == a.length and b.length == pytest.approx(a.length)
            assert b.any_angle_lower_bound is None
    assert plain != ones and plain.id != ones.id
    assert np.array_equal(ones.field(free[0]).distances(), plain.field(free[0]).distances())


def test_engines_on_costs(rng):
    """All have the least cost over N(k); paths at any angle cost no more."""
    blocked, costs = random_costs(rng, 14, 21)
    grid = mediant.Grid(blocked, costs=costs)
    free = np.argwhere(~blocked)
    indexes = {name: grid.prepare(name, k=4) for name in ("dijkstra", "astar", "landmarks", "theta")}
    again = pickle.loads(pickle.dumps(indexes["landmarks"]))
    for start, goal in rng.choice(free, size=(15, 2)):
        least = grid.distance(start, goal, k=4)
        for index in (indexes["dijkstra"], indexes["astar"], indexes["landmarks"], again):
            assert near(index.distance(start, goal), least)
        for other in (indexes["theta"], grid.prepare("astar", k=4, smooth="linear")):
            answer = other.find(start, goal)
            assert answer.cost == least or answer.cost <= least * (1 + 1e-9)
            assert answer.path is None or grid.holds(answer.path, k=4)


def test_fields_of_several_sources(rng):
    """The nearest source by number, corridors, and where directions lead."""
    for has_costs in (True, False):
        blocked, costs = random_costs(rng, 12, 17)
        grid = mediant.Grid(blocked, costs=costs) if has_costs else mediant.Grid(blocked)
        free = np.argwhere(~blocked)
        sources = rng.choice(free, size=4)
        sources[3] = sources[0]
        field, each = grid.field(sources), [grid.field(source).distances() for source in sources]
        numbers, distances = field.allocation(), field.distances()
        assert numbers.dtype == np.int32 and not (numbers == 3).any()
        assert np.array_equal(numbers == -1, np.isinf(distances))
        for row, column in free:
            number, nearest = numbers[row, column], field.nearest_source((row, column))
            assert (nearest is None) == (number == -1)
            if nearest is not None:
                assert tuple(sources[number]) == nearest
                assert near(each[number][row, column], distances[row, column])
        corridor = field.corridor(grid.field(free[-1]))
        assert near(corridor, distances + grid.distances(free[-1]))
        path = field.path_from(free[-1], points="touched")
        if path is not None:
            assert near(corridor[tuple(path[0])], np.min(corridor))
    with pytest.raises(mediant.MismatchError):
        field.corridor(mediant.Grid(blocked, costs=costs).field(free[0]))
    with pytest.raises(TypeError, match="other"):
        field.corridor(distances)


def test_progress_of_fields(rng):
    """A field of costs tells how many cells have their cost; what the callback raises ends it."""
    costs = rng.integers(1, 90, size=(900, 1100))
    grid, told = mediant.Grid.from_costs(np.where(costs > 80, -1, costs), nodata=-1), []
    source = tuple(np.argwhere(costs <= 80)[0])
    field = grid.field(source, progress=lambda done, total: told.append((done, total)))
    assert np.array_equal(field.distances(), grid.distances(source))
    known = np.isfinite(field.distances()).sum()
    assert told == sorted(told) and told[-1] == (known, (costs <= 80).sum())
    with pytest.raises(ZeroDivisionError):
        grid.distances(source, progress=lambda done, total: 1 // 0)
    with pytest.raises(TypeError, match="progress"):
        grid.field(source, progress=3)
    assert mediant.Grid(costs > 80).field(source, progress=lambda *_: 1 // 0).get(source) == 0


def test_wishes_and_limits_count_costs():
    costs = np.ones((3, 9))
    costs[:, 4] = 10
    grid = mediant.Grid.from_costs(costs)
    assert grid.distance((1, 0), (1, 8)) == 8 + 9
    assert grid.find((1, 0), (1, 8), max_cost=17).status == "found"
    stopped = grid.find((1, 0), (1, 8), max_cost=16.9)
    assert (stopped.status, stopped.stopped_by) == ("stopped", "cost")
    assert grid.path((1, 0), [(1, 8), (1, 3)]).tolist() == [[1, 0], [1, 3]]
    shut = grid.edit_cells([(row, 6) for row in range(3)], True)
    assert shut.find((1, 0), (1, 8), nearest=True).status == "nearest"
    assert shut.find((1, 0), (1, 6), snap=True).status == "found"
    assert grid.find((1, 0), (1, 8), tolerance=5).path[-1].tolist() == [1, 3]
    numbers, costs_of = grid.prepare().nearest([(0, 0)], [(1, 8), (1, 1)])
    assert numbers.tolist() == [1] and costs_of == pytest.approx(math.sqrt(2))
    search = grid.prepare("dijkstra").search((1, 0), (1, 8), trace=True)
    while search.step(3) is None:
        assert search.lower_bound <= 17
    assert search.answer.cost == 17 and len(search.expanded()) > 9


@pytest.mark.parametrize("dtype", "i1 u1 <i2 >i2 <u2 <i4 >u4 <i8 <u8 f2 <f4 >f4 <f8 >f8 g".split())
def test_arrays_of_any_kind_are_read_as_they_are(rng, dtype):
    numbers = rng.integers(1, 100, size=(5, 8))
    blocked = rng.random((5, 8)) < 0.3
    wanted = mediant.Grid(blocked, costs=numbers.tolist())
    array = numbers.astype(dtype)
    wide = np.zeros((10, 16), dtype=dtype)
    wide[::2, ::-2] = array
    record = np.zeros((5, 8), dtype=[("x", "i1"), ("here", dtype)])
    record["here"] = array
    layouts = [array, np.asfortranarray(array), array[::-1, ::-1].copy()[::-1, ::-1], wide[::2, ::-2]]
    for costs in [*layouts, record["here"], np.ma.masked_array(array, mask=False)]:
        before = costs.tobytes()
        grid = mediant.Grid(blocked, costs=costs)
        assert grid == wanted and grid.id == wanted.id and costs.tobytes() == before
    array[blocked] = 0
    assert mediant.Grid(blocked, costs=array) == wanted
    assert np.array_equal(wanted.costs, np.where(blocked, np.nan, numbers), equal_nan=True)
    # All rows the same, without memory for each.
    row = np.broadcast_to(numbers[0].astype(dtype), (5, 8))
    assert mediant.Grid(blocked, costs=row) == mediant.Grid(blocked, costs=row.copy())


def test_walls_are_said_in_words(rng):
    """No data, masks and numbers that are none are walls where that is said."""
    costs = rng.uniform(1, 9, size=(6, 7)).astype("f4")
    walls = rng.random((6, 7)) < 0.3
    wanted = mediant.Grid(walls, costs=costs)

    def with_walls(value):
        return np.where(walls, costs.dtype.type(value), costs)

    assert mediant.Grid.from_costs(with_walls(-9999), nodata=-9999) == wanted
    assert mediant.Grid.from_costs(with_walls(0.1), nodata=0.1) == wanted  # As a number of 32 bits.
    for value in (np.nan, np.inf, 0):
        assert mediant.Grid.from_costs(with_walls(value), nodata=value) == wanted
    both = with_walls(-1)
    both[0, 0], walls[0, 0] = np.nan, True
    assert mediant.Grid.from_costs(both, nodata=[-1, np.nan]) == mediant.Grid(walls, costs=costs)
    masked = np.ma.masked_array(both, mask=walls)
    assert mediant.Grid.from_costs(masked) == mediant.Grid(walls, costs=costs)
    assert mediant.Grid.from_costs(np.ma.masked_array(costs, mask=False)).to_numpy().sum() == 0
    assert mediant.Grid.from_costs(costs.astype("u1"), nodata=3).costs.dtype == float
    assert mediant.Grid.from_costs(costs[None]) == mediant.Grid.from_costs(costs)  # One band.
    assert mediant.Grid(costs, above=5, costs=costs).to_numpy().sum() == (costs > 5).sum()
    for value in (np.nan, np.inf, -np.inf, 0, -3):
        bad = costs.copy()
        bad[2, 5] = value
        for make in (mediant.Grid.from_costs, lambda bad: mediant.Grid(np.zeros((6, 7), bool), costs=bad)):
            with pytest.raises(mediant.MapError, match=rf"\(2, 5\) is {value}.*nodata") as caught:
                make(bad)
            assert caught.value.code == "cost"


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda: mediant.Grid(np.ones((2, 2))), TypeError, "costs=.*from_costs.*above="),
        (lambda: mediant.Grid([[False]], costs=[[1, 2]]), mediant.ArgumentError, r"costs: .*1 . 1.*\[1, 2\]"),
        (lambda: mediant.Grid([[False]], costs=[[True]]), TypeError, "costs: expected numbers, found bool"),
        (lambda: mediant.Grid([[False]], costs=[["a"]]), TypeError, "costs: expected numbers"),
        (lambda: mediant.Grid([[False]], costs=3), mediant.ArgumentError, "costs"),
        (lambda: mediant.Grid([[False]], cell_size=3), mediant.ArgumentError, "cell_size.*costs="),
        (lambda: mediant.Grid.from_costs([[True]]), TypeError, "costs: .*Grid"),
        (lambda: mediant.Grid.from_costs([1, 2]), mediant.ArgumentError, "costs: .*rows and columns"),
        (lambda: mediant.Grid.from_costs([[1], [1, 2]]), mediant.ArgumentError, "costs: .*same length"),
        (lambda: mediant.Grid.from_costs([[1e-9, 1]]), mediant.MapError, "costs: .*65,536"),
        (lambda: mediant.Grid.from_costs([[1]], nodata="x"), TypeError, "nodata"),
        (lambda: mediant.Grid.from_costs([[1]], transform=3), TypeError, "transform"),
        (
            lambda: mediant.Grid.from_costs([[1]], transform=(1, 2, 3, 4, 5, 6)),
            mediant.ArgumentError,
            "turns",
        ),
        (
            lambda: mediant.Grid.from_costs([[1]], cell_size=1, transform=(1, 0, 3, 0, -5, 6)),
            mediant.ArgumentError,
            "cell_size",
        ),
    ],
)
def test_mistakes_say_what_to_do(make, error, words):
    with pytest.raises(error, match=words):
        make()


@pytest.mark.parametrize("size", [0, -1, np.nan, np.inf, (1,), (1, 2, 3), (1, 1e9), "x", (1, "x"), object()])
def test_odd_sizes_of_cells(size):
    with pytest.raises((mediant.ArgumentError, TypeError), match="cell_size"):
        mediant.Grid.from_costs([[1.0]], cell_size=size)


def test_grids_are_values(rng):
    """Equal, hashed, pickled and copied by their cells, costs and sizes, also after edits."""
    for _ in range(12):
        blocked, costs = random_costs(rng, 7, 9)
        grid = mediant.Grid(blocked, costs=costs, cell_size=(3, 2), resolution=0.5, origin=(1, 2))
        free = np.argwhere(~blocked)
        edited = grid.edit_costs(free[0], 1.5 * costs.max()).edit_costs(free[0], costs[tuple(free[0])])
        for one in (grid, edited, grid.edit_cells(free[:3], True)):
            for again in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
                assert again == one and hash(again) == hash(one) and again.id == one.id
                assert again.cell_size == (3.0, 2.0) and again.world.origin == one.world.origin
                assert np.array_equal(again.costs, one.costs, equal_nan=True) and repr(again) == repr(one)
        other = mediant.Grid(blocked, costs=costs, cell_size=(2, 3), resolution=0.5, origin=(1, 2))
        assert grid != other and grid.id != other.id and grid != mediant.Grid(blocked)
        assert np.array_equal(grid.to_numpy(), blocked) and np.array_equal(np.asarray(grid), blocked)
        index = pickle.loads(pickle.dumps(grid.prepare()))
        assert index.grid == grid and index.distance(free[0], free[-1]) == grid.distance(free[0], free[-1])
    assert grid._repr_png_().startswith(b"\x89PNG") and grid.has_costs and not mediant.Grid(blocked).has_costs
    assert mediant.Grid(blocked).costs is None and mediant.Grid(blocked).cell_size == (1.0, 1.0)
    state = pickle.loads(pickle.dumps(mediant.Grid(np.array([[True]])))).__reduce__()
    assert state[0](*state[1]).has_costs is False
    make, (steps, *rest) = grid.__reduce__()
    for wrong in (steps[:-1], b"\xff" * len(steps)):
        with pytest.raises(mediant.MediantError):
            make(wrong, *rest)


def test_edits(rng):
    """Cells are blocked, freed and given other costs; indexes follow; each is as one made anew."""
    blocked, costs = random_costs(rng, 9, 14)
    costs = costs.astype(float)
    grid = mediant.Grid(blocked, costs=costs)
    index = grid.prepare(k=4)
    for step in range(30):
        cells = np.stack([rng.integers(9, size=4), rng.integers(14, size=4)], axis=1)
        if step % 3 == 0:
            grid = grid.edit_cells(cells, True)
            blocked[tuple(cells.T)] = True
        elif step % 3 == 1:
            row, column = cells[0]
            patch = blocked[row : row + 2, column : column + 3] | (rng.random() < 0.5)
            grid = grid.edit((row, column), patch)
            blocked[row : row + 2, column : column + 3] = patch
        else:
            new = rng.uniform(0.2, 9, size=4)
            grid = grid.edit_costs(cells, new)
            for cell, cost in zip(cells, new):
                costs[tuple(cell)], blocked[tuple(cell)] = cost, False
        assert np.array_equal(grid.to_numpy(), blocked)
        index = index.repair(grid)
        assert index.grid == grid
        free = np.argwhere(~blocked)
        if len(free) < 2:
            continue
        fresh = mediant.Grid(blocked, costs=costs)
        for start, goal in rng.choice(free, size=(5, 2)):
            wanted = fresh.distance(start, goal, k=4)
            assert near([index.distance(start, goal), grid.distance(start, goal, k=4)], [wanted, wanted])
    assert grid.edit_costs(np.zeros((0, 2), dtype=int), []) == grid
    assert grid.edit_costs([(0, 0), (0, 0)], [3, 2]).costs[0, 0] == pytest.approx(2)
    shut = grid.edit_cells((0, 0), True)
    with pytest.raises(mediant.MapError, match=r"\(0, 0\) is freed.*edit_costs"):
        shut.edit_cells((0, 0), False)
    with pytest.raises(mediant.MapError, match=r"\(0, 0\) is freed.*edit_costs"):
        shut.edit((0, 0), [[False]])
    for bad in (0, -1, np.nan, np.inf):
        with pytest.raises(mediant.MapError, match=r"\(2, 1\)"):
            grid.edit_costs((2, 1), bad)
    with pytest.raises(mediant.ArgumentError, match="costs"):
        grid.edit_costs([(0, 0), (1, 1)], [1, 2, 3])
    with pytest.raises(TypeError, match="costs"):
        grid.edit_costs((0, 0), "x")
    with pytest.raises(mediant.MapError, match="outside"):
        grid.edit_costs((9, 0), 1)
    with pytest.raises(mediant.MapError, match=r"no costs.*costs="):
        mediant.Grid(blocked).edit_costs((0, 0), 1)


def test_agents_of_a_size(rng):
    costs = rng.integers(1, 9, size=(9, 12))
    blocked = np.zeros((9, 12), dtype=bool)
    blocked[4, 6] = True
    grid = mediant.Grid(blocked, costs=costs)
    disc = grid.for_disc(1.2, outside="open")
    where = mediant.Grid(blocked).for_disc(1.2, outside="open").to_numpy()
    assert disc == grid.edit_cells(np.argwhere(where), True) and where.sum() > 1
    assert np.array_equal(grid.clearance(), mediant.Grid(blocked).clearance())


def test_what_there_is_not_on_costs_is_refused():
    grid = mediant.Grid.from_costs(np.ones((3, 4)))
    index, ends = grid.prepare(), ((0, 0), (2, 3))
    for call in [
        lambda: grid.widest_path(*ends, surplus=0.1),
        lambda: grid.disc(1.0),
        lambda: grid.for_square(2),
        lambda: grid.path(*ends, smooth="taut"),
        lambda: grid.path(*ends, engine="jps"),
        lambda: grid.path(*ends, k="any"),
        lambda: grid.path(*ends, k=9),
        lambda: index.find_except(*ends, blocked=[(1, 1)]),
    ]:
        with pytest.raises(mediant.OptionError, match="costs"):
            call()
    with pytest.raises(TypeError, match=r"weights.*costs=.*from_costs"):
        grid.path(*ends, weights=np.ones((3, 4)))
    with pytest.raises(TypeError, match="edit_costs"):
        grid.edit((0, 0), [[2.5]])


def test_traces_and_pictures_of_costs(tmp_path):
    grid = mediant.Grid.from_costs([[1.0, 2.0], [3.0, 4.0]])
    search = grid.prepare("astar").search((0, 0), (1, 1), trace=True)
    search.finish()
    search.write_trace(tmp_path / "costs.json")
    assert json.loads((tmp_path / "costs.json").read_text())["events"]
    assert grid.field((0, 0))._repr_png_().startswith(b"\x89PNG")
