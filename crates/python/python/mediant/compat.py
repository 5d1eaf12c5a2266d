"""Calls of other libraries, answered by the engines of this one.

Each has the name, the parameters, the result and the errors of the one that it stands in for. Where several
paths are equally good, it may return another of them: costs are the same but for rounding (the last of some
ten digits), cells need not be. A call that cannot be answered the same is an error, never another answer:
`mediant.OptionError`.

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
from .errors import MapError, OptionError

if TYPE_CHECKING:
    from ._mediant import Engine

__all__ = ["Heuristic", "MCP_Geometric", "astar_path", "route_through_array"]

_NO_ROUTE = "no minimum-cost path was found to the specified end point"
_ZERO = (
    "some passable cells cost 0: Mediant has positive costs alone, since a path over cells that cost nothing "
    "can be of any length. Give them a cost that is small beside the others"
)
# The steps to the neighbors of a cell, in the order of skimage.
_STEPS = np.array([(row, column) for row in (-1, 0, 1) for column in (-1, 0, 1) if (row, column) != (0, 0)])


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
        The costs. Cells that are infinite or negative are impassable. All others must be positive, or cost
        the same; with ``fully_connected`` and without ``geometric`` they must cost the same.
    start, end : iterable of int
        (row, column). Negative numbers count from the end, as indexes of arrays do.
    fully_connected : bool
        Whether paths may take diagonal steps. They pass between two impassable cells that touch at a corner.
    geometric : bool
        Whether a step costs its length, √2 of a diagonal one, times the mean of the costs of its two cells.
        If not, the path costs the sum of its cells, both ends included.

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
        The array has not two axes; or its passable cells have several costs, of which one is zero, or no
        number, or more than 65536 times another; or without `geometric` diagonal steps are taken over them.

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
    if costs[first] < 0:
        raise _negative_start(costs[first])
    if not np.all((others < 0) | (others == math.inf)):
        if k != 2 and not geometric:
            other = others[~((others < 0) | (others == math.inf))][0]
            raise _not_uniform(each, other, "infinite or negative ones")
        return _route_over_costs(costs, first, last, k, geometric)
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


def _route_over_costs(
    costs: NDArray[Any], first: tuple[int, int], last: tuple[int, int], k: int, geometric: bool
) -> tuple[list[tuple[int, int]], float]:
    """Do the same where cells have several costs."""
    path = _grid_of(costs, 1.0).path(first, last, k=k, corners="always", points="vertices")
    if path is None:
        return [], math.inf
    each = costs[path[:, 0], path[:, 1]].astype(np.float64)
    cells = list(zip(path[:, 0].tolist(), path[:, 1].tolist()))
    if not geometric:  # Of straight steps, the means add up to the cells between the ends, and half of those.
        return cells, float(each.sum())
    lengths = np.sqrt(np.abs(np.diff(path, axis=0)).sum(axis=1))
    return cells, float((lengths * (each[1:] + each[:-1])).sum() / 2)


def _grid_of(costs: NDArray[Any], cell_size: Any) -> Grid:
    """Make the grid of costs of which negative and infinite ones are impassable."""
    if costs.dtype.kind == "f" and np.isnan(costs).any():
        raise OptionError("a cost is not a number: mark what is impassable by infinity", "not-uniform")
    blocked = (costs < 0) | (costs == math.inf)
    if not np.all(costs[~blocked]):
        raise OptionError(_ZERO, "not-supported")
    try:
        return Grid(blocked, costs=costs.astype(np.float64, copy=False), cell_size=cell_size)
    except MapError as error:
        raise OptionError(str(error), "not-supported") from error


def _known_offsets(offsets: Iterable[Any]) -> NDArray[np.int_]:
    """Give offsets as an array, if they are those that an engine has."""
    given = [tuple(offset) for offset in offsets]
    for steps in (_STEPS, _STEPS[(_STEPS == 0).any(axis=1)]):
        if sorted(given) == sorted(map(tuple, steps.tolist())):
            return np.array(given, dtype=int)
    raise OptionError(
        "offsets other than the steps to 8 or 4 neighbors are not there: for more directions use "
        "mediant.Grid.field with k=4 and more",
        "not-supported",
    )


def _sampling(sampling: Sequence[float] | None) -> tuple[float, float] | None:
    """Check the height and the width of a cell, as skimage does."""
    if sampling is None:
        return None
    if not isinstance(sampling, (tuple, list)):
        raise ValueError(f"Invalid type for sampling: {type(sampling)}.")
    if len(sampling) != 2:
        raise ValueError("Need one sampling element per dimension.")
    height, width = (float(side) for side in sampling)
    if not (0 < height < math.inf and 0 < width < math.inf):
        raise OptionError(f"sampling {sampling}: height and width must be positive", "not-supported")
    return height, width


def _one_limit(
    coverage: float, cumulative: None, max_cost: float | None, max_step_cost: float | None
) -> float | None:
    """Give the limit on the costs of cells, if there is one; refuse the others."""
    if not coverage >= 1:
        raise OptionError("max_coverage below 1 is not there: give ends", "not-supported")
    if cumulative is not None:
        raise OptionError(
            "max_cumulative_cost is not looked at by skimage: mediant.Grid.field has a limit", "not-supported"
        )
    if max_cost is not None and max_step_cost is not None:
        raise ValueError("max_cost and max_step_cost are the same: give one of them")
    return max_cost if max_step_cost is None else max_step_cost


def _negative_start(cost: object) -> OptionError:
    """Make the error for a start that may only be left."""
    return OptionError(
        f"the start has the negative cost {cost}, which only skimage takes. Give it that of the cells beside "
        "it",
        "not-supported",
    )


class MCP_Geometric:
    """Cheapest paths from one or several cells to all others, as `skimage.graph.MCP_Geometric` finds them.

    For a search with more directions, and without a class, there is `mediant.Grid.field`.

    Parameters
    ----------
    costs : array_like of shape (rows, columns)
        The costs. Cells that are infinite or negative are impassable. All others must be positive.
    offsets : iterable of tuple of int, optional
        The moves, in place of `fully_connected`: the 8 or the 4 steps to neighbors in any order. Others are
        refused.
    fully_connected : bool
        Whether paths may take diagonal steps. They pass between two impassable cells that touch at a corner.
    sampling : tuple of float, optional
        The height and the width of a cell.

    Attributes
    ----------
    offsets : numpy.ndarray
        The moves, shape (8, 2) or (4, 2), to which the numbers of a traceback array refer.

    Raises
    ------
    mediant.OptionError
        The array has not two axes; a cost is zero, or no number, or more than 65536 times another; there are
        other offsets; or a side of a cell is not positive.
    TypeError
        A subclass overrides `goal_reached`: searches do not ask it.

    Examples
    --------
    >>> import numpy as np
    >>> from mediant.compat import MCP_Geometric
    >>> mcp = MCP_Geometric(np.array([[1.0, 9.0, 1.0], [1.0, 1.0, 1.0]]))
    >>> costs, traceback = mcp.find_costs([(0, 0)])
    >>> costs.round(2).tolist()
    [[0.0, 5.0, 2.83], [1.0, 1.41, 2.41]]
    >>> mcp.traceback((0, 2)), mcp.offsets[traceback[0, 2]].tolist()
    ([(0, 0), (1, 1), (0, 2)], [-1, 1])
    """

    def __init__(
        self,
        costs: ArrayLike,
        offsets: Iterable[Any] | None = None,
        fully_connected: bool = True,
        sampling: Sequence[float] | None = None,
    ) -> None:
        array = np.asarray(costs)
        if not np.can_cast(array.dtype, np.float64):
            raise TypeError(f"cannot cast costs array to {np.float64}")
        if array.ndim != 2:
            raise OptionError(f"the array must have 2 axes, it has {array.ndim}", "not-supported")
        self.offsets = _STEPS if fully_connected else _STEPS[(_STEPS == 0).any(axis=1)]
        if offsets is not None:
            self.offsets = _known_offsets(offsets)
        self._costs, self._k = array, 3 if len(self.offsets) == 8 else 2
        self._sampling = _sampling(sampling)
        self._grid = _grid_of(array, self._sampling)
        self._found: tuple[NDArray[np.float64], NDArray[np.int16]] | None = None

    def __init_subclass__(cls, **how: Any) -> None:
        super().__init_subclass__(**how)
        if hasattr(cls, "goal_reached"):
            raise TypeError("goal_reached is not asked by the searches here: use ends, or Grid.field(limit=)")

    def find_costs(  # noqa: PLR0917, as in scikit-image
        self,
        starts: Iterable[Any],
        ends: Iterable[Any] | None = None,
        find_all_ends: bool = True,
        max_coverage: float = 1.0,
        max_cumulative_cost: None = None,
        max_cost: float | None = None,
        *,
        max_step_cost: float | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.int16]]:
        """Find the costs of all cells.

        Parameters
        ----------
        starts : iterable of tuple of int
            (row, column) of each start. Negative numbers count from the end.
        ends : iterable of tuple of int, optional
            Cells that cost more than all of these are left out, unless one of them is named twice. (Of cells
            that cost exactly as much, skimage leaves out some.)
        find_all_ends : bool
            If not, cells that cost more than the cheapest of the ends are left out.
        max_coverage : float
            Less than 1 is refused.
        max_cumulative_cost : None
            Others are refused: skimage takes this, and does not look at it.
        max_cost, max_step_cost : float, optional
            Cells whose own cost is greater are impassable, but for the starts. These are two names of the
            same.

        Returns
        -------
        cumulative_costs : numpy.ndarray
            The least cost of each cell, float64; infinite where no path leads, or where it was left out.
        traceback : numpy.ndarray
            The number in `offsets` of the last step to each cell, int16; -1 at starts, -2 where there is
            none.

        Raises
        ------
        ValueError
            A cell lies outside the array, no start is passable, or both names of the limit are given.
        mediant.OptionError
            A start has a negative cost, or an option is refused.
        """
        step = _one_limit(max_coverage, max_cumulative_cost, max_cost, max_step_cost)
        shape = self._costs.shape
        cells = [_cell(tuple(start), shape, "start") for start in starts]
        lasts = [_cell(tuple(end), shape, "end") for end in ends or ()]
        for cell in cells:
            if self._costs[cell] < 0:
                raise _negative_start(self._costs[cell])
        cells = [cell for cell in cells if self._costs[cell] != math.inf]
        if not cells:
            raise ValueError("no valid start points to start frontpropagation")
        grid = self._grid if step is None else self._within(step, cells)
        field = grid.field(cells, k=self._k, corners="always")
        costs = field.distances()
        from_last = np.moveaxis(np.indices(shape), 0, -1) - field.next() + 1
        numbers = np.full((3, 3), -1, dtype=np.int16)
        numbers[tuple((self.offsets + 1).T)] = np.arange(len(self.offsets))
        is_known = np.isfinite(costs)
        if lasts and not (find_all_ends and len(set(lasts)) < len(lasts)):
            reached = [costs[last] for last in lasts]
            is_known &= costs <= (max if find_all_ends else min)(reached)
        costs[~is_known] = math.inf
        traceback = np.full(shape, -2, dtype=np.int16)
        traceback[is_known] = numbers[tuple(from_last[is_known].T)]
        self._found = costs, traceback
        return costs.copy(), traceback.copy()

    def _within(self, limit: float, starts: list[tuple[int, int]]) -> Grid:
        """Make the grid on which dearer cells than this are impassable, but for the starts."""
        is_wall = self._costs > limit
        is_wall[tuple(np.transpose(starts))] = False
        return _grid_of(np.where(is_wall, math.inf, self._costs), self._sampling)

    def traceback(self, end: Iterable[Any]) -> list[tuple[int, int]]:
        """Give the cells of the cheapest path to a cell, from the start that is nearest to it.

        Parameters
        ----------
        end : iterable of int
            (row, column).

        Returns
        -------
        list of tuple
            (row, column) of every cell.

        Raises
        ------
        ValueError
            The cell lies outside the array, or no path leads to it.
        Exception
            Nothing was found yet by `find_costs`.
        """
        if self._found is None:
            raise Exception("find_costs() must be run before traceback()")
        costs, numbers = self._found
        at = _cell(tuple(end), costs.shape, "end")
        if costs[at] == math.inf:
            raise ValueError(_NO_ROUTE)
        cells = [at]
        while numbers[at] >= 0:
            row, column = self.offsets[numbers[at]].tolist()
            at = (at[0] - row, at[1] - column)
            cells.append(at)
        return cells[::-1]


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
    if path is None or float(each) * (len(path) - 1) > float(np.finfo(np.float32).max):
        return None  # There, a cost that overflows is no way.
    return path.astype(np.int32, copy=False)


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
        f"search for the least sum of cells with diagonal steps, the original has. Impassable are {blocked} "
        "only",
        "not-uniform",
    )
