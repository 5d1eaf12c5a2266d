"""Calls of other libraries, answered by the engines of this one.

Each function has the name, the parameters, the result and the errors of the one that it stands in for, on
arrays in which all passable cells cost the same. Where several paths are equally good, it may return another
of them: costs are the same, cells need not be. A call that cannot be answered the same is an error, never
another answer: `mediant.OptionError`.

Every call makes a new grid of its array, as the originals do. For many paths on one map there is less to do:
``mediant.Grid(blocked).prepare(corners="always")`` has an index that answers much faster.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING, Any, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._mediant import Grid
from .errors import OptionError

if TYPE_CHECKING:
    from ._mediant import Engine

__all__ = ["Heuristic", "astar_path", "route_through_array"]

_NO_ROUTE = "no minimum-cost path was found to the specified end point"


def route_through_array(
    array: ArrayLike,
    start: Iterable[Any],
    end: Iterable[Any],
    fully_connected: bool = True,
    geometric: bool = True,
) -> tuple[list[tuple[int, int]], np.float64]:
    """Find a cheapest path, as `skimage.graph.route_through_array` does.

    Parameters
    ----------
    array : array_like of shape (rows, columns)
        The costs. Cells that are infinite or negative are impassable. All others must cost the same.
    start, end : iterable of int
        (row, column). Negative numbers count from the end, as indexes of arrays do.
    fully_connected : bool
        Whether paths may take diagonal steps. They pass between two impassable cells that touch at a corner.
    geometric : bool
        Whether the cost is the length of the path times the cost of a cell, a diagonal step being √2 long. If
        not, it is the number of cells, both ends included, times the cost of a cell.

    Returns
    -------
    path : list of tuple
        (row, column) of every cell, from start to end.
    cost : float
        The cost of the path. It differs from skimage's by rounding only.

    Raises
    ------
    ValueError
        An end lies outside the array, or no path leads from one to the other.
    IndexError
        The end's numbers are not integers. (The start's are truncated.)
    TypeError
        The array is not of numbers that a float64 can hold.
    mediant.OptionError
        The array has not two axes, or its passable cells have several costs, of which the start's may be one.

    Examples
    --------
    >>> import numpy as np
    >>> from mediant.compat import route_through_array
    >>> costs = np.ones((3, 4))
    >>> costs[:2, 1] = np.inf
    >>> path, cost = route_through_array(costs, (0, 0), (0, 2))
    >>> path
    [(0, 0), (1, 0), (2, 1), (1, 2), (0, 2)]
    >>> round(float(cost), 3)
    4.828
    """
    start, end = tuple(start), tuple(end)
    costs = np.asarray(array)
    if not np.can_cast(costs.dtype, np.float64):
        raise TypeError(f"cannot cast costs array to {np.float64}")
    first, last = _cell(start, costs.shape, "start"), _cell(end, costs.shape, "end")
    if costs.ndim != 2:
        raise OptionError(f"the array must have 2 axes, it has {costs.ndim}", "not-supported")
    if first == last:
        cells, cost = [last], 0.0 if geometric else float(costs[first])
    else:
        cells, cost = _route(costs, first, last, 3 if fully_connected else 2, geometric)
    if cost == math.inf:
        raise ValueError(_NO_ROUTE)
    if np.ndim(costs[end]) != 0:  # With floats NumPy raises an IndexError here, as it does there.
        raise OptionError(f"the end {end} must be two integers, not booleans", "not-supported")
    return cells, np.float64(cost)


def _cell(point: tuple[Any, ...], shape: tuple[int, ...], name: str) -> tuple[int, int]:
    """Count the indexes of a cell from zero on, and check them, as skimage does."""
    cell = []
    for i, n in zip(point if len(point) == len(shape) else (), shape):
        whole = int(i)
        cell.append(whole + n if whole < 0 else whole)
        if not 0 <= cell[-1] < n:
            break
    else:
        if cell:
            return tuple(cell)  # type: ignore[return-value]  # Arrays of other than two axes are refused later.
    raise ValueError(f"{name} points must all be within the costs array")


def _route(
    costs: NDArray[Any], first: tuple[int, int], last: tuple[int, int], k: int, geometric: bool
) -> tuple[list[tuple[int, int]], float]:
    """Return the cells of a cheapest path and its cost, which is infinite if there is none."""
    each = costs[last]
    if each < 0 or each == math.inf or costs[first] == math.inf:
        return [], math.inf
    same = costs == each
    others = costs[~same]
    if not np.all((others < 0) | (others == math.inf)):
        other = others[~((others < 0) | (others == math.inf))][0]
        raise _not_uniform(each, other, "infinite or negative ones")
    if not same[first]:
        raise OptionError(
            f"the start has the negative cost {costs[first]}, which only skimage takes. Give it the cost "
            f"{each} of the other cells",
            "not-supported",
        )
    # The fewest cells are not always those of a shortest path, so that they need an engine of their own. For
    # one path on a new grid, canonical A* is fastest.
    engine: Engine = "canonical" if geometric or k == 2 else "wavefront"
    answer = Grid(~same).find(first, last, k=k, corners="always", engine=engine, points="vertices")
    if answer.path is None:
        return [], math.inf
    cells = list(zip(answer.path[:, 0].tolist(), answer.path[:, 1].tolist()))
    mean = 0.5 * (float(each) + float(each))  # There, it is the mean of two cells, which overflows early.
    if not geometric:
        return cells, float(each) * len(cells)
    # `answer.distance` is rounded as searches do, to a multiple of 2**-32 for each move.
    diagonal = int(np.all(np.diff(answer.path, axis=0) != 0, axis=1).sum())
    return cells, mean * (len(cells) - 1 - diagonal + math.sqrt(2) * diagonal)


class Heuristic(IntEnum):
    """The heuristics of pyastar2d. The orthogonal ones are there to be named, and refused."""

    DEFAULT = 0
    ORTHOGONAL_X = 1
    ORTHOGONAL_Y = 2


def astar_path(
    weights: NDArray[np.float32],
    start: Sequence[SupportsIndex],
    goal: Sequence[SupportsIndex],
    allow_diagonal: bool = False,
    heuristic_override: int = Heuristic.DEFAULT,
) -> NDArray[np.int32] | None:
    """Find a path of the fewest steps, as `pyastar2d.astar_path` does.

    A diagonal step costs as much as a straight one there, so that a path of the fewest steps need not be the
    shortest. `mediant.Grid.path` counts lengths. For fewest steps Mediant has no search towards the goal:
    with diagonal steps, this is slower than the original on most maps.

    Parameters
    ----------
    weights : numpy.ndarray of float32, of shape (rows, columns)
        The costs of entering cells, at least 1. Infinite ones are impassable. All others must be the same but
        for the start's, which is never entered.
    start, goal : tuple of int
        (row, column), from zero on. The start may be impassable.
    allow_diagonal : bool
        Whether paths may take diagonal steps. They pass between two impassable cells that touch at a corner.
    heuristic_override : int
        0. The orthogonal heuristics of pyastar2d, 1 and 2, do not look for shortest paths.

    Returns
    -------
    numpy.ndarray of int32, of shape (n, 2), or None
        (row, column) of every cell, from start to goal. None if there is no path.

    Raises
    ------
    ValueError
        A weight is less than 1, or an end lies outside the array.
    AssertionError
        The weights are not of type float32.
    mediant.OptionError
        The passable cells have several weights, a weight is not a number, or the heuristic is an orthogonal
        one.

    Examples
    --------
    >>> import numpy as np
    >>> from mediant.compat import astar_path
    >>> weights = np.ones((3, 4), dtype=np.float32)
    >>> weights[:2, 1] = np.inf
    >>> astar_path(weights, (0, 0), (0, 2), allow_diagonal=True).tolist()
    [[0, 0], [1, 0], [2, 1], [1, 2], [0, 2]]
    """
    first, last = _ends_of_astar(weights, start, goal)
    if int(heuristic_override) in (Heuristic.ORTHOGONAL_X, Heuristic.ORTHOGONAL_Y):
        raise OptionError(
            "the heuristics ORTHOGONAL_X and ORTHOGONAL_Y do not find shortest paths, as Mediant does. Leave "
            "out heuristic_override",
            "not-supported",
        )
    if first == last:
        return np.array([last], dtype=np.int32)
    each = weights[last]
    if each == math.inf:
        return None
    blocked = weights != each
    blocked[first] = False
    others = weights[blocked]
    if not np.all(others == math.inf):
        raise _not_uniform(each, others[others != math.inf][0], "infinite ones")
    engine: Engine = "wavefront" if allow_diagonal else "canonical"
    path = Grid(blocked).path(
        first, last, k=3 if allow_diagonal else 2, corners="always", engine=engine, points="vertices"
    )
    if path is not None and float(each) * (len(path) - 1) > float(np.finfo(np.float32).max):
        return None  # There, a cost that overflows is no way.
    return path


def _ends_of_astar(
    weights: NDArray[np.float32], start: Sequence[SupportsIndex], goal: Sequence[SupportsIndex]
) -> tuple[tuple[int, int], tuple[int, int]]:
    """Check the arguments as pyastar2d does, in its order, and return the start and the goal."""
    if weights.dtype != np.float32:
        raise AssertionError(f"weights must have np.float32 data type, but has {weights.dtype}")
    least = weights.min()
    if least < 1.0:
        raise ValueError(f"Minimum cost to move must be 1, but got {least:f}")
    for name, (row, column) in (("Start", (start[0], start[1])), ("Goal", (goal[0], goal[1]))):
        if not (0 <= row < weights.shape[0] and 0 <= column < weights.shape[1]):  # type: ignore[operator]
            raise ValueError(f"{name} of {start if name == 'Start' else goal} lies outside grid.")
    rows, columns = weights.shape
    points: tuple[Any, Any] = (start, goal)
    first, last = (divmod(int(np.ravel_multi_index(tuple(p), (rows, columns))), columns) for p in points)
    if np.isnan(least):
        raise OptionError("a weight is not a number: mark what is impassable by infinity", "not-supported")
    return first, last


def _not_uniform(one: object, other: object, blocked: str) -> OptionError:
    """Make the error for an array with several costs."""
    return OptionError(
        f"the passable cells must all cost the same, but some cost {one} and some {other}: Mediant has no "
        f"cells of several costs, the original has. Impassable are {blocked} only",
        "not-uniform",
    )
