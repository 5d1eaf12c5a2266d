"""A million queries over several maps, and their answers by one thread of one process.

Run apart from the other tests: `pytest tests/cluster`. Clusters are local, of two worker processes.
"""

from __future__ import annotations

import contextlib
import os
import signal
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import mediant
import numpy as np
import psutil
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from mediant import batch

COUNT = int(os.environ.get("MEDIANT_CLUSTER_QUERIES", 1_000_000))
SEED = 20_240_607
K = 3
PART_ROWS = 20_000
HOW = {"k": K, "paths": True}


def noise(seed: int, side: int, share: float) -> mediant.Grid:
    """Cells that are blocked at random."""
    return mediant.Grid(np.random.default_rng(seed).random((side, side)) < share)


def rooms(seed: int, side: int, width: int) -> mediant.Grid:
    """A maze of rooms: a tree of doors joins all of them, and a few more doors make ways round."""
    random = np.random.default_rng(seed)
    count = (side - 1) // (width + 1)
    blocked = np.ones((side, side), dtype=bool)
    corner = 1 + np.arange(count) * (width + 1)
    for row in corner:
        for column in corner:
            blocked[row : row + width, column : column + width] = False
    seen, stack = {(0, 0)}, [(0, 0)]
    while stack:
        here = stack[-1]
        steps = random.permutation([(0, 1), (1, 0), (0, -1), (-1, 0)])
        near = [(here[0] + int(r), here[1] + int(c)) for r, c in steps]
        fresh = [there for there in near if min(there) >= 0 and max(there) < count and there not in seen]
        there = fresh[0] if fresh else None
        if there is None:
            stack.pop()
            continue
        _open_door(blocked, corner, here, there, int(random.integers(width)), width)
        seen.add(there)
        stack.append(there)
    for _ in range(count * count // 4):
        here = (int(random.integers(count - 1)), int(random.integers(count)))
        _open_door(blocked, corner, here, (here[0] + 1, here[1]), int(random.integers(width)), width)
    return mediant.Grid(blocked)


def _open_door(blocked, corner, here, there, at, width):
    low = min(here, there)
    if here[0] != there[0]:
        blocked[corner[low[0]] + width, corner[low[1]] + at] = False
    else:
        blocked[corner[low[0]] + at, corner[low[1]] + width] = False


@pytest.fixture(scope="session")
def maps():
    return {
        "noise-10": noise(1, 160, 0.10),
        "noise-30": noise(2, 192, 0.30),
        "rooms-8": rooms(3, 129, 8),
        "rooms-15": rooms(4, 256, 15),
    }


@pytest.fixture(scope="session")
def queries(maps):
    """Rows of all maps, mixed: most ends near each other, some far, some blocked, a few outside or null."""
    random = np.random.default_rng(SEED)
    names = np.array(list(maps))
    key = random.integers(len(names), size=COUNT)
    sides = np.array([grid.shape[0] for grid in maps.values()])[key]
    start = random.integers(0, sides[:, None], (COUNT, 2))
    far = random.random((COUNT, 1)) < 0.02
    goal = np.where(
        far, random.integers(0, sides[:, None], (COUNT, 2)), start + random.integers(-40, 41, (COUNT, 2))
    )
    columns = {
        "map": pa.DictionaryArray.from_arrays(key.astype(np.int8), pa.array(names)),
        "start_row": pa.array(start[:, 0], mask=random.random(COUNT) < 0.001),
        "start_column": pa.array(start[:, 1]),
        "goal_row": pa.array(goal[:, 0]),
        "goal_column": pa.array(goal[:, 1]),
        "tag": pa.array(np.arange(COUNT)),
    }
    return pa.table(columns)


def one_bad_row() -> pa.Table:
    """Queries of which only row 7 is invalid."""
    columns = {name: [1] * 12 for name in ("start_row", "start_column", "goal_row", "goal_column")}
    return pa.table({"map": ["rooms-8"] * 12, **columns, "start_row": [1] * 7 + [999] + [1] * 4})


@pytest.fixture(scope="session")
def queries_file(queries, tmp_path_factory):
    path = tmp_path_factory.mktemp("queries") / "queries.parquet"
    pq.write_table(queries, path, row_group_size=2 * PART_ROWS)
    return path


@pytest.fixture(scope="session")
def expected(maps, queries):
    """The local answer, by one thread."""
    begin = time.perf_counter()
    answer = batch.solve(queries, maps, threads=1, **HOW)
    print(f"\n{COUNT:,} queries by one thread: {time.perf_counter() - begin:.1f} s")
    statuses = set(answer["status"].to_pylist())
    assert statuses == {"found", "unreachable", "invalid"}, "each kind of answer takes part"
    return answer


@pytest.fixture
def same(expected):
    """Compare an answer with the local one, row for row."""

    def check(answer):
        assert answer.num_rows == expected.num_rows
        assert answer.column_names == expected.column_names
        for name in expected.column_names:
            one, other = answer[name], expected[name]
            if name in ("map", "status"):  # Dictionaries: their words count, not their numbers.
                one, other = one.cast(pa.string()), other.cast(pa.string())
            if not one.equals(other):
                row = next(at for at in range(len(one)) if one[at].as_py() != other[at].as_py())
                pytest.fail(
                    f"{name!r} differs in row {row}: {answer.slice(row, 1).to_pylist()} (seed {SEED})"
                )

    return check


class Killing:
    """Kills a worker process when some parts of the answer are written, but not all."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.parts = -(-COUNT // PART_ROWS)

    def run(self, work, choose):
        """Run `work(folder)`, and meanwhile kill the process that `choose()` names.

        Returns the answer, and the number of the process that was killed.
        """
        with ThreadPoolExecutor(1) as pool:
            killer = pool.submit(self._kill, choose)
            names = work(self.folder)
            victim, there = killer.result()
        print(f"\nprocess {victim} was killed with {there} of {self.parts} parts written")
        assert 0 < there < self.parts, "the worker was not killed midway"
        assert names == [str(self.folder / f"part-{at:06}.parquet") for at in range(self.parts)]
        return pa.concat_tables([pq.read_table(name) for name in names]), victim

    def _kill(self, choose) -> tuple[int, int]:
        end = time.monotonic() + 100
        while self._count() < max(1, self.parts // 6) or (victim := choose()) is None:
            assert time.monotonic() < end, f"{self._count()} of {self.parts} parts, and no busy worker"
            time.sleep(0.005)
        os.kill(victim, signal.SIGKILL)
        there = self._count()
        with contextlib.suppress(psutil.NoSuchProcess, psutil.TimeoutExpired):
            psutil.Process(victim).wait(30)
        assert not psutil.pid_exists(victim) or psutil.Process(victim).status() == psutil.STATUS_ZOMBIE
        return victim, there

    def _count(self) -> int:
        return len(list(self.folder.glob("part-*.parquet")))


@pytest.fixture
def killing(tmp_path):
    (tmp_path / "answer").mkdir()
    return Killing(tmp_path / "answer")
