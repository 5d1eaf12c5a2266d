"""Many fields: of many sources on one map, or of many maps and tiles; here, or on a cluster of Dask."""

from __future__ import annotations

import os
import uuid
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._columns import TableError
from ._need import need
from ._solver import Solver

__all__ = ["fields"]

ENGINE = "dijkstra"
"""It prepares next to nothing: a field needs the map alone."""


def fields(
    sources: Mapping[Any, Any],
    maps: Any,
    *,
    limit: float | None = None,
    heading: Literal["to", "from"] = "to",
    to: str | os.PathLike[str] | None = None,
    client: Any = None,
    threads: int | None = None,
    **motion: Any,
) -> dict[Any, Any]:
    """Make a field for each of many sources: the distance, or the cost, of every vertex to it.

    A process opens each map once, and keeps it in `batch.cache`.

    Parameters
    ----------
    sources : Mapping
        By their names: a point (row, column), or several with shape (n, 2), to the nearest of which a field
        leads. If maps have keys: a pair of the key of a map and points on it.
    maps : Mapping, or one map
        As for `Solver`: of rasters those of `mediant.Grid.from_costs` and `mediant.Grid.from_elevation`.
    limit : float, optional
        The greatest distance or cost, as for `mediant.Grid.field`.
    heading : {"to", "from"}
        Whether the ways lead to the sources or from them, as for `mediant.Grid.field`.
    to : path, optional
        A folder that all workers can write to. Each field is written to it as ``<name>.npy``, and only the
        names of files come back.
    client : distributed.Client, optional
        The cluster, which has a task for each field. None: the threads of this process.
    threads : int, optional
        The most fields at a time in this process. All cores, if None.
    **motion
        ``k``, ``placement``, ``corners`` and ``gap``, as for `mediant.Grid.field`.

    Returns
    -------
    dict
        By the names of the sources: an array of float64 as `mediant.Grid.distances` gives it, or the path of
        its file.

    Raises
    ------
    TableError
        There is no map of a key, or a name is no name of a file.
    MediantError
        As for `mediant.Grid.field`.

    Examples
    --------
    >>> import numpy as np
    >>> import mediant
    >>> from mediant import batch
    >>> friction = np.array([[1.0, 1.0, 4.0], [2.0, 2.0, 2.0]])
    >>> clinics = {"north": (0, 0), "south": [(1, 2)]}
    >>> costs = batch.fields(clinics, mediant.Grid.from_costs(friction))
    >>> costs["north"].round(2).tolist()
    [[0.0, 1.0, 3.5], [1.5, 2.12, 3.12]]
    """
    here = Solver(maps, engine=ENGINE, **motion)
    jobs = {name: _job_of(name, wanted, here) for name, wanted in sources.items()}
    how = {"limit": limit, "heading": heading, **motion}
    folder = None if to is None else os.path.abspath(os.fspath(to))
    files = {name: None if folder is None else _file_of(folder, name) for name in jobs}
    if folder is not None:
        Path(folder).mkdir(parents=True, exist_ok=True)
    if client is None:
        with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
            tasks = {name: pool.submit(_field, here, *jobs[name], how, files[name]) for name in jobs}
            return {name: task.result() for name, task in tasks.items()}
    package = need("dask", "dask")
    shared = package.delayed(_same, pure=False)(package.delayed(here.packed(threads=1), pure=False))
    task = package.delayed(_field, pure=False)
    made = client.gather(client.compute([task(shared, *jobs[name], how, files[name]) for name in jobs]))
    return dict(zip(jobs, made))


def _field(
    solver: Solver, key: Any, points: NDArray[np.int64], how: dict[str, Any], file: str | None
) -> NDArray[np.float64] | str:
    """Make a field. This is the task that clusters run."""
    values: NDArray[np.float64] = solver._index(key).grid.distances(points, **how)
    return values if file is None else _write(values, Path(file))


def _same(solver: Solver) -> Solver:
    return solver


def _job_of(name: Any, wanted: Any, solver: Solver) -> tuple[Any, NDArray[np.int64]]:
    """Give the key of a map, and points on it."""
    key = None
    if solver.has_keys:
        try:
            key, wanted = wanted
        except (TypeError, ValueError):
            raise TableError(
                f"expected for the source {name!r} a pair of the key of a map and points", "source"
            ) from None
        if not solver.knows(key):
            raise TableError(f"the source {name!r} is on a map {key!r}, which there is not", "unknown-map")
    points = np.asarray(wanted)
    if points.dtype.kind not in "iu" or points.shape[-1:] != (2,) or points.ndim > 2:
        raise TableError(
            f"expected for the source {name!r} a point (row, column), or integers of shape (n, 2)", "source"
        )
    return key, points.astype(np.int64)


def _file_of(folder: str, name: Any) -> str:
    if str(name) != os.path.basename(str(name)) or str(name) in ("", ".", ".."):
        raise TableError(f"the source {name!r} has a name that no file can have", "source")
    return os.path.join(folder, f"{name}.npy")


def _write(values: NDArray[np.float64], path: Path) -> str:
    """Write a file as a whole: who is killed meanwhile leaves no half of it under its name."""
    unfinished = path.with_name(f".{path.stem}-{uuid.uuid4().hex}.npy")
    try:
        np.save(unfinished, values)
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)
    return str(path)
