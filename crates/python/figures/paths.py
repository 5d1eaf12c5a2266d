"""Draws the figure of the README: one map, with the shortest paths of four k. Usage: paths.py OUT.png."""

from __future__ import annotations

import sys

import matplotlib as mpl
import mediant
import numpy as np
from mediant import plot

mpl.use("Agg")

ISLANDS = (
    *((5, 11, 4.5), (4, 27, 2.5), (15, 21, 4.5), (21, 38, 5.5), (6, 42, 4.5)),
    *((28, 12, 4.5), (15, 53, 3.5), (29, 51, 3.5), (12, 32, 1.5), (31, 28, 2.5)),
)
"""The row, column and radius of each, in cells."""


def main(out: str) -> None:
    """Draw the figure into a file."""
    rows, columns = np.indices((36, 60))
    blocked = np.zeros((36, 60), dtype=bool)
    for row, column, radius in ISLANDS:
        blocked |= (rows - row) ** 2 + (columns - column) ** 2 <= radius**2
    grid = mediant.Grid(blocked)
    start, goal = (24, 2), (6, 57)

    paths = {}
    for k in (2, 3, 4, "any"):
        length = grid.distance(start, goal, k=k, placement="corner")
        name = "any angle" if k == "any" else f"k = {k}"
        paths[f"{name}: {length:.2f}"] = grid.path(start, goal, k=k, placement="corner")
    ax = plot.show(grid, paths, placement="corner")
    ax.set(xticks=[], yticks=[], xlabel="", ylabel="")
    ax.figure.savefig(out, dpi=120, bbox_inches="tight", pad_inches=0.05)


if __name__ == "__main__":
    main(sys.argv[1])
