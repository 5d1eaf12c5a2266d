"""Paths and distances of all engines, held to shortest paths on explicit graphs."""

from __future__ import annotations

import itertools
import math
from collections import Counter

import mediant
import numpy as np
import pytest
import slow

KS = (2, 3, 4, 5, "any")
OPTIMAL = {"astar", "dijkstra", "canonical", "jps", "jps-block", "jps-plus", "anya", "subgoal", "landmarks"}
# The number of pairs of one of `KS` and one of the five rules that each engine takes.
TAKES = {
    "astar": 20,
    "dijkstra": 20,
    "wavefront": 20,
    "canonical": 20,
    "jps": 20,
    "jps-block": 10,
    "jps-plus": 10,
    "theta": 20,
    "lazy-theta": 20,
    "anya": 10,
    "subgoal": 14,
    "subgoal-theta": 8,
    "hpa": 4,
    "chpa": 4,
    "landmarks": 20,
}
ANY_ANGLE = {"theta", "lazy-theta", "subgoal-theta"}


def prepared(grid, engine, k, rule):
    """The index, or None if the engine does not take the motion."""
    try:
        return grid.prepare(engine, k=k, **slow.motion(rule))
    except mediant.OptionError:
        return None


def queries(rng, oracle, count):
    free = [at for at in oracle.vertices() if oracle.is_free(at)]
    return [tuple(free[i] for i in rng.integers(len(free), size=2)) for _ in range(count)]


@pytest.mark.parametrize("trial", range(4))
def test_all_engines(rng, trial):
    """Each engine under each motion that it takes: shortest, or legal and not shorter."""
    rows, columns = [(9, 15), (14, 6), (7, 21), (12, 11)][trial]
    blocked = slow.random_map(rng, rows, columns, [0.15, 0.3, 0.4, 0.3][trial])
    grid, taken, found = mediant.Grid(blocked), Counter(), Counter()
    for rule in slow.RULES:
        oracle = slow.Slow(blocked, rule)
        asked = queries(rng, oracle, 25)
        sources = sorted({start for start, _ in asked})
        any_angle = oracle.distances("any", sources)
        for k in KS if oracle.at_corners else KS[:-1]:
            wanted = oracle.distances(k, sources)
            for engine in TAKES:
                index = prepared(grid, engine, k, rule)
                if index is None:
                    continue
                taken[engine] += 1
                for start, goal in asked:
                    at = (sources.index(start), *goal)
                    check_query(index, oracle, (start, goal), (wanted[at], any_angle[at]))
                    found[bool(np.isfinite(wanted[at]))] += 1
    assert taken == TAKES
    assert found[True] > 500
    assert found[False] > (0 if trial else -1)


def check_query(index, oracle, query, distances):
    """One query of one engine."""
    (wanted, any_angle), (engine, k) = distances, (index.engine, index.k)
    where = (engine, k, oracle.name, query, oracle.blocked.astype(int).tolist())
    path, distance = index.path(*query), index.distance(*query)
    # At k = 2 where corners are always cut, segments connect more than moves.
    nearest = any_angle if engine in ANY_ANGLE else wanted
    assert (path is None) == math.isinf(nearest) == math.isinf(distance), where
    if path is None:
        return
    assert path.dtype == np.int32, where
    assert path.shape[1:] == (2,), where
    assert (tuple(path[0]), tuple(path[-1])) == query, where
    assert distance == pytest.approx(slow.length(path), abs=1e-9), where
    fault = oracle.is_path(path if query[0] != query[1] else path[:1], "any" if engine in ANY_ANGLE else k)
    assert fault is None, (fault, path.tolist(), *where)
    if engine in OPTIMAL or (engine == "wavefront" and k == 2):
        assert distance == pytest.approx(wanted, abs=1e-7), where
    else:
        assert distance > nearest - 1e-7, where


