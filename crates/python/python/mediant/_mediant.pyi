"""The types of the compiled module; its docstrings describe the items: `help(mediant.Grid)`."""

import os
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from typing import Any, Literal, Protocol, SupportsFloat, SupportsIndex, TypeVar, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self, TypeAlias, TypedDict, Unpack

__all__ = [
    "Answer",
    "Disc",
    "Field",
    "Grid",
    "Index",
    "Paths",
    "Scenario",
    "Search",
    "World",
    "__version__",
    "bound",
    "moves",
    "spaced",
]

Point: TypeAlias = Sequence[SupportsIndex] | NDArray[np.integer[Any]]
"""A vertex: (row, column)."""

Points: TypeAlias = Point | Sequence[Point] | NDArray[np.integer[Any]]
"""One vertex, or several: an integer array of shape (n, 2)."""

Place: TypeAlias = Point | Sequence[SupportsFloat] | NDArray[np.floating[Any]]
"""A vertex, or for paths at any angle a point between vertices: (row, column)."""

Places: TypeAlias = Place | Sequence[Place] | NDArray[np.integer[Any]] | NDArray[np.floating[Any]]
"""One of them, or several: an array of shape (n, 2)."""

Waypoints: TypeAlias = NDArray[np.int32] | NDArray[np.float64]
"""The points of a path: float64 if one of them lies between vertices."""

CellSize: TypeAlias = SupportsFloat | Sequence[SupportsFloat]
"""The side of a cell, or its height and its width."""

class DataArray(Protocol):
    """A raster of xarray, by what is read of it."""

    @property
    def dims(self) -> tuple[Hashable, ...]: ...
    @property
    def coords(self) -> Any: ...
    @property
    def attrs(self) -> Any: ...
    @property
    def values(self) -> Any: ...

class Dataset(Protocol):
    """A dataset of rasterio, by what is read of it."""

    @property
    def count(self) -> int: ...
    @property
    def crs(self) -> Any: ...
    @property
    def transform(self) -> Any: ...
    def read(self, indexes: int, /, *, masked: bool) -> Any: ...

Raster = TypeVar("Raster", bound=DataArray)

K: TypeAlias = SupportsIndex | Literal["any"]
PathPoints: TypeAlias = Literal["waypoints", "vertices", "touched"]
Heading: TypeAlias = Literal["to", "from"]

# described: calls
Placement: TypeAlias = Literal["center", "corner"]
Corners: TypeAlias = Literal["never", "one", "always"]
Gap: TypeAlias = Literal["open", "closed"]
Engine: TypeAlias = Literal[
    "astar",
    "dijkstra",
    "wavefront",
    "canonical",
    "jps",
    "jps-block",
    "jps-plus",
    "theta",
    "lazy-theta",
    "anya",
    "subgoal",
    "subgoal-theta",
    "hpa",
    "chpa",
    "landmarks",
]
Heuristic: TypeAlias = Literal["hk", "euclidean", "zero"]
Smooth: TypeAlias = Literal["linear", "taut"]
Status: TypeAlias = Literal["found", "unreachable", "nearest", "stopped", "invalid"]
Limit: TypeAlias = Literal["cost", "expansions", "timeout", "cancelled"]
Stage: TypeAlias = Literal["edges", "hierarchy", "sight", "labels", "vertices"]
Origin: TypeAlias = Literal["prepared", "loaded", "repaired", "unchanged"]

class Motion(TypedDict, total=False):
    """The motion of an agent."""

    k: SupportsIndex | Literal["any"] | None
    neighbors: SupportsIndex | None
    placement: Placement | None
    corners: Corners | None
    gap: Gap | None

class Wishes(TypedDict, total=False):
    """Wishes beyond the ends of a path."""

    nearest: bool | None
    snap: bool | None
    tolerance: SupportsFloat | None
    max_cost: SupportsFloat | None
    max_expansions: SupportsIndex | None
    timeout: SupportsFloat | None

