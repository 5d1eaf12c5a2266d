"""Ctrl-C ends long calls soon, and other Python threads go on during them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import mediant
import numpy as np
import pytest

# We promise about 50 ms on an idle machine. A busy one may take some more.
MOST_SECONDS = float(os.environ.get("MEDIANT_MOST_SECONDS", "0.5"))
SIDE = int(os.environ.get("MEDIANT_SIDE", "2048"))

SETUP = f"""
import json, os, signal, sys, threading, time
import mediant, numpy as np

rng = np.random.default_rng(5)
side = {SIDE}
blocked = rng.random((side, side)) < 0.2
# Start and goal are at the right; the wall between them has its only hole at the left.
open_map = np.zeros((side, side), dtype=bool)
blocked[:, 0] = blocked[:, -1] = False
blocked[:2, :2] = False
blocked[side // 2, 1:] = open_map[side // 2, 1:] = True
grid, wide = mediant.Grid(blocked), mediant.Grid(open_map)
start, goal = (0, side - 1), (side - 1, side - 1)
ends = [start, goal]
"""

COSTS = "numbers = rng.uniform(1, 9, blocked.shape)\ncostly = mediant.Grid(blocked, costs=numbers)\n"

# The preparation, and the call that is interrupted after it. The first search of a planner makes its scratch
# memory, which cannot be interrupted: `first` may take longer.
CALLS = {
    "first": ("index = grid.prepare('astar', k=5)", "index.path(start, goal)"),
    "astar": ("index = grid.prepare('astar', k=5)", "index.path(start, goal)"),
    "dijkstra": ("index = wide.prepare('dijkstra', k=4)", "index.path(start, goal)"),
    "theta": ("index = grid.prepare('theta')", "index.path(start, goal)"),
    "lazy-theta": ("index = wide.prepare('lazy-theta')", "index.path(start, goal)"),
    "anya": ("index = grid.prepare('anya')", "index.path(start, goal)"),
    "jps": ("index = grid.prepare('jps', k=4)", "index.path(start, goal)"),
    "timeout": ("index = grid.prepare('astar', k=5)", "index.path(start, goal, timeout=1000)"),
    "counters": ("index = grid.prepare('astar', k=5)", "index.find(start, goal, counters=True)"),
    "grid": ("grid.path((0, 0), (0, 0), k=5)", "grid.distance(start, goal, k=5)"),
    "steps": ("index = grid.prepare('astar', k=5)", "index.search(start, goal).finish()"),
    "steps with a trace": (
        "index = grid.prepare('astar', k=5)",
        "index.search(start, goal, trace=True).finish()",
    ),
    "exceptions": ("index = grid.prepare('astar', k=5)", "index.find_except(start, goal, blocked=(1, 1))"),
    "paths of a grid": ("grid.path((0, 0), (0, 0), k=5)", "grid.paths([start] * 99, goal, k=5)"),
    "prepare": (
        "index = mediant.Grid(blocked[:64, :64]).prepare()",
        "grid.prepare('subgoal', k=4, placement='corner')",
    ),
    # Where diagonal jumps have forced successors it takes longest.
    "prepare-jps": ("", "grid.prepare('jps-plus', corners='always')"),
    "batch": ("index = grid.prepare('astar', k=4)", "index.paths([start] * 99, [goal] * 99)"),
    "small-batch": (
        "index = mediant.Grid(blocked[:300, :300]).prepare('astar', k=4)\nstart, goal = (0, 0), (0, 0)",
        "index.distances(np.zeros((9_000_000, 2), dtype=int), (1, 1))",
    ),
    "table": ("index = grid.prepare('astar', k=4)", "index.table(ends, ends)"),
    "table of labels": (
        "index = mediant.Grid(blocked[:300, :300]).prepare('subgoal', levels='labels')\n"
        "ends = np.argwhere(~blocked[:300, :300])[:20_000]\nindex.table(ends[:9], ends[:9])",
        "index.table(ends, ends)",
    ),
    "nearest": ("index = grid.prepare('astar', k=4)", "index.nearest(ends, ends[::-1][:1])"),
    "field": ("", "grid.field(start, k=6)"),
    "any-angle field": ("", "grid.field(start, k='any')"),
    "space": (
        "",
        "mediant.Grid(blocked).is_free(start)\nwhile True: mediant.Grid(blocked[:9]).is_free(start)",
    ),
    "path on costs": (f"{COSTS}index = costly.prepare('astar', k=6)", "index.path(start, goal)"),
    "field on costs": (COSTS, "costly.field(start, k=6)"),
    "reading elevations": ("", "while True: mediant.Grid.from_elevation(1.0 * blocked, cell_size=1)"),
    "field over elevation": (
        "land = mediant.Grid.from_elevation(rng.uniform(1, 9, blocked.shape), cell_size=9)",
        "land.field(start, heading='from', k=6)",
    ),
    "reading costs": (COSTS, "while True: mediant.Grid(blocked, costs=numbers)"),
    "widest": ("", "grid.widest_path(start, goal, surplus=0.5, k=4)"),
}

PROGRAM = """
{setup}
{prepare}
if {is_warm} and "index" in globals():
    index.distance((0, 0), (0, 0))
def report():
    time.sleep({delay})
    moment.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)

