"""Parts of a table: how it is cut, and how one part is answered, wherever that is."""

from __future__ import annotations

import io
import os
import uuid
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Protocol, Union

import pyarrow as pa
import pyarrow.parquet as pq

from ._columns import is_path, narrow, table_of
from ._parquet import fragments_of
from ._solver import Solver, with_columns

__all__ = ["Job", "Part", "job_of", "run"]

FEWEST, MOST = 20_000, 100_000
"""The rows of a part, if nobody says how many. Fewer, and the overhead of a task is seen; more, and much is
lost with a worker. docs/python-batch.md has the measurements."""


class Part(Protocol):
    """Some rows of a table. It pickles."""

    first_row: int

    def read(self) -> pa.Table:
        """Give the rows."""


class OfTable:
    """Rows that were in memory: the columns of the queries, in Arrow's stream format."""

    def __init__(self, data: bytes, first_row: int) -> None:
        self.data, self.first_row = data, first_row

    @staticmethod
    def of(table: pa.Table, first_row: int) -> OfTable:
        """Copy the rows of a slice, and not the table that it is a slice of."""
        sink = io.BytesIO()
        with pa.ipc.new_stream(sink, table.schema) as stream:
            stream.write_table(table)
        return OfTable(sink.getvalue(), first_row)

    def read(self) -> pa.Table:
        return pa.ipc.open_stream(self.data).read_all()


class OfFile:
    """Rows of a Parquet file: some of its row groups, and of those a slice."""

    def __init__(self, fragment: Any, schema: pa.Schema, skip: int, rows: int, first_row: int) -> None:
        self.fragment, self.schema, self.skip, self.rows, self.first_row = (
            fragment,
            schema,
            skip,
            rows,
            first_row,
        )

    def read(self) -> pa.Table:
        return self.fragment.to_table(schema=self.schema, use_threads=False).slice(self.skip, self.rows)


AnyPart = Union[OfTable, OfFile]


class Job(NamedTuple):
    """A table in parts. `table` is the whole one, if it is in memory."""

    parts: list[AnyPart]
    table: pa.Table | None
    schema: pa.Schema

    def finish(self, answers: Sequence[Any], solver: Solver, to: Any) -> Any:
        """Put the answers of the parts together."""
        if to is not None:
            return list(answers)
        if self.table is None:
            return pa.concat_tables(answers) if answers else solver(self.schema.empty_table())
        if not answers:
            return solver(self.table)
        return with_columns(self.table, pa.concat_tables(answers))


def job_of(queries: Any, solver: Solver, rows: int | None, slots: int, to: Any) -> Job:
    """Cut a table into parts of at most `rows` rows.

    Parameters
    ----------
    queries : table or path
    solver : Solver
        Checks the columns before anything is sent.
    rows : int or None
        None chooses: some parts for each slot, so that slow ones even out.
    slots : int
        The tasks that can run at once.
    to : path or None
        The folder for the parts. It must hold none.
    """
    if rows is not None and rows < 1:
        raise ValueError(f"partition_rows is at least 1, not {rows}")
    if to is not None:
        _make_empty(Path(to))
    if is_path(queries):
        fragments, schema = fragments_of(queries)
        solver.check(schema)
        total = sum(fragment.count_rows() for fragment in fragments)
        parts = list(_cut_files(fragments, schema, rows or _rows(total, slots)))
        return Job(list(parts), None, schema)
    table = table_of(queries)
    solver.check(table.schema)
    rows = rows or _rows(table.num_rows, slots)
    sent = table if to is not None else narrow(table, solver.has_keys)
    cut = [OfTable.of(sent.slice(at, rows), at) for at in range(0, table.num_rows, rows)]
    return Job(list(cut), table, table.schema)


def run(solver: Solver, part: AnyPart, at: int, to: str | None) -> Any:
    """Answer a part. This is the task that clusters run.

    Returns
    -------
    pyarrow.Table or str
        The answer, or the path of the file it was written to.
    """
    table = part.read()
    if to is None and isinstance(part, OfTable):
        return solver.columns(table, first_row=part.first_row)
    answer = solver(table, first_row=part.first_row)
    return answer if to is None else _write(answer, Path(to) / f"part-{at:06}.parquet")


def _rows(total: int, slots: int) -> int:
    return min(max(-(-total // (4 * slots)), FEWEST), MOST)


def _cut_files(fragments: Sequence[Any], schema: pa.Schema, rows: int) -> Iterator[OfFile]:
    first = 0
    for fragment in fragments:
        groups = [group.num_rows for group in fragment.row_groups]
        begin = 0
        while begin < len(groups):
            end, size = begin + 1, groups[begin]
            while end < len(groups) and size + groups[end] <= rows:
                size += groups[end]
                end += 1
            subset = fragment.subset(row_group_ids=list(range(begin, end)))
            for skip in range(0, size, rows):
                count = min(rows, size - skip)
                yield OfFile(subset, schema, skip, count, first)
                first += count
            begin = end


def _make_empty(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    there = sorted(folder.glob("part-*.parquet"))
    if there:
        raise FileExistsError(f"{str(folder)!r} holds parts of an answer already: {there[0].name!r}")


def _write(table: pa.Table, path: Path) -> str:
    """Write a file as a whole: who is killed meanwhile leaves no half of it under its name."""
    unfinished = path.with_name(f".{path.name}-{uuid.uuid4().hex}")
    try:
        pq.write_table(table, unfinished)
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)
    return str(path)
