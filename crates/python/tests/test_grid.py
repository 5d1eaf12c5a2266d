"""Grids as values: made of arrays and files, edited, compared, pickled; rules of motion; the world."""

from __future__ import annotations

import pickle
from array import array as array_of

import calls
import mediant
import numpy as np
import pytest
import slow


def test_arrays_of_all_kinds(rng):
    """True is blocked, whatever the layout of the array."""
    blocked = slow.random_map(rng, 6, 11, 0.4)
    wide = np.zeros((12, 33), dtype=bool)
    wide[::2, ::3] = blocked
    bytes_of = np.where(blocked, 7, 0).astype(np.uint8)
    read_only = blocked.copy()
    read_only.flags.writeable = False
    record = np.zeros((6, 11), dtype=[("x", "i1"), ("blocked", "?"), ("y", "i4")])
    record["blocked"] = blocked
    for array in (
        blocked,
        blocked.tolist(),
        np.asfortranarray(blocked),
        wide[::2, ::3],
        blocked[::-1, ::-1].copy()[::-1, ::-1],
        bytes_of.view(bool),
        read_only,
        record["blocked"],
        np.matrix(blocked),
        np.ma.masked_array(blocked),
    ):
        grid = mediant.Grid(array)
        assert grid.shape == (6, 11)
        assert np.array_equal(grid.to_numpy(), blocked)
        assert np.array_equal(np.asarray(grid), blocked)
        assert repr(grid) == f"<mediant.Grid of 6 \u00d7 11 cells, {blocked.sum()} blocked>"
    broadcast = mediant.Grid(np.broadcast_to(blocked[:1], (6, 11)))
    assert np.array_equal(broadcast.to_numpy(), np.repeat(blocked[:1], 6, axis=0))


@pytest.mark.parametrize("dtype", "i1 u1 i2 >i4 u8 i8 f2 f4 >f8 g".split())
def test_criteria(rng, dtype):
    """Above, below and values, alone and together, for all kinds of numbers."""
    numbers = rng.integers(0, 9, (5, 12)).astype(dtype)
    for above in (None, 5, 6.5):
        for below in (None, 2, 1.5):
            for values in (None, [4], {3, 4}, (7, 2.5), np.array([3, 1]), range(2)):
                if above is below is values is None:
                    continue
                wanted = np.zeros(numbers.shape, dtype=bool)
                for row, column in np.ndindex(numbers.shape):
                    x = float(numbers[row, column])
                    wanted[row, column] = (
                        (above is not None and x > above)
                        or (below is not None and x < below)
                        or (values is not None and x in [float(v) for v in values])
                    )
                grid = mediant.Grid(numbers, above=above, below=below, values=values)
                assert np.array_equal(grid.to_numpy(), wanted), (above, below, values)


def test_criteria_are_exact():
    """Integers are compared as integers."""
    large = np.array([[2**53, 2**53 + 1, 2**53 + 2]])
    for dtype in (np.int64, np.uint64):
        assert mediant.Grid(large.astype(dtype), above=2**53).to_numpy().tolist() == [[False, True, True]]
        assert mediant.Grid(large.astype(dtype), below=2**53 + 1).to_numpy().tolist() == [
            [True, False, False]
        ]
        assert mediant.Grid(large.astype(dtype), values=[2**53 + 1]).to_numpy().tolist() == [
            [False, True, False]
        ]


def test_nan():
    numbers = np.array([[0.0, np.nan, np.inf]])
    with pytest.raises(mediant.ArgumentError, match="array"):
        mediant.Grid(numbers, above=5)
    assert mediant.Grid(numbers, above=5, values=[np.nan]).to_numpy().tolist() == [[False, True, True]]
    with pytest.raises(mediant.ArgumentError, match="above"):
        mediant.Grid(numbers, above=np.nan)


