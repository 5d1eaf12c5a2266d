"""From the arrays of the engine to the columns of a table, and back."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from .._mediant import Paths
from ._columns import RESULTS, TableError

__all__ = ["INVALID", "Results", "schema_of", "waypoints"]

WORDS = ("found", "unreachable", "nearest", "stopped", "invalid")
"""The words of `Paths.statuses`, by their numbers."""

FOUND, UNREACHABLE, _, STOPPED, INVALID = range(len(WORDS))

PATH = pa.large_list(pa.struct([("row", pa.int32()), ("column", pa.int32())]))
STATUS = pa.dictionary(pa.int8(), pa.string())


def schema_of(paths: bool) -> pa.Schema:
    """Give the columns that an answer adds."""
    fields = list(zip(RESULTS, (pa.float64(), STATUS, PATH)))
    return pa.schema(fields if paths else fields[:2])


class Results:
    """Collects the answers to `size` queries, which come in any order."""

    def __init__(self, size: int, paths: bool) -> None:
        self._distances = np.full(size, np.nan)
        self._statuses = np.full(size, INVALID, dtype=np.int8)
        self._paths: list[pa.Array] | None = [] if paths else None
        self._rows: list[NDArray[np.intp]] = []

    def add(self, rows: NDArray[np.intp], found: Paths) -> None:
        """Add the answers to the queries of some rows."""
        self._distances[rows] = found.distances
        self._statuses[rows] = found.statuses
        if self._paths is not None:
            self._paths.append(_path_column(found))
            self._rows.append(rows)

    def measured(self, rows: NDArray[np.intp], distances: NDArray[np.float64]) -> None:
        """Add the distances of plain queries without paths: nan where a query is invalid."""
        self._distances[rows] = distances
        found = np.where(np.isinf(distances), UNREACHABLE, FOUND)
        self._statuses[rows] = np.where(np.isnan(distances), INVALID, found)

    def statuses(self, rows: NDArray[np.intp]) -> NDArray[np.int8]:
        """Give the statuses of the queries of some rows."""
        return self._statuses[rows]

    def columns(self) -> pa.Table:
        """Give the columns, in the order of the rows."""
        unknown = (self._statuses == INVALID) | (self._statuses == STOPPED)
        columns = [
            pa.array(self._distances, mask=unknown),
            pa.DictionaryArray.from_arrays(self._statuses, pa.array(WORDS)),
        ]
        if self._paths is not None:
            columns.append(self._path())
        return pa.Table.from_arrays(columns, schema=schema_of(self._paths is not None))

    def _path(self) -> pa.Array:
        assert self._paths is not None
        if not self._paths:
            return pa.nulls(len(self._statuses), PATH)
        column = pa.concat_arrays(self._paths) if len(self._paths) > 1 else self._paths[0]
        rows = np.concatenate(self._rows)
        if len(rows) == len(self._statuses) and (rows[1:] > rows[:-1]).all():
            return column
        where = np.full(len(self._statuses), -1, dtype=np.int64)
        where[rows] = np.arange(len(rows))
        return column.take(pa.array(where, mask=where < 0))


def _path_column(found: Paths) -> pa.Array:
    points, offsets = found.points, found.offsets
    values = pa.StructArray.from_arrays(
        [pa.array(np.ascontiguousarray(points[:, axis])) for axis in (0, 1)], fields=list(PATH.value_type)
    )
    none = offsets[1:] == offsets[:-1]  # A path from a vertex to itself has a point.
    return pa.LargeListArray.from_arrays(pa.array(offsets), values, type=PATH, mask=pa.array(none))


def waypoints(column: Any) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Give a column of paths as two arrays, without a loop over its rows.

    Parameters
    ----------
    column : pyarrow.Array or pyarrow.ChunkedArray
        The column ``path`` of an answer, or a part of it; also after a way through a Parquet file.

    Returns
    -------
    points : ndarray of int32, shape (n, 2)
        The points of all paths, one path after another: (row, column).
    offsets : ndarray of int64, shape (rows + 1,)
        The index of each path's first point: the path of row i is ``points[offsets[i]:offsets[i + 1]]``,
        empty where there is none.

    Raises
    ------
    TableError
        The column holds no paths.

    Examples
    --------
    >>> import mediant
    >>> from mediant import batch
    >>> grid = mediant.Grid.from_rows([".....", "####."])
    >>> queries = {"start_row": [0, 0], "start_column": [0, 2], "goal_row": [0, 0], "goal_column": [3, 9]}
    >>> answer = batch.solve(queries, grid, paths=True)
    >>> answer["path"].to_pylist()
    [[{'row': 0, 'column': 0}, {'row': 0, 'column': 3}], None]
    >>> points, offsets = batch.waypoints(answer["path"])
    >>> points.tolist(), offsets.tolist()
    ([[0, 0], [0, 3]], [0, 2, 2])
    """
    chunked = column if isinstance(column, pa.ChunkedArray) else pa.chunked_array([column])
    try:
        chunked = chunked.cast(PATH)
    except (pa.ArrowInvalid, pa.ArrowNotImplementedError) as error:
        raise TableError(f"a column of type {chunked.type} holds no paths: {error}", "column-type") from None
    sizes, points = [np.zeros(1, dtype=np.int64)], [np.empty((0, 2), dtype=np.int32)]
    for chunk in chunked.chunks:
        sizes.append(chunk.value_lengths().fill_null(0).to_numpy(zero_copy_only=False))
        flat = chunk.flatten()
        points.append(np.stack([flat.field(axis).to_numpy(zero_copy_only=False) for axis in (0, 1)], axis=1))
    return np.concatenate(points), np.cumsum(np.concatenate(sizes), dtype=np.int64)
