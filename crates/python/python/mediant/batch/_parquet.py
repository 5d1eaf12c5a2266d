"""Parquet files: one, several, or a folder of them."""

from __future__ import annotations

import os
from typing import Any

import pyarrow as pa
import pyarrow.dataset as ds

__all__ = ["fragments_of", "read"]


def read(paths: Any) -> pa.Table:
    """Read Parquet files, in the order that parts have."""
    fragments, schema = fragments_of(paths)
    return pa.concat_tables(
        [schema.empty_table(), *(fragment.to_table(schema=schema) for fragment in fragments)]
    )


def fragments_of(paths: Any) -> tuple[list[Any], pa.Schema]:
    """Give the fragments of Parquet files, in the order that parts have, and the schema of all."""
    several = isinstance(paths, (list, tuple))
    where = [os.fspath(path) for path in paths] if several else os.fspath(paths)
    dataset = ds.dataset(where, format="parquet", partitioning="hive")
    fragments = list(dataset.get_fragments())
    return fragments if several else sorted(fragments, key=lambda fragment: fragment.path), dataset.schema