@pytest.mark.parametrize("dtype", "u1 i4 i8 f4 f8".split())
def test_costs(dtype):
    """An array of costs is not taken for one of blocked cells: the error says what there is instead."""
    costs = np.array([[1, 1, 5], [1, 9, 1]], dtype=dtype)
    for call in (lambda: mediant.Grid(costs), lambda: mediant.Grid(costs > 0).edit((0, 0), costs)):
        with pytest.raises(TypeError, match="expected dtype bool") as error:
            call()
        assert "cost" in str(error.value) and "array > limit" in str(error.value)
        assert costs.dtype.name in str(error.value)
    assert mediant.Grid(costs > 4).to_numpy().tolist() == [[False, False, True], [False, True, False]]


def test_sizes_are_said_in_words():
    """Rows and columns by name: (40000, 3) is not 3 \u00d7 40000."""
    for array in (np.zeros((40000, 3), dtype=bool), np.zeros((40000, 3))):
        with pytest.raises(mediant.MapError, match="a map of 3 columns and 40000 rows: each side must have"):
            mediant.Grid(array, **({} if array.dtype == bool else {"above": 1}))
    data = mediant.Grid(np.zeros((4, 9), dtype=bool)).prepare("hpa", side=4).to_bytes()
    with pytest.raises(mediant.MismatchError, match="of 9 columns and 4 rows") as error:
        mediant.Grid(np.zeros((5, 8), dtype=bool)).index_from_bytes(data)
    assert "of 8 columns and 5 rows" in str(error.value)


TAKES_KEYWORDS = [call for call in calls.all_calls() if call.takes_more]


def test_calls_that_take_keywords_are_found():
    assert {"Grid", "Index"} == {call.owner for call in TAKES_KEYWORDS} and len(TAKES_KEYWORDS) >= 20


@pytest.mark.parametrize("call", TAKES_KEYWORDS, ids=str)
def test_unknown_keywords(call, tmp_path):
    """The error lists the keywords that the call has, and says what the package does not do."""
    things = calls.Things(tmp_path)
    good = things.good_call(call, [])
    with pytest.raises(TypeError, match=r"unexpected keyword argument 'kk'; the keywords are ") as error:
        things.call(call, {**good, "kk": 3})
    listed = str(error.value).split("the keywords are ")[1].split(", ")
    assert sorted(listed) == sorted({p.name for p in call.parameters if p.is_keyword})
    for name in ("weights", "cost_map"):
        with pytest.raises(
            TypeError, match=rf"'{name}' \(costs of cells are those of a grid: .*costs=.*\); the keywords"
        ):
            things.call(call, {**good, name: [[1.0]]})
    with pytest.raises(TypeError, match=r"does not wrap around\); the keywords"):
        things.call(call, {**good, "wrap": True})


def test_unknown_keywords_of_a_grid():
    blocked = np.zeros((2, 3), dtype=bool)
    with pytest.raises(TypeError, match=r"'weights' \(.*costs=.*\); the keywords are above, below, values,"):
        mediant.Grid(blocked, weights=np.ones((2, 3)))
    with pytest.raises(TypeError, match=r"unexpected keyword argument 'abov'; the keywords are above"):
        mediant.Grid(blocked, abov=3)


def test_places_of_arrays():
    """A grid that is made by hand has the place of the ROS map with the same numbers."""
    blocked = np.array([[0, 0, 1], [1, 0, 0]], dtype=bool)
    grid = mediant.Grid(blocked, resolution=0.5, origin=(1, -2, 0.25))
    assert (grid.world.resolution, grid.world.origin) == (0.5, (1.0, -2.0, 0.25))
    assert mediant.Grid(blocked, resolution=0.5, origin=[1, 2]).world.vertex_at(1.1, 2.1) == (1, 0)
    assert mediant.Grid(blocked * 9, above=3, resolution=2).world.origin == (0.0, 0.0, 0.0)
    assert mediant.Grid(blocked).world is None
    edited = grid.edit((0, 0), [[True]])
    assert (
        edited.world.origin == grid.world.origin and pickle.loads(pickle.dumps(grid)).world.origin[2] == 0.25
    )
    for wrong, name in [
        ({"origin": (1, 2)}, "origin: it needs"),
        ({"resolution": 0}, "resolution: "),
        ({"resolution": np.nan}, "resolution: "),
        ({"resolution": 1, "origin": (1, np.inf)}, "origin: "),
        ({"resolution": 1, "origin": (1,)}, "origin: "),
        ({"resolution": 1, "origin": (1, 2, 3, 4)}, "origin: "),
    ]:
        with pytest.raises(mediant.ArgumentError, match=name):
            mediant.Grid(blocked, **wrong)
    with pytest.raises(TypeError, match="origin: expected"):
        mediant.Grid(blocked, resolution=1, origin=3)


