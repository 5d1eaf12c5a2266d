"""Tables in files and in parts, maps in files, and the cache of indexes."""

from __future__ import annotations

import pickle
import sys
import threading
from pathlib import Path

import mediant
import numpy as np
import pytest

pa = pytest.importorskip("pyarrow")

import pyarrow.parquet as pq  # noqa: E402
from mediant import batch  # noqa: E402
from mediant.batch import _parts  # noqa: E402
from mediant.batch._columns import narrow  # noqa: E402
from tables import ENDS, MAPS, SEED, a_map, a_table  # noqa: E402

pytestmark = pytest.mark.usefixtures("empty_cache")


def test_files_in(tmp_path):
    table = a_table(90)
    expected = batch.solve(table, MAPS)
    pq.write_table(table, tmp_path / "one.parquet", row_group_size=13)
    assert batch.solve(tmp_path / "one.parquet", MAPS).equals(expected)
    folder = tmp_path / "many"
    folder.mkdir()
    for at in range(9):
        pq.write_table(table.slice(at * 10, 10), folder / f"{at}.parquet")
    assert batch.solve(folder, MAPS).equals(expected)
    names = [folder / f"{at}.parquet" for at in (8, 0)]
    assert batch.solve(names, MAPS)["tag"].to_pylist() == [*range(80, 90), *range(10)]


def test_files_that_are_sorted_by_map(tmp_path):
    """Folders named map=… are how Spark, Dask and DuckDB write tables by key."""
    table = a_table(60)
    pq.write_to_dataset(table, tmp_path / "sorted", partition_cols=["map"])
    answer = batch.solve(tmp_path / "sorted", MAPS).sort_by("tag")
    assert answer["distance"].equals(batch.solve(table, MAPS)["distance"])


@pytest.mark.parametrize("to", [False, True])
@pytest.mark.parametrize("source", ["table", "file", "folder"])
def test_dask_without_a_cluster(tmp_path, source, to):
    pytest.importorskip("dask")
    table = a_table(200)
    expected = batch.solve(table, MAPS, paths=True)
    queries = table
    if source != "table":
        queries = tmp_path / "in" / ("queries.parquet" if source == "file" else "")
        (tmp_path / "in").mkdir()
        pq.write_table(table.slice(0, 150), tmp_path / "in" / "a.parquet", row_group_size=20)
        pq.write_table(table.slice(150), tmp_path / "in" / "b.parquet", row_group_size=70)
        if source == "file":
            queries = [tmp_path / "in" / "a.parquet", tmp_path / "in" / "b.parquet"]
    folder = tmp_path / "out" if to else None
    answer = batch.dask(queries, MAPS, paths=True, partition_rows=33, to=folder)
    if to:
        assert len(answer) >= 6 and answer == sorted(answer)
        assert sorted(str(path) for path in folder.iterdir()) == answer
        with pytest.raises(FileExistsError, match="part-000000"):
            batch.dask(queries, MAPS, to=folder)
        answer = pa.concat_tables([pq.read_table(path) for path in answer]).cast(expected.schema)
    assert answer.equals(expected), f"seed {SEED}"


def test_dask_of_an_empty_table(tmp_path):
    pytest.importorskip("dask")
    table = a_table(5).slice(0, 0)
    assert batch.dask(table, MAPS).equals(batch.solve(table, MAPS))
    assert batch.dask(table, MAPS, to=tmp_path / "out") == []
    pq.write_table(table, tmp_path / "none.parquet")
    assert batch.dask(tmp_path / "none.parquet", MAPS).equals(batch.solve(table, MAPS))


def test_dask_data_frame():
    pytest.importorskip("distributed")
    frames = pytest.importorskip("dask.dataframe")
    frame = a_table(100).to_pandas()
    answer = batch.dask(frames.from_pandas(frame, npartitions=4), MAPS, paths=True)
    back = answer.compute(scheduler="threads")
    assert list(back.columns) == list(answer.columns) and (back.dtypes == answer.dtypes).all()
    expected = batch.solve(frame, MAPS, paths=True)
    assert back["tag"].tolist() == list(range(100))
    back = pa.Table.from_pandas(back, preserve_index=False)
    for name in ("distance", "status", "path"):
        assert back[name].to_pylist() == expected[name].to_pylist(), f"{name}, seed {SEED}"
    with pytest.raises(ValueError, match="to_parquet"):
        batch.dask(frames.from_pandas(frame, npartitions=4), MAPS, to="here")


