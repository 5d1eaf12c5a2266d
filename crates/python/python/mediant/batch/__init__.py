"""Millions of queries over many maps: on one machine, on Dask or on Ray, from tables to tables.

A table of queries has the integer columns ``start_row``, ``start_column``, ``goal_row`` and ``goal_column``,
and ``map``, the key of a map. The answer has the same rows in the same order, and two more columns, or three:
``distance``, ``status`` and, if asked for, ``path``. Tables are those of Arrow, so that pandas, polars,
DuckDB and Parquet files can take part. Where the cells of a map have costs, the distance of a path is its
cost. `fields` makes the distances, or costs, of all cells to each of many sources.

It needs pyarrow: ``pip install "mediant[batch]"``; on clusters ``"mediant[dask]"`` or ``"mediant[ray]"``.

Examples
--------
>>> import mediant
>>> from mediant import batch
>>> hall, wall = [["....", ".##.", "...."], ["..#."]]
>>> maps = {"hall": mediant.Grid.from_rows(hall), "wall": mediant.Grid.from_rows(wall)}
>>> queries = {
...     "map": ["hall", "wall", "wall"],
...     "start_row": [1, 0, 0], "start_column": [0, 0, 0],
...     "goal_row": [1, 0, 0], "goal_column": [3, 3, 2],
... }
>>> answer = batch.solve(queries, maps, k=2)
>>> answer["distance"].to_pylist(), answer["status"].to_pylist()
([5.0, inf, None], ['found', 'unreachable', 'invalid'])
"""

from __future__ import annotations

from ._need import need

need("pyarrow", "batch")

from ._cache import Cache, cache  # noqa: E402
from ._columns import TableError  # noqa: E402
from ._fields import fields  # noqa: E402
from ._results import waypoints  # noqa: E402
from ._solver import Solver, solve  # noqa: E402
from .on_dask import dask  # noqa: E402
from .on_ray import ray  # noqa: E402

__all__ = ["Cache", "Solver", "TableError", "cache", "dask", "fields", "ray", "solve", "waypoints"]
