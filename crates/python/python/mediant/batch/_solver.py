"""The part that all ways share: from a table in memory to its answers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Literal

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from .._mediant import Grid, Index, __version__
from ..errors import MediantError, MismatchError, OptionError
from ._cache import cache
from ._columns import Queries, TableError, is_path, queries_of, table_of
from ._results import INVALID, Results, schema_of
from ._sources import OfIndex, Setup, Source, have_costs, sources_of

__all__ = ["Solver", "solve"]

WISHES = ("nearest", "tolerance", "snap", "max_cost", "max_expansions", "timeout")

CHUNK = 1 << 16
"""The number of queries in one call of the engine: many for its threads, few for memory."""

Progress = Callable[[int, int], object]


class Solver:
    """Answers tables of queries. It pickles, so that any system of tasks can run it.

    A process makes each index once, and keeps it in `batch.cache`.

    Parameters
    ----------
    maps : Mapping, or one map
        By the keys in the column ``map``: `mediant.Grid`, with costs or without, a 2-D array of bool, the
        path of a map file, `mediant.Index`, or a pair of a map and the path of the file of its index. One map
        alone is for all rows; a column ``map`` is not read then.
    k, engine, placement, corners, gap
        As for `Grid.prepare`. It chooses those that are None; k is 3 then. An index that is given has its
        own: it is an error if something else is asked for.
    paths : bool
        Whether the answer has the column ``path``. Without it, and without options of queries, no path is
        made, which takes half of the time on prepared maps; distances are those of `Index.distances` then.
    points : {"waypoints", "vertices", "touched"}
        The points that a path has.
    threads : int, optional
        The threads that prepare a map and answer its queries. All cores, if None.
    invalid : {"none", "raise"}
        The answer to an end that is blocked, outside its map, or null: a word in the column ``status``, or an
        error that names the row.
    **options
        `nearest`, `tolerance`, `snap`, `max_cost`, `max_expansions`, `timeout` as for `Index.paths`, and the
        options of the engine as for `Grid.prepare`.

    Raises
    ------
    MediantError
        The engine, motion or options do not exist, or not together.

    Examples
    --------
    >>> import pickle
    >>> import mediant
    >>> from mediant import batch
    >>> solver = batch.Solver({7: mediant.Grid.from_rows(["...", ".#.", "..."])}, k=2)
    >>> queries = {"map": [7], "start_row": [0], "start_column": [0], "goal_row": [2], "goal_column": [2]}
    >>> pickle.loads(pickle.dumps(solver))(queries)["distance"].to_pylist()
    [4.0]
    """

    def __init__(
        self,
        maps: Any,
        *,
        k: Any = None,
        engine: str | None = None,
        placement: str | None = None,
        corners: str | None = None,
        gap: str | None = None,
        paths: bool = False,
        points: Literal["waypoints", "vertices", "touched"] = "waypoints",
        threads: int | None = None,
        invalid: Literal["none", "raise"] = "none",
        **options: Any,
    ) -> None:
        self._sources, self.has_keys = sources_of(maps)
        wishes = {name: options.pop(name) for name in WISHES if name in options}
        self._setup = Setup(engine, k, placement, corners, gap, tuple(sorted(options.items())))
        self._how = {**wishes, "points": points, "threads": threads}
        self.paths, self.threads, self._strict = paths, threads, _is_strict(invalid)
        if not all(isinstance(source, OfIndex) for source in self._sources.values()):
            # Mistakes are found here, not on a worker.
            for has_costs in {have_costs(getattr(one, "grid", None)) for one in self._sources.values()}:
                self._setup.prepare(Grid([[False]], costs=[[1]] if has_costs else None), 1)

    def __call__(self, queries: Any, *, progress: Progress | None = None, first_row: int = 0) -> pa.Table:
        """Answer a table.

        Parameters
        ----------
        queries : pyarrow.Table, RecordBatch, DataFrame of pandas or polars, or dict of columns
        progress : callable, optional
            Is called now and then with the number of queries that are answered, and that of all.
        first_row : int
            The number of its first row, for the texts of errors.

        Returns
        -------
        pyarrow.Table
            The same rows in the same order, with the columns ``distance``, ``status`` and perhaps ``path``.

        Raises
        ------
        TableError
            A column is missing or of another type, or there is no map of a key.
        QueryError
            An end is blocked or outside its map, if `invalid` is "raise".
        """
        table = table_of(queries)
        self.check(table.schema)
        return with_columns(table, self.columns(table, progress=progress, first_row=first_row))

    def check(self, schema: pa.Schema) -> None:
        """Raise an error if a column of the answer is there already."""
        taken = [name for name in schema_of(self.paths).names if name in schema.names]
        if taken:
            raise TableError(
                f"the table has a column {taken[0]!r} already, which the answer adds; rename or drop it",
                "column-taken",
            )

    def columns(self, table: pa.Table, *, progress: Progress | None = None, first_row: int = 0) -> pa.Table:
        """Give only the columns that the answer adds."""
        known = self._sources if self.has_keys else None
        queries = queries_of(table, known, strict=self._strict, first_row=first_row)
        results = Results(table.num_rows, self.paths)
        groups = list(_groups(queries))
        turn = first_row // max(1, table.num_rows) % max(1, len(groups))
        # Without a path in the answer, and without a wish, the engine need not make it.
        measures = not self.paths and not any(_is_wish(self._how.get(name)) for name in WISHES)
        done = 0
        # Tasks that start together begin with different maps, and do not all wait for the first one.
        for code, rows in groups[turn:] + groups[:turn]:
            index = self._index(queries.keys[code])
            for chunk in (rows[at : at + CHUNK] for at in range(0, len(rows), CHUNK)):
                ends = queries.ends[chunk]
                starts, goals, threads = ends[:, :2], ends[:, 2:], self._how["threads"]
                if measures:
                    results.measured(chunk, index.distances(starts, goals, invalid="none", threads=threads))
                else:
                    results.add(chunk, index.paths(starts, goals, invalid="none", **self._how))
                invalid = results.statuses(chunk) == INVALID
                if self._strict and invalid.any():
                    self._explain(index, queries, int(chunk[int(invalid.argmax())]), first_row)
                done += len(chunk)
                if progress is not None:
                    progress(done, table.num_rows)
        return results.columns()

    def packed(self, *, threads: int | None, indexes: bool = False) -> Solver:
        """Give one that can be sent to other processes.

        Parameters
        ----------
        threads : int or None
            The number of threads that a call may have there.
        indexes : bool
            Whether the indexes are made here, and their bytes sent, rather than the maps.
        """
        other: Solver = Solver.__new__(Solver)
        other.__dict__.update(self.__dict__)
        other.threads, other._how = threads, {**self._how, "threads": threads}
        sources: dict[Any, Source] = {
            key: OfIndex(self._index(key)) if indexes else source for key, source in self._sources.items()
        }
        other._sources = {key: source.packed() for key, source in sources.items()}
        return other

    def __getstate__(self) -> dict[str, Any]:
        sources = {key: source.packed() for key, source in self._sources.items()}
        return {**self.__dict__, "_sources": sources, "version": __version__}

    def __setstate__(self, state: dict[str, Any]) -> None:
        version = state.pop("version")
        if version != __version__:
            raise MismatchError(f"sent by mediant {version}, received by mediant {__version__}", "version")
        self.__dict__.update(state)

    def knows(self, key: Any) -> bool:
        """Say whether there is a map of a key."""
        return key in self._sources

    def _index(self, key: Any) -> Index:
        """Give the index of the map of a key, or of the only one by the key None."""
        source = self._sources[key]
        if isinstance(source, OfIndex):
            return source.open(self._setup, self.threads)
        return cache.get((source.key(), self._setup), lambda: source.open(self._setup, self.threads))

    def _explain(self, index: Index, queries: Queries, row: int, first_row: int) -> None:
        """Raise the error of one query, which names its row."""
        ends = queries.ends[row]
        try:
            wishes = {name: value for name, value in self._how.items() if name in WISHES}
            index.path(ends[:2], ends[2:], **wishes)
        except MediantError as error:
            key = f" (map {queries.keys[queries.codes[row]]!r})" if self.has_keys else ""
            raise type(error)(f"row {first_row + row}{key}: {error}", error.code) from None
        raise AssertionError(f"row {first_row + row} is invalid, and is not")


def solve(queries: Any, maps: Any, *, progress: Progress | None = None, **how: Any) -> pa.Table:
    """Answer a table of queries on this machine.

    Parameters
    ----------
    queries : table or path
        A table as `Solver` takes it, or the path of a Parquet file or of a folder of such files, or a list of
        paths. The rows of a folder come in the order of the names of its files. Columns: ``start_row``,
        ``start_column``, ``goal_row``, ``goal_column`` of any type of integer, and ``map`` of strings or
        integers, if maps have keys. Other columns are passed on.
    maps : Mapping, or one map
        As for `Solver`.
    progress : callable, optional
        Is called now and then with the number of queries that are answered, and that of all.
    **how
        As for `Solver`: `k`, `engine`, `placement`, `corners`, `gap`, `paths`, `points`, `threads`,
        `invalid`, and the options of queries and engines.

    Returns
    -------
    pyarrow.Table
        The same rows in the same order, and the columns

        - ``distance``, float64: infinite if no path leads there, null if an end is invalid or a limit stopped
          the search, so that nothing is known.
        - ``status``, a dictionary of strings: found, unreachable, nearest, stopped or invalid.
        - ``path``, if `paths`: large_list<struct<row: int32, column: int32>>, null where there is no path.

    Raises
    ------
    TableError
        A column is missing or of another type, or there is no map of a key.
    QueryError
        An end is blocked or outside its map, if `invalid` is "raise".
    MediantError
        A map, engine, motion or option that cannot be.

    Examples
    --------
    >>> import mediant
    >>> from mediant import batch
    >>> queries = {"start_row": [0], "start_column": [0], "goal_row": [1], "goal_column": [2], "who": ["Ada"]}
    >>> batch.solve(queries, mediant.Grid.from_rows(["...", ".#."])).to_pylist()[0]["status"]
    'found'
    """
    if is_path(queries):
        from ._parquet import read  # noqa: PLC0415

        queries = read(queries)
    return Solver(maps, **how)(queries, progress=progress)


def with_columns(table: pa.Table, more: pa.Table) -> pa.Table:
    """Give a table with the columns of another one."""
    for field, column in zip(more.schema, more.columns):
        table = table.append_column(field, column)
    return table


def _groups(queries: Queries) -> Iterator[tuple[int, NDArray[np.intp]]]:
    """Give the rows of each map."""
    order = np.argsort(queries.codes, kind="stable")
    codes = queries.codes[order]
    edges = np.flatnonzero(np.diff(codes, prepend=-2, append=-2))
    for begin, end in zip(edges[:-1], edges[1:]):
        if codes[begin] >= 0:
            yield int(codes[begin]), order[begin:end]


def _is_wish(value: Any) -> bool:
    return value is not None and value is not False


def _is_strict(invalid: str) -> bool:
    if invalid not in ("none", "raise"):
        raise OptionError(f'invalid is "none" or "raise", not {invalid!r}', "invalid")
    return invalid == "raise"