def test_errors_name_rows_of_the_whole_table(tmp_path):
    pytest.importorskip("dask")
    table = pa.table({name: [0] * 50 for name in ENDS})
    table = table.set_column(0, "start_row", pa.array([0] * 37 + [99] + [0] * 12))
    with pytest.raises(mediant.QueryError, match=r"row 37: ") as error:
        batch.dask(table, a_map(5, share=0.0), partition_rows=10, invalid="raise")
    assert error.value.code == "start-outside"
    pq.write_table(table.slice(0, 21), tmp_path / "a.parquet")
    pq.write_table(table.slice(21), tmp_path / "b.parquet", row_group_size=3)
    for rows in (4, 10, 100):
        with pytest.raises(mediant.QueryError, match=r"row 37: "):
            batch.dask(tmp_path, a_map(5, share=0.0), partition_rows=rows, invalid="raise")


def test_parts_are_cut_as_told(tmp_path):
    solver = batch.Solver(MAPS)
    pq.write_table(a_table(100), tmp_path / "a.parquet", row_group_size=8)
    pq.write_table(a_table(50), tmp_path / "b.parquet", row_group_size=50)
    parts = _parts.job_of(tmp_path, solver, 20, 1, None).parts
    assert [part.rows for part in parts] == [16, 16, 16, 16, 16, 20, 20, 20, 10]
    assert [part.first_row for part in parts] == [0, 16, 32, 48, 64, 80, 100, 120, 140]
    assert [part.read().num_rows for part in parts] == [part.rows for part in parts]
    for count, slots, rows in [(10, 4, 20_000), (800_000, 4, 50_000), (10**7, 2, 100_000)]:
        assert _parts._rows(count, slots) == rows


def test_few_bytes_are_sent():
    table = pa.table(
        {
            "start_row": pa.array([0, 255], pa.int64()),
            "start_column": pa.array([-1, 3], pa.int64()),
            "goal_row": pa.array([None, 70_000], pa.int64()),
            "goal_column": pa.array([None, None], pa.int64()),
            "map": ["a", "a"],
            "tag": [1, 2],
        }
    )
    sent = narrow(table, True)
    kinds = ["uint8", "int16", "uint32", "int64"]
    assert [str(sent.schema.field(name).type) for name in ENDS] == kinds and sent.num_columns == 5
    assert sent.select(list(ENDS)).to_pylist() == table.select(list(ENDS)).to_pylist()
    part = _parts.OfTable.of(a_table(100_000).slice(500, 10), 500)
    assert len(part.data) < 5_000 and part.read().equals(a_table(100_000).slice(500, 10))


def test_no_half_of_a_file_is_left(tmp_path, monkeypatch):
    def fail(table, path):
        Path(path).write_bytes(b"PAR1")
        assert not list(tmp_path.glob("*.parquet"))
        raise OSError("the disk is full")

    monkeypatch.setattr(_parts.pq, "write_table", fail)
    with pytest.raises(OSError, match="the disk is full"):
        _parts._write(a_table(3), tmp_path / "part-000000.parquet")
    assert not list(tmp_path.iterdir())


def test_maps_or_indexes_are_sent():
    here = batch.Solver({"a": MAPS["a"]}, engine="jps-plus")
    for indexes, origin in [(False, "prepared"), (True, "loaded")]:
        there = pickle.loads(pickle.dumps(here.packed(threads=1, indexes=indexes)))
        batch.cache.clear()
        assert there(a_table(30, ["a"])).equals(here(a_table(30, ["a"])))
        assert there._index("a").origin == origin


def test_maps_can_be_files_and_indexes(tmp_path):
    grid = MAPS["a"]
    rows = ["".join("@" if cell else "." for cell in row) for row in grid.to_numpy()]
    height, width = grid.shape
    (tmp_path / "a.map").write_text(
        "\n".join(["type octile", f"height {height}", f"width {width}", "map", *rows, ""])
    )
    index = grid.prepare("jps-plus", k=3)
    index.save(tmp_path / "a.idx")
    table = a_table(60, ["a"])
    expected = batch.solve(table, {"a": grid}, engine="jps-plus")
    for one in (tmp_path / "a.map", str(tmp_path / "a.map")):
        assert batch.solve(table, {"a": one}, engine="jps-plus").equals(expected)
    for one in (index, (grid, tmp_path / "a.idx"), (str(tmp_path / "a.map"), str(tmp_path / "a.idx"))):
        assert batch.solve(table, {"a": one}).equals(expected)
        assert pickle.loads(pickle.dumps(batch.Solver({"a": one})))(table).equals(expected)
        with pytest.raises(mediant.MismatchError, match=r"k=2 \(it has 3\)"):
            batch.solve(table, {"a": one}, k=2)
        with pytest.raises(mediant.MismatchError, match=r"engine='astar' \(it has 'jps-plus'\)"):
            batch.solve(table, {"a": one}, engine="astar")
    with pytest.raises(mediant.MissingFileError, match=r"none\.map"):
        batch.solve(table, {"a": tmp_path / "none.map"})
    with pytest.raises(TypeError, match=r"the map 'a'.*found float"):
        batch.solve(table, {"a": 0.5})


