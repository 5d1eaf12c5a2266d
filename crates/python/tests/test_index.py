"""Indexes: saved, sent to other processes and threads, repaired; batches and tables."""

from __future__ import annotations

import multiprocessing
import pickle
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import mediant
import numpy as np
import pytest
import slow

SETUPS = [
    ("astar", {"k": 4}),
    ("canonical", {"k": 3, "placement": "corner", "gap": "closed"}),
    ("jps", {"k": 2, "heuristic": "euclidean"}),
    ("jps-plus", {"k": 3, "corners": "one"}),
    ("anya", {}),
    ("anya", {"k": 5, "gap": "closed"}),
    ("subgoal", {"k": 3}),
    ("subgoal", {"k": "any", "gap": "closed"}),
    ("subgoal", {"k": 5, "placement": "corner", "levels": "contracted"}),
    ("subgoal", {"k": 4, "placement": "corner", "levels": "labels", "smooth": "taut"}),
    ("subgoal-theta", {"k": 3, "placement": "corner"}),
    ("hpa", {"side": 6}),
    ("chpa", {"smooth": "taut"}),
]


def example(rng, shape=(19, 33), count=200, density=0.25):
    """A grid, starts and goals that are free cells, and so free corners."""
    blocked = slow.random_map(rng, *shape, density)
    free = np.argwhere(~blocked)
    return mediant.Grid(blocked), *free[rng.integers(len(free), size=(2, count))]


def assert_same(a, b):
    """The same `Paths`."""
    for name in ("points", "offsets", "distances", "statuses"):
        first, second = getattr(a, name), getattr(b, name)
        assert (first.dtype, first.shape) == (second.dtype, second.shape)
        assert np.array_equal(first, second, equal_nan=name == "distances"), name


@pytest.mark.parametrize("engine, how", SETUPS)
def test_setups_travel(rng, tmp_path, engine, how):
    """Saved and loaded, through bytes and through pickle: the same setup and the same answers."""
    grid, starts, goals = example(rng)
    index = grid.prepare(engine, **how)
    paths = index.paths(starts, goals)
    assert index.grid == grid and index.engine == engine and index.origin == "prepared"
    again = pickle.loads(pickle.dumps(index))
    assert again.grid == grid and again.engine == engine
    # The text may name options that the first one left to their defaults; it does not change again.
    assert pickle.loads(pickle.dumps(again)).setup == again.setup
    assert_same(again.paths(starts, goals), paths)
    options = {name: value for name, value in how.items() if name not in ("k", "placement", "corners", "gap")}
    if index.memory_bytes and engine in ("jps-plus", "subgoal", "subgoal-theta", "hpa", "chpa"):
        index.save(tmp_path / "index")
        for loaded in (
            grid.load(tmp_path / "index", **options),
            grid.load(str(tmp_path / "index"), **options),
            grid.index_from_bytes(index.to_bytes(), **options),
        ):
            assert (loaded.engine, loaded.origin) == (engine, "loaded")
            assert_same(loaded.paths(starts, goals), paths)
        with pytest.raises(mediant.MismatchError):
            grid.edit((0, 0), ~grid.to_numpy()[:1, :1]).load(tmp_path / "index")
        with pytest.raises(mediant.IndexFileError):
            grid.index_from_bytes(index.to_bytes()[:-1])
        damaged = bytearray(index.to_bytes())
        damaged[len(damaged) // 2] ^= 4
        with pytest.raises(mediant.MediantError):
            grid.index_from_bytes(bytes(damaged))
    else:
        with pytest.raises(mediant.OptionError):
            index.to_bytes()


def test_missing_index(tmp_path):
    grid = mediant.Grid.from_rows([".."])
    with pytest.raises(FileNotFoundError):
        grid.load(tmp_path / "none")
    with pytest.raises(mediant.FileError):
        grid.prepare().save(tmp_path / "no" / "folder")


def answer(index, starts, goals):
    """In another process: many on a pool of threads, a few, one, and what prepares anew."""
    return (
        index.paths(starts, goals),
        index.paths(starts[:2], goals[:2]).distances,
        index.distance(starts[0], goals[0]),
        index.grid.prepare("hpa").distances(starts, goals),
        index.grid.distances(starts[0]),
        index.grid.path(starts[0], goals[0]),
    )


@pytest.mark.parametrize("method", ["spawn", "fork", "forkserver"])
def test_processes(rng, method):
    """A process that was started or forked after the module was used answers, too, and does not hang."""
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"no {method} here")
    grid, starts, goals = example(rng, (70, 90), 3000)
    index = grid.prepare()
    here = answer(index, starts, goals)
    with multiprocessing.get_context(method).Pool(2) as pool:
        results = [pool.apply_async(answer, (index, starts, goals)) for _ in range(3)]
        for result in results:
            there = result.get(timeout=60)
            assert_same(there[0], here[0])
            assert all(np.array_equal(a, b) for a, b in zip(there[1:], here[1:]))