def slow_occupancy(cells, occupied, free, unknown):
    """Blocked cells by the words of the docstring, one by one, the highest row first."""

    def is_blocked(value):
        if 0 <= value <= free:
            return False
        return unknown == "blocked" or (occupied <= value <= 100)

    return [[is_blocked(int(value)) for value in row] for row in cells[::-1]]


@pytest.mark.parametrize("dtype", ["i1", ">i2", "i4", "i8"])
def test_occupancy(rng, dtype):
    """Cells of a message, in one row and as rows, with all thresholds."""
    cells = rng.choice([-1, 0, 1, 24, 25, 26, 50, 64, 65, 66, 99, 100, 101, -2], (7, 5)).astype(dtype)
    for occupied, free in [(65, 25), (50, 50), (24, 66), (0, 0), (100, 0), (65.5, 24.5)]:
        for unknown in ("blocked", "free"):
            how = {"resolution": 0.05, "occupied": occupied, "free": free, "unknown": unknown}
            wanted = slow_occupancy(cells, occupied, free, unknown)
            flat = cells.ravel()
            for grid in (
                mediant.Grid.from_occupancy(flat, 5, 7, **how),
                mediant.Grid.from_occupancy(flat.tolist(), 5, **how),
                mediant.Grid.from_occupancy(tuple(flat.tolist()), width=5, **how),
                mediant.Grid.from_occupancy(cells, **how),
                mediant.Grid.from_occupancy(np.asfortranarray(cells), None, 7, **how),
                mediant.Grid.from_occupancy(np.ma.masked_equal(cells, -1), **how),
            ):
                assert grid.to_numpy().tolist() == wanted, how
    message = array_of("b", [0, 100, -1, 0])
    grid = mediant.Grid.from_occupancy(message, 2, 2, resolution=0.5, origin=(1, 2, 0))
    assert grid.to_numpy().tolist() == [[True, False], [False, True]]
    masked = np.ma.masked_array([[0, 0]], mask=[[False, True]])
    assert mediant.Grid.from_occupancy(masked, resolution=1).to_numpy().tolist() == [[False, True]]


