"""Batches of a grid, certificates, searches in steps, traces, spacing, exceptions."""

from __future__ import annotations

import json
import math
import signal
import threading
import time

import mediant
import numpy as np
import pytest
import slow


def example(rng, shape=(19, 33), count=60, density=0.25):
    """A grid, starts and goals that are free cells, and so free corners."""
    blocked = slow.random_map(rng, *shape, density)
    free = np.argwhere(~blocked)
    return mediant.Grid(blocked), *free[rng.integers(len(free), size=(2, count))]


@pytest.mark.parametrize("how", [{}, {"k": "any"}, {"k": 4, "engine": "jps"}, {"engine": "hpa", "side": 5}])
def test_paths_of_a_grid_are_its_single_paths(rng, how):
    grid, starts, goals = example(rng)
    paths = grid.paths(starts, goals, **how)
    assert len(paths) == len(starts)
    for path, start, goal in zip(paths, starts, goals):
        single = grid.path(start, goal, **how)
        assert (path is None) == (single is None)
        assert path is None or np.array_equal(path, single)
    wished = grid.paths(starts, goals, max_cost=5, **how)
    assert set(wished.statuses) == {0, 1, 3} or set(wished.statuses) == {0, 3}
    assert len(grid.paths(starts[0], goals)) == len(goals)


def test_mistakes_of_paths_of_a_grid():
    grid = mediant.Grid.from_rows([".#.", "..."])
    with pytest.raises(mediant.QueryError, match=r"query 1: the goal \(0, 1\) is blocked"):
        grid.paths((0, 0), [(0, 2), (0, 1)])
    assert grid.paths((0, 0), [(0, 2), (0, 1)], invalid="none").statuses.tolist() == [0, 4]
    with pytest.raises(TypeError, match=r"unexpected keyword argument 'kk'.*points, threads"):
        grid.paths((0, 0), (0, 2), kk=3)


@pytest.mark.parametrize("rule", slow.RULES)
def test_certificates_hold_against_all_angles(rng, rule):
    """No any-angle path under the same rules is shorter; straight lines are tight."""
    grid, starts, goals = example(rng, (9, 12), 40)
    oracle = slow.Slow(grid.to_numpy(), rule)
    sources = sorted({tuple(map(int, start)) for start in starts})
    any_angle = oracle.distances("any", sources)
    tight = 0
    for how in ({"k": 2}, {"k": 4}, {"engine": "theta"}, {"k": 3, "smooth": "taut"}):
        for start, goal in zip(starts, goals):
            answer = grid.find(start, goal, **how, **slow.motion(rule))
            if answer.path is None:
                assert answer.any_angle_lower_bound is None
                continue
            least = any_angle[(sources.index(tuple(start)), *goal)]
            assert answer.any_angle_lower_bound <= least * (1 + 1e-9)
            assert answer.any_angle_lower_bound >= math.dist(start, goal) * (1 - 1e-9)
            tight += answer.any_angle_lower_bound >= answer.distance * (1 - 1e-9)
    assert tight > 5


def test_the_certificate_of_an_exact_path_is_its_length():
    grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    answer = grid.find((0, 0), (3, 4), k="any")
    assert answer.any_angle_lower_bound == answer.distance
    nearest = grid.edit((0, 2), [[True], [True], [True]]).find((0, 0), (0, 3), nearest=True)
    assert (nearest.status, nearest.any_angle_lower_bound) == ("nearest", 1.0)
    assert grid.find((0, 0), (2, 3), max_cost=1).any_angle_lower_bound is None