@pytest.mark.parametrize("rule", slow.RULES)
def test_points(rng, rule):
    """The three kinds of points of a path."""
    blocked = slow.random_map(rng, 11, 17, 0.2)
    grid, oracle = mediant.Grid(blocked), slow.Slow(blocked, rule)
    for k in (2, 3, 4, 5):
        for start, goal in queries(rng, oracle, 20):
            how = {"k": k, **slow.motion(rule)}
            path = grid.path(start, goal, **how)
            if path is None:
                continue
            assert np.array_equal(path, grid.path(start, goal, points="waypoints", **how))
            vertices = grid.path(start, goal, points="vertices", **how)
            assert all(tuple(d) in slow.moves(k) for d in np.diff(vertices, axis=0).tolist())
            bends = [0, *bends_of(vertices), len(vertices) - 1]
            assert np.array_equal(vertices[sorted(set(bends))], path)
            assert grid.path(start, goal, points="touched", **how).tolist() == cells_of(oracle, path)


def bends_of(vertices):
    d = np.diff(vertices, axis=0)
    return [i + 1 for i in range(len(d) - 1) if not np.array_equal(d[i], d[i + 1])]


def cells_of(oracle, path):
    """The cells that a path touches, sorted as the package says: by when it touches them."""
    result = []
    for a, b in zip(path.tolist(), path.tolist()[1:]):
        d = (b[0] - a[0], b[1] - a[1])
        entered, beside, _ = slow.footprint(oracle.placement, *d)
        cells = set(entered) | set(itertools.chain.from_iterable(beside))
        result.append({(a[0] + i, a[1] + j) for i, j in cells})
    if oracle.at_corners:
        return AllCells(set().union(*result))
    return CellRuns(result, None if len(path) > 1 else [path[0].tolist()])


class AllCells:
    """A set of cells, for a path that may come back to one."""

    def __init__(self, cells):
        self.cells = cells

    def __eq__(self, cells):
        cells = [tuple(cell) for cell in cells]
        assert all(a != b for a, b in zip(cells, cells[1:])), "no cell comes twice in a row"
        return set(cells) == self.cells

    __hash__ = None


class CellRuns:
    """Sets of cells, one for each segment, whose order does not matter."""

    def __init__(self, runs, alone):
        self.runs, self.alone = runs, alone

    def __eq__(self, cells):
        if self.alone is not None:
            return cells == self.alone
        cells, at = [tuple(cell) for cell in cells], 0
        assert all(a != b for a, b in zip(cells, cells[1:])), "no cell comes twice in a row"
        for run in self.runs:
            # The first cell may be the last one of the segment before.
            shared = int(at > 0 and cells[at - 1] in run and cells[at : at + len(run)] != [])
            for overlap in (shared, 0):
                part = cells[at - overlap : at - overlap + len(run)]
                if set(part) == run:
                    at += len(run) - overlap
                    break
            else:
                return False
        return at == len(cells)

    __hash__ = None


@pytest.mark.parametrize("rule", slow.RULES)
def test_several_ends(rng, rule):
    """The shortest path from any start to any goal."""
    blocked = slow.random_map(rng, 8, 19, 0.3)
    grid, oracle = mediant.Grid(blocked), slow.Slow(blocked, rule)
    for k in (2, 3, 4):
        index = grid.prepare(k=k, **slow.motion(rule))
        for _ in range(15):
            starts, goals = zip(*queries(rng, oracle, 3))
            distances = oracle.distances(k, list(starts))
            wanted = min(distances[(i, *goal)] for i in range(3) for goal in goals)
            for ends in ((starts, goals), (np.array(starts), list(map(list, goals)))):
                assert grid.distance(*ends, k=k, **slow.motion(rule)) == pytest.approx(wanted, abs=1e-7)
                assert index.distance(*ends) == pytest.approx(wanted, abs=1e-7)
            path = index.path(starts, goals)
            if path is not None:
                assert tuple(path[0]) in starts and tuple(path[-1]) in goals


