"""From tables to arrays: what kinds of table there are, and the columns of a query."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from ..errors import MediantError

__all__ = ["ENDS", "MAP", "RESULTS", "Queries", "TableError", "narrow", "queries_of", "table_of"]

ENDS = ("start_row", "start_column", "goal_row", "goal_column")
MAP = "map"
RESULTS = ("distance", "status", "path")
FAR = np.iinfo(np.int32)
"""Rows and columns beyond it are on no map."""


class TableError(MediantError):
    """A table of queries in which a column is missing, of another type, or holds what cannot be understood.

    Examples
    --------
    >>> import mediant
    >>> from mediant import batch
    >>> try:
    ...     batch.solve({"start_row": [0]}, mediant.Grid.from_rows([".."]))
    ... except batch.TableError as error:
    ...     print(error.code)
    missing-column
    """


class Queries(NamedTuple):
    """The queries of a table.

    `ends` has shape (n, 4): the columns of `ENDS`. `codes` says which of `keys` is the map of each query, or
    -1 where a cell of the query is null.
    """

    ends: NDArray[np.int64]
    codes: NDArray[np.intp]
    keys: list[Any]


def table_of(queries: Any) -> pa.Table:
    """Take a table of any kind that is in memory."""
    if isinstance(queries, pa.Table):
        return queries
    if isinstance(queries, pa.RecordBatch):
        return pa.Table.from_batches([queries])
    if isinstance(queries, Mapping):
        return pa.table(dict(queries))
    if type(queries).__module__.split(".")[0] == "pandas":
        return pa.Table.from_pandas(queries)  # Its index is kept, as metadata or as a column.
    if hasattr(queries, "__arrow_c_stream__"):
        return pa.table(queries)
    raise TypeError(
        f"expected a table of pyarrow, pandas or polars, a dict of columns, or the path of a Parquet file; "
        f"found {type(queries).__name__}"
    )


def is_path(queries: Any) -> bool:
    """Whether these are the path of a file or folder, or a list of such."""
    if isinstance(queries, (list, tuple)):
        return bool(queries) and all(isinstance(one, (str, os.PathLike)) for one in queries)
    return isinstance(queries, (str, os.PathLike))


def queries_of(
    table: pa.Table, known: Mapping[Any, Any] | None, *, strict: bool, first_row: int = 0
) -> Queries:
    """Read the queries of a table.

    Parameters
    ----------
    table : pyarrow.Table
    known : mapping or None
        Its keys are those of maps. None if there is one map, for all rows.
    strict : bool
        Whether a null is an error.
    first_row : int
        The number of the table's first row, for the texts of errors.
    """
    ends = np.empty((table.num_rows, len(ENDS)), dtype=np.int64)
    null = np.zeros(table.num_rows, dtype=bool)
    for at, name in enumerate(ENDS):
        column = _column(table, name)
        if not (pa.types.is_integer(column.type) or pa.types.is_null(column.type)):
            raise TableError(
                f"column {name!r} is of type {column.type}; integers are needed"
                ' (in pandas, .astype("Int64") also holds missing values)',
                "column-type",
            )
        null |= _nulls(column, name, strict, first_row)
        ends[:, at] = _int64(column)
    if known is None:
        codes, keys = np.zeros(table.num_rows, dtype=np.intp), [None]
    else:
        codes, keys = _maps(table, known, strict, first_row)
    codes[null] = -1
    return Queries(ends, codes, keys)


def narrow(table: pa.Table, with_map: bool) -> pa.Table:
    """Only the columns of queries, the integers in as few bytes as hold them, to be sent elsewhere."""
    names = [*([MAP] if with_map else []), *ENDS]
    columns = {name: _column(table, name) for name in names}
    for name in names:
        column = columns[name]
        if name == MAP and not pa.types.is_dictionary(column.type):
            columns[name] = column.dictionary_encode()
        elif pa.types.is_integer(column.type) and len(column) > column.null_count:
            span = pc.min_max(column).as_py()
            small = np.promote_types(np.min_scalar_type(span["min"]), np.min_scalar_type(span["max"]))
            if small.kind in "iu":
                columns[name] = column.cast(pa.from_numpy_dtype(small))
    return pa.table(columns)


def _column(table: pa.Table, name: str) -> pa.ChunkedArray:
    at = table.schema.get_all_field_indices(name)
    if len(at) != 1:
        code = "missing-column" if not at else "repeated-column"
        found = ", ".join(repr(one) for one in table.column_names) or "none"
        raise TableError(f"expected one column {name!r}, found {len(at)}; the columns are: {found}", code)
    return table.column(at[0])


def _nulls(column: pa.ChunkedArray, name: str, strict: bool, first_row: int) -> NDArray[np.bool_]:
    if not column.null_count:
        return np.zeros(len(column), dtype=bool)
    null: NDArray[np.bool_] = column.is_null().to_numpy()
    if strict:
        raise TableError(f"column {name!r} is null in row {first_row + int(null.argmax())}", "null")
    return null


def _int64(column: pa.ChunkedArray) -> NDArray[np.int64]:
    if pa.types.is_null(column.type):
        return np.zeros(len(column), dtype=np.int64)
    values = (column.fill_null(0) if column.null_count else column).to_numpy()
    if values.dtype.itemsize > 4:  # No map is so large, and what is far outside may as well be near.
        least = 0 if values.dtype.kind == "u" else FAR.min
        values = np.clip(values, least, FAR.max)
    return values.astype(np.int64, copy=False)  # type: ignore[no-any-return]


def _maps(
    table: pa.Table, known: Mapping[Any, Any], strict: bool, first_row: int
) -> tuple[NDArray[np.intp], list[Any]]:
    column = _column(table, MAP)
    kind = column.type.value_type if pa.types.is_dictionary(column.type) else column.type
    if not (
        pa.types.is_string(kind)
        or pa.types.is_large_string(kind)
        or kind == getattr(pa, "string_view", pa.string)()
        or pa.types.is_integer(kind)
        or pa.types.is_null(kind)
    ):
        raise TableError(
            f"column {MAP!r} is of type {column.type}; strings or integers are needed", "column-type"
        )
    _nulls(column, MAP, strict, first_row)
    if pa.types.is_null(kind) or not len(column):
        return np.full(len(column), -1, dtype=np.intp), []
    if not pa.types.is_dictionary(column.type):
        column = column.dictionary_encode()
    column = column.combine_chunks()
    codes = column.indices.fill_null(-1).to_numpy(zero_copy_only=False).astype(np.intp)
    keys = column.dictionary.to_pylist()
    for code in np.unique(codes):
        if code >= 0 and keys[code] not in known:
            raise _unknown(keys[code], known, first_row + int((codes == code).argmax()))
    return codes, keys


def _unknown(key: Any, known: Mapping[Any, Any], row: int) -> TableError:
    some = ", ".join(repr(one) for one in list(known)[:5]) + (", …" if len(known) > 5 else "")
    return TableError(
        f"column {MAP!r} is {key!r} in row {row}, and there is no map of this key; the keys are: {some}",
        "unknown-map",
    )
