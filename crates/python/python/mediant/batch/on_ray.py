"""On Ray: a task for each part of a table."""

from __future__ import annotations

import os
from typing import Any

from ._need import need
from ._parts import job_of, run
from ._solver import Solver

__all__ = ["ray"]


def ray(
    queries: Any,
    maps: Any,
    *,
    to: str | os.PathLike[str] | None = None,
    partition_rows: int | None = None,
    threads: int = 1,
    ship: bool = False,
    retries: int = 3,
    **how: Any,
) -> Any:
    """Answer a table of queries on a cluster of Ray.

    The tasks of a worker process share its indexes, each of which is made once. A task whose worker is lost
    runs again on another one. Without a cluster, `ray.init` starts one on this machine.

    Parameters
    ----------
    queries : table or path
        As for `solve`. Files are read by the workers.
    maps : Mapping, or one map
        As for `Solver`. A map in memory is sent to each machine once; a path is opened by the worker.
    to : path, optional
        A folder that all workers can write to. Each task writes a Parquet file to it, ``part-000000.parquet``
        and so on, in the order of the queries, and only the names come back.
    partition_rows : int, optional
        The rows of a task. None: a quarter of what each task that can run at once gets, from 20,000 to
        100,000.
    threads : int
        The threads of a task, and the CPUs that Ray reserves for it. A worker process of Ray runs one task at
        a time: with many large indexes, a few processes of many threads take less memory than many of one.
    ship : bool
        Whether the indexes are made here, and sent instead of the maps. An index that is given is always
        sent.
    retries : int
        The number of times that a task may lose its worker.
    **how
        As for `Solver`.

    Returns
    -------
    pyarrow.Table or list of str
        The answer as `solve` gives it; the paths of its files, if `to` is given.

    Raises
    ------
    MediantError
        As for `solve`; those of rows are raised by the worker.
    FileExistsError
        `to` holds the parts of an answer.
    ImportError
        Ray is not there: ``pip install "mediant[ray]"``.

    Examples
    --------
    >>> import mediant
    >>> from mediant import batch
    >>> grid = mediant.Grid.from_rows(["...", ".#."])
    >>> queries = {"start_row": [0, 1], "start_column": [0, 2], "goal_row": [1, 1], "goal_column": [2, 0]}
    >>> batch.ray(queries, grid, k=2)["distance"].to_pylist()  # doctest: +SKIP
    [3.0, 4.0]
    """
    package = need("ray", "ray")
    here = Solver(maps, threads=threads, **how)
    if not package.is_initialized():
        package.init()
    slots = int(package.cluster_resources().get("CPU", 1)) // threads
    job = job_of(queries, here, partition_rows, max(1, slots), to)
    shared = package.put(here.packed(threads=threads, indexes=ship))
    task = package.remote(run).options(num_cpus=threads, max_retries=retries, name="mediant.batch")
    folder = None if to is None else os.path.abspath(os.fspath(to))
    answers = package.get([task.remote(shared, part, at, folder) for at, part in enumerate(job.parts)])
    return job.finish(answers, here, to)
