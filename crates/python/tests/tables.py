"""Tables of queries and their maps, for the tests of batches."""

from __future__ import annotations

import mediant
import numpy as np
import pyarrow as pa

ENDS = ("start_row", "start_column", "goal_row", "goal_column")
SEED = 20_240_607


def a_map(seed, rows=24, columns=31, share=0.25):
    return mediant.Grid(np.random.default_rng(seed).random((rows, columns)) < share)


MAPS = {"a": a_map(1), "b": a_map(2, 17, 40), "c": a_map(3, 9, 9, 0.6)}


def a_table(count, keys=tuple(MAPS), seed=SEED):
    """Queries with ends that are free, blocked and outside."""
    random = np.random.default_rng(seed)
    ends = {name: random.integers(-1, 25, count) for name in ENDS}
    return pa.table({"map": random.choice(keys, count), **ends, "tag": np.arange(count)})