def test_occupancy_is_the_file_that_was_saved(tmp_path):
    """A message, and the file that a server would save of it, have the same cells in the same places."""
    cells = np.array([[0, 100, 0, 0], [-1, 0, 0, 100], [0, 0, 0, 0]])
    gray = {0: 254, 100: 0, -1: 205}
    pixels = " ".join(str(gray[int(cell)]) for cell in cells[::-1].ravel())
    (tmp_path / "room.pgm").write_text(f"P2 4 3 255 {pixels}")
    (tmp_path / "room.yaml").write_text(
        "image: room.pgm\nresolution: 0.5\norigin: [1, -2, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    saved = mediant.Grid.open(tmp_path / "room.yaml")
    grid = mediant.Grid.from_occupancy(cells.ravel(), 4, 3, resolution=0.5, origin=(1, -2, 0))
    assert grid == saved
    for place in [(1.1, -1.9), (2.9, -0.6), (1.6, -1.9), (0.9, -1.9)]:
        assert grid.world.vertex_at(*place) == saved.world.vertex_at(*place)
    # The occupied cell of the lowest row is the second one from the left.
    assert grid.to_numpy()[grid.world.vertex_at(1.6, -1.9)]


def test_occupancy_mistakes():
    cells = np.zeros(6, dtype=np.int8)
    for wrong, error, text in [
        ({}, mediant.ArgumentError, "occupancy: cells in one row need width="),
        ({"width": 4}, mediant.ArgumentError, "width: 6 cells do not fill rows of 4"),
        ({"width": 0}, mediant.ArgumentError, "width: 6 cells do not fill rows of 0"),
        ({"width": 3, "height": 3}, mediant.ArgumentError, "height: the cells are 3 columns and 2 rows"),
        ({"width": 3, "occupied": 101}, mediant.ArgumentError, "occupied: expected a percentage"),
        ({"width": 3, "free": -1}, mediant.ArgumentError, "free: expected a percentage"),
        ({"width": 3, "free": 0.25j}, TypeError, "free: expected a number"),
        ({"width": 3, "unknown": "wall"}, mediant.OptionError, "unknown: expected one of"),
        ({"width": 3, "occupancy": cells / 100}, TypeError, "occupancy: expected integers from -1 to 100"),
        ({"width": 3, "occupancy": cells > 0}, TypeError, "occupancy: expected integers"),
        ({"occupancy": np.zeros((0, 2), dtype="S2")}, TypeError, "occupancy: expected integers"),
        ({"occupancy": np.zeros((0, 2), dtype=bool)}, TypeError, "occupancy: expected integers"),
        ({"occupancy": [[], []]}, mediant.MapError, "of 0 columns and 2 rows"),
        ({"occupancy": cells.reshape(1, 2, 3)}, mediant.ArgumentError, "occupancy: expected one row or rows"),
        ({"width": 4, "occupancy": cells.reshape(2, 3)}, mediant.ArgumentError, "width: the cells are 3"),
        ({"occupancy": np.zeros((0, 3), dtype=int)}, mediant.MapError, "of 3 columns and 0 rows"),
    ]:
        with pytest.raises(error, match=text):
            mediant.Grid.from_occupancy(**{"occupancy": cells, "resolution": 1, **wrong})


def test_masked():
    with pytest.raises(mediant.ArgumentError, match="array"):
        mediant.Grid(np.ma.masked_array([[True, False]], mask=[[True, False]]))


def test_values(rng):
    """Equality, hash, id and pickle go by the content."""
    blocked = slow.random_map(rng, 7, 13, 0.4)
    grid, same, other = mediant.Grid(blocked), mediant.Grid(blocked.tolist()), mediant.Grid(~blocked)
    assert grid == same and grid is not same and grid != other and grid != blocked.tolist() and grid != None  # noqa: E711
    assert (hash(grid), grid.id) == (hash(same), same.id) and grid.id != other.id
    assert mediant.Grid(blocked.T).id != grid.id
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(grid, protocol)) == grid
    grid.to_numpy()[:] = True
    assert grid == same
    rows = ["".join(".#"[cell] for cell in row) for row in blocked.astype(int)]
    assert mediant.Grid.from_rows(rows) == mediant.Grid.from_rows(iter(rows)) == grid


def test_edit(rng):
    """A rectangle is replaced in a new grid; the old one stays."""
    blocked = slow.random_map(rng, 8, 15, 0.3)
    grid = mediant.Grid(blocked)
    for _ in range(50):
        row, column = (int(rng.integers(side)) for side in blocked.shape)
        rows, columns = int(rng.integers(1, 9 - row)), int(rng.integers(1, 16 - column))
        new = rng.random((columns, rows)).T < 0.4
        wanted = grid.to_numpy()
        wanted[row : row + rows, column : column + columns] = new
        before, grid = grid, grid.edit((row, column), new)
        assert np.array_equal(grid.to_numpy(), wanted)
        assert before.edit((row, column), np.zeros((0, 1), dtype=bool)) == before
    assert np.array_equal(mediant.Grid(blocked).to_numpy(), blocked)
    for at, shape in [
        ((0, 0), (9, 1)),
        ((0, 0), (1, 16)),
        ((7, 14), (2, 1)),
        ((-1, 0), (1, 1)),
        ((8, 0), (1, 1)),
    ]:
        with pytest.raises(mediant.MapError, match="at"):
            grid.edit(at, np.zeros(shape, dtype=bool))


