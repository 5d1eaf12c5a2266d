"""Pathfinding on grids: 4, 8, 16, 32 and more directions, or any angle.

Points are (row, column) everywhere, as in NumPy. A map is a 2-D array of bool, in which True is blocked; a
path is an integer array of shape (n, 2), or None if there is none; distances are floats, infinite where no
path leads. Cells may have costs (`Grid.from_costs`): paths are the cheapest then, and distances are costs. Or
they have elevations (`Grid.from_elevation`): distances are the times of walking then.

Examples
--------
>>> import numpy as np
>>> import mediant
>>> blocked = np.zeros((5, 9), dtype=bool)
>>> blocked[:4, 4] = True
>>> grid = mediant.Grid(blocked)
>>> grid.path((0, 0), (0, 8)).tolist()
[[0, 0], [3, 3], [4, 3], [4, 5], [1, 8], [0, 8]]
>>> round(grid.distance((0, 0), (0, 8)), 3)
12.485
"""

from __future__ import annotations

from typing import Final

from ._mediant import (
    Answer,
    Disc,
    Field,
    Grid,
    Index,
    Paths,
    Scenario,
    Search,
    World,
    __version__,
    bound,
    moves,
    spaced,
)
from .errors import (
    ArgumentError,
    BrokenPathError,
    FileError,
    IndexFileError,
    LimitReached,
    MapError,
    MediantError,
    MismatchError,
    MissingFileError,
    OptionError,
    QueryError,
)

N4, N8, N16, N32, N64 = 2, 3, 4, 5, 6
"""The k of 4, 8, 16, 32 and 64 directions."""

ANY: Final = "any"
"""The k of any angle."""

__all__ = [
    "ANY",
    "N4",
    "N8",
    "N16",
    "N32",
    "N64",
    "Answer",
    "ArgumentError",
    "BrokenPathError",
    "Disc",
    "Field",
    "FileError",
    "Grid",
    "Index",
    "IndexFileError",
    "LimitReached",
    "MapError",
    "MediantError",
    "MismatchError",
    "MissingFileError",
    "OptionError",
    "Paths",
    "QueryError",
    "Scenario",
    "Search",
    "World",
    "__version__",
    "bound",
    "moves",
    "spaced",
]
