"""The other libraries, each behind one face: a map made ready beforehand, a path per call, its length.

A library's own form of a map is made in the constructor and not timed, unless the library takes an array at
each call. `rule` says under which rules of Mediant the same paths are sought.
"""

from __future__ import annotations

import math
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

CARDINAL, DIAGONAL = 13860, 19601
"""Integer costs whose ratio is the square root of two but for 2e-9."""

RULES: dict[str, dict[str, Any]] = {
    "4": {"k": 2},
    "8": {"k": 3},
    "8, cutting corners": {"k": 3, "corners": "always"},
    "8, fewest steps": {"k": 3, "corners": "always", "engine": "wavefront"},
}
"""Rules of motion by name, as keywords of `Grid.path`."""

PREPARED = {"4": "subgoal", "8": "subgoal", "8, cutting corners": "jps-plus", "8, fewest steps": None}
"""The fastest engine that is prepared and takes the rules."""


def length(cells: Any, rule: str) -> float:
    """Return the length of a path, given by its cells or its waypoints, as the rule counts it."""
    steps = np.abs(np.diff(np.asarray(cells, dtype=np.int64).reshape(-1, 2), axis=0))
    if rule == "8, fewest steps":
        return float(steps.max(axis=1).sum())
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())


def graph_of(blocked: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Return the edges of the grid graph of 8 directions that cuts no corners: from, to, length."""
    rows, columns = blocked.shape
    free = ~blocked
    ids = np.arange(rows * columns).reshape(rows, columns)
    parts = []
    for dr, dc in ((0, 1), (1, 0), (1, 1), (1, -1)):
        here = (slice(0, rows - dr), slice(max(0, -dc), columns - max(0, dc)))
        there = (slice(dr, rows), slice(max(0, dc), columns - max(0, -dc)))
        legal = free[here] & free[there]
        if dr and dc:
            legal &= free[here[0], there[1]] & free[there[0], here[1]]
        parts.append((ids[here][legal], ids[there][legal], np.full(legal.sum(), math.hypot(dr, dc))))
    sources, targets, lengths = (np.concatenate(part) for part in zip(*parts))
    return np.r_[sources, targets], np.r_[targets, sources], np.r_[lengths, lengths]


class Peer:
    """A library: its name, the package, the rules, how many queries of a map it is asked."""

    name = ""
    package = ""
    rule = "8"
    queries = 20

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        raise NotImplementedError

    def reset(self) -> None:
        """Make ready for the next query; not timed."""

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        """Find a path; timed."""
        raise NotImplementedError

    def cells(self, found: Any, start: tuple[int, int]) -> Any:
        """Return the cells of what `path` found; not timed."""
        return found


class Pyastar(Peer):
    """pyastar2d: takes an array of weights at each call."""

    name, package, rule, queries = "pyastar2d", "pyastar2d", "4", 50
    diagonal = False

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        import pyastar2d

        self.weights = np.where(blocked, np.inf, 1).astype(np.float32)
        self.call = pyastar2d.astar_path

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        return self.call(self.weights, start, goal, allow_diagonal=self.diagonal)


class PyastarDiagonal(Pyastar):
    """pyastar2d with diagonal steps, each as long as a straight one."""

    name, rule, diagonal = "pyastar2d, allow_diagonal", "8, fewest steps", True


class PyastarBesideShortest(PyastarDiagonal):
    """The same, beside shortest paths. Its own are longer: it does not count lengths."""

    name, rule = "pyastar2d, beside shortest paths", "8, cutting corners"


class SkimageRoute(Peer):
    """scikit-image: takes an array of costs at each call."""

    name, package, rule = "skimage route_through_array", "scikit-image", "8, cutting corners"

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        from skimage.graph import route_through_array

        self.costs = np.where(blocked, np.inf, 1.0)
        self.call = route_through_array

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        return self.call(self.costs, start, goal)[0]


class SkimageMcp(Peer):
    """scikit-image: the object behind it, made once."""

    name, package, rule = "skimage MCP_Geometric", "scikit-image", "8, cutting corners"

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        from skimage.graph import MCP_Geometric

        self.mcp = MCP_Geometric(np.where(blocked, np.inf, 1.0))

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        self.mcp.find_costs([start], [goal])
        return self.mcp.traceback(goal)


class TcodAstar(Peer):
    """tcod: the older A*."""

    name, package, rule, queries = "tcod AStar", "tcod", "8, cutting corners", 50

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        from tcod.path import AStar

        self.finder = AStar((~blocked).astype(np.int8), diagonal=math.sqrt(2))

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        return self.finder.get_path(*start, *goal)

    def cells(self, found: Any, start: tuple[int, int]) -> Any:
        return [start, *found]


class TcodPathfinder(Peer):
    """tcod: the newer A*, with integer costs."""

    name, package, rule, queries = "tcod Pathfinder", "tcod", "8, cutting corners", 50

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        from tcod import path

        cost = (~blocked).astype(np.int8)
        self.make = path.Pathfinder
        self.graph = path.SimpleGraph(cost=cost, cardinal=CARDINAL, diagonal=DIAGONAL)

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        finder = self.make(self.graph)
        finder.add_root(start)
        return finder.path_to(goal)


class TcodPath2d(Peer):
    """tcod: one call, which takes an array of costs."""

    name, package, rule, queries = "tcod path2d", "tcod", "8, cutting corners", 50

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        from tcod.path import path2d

        self.cost = (~blocked).astype(np.int8)
        self.call = path2d

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        return self.call(
            self.cost, start_points=[start], end_points=[goal], cardinal=CARDINAL, diagonal=DIAGONAL
        )


class Pathfinding(Peer):
    """python-pathfinding: pure Python. Its grid is cleaned after each query, outside the time."""

    name, package, queries = "python-pathfinding A*", "pathfinding", 6

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        from pathfinding.core.diagonal_movement import DiagonalMovement
        from pathfinding.core.grid import Grid
        from pathfinding.finder.a_star import AStarFinder

        self.grid = Grid(matrix=(~blocked).astype(int).tolist())
        self.finder = AStarFinder(diagonal_movement=DiagonalMovement.only_when_no_obstacle)

    def reset(self) -> None:
        self.grid.cleanup()
        self.grid.dirty = False

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        grid = self.grid
        return self.finder.find_path(grid.node(*start[::-1]), grid.node(*goal[::-1]), grid)[0]

    def cells(self, found: Any, start: tuple[int, int]) -> Any:
        return [(node.y, node.x) for node in found]


class Networkx(Peer):
    """networkx: pure Python, on a graph made beforehand, with the octile distance as heuristic."""

    name, package, queries = "networkx astar_path", "networkx", 6

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        import networkx

        self.columns = blocked.shape[1]
        self.graph = networkx.Graph()
        sources, targets, lengths = graph_of(blocked)
        half = len(sources) // 2
        edges = zip(sources[:half].tolist(), targets[:half].tolist(), lengths[:half].tolist())
        self.graph.add_weighted_edges_from(edges)
        self.call = networkx.astar_path

    def octile(self, one: int, other: int) -> float:
        dr = abs(one // self.columns - other // self.columns)
        dc = abs(one % self.columns - other % self.columns)
        return max(dr, dc) + (math.sqrt(2) - 1) * min(dr, dc)

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        ids = (row * self.columns + column for row, column in (start, goal))
        return self.call(self.graph, *ids, heuristic=self.octile)

    def cells(self, found: Any, start: tuple[int, int]) -> Any:
        return [divmod(cell, self.columns) for cell in found]


class Scipy(Peer):
    """scipy: Dijkstra on a sparse matrix made beforehand, and the path out of the predecessors."""

    name, package, queries = "scipy dijkstra", "scipy", 12

    def __init__(self, blocked: NDArray[np.bool_]) -> None:
        from scipy.sparse import csr_array
        from scipy.sparse.csgraph import dijkstra

        self.columns = blocked.shape[1]
        sources, targets, lengths = graph_of(blocked)
        self.graph = csr_array((lengths, (sources, targets)), shape=(blocked.size, blocked.size))
        self.call = dijkstra

    def path(self, start: tuple[int, int], goal: tuple[int, int]) -> Any:
        source, at = (row * self.columns + column for row, column in (start, goal))
        _, before = self.call(self.graph, indices=source, return_predecessors=True)
        found = [at]
        while at != source:
            at = before[at]
            found.append(at)
        return found[::-1]

    def cells(self, found: Any, start: tuple[int, int]) -> Any:
        return [divmod(int(cell), self.columns) for cell in found]


PEERS: list[type[Peer]] = [
    Pyastar, PyastarDiagonal, PyastarBesideShortest, SkimageRoute, SkimageMcp, TcodAstar, TcodPathfinder,
    TcodPath2d, Scipy, Networkx, Pathfinding,
]  # fmt: skip


def skimage_field(blocked: NDArray[np.bool_]) -> Callable[[tuple[int, int]], NDArray[Any]]:
    """Make a call for distances by `MCP_Geometric.find_costs`, made beforehand."""
    from skimage.graph import MCP_Geometric

    mcp = MCP_Geometric(np.where(blocked, np.inf, 1.0))
    return lambda source: mcp.find_costs([source])[0]


def scipy_field(blocked: NDArray[np.bool_]) -> Callable[[tuple[int, int]], NDArray[Any]]:
    """Make a call for distances by `dijkstra`, on a matrix made beforehand."""
    peer = Scipy(blocked)
    shape = blocked.shape
    return lambda source: peer.call(peer.graph, indices=source[0] * shape[1] + source[1]).reshape(shape)


def tcod_field(blocked: NDArray[np.bool_]) -> Callable[[tuple[int, int]], NDArray[Any]]:
    """Make a call for distances by `dijkstra2d`, integers to be divided by `CARDINAL`."""
    from tcod.path import dijkstra2d, maxarray

    cost = (~blocked).astype(np.int8)

    def field(source: tuple[int, int]) -> NDArray[Any]:
        distances = maxarray(blocked.shape)
        distances[source] = 0
        return dijkstra2d(distances, cost, CARDINAL, DIAGONAL, out=distances)

    return field


FIELDS = [
    ("skimage MCP_Geometric.find_costs", "8, cutting corners", skimage_field),
    ("scipy dijkstra", "8", scipy_field),
    ("tcod dijkstra2d", "8, cutting corners", tcod_field),
]
"""Distance fields: the name, the rules, and what makes the call for a map."""
