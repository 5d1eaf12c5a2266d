"""`mediant.compat` beside the libraries that its calls stand in for: the same results, the same errors."""

from __future__ import annotations

import inspect
import math
import random

import mediant
import numpy as np
import pytest
from mediant import compat

SEED = 20261122
CASES = 4000


@pytest.fixture
def skimage():
    return pytest.importorskip("skimage.graph", reason="scikit-image is not installed").route_through_array


@pytest.fixture
def pyastar2d():
    return pytest.importorskip("pyastar2d", reason="pyastar2d is not installed")


def outcome(call, *arguments, **options):
    """The outcome of a call: ("returned", its result), or ("raised", its kind, its text)."""
    try:
        return ("returned", call(*arguments, **options))
    except Exception as error:
        return ("raised", type(error), str(error))


def legal(cells, passable, diagonal):
    """Whether each cell but the first is passable, and next to the one before it."""
    steps = np.abs(np.diff(np.asarray(cells).reshape(-1, 2), axis=0))
    near = (
        (steps.max(axis=1) == 1) & (diagonal | (steps.sum(axis=1) == 1)) if len(steps) else np.array([True])
    )
    return bool(near.all()) and all(passable[tuple(cell)] for cell in cells[1:])


def shape_of(rng):
    return (rng.randint(1, 12), rng.randint(1, 12))


def cell_of(rng, shape, low=0, beyond=0):
    return tuple(rng.randint(-n if low else 0, n - 1 + (rng.random() < 0.04) * beyond) for n in shape)


# --- skimage.graph.route_through_array


def costs_of(rng):
    """An array whose passable cells cost the same, of any kind of number."""
    shape = shape_of(rng)
    blocked = np.array([[rng.random() < 0.25 for _ in range(shape[1])] for _ in range(shape[0])])
    if rng.random() < 0.1:
        return (
            np.ones(shape, bool)
            if rng.random() < 0.3
            else np.where(blocked, -1, 3).astype(rng.choice("bhiq"))
        )
    cost = rng.choice([1.0, 1.0, 0.25, 7.3, 0.0, 1e-200, 6e307, 1e308])
    walls = rng.choice([[np.inf], [-1.0], [-np.inf, np.inf, -3.5]])
    costs = np.where(blocked, [[rng.choice(walls) for _ in range(shape[1])] for _ in range(shape[0])], cost)
    kind = np.float32 if cost in (1.0, 0.25) and rng.random() < 0.3 else np.float64
    costs = costs.astype(kind, order=rng.choice("CF"))
    return costs.tolist() if rng.random() < 0.1 else costs


def assert_same_route(theirs, ours, costs, diagonal, note, tolerance=1e-12):
    assert ours[0] == theirs[0], note
    if ours[0] == "raised":
        assert ours[1:] == theirs[1:], note
        return
    (cells, cost), (their_cells, their_cost) = ours[1], theirs[1]
    assert cells[0] == their_cells[0] and cells[-1] == their_cells[-1], note
    assert type(cells) is list and {type(x) for cell in cells for x in (cell, *cell)} == {tuple, int}, note
    assert type(cost) is type(their_cost) is np.float64, note
    assert math.isclose(cost, their_cost, rel_tol=tolerance, abs_tol=1e-300), note
    assert legal(cells, (np.asarray(costs) >= 0) & (np.asarray(costs) < np.inf), diagonal), note


def cost_at(costs, cell):
    """The cost of a cell, or NaN outside the array."""
    costs = np.asarray(costs)
    return costs[cell] if all(-n <= i < n for i, n in zip(cell, costs.shape)) else math.nan


def test_routes_are_those_of_skimage(skimage):
    rng = random.Random(SEED)
    found = refused = 0
    for number in range(CASES):
        costs = costs_of(rng)
        start, end = (cell_of(rng, np.shape(costs), low=1, beyond=3) for _ in range(2))
        diagonal, geometric = rng.random() < 0.7, rng.random() < 0.6
        arguments = (costs, start, end, diagonal, geometric)
        note = f"seed {SEED}, case {number}: {arguments}"
        ours = outcome(compat.route_through_array, *arguments)
        cost = cost_at(costs, start)
        if ours[0] == "raised" and ours[1] is mediant.OptionError:
            assert cost < 0, note
            refused += 1
        elif cost == -np.inf or (cost == np.inf and not geometric):
            # skimage reads beyond its memory: its heap takes an infinite cost for an empty place.
            assert ours[:2] == ("raised", ValueError) or len(ours[1][0]) == 1, note
        else:
            assert_same_route(outcome(skimage, *arguments), ours, costs, diagonal, note)
            found += ours[0] == "returned" and len(ours[1][0]) > 2
    assert found > CASES / 4 and 0 < refused < CASES / 8