class Options(TypedDict, total=False):
    """The options of engines. Each engine takes some of them."""

    heuristic: Heuristic | None
    levels: SupportsIndex | Literal["all", "contracted", "labels"] | None
    memory: SupportsIndex | str | None
    side: SupportsIndex | None
    landmarks: SupportsIndex | None
    smooth: Smooth | None

class FromGrid(Motion, Wishes, Options, total=False):
    """All of them, with the engine."""

    engine: Engine | Literal["auto"] | None

# described: end

@final
class Grid:
    def __new__(
        cls,
        array: ArrayLike,
        *,
        above: SupportsFloat | None = None,
        below: SupportsFloat | None = None,
        values: Iterable[SupportsFloat] | None = None,
        resolution: SupportsFloat | None = None,
        origin: Sequence[SupportsFloat] | None = None,
        world: World | None = None,
        costs: ArrayLike | None = None,
        cell_size: CellSize | None = None,
    ) -> Self: ...
    @staticmethod
    def from_costs(
        costs: ArrayLike | DataArray | Dataset,
        *,
        nodata: SupportsFloat | Iterable[SupportsFloat] | None = None,
        cell_size: CellSize | None = None,
        transform: Iterable[SupportsFloat] | None = None,
        world: World | None = None,
    ) -> Grid: ...
    @staticmethod
    def from_elevation(
        elevation: ArrayLike | DataArray | Dataset,
        *,
        pace: Literal["tobler", "langmuir"] | ArrayLike = "tobler",
        friction: ArrayLike | DataArray | Dataset | None = None,
        nodata: SupportsFloat | Iterable[SupportsFloat] | None = None,
        cell_size: CellSize | None = None,
        transform: Iterable[SupportsFloat] | None = None,
        world: World | None = None,
    ) -> Grid: ...
    @staticmethod
    def from_costmap(
        costmap: ArrayLike,
        *,
        weight: SupportsFloat = 2.0,
        unknown: SupportsIndex | None = None,
        world: World | None = None,
    ) -> Grid: ...
    @staticmethod
    def open(
        path: str | os.PathLike[str],
        *,
        threshold: str | SupportsFloat = 0.5,
        invert: bool = False,
        unknown: Literal["blocked", "free"] = "blocked",
        ros: Literal[1, 2] = 2,
        free: str | None = None,
        blocked: str | None = None,
    ) -> Grid: ...
    @staticmethod
    def from_rows(rows: Iterable[str], *, free: str | None = None, blocked: str | None = None) -> Grid: ...
    @staticmethod
    def from_occupancy(
        occupancy: ArrayLike,
        width: SupportsIndex | None = None,
        height: SupportsIndex | None = None,
        *,
        resolution: SupportsFloat,
        origin: Sequence[SupportsFloat] = (0.0, 0.0, 0.0),
        occupied: SupportsFloat = 65,
        free: SupportsFloat = 25,
        unknown: Literal["blocked", "free"] = "blocked",
    ) -> Grid: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def world(self) -> World | None: ...
    @property
    def id(self) -> str: ...
    @property
    def costs(self) -> NDArray[np.float64] | None: ...
    @property
    def has_costs(self) -> bool: ...
    @property
    def elevation(self) -> NDArray[np.float64] | None: ...
    @property
    def friction(self) -> NDArray[np.float64] | None: ...
    @property
    def pace(self) -> Literal["tobler", "langmuir"] | NDArray[np.float64] | None: ...
    @property
    def cell_size(self) -> tuple[float, float]: ...
    def to_numpy(self) -> NDArray[np.bool_]: ...
    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    def _repr_png_(self) -> bytes: ...
    def edit(self, at: Point, blocked: ArrayLike) -> Grid: ...
    def edit_cells(self, cells: Points, blocked: bool | ArrayLike) -> Grid: ...
    def edit_costs(self, cells: Points, costs: ArrayLike) -> Grid: ...
    def inflated(
        self,
        *,
        inflation_radius: SupportsFloat,
        inscribed_radius: SupportsFloat = 0.0,
        cost_scaling_factor: SupportsFloat | None = None,
        weight: SupportsFloat = 2.0,
    ) -> Grid: ...
    def with_world(self, world: World | None) -> Grid: ...
    def is_free(self, point: Place, **motion: Unpack[Motion]) -> bool: ...
    def connected(self, start: Place, goal: Place, **motion: Unpack[Motion]) -> bool: ...
    def sees(self, start: Place, goal: Place, **motion: Unpack[Motion]) -> bool: ...
    def check(self, path: ArrayLike, **motion: Unpack[Motion]) -> None: ...
    def holds(self, path: ArrayLike, **motion: Unpack[Motion]) -> bool: ...
    def path(
        self, start: Places, goal: Places, *, points: PathPoints = "waypoints", **how: Unpack[FromGrid]
    ) -> Waypoints | None: ...
    def distance(self, start: Places, goal: Places, **how: Unpack[FromGrid]) -> float: ...
    def find(
        self,
        start: Places,
        goal: Places,
        *,
        points: PathPoints = "waypoints",
        counters: bool = False,
        **how: Unpack[FromGrid],
    ) -> Answer: ...
    def paths(
        self,
        starts: Places,
        goals: Places,
        *,
        points: PathPoints = "waypoints",
        threads: SupportsIndex | None = None,
        progress: Callable[[int, int], object] | None = None,
        invalid: Literal["raise", "none"] = "raise",
        **how: Unpack[FromGrid],
    ) -> Paths: ...
    def setup(self, **how: Unpack[FromGrid]) -> str: ...
    def engine(self, **motion: Unpack[Motion]) -> tuple[Engine, str]: ...
    def prepare(
        self,
        engine: Engine | Literal["auto"] | None = None,
        *,
        k: K | None = None,
        neighbors: SupportsIndex | None = None,
        placement: Placement | None = None,
        corners: Corners | None = None,
        gap: Gap | None = None,
        threads: SupportsIndex | None = None,
        progress: Callable[[str, int, int], object] | None = None,
        **options: Unpack[Options],
    ) -> Index: ...
    def load(self, path: str | os.PathLike[str], **options: Unpack[Options]) -> Index: ...
    def index_from_bytes(self, data: bytes, **options: Unpack[Options]) -> Index: ...
    def field(
        self,
        sources: Places,
        *,
        limit: SupportsFloat | None = None,
        heading: Heading = "to",
        progress: Callable[[int, int], object] | None = None,
        **motion: Unpack[Motion],
    ) -> Field: ...
    def distances(
        self,
        sources: Places,
        *,
        limit: SupportsFloat | None = None,
        heading: Heading = "to",
        progress: Callable[[int, int], object] | None = None,
        **motion: Unpack[Motion],
    ) -> NDArray[np.float64]: ...
    def reach(
        self,
        sources: Places,
        limit: SupportsFloat,
        *,
        heading: Heading = "from",
        **motion: Unpack[Motion],
    ) -> NDArray[np.bool_]: ...
    def flow(
        self,
        sources: Places,
        *,
        limit: SupportsFloat | None = None,
        heading: Heading = "to",
        **motion: Unpack[Motion],
    ) -> NDArray[np.float64]: ...
    def clearance(
        self,
        *,
        fit: Literal["centers", "whole-cells"] = "centers",
        outside: Literal["blocked", "open"] = "blocked",
    ) -> NDArray[np.float64]: ...
    def for_disc(
        self,
        radius: SupportsFloat | None = None,
        *,
        meters: SupportsFloat | None = None,
        fit: Literal["centers", "whole-cells"] | None = None,
        outside: Literal["blocked", "open"] = "blocked",
        **motion: Unpack[Motion],
    ) -> Grid: ...
    def disc(
        self,
        radius: SupportsFloat | None = None,
        *,
        meters: SupportsFloat | None = None,
        **motion: Unpack[Motion],
    ) -> Disc: ...
    def for_square(self, side: SupportsIndex) -> Grid: ...
    def widest_path(
        self,
        start: Point,
        goal: Point,
        *,
        surplus: SupportsFloat,
        points: PathPoints = "waypoints",
        **motion: Unpack[Motion],
    ) -> tuple[Waypoints, float] | None: ...