def test_tolerance(rng):
    """The shortest path to a vertex near the goal, which may be blocked."""
    blocked = slow.random_map(rng, 9, 16, 0.35)
    grid = mediant.Grid(blocked)
    for rule in slow.RULES[:4]:
        oracle = slow.Slow(blocked, rule)
        for (start, _), tolerance in itertools.product(queries(rng, oracle, 10), (1, 1.5, 3)):
            goal = tuple(int(rng.integers(side)) for side in oracle.shape)
            distances = oracle.distances(3, [start])[0]
            near = [at for at in oracle.vertices() if math.dist(at, goal) <= tolerance]
            wanted = min((distances[at] for at in near), default=math.inf)
            if not any(oracle.is_free(at) for at in near):
                continue
            found = grid.find(start, goal, tolerance=tolerance, k=3, **slow.motion(rule))
            assert found.distance == pytest.approx(wanted, abs=1e-7), (rule, start, goal, tolerance)
            if found.path is not None:
                assert math.dist(found.path[-1], goal) <= tolerance


def test_nearest_and_snap(rng):
    """The reachable vertex that is nearest by the distance on open ground; of several the shortest path."""
    blocked = slow.random_map(rng, 7, 22, 0.4)
    grid, oracle = mediant.Grid(blocked), slow.Slow(blocked, ("center", "never"))
    open_ground = slow.Slow(np.zeros((7, 22), dtype=bool), ("center", "never"))
    statuses = Counter()
    for k in (2, 3):
        for start, _ in queries(rng, oracle, 20):
            goal = tuple(int(rng.integers(side)) for side in oracle.shape)
            direct, distances = open_ground.distances(k, [goal])[0], oracle.distances(k, [start])[0]
            reached = [at for at in oracle.vertices() if np.isfinite(distances[at])]
            least = min(direct[at] for at in reached)
            wanted = min(distances[at] for at in reached if direct[at] < least + 1e-7)
            if oracle.is_free(goal):
                answer = grid.find(start, goal, nearest=True, k=k)
                assert answer.distance == pytest.approx(wanted, abs=1e-7), (
                    k,
                    start,
                    goal,
                    blocked.astype(int),
                )
                statuses[answer.status] += 1
                assert (answer.status == "found") == (least == 0)
            free = [at for at in oracle.vertices() if oracle.is_free(at)]
            moved = min(free, key=lambda at: (round(direct[at], 7), at))
            wanted = oracle.distances(k, [start])[0][moved]
            assert grid.distance(start, goal, snap=True, k=k) == pytest.approx(wanted, abs=1e-7)
    assert statuses["found"] and statuses["nearest"]


def test_snap_outside():
    grid = mediant.Grid.from_rows(["...", "..."])
    assert grid.path((-5, 1), (9, 30), snap=True).tolist()[0] == [0, 1]
    assert grid.path((-5, 1), (9, 30), snap=True).tolist()[-1] == [1, 2]


@pytest.mark.parametrize("engine", sorted(TAKES))
def test_limits(engine):
    """A limit raises LimitReached with the best path so far, and a bound that holds."""
    blocked = np.zeros((40, 70), dtype=bool)
    blocked[5:, 30] = True
    grid = mediant.Grid(blocked)
    index = grid.prepare(engine, k=3, placement=placement_of(engine))
    start, goal = (39, 3), (38, 66)
    whole = index.distance(start, goal)
    with pytest.raises(mediant.LimitReached) as caught:
        index.path(start, goal, max_cost=whole / 2)
    answer = caught.value.answer
    assert (caught.value.code, answer.status, answer.stopped_by) == ("stopped", "stopped", "cost")
    assert 0 <= answer.lower_bound <= whole + 1e-6
    assert math.isnan(answer.distance) and answer.path is None
    assert tuple(answer.best[0]) == start
    # An engine that guarantees nothing may miss a path that costs nearly as much as the limit.
    slack = 1 + 1e-6 if engine in OPTIMAL or engine == "wavefront" else 1.1
    assert index.path(start, goal, max_cost=whole * slack) is not None
    assert index.find(start, goal, max_cost=whole / 2).stopped_by == "cost"
    long = index.distance(start, goal, max_expansions=10**9, timeout=1e9)
    assert long == pytest.approx(whole, rel=1e-9)
    answer = index.find(start, goal, max_expansions=1)
    # Hub labels expand nothing.
    expected = ("found", None) if index.levels == "labels" else ("stopped", "expansions")
    assert (answer.status, answer.stopped_by) == expected
    assert index.find(start, goal, timeout=0).stopped_by == "timeout"
    batch = index.paths([start, start], [goal, (39, 4)], max_cost=whole / 2)
    assert batch.statuses.tolist() == [3, 0] and batch[0] is None and math.isnan(batch.distances[0])


