"""Tables of queries: what goes in, what comes out, and in which words it fails."""

from __future__ import annotations

import pickle
import sys

import mediant
import numpy as np
import pytest

pa = pytest.importorskip("pyarrow")

import pyarrow.parquet as pq  # noqa: E402
from mediant import batch  # noqa: E402
from tables import ENDS, MAPS, SEED, a_map, a_table  # noqa: E402

pytestmark = pytest.mark.usefixtures("empty_cache")


def one_by_one(table, maps=MAPS, **how):
    """The slow way: a query at a time, by the plainest call."""
    answers = []
    for row in table.to_pylist():
        grid = maps[row["map"]]
        start, goal = (row["start_row"], row["start_column"]), (row["goal_row"], row["goal_column"])
        try:
            path, distance = grid.path(start, goal, **how), grid.distance(start, goal, **how)
        except mediant.QueryError:
            answers.append((None, "invalid", None))
            continue
        status = "found" if path is not None else "unreachable"
        answers.append((distance, status, None if path is None else path.tolist()))
    return answers


def as_rows(answer):
    """The answers as `one_by_one` gives them."""
    rows = zip(answer["distance"].to_pylist(), answer["status"].to_pylist(), answer["path"].to_pylist())
    return [(d, s, None if p is None else [[at["row"], at["column"]] for at in p]) for d, s, p in rows]


@pytest.mark.parametrize("k", [2, 3, 5])
@pytest.mark.parametrize("threads", [1, None])
def test_rows_are_answered_as_one_by_one(k, threads):
    table = a_table(400)
    answer = batch.solve(table, MAPS, k=k, engine="astar", paths=True, threads=threads)
    expected = one_by_one(table, k=k, engine="astar")
    assert as_rows(answer) == expected, f"seed {SEED}"
    assert {status for _, status, _ in expected} == {
        "found",
        "unreachable",
        "invalid",
    }  # All kinds took part.
    assert answer.select(table.column_names).equals(table)


def a_raster(seed):
    """A grid with costs, of which some cells are blocked."""
    random = np.random.default_rng([SEED, seed])
    costs = random.uniform(1, 9, size=(14, 19))
    return mediant.Grid(random.random(costs.shape) < 0.2, costs=costs, cell_size=(3, 2))


def test_rows_on_costs_are_answered_as_one_by_one():
    maps = {**MAPS, next(iter(MAPS)): a_raster(1)}
    table = a_table(200)
    answer = batch.solve(table, maps, k=4, engine="astar", paths=True)
    assert as_rows(answer) == one_by_one(table, maps, k=4, engine="astar"), f"seed {SEED}"
    # Those of one id are made once, wherever they came from.
    raster = a_raster(1)
    batch.solve(table.drop(["map"]), raster, k=4, engine="astar")
    assert batch.cache.info()["made"] == len(MAPS)
    batch.cache.clear()
    for _ in range(2):
        again = pickle.loads(pickle.dumps(batch.Solver(maps, k=4, engine="astar", paths=True)))
        assert again(table).equals(answer)
    assert batch.cache.info()["made"] == len(MAPS)
    assert batch.cache.info()["bytes"] >= 4 * raster.shape[0] * raster.shape[1]
    with pytest.raises(mediant.OptionError, match="costs"):
        batch.Solver(raster, engine="jps")
    with pytest.raises(mediant.OptionError, match="costs"):
        batch.Solver(maps, k=9)


def test_fields_of_many_sources(tmp_path):
    raster, plain = a_raster(2), mediant.Grid.from_rows(["....", ".##."])
    free = [tuple(map(int, at)) for at in np.argwhere(~raster.to_numpy())]
    sources = {"a": free[0], "b": free[5:9], 3: [free[-1]]}
    found = batch.fields(sources, raster, k=4, limit=40)
    for name, points in sources.items():
        assert np.array_equal(found[name], raster.distances(points, k=4, limit=40))
    written = batch.fields(sources, raster, k=4, limit=40, to=tmp_path / "fields")
    assert set(written) == set(found)
    assert all(np.array_equal(np.load(written[name]), found[name]) for name in sources)
    assert sorted(file.name for file in (tmp_path / "fields").iterdir()) == ["3.npy", "a.npy", "b.npy"]
    tiles = {"raster": raster, "plain": plain}
    found = batch.fields({1: ("raster", free[0]), 2: ("plain", (0, 0))}, tiles, threads=1)
    assert found[2].tolist() == plain.distances((0, 0)).tolist() and found[1].shape == raster.shape
    for wrong, maps in [
        ({"a": ("other", (0, 0))}, tiles),
        ({"a": 7}, tiles),
        ({"a": (0.5, 1)}, raster),
        ({"a": [1, 2, 3]}, raster),
    ]:
        with pytest.raises(batch.TableError, match="'a'"):
            batch.fields(wrong, maps)
    with pytest.raises(batch.TableError, match="name"):
        batch.fields({"../a": (0, 0)}, plain, to=tmp_path)
    with pytest.raises(mediant.QueryError):
        batch.fields({"a": (99, 0)}, plain)


