"""A program with types, which `mypy --strict` checks; and mistakes that it has to find."""

from __future__ import annotations

from typing import Union

import mediant
import numpy as np
from numpy.typing import NDArray

Waypoints = Union[NDArray[np.int32], NDArray[np.float64]]

blocked: NDArray[np.bool_] = np.zeros((5, 9), dtype=bool)
grid = mediant.Grid(blocked)
path: Waypoints | None = grid.path((0, 0), (4, 8), k=3, corners="one", points="touched", timeout=1.0)
distance: float = grid.distance((0, 0), [(4, 8), (3, 3)], k=mediant.ANY)
index: mediant.Index = grid.prepare("subgoal", k=mediant.N8, levels="contracted")
paths: mediant.Paths = index.paths(np.array([[0, 0]]), [(4, 8)], threads=2, progress=print)
part: list[Waypoints | None] = paths[:1]
numbers: NDArray[np.float64] = index.table([(0, 0)], [(4, 8)])
status: str = index.find((0, 0), (4, 8), nearest=True).status
shape: tuple[int, int] = grid.field((0, 0), placement="corner").shape
distance = grid.field((0, 0)).get((1, 1))
many: mediant.Paths = grid.paths([(0, 0)], (4, 8), k=4, max_cost=20, invalid="none")
least: float | None = grid.find((0, 0), (4, 8)).any_angle_lower_bound
search: mediant.Search = index.search((0, 0), (4, 8), trace=True, timeout=1.0)
answer: mediant.Answer | None = search.step(10)
best: Waypoints = search.best
spaced: NDArray[np.float64] = mediant.spaced([(0, 0), (4, 8)], 0.5)
world: mediant.World = mediant.World(0.05, (1, 2), shape=grid.shape)
scenario: mediant.Scenario = mediant.Scenario.from_bytes(b"version 1\n")
starts: NDArray[np.int32] = scenario.starts
disc: mediant.Disc = mediant.Grid(blocked, world=world).disc(meters=0.1).edit((0, 0), [[True]])
around: mediant.Answer = index.find_except((0, 0), (4, 8), blocked=[(1, 1)], free_ends=True)
bound: float | None = mediant.bound(4, placement="corner")
again: mediant.Grid = mediant.Grid(np.array([[1.5]]), above=1, values=(2, 3.5)).edit((0, 0), [[True]])
costly: mediant.Grid = mediant.Grid.from_costs(np.ones((5, 9), "f4"), nodata=-9, cell_size=(30, 20.5))
costs: NDArray[np.float64] | None = (
    mediant.Grid(blocked, costs=np.ones((5, 9), "u1")).edit_costs((0, 0), 2).costs
)
corridor: NDArray[np.float64] = costly.field((0, 0)).corridor(costly.field([(4, 8)]))
reached: NDArray[np.float64] = costly.distances((0, 0), progress=print)
links: NDArray[np.float64] = costly.field((0, 0)).directions("arcgis")
robot: mediant.Grid = mediant.Grid.from_costmap(np.zeros((5, 9), "u1"), unknown=252, world=world)
around_walls: mediant.Grid = grid.inflated(inflation_radius=3, inscribed_radius=0.5, weight=3)
price: float = costly.find((0, 0), (4, 8)).cost
land: mediant.Grid = mediant.Grid.from_elevation(np.ones((5, 9), "f4"), pace="langmuir", cell_size=30)
land = mediant.Grid.from_elevation([[1, 2.5]], pace=[(-1, 2), (1, 3)], friction=[[0, 1]], cell_size=(3, 2))
away: Waypoints | None = land.field((0, 0), heading="from", limit=9).path_to((0, 1))
pace: str | NDArray[np.float64] | None = land.pace
for one in paths:
    if one is not None:
        rows: Waypoints = one[:, 0]
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
grid.field((0, 0), heading="away")  # type: ignore[arg-type]
index.path((0, 0), (4, 8), k=3)  # type: ignore[call-arg]
index.search((0, 0), (4, 8), k=3)  # type: ignore[call-arg]
mediant.World(1)  # type: ignore[call-arg]
index.engine = "astar"  # type: ignore[misc]
path.tolist()  # type: ignore[union-attr]
