"""Ray on two worker processes: the same answers, also when one of them is lost."""

from __future__ import annotations

import os
import time

import mediant
import psutil
import pytest
from conftest import COUNT, HOW, PART_ROWS, one_bad_row
from mediant import batch

os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
ray = pytest.importorskip("ray")


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    token = (
        tmp_path_factory.mktemp("ray") / "token"
    )  # Of this cluster only: none is left in the user's folder.
    token.write_text(os.urandom(32).hex())
    os.environ["RAY_AUTH_TOKEN_PATH"] = str(token)
    ray.init(
        num_cpus=2,
        include_dashboard=False,
        object_store_memory=400_000_000,
        _node_ip_address="127.0.0.1",
        logging_level="warning",
        log_to_driver=False,
    )
    caches()  # Both processes are there before the work begins.
    yield
    ray.shutdown()


def caches(processes=2):
    """The counts of the workers' caches, by the numbers of their processes."""

    @ray.remote(num_cpus=1)
    def info():
        time.sleep(0.2)  # So that the other worker takes the other task.
        return batch.cache.info()

    infos = {}
    end = time.monotonic() + 60
    while len(infos) < processes and time.monotonic() < end:
        infos.update({one["process"]: one for one in ray.get([info.remote() for _ in range(processes)])})
    return infos


def test_a_table_in_memory(cluster, maps, queries, same):
    same(batch.ray(queries, maps, partition_rows=PART_ROWS, **HOW))
    infos = caches()
    assert os.getpid() not in infos
    for info in infos.values():
        assert info["made"] == info["indexes"] == len(maps), f"an index is made once a process: {infos}"
    parts = -(-COUNT // PART_ROWS)  # Each has rows of all maps.
    assert sum(info["made"] + info["found"] for info in infos.values()) == parts * len(maps)


def test_a_worker_is_lost(cluster, maps, queries_file, same, killing):
    before = caches()

    def busy():
        """Ray renames a process after the task that it runs."""
        for process in psutil.Process().children(recursive=True):
            try:
                if "mediant.batch" in process.cmdline()[0]:
                    return process.pid
            except (psutil.Error, IndexError):
                continue
        return None

    def work(folder):
        return batch.ray(queries_file, maps, partition_rows=PART_ROWS, to=folder, **HOW)

    answer, victim = killing.run(work, busy)
    same(answer)
    after = caches()
    assert victim in before and victim not in after
    for process, info in after.items():
        assert info["made"] == info["indexes"] <= len(maps), f"an index is made once a process: {after}"
        assert process not in before or before[process]["made"] in (0, info["made"]), "nothing is made again"


def test_errors_of_workers(cluster, maps):
    with pytest.raises(mediant.QueryError, match=r"row 7 \(map 'rooms-8'\): ") as error:
        batch.ray(one_bad_row(), maps, partition_rows=2, invalid="raise")
    assert error.value.code == "start-outside"