class Spy:
    """An index that writes down what it is asked for."""

    def __init__(self, index, calls):
        self.index, self.calls = index, calls

    def __getattr__(self, name):
        self.calls.add(name)
        return getattr(self.index, name)


@pytest.mark.parametrize("wishes", [{}, {"nearest": False, "timeout": None}, {"max_expansions": 0}])
def test_what_asks_for_no_paths_makes_none(monkeypatch, wishes):
    table, calls, solver = a_table(300), set(), sys.modules["mediant.batch._solver"].Solver
    whole = batch.solve(table, MAPS, paths=True, **wishes)
    index = solver._index
    monkeypatch.setattr(solver, "_index", lambda self, key: Spy(index(self, key), calls))
    measured = batch.solve(table, MAPS, **wishes)
    assert calls == ({"paths"} if "max_expansions" in wishes else {"distances"})
    assert measured.equals(whole.select(measured.column_names)), f"seed {SEED}"


def test_chunks_and_groups_keep_the_order(monkeypatch):
    table = a_table(300)
    whole = batch.solve(table, MAPS, paths=True)
    monkeypatch.setattr(sys.modules["mediant.batch._solver"], "CHUNK", 7)
    seen = []
    parts = batch.solve(table, MAPS, paths=True, progress=lambda done, total: seen.append((done, total)))
    assert parts.equals(whole), f"seed {SEED}"
    assert seen[-1] == (300, 300) and len(seen) > 40 and seen == sorted(seen)


def test_types_of_the_answer():
    answer = batch.solve(a_table(20), MAPS, paths=True)
    assert answer.schema.field("distance").type == pa.float64()
    assert answer.schema.field("status").type == pa.dictionary(pa.int8(), pa.string())
    assert answer.schema.field("path").type == pa.large_list(
        pa.struct([("row", pa.int32()), ("column", pa.int32())])
    )
    assert "path" not in batch.solve(a_table(20), MAPS).column_names
    answer.validate(full=True)


def test_kinds_of_points():
    grid = mediant.Grid(np.zeros((5, 5), dtype=bool))
    query = {"start_row": [0], "start_column": [0], "goal_row": [4], "goal_column": [4]}
    lengths = [
        len(batch.solve(query, grid, paths=True, points=points)["path"][0].as_py())
        for points in ("waypoints", "vertices", "touched")
    ]
    assert lengths[0] == 2 and lengths[1] == 5 and lengths[2] >= 5


@pytest.mark.parametrize(
    "kind", [pa.int8(), pa.uint8(), pa.int16(), pa.uint16(), pa.int32(), pa.uint32(), pa.uint64()]
)
def test_every_type_of_integer(kind):
    table = pa.table({name: pa.array([0, 3], kind) for name in ENDS})
    assert batch.solve(table, a_map(5, share=0.0))["distance"].to_pylist() == [0.0, 0.0]


@pytest.mark.parametrize("huge", [2**63 - 1, -(2**63), 2**32, 2**31, -1])
def test_huge_numbers_are_outside(huge):
    table = pa.table({name: pa.array([0, huge if name == "goal_row" else 0], pa.int64()) for name in ENDS})
    assert batch.solve(table, a_map(5, share=0.0))["status"].to_pylist() == ["found", "invalid"]


@pytest.mark.parametrize("huge", [2**64 - 1, 2**63, 2**63 + 1])
def test_huge_unsigned_numbers_are_outside(huge):
    table = pa.table({name: pa.array([0, huge], pa.uint64()) for name in ENDS})
    assert batch.solve(table, a_map(5, share=0.0))["status"].to_pylist() == ["found", "invalid"]