def test_paths_as_sequence(rng):
    grid, starts, goals = example(rng, density=0.4)
    index = grid.prepare()
    paths = index.paths(starts, goals)
    assert len(paths) == 200 and repr(paths) == "<mediant.Paths of 200 queries>"
    assert paths.offsets[0] == 0 and paths.offsets[-1] == len(paths.points)
    none = 0
    for i, path in enumerate(paths):
        alone = index.path(starts[i], goals[i])
        none += path is None
        assert (
            (path is None) == (alone is None) == bool(paths.statuses[i] == 1) == np.isinf(paths.distances[i])
        )
        if path is not None:
            assert np.array_equal(path, alone) and np.array_equal(paths[i - 200], path)
            assert path.dtype == np.int32
            assert np.array_equal(paths.points[paths.offsets[i] : paths.offsets[i + 1]], path)
        assert paths.distances[i] == pytest.approx(index.distance(starts[i], goals[i]), rel=1e-9)
    assert 0 < none < 150
    for part in (slice(3, 50, 7), slice(None), slice(None, None, -1), slice(150, 999), slice(5, 5)):
        assert all(np.array_equal(a, b) for a, b in zip(paths[part], list(paths)[part]))
        assert len(paths[part]) == len(range(200)[part])
    for wrong in (200, -201, 2**31):
        with pytest.raises(IndexError):
            paths[wrong]
    assert_same(pickle.loads(pickle.dumps(paths)), paths)


def test_no_queries():
    index = mediant.Grid.from_rows(["..."]).prepare()
    for starts, goals in [([], []), (np.zeros((0, 2), dtype=int), []), ((0, 0), [])]:
        paths = index.paths(starts, goals)
        assert len(paths) == 0 and list(paths) == [] and paths.points.shape == (0, 2)
        assert paths.offsets.tolist() == [0] and paths.statuses.shape == (0,)
        assert index.distances(starts, goals).shape == (0,)
        assert_same(pickle.loads(pickle.dumps(paths)), paths)
    assert index.table([], [(0, 0)]).shape == (0, 1)
    assert index.table([(0, 0)], []).shape == (1, 0)


@pytest.mark.parametrize("engine, how", SETUPS)
def test_threads_do_not_matter(rng, engine, how):
    """On 1, 2, 3 and 8 threads the same arrays; distances and tables agree with them."""
    grid, starts, goals = example(rng, count=2500)
    index = grid.prepare(engine, threads=1, **how)
    paths = index.paths(starts, goals, threads=1)
    distances = index.distances(starts, goals, threads=1)
    assert distances == pytest.approx(paths.distances, rel=1e-9)
    for threads in (2, 3, 8):
        assert grid.prepare(engine, threads=threads, **how).setup == index.setup
        assert_same(index.paths(starts, goals, threads=threads), paths)
        assert np.array_equal(index.distances(starts, goals, threads=threads), distances)
    table = index.table(starts[:40], goals[:70])
    assert table.shape == (40, 70)
    assert np.diagonal(table) == pytest.approx(paths.distances[:40], rel=1e-9)
    assert table[3, 50] == pytest.approx(index.distance(starts[3], goals[50]), rel=1e-9)
    assert np.array_equal(index.table(starts[:40], goals[:70], threads=3), table)
    one = index.paths(starts[0], goals, points="touched")
    assert np.array_equal(one.distances, index.paths(np.repeat(starts[:1], 2500, axis=0), goals).distances)
    alone = index.path(starts[0], goals[7], points="touched")
    assert one[7] is None if alone is None else np.array_equal(one[7], alone)