def test_costs_that_differ_are_refused_or_answered_alike(skimage):
    rng = random.Random(SEED + 1)
    refused = found = 0
    for number in range(CASES // 2):
        costs = several_costs_of(rng)
        start, end = cell_of(rng, costs.shape), cell_of(rng, costs.shape)
        arguments = (costs, start, end, rng.random() < 0.6, rng.random() < 0.6)
        note = f"seed {SEED + 1}, case {number}: {arguments}"
        ours = outcome(compat.route_through_array, *arguments)
        passable = costs[(costs >= 0) & (costs < np.inf)]
        if ours[0] == "raised" and ours[1] is mediant.OptionError:
            is_odd = np.isnan(costs).any() or not passable.all() or costs[start] < 0
            assert is_odd or (arguments[3:] == (True, False) and len(np.unique(passable)) > 1), note
            refused += 1
        elif costs[start] >= 0 and costs[start] < np.inf and not np.isnan(costs).any():
            # Costs are exact to 2**-32 of the greatest, so of two routes that differ by less it takes either.
            assert_same_route(outcome(skimage, *arguments), ours, costs, arguments[3], note, 1e-8)
            found += ours[0] == "returned" and len(ours[1][0]) > 2
    assert refused > CASES / 20 and found > CASES / 10


def several_costs_of(rng):
    """Costs of which some are several, some infinite, some zero or no number."""
    shape = shape_of(rng)
    kinds = [1.0, 2.0, 9.5, rng.uniform(0.1, 20), np.inf, -1.0, 0.0, np.nan][
        : rng.choice([2, 4, 5, 6, 6, 7, 8])
    ]
    costs = np.array([[rng.choice(kinds) for _ in range(shape[1])] for _ in range(shape[0])])
    if rng.random() < 0.3:
        noise = np.array([[rng.uniform(0.5, 2) for _ in range(shape[1])] for _ in range(shape[0])])
        costs = costs * noise
    return costs.astype(np.float64, order=rng.choice("CF"))


def test_fields_are_those_of_skimage():
    """Costs, offsets and paths of `MCP_Geometric`: with cells of any size, several starts, and ends."""
    theirs_of = pytest.importorskip("skimage.graph", reason="scikit-image is not installed").MCP_Geometric
    is_new = "max_step_cost" in inspect.signature(theirs_of.find_costs).parameters  # Since 0.26.
    rng = random.Random(SEED + 3)
    checked = reached = limited = 0
    for number in range(CASES // 8):
        costs = np.abs(several_costs_of(rng))
        costs[np.isnan(costs) | (costs == 0)] = rng.choice([np.inf, -1])
        starts = [cell_of(rng, costs.shape, low=1) for _ in range(rng.randint(1, 3))]
        if not all(0 < costs[start] < np.inf for start in starts):
            continue
        diagonal, sampling = rng.random() < 0.7, rng.choice([None, (2, 3), (0.5, 0.5)])
        note = f"seed {SEED + 3}, case {number}: {costs}, {starts}, {diagonal}, {sampling}"
        theirs = theirs_of(costs, fully_connected=diagonal, sampling=sampling)
        ours = compat.MCP_Geometric(costs, fully_connected=diagonal, sampling=sampling)
        assert np.array_equal(ours.offsets, theirs.offsets), note
        (wanted, their_numbers), (found, numbers) = theirs.find_costs(starts), ours.find_costs(starts)
        assert found.dtype == wanted.dtype and numbers.dtype == their_numbers.dtype, note
        assert np.allclose(found, wanted, rtol=1e-8, atol=0), note
        assert np.array_equal(numbers < 0, their_numbers < 0), note
        assert np.array_equal(numbers[numbers < 0], their_numbers[numbers < 0]), note
        for end in zip(*np.nonzero(np.isfinite(found))):
            cells = ours.traceback(end)
            assert legal(cells, (costs > 0) & (costs < np.inf), diagonal) and cells[-1] == end, note
            assert numbers[cells[0]] == -1 and (len(cells) == 1) == (numbers[end] == -1), note
            if len(cells) > 1:
                assert tuple(ours.offsets[numbers[end]]) == tuple(np.subtract(cells[-1], cells[-2])), note
            reached += 1
        blocked = np.argwhere(np.isinf(found))
        if len(blocked):
            theirs_, ours_ = (outcome(mcp.traceback, blocked[0]) for mcp in (theirs, ours))
            assert theirs_ == ours_, note
        ends = [cell_of(rng, costs.shape, low=1) for _ in range(rng.randint(1, 3))]
        is_all, limit = rng.random() < 0.5, rng.choice([None, 2.0, 9.5, rng.uniform(0, 20), 0, -1.0])
        name = rng.choice(["max_cost", "max_step_cost"])
        their_name = "max_step_cost" if is_new else "max_cost"
        wanted, _ = theirs.find_costs(starts, ends, is_all, **{their_name: limit})
        found, numbers = ours.find_costs(starts, ends, is_all, **{name: limit})
        note = f"{note}, {ends}, {is_all}, {name}: {limit}"
        both = np.isfinite(found) & np.isfinite(wanted)
        assert np.allclose(found[both], wanted[both], rtol=1e-8, atol=0), note
        # Of cells that cost as much as the last end, they take those that come first.
        last = wanted[np.isfinite(wanted)].max()
        assert not (np.isfinite(wanted) & ~np.isfinite(found)).any(), note
        assert np.all(np.isclose(found[np.isfinite(found) & ~np.isfinite(wanted)], last, rtol=1e-8)), note
        assert np.isfinite(found).sum() == (numbers > -2).sum(), note
        limited += limit is not None and 1 < both.sum() < costs.size / 2
        checked += 1
    assert checked > CASES / 32 and reached > CASES and limited > CASES / 200


@pytest.mark.parametrize("starts", [[], [(9, 9)], [(0, 1)]], ids=str)
def test_odd_starts_are_taken_as_by_skimage(starts):
    theirs_of = pytest.importorskip("skimage.graph", reason="scikit-image is not installed").MCP_Geometric
    costs = np.array([[1.0, np.inf, 2.0]])
    ours = outcome(compat.MCP_Geometric(costs).find_costs, starts)
    assert ours[:2] == ("raised", ValueError)
    if starts != [(0, 1)]:  # Of an infinite start, skimage's heap makes what it likes.
        assert outcome(theirs_of(costs).find_costs, starts) == ours


OFFSETS = [
    [(0, 1), (1, 0), (0, -1), (-1, 0)],
    np.array([(-1, 1), (0, 1), (1, 0), (1, 1), (0, -1), (-1, 0), (1, -1), (-1, -1)]),
]


@pytest.mark.parametrize("offsets", OFFSETS, ids=len)
def test_offsets_of_neighbors_are_taken_in_any_order(offsets):
    theirs_of = pytest.importorskip("skimage.graph", reason="scikit-image is not installed").MCP_Geometric
    costs = np.random.default_rng(SEED).uniform(1, 9, (9, 12))
    theirs, ours = theirs_of(costs, offsets), compat.MCP_Geometric(costs, offsets)
    assert np.array_equal(ours.offsets, theirs.offsets)
    (wanted, their_numbers), (found, numbers) = theirs.find_costs([(4, 4)]), ours.find_costs([(4, 4)])
    assert np.allclose(found, wanted, rtol=1e-8, atol=0) and np.array_equal(numbers, their_numbers)


@pytest.mark.parametrize("sampling", [(1,), (1, 2, 3), 2, np.array([2, 3]), "ab"], ids=str)
def test_odd_samplings_are_refused_as_by_skimage(sampling):
    theirs_of = pytest.importorskip("skimage.graph", reason="scikit-image is not installed").MCP_Geometric
    both = (theirs_of, compat.MCP_Geometric)
    theirs, ours = (outcome(of, np.ones((2, 3)), None, True, sampling) for of in both)
    assert ours == theirs and ours[:2] == ("raised", ValueError)


def test_what_only_their_fields_have_is_named():
    for costs, how in [
        ([[1.0, 0.0]], {}),
        ([[1.0, np.nan]], {}),
        ([1.0, 2.0], {}),
        ([[1.0, 2e9, 1.5]], {}),
        ([[1.0, 2.0]], {"offsets": [(0, 1)]}),
        ([[1.0, 2.0]], {"offsets": [(1, 2), (2, 1)]}),
        ([[1.0, 2.0]], {"sampling": (0, 1)}),
        ([[1.0, 2.0]], {"sampling": (1, math.nan)}),
    ]:
        with pytest.raises(mediant.OptionError):
            compat.MCP_Geometric(costs, **how)
    mcp = compat.MCP_Geometric([[1.0, -2.0]])
    with pytest.raises(mediant.OptionError, match="negative"):
        mcp.find_costs([(0, 1)])
    with pytest.raises(Exception, match="find_costs"):
        mcp.traceback((0, 0))
    for how in ({"max_coverage": 0.5}, {"max_coverage": math.nan}, {"max_cumulative_cost": 3}):
        with pytest.raises(mediant.OptionError, match=next(iter(how))):
            mcp.find_costs([(0, 0)], **how)
    with pytest.raises(ValueError, match="max_step_cost"):
        mcp.find_costs([(0, 0)], max_cost=3, max_step_cost=3)
    with pytest.raises(TypeError, match="goal_reached"):
        type("Watched", (compat.MCP_Geometric,), {"goal_reached": lambda *_: 2})


ODD_ENDS = [
    ((0, 0), (3, 0)), ((0, 4), (0, 0)), ((-4, 0), (0, 0)), ((0,), (0, 0)), ((0, 0), (0,)),
    ((0, 0, 0), (0, 0)), ((0.9, -0.5), (2, 3)), ((0, 0), (1.0, 2)), ((0, 0), (1, 2.5)), (("1", "2"), (2, 3)),
    (("a", 0), (1, 1)), (("a",), (1, 1)), ((9, "a"), (1, 1)), ((None, 0), (1, 1)), ((np.nan, 0), (1, 1)),
    ((np.inf, 0), (1, 1)),
    ((0, 0), (0, 1 + 0j)), ((0, 0), ("1", "1")), (5, (1, 1)), ((0, 0), 5), ((0, 9), (0, 9, 9)),
    ((0, 0), (0, 9.5)), (np.array([0, 0.0]), np.array([1, 2.0])), (np.array([0, 0]), np.array([2, 2])),
    ([0, 0], [2, np.uint8(2)]), ((1, 1), (1, 1)), ((1, 1), (1.0, 1.0)), ((0, 0), (1, 1)),
    ((), ()), ((0, 0), ()),
]  # fmt: skip


@pytest.mark.parametrize(("start", "end"), ODD_ENDS, ids=str)
@pytest.mark.parametrize("geometric", [True, False])
def test_odd_ends_are_taken_as_by_skimage(skimage, start, end, geometric):
    costs = np.ones((3, 4))
    costs[1, 1] = np.inf if geometric else -1  # Of an infinite start, skimage's heap makes what it likes.
    theirs = outcome(skimage, costs, start, end, geometric=geometric)
    ours = outcome(compat.route_through_array, costs, start, end, geometric=geometric)
    assert_same_route(theirs, ours, costs, True, (start, end))


@pytest.mark.parametrize(
    "costs", [np.ones((2, 2)) * 1j, np.ones((2, 2), object), "ab", np.zeros((0, 3))], ids=str
)
def test_odd_arrays_are_refused_as_by_skimage(skimage, costs):
    theirs = outcome(skimage, costs, (0, 0), (1, 1))
    assert theirs[0] == "raised"
    assert outcome(compat.route_through_array, costs, (0, 0), (1, 1)) == theirs


@pytest.mark.parametrize(
    ("costs", "start", "code"),
    [
        ([[1.0, 0.0, 2.0]], (0, 0), "not-supported"),
        ([[1.0, 1e9, 2.5]], (0, 0), "not-supported"),
        ([[1.0, math.nan, 1.0]], (0, 0), "not-uniform"),
        ([[-1.0, 2.0]], (0, 0), "not-supported"),
        ([[[1.0, 1.0]]], (0, 0, 0), "not-supported"),
    ],
)
def test_what_is_theirs_only_is_named(costs, start, code):
    with pytest.raises(mediant.OptionError) as caught:
        compat.route_through_array(costs, start, np.array(np.shape(costs)) - 1)
    assert caught.value.code == code


def test_booleans_are_no_end():
    with pytest.raises(mediant.OptionError):
        compat.route_through_array(np.ones((3, 3)), (0, 0), (True, True))


# --- pyastar2d.astar_path


def weights_of(rng):
    shape = shape_of(rng)
    weight = np.float32(rng.choice([1, 1, 1.1, 2.5, 3e37, 3e38]))
    blocked = np.array([[rng.random() < 0.25 for _ in range(shape[1])] for _ in range(shape[0])])
    return np.where(blocked, np.float32(np.inf), weight).astype(np.float32, order=rng.choice("CF"))


def assert_same_path(theirs, ours, weights, diagonal, note):
    assert ours[0] == theirs[0], note
    if ours[0] == "raised":
        assert ours[1:] == theirs[1:], note
    elif theirs[1] is None:
        assert ours[1] is None, note
    else:
        path, their_path = ours[1], theirs[1]
        assert path.dtype == their_path.dtype == np.int32 and path.shape == their_path.shape, note
        assert (path[[0, -1]] == their_path[[0, -1]]).all(), note
        assert legal(path, weights < np.inf, diagonal), note


def test_paths_are_those_of_pyastar2d(pyastar2d):
    rng = random.Random(SEED + 2)
    found = none = 0
    for number in range(CASES):
        weights = weights_of(rng)
        start, goal = (cell_of(rng, weights.shape, low=rng.random() < 0.05, beyond=3) for _ in range(2))
        if rng.random() < 0.1 and min(start) >= 0 and (np.array(start) < weights.shape).all():
            weights[start] = 55  # The start is never entered: its weight does not count.
        diagonal = rng.random() < 0.6
        arguments = (weights, start, goal, diagonal)
        note = f"seed {SEED + 2}, case {number}: {arguments}"
        theirs, ours = outcome(pyastar2d.astar_path, *arguments), outcome(compat.astar_path, *arguments)
        if ours[0] == "raised" and ours[1] is mediant.OptionError:
            assert start == goal or weights[goal] != weights[np.isfinite(weights)].min(), note
            continue
        assert_same_path(theirs, ours, weights, diagonal, note)
        found += ours[0] == "returned" and ours[1] is not None and len(ours[1]) > 2
        none += ours[0] == "returned" and ours[1] is None
    assert found > CASES / 4 and none > CASES / 10


ODD_CALLS = [
    (np.ones((3, 4)), (0, 0), (1, 1)),
    (np.ones((3, 4), int), (0, 0), (1, 1)),
    (np.full((3, 4), 0.5, np.float32), (0, 0), (1, 1)),
    (np.ones((3, 4), np.float32), (3, 0), (1, 1)),
    (np.ones((3, 4), np.float32), (0, 0), (1, -1)),
    (np.ones((3, 4), np.float32), (0.0, 1), (1, 1)),
    (np.ones((3, 4), np.float32), (0, 1), (1, 1.0)),
    (np.ones((3, 4), np.float32), (0, 1, 2), (1, 1)),
    (np.ones((3, 4), np.float32), (0,), (1, 1)),
    (np.ones((3, 4), np.float32), [0, 1], [1, 1]),
    (np.ones((3, 4), np.float32), np.array([0, 1]), np.array([2, 3])),
    (np.ones(4, np.float32), (0, 1), (1, 1)),
    (np.ones((2, 3, 4), np.float32), (0, 1), (1, 1)),
    (np.ones((0, 4), np.float32), (0, 1), (1, 1)),
    (np.ones((3, 4), np.float32), (0, 1), 5),
]


@pytest.mark.parametrize(("weights", "start", "goal"), ODD_CALLS)
def test_odd_calls_are_taken_as_by_pyastar2d(pyastar2d, weights, start, goal):
    theirs = outcome(pyastar2d.astar_path, weights, start, goal)
    assert_same_path(theirs, outcome(compat.astar_path, weights, start, goal), weights, False, theirs)


@pytest.fixture
def two_ways():
    """A map with a zigzag of 12 diagonal steps, and a shorter way around it of 16 steps."""
    rows = [" ........... ", ".           .", ".           .", ". . . . . . .", " . . . . . . "]
    return np.array([[cell == "." for cell in row] for row in rows])


def test_fewest_steps_are_not_the_shortest_path(skimage, pyastar2d, two_ways):
    costs = np.where(two_ways, 1, np.inf).astype(np.float32)
    assert len(mediant.Grid(~two_ways).path((3, 0), (3, 12), corners="always", points="vertices")) == 17
    for route in (skimage, compat.route_through_array):
        cells, cost = route(costs, (3, 0), (3, 12), geometric=False)
        assert len(cells) == cost == 13
        cells, cost = route(costs, (3, 0), (3, 12))
        assert len(cells) == 17 and math.isclose(cost, 14 + 2 * math.sqrt(2))
    for path in (pyastar2d.astar_path, compat.astar_path):
        assert len(path(costs, (3, 0), (3, 12), True)) == 13


@pytest.mark.parametrize("heuristic", [1, 2])
def test_heuristics_that_do_not_find_shortest_paths_are_refused(pyastar2d, heuristic):
    assert compat.Heuristic(heuristic).name == pyastar2d.Heuristic(heuristic).name
    with pytest.raises(mediant.OptionError):
        compat.astar_path(np.ones((2, 2), np.float32), (0, 0), (1, 1), heuristic_override=heuristic)


@pytest.mark.parametrize("bad", [2.0, math.nan])
def test_weights_that_differ_are_refused(bad):
    weights = np.ones((2, 3), np.float32)
    weights[1, 2] = bad
    with pytest.raises(mediant.OptionError):
        compat.astar_path(weights, (0, 0), (0, 2))