def test_nulls_are_invalid():
    columns = {name: pa.array([0, 0, 0, None], pa.int32()) for name in ENDS}
    columns["start_row"] = pa.array([0, None, 0, 0], pa.int32())
    table = pa.table({"map": pa.array(["e", "e", None, "e"]), **columns})
    for snap in (False, True):  # Nowhere is not moved to somewhere.
        answer = batch.solve(table, {"e": a_map(5, share=0.0)}, paths=True, snap=snap)
        assert answer["status"].to_pylist() == ["found", "invalid", "invalid", "invalid"]
        assert answer["distance"].to_pylist() == [0.0, None, None, None]
        assert answer["path"].null_count == 3


@pytest.mark.parametrize("name", ["map", *ENDS])
def test_nulls_raise_if_told(name):
    table = a_table(4, ["a"]).set_column(0, "map", pa.array(["e"] * 4))
    at = table.column_names.index(name)
    table = table.set_column(at, name, pa.array([*table[name].to_pylist()[:2], None, None]))
    with pytest.raises(batch.TableError, match=f"column '{name}' is null in row 2") as error:
        batch.solve(table, {"e": a_map(5, share=0.0)}, invalid="raise")
    assert error.value.code == "null"


def test_invalid_ends_raise_if_told():
    grid = mediant.Grid.from_rows(["..#"])
    table = pa.table(
        {
            "map": [7, 7],
            "start_row": [0, 0],
            "start_column": [0, 0],
            "goal_row": [0, 0],
            "goal_column": [1, 2],
        }
    )
    with pytest.raises(mediant.QueryError, match=r"row 1 \(map 7\): ") as error:
        batch.solve(table, {7: grid}, invalid="raise")
    assert error.value.code == "goal-blocked"
    with pytest.raises(mediant.OptionError, match="'maybe'"):
        batch.solve(table, {7: grid}, invalid="maybe")


@pytest.mark.parametrize("name", ["map", *ENDS])
def test_missing_and_repeated_columns_are_named(name):
    table = a_table(3)
    with pytest.raises(batch.TableError, match=f"'{name}', found 0") as error:
        batch.solve(table.drop_columns([name]), MAPS)
    assert error.value.code == "missing-column"
    with pytest.raises(batch.TableError, match=f"'{name}', found 2") as error:
        batch.solve(table.append_column(name, table[name]), MAPS)
    assert error.value.code == "repeated-column"


@pytest.mark.parametrize("name", ["map", *ENDS])
def test_columns_of_another_type_are_named(name):
    table = a_table(3)
    table = table.set_column(table.column_names.index(name), name, pa.array([0.5, 1.0, 2.0]))
    with pytest.raises(batch.TableError, match=f"column '{name}' is of type double") as error:
        batch.solve(table, MAPS)
    assert error.value.code == "column-type"


@pytest.mark.parametrize("name", ["distance", "status", "path"])
def test_columns_that_are_there_already_are_named(name):
    with pytest.raises(batch.TableError, match=f"column '{name}' already"):
        batch.solve(a_table(3).append_column(name, pa.array([1, 2, 3])), MAPS, paths=True)


def test_unknown_keys_are_named():
    table = a_table(6, ["a"]).set_column(0, "map", pa.array(["a", "a", "z", "y", "a", "z"]))
    with pytest.raises(batch.TableError, match=r"'map' is '[yz]' in row [23],.* 'a', 'b', 'c'") as error:
        batch.solve(table, MAPS)
    assert error.value.code == "unknown-map"
    with pytest.raises(batch.TableError, match="column 'map' is 1 in row 0,"):
        batch.solve(a_table(1, [1]), {"1": a_map(1)})


@pytest.mark.parametrize(
    "encode",
    [
        lambda keys: pa.array(keys),
        lambda keys: pa.array(keys, pa.large_string()),
        lambda keys: pa.array(keys).dictionary_encode(),
        lambda keys: pa.chunked_array(
            [pa.array(keys[:3]).dictionary_encode(), pa.array(keys[3:]).dictionary_encode()]
        ),
    ],
)
def test_every_type_of_string(encode):
    table = a_table(40)
    other = table.set_column(0, "map", encode(table["map"].to_pylist()))
    assert batch.solve(other, MAPS).select(["distance"]).equals(batch.solve(table, MAPS).select(["distance"]))


def test_keys_can_be_integers():
    table = a_table(30, [0, 1, 2])
    maps = dict(enumerate(MAPS.values()))
    assert as_rows(batch.solve(table, maps, k=2, engine="astar", paths=True)) == one_by_one(
        table, maps, k=2, engine="astar"
    )