def test_shared_by_threads(rng):
    """Eight threads ask one index and one grid at the same time."""
    grid, starts, goals = example(rng, (60, 41), 400)
    index = grid.prepare()
    wanted = index.distances(starts, goals).tolist()
    barrier = threading.Barrier(8)

    def ask(number):
        barrier.wait()
        if number % 4 == 0:
            return index.paths(starts, goals).distances.tolist()
        if number % 4 == 1:
            return [grid.distance(a, b, engine="jps") for a, b in zip(starts, goals)]
        if number % 4 == 2:
            return [index.find(a, b, counters=True).distance for a, b in zip(starts, goals)]
        return [index.distance(a, b) for a, b in zip(starts, goals)]

    with ThreadPoolExecutor(8) as pool:
        for got in pool.map(ask, range(8)):
            assert got == pytest.approx(wanted)


@pytest.mark.skipif(sys.platform != "linux", reason="limits memory as Linux does")
def test_short_memory():
    """A call that needs more memory than there is raises an error, and the process goes on."""
    program = """
import mediant, numpy, resource
grid = mediant.Grid(numpy.zeros((4000, 4000), bool))
index = grid.prepare("astar", k=3)
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + (50 << 20), resource.RLIM_INFINITY))
for ask in [lambda: index.path((0, 0), (9, 9)), lambda: grid.prepare("jps-plus", k=3)]:
    try:
        ask()
    except MemoryError as error:
        assert str(error).startswith("there is no room for "), error
    else:
        raise AssertionError("there was room")
resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
assert len(index.path((0, 0), (9, 9))) == 2
"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_invalid_queries():
    index = mediant.Grid.from_rows(["..#", "..."]).prepare()
    starts, goals = [(0, 0), (0, 2), (0, 0), (0, 1)], [(1, 2), (0, 0), (7, 0), (0, 1)]
    with pytest.raises(mediant.QueryError, match=r"query 1.*\(0, 2\)"):
        index.paths(starts, goals)
    with pytest.raises(mediant.QueryError, match=r"query 1"):
        index.distances(starts, goals)
    paths = index.paths(starts, goals, invalid="none")
    assert paths.statuses.tolist() == [0, 4, 4, 0] and paths[1] is None
    assert np.isnan(paths.distances).tolist() == [False, True, True, False]
    assert paths[3].tolist()[0] == [0, 1]
    with pytest.raises(mediant.ArgumentError, match="goals"):
        index.paths(starts, goals[:3])


def test_progress(rng):
    """Called with growing numbers, and last with all; what it raises ends the call."""
    grid, starts, goals = example(rng, (150, 130), 20000)
    index, told = grid.prepare(), []
    paths = index.paths(starts, goals, progress=lambda done, count: told.append((done, count)))
    assert told == sorted(told) and told[-1] == (20000, 20000) and {count for _, count in told} == {20000}
    for call in (index.paths, index.distances, index.table, index.nearest):
        with pytest.raises(ZeroDivisionError):
            call(starts[:300], goals[:300], progress=lambda done, count: 1 // 0)
    assert_same(index.paths(starts, goals), paths)


def test_progress_of_preparation():
    """A long preparation tells its stages; what the callback raises ends it."""
    blocked = np.random.default_rng(3).random((500, 700)) < 0.1
    grid, told = mediant.Grid(blocked), []
    grid.prepare("subgoal", k=3, progress=lambda *args: told.append(args))
    stages = [stage for stage, _, _ in told]
    order = ["edges", "hierarchy", "sight", "labels"]
    assert stages == sorted(stages, key=order.index)
    assert all(0 < done <= total for _, done, total in told)
    assert ("edges", told[0][2], told[0][2]) in told
    with pytest.raises(KeyError):
        grid.prepare("subgoal", k=3, progress=lambda *args: {}["no"])


@pytest.mark.parametrize("engine, how", SETUPS)
def test_repair(rng, engine, how):
    """A repaired index answers as one prepared anew, and the old one as before."""
    grid, starts, goals = example(rng)
    index = grid.prepare(engine, **how)
    before, kept = index.paths(starts, goals), grid.to_numpy()
    for _ in range(4):
        row, column = int(rng.integers(15)), int(rng.integers(28))
        edited = index.grid.edit((row, column), rng.random((4, 5)) < 0.3)
        repaired = index.repair(edited)
        assert repaired.grid == edited and repaired.origin in ("repaired", "prepared", "unchanged")
        new = edited.prepare(engine, **how)
        assert repaired.setup == new.setup
        expected = new.paths(starts, goals, invalid="none")
        if engine == "subgoal":
            # Of equally short paths an earlier map may give another one.
            found = repaired.paths(starts, goals, invalid="none").distances
            assert how.get("smooth") or np.allclose(found, expected.distances, equal_nan=True)
            assert repaired.origin == "unchanged" or not repaired.is_finished
            assert_same(repaired.finish().paths(starts, goals, invalid="none"), expected)
        else:
            assert repaired.is_finished and repaired.finish().setup == repaired.setup
            assert_same(repaired.paths(starts, goals, invalid="none"), expected)
        assert np.array_equal(index.grid.to_numpy(), kept)
        index, kept = repaired, edited.to_numpy()
    assert_same(grid.prepare(engine, **how).paths(starts, goals), before)
    assert index.repair(index.grid).origin == "unchanged" or engine not in ("hpa", "chpa")
    assert grid.prepare("hpa").repair(edited).origin == "repaired"


def test_answers_say_by_what():
    """Labels of the grid before answer where they prove it, and another engine elsewhere."""
    grid = mediant.Grid.from_rows(["." * 20] * 5 + ["#" * 19 + "."] + ["." * 20] * 5)
    index = grid.prepare("subgoal")
    assert index.find((0, 0), (9, 0)).searched_by == "subgoal"
    repaired = index.repair(grid.edit((5, 0), [[False]]))
    assert (repaired.origin, repaired.is_finished) == ("repaired", False)
    through, beside = [(4, 0), (6, 0)], [(0, 19), (9, 19)]
    assert [repaired.find(*ends).searched_by for ends in (through, beside)] == ["jps-block", "subgoal"]
    finished = repaired.finish()
    assert finished.is_finished and finished.find(*through).searched_by == "subgoal"
    assert index.find_except((4, 0), (6, 0), free=[(5, 0)]).searched_by == "jps-block"


def test_repair_hands_scratch_memory_on(rng):
    """Both indexes answer in turn, whichever has the memory: the old one makes it anew."""
    for engine, how in [("astar", {}), ("jps-block", {}), ("anya", {"k": "any"}), ("hpa", {})]:
        grid, starts, goals = example(rng)
        index = grid.prepare(engine, **how)
        edited = grid.edit((3, 4), rng.random((5, 6)) < 0.4)
        expected = [a.prepare(engine, **how).distances(starts, goals, invalid="none") for a in (grid, edited)]
        index.path(starts[0], goals[0])
        repaired = index.repair(edited)
        for _ in range(2):
            for known, answering in zip(expected, (index, repaired)):
                found = answering.distances(starts, goals, invalid="none")
                assert np.array_equal(found, known, equal_nan=True)
        # And back again, to a grid that another index has.
        assert np.array_equal(repaired.repair(grid).distances(starts, goals, invalid="none"), expected[0])


def test_repair_of_other_sizes():
    index = mediant.Grid.from_rows(["..", ".."]).prepare("hpa")
    other = mediant.Grid.from_rows(["...", "..."])
    try:
        assert index.repair(other).distance((0, 0), (1, 2)) == pytest.approx(1 + 2**0.5)
    except mediant.MediantError as error:
        assert error.code


def test_with_options():
    grid = mediant.Grid(np.zeros((9, 14), dtype=bool))
    index = grid.prepare("astar", k=3)
    assert index.with_options(heuristic="euclidean").setup == "astar:3:never,euclidean"
    assert index.with_options().setup == index.setup
    taut = index.with_options(smooth="taut")
    assert taut.distance((0, 0), (8, 13)) < index.distance((0, 0), (8, 13))
    with pytest.raises(mediant.OptionError):
        index.with_options(side=4)
    with pytest.raises(mediant.OptionError):
        grid.prepare("hpa", side=4).with_options(side=5)


def test_facts():
    index = mediant.Grid(np.zeros((9, 14), dtype=bool)).prepare("subgoal", k=4, placement="corner")
    assert (index.k, index.placement, index.rule) == (4, "corner", "open")
    assert index.bound == pytest.approx(mediant.bound(4, placement="corner"))
    assert index.memory_bytes > 0 and index.guarantee
    anya = mediant.Grid(np.zeros((9, 14), dtype=bool)).prepare("anya")
    assert (anya.k, anya.placement, anya.bound) == ("any", "corner", 1.0)
    anya = mediant.Grid(np.zeros((9, 14), dtype=bool)).prepare("anya", k=4)
    assert (anya.k, anya.placement, anya.bound) == (4, "corner", index.bound)


def test_immutable():
    index = mediant.Grid.from_rows(["..."]).prepare()
    for thing, name in ((index, "engine"), (index.grid, "shape"), (index.find((0, 0), (0, 1)), "path")):
        with pytest.raises((AttributeError, TypeError)):
            setattr(thing, name, None)
    with pytest.raises(TypeError):
        type(index)()


@pytest.mark.skipif(sys.flags.dev_mode, reason="counts references")
def test_no_leaks(rng):
    """Arrays go when nobody holds them."""
    grid, starts, goals = example(rng, count=50)
    index = grid.prepare()
    counts = []
    for _ in range(3):
        for _ in range(50):
            index.paths(starts, goals), index.path(starts[0], goals[0]), grid.distances(starts[0])
        counts.append((sys.getrefcount(starts), sys.getrefcount(None) // 1000, sys.getrefcount(index)))
    assert counts[1] == counts[2]


def test_a_table_that_has_no_room():
    index = mediant.Grid.from_rows(["..."]).prepare()
    many = np.zeros((50_000, 2), dtype=np.int32)
    with pytest.raises(mediant.ArgumentError, match=r"^goals: a table of 50000"):
        index.table(many, many)


def test_points_of_a_packed_record():
    """Its numbers lie closer than whole ones: they can be read as a copy only."""
    index = mediant.Grid.from_rows(["....."] * 4).prepare()
    record = np.zeros((2, 2), dtype=[("point", "<i4"), ("byte", "i1")])
    record["point"] = [[0, 1], [3, 4]]
    assert (
        index.distances((0, 0), record["point"]).tolist()
        == index.distances((0, 0), [[0, 1], [3, 4]]).tolist()
    )
    assert index.path((0, 0), record["point"][1]).tolist() == index.path((0, 0), (3, 4)).tolist()


def test_an_invalid_query_is_named_by_its_number():
    """Also beyond the first chunk of 256."""
    index = mediant.Grid.from_rows(["..#"]).prepare()
    goals = np.zeros((700, 2), dtype=np.int32)
    goals[600] = (0, 2)
    with pytest.raises(mediant.QueryError, match=r"^query 600: the goal \(0, 2\) is blocked"):
        index.distances((0, 0), goals)