ENGINES = ["astar", "dijkstra", "canonical", "jps", "jps-plus", "theta", "anya", "subgoal", "hpa", "chpa"]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_search_in_steps_finds_what_one_at_once_finds(rng, engine):
    grid, starts, goals = example(rng, count=12)
    index = grid.prepare(engine, **({"k": "any"} if engine == "anya" else {}))
    for start, goal in zip(starts, goals):
        wanted = index.find(start, goal, counters=True)
        search, steps, bounds = index.search(start, goal, trace=True), 0, [0.0]
        assert (search.answer, search.expansions) == (None, 0) or wanted.status == "unreachable"
        while search.step(3) is None:
            steps += 1
            bounds.append(search.lower_bound)
            assert search.best is not None and np.array_equal(search.best[0], start)
        answer = search.answer
        assert (answer.status, answer.counters) == (wanted.status, wanted.counters)
        assert (answer.path is None) == (wanted.path is None)
        assert answer.path is None or np.array_equal(answer.path, wanted.path)
        assert answer.distance == wanted.distance
        assert max(bounds) <= wanted.distance * (1 + 1e-9)
        assert len(search.expanded()) == wanted.counters["expanded"]
        assert len(search.generated()) == wanted.counters["generated"]
        # The answer stays.
        assert search.step().distance == search.finish().distance == wanted.distance


def test_steps_and_wishes():
    grid = mediant.Grid.from_rows(["....#.", "....#.", "....#."])
    index = grid.prepare("astar")
    search = index.search([(0, 0), (2, 2)], (0, 5), nearest=True, points="vertices")
    assert search.finish().status == "nearest"
    search = index.search((0, 0), (2, 3), max_expansions=1)
    assert (search.step(10).stopped_by, search.answer.status) == ("expansions", "stopped")
    search = index.search((0, 0), (2, 3), timeout=0)
    assert search.finish().stopped_by == "timeout"
    # The time between steps counts.
    search = index.search((0, 0), (2, 3), timeout=0.01)
    time.sleep(0.02)
    assert search.finish().stopped_by == "timeout"


def test_events_are_kept_if_they_are_asked_for():
    search = mediant.Grid.from_rows(["..."]).prepare("astar").search((0, 0), (0, 2))
    for read in (search.expanded, search.generated, lambda: search.write_trace("nowhere")):
        with pytest.raises(mediant.ArgumentError, match="trace=True"):
            read()
    assert search.finish().counters is None


def test_a_search_is_of_one_thread_at_a_time():
    """A step on another thread does not wait for ever, and nothing is lost."""
    index = mediant.Grid(np.zeros((1500, 1500), dtype=bool)).prepare("dijkstra")
    search, errors = index.search((0, 0), (1499, 1499)), []

    def look():
        try:
            while search.step(1000) is None:
                pass
        except mediant.ArgumentError as error:
            errors.append(str(error))

    threads = [threading.Thread(target=look) for _ in range(2)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all("search: a step is at work" in error for error in errors) and len(errors) < 2
    assert search.finish().status == "found"


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="needs a signal that a timer sends")
def test_a_search_goes_on_after_a_signal():
    """The error of a signal's handler comes out of a step, and no expansion is lost or made twice."""

    class AlarmError(Exception):
        pass

    def handler(*_):
        raise AlarmError

    index = mediant.Grid(np.zeros((1024, 1024), dtype=bool)).prepare("dijkstra", k=4)
    wanted = index.find((0, 0), (1023, 1023), counters=True)
    search, alarms = index.search((0, 0), (1023, 1023), trace=True), 0
    known = signal.signal(signal.SIGALRM, handler)
    try:
        while search.answer is None:
            try:
                try:
                    signal.setitimer(signal.ITIMER_REAL, 0.03)
                    search.finish()
                finally:
                    signal.setitimer(signal.ITIMER_REAL, 0)
            except AlarmError:
                alarms += 1
    finally:
        signal.signal(signal.SIGALRM, known)
    assert alarms > 0
    assert search.answer.distance == wanted.distance
    assert search.answer.counters == wanted.counters


