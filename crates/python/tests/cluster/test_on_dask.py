"""Dask on two worker processes: the same answers, also when one of them is lost."""

from __future__ import annotations

import os

import mediant
import numpy as np
import pandas
import pyarrow as pa
import pytest
from conftest import COUNT, HOW, PART_ROWS, K, one_bad_row
from mediant import batch

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as one,
    ):
        yield one


def caches(client):
    """The counts of the workers' caches, by the numbers of their processes."""
    return {info["process"]: info for info in client.run(lambda: batch.cache.info()).values()}


@pytest.mark.filterwarnings("ignore:Sending large graph")  # The page says when to prefer files.
def test_a_table_in_memory(client, maps, queries, same):
    same(batch.dask(queries, maps, partition_rows=PART_ROWS, client=client, **HOW))
    infos = caches(client)
    assert len(infos) == 2 and os.getpid() not in infos
    for info in infos.values():
        assert info["made"] == info["indexes"] == len(maps), f"an index is made once a process: {infos}"
    parts = -(-COUNT // PART_ROWS)  # Each has rows of all maps.
    assert sum(info["made"] + info["found"] for info in infos.values()) == parts * len(maps)


def test_a_worker_is_lost(client, maps, queries_file, same, killing):
    before = caches(client)
    workers = client.run(os.getpid)

    def busy():
        return next((workers[address] for address, keys in client.processing().items() if keys), None)

    def work(folder):
        return batch.dask(queries_file, maps, partition_rows=PART_ROWS, client=client, to=folder, **HOW)

    answer, victim = killing.run(work, busy)
    same(answer)
    client.wait_for_workers(2, timeout=60)  # The nanny of the lost worker starts another one.
    after = caches(client)
    assert victim in before and victim not in after and len(after) == 2
    for process, info in after.items():
        assert info["made"] == info["indexes"] <= len(maps), f"an index is made once a process: {after}"
        assert process not in before or before[process]["made"] in (0, info["made"]), "nothing is made again"


def test_indexes_can_be_sent(client, maps, queries, expected):
    some = queries.slice(0, 10 * PART_ROWS)
    client.run(lambda: batch.cache.clear())
    answer = batch.dask(some, maps, partition_rows=PART_ROWS, client=client, ship=True, **HOW)
    assert answer["distance"].equals(expected["distance"].slice(0, 10 * PART_ROWS))
    assert answer["path"].equals(expected["path"].slice(0, 10 * PART_ROWS))
    for info in caches(client).values():
        assert info["made"] == len(maps)


def test_a_data_frame(client, maps, queries, expected):
    frames = pytest.importorskip("dask.dataframe")
    some = queries.slice(0, PART_ROWS)
    frame = frames.from_pandas(
        some.to_pandas(types_mapper={pa.int64(): pandas.Int64Dtype()}.get), npartitions=5
    )
    answer = batch.dask(frame, maps, client=client, k=K).compute()
    assert (
        pa.array(answer["distance"], from_pandas=True).to_pylist()
        == expected["distance"][:PART_ROWS].to_pylist()
    )
    assert answer["tag"].tolist() == list(range(PART_ROWS))


def test_errors_of_workers(client, maps):
    with pytest.raises(mediant.QueryError, match=r"row 7 \(map 'rooms-8'\): ") as error:
        batch.dask(one_bad_row(), maps, partition_rows=2, invalid="raise", client=client)
    assert error.value.code == "start-outside"


def test_fields_of_rasters(client, tmp_path):
    """Costs are the same by workers, in memory and in files; each worker opens a raster once."""
    random = np.random.default_rng(7)
    rasters = {
        key: mediant.Grid.from_costs(random.uniform(1, 9, size=(60, 90)), cell_size=(3, 2)) for key in "ab"
    }
    sources = {f"{key}-{n}": (key, random.integers(60, size=(3, 2))) for key in rasters for n in range(6)}
    client.run(lambda: batch.cache.clear())
    found = batch.fields(sources, rasters, k=4, client=client)
    written = batch.fields(sources, rasters, k=4, client=client, to=tmp_path)
    for name, (key, points) in sources.items():
        wanted = rasters[key].distances(points, k=4)
        assert np.array_equal(found[name], wanted) and np.array_equal(np.load(written[name]), wanted)
    assert all(info["made"] <= len(rasters) for info in caches(client).values())