@pytest.mark.parametrize("rule", slow.RULES)
def test_rules_of_motion(rng, rule):
    """Free vertices, lines of sight and connected vertices, held to the slow rules."""
    blocked = slow.random_map(rng, 7, 11, 0.3)
    grid, oracle, how = mediant.Grid(blocked), slow.Slow(blocked, rule), slow.motion(rule)
    rows, columns = oracle.shape
    for row in range(-1, rows + 1):
        for column in range(-1, columns + 1):
            inside = 0 <= row < rows and 0 <= column < columns
            assert grid.is_free((row, column), **how) == (inside and oracle.is_free((row, column)))
    vertices, seen = oracle.vertices(), 0
    for _ in range(800):
        start, goal = (vertices[i] for i in rng.integers(len(vertices), size=2))
        assert grid.sees(start, goal, **how) == oracle.sees(start, goal), (start, goal)
        seen += oracle.sees(start, goal)
    assert 50 < seen < 750
    for k in (2, 3, 4):
        source = next(at for at in vertices if oracle.is_free(at))
        reached = np.isfinite(oracle.distances(k, [source])[0])
        for at in vertices:
            assert grid.connected(source, at, k=k, **how) == reached[at], (k, source, at)


@pytest.mark.parametrize("rule", slow.RULES)
def test_check(rng, rule):
    """A path holds exactly if all its segments are legal, over N(k) or not; up to where is said."""
    blocked = slow.random_map(rng, 6, 10, 0.15)
    grid, oracle, how = mediant.Grid(blocked), slow.Slow(blocked, rule), slow.motion(rule)
    free = [at for at in oracle.vertices() if oracle.is_free(at)]
    held = 0
    for _ in range(400):
        path = [free[i] for i in rng.integers(len(free), size=int(rng.integers(1, 4)))]
        if rng.random() < 0.5:
            path = [free[rng.integers(len(free))]]
            for _ in range(3):
                near = [at for at in free if at != path[-1] and oracle.sees(path[-1], at)]
                if near:
                    path.append(near[rng.integers(len(near))])
        if len(set(path)) < len(path):
            continue
        wanted = oracle.is_path(path) is None
        held += wanted
        assert grid.holds(path, **how) == grid.holds(np.array(path), **how) == wanted, path
        if wanted:
            assert grid.check(path, **how) is None
            continue
        with pytest.raises(mediant.BrokenPathError) as caught:
            grid.check(path, **how)
        assert caught.value.code == "broken-path"
        up_to = caught.value.holds_up_to
        assert 0 <= up_to < len(path)
        again = pickle.loads(pickle.dumps(caught.value))
        assert (str(again), again.holds_up_to, again.code) == (str(caught.value), up_to, "broken-path")
    assert held > 40


def test_a_path_holds_up_to_a_blocked_goal():
    grid = mediant.Grid.from_rows(["...", "..#"])
    for path, holds in [
        ([(1, 0), (0, 0), (0, 2), (1, 2)], 3),
        ([(1, 0), (0, 0), (0, 2), (0, 9)], 3),
        ([(1, 2), (0, 2)], 0),
    ]:
        with pytest.raises(mediant.BrokenPathError) as caught:
            grid.check(path)
        assert caught.value.holds_up_to == holds, path


def test_paths_have_waypoints_where_they_turn():
    grid = mediant.Grid.from_rows(["#.", ".."])
    path = grid.path((0, 2), (2, 0), k=2, placement="corner", smooth="linear")
    assert path.tolist() == [[0, 2], [2, 0]]