@final
class Disc:
    @property
    def grid(self) -> Grid: ...
    @property
    def obstacles(self) -> Grid: ...
    @property
    def radius(self) -> float: ...
    def edit(self, at: Point, blocked: ArrayLike) -> Disc: ...

@final
class Index:
    @property
    def grid(self) -> Grid: ...
    @property
    def engine(self) -> Engine: ...
    @property
    def k(self) -> int | Literal["any"]: ...
    @property
    def placement(self) -> Placement: ...
    @property
    def rule(self) -> Literal["never", "one", "always", "open", "closed"]: ...
    @property
    def levels(self) -> int | Literal["all", "contracted", "labels"] | None: ...
    @property
    def searched_by(self) -> Engine: ...
    @property
    def setup(self) -> str: ...
    @property
    def origin(self) -> Origin: ...
    @property
    def is_finished(self) -> bool: ...
    @property
    def guarantee(self) -> str: ...
    @property
    def bound(self) -> float | None: ...
    @property
    def memory_bytes(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    def path(
        self, start: Places, goal: Places, *, points: PathPoints = "waypoints", **wishes: Unpack[Wishes]
    ) -> Waypoints | None: ...
    def distance(self, start: Places, goal: Places, **wishes: Unpack[Wishes]) -> float: ...
    def find(
        self,
        start: Places,
        goal: Places,
        *,
        points: PathPoints = "waypoints",
        counters: bool = False,
        **wishes: Unpack[Wishes],
    ) -> Answer: ...
    def paths(
        self,
        starts: Places,
        goals: Places,
        *,
        points: PathPoints = "waypoints",
        threads: SupportsIndex | None = None,
        progress: Callable[[int, int], object] | None = None,
        invalid: Literal["raise", "none"] = "raise",
        **wishes: Unpack[Wishes],
    ) -> Paths: ...
    def distances(
        self,
        starts: Places,
        goals: Places,
        *,
        threads: SupportsIndex | None = None,
        progress: Callable[[int, int], object] | None = None,
        invalid: Literal["raise", "none"] = "raise",
        **wishes: Unpack[Wishes],
    ) -> NDArray[np.float64]: ...
    def table(
        self,
        starts: Places,
        goals: Places,
        *,
        threads: SupportsIndex | None = None,
        progress: Callable[[int, int], object] | None = None,
    ) -> NDArray[np.float64]: ...
    def nearest(
        self,
        starts: Places,
        goals: Places,
        *,
        threads: SupportsIndex | None = None,
        progress: Callable[[int, int], object] | None = None,
        invalid: Literal["raise", "none"] = "raise",
    ) -> tuple[NDArray[np.int64], NDArray[np.float64]]: ...
    def find_except(
        self,
        start: Places,
        goal: Places,
        *,
        blocked: Points | None = None,
        free: Points | None = None,
        free_ends: bool = False,
        points: PathPoints = "waypoints",
        counters: bool = False,
        **wishes: Unpack[Wishes],
    ) -> Answer: ...
    def search(
        self,
        start: Places,
        goal: Places,
        *,
        points: PathPoints = "waypoints",
        trace: bool = False,
        **wishes: Unpack[Wishes],
    ) -> Search: ...
    def with_options(self, **options: Unpack[Options]) -> Index: ...
    def repair(self, grid: Grid) -> Index: ...
    def finish(self) -> Index: ...
    def save(self, path: str | os.PathLike[str]) -> None: ...
    def to_bytes(self) -> bytes: ...

@final
class Search:
    @property
    def best(self) -> Waypoints: ...
    @property
    def lower_bound(self) -> float: ...
    @property
    def expansions(self) -> int: ...
    @property
    def answer(self) -> Answer | None: ...
    def step(self, expansions: SupportsIndex = 1) -> Answer | None: ...
    def finish(self) -> Answer: ...
    def path_to(self, point: Place) -> Waypoints | None: ...
    def expanded(self) -> NDArray[np.int32]: ...
    def generated(self) -> NDArray[np.int32]: ...
    def write_trace(self, path: str | os.PathLike[str]) -> None: ...

@final
class Answer:
    @property
    def status(self) -> Status: ...
    @property
    def path(self) -> Waypoints | None: ...
    @property
    def distance(self) -> float: ...
    @property
    def cost(self) -> float: ...
    @property
    def length(self) -> float: ...
    @property
    def stopped_by(self) -> Limit | None: ...
    @property
    def best(self) -> Waypoints | None: ...
    @property
    def lower_bound(self) -> float: ...
    @property
    def any_angle_lower_bound(self) -> float | None: ...
    @property
    def counters(self) -> dict[str, int] | None: ...
    @property
    def searched_by(self) -> Engine | None: ...

@final
class Paths:
    @property
    def points(self) -> Waypoints: ...
    @property
    def offsets(self) -> NDArray[np.int64]: ...
    @property
    def distances(self) -> NDArray[np.float64]: ...
    @property
    def statuses(self) -> NDArray[np.uint8]: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: SupportsIndex, /) -> Waypoints | None: ...
    @overload
    def __getitem__(self, index: slice, /) -> list[Waypoints | None]: ...
    def __iter__(self) -> Iterator[Waypoints | None]: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Field:
    @property
    def shape(self) -> tuple[int, int]: ...
    def distances(self) -> NDArray[np.float64]: ...
    def flow(self) -> NDArray[np.float64]: ...
    def next(self) -> Waypoints: ...
    def get(self, point: Place) -> float: ...
    def path_from(self, point: Place, *, points: PathPoints = "waypoints") -> Waypoints | None: ...
    def path_to(self, point: Place, *, points: PathPoints = "waypoints") -> Waypoints | None: ...
    def nearest_source(self, point: Place) -> tuple[int, int] | tuple[float, float] | None: ...
    def allocation(self) -> NDArray[np.int32]: ...
    def directions(self, code: Literal["arcgis", "degrees", "grass"]) -> NDArray[np.float64]: ...
    def corridor(self, other: Field) -> NDArray[np.float64]: ...
    def to_xarray(self, like: Raster) -> Raster: ...
    def _repr_png_(self) -> bytes: ...

