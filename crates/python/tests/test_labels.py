"""Hub labels: distances without paths, tables, the nearest goal; and the memory that they may take."""

from __future__ import annotations

import pickle

import mediant
import numpy as np
import pytest
import slow

MOTIONS = [
    {"k": 3},
    {"k": 2, "corners": "one"},
    {"k": 4, "placement": "corner"},
    {"k": "any", "gap": "closed"},
]
OTHERS = [("astar", {}), ("subgoal", {"levels": "contracted"}), ("subgoal", {"smooth": "taut"}), ("hpa", {})]


def example(rng, shape=(23, 31), density=0.3, count=60):
    """A grid with rooms that no path joins, starts and goals that are free cells, and so free corners."""
    blocked = slow.random_map(rng, *shape, density)
    free = np.argwhere(~blocked)
    return mediant.Grid(blocked), *free[rng.integers(len(free), size=(2, count))]


def single(index, starts, goals):
    """The lengths of single paths, from each start to each goal."""
    lengths = [[index.find(start, goal).distance for goal in goals] for start in starts]
    return np.array(lengths).reshape(len(starts), len(goals))


@pytest.mark.parametrize("how", MOTIONS)
def test_labels_measure_what_paths_measure(rng, how):
    """One distance, many and tables, against the lengths of single paths and a slow reference."""
    grid, starts, goals = example(rng, (9, 12), count=30)
    index = grid.prepare("subgoal", levels="labels", **how)
    assert (index.levels, index.searched_by) == ("labels", "subgoal")
    wanted = single(index, starts, goals)
    oracle = slow.Slow(grid.to_numpy(), (index.placement, index.rule))
    truth = [distances[tuple(goals.T)] for distances in oracle.distances(how["k"], list(map(tuple, starts)))]
    assert np.isinf(wanted).any() and wanted == pytest.approx(np.array(truth), rel=1e-9)
    pairs = np.diagonal(wanted)
    assert [index.distance(a, b) for a, b in zip(starts, goals)] == pytest.approx(pairs.tolist(), rel=1e-9)
    assert index.distances(starts, goals) == pytest.approx(pairs, rel=1e-9)
    table = index.table(starts, goals)
    # All of them are the same to the last bit.
    assert np.array_equal(index.distances(starts, goals), np.diagonal(table))
    assert [index.distance(a, b) for a, b in zip(starts, goals)] == np.diagonal(table).tolist()
    assert table.dtype == np.float64 and table == pytest.approx(wanted, rel=1e-9)
    # Wishes ask for paths, which labels have, too.
    assert index.distances(starts, goals, max_cost=1e9) == pytest.approx(pairs, rel=1e-9)


@pytest.mark.parametrize("how", MOTIONS)
@pytest.mark.parametrize("engine, options", [("subgoal", {"levels": "labels"}), *OTHERS])
def test_nearest(rng, how, engine, options):
    """The nearest goal is the one of the least single distance."""
    if engine == "hpa" and how["k"] != 3:
        pytest.skip("hpa is tried at one k")
    if engine == "astar" and how["k"] == "any":
        engine = "anya"
    grid, starts, goals = example(rng)
    # An end alone in a closed room has no way to any goal.
    blocked = grid.to_numpy()
    blocked[:3, :3], blocked[1, 1], starts[0] = True, False, (1, 1)
    for ends in (starts, goals):
        ends[blocked[tuple(ends.T)]] = (22, 30)
    blocked[22, 30] = False
    grid, goals = mediant.Grid(blocked), goals[:9]
    index = grid.prepare(engine, **options, **how)
    wanted = single(index, starts, goals)
    numbers, distances = index.nearest(starts, goals)
    assert (numbers.dtype, numbers.shape) == (np.int64, (60,))
    assert (distances.dtype, distances.shape) == (np.float64, (60,))
    if engine == "hpa":  # Its paths to several goals need not be the best of its paths to each.
        assert np.array_equal(numbers < 0, np.isinf(wanted).all(axis=1))
        return
    assert distances == pytest.approx(wanted.min(axis=1), rel=1e-9)
    is_none = np.isinf(wanted).all(axis=1)
    assert is_none.any() and np.array_equal(numbers == -1, is_none)
    found = np.flatnonzero(~is_none)
    assert wanted[found, numbers[found]] == pytest.approx(distances[found], rel=1e-9)
    if index.levels == "labels":
        nearly = wanted <= wanted.min(axis=1, keepdims=True) * (1 + 1e-9)
        assert np.array_equal(numbers[found], nearly.argmax(axis=1)[found]), "the first of several"