def test_a_file_that_changes_is_read_again(tmp_path):
    path = tmp_path / "m.map"
    query = {"start_row": [0], "start_column": [0], "goal_row": [0], "goal_column": [2]}
    path.write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    assert batch.solve(query, path, k=2)["distance"].to_pylist() == [2.0]
    path.write_text("type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n")
    assert batch.solve(query, path, k=2)["distance"].to_pylist() == [4.0]


def test_mistakes_are_said_before_work_is_sent():
    with pytest.raises((mediant.OptionError, TypeError)):
        batch.Solver(MAPS, engine="teleport")
    with pytest.raises((mediant.OptionError, TypeError)):
        batch.Solver(MAPS, no_such_option=1)
    with pytest.raises(ValueError, match="at least 1"):
        batch.dask(a_table(3), MAPS, partition_rows=0)


def test_a_solver_of_another_version_is_refused(monkeypatch):
    data = pickle.dumps(batch.Solver(MAPS))
    monkeypatch.setattr(sys.modules["mediant.batch._solver"], "__version__", "0.0.1")
    with pytest.raises(mediant.MismatchError, match=r"received by mediant 0\.0\.1"):
        pickle.loads(data)


def test_wishes_reach_the_engine():
    walled = mediant.Grid.from_rows([".#."])
    query = {"start_row": [0], "start_column": [0], "goal_row": [0], "goal_column": [2]}
    assert batch.solve(query, walled)["status"].to_pylist() == ["unreachable"]
    assert batch.solve(query, walled)["distance"].to_pylist() == [np.inf]
    answer = batch.solve(query, walled, nearest=True, paths=True)
    assert answer["status"].to_pylist() == ["nearest"] and answer["distance"].to_pylist() == [0.0]
    assert answer["path"].to_pylist() == [[{"row": 0, "column": 0}]]
    wide = mediant.Grid(np.random.default_rng(SEED).random((60, 60)) < 0.2)
    ends = np.argwhere(~wide.to_numpy())[[0, -1]].ravel()
    query = {name: [int(at)] for name, at in zip(ENDS, ends)}
    answer = batch.solve(query, wide, engine="astar", max_expansions=1, paths=True)
    assert answer["status"].to_pylist() == ["stopped"]
    assert answer["distance"].to_pylist() == [None] and answer["path"].to_pylist() == [None]


def test_an_index_is_made_once():
    table = a_table(30)
    for _ in range(3):
        batch.solve(table, MAPS)
    info = batch.cache.info()
    assert (info["made"], info["found"], info["indexes"]) == (3, 6, 3)
    batch.solve(table, MAPS, k=2)
    assert batch.cache.info()["made"] == 6
    batch.solve(
        table, {key: mediant.Grid(grid.to_numpy()) for key, grid in MAPS.items()}
    )  # The same maps again.
    assert batch.cache.info()["made"] == 6


def test_threads_make_an_index_once():
    cache, made, gate = batch.Cache(1 << 30), [], threading.Barrier(8)
    index = MAPS["a"].prepare()

    def work():
        gate.wait()
        assert cache.get("key", lambda: made.append(1) or index) is index

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 1 and cache.info()["found"] == 7


def test_the_cache_is_bounded():
    indexes = {key: grid.prepare() for key, grid in MAPS.items()}
    cache = batch.Cache(1 << 30)
    for key in "ab":
        cache.get(key, lambda key=key: indexes[key])
    cache.limit_bytes = cache.info()["bytes"]
    assert cache.limit_bytes >= indexes["a"].memory_bytes + indexes["b"].memory_bytes
    for key in "aba":
        cache.get(key, lambda key=key: indexes[key])
    assert cache.info()["made"] == 2
    cache.get("c", lambda: indexes["c"])
    assert cache.info()["dropped"] >= 1 and cache.info()["bytes"] <= cache.limit_bytes
    cache.get("a", lambda: pytest.fail("a was used later than b, and was dropped before it"))
    cache.limit_bytes = 0
    cache.get("d", lambda: indexes["a"])
    assert cache.info()["indexes"] == 1  # The last one stays, however large.
    cache.get("d", lambda: pytest.fail("it was not kept"))


def test_a_failure_is_not_kept():
    cache = batch.Cache(1 << 30)
    with pytest.raises(ZeroDivisionError):
        cache.get("key", lambda: 1 / 0)
    assert cache.info()["indexes"] == 0
    assert cache.get("key", lambda: MAPS["a"].prepare()).grid == MAPS["a"]
