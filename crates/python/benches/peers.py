"""Compare the paths and times of Mediant with those of other Python libraries, on maps of MovingAI.

    python peers.py --data FOLDER --out FOLDER

FOLDER has SET-map.zip and SET-scen.zip of each set. Into the other folder come peers.json, peers.md,
peers.svg and peers.png. Everything runs in one process on one thread. The times of Mediant are taken beside
those of each library, on the same queries, in the same run. The length of every path is compared.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import platform
import sys
import time
import zipfile
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any, Callable

import mediant
import numpy as np
import others
import report
from numpy.typing import NDArray

MAPS = [
    "dao/brc202d",
    "bg512/AR0011SR",
    "sc1/Aftershock",
    "room/16room_000",
    "random/random512-10-0",
    "street/Moscow_2_1024",
]

Query = tuple[tuple[int, int], tuple[int, int]]


def read_map(data: Path, name: str) -> NDArray[np.bool_]:
    """Read a map out of its zip: True is blocked."""
    folder, stem = name.split("/")
    with zipfile.ZipFile(data / f"{folder}-map.zip") as archive:
        lines = archive.read(f"{stem}.map").decode("ascii").splitlines()
    return np.array([[cell not in ".GS" for cell in line] for line in lines[4:] if line])


def read_queries(data: Path, name: str) -> list[tuple[tuple[int, int], tuple[int, int], float]]:
    """Read the start, the goal and the published length of every instance of a map."""
    folder, stem = name.split("/")
    with zipfile.ZipFile(data / f"{folder}-scen.zip") as archive:
        lines = archive.read(f"{stem}.map.scen").decode("ascii").splitlines()
    fields = [line.split() for line in lines[1:] if line]
    return [((int(f[5]), int(f[4])), (int(f[7]), int(f[6])), float(f[8])) for f in fields]


def sample(items: Sequence[Any], count: int) -> list[Any]:
    """Return an even sample, without the first instances, which are shortest."""
    return [items[i] for i in np.linspace(0, len(items), count + 1).astype(int)[1:] - 1]


def timed(call: Callable[..., Any], *arguments: Any, **options: Any) -> tuple[int, Any]:
    """Return the nanoseconds of a call, and what it returned.

    From a millisecond on, time in which the machine did other things does not count.
    """
    used = time.process_time_ns()
    before = time.perf_counter_ns()
    result = call(*arguments, **options)
    passed = time.perf_counter_ns() - before
    used = time.process_time_ns() - used
    return passed if passed < 1_000_000 else min(used, passed), result


def per_query(call: Callable[..., Any], queries: Sequence[Query], rounds: int) -> NDArray[np.float64]:
    """Return the median of the rounds for each query, in microseconds, after a round to warm up."""
    if rounds > 1:
        for query in queries:
            call(*query)
    times = [[timed(call, *query)[0] for query in queries] for _ in range(rounds)]
    return np.median(np.array(times, dtype=float), axis=0) / 1000


def ours(blocked: NDArray[np.bool_], grid: mediant.Grid, rule: str) -> dict[str, Callable[..., Any]]:
    """Return the calls of Mediant under a rule: prepared, on a grid that is there, on one made anew."""
    how = others.RULES[rule]
    calls: dict[str, Callable[..., Any]] = {}
    if others.PREPARED[rule]:
        calls["prepared"] = grid.prepare(others.PREPARED[rule], threads=1, **how).path
    # The choice for a grid, but for fewest steps; and what the README names for a grid that is used once.
    often, once = {"engine": "jps-block"} | how, {"engine": "canonical"} | how
    calls["grid"] = lambda start, goal: grid.path(start, goal, **often)
    calls["array"] = lambda start, goal: mediant.Grid(blocked).path(start, goal, **once)
    return calls


def compare(
    peer_type: type[others.Peer], blocked: NDArray[np.bool_], grid: mediant.Grid, queries: list[Any]
) -> Any:
    """Measure one library on one map, and Mediant beside it."""
    rule = peer_type.rule
    chosen = [query[:2] for query in sample(queries, peer_type.queries)]
    peer = peer_type(blocked)
    calls = ours(blocked, grid, rule)
    theirs, difference = [], 0.0
    reference = calls.get("prepared", calls["grid"])
    peer.path(*chosen[0])
    for start, goal in chosen:
        peer.reset()
        nanoseconds, found = timed(peer.path, start, goal)
        peer.reset()
        if nanoseconds < 100_000_000:
            again = [nanoseconds] + [timed(peer.path, start, goal)[0] for _ in range(4)]
            nanoseconds = int(np.median(again))
        theirs.append(nanoseconds / 1000)
        our_length = others.length(reference(start, goal), rule)
        their_length = others.length(peer.cells(found, start), rule)
        difference = max(difference, abs(their_length - our_length) / our_length)
    result: dict[str, Any] = {
        "peer": peer.name,
        "rule": rule,
        "queries": len(chosen),
        "difference": difference,
    }
    result["theirs"] = summary(np.array(theirs))
    for way, call in calls.items():
        times = per_query(call, chosen, 3 if way == "array" else 15)
        ratios = np.array(theirs) / times
        result[way] = summary(times) | {
            "times_as_fast": float(np.sum(theirs) / np.sum(times)),
            "least": float(ratios.min()),
            "slower_on": int((ratios < 1).sum()),
        }
    return result


def summary(times: NDArray[np.float64]) -> dict[str, float]:
    """Return the mean and the median of times, in microseconds."""
    return {"mean": float(times.mean()), "median": float(np.median(times))}


def fields(blocked: NDArray[np.bool_], grid: mediant.Grid, source: tuple[int, int]) -> list[Any]:
    """Measure distance fields from one source."""
    results = []
    for name, rule, make in others.FIELDS:
        call = make(blocked)
        how = others.RULES[rule]
        grid.distances(source, **how)
        theirs, mine, cold = [], [], []
        for _ in range(5):
            nanoseconds, found = timed(call, source)
            theirs.append(nanoseconds)
            nanoseconds, distances = timed(grid.distances, source, **how)
            mine.append(nanoseconds)
            nanoseconds, fresh = timed(mediant.Grid, blocked)
            cold.append(nanoseconds + timed(fresh.distances, source, **how)[0])
        if np.issubdtype(found.dtype, np.integer):
            found = np.where(found == np.iinfo(found.dtype).max, np.inf, found / others.CARDINAL)
        assert (np.isinf(found) == np.isinf(distances)).all(), f"{name}: other vertices are reached"
        reached = np.isfinite(distances)
        results.append(
            {
                "peer": name,
                "rule": rule,
                "vertices": int(reached.sum()),
                "difference": float(np.abs(found[reached] - distances[reached]).max()),
                "theirs": float(np.median(theirs)) / 1e6,
                "ours": float(np.median(mine)) / 1e6,
                "array": float(np.median(cold)) / 1e6,
            }
        )
    return results


def measure(data: Path, names: Sequence[str], only: str | None) -> dict[str, Any]:
    """Measure everything."""
    peers = [peer for peer in others.PEERS if not only or only in peer.name]
    packages = sorted({peer.package for peer in others.PEERS} | {"numpy"})
    record: dict[str, Any] = {
        "machine": machine(),
        "python": platform.python_version(),
        "versions": {"mediant": mediant.__version__} | {name: version(name) for name in packages},
        "maps": {},
    }
    for name in names:
        blocked, queries = read_map(data, name), read_queries(data, name)
        grid = mediant.Grid(blocked)
        for start, goal, published in sample(queries, 50):
            # Some files have two decimals.
            assert abs(grid.distance(start, goal) - published) < 0.006 + 1e-5 * published, (name, start, goal)
        entry: dict[str, Any] = {
            "shape": blocked.shape,
            "load": os.getloadavg()[0],
            "paths": [],
            "fields": [],
        }
        for peer in peers:
            entry["paths"].append(compare(peer, blocked, grid, queries))
            gc.collect()
            print(name, report.line(entry["paths"][-1]), file=sys.stderr)
        if not only:
            entry["fields"] = fields(blocked, grid, queries[-1][0])
        record["maps"][name] = entry
    return record


def machine() -> str:
    """Return the kind of the processor, and how many the machine has."""
    cpu = Path("/proc/cpuinfo")
    lines = cpu.read_text().splitlines() if cpu.exists() else []
    models = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return f"{models[0] if models else platform.machine()}, {os.cpu_count()} processors"


def main() -> None:
    """Read the options, measure, write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True, help="the folder of the zips")
    parser.add_argument("--out", type=Path, required=True, help="the folder for the results")
    parser.add_argument("--maps", nargs="+", default=MAPS, help="SET/MAP (default: %(default)s)")
    parser.add_argument("--only", help="only the libraries whose names have this in them")
    parser.add_argument(
        "--again", action="store_true", help="write the table and the figure out of peers.json"
    )
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    file = options.out / "peers.json"
    if not options.again:
        gc.disable()
        file.write_text(json.dumps(measure(options.data, options.maps, options.only), indent=1) + "\n")
    record = json.loads(file.read_text())
    (options.out / "peers.md").write_text(report.table(record))
    report.figure(record, options.out)


if __name__ == "__main__":
    main()