def test_fewest_moves_may_pass_a_closed_gap():
    grid = mediant.Grid.from_rows(["..#.", "#...", ".#.."])
    path = grid.path((0, 2), (1, 4), k=5, gap="closed", engine="wavefront", points="vertices")
    assert len(path) == 3 and grid.holds(path, gap="closed")


def test_the_nearest_vertex_is_the_same_for_all_engines():
    grid = mediant.Grid.from_rows(["...", "#.#"])
    for engine in ("astar", "dijkstra", "jps", "jps-block", "canonical", "subgoal"):
        for wishes in ({}, {"tolerance": 0.5}):
            answer = grid.find((0, 0), (1, 2), nearest=True, engine=engine, **wishes)
            assert (answer.status, answer.path[-1].tolist()) == ("nearest", [0, 2]), (engine, wishes)


def test_segments_may_connect_more_than_four_moves():
    grid, how = mediant.Grid.from_rows([".#", "#."]), {"k": 2, "corners": "always"}
    assert grid.sees((0, 0), (1, 1), **how)
    for engine in ("theta", "lazy-theta"):
        answer = grid.find((0, 0), (1, 1), engine=engine, **how)
        assert (answer.status, answer.path.tolist()) == ("found", [[0, 0], [1, 1]])
        assert answer.lower_bound <= answer.distance == pytest.approx(2**0.5)
    assert grid.find((0, 0), (1, 1), engine="astar", **how).status == "unreachable"


def test_errors_say_row_and_column():
    grid = mediant.Grid(np.zeros((3, 8), dtype=bool)).edit((1, 6), [[True]])
    with pytest.raises(mediant.QueryError, match=r"start \(1, 6\).*blocked") as caught:
        grid.path((1, 6), (0, 0))
    assert caught.value.code == "start-blocked"
    with pytest.raises(mediant.QueryError, match=r"goal \(6, 1\) is outside.*\(2, 7\)") as caught:
        grid.path((0, 0), (6, 1))
    assert caught.value.code == "goal-outside"
    with pytest.raises(mediant.QueryError, match=r"query 1.*\(1, 6\)") as caught:
        grid.prepare().paths((0, 0), [(0, 1), (1, 6)])
    with pytest.raises(mediant.BrokenPathError, match=r"\(1, 6\)"):
        grid.check([(1, 0), (1, 7)])
    with pytest.raises(mediant.QueryError, match=r"\(8, 3\)"):
        grid.field((8, 3))


def test_files(tmp_path):
    """Pictures, rows first; a missing file is a FileNotFoundError, too."""
    file = tmp_path / "room.pgm"
    file.write_text("P2 4 2 255  255 0 90 255  255 255 255 10")
    wanted = [[False, True, True, False], [False, False, False, True]]
    for path in (file, str(file)):
        assert mediant.Grid.open(path).to_numpy().tolist() == wanted
    assert mediant.Grid.open(file, invert=True).to_numpy().tolist() == (~np.array(wanted)).tolist()
    assert mediant.Grid.open(file, threshold=0.2).to_numpy().sum() == 2
    assert mediant.Grid.open(file, threshold="0.2") == mediant.Grid.open(file, threshold=0.2)
    (tmp_path / "a.map").write_text("type octile\nheight 2\nwidth 3\nmap\n.@.\nG.T\n")
    assert mediant.Grid.open(tmp_path / "a.map") == mediant.Grid.from_rows([".@.", "G.T"])
    with pytest.raises(FileNotFoundError) as caught:
        mediant.Grid.open(tmp_path / "none.map")
    assert isinstance(caught.value, mediant.FileError)
    (tmp_path / "no.map").write_text("hello")
    with pytest.raises(mediant.FileError):
        mediant.Grid.open(tmp_path / "no.map")


