"""On Dask: a task for each part of a table."""

from __future__ import annotations

import os
from typing import Any

import pyarrow as pa

from ._need import need
from ._parts import job_of, run
from ._solver import Solver

__all__ = ["dask"]


def dask(
    queries: Any,
    maps: Any,
    *,
    to: str | os.PathLike[str] | None = None,
    partition_rows: int | None = None,
    threads: int = 1,
    ship: bool = False,
    client: Any = None,
    **how: Any,
) -> Any:
    """Answer a table of queries on a cluster of Dask.

    The tasks of a worker process share its indexes, each of which is made once. A task whose worker is lost
    runs again on another one.

    Parameters
    ----------
    queries : table, path or dask DataFrame
        As for `solve`. Files are read by the workers.
    maps : Mapping, or one map
        As for `Solver`. A map in memory is sent to each worker that needs it, once; a path is opened by the
        worker.
    to : path, optional
        A folder that all workers can write to. Each task writes a Parquet file to it, ``part-000000.parquet``
        and so on, in the order of the queries, and only the names come back.
    partition_rows : int, optional
        The rows of a task. None: a quarter of what each thread of the cluster gets, from 20,000 to 100,000.
    threads : int
        The threads of a task. Dask runs as many tasks at once as a worker has threads, so that one is right,
        unless workers were told otherwise.
    ship : bool
        Whether the indexes are made here, and sent instead of the maps. An index that is given is always
        sent.
    client : distributed.Client, optional
        The cluster. None: the current client, or the threads of this process if there is none.
    **how
        As for `Solver`.

    Returns
    -------
    pyarrow.Table, list of str, or dask DataFrame
        The answer as `solve` gives it; the paths of its files, if `to` is given; for a dask DataFrame one
        that computes the answer when asked, with the same partitions.

    Raises
    ------
    MediantError
        As for `solve`; those of rows are raised by the worker.
    FileExistsError
        `to` holds the parts of an answer.
    ImportError
        Dask is not there: ``pip install "mediant[dask]"``.

    Examples
    --------
    >>> import mediant
    >>> from mediant import batch
    >>> queries = {"start_row": [0, 1], "start_column": [0, 2], "goal_row": [1, 1], "goal_column": [2, 0]}
    >>> batch.dask(queries, mediant.Grid.from_rows(["...", ".#."]), k=2)["distance"].to_pylist()
    [3.0, 4.0]
    """
    package = need("dask", "dask")
    here = Solver(maps, threads=threads, **how)
    solver = here.packed(threads=threads, indexes=ship)
    # A task of its own, so that a worker gets the solver once. If it is lost, the scheduler sends it again.
    shared = package.delayed(_same, pure=False)(package.delayed(solver, pure=False))
    if hasattr(queries, "map_partitions"):
        if to is not None or partition_rows is not None:
            raise ValueError("a dask DataFrame has partitions of its own, and writes itself: to_parquet")
        return queries.map_partitions(_frame, shared, meta=_frame(queries._meta, here))
    if client is None:
        client = _current()
    slots = sum(client.nthreads().values()) if client is not None else os.cpu_count() or 1
    job = job_of(queries, here, partition_rows, max(1, slots // threads), to)
    task = package.delayed(run, pure=False)
    folder = None if to is None else os.path.abspath(os.fspath(to))
    tasks = [task(shared, part, at, folder) for at, part in enumerate(job.parts)]
    answers = package.compute(*tasks) if client is None else client.gather(client.compute(tasks))
    return job.finish(answers, here, to)


def _current() -> Any:
    """Give the client of this process, if there is one."""
    try:
        distributed = need("distributed", "dask")
    except ImportError:
        return None  # Dask alone computes with threads.
    try:
        return distributed.get_client()
    except ValueError:
        return None


def _same(solver: Solver) -> Solver:
    return solver


def _frame(frame: Any, solver: Solver) -> Any:
    """Answer a partition of pandas."""
    answer = solver(pa.Table.from_pandas(frame))
    paths = {
        pa_type: _arrow_type(pa_type) for pa_type in answer.schema.types if pa.types.is_large_list(pa_type)
    }
    return answer.to_pandas(types_mapper=paths.get)


def _arrow_type(kind: pa.DataType) -> Any:
    return need("pandas", "dask").ArrowDtype(kind)