def test_one_map_needs_no_keys():
    table = a_table(30, ["a"])
    expected = batch.solve(table, MAPS)
    assert batch.solve(table, MAPS["a"]).equals(expected)
    assert batch.solve(table.drop_columns(["map"]), MAPS["a"]).equals(expected.drop_columns(["map"]))
    assert batch.solve(table, MAPS["a"].to_numpy()).equals(expected)


@pytest.mark.parametrize("maps", [MAPS, {}, MAPS["a"]])
def test_empty_tables(maps):
    table = a_table(3).slice(0, 0)
    answer = batch.solve(table, maps, paths=True)
    assert answer.num_rows == 0 and answer.column_names == [*table.column_names, "distance", "status", "path"]
    assert answer.schema == batch.solve(a_table(3), MAPS, paths=True).schema
    untyped = pa.table({name: pa.array([], pa.null()) for name in ("map", *ENDS)})
    assert batch.solve(untyped, maps).num_rows == 0
    assert batch.solve(pa.Table.from_batches([], table.schema), maps).num_rows == 0


def test_rows_of_no_map_at_all():
    table = a_table(3).set_column(0, "map", pa.nulls(3, pa.string()))
    assert batch.solve(table, {}, paths=True)["path"].null_count == 3


def test_slices_are_their_own_rows():
    table = a_table(100)
    assert batch.solve(table.slice(30, 50), MAPS, paths=True).equals(
        batch.solve(table, MAPS, paths=True).slice(30, 50)
    )


def test_kinds_of_tables():
    pandas = pytest.importorskip("pandas")
    table = a_table(50)
    expected = batch.solve(table, MAPS)["distance"]
    assert batch.solve(table.to_batches()[0], MAPS)["distance"].equals(expected)
    assert batch.solve(table.to_pydict(), MAPS)["distance"].equals(expected)
    frame = table.to_pandas()
    frame.index = [f"row {at}" for at in range(50)]
    back = batch.solve(frame, MAPS).to_pandas()
    pandas.testing.assert_frame_equal(back[frame.columns], frame)
    assert (back["status"] == "found").any()
    with pytest.raises(TypeError, match="found int"):
        batch.solve(5, MAPS)


def test_missing_numbers_of_pandas():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({name: [0, None] for name in ENDS})
    with pytest.raises(batch.TableError, match="Int64"):
        batch.solve(frame, MAPS["a"])
    assert batch.solve(frame.astype("Int64"), a_map(5, share=0.0))["status"].to_pylist() == [
        "found",
        "invalid",
    ]


def test_other_libraries_read_the_answer(tmp_path):
    answer = batch.solve(a_table(60), MAPS, paths=True)
    pq.write_table(answer, tmp_path / "answer.parquet")
    expected = [path for _, _, path in as_rows(answer)]
    polars = pytest.importorskip("polars")
    column = polars.read_parquet(tmp_path / "answer.parquet")["path"].to_list()
    assert [None if p is None else [list(at.values()) for at in p] for p in column] == expected
    duckdb = pytest.importorskip("duckdb")
    rows = duckdb.sql(f"select path[1].row from '{tmp_path / 'answer.parquet'}'").fetchall()
    assert [row for (row,) in rows] == [None if p is None else p[0][0] for p in expected]


def test_waypoints_are_arrays_again(tmp_path):
    answer = batch.solve(a_table(80), MAPS, paths=True)
    pq.write_table(answer, tmp_path / "answer.parquet")
    for table in (
        answer,
        pq.read_table(tmp_path / "answer.parquet"),
        pa.concat_tables([answer, answer]).slice(80),
    ):
        points, offsets = batch.waypoints(table["path"])
        assert points.dtype == np.int32 and offsets.dtype == np.int64 and len(offsets) == 81
        paths = [points[a:b].tolist() or None for a, b in zip(offsets, offsets[1:])]
        assert paths == [path for _, _, path in as_rows(answer)]
    some = (
        answer["path"].combine_chunks().slice(5, 9)
    )  # A slice of one array, whose offsets do not begin at 0.
    points, offsets = batch.waypoints(some)
    assert [points[a:b].tolist() or None for a, b in zip(offsets, offsets[1:])] == paths[5:14]
    with pytest.raises(batch.TableError, match="holds no paths"):
        batch.waypoints(answer["status"])
