"""The cost of a call from Python: paths one by one on a prepared map, and a million in one call.

    python overhead.py --data FOLDER [--map SET/MAP] [--queries 1000000]

The floor is a query to the next cell: hardly any search, and an array of two points.
"""

from __future__ import annotations

import argparse
import gc
import os
import time
from pathlib import Path
from typing import Any, Callable

import mediant
import numpy as np
import peers


def nanoseconds(
    call: Callable[..., Any], arguments: list[tuple[Any, ...]], rounds: int
) -> tuple[float, float]:
    """Return the mean and the median nanoseconds of a call: of each the least of the rounds."""
    means, medians = [], []
    for _ in range(rounds):
        times = []
        for one in arguments:
            before = time.perf_counter_ns()
            call(*one)
            times.append(time.perf_counter_ns() - before)
        means.append(float(np.mean(times)))
        medians.append(float(np.median(times)))
    return min(means), min(medians)


def one_by_one(index: mediant.Index, queries: list[peers.Query]) -> None:
    """Print what calls take."""
    points = [queries[0][0]] * 2000
    beside = neighbor(index.grid, points[0])
    near = [(point, beside) for point in points]
    arrays = [(np.array(start), np.array(goal)) for start, goal in queries]
    rows = [
        ("a call that does nothing", lambda start, goal: None, near),
        ("path to the next cell", index.path, near),
        ("distance to the next cell", index.distance, near),
        ("find to the next cell", index.find, near),
        ("path, the scenario's queries", index.path, queries),
        ("path, the same, ends as arrays", index.path, arrays),
        (
            "path, the same, every cell",
            lambda start, goal: index.path(start, goal, points="touched"),
            queries,
        ),
        ("distance, the same", index.distance, queries),
        ("find, the same", index.find, queries),
    ]
    print("| call | mean, ns | median, ns |\n|---|--:|--:|")
    for name, call, arguments in rows:
        mean, median = nanoseconds(call, arguments, 7)
        print(f"| {name} | {mean:,.0f} | {median:,.0f} |")


def neighbor(grid: mediant.Grid, cell: tuple[int, int]) -> tuple[int, int]:
    """Return a free cell next to another."""
    for dr, dc in ((0, 1), (1, 0), (0, -1), (-1, 0)):
        beside = (cell[0] + dr, cell[1] + dc)
        if min(beside) >= 0 and all(i < n for i, n in zip(beside, grid.shape)) and grid.is_free(beside):
            return beside
    raise ValueError(f"nothing beside {cell} is free")


def batches(index: mediant.Index, queries: list[peers.Query], count: int) -> None:
    """Print what a million queries in one call take."""
    chosen = np.random.default_rng(1).integers(len(queries), size=count)
    starts, goals = (np.array([query[end] for query in queries], dtype=np.int32)[chosen] for end in (0, 1))
    print("\n| call | threads | seconds | queries a second | µs of the processor a query |")
    print("|---|--:|--:|--:|--:|")
    for name, call in (("paths", index.paths), ("distances", index.distances)):
        for threads in (1, 2):
            seconds, used = [], []
            for _ in range(3):
                before, used_before = time.perf_counter(), time.process_time()
                result = call(starts, goals, threads=threads)
                seconds.append(time.perf_counter() - before)
                used.append(time.process_time() - used_before)
                assert len(result) == count
                del result
            least, each = min(seconds), min(used) / count * 1e6
            print(f"| {name} | {threads} | {least:.2f} | {count / least:,.0f} | {each:.2f} |")


def main() -> None:
    """Read the options and measure."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True, help="the folder of the zips")
    parser.add_argument("--map", default="room/16room_000", help="SET/MAP (default: %(default)s)")
    parser.add_argument("--queries", type=int, default=1_000_000, help="of a batch (default: %(default)s)")
    options = parser.parse_args()
    gc.disable()
    blocked = peers.read_map(options.data, options.map)
    queries = [query[:2] for query in peers.read_queries(options.data, options.map)]
    index = mediant.Grid(blocked).prepare("subgoal")
    print(f"{options.map}, {len(queries)} queries; {peers.machine()}, load {os.getloadavg()[0]:.1f}\n")
    one_by_one(index, queries)
    batches(index, queries, options.queries)


if __name__ == "__main__":
    main()