def test_tiles_and_ros(tmp_path):
    """Characters are free or blocked by name, others an error; a ROS map is read as by nav2 since 2025."""
    for rows, tile in ((["#   #"], " "), (["010"], "0"), (["x.x"], "x")):
        with pytest.raises(mediant.MapError, match=f"found `{tile}`.*by `free` or `blocked`") as caught:
            mediant.Grid.from_rows(rows)
        assert caught.value.code == "map-tile"
    hall = mediant.Grid.from_rows(["#   #"], free=" ")
    assert hall.distance((0, 1), (0, 3)) == 2 and hall == mediant.Grid.from_rows(["#   #"], blocked="#")
    digits = mediant.Grid.from_rows(["010"], free="0", blocked="1")
    assert digits.to_numpy().tolist() == [[False, True, False]]
    assert mediant.Grid.from_rows([".sgS."]).distance((0, 0), (0, 4)) == 4
    for wrong in ({"free": ""}, {"free": "x", "blocked": "X"}):
        with pytest.raises(mediant.MediantError, match="free"):
            mediant.Grid.from_rows(["..."], **wrong)
    rock = mediant.Grid.from_rows(["##", "@@"])
    with pytest.raises(mediant.QueryError, match=r"\(1, 0\) is blocked, and no cell of the map is free"):
        rock.path((1, 0), (0, 0))
    (tmp_path / "a.map").write_text("type octile\nheight 2\nwidth 4\nmap\n.WW.\n.Ww.\n")
    assert mediant.Grid.open(tmp_path / "a.map", free="W").distance((0, 1), (1, 2)) == pytest.approx(2**0.5)
    (tmp_path / "a.pgm").write_bytes(b"P5 2 1 255 \xff\0")
    keys = "image: a.pgm, resolution: 1, origin: [0, 0, 0], negate: 0, occupied_thresh: 0.65, free_thresh: 0"
    (tmp_path / "a.yaml").write_text("{" + keys + "}")
    for options, wanted in (({}, [False, True]), ({"ros": 2}, [False, True]), ({"ros": 1}, [True, True])):
        assert mediant.Grid.open(tmp_path / "a.yaml", **options).to_numpy().tolist() == [wanted]
    with pytest.raises(mediant.MediantError, match="ros: expected 1 or 2, found 3"):
        mediant.Grid.open(tmp_path / "a.yaml", ros=3)


def test_world(tmp_path, rng):
    """Vertices in meters and back: y goes up from the lower left corner, which is turned by an angle."""
    (tmp_path / "room.pgm").write_text("P2 5 3 255 " + "254 " * 15)
    lines = ["image: room.pgm", "resolution: 0.5", "origin: [1.0, -2.0, 0.3]", "negate: 0"]
    (tmp_path / "room.yaml").write_text("\n".join([*lines, "occupied_thresh: 0.65", "free_thresh: 0.25", ""]))
    grid = mediant.Grid.open(tmp_path / "room.yaml")
    world = grid.world
    assert (grid.shape, world.resolution, world.origin) == ((3, 5), 0.5, (1.0, -2.0, 0.3))
    turn = np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]])
    for placement, shift, rows, columns in (("center", 0.5, 3, 5), ("corner", 0, 4, 6)):
        at = np.array([(r, c) for r in range(rows) for c in range(columns)])
        flat = np.stack([at[:, 1] + shift, 3 - at[:, 0] - shift], axis=1) * 0.5
        wanted = flat @ turn.T + [1, -2]
        assert world.point_of(at, placement=placement) == pytest.approx(wanted, abs=1e-12)
        assert world.point_of(at[4], placement=placement) == pytest.approx(wanted[4], abs=1e-12)
        for vertex, local in zip(at.tolist(), flat):
            x, y = turn @ (local + (0 if placement == "center" else 1e-3 * (0.75 - local))) + [1, -2]
            assert world.vertex_at(x, y, placement=placement) == tuple(vertex)
    assert world.vertex_at(-50, 3) is None
    again = pickle.loads(pickle.dumps(grid))
    assert again == grid and again.world.origin == world.origin
    assert grid != mediant.Grid(grid.to_numpy())
    assert grid.edit((0, 0), [[True]]).world.origin == world.origin == grid.for_square(1).world.origin


