"""A program with types, which `mypy --strict` checks; and mistakes that it has to find."""

from __future__ import annotations

import mediant
import numpy as np
from numpy.typing import NDArray

blocked: NDArray[np.bool_] = np.zeros((5, 9), dtype=bool)
grid = mediant.Grid(blocked)
path: NDArray[np.int32] | None = grid.path((0, 0), (4, 8), k=3, corners="one", points="touched", timeout=1.0)
distance: float = grid.distance((0, 0), [(4, 8), (3, 3)], k=mediant.ANY)
index: mediant.Index = grid.prepare("subgoal", k=mediant.N8, levels="contracted")
paths: mediant.Paths = index.paths(np.array([[0, 0]]), [(4, 8)], threads=2, progress=print)
part: list[NDArray[np.int32] | None] = paths[:1]
numbers: NDArray[np.float64] = index.table([(0, 0)], [(4, 8)])
status: str = index.find((0, 0), (4, 8), nearest=True).status
shape: tuple[int, int] = grid.field((0, 0), placement="corner").shape
bound: float | None = mediant.bound(4, placement="corner")
again: mediant.Grid = mediant.Grid(np.array([[1.5]]), above=1, values=(2, 3.5)).edit((0, 0), [[True]])
for one in paths:
    if one is not None:
        rows: NDArray[np.int32] = one[:, 0]
try:
    grid.check([(0, 0), (4, 8)])
except mediant.BrokenPathError as error:
    count: int = error.holds_up_to

# Each of these must be an error, or `mypy --warn-unused-ignores` complains.
grid.path((0, 0), (4, 8), kk=3)  # type: ignore[call-arg]
grid.path((0, 0), (4, 8), k="all")  # type: ignore[arg-type]
grid.path((0, 0))  # type: ignore[call-arg]
grid.path((0, 0), (4, 8), corners="some")  # type: ignore[arg-type]
grid.prepare("a-star")  # type: ignore[arg-type]
index.path((0, 0), (4, 8), k=3)  # type: ignore[call-arg]
index.engine = "astar"  # type: ignore[misc]
path.tolist()  # type: ignore[union-attr]