def test_traces(tmp_path, rng):
    """The file has the events in their order, between the ends and the path."""
    grid, starts, goals = example(rng, count=8)
    index = grid.prepare("astar")
    for start, goal in zip(starts, goals):
        search = index.search(start, goal, trace=True)
        answer = search.finish()
        file = tmp_path / "trace.json"
        search.write_trace(file)
        events = json.loads(file.read_text(encoding="utf-8"))["events"]
        points = {kind: [[e["y"], e["x"]] for e in events if e["type"] == kind] for kind in KINDS}
        assert points["source"] == [list(start)] and points["destination"] == [list(goal)]
        assert points["expanding"] == search.expanded().tolist()
        assert points["generating"] == search.generated().tolist()
        assert points["end"] == ([] if answer.path is None else answer.path.tolist())
    with pytest.raises(mediant.FileError, match="there is no folder"):
        search.write_trace(tmp_path / "nowhere" / "trace.json")


KINDS = ("source", "destination", "generating", "expanding", "end")


def test_spacing(rng):
    grid, starts, goals = example(rng)
    for path in filter(lambda path: path is not None and len(path) > 1, grid.paths(starts, goals, k="any")):
        spacing = float(rng.uniform(0.05, 3))
        points = mediant.spaced(path, spacing)
        assert points.dtype == np.float64
        assert np.array_equal(points[0], path[0]) and np.array_equal(points[-1], path[-1])
        lengths = np.hypot(*np.diff(path, axis=0).T)
        along = np.r_[0, np.cumsum(lengths)]
        at = np.append(np.arange(len(points) - 1) * spacing, along[-1])
        assert along[-1] - at[-2] <= spacing * (1 + 1e-9)
        wanted = np.c_[np.interp(at, along, path[:, 0]), np.interp(at, along, path[:, 1])]
        assert np.allclose(points, wanted)
    assert mediant.spaced([(2, 3)], 1).tolist() == [[2, 3]]
    assert mediant.spaced(np.empty((0, 2), dtype=int), 1).shape == (0, 2)
    for spacing in (0, -1, float("nan"), 1e-300):
        with pytest.raises(mediant.ArgumentError, match="spacing"):
            mediant.spaced([(0, 0), (0, 9)], spacing)


def test_the_distance_of_a_vertex():
    field = mediant.Grid.from_rows([".#.", "..."]).field((0, 0))
    distances = field.distances()
    for at in np.ndindex(distances.shape):
        assert field.get(at) == distances[at]
    assert field.get((5, 5)) == field.get((-1, 0)) == math.inf


@pytest.mark.parametrize("engine", ["subgoal", "jps", "hpa"])
def test_exceptions_are_edits(rng, engine):
    grid, starts, goals = example(rng, count=30)
    index = grid.prepare(engine)
    for start, goal in zip(starts, goals):
        blocked, free = (np.c_[rng.integers(19, size=9), rng.integers(33, size=9)] for _ in range(2))
        answer = index.find_except(start, goal, blocked=blocked, free=free, free_ends=True, counters=True)
        edited = grid.edit_cells(blocked, True).edit_cells(free, False).edit_cells([start, goal], False)
        if engine != "hpa":
            assert answer.distance == edited.distance(start, goal)
        assert answer.path is None or edited.holds(answer.path)
        assert answer.counters is not None
        plain, same = index.find(start, goal), index.find_except(start, goal)
        assert (plain.status, plain.distance) == (same.status, same.distance)


def test_mistakes_of_exceptions():
    index = mediant.Grid.from_rows(["..#", "..."]).prepare("astar")
    with pytest.raises(mediant.MapError, match=r"free: cell \(2, 0\) is outside"):
        index.find_except((0, 0), (1, 2), free=(2, 0))
    with pytest.raises(mediant.QueryError, match=r"the goal \(0, 2\) is blocked"):
        index.find_except((0, 0), (0, 2))
    assert index.find_except((0, 0), (0, 2), free_ends=True).distance == 2
    assert index.find_except((0, 0), (0, 1), blocked=(1, 1), max_expansions=0).stopped_by == "expansions"
    assert index.find_except((0, 0), (0, 1), blocked=(1, 1), timeout=0).status == "stopped"