def test_sizes():
    for shape in ((0, 3), (3, 0), (40000, 1), (1, 40000)):
        with pytest.raises(mediant.MapError, match="array"):
            mediant.Grid(np.zeros(shape, dtype=bool))
    assert mediant.Grid(np.zeros((1, 32768), dtype=bool)).distance((0, 0), (0, 32767)) == 32767
    assert mediant.Grid(np.zeros((32768, 1), dtype=bool)).distance((0, 0), (32767, 0)) == 32767
    with pytest.raises(mediant.MapError):
        mediant.Grid.from_rows(["..", "."])
    with pytest.raises(mediant.MapError):
        mediant.Grid.from_rows([])


def test_small_floats_are_not_rounded_to():
    a = np.array([[np.inf, 2048.0, 1.0]], "f2")
    assert mediant.Grid(a, above=1e6).to_numpy().tolist() == [[True, False, False]]
    assert mediant.Grid(a, below=2049).to_numpy().tolist() == [[False, True, True]]
    assert not mediant.Grid(a, values=[1e6]).to_numpy().any()
    assert mediant.Grid(a, values=[np.inf]).to_numpy().tolist() == [[True, False, False]]
    assert mediant.Grid(np.array([[0.1]], "f4"), values=[0.1]).to_numpy().all()


def test_neighbors_name_the_neighborhood_by_its_moves():
    grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    for neighbors, k in [(4, 2), (8, 3), (np.int64(16), 4), (4096, 12)]:
        by_moves = grid.path((0, 0), (2, 3), neighbors=neighbors)
        assert by_moves.tolist() == grid.path((0, 0), (2, 3), k=k).tolist()
        assert grid.prepare("astar", neighbors=neighbors).k == k
    with pytest.raises(mediant.OptionError, match="no 2\\^k neighborhood has 6 moves: choose 4 or 8"):
        grid.path((0, 0), (2, 3), neighbors=6)
    with pytest.raises(mediant.ArgumentError, match="neighbors"):
        grid.path((0, 0), (2, 3), k=3, neighbors=8)
    with pytest.raises(mediant.OptionError, match=r"k = 31: .* \(4 to 4096 neighbors\)"):
        grid.prepare("astar", neighbors=2**31)


def test_engines_and_infinity_have_several_names():
    grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    for name, engine in [
        ("A*", "astar"),
        ("JPS+", "jps-plus"),
        ("Theta*", "theta"),
        ("jps_block", "jps-block"),
    ]:
        assert grid.prepare(name).engine == engine
    for k in ["any", "inf", "∞", float("inf")]:
        assert grid.prepare("anya", k=k).k == "any"


def test_a_radius_in_meters_where_there_is_a_world(tmp_path):
    shades = " ".join("0" if (x, y) == (10, 5) else "254" for y in range(11) for x in range(21))
    (tmp_path / "m.pgm").write_text(f"P2 21 11 255 {shades}")
    (tmp_path / "m.yaml").write_text(
        "image: m.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.25\n"
    )
    grid = mediant.Grid.open(tmp_path / "m.yaml")
    assert (grid.for_disc(meters=0.22).to_numpy() == grid.for_disc(4.4).to_numpy()).all()
    assert (grid.for_disc(0.22).to_numpy() == grid.to_numpy()).all()
    for arguments in [{}, {"radius": 1, "meters": 1}]:
        with pytest.raises(mediant.ArgumentError, match="radius"):
            grid.for_disc(**arguments)
    with pytest.raises(mediant.ArgumentError, match="meters"):
        mediant.Grid.from_rows(["..."]).for_disc(meters=0.2)
    with pytest.raises(mediant.ArgumentError, match="meters"):
        grid.for_disc(meters=-0.2)