@final
class World:
    def __new__(
        cls,
        resolution: SupportsFloat,
        origin: Sequence[SupportsFloat] = (0.0, 0.0, 0.0),
        *,
        shape: Sequence[SupportsIndex],
    ) -> Self: ...
    @property
    def resolution(self) -> float: ...
    @property
    def origin(self) -> tuple[float, float, float]: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    def cells(self, meters: SupportsFloat) -> float: ...
    def vertex_at(
        self, x: SupportsFloat, y: SupportsFloat, *, placement: Placement = "center"
    ) -> tuple[int, int] | None: ...
    def place_at(
        self, x: SupportsFloat, y: SupportsFloat, *, placement: Placement = "center"
    ) -> tuple[float, float] | None: ...
    def point_of(self, points: ArrayLike, *, placement: Placement = "center") -> NDArray[np.float64]: ...

@final
class Scenario:
    @staticmethod
    def open(path: str | os.PathLike[str]) -> Scenario: ...
    @staticmethod
    def from_bytes(data: bytes) -> Scenario: ...
    @property
    def starts(self) -> NDArray[np.int32]: ...
    @property
    def goals(self) -> NDArray[np.int32]: ...
    @property
    def lengths(self) -> NDArray[np.float64]: ...
    @property
    def buckets(self) -> NDArray[np.uint32]: ...
    @property
    def maps(self) -> list[str]: ...
    @property
    def shapes(self) -> NDArray[np.uint32]: ...
    def check(self, grid: Grid) -> None: ...
    def __len__(self) -> int: ...

__version__: str

def moves(k: K) -> NDArray[np.int32]: ...
def spaced(path: ArrayLike, spacing: SupportsFloat) -> NDArray[np.float64]: ...
def bound(
    k: K,
    *,
    neighbors: SupportsIndex | None = None,
    placement: Placement | None = None,
    corners: Corners | None = None,
    gap: Gap | None = None,
) -> float | None: ...