moment, begin = [], time.perf_counter()
threading.Thread(target=report, daemon=True).start()
try:
    {call}
    print(json.dumps(["finished", time.perf_counter() - begin]))
    sys.exit()
except KeyboardInterrupt:
    waited = time.perf_counter() - moment[0]
index = globals().get("index") or grid.prepare("jps")
assert index.path((0, 0), (1, 1)) is not None
print(json.dumps(["interrupted", waited]), flush=True)
os._exit(0)
"""


@pytest.mark.parametrize("name", CALLS)
def test_interrupt(name, record_property):
    """The call raises KeyboardInterrupt soon after a SIGINT, and the index still answers."""
    prepare, call = CALLS[name]
    call = textwrap.indent(call, "    ").strip()
    program = PROGRAM.format(setup=SETUP, prepare=prepare, call=call, delay=0.05, is_warm=name != "first")
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False
    )
    assert run.returncode == 0, run.stderr
    what, seconds = json.loads(run.stdout)
    record_property("seconds", seconds)
    print(f"{name}: {what} after {1000 * seconds:.1f} ms")
    assert what == "interrupted"
    assert seconds < MOST_SECONDS * (4 if name == "first" else 1)


# The preparation, and the call that is repeated until it is interrupted. Nothing of it may go on.
ENDED = {
    "jps-block": ("", "grid.prepare('jps-block')"),
    "jps-plus": ("", "grid.prepare('jps-plus')"),
    "canonical": ("", "grid.prepare('canonical', k=5)"),
    "anya": ("", "grid.prepare('anya')"),
    "subgoal": ("", "grid.prepare('subgoal')"),
    "subgoal at corners": ("", "grid.prepare('subgoal', k='any')"),
    "labels": ("", "wide.prepare('subgoal', k='any', levels='labels')\n    grid.prepare('subgoal', k='any')"),
    "subgoal-theta": ("", "grid.prepare('subgoal-theta')"),
    "hpa": ("", "grid.prepare('hpa')"),
    "chpa": ("", "grid.prepare('chpa')"),
    "repair": (
        "index = grid.prepare('hpa')\nedited = grid.edit((5, 5), np.zeros((1500, 1500), dtype=bool))",
        "index.repair(edited)",
    ),
    "repair anew": (
        "index = grid.prepare('jps-block')\nedited = grid.edit((5, 5), [[True]])",
        "index.repair(edited)",
    ),
    "load": (
        "import tempfile\nfile = tempfile.mkdtemp() + '/index'\ngrid.prepare('hpa').save(file)",
        "grid.load(file)",
    ),
    "open": (
        "import tempfile\nfile = tempfile.mkdtemp() + '/map.pgm'\n"
        "open(file, 'wb').write(b'P5 %d %d 255\\n' % (side, side) + np.uint8(255 * ~blocked).tobytes())",
        "mediant.Grid.open(file)",
    ),
    "save": (
        "import tempfile\nfile = tempfile.mkdtemp() + '/index'\nindex = grid.prepare('hpa')",
        "index.save(file)",
    ),
    "to bytes": ("index = grid.prepare('hpa')", "index.to_bytes()"),
    "bytes": ("data = grid.prepare('chpa').to_bytes()", "grid.index_from_bytes(data)"),
    "field": ("", "grid.field((0, 0), k=6)"),
    "any-angle field": ("", "wide.field((0, 0), k='any')"),
    "clearance": ("", "grid.clearance()"),
    "disc": ("", "grid.for_disc(1.5)"),
    "square": ("", "grid.for_square(3)"),
    "widest": ("", "wide.widest_path((0, 0), goal, surplus=0.5)"),
    "table": ("index = grid.prepare('astar', k=4)", "index.table(ends, ends)"),
    "engine of a path": ("", "mediant.Grid(blocked).path(start, goal, engine='hpa')"),
    "space": ("", "mediant.Grid(blocked).is_free(start)"),
}

ENDED_PROGRAM = """
{setup}
{prepare}
def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

def report():
    time.sleep(0.05)
    os.kill(os.getpid(), signal.SIGINT)