@pytest.mark.parametrize("engine", ["subgoal", "anya"])
def test_of_equal_goals_the_first_is_the_nearest(engine):
    grid = mediant.Grid.from_rows(["..", "#.", "..", ".."])
    index = grid.prepare(engine, k="any", gap="closed")
    for goals in ([(4, 0), (0, 0)], [(0, 0), (4, 0)]):
        numbers, distances = index.nearest([(2, 2)], goals)
        assert numbers.tolist() == [0]
        assert distances.tolist() == pytest.approx([8**0.5])


def test_nearest_takes_points_as_others_do(rng):
    """One start or goal, none, any number of threads, progress."""
    grid, starts, goals = example(rng, (60, 70), density=0.2, count=3000)
    index, told = grid.prepare(), []
    wanted = index.nearest(starts, goals, progress=lambda *args: told.append(args))
    assert told == sorted(told) and told[-1] == (3000, 3000)
    for threads in (1, 2, 5):
        again = index.nearest(starts, goals, threads=threads)
        assert all(np.array_equal(a, b) for a, b in zip(again, wanted))
    one = index.nearest(tuple(starts[0].tolist()), goals)
    assert [part.tolist() for part in one] == [part[:1].tolist() for part in wanted]
    alone = index.nearest(starts[:5], goals[0])
    assert alone[1] == pytest.approx(index.distances(starts[:5], goals[0]), rel=1e-9)
    none = index.nearest(starts[:2], [])
    assert (none[0].tolist(), none[1].tolist()) == ([-1, -1], [np.inf, np.inf])
    assert [part.shape for part in index.nearest([], goals)] == [(0,), (0,)]
    with pytest.raises(ZeroDivisionError):
        index.nearest(starts, goals, progress=lambda *_: 1 // 0)


@pytest.mark.parametrize("engine", ["subgoal", "astar"])
def test_invalid_ends(engine):
    index = mediant.Grid.from_rows(["..#.", "..#."]).prepare(engine)
    starts, goals = [(0, 0), (0, 2), (1, 3)], [(9, 9), (1, 1), (0, 2)]
    with pytest.raises(mediant.QueryError, match=r"goal 0: .*\(9, 9\)") as error:
        index.nearest(starts, goals)
    assert error.value.code == "goal-outside"
    with pytest.raises(mediant.QueryError, match=r"query 1: .*\(0, 2\)") as error:
        index.nearest(starts, goals[1:2])
    assert error.value.code == "start-blocked"
    numbers, distances = index.nearest(starts, goals, invalid="none")
    assert numbers.tolist() == [1, -1, -1]
    assert distances == pytest.approx([2**0.5, np.nan, np.inf], rel=1e-9, nan_ok=True)
    # A table names the query that is the first in its order, as if each had been asked.
    for rows, columns, number, code in [
        (starts, goals, 0, "goal-outside"),
        (starts, goals[1:2], 1, "start-blocked"),
        (starts[1:], goals, 0, "start-blocked"),
        (starts, goals[1:], 1, "goal-blocked"),
    ]:
        with pytest.raises(mediant.QueryError, match=f"query {number}: ") as error:
            index.table(rows, columns)
        assert error.value.code == code
    table = index.table(starts[::2], [(1, 1), (0, 3)])
    assert table == pytest.approx(np.array([[2**0.5, np.inf], [np.inf, 1.0]]), rel=1e-9)


def test_memory(rng, tmp_path):
    """Labels are made if they fit, to the byte; a loaded index may take no more."""
    grid, starts, goals = example(rng, (40, 40), density=0.2)
    index = grid.prepare("subgoal")
    paths, most = index.paths(starts, goals), index.memory_bytes
    assert index.levels == "labels"
    for memory, levels in [(most, "labels"), (str(most), "labels"), ("8MB", "labels"), ("1GB", "labels")]:
        assert grid.prepare("subgoal", memory=memory).levels == levels
    for memory in (most - 1, 1, "1kB"):
        small = grid.prepare("subgoal", memory=memory)
        assert small.levels == "contracted" and small.searched_by == "subgoal"
        assert small.paths(starts, goals).distances == pytest.approx(paths.distances, rel=1e-9)
        assert pickle.loads(pickle.dumps(small)).levels == "contracted"
    with pytest.raises(mediant.OptionError, match="allow more memory"):
        grid.prepare("subgoal", levels="labels", memory="1kB")
    index.save(tmp_path / "index")
    assert grid.load(tmp_path / "index", memory=most).levels == "labels"
    with pytest.raises(mediant.OptionError, match="allow more memory"):
        grid.load(tmp_path / "index", memory=most - 1)
    with pytest.raises(mediant.OptionError, match="contraction"):
        grid.load(tmp_path / "index", levels="contracted")
    for again in (grid.load(tmp_path / "index"), pickle.loads(pickle.dumps(index))):
        assert again.levels == "labels" and again.memory_bytes == most
        assert np.array_equal(again.table(starts, goals), index.table(starts, goals))
    for wrong in (0, -1, "8 MiB", "", "much"):
        with pytest.raises(mediant.ArgumentError, match="memory"):
            grid.prepare("subgoal", memory=wrong)
    for wrong in (1.5, True, b"8MB"):
        with pytest.raises(TypeError, match="memory"):
            grid.prepare("subgoal", memory=wrong)
    with pytest.raises(mediant.OptionError):
        grid.prepare("astar", memory="8MB")


def test_levels_of_indexes():
    grid = mediant.Grid(np.zeros((40, 50), dtype=bool)).edit((3, 4), [[True]])
    for engine, options, levels in [
        ("astar", {}, None),
        ("subgoal", {"levels": 2}, 2),
        ("subgoal", {"levels": "all"}, "all"),
        ("subgoal", {"levels": "contracted"}, "contracted"),
        ("subgoal", {"levels": "labels"}, "labels"),
        ("subgoal-theta", {"placement": "corner"}, 2),
        ("hpa", {"levels": 1}, 1),
    ]:
        index = grid.prepare(engine, **options)
        assert (index.levels, index.searched_by) == (levels, engine)
    with pytest.raises(mediant.OptionError):
        grid.prepare("hpa", levels="labels")


def test_stages_of_labels():
    """The preparation of labels tells its five stages in order."""
    blocked = np.kron(np.random.default_rng(3).random((90, 90)) < 0.2, np.ones((5, 5), dtype=bool))
    grid, told = mediant.Grid(blocked), []
    index = grid.prepare("subgoal", memory="2GB", progress=lambda *args: told.append(args))
    order = ["edges", "hierarchy", "sight", "labels", "vertices"]
    stages = [order.index(stage) for stage, _, _ in told]
    assert index.levels == "labels" and stages == sorted(stages) and stages[-1] == 4
    assert all(0 < done <= total for _, done, total in told)


@pytest.mark.parametrize(
    "k, searched_by, levels, exact",
    [(3, "subgoal", "contracted", "jps-block"), ("any", "anya", None, "anya")],
)
def test_noise_has_no_labels(rng, tmp_path, k, searched_by, levels, exact):
    """Of noise a contraction is kept, or nothing; the index travels, and its paths are as good."""
    blocked = np.random.default_rng(3).random((400, 400)) < 0.1
    grid, free = mediant.Grid(blocked), np.argwhere(~blocked)
    starts, goals = free[rng.integers(len(free), size=(2, 20))]
    index = grid.prepare("subgoal", k=k)
    assert (index.engine, index.searched_by, index.levels) == ("subgoal", searched_by, levels)
    wanted = grid.prepare(exact, k=k).paths(starts, goals).distances
    index.save(tmp_path / "index")
    for again in (index, grid.load(tmp_path / "index"), pickle.loads(pickle.dumps(index))):
        assert (again.levels, again.searched_by) == (levels, searched_by)
        assert again.distances(starts, goals) == pytest.approx(wanted, rel=1e-9)
        assert np.diagonal(again.table(starts[:4], goals[:4])) == pytest.approx(wanted[:4], rel=1e-9)
        assert (again.nearest(starts, goals)[1] <= wanted * (1 + 1e-9)).all()
    with pytest.raises(mediant.OptionError):
        index.with_options(levels="labels")