def placement_of(engine):
    return "corner" if engine in ("anya", "subgoal-theta") else "center"


def test_lower_bound(rng):
    """No path is shorter than the bound, with smoothing and without."""
    blocked = slow.random_map(rng, 12, 19, 0.25)
    grid, oracle = mediant.Grid(blocked), slow.Slow(blocked, ("center", "never"))
    for start, goal in queries(rng, oracle, 10):
        for smooth in (None, "linear", "taut"):
            answer = grid.find(start, goal, smooth=smooth)
            if answer.path is None:
                continue
            assert oracle.is_path(answer.path[: None if start != goal else 1]) is None
            assert answer.distance <= grid.distance(start, goal) + 1e-9
            any_angle = oracle.distances("any", [start])[(0, *goal)]
            assert answer.lower_bound <= (grid.distance(start, goal) if smooth is None else any_angle) + 1e-7


def test_options(rng):
    """Heuristics and levels do not change what is shortest."""
    blocked = slow.random_map(rng, 15, 24, 0.3)
    grid, oracle = mediant.Grid(blocked), slow.Slow(blocked, ("center", "never"))
    for start, goal in queries(rng, oracle, 15):
        shortest = grid.distance(start, goal)
        for engine, options in [
            ("astar", {"heuristic": "hk"}),
            ("astar", {"heuristic": "euclidean"}),
            ("astar", {"heuristic": "zero"}),
            ("jps", {"heuristic": "euclidean"}),
            ("subgoal", {"levels": 2}),
            ("subgoal", {"levels": "all"}),
            ("subgoal", {"levels": "contracted"}),
        ]:
            assert grid.distance(start, goal, engine=engine, **options) == pytest.approx(shortest, abs=1e-9)
        assert grid.distance(start, goal, engine="hpa", side=5, levels=2) >= shortest - 1e-9
    # Options that only reproduce publications are not in the package.
    for option in ({"jump_limit": 3}, {"variant": "paper"}):
        with pytest.raises(TypeError):
            grid.path((0, 0), (1, 1), engine="jps", **option)
    with pytest.raises(mediant.MediantError):
        grid.path((0, 0), (1, 1), engine="astar", heuristic="squared")


def test_counters():
    index = mediant.Grid(np.zeros((20, 30), dtype=bool)).prepare("dijkstra")
    assert index.find((0, 0), (19, 29)).counters is None
    counters = index.find((0, 0), (19, 29), counters=True).counters
    assert set(counters) == {"expanded", "generated", "updated", "percolations", "scanned", "fallbacks"}
    assert 100 < counters["expanded"] <= 600


def test_moves_and_bounds():
    for k in range(2, 9):
        assert sorted(map(tuple, mediant.moves(k).tolist())) == sorted(slow.moves(k))
        angles = np.unwrap(np.arctan2(*mediant.moves(k).T))
        assert (np.diff(angles) > 0).all() or (np.diff(angles) < 0).all()
    bounds = [mediant.bound(k, placement="corner") for k in range(2, 9)]
    assert bounds == sorted(bounds, reverse=True)
    # Halfway between an axis and the next move, the worst direction (Kramm 2018).
    for k, value in zip(range(2, 9), bounds):
        a, b = np.array([[1.0, 0.0], [k - 2.0, 1.0]]) if k > 2 else np.array([[1.0, 0.0], [0.0, 1.0]])
        ways = [np.hypot(*a) * (1 - t) + np.hypot(*b) * t for t in np.linspace(0, 1, 20001)]
        straight = [np.hypot(*(a * (1 - t) + b * t)) for t in np.linspace(0, 1, 20001)]
        assert value == pytest.approx(np.max(np.array(ways) / straight), abs=1e-6)
    assert mediant.bound("any") == 1.0
    assert mediant.bound(3, corners="always") is None