before = resident()
threading.Thread(target=report, daemon=True).start()
try:
    while True:
        {call}
except KeyboardInterrupt:
    begin = time.process_time()
    time.sleep(0.1)
    used = time.process_time() - begin
print(json.dumps([used, resident() - before]), flush=True)
os._exit(0)
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="it reads the memory in use from /proc")
@pytest.mark.parametrize("name", ENDED)
def test_nothing_goes_on(name):
    """After a KeyboardInterrupt no hidden thread works on, and the memory of its work is given back."""
    prepare, call = ENDED[name]
    program = ENDED_PROGRAM.format(setup=SETUP, prepare=prepare, call=call.replace("\n    ", "; "))
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False
    )
    assert run.returncode == 0, run.stderr
    seconds, grown = json.loads(run.stdout)
    print(f"{name}: {1000 * seconds:.1f} ms of the next 100 ms, {grown >> 20} MiB")
    assert seconds < 0.02
    # Allocators and thread pools keep some for themselves.
    assert grown < 48 << 20


def test_timeout_covers_the_whole_call():
    """A timeout is that of the call: what it prepares counts."""
    blocked = np.random.default_rng(3).random((3000, 3000)) < 0.2
    blocked[0, 0] = blocked[-1, -1] = False
    for engine in ["subgoal", "hpa", "jps-block", "anya"]:
        how = {"engine": engine, "timeout": 0.02, **({"k": "any"} if engine == "anya" else {})}
        for name in ["find", "path", "distance"]:
            call = getattr(mediant.Grid(blocked), name)
            begin = time.perf_counter()
            if name == "find":
                answer = call((0, 0), (2999, 2999), **how)
            else:
                with pytest.raises(mediant.LimitReached, match="out of time while ") as caught:
                    call((0, 0), (2999, 2999), **how)
                answer = caught.value.answer
            assert time.perf_counter() - begin < 0.02 + MOST_SECONDS
            assert (answer.status, answer.stopped_by) == ("stopped", "timeout")
            assert answer.best.tolist() == [[0, 0]] and answer.lower_bound == 0


def test_handler_that_does_not_raise():
    """Another signal's handler runs during a search, which goes on."""
    grid, seen = mediant.Grid(np.zeros((1500, 1500), dtype=bool)), []
    index = grid.prepare("dijkstra", k=4)
    before = signal.signal(signal.SIGALRM, lambda *_: seen.append(time.perf_counter()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        assert index.distance((0, 0), (1499, 1499)) == pytest.approx(1499 * 2**0.5)
        end = time.perf_counter()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert len(seen) == 1 and seen[0] < end


def test_timeout_is_kept():
    """A search ends soon after its time."""
    index = mediant.Grid(np.zeros((2000, 2000), dtype=bool)).prepare("dijkstra", k=5)
    begin = time.perf_counter()
    answer = index.find((0, 0), (1999, 1999), timeout=0.1)
    assert answer.stopped_by == "timeout"
    assert 0.1 <= time.perf_counter() - begin < 0.1 + MOST_SECONDS
    assert 0 < answer.lower_bound <= 2000 * 2**0.5


RELEASED = {
    "path": lambda grid: grid.prepare("dijkstra", k=4).path((0, 0), (1499, 1499)),
    "find": lambda grid: grid.prepare("dijkstra", k=4).find((0, 0), (1499, 1499), counters=True),
    "paths": lambda grid: grid.prepare("dijkstra").paths([(0, 0)] * 3, [(1499, 1499)] * 3),
    "prepare": lambda grid: grid.prepare("hpa"),
    "nearest": lambda grid: grid.prepare("dijkstra").nearest([(0, 0)] * 3, (1499, 1499)),
    "field": lambda grid: grid.field((0, 0), k=5),
    "distances": lambda grid: grid.distances((0, 0), k=4),
    "clearance": lambda grid: [grid.clearance() for _ in range(4)],
}


@pytest.mark.parametrize("name", RELEASED)
def test_other_threads_go_on(name):
    """While a call works, another Python thread counts; with the GIL held it would stand still."""
    grid, count, stop = mediant.Grid(np.zeros((1500, 1500), dtype=bool)), [0], threading.Event()
    ticks = []

    def tick():
        while not stop.is_set():
            count[0] += 1
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    try:
        RELEASED[name](grid)
    finally:
        end = time.perf_counter()
        stop.set()
        thread.join()
    during = [moment for moment in [begin, *ticks, end] if begin <= moment <= end]
    longest = float(np.max(np.diff(during)))
    print(f"{name}: {end - begin:.3f} s, another thread stood still for {1000 * longest:.1f} ms at most")
    assert end - begin > 0.03
    assert longest < max(0.5 * (end - begin), 0.05)
