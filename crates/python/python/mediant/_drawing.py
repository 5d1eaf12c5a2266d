"""The drawing of `mediant.plot` with matplotlib, and the conversion of its arguments."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Union, cast

import numpy as np

from ._mediant import Field, Grid

try:
    import matplotlib.pyplot as plt
    from matplotlib import colormaps
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap, LogNorm
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine
    from matplotlib.patches import Patch, Polygon, Rectangle
    from matplotlib.patheffects import Normal, Stroke
    from matplotlib.ticker import MaxNLocator
    from matplotlib.transforms import Affine2D
except ImportError as error:
    raise ImportError('mediant.plot needs matplotlib: pip install "mediant[plot]"') from error

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D
    from matplotlib.quiver import Quiver
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import TypeAlias

    from ._mediant import Paths, Placement, World

    OnePath: TypeAlias = Union[ArrayLike, None]
    SeveralPaths: TypeAlias = Union[OnePath, Iterable[OnePath], Mapping[str, OnePath], Paths]
    Named: TypeAlias = list[tuple[Union[str, None], Union[NDArray[np.float64], None]]]

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "black")
"""Of lines, one after another: the colors of Okabe and Ito, which the color-blind can tell apart."""

STYLES: tuple[Any, ...] = ("solid", (0, (5, 1.5)), (0, (1.5, 1)), (0, (6, 1.5, 1.5, 1.5)))
"""Of lines, one after another, so that lines differ in gray print too."""

COLORMAP = ListedColormap(colormaps["cividis"](np.linspace(0.15, 1.0, 256)), name="distances")
"""Of distances: near ones dark, but lighter than blocked cells. Lightness grows all the way, for gray print,
and the color-blind see these colors as others do."""

COSTS = ListedColormap(colormaps["YlOrBr"](np.linspace(0.0, 0.7, 256)), name="costs")
"""Of costs: cheap cells nearly white, dear ones brown, all lighter than lines of paths."""

MANY_TIMES = 30.0
"""Costs that are so many times as great as others are drawn by their logarithms."""

BLOCKED, BLOCKED_ON_FIELD = "0.25", "black"

NOT_REACHED: dict[str, Any] = {"facecolor": "white", "edgecolor": "0.7", "hatch": "////", "linewidth": 0.0}

MARGIN = 0.012
"""Around the map, as a share of its longer side."""

ARROWS = 28
"""The most arrows along a side."""


class Canvas:
    """Axes, with the places of vertices on them.

    Parameters
    ----------
    ax : matplotlib.axes.Axes or None
        The axes to draw on; the current ones if None.
    placement : {"center", "corner"}
        The placement of the vertices of paths and of arrays.
    world : World or None
        To draw in meters rather than in cells.
    """

    def __init__(self, ax: Axes | None, placement: Placement, world: World | None) -> None:
        if placement not in ("center", "corner"):
            raise ValueError(f'expected placement "center" or "corner", found {placement!r}')
        self.ax = plt.gca() if ax is None else ax
        self.placement = placement
        self.world = world
        self.to_axes = _from_corners(world)

    def places(self, points: NDArray[Any]) -> NDArray[np.float64]:
        """Vertices, (row, column), as (x, y) on the axes."""
        corners = points[..., ::-1] + (0.5 if self.placement == "center" else 0.0)
        places: NDArray[np.float64] = self.to_axes.transform(corners.reshape(-1, 2)).reshape(corners.shape)
        return places

    def image(
        self, array: NDArray[Any], shape: tuple[int, int], look: Mapping[str, Any], block: int = 1
    ) -> AxesImage:
        """Draw an array on a map of this shape, with a square for each vertex or block of vertices.

        It shows the map as a whole, with its outline, and nothing outside.
        """
        rows, columns = shape
        height, width = array.shape[0] * block, array.shape[1] * block
        before = 0.0 if self.placement == "center" else 0.5
        drawn = self.ax.imshow(array, extent=(-before, width - before, height - before, -before), **look)
        to_display = self.to_axes + self.ax.transData
        drawn.set_transform(to_display)
        drawn.set_clip_path(Rectangle((0, 0), columns, rows, transform=to_display))
        outline = self.to_axes.transform([(0, 0), (columns, 0), (columns, rows), (0, rows)])
        self.ax.add_patch(Polygon(outline, fill=False, edgecolor="0.5", linewidth=0.8, zorder=1.8))
        # Some room, so that a path along the edge of the map, and its ends, are seen as a whole.
        room = MARGIN * np.ptp(outline, axis=0).max()
        (left, low), (right, high) = outline.min(axis=0) - room, outline.max(axis=0) + room
        self.ax.set_xlim(left, right)
        self.ax.set_ylim(*((high, low) if self.world is None else (low, high)))
        self.ax.set_aspect("equal")
        if self.world is None:
            self.ax.spines[:].set_visible(False)
            for axis in (self.ax.xaxis, self.ax.yaxis):
                axis.set_major_locator(MaxNLocator("auto", integer=True, steps=[1, 2, 5, 10]))
        self.ax.set_xlabel("column" if self.world is None else "x (m)")
        self.ax.set_ylabel("row" if self.world is None else "y (m)")
        return drawn

    def cells(self, blocked: NDArray[np.bool_], look: Mapping[str, Any], *, on_field: bool) -> AxesImage:
        """Draw the blocked cells, and the free ones too unless they lie on a field."""
        colors = ["#00000000", BLOCKED_ON_FIELD] if on_field else ["white", BLOCKED]
        rows, columns = blocked.shape
        # Of cells smaller than pixels many would not be seen. The axes may yet shrink, to make room for text.
        box = self.ax.get_window_extent()
        tall, wide = 0.7 * max(box.height, 2.0), 0.7 * max(box.width, 2.0)
        block = max(1, math.ceil(rows / tall), math.ceil(columns / wide))
        shades = _shades_of_blocks(blocked, block)
        colormap = LinearSegmentedColormap.from_list("cells", colors)
        look = {"cmap": colormap, "vmin": 0, "vmax": 1, "interpolation": "nearest", **look}
        return Canvas(self.ax, "center", self.world).image(shades, (rows, columns), look, block)

    def costs(self, costs: NDArray[np.float64], look: Mapping[str, Any]) -> AxesImage:
        """Draw the costs of cells."""
        masked = np.ma.masked_invalid(costs)
        wide = masked.count() > 0 and masked.max() > MANY_TIMES * masked.min()
        look = {"cmap": COSTS, "norm": LogNorm() if wide else None, "interpolation": "nearest", **look}
        return Canvas(self.ax, "center", self.world).image(masked, costs.shape[:2], look)

    def distances(
        self, distances: NDArray[np.float64], levels: ArrayLike | None, look: Mapping[str, Any]
    ) -> AxesImage:
        """Draw distances, hatched where there is none, with lines of equal distance."""
        masked = np.ma.masked_invalid(distances)
        rows, columns = map_shape(distances, self.placement)
        drawn = self.image(masked, (rows, columns), {"cmap": COLORMAP, "interpolation": "nearest", **look})
        to_display = self.to_axes + self.ax.transData
        behind = drawn.get_zorder() - 0.1
        self.ax.add_patch(
            Rectangle((0, 0), columns, rows, transform=to_display, zorder=behind, **NOT_REACHED)
        )
        if levels is not None:
            x, y = np.moveaxis(self.places(np.moveaxis(np.indices(distances.shape), 0, -1)), -1, 0)
            lines = self.ax.contour(x, y, masked, levels=levels, colors="white", linewidths=1.0)
            lines.set(path_effects=[Stroke(linewidth=2.0, foreground="black", alpha=0.5), Normal()])
        return drawn

    def paths(self, named: Named, look: Mapping[str, Any]) -> list[Line2D]:
        """Draw paths, each in a color and style of its own, with their ends."""
        lines = []
        ends: dict[tuple[float, ...], str] = {}
        for number, (name, points) in enumerate(named):
            if points is None or len(points) == 0:
                continue
            places = self.places(points)
            line: dict[str, Any] = {"linewidth": 2.2, "label": name, "solid_joinstyle": "round", **look}
            if not {"color", "c"} & look.keys():
                line["color"] = COLORS[number % len(COLORS)]
            if not {"linestyle", "ls"} & look.keys():
                line["linestyle"] = STYLES[number % len(STYLES)]
            # A pale rim keeps a line visible where it runs along a wall or over dark colors.
            rim = Stroke(linewidth=line.get("lw", line["linewidth"]) + 1.8, foreground="white", alpha=0.9)
            lines.extend(self.ax.plot(places[:, 0], places[:, 1], path_effects=[rim, Normal()], **line))
            ends.setdefault(tuple(places[0]), "o")
            ends.setdefault(tuple(places[-1]), "D")
        for (x, y), marker in ends.items():
            self.ax.plot(x, y, marker, color="black", markeredgecolor="white", markersize=7, zorder=3)
        return lines

    def arrows(self, directions: NDArray[np.float64], arrows: int, look: Mapping[str, Any]) -> Quiver:
        """Draw directions, if need be only those of every few vertices."""
        step = max(1, -(-max(directions.shape[:2]) // arrows))
        some = slice(step // 2, None, step)
        at = np.moveaxis(np.indices(directions.shape[:2]), 0, -1)[some, some]
        directions = directions[some, some]
        there = np.isfinite(directions).all(axis=-1) & directions.any(axis=-1)
        tails = self.places(at[there])
        vectors = self.places(at[there] + 0.75 * step * directions[there]) - tails
        line: dict[str, Any] = {"angles": "xy", "scale_units": "xy", "scale": 1, "pivot": "mid"}
        line.update(color="black", units="inches", width=0.0115, headwidth=4.0, zorder=1.9)
        line.update(path_effects=[Stroke(linewidth=1.2, foreground="white", alpha=0.7), Normal()])
        return self.ax.quiver(*tails.T, *vectors.T, **{**line, **look})

    def color_bar(self, image: AxesImage, label: str) -> None:
        """Add the scale of distances or costs, as high as the map."""
        (left, right), (low, high) = self.ax.get_xlim(), self.ax.get_ylim()
        longer = max(1.0, abs((high - low) / (right - left)))
        beside = self.ax.inset_axes((1 + 0.02 * longer, 0.0, 0.03 * longer, 1.0))
        self.ax.figure.colorbar(image, cax=beside, label=label)

    def legend(self, *, not_reached: bool) -> None:
        """Name what was drawn above the map, where it hides nothing, in as many columns as fit."""
        handles: list[Any] = list(self.ax.get_legend_handles_labels()[0])
        if not_reached:
            handles.append(Patch(label="not reached", **NOT_REACHED))
        if not handles:
            return
        # About as wide as texts of the usual size are.
        wide = sum(0.62 + 0.075 * len(str(handle.get_label())) for handle in handles)
        lines = np.ceil(wide / (self.ax.get_window_extent().width / self.ax.figure.dpi))
        columns = int(np.ceil(len(handles) / lines))
        look: dict[str, Any] = {"frameon": False, "handlelength": 2.6, "columnspacing": 1.2}
        self.ax.legend(handles=handles, ncol=columns, loc="lower center", bbox_to_anchor=(0.5, 1.0), **look)

    def settle(self) -> None:
        """Lay the figure out once. With an aspect to keep, only the second round is good."""
        if isinstance(self.ax.figure, Figure):
            self.ax.figure.draw_without_rendering()


def new_axes(blocked: NDArray[np.bool_], world: World | None, *, color_bar: bool) -> Axes:
    """Make axes in a figure that has the proportions of the map."""
    rows, columns = blocked.shape
    corners = _from_corners(world).transform([(0, 0), (columns, 0), (0, rows), (columns, rows)])
    across, down = np.ptp(corners, axis=0)
    scale = min(5.6 / max(across, 1e-9), 6.4 / max(down, 1e-9))
    width, height = max(across * scale, 2.8), max(down * scale, 1.2)
    size = (width + (1.6 if color_bar else 0.8), height + 0.9)
    # The layout is not exact where axes keep an aspect, and cuts labels without some room.
    layout = ConstrainedLayoutEngine(w_pad=0.15, h_pad=0.1)
    return plt.figure(figsize=size, layout=layout).add_subplot()


def to_blocked(grid: Grid | ArrayLike) -> NDArray[np.bool_]:
    """Take a map as an array."""
    blocked = np.asarray(grid, dtype=bool)
    if blocked.ndim != 2:
        raise ValueError(f"expected a map of shape (rows, columns), found shape {blocked.shape}")
    return blocked


def to_costs(grid: Grid | ArrayLike) -> NDArray[np.float64] | None:
    """Take the costs of a map's cells, if they have any."""
    return grid.costs if isinstance(grid, Grid) else None


def to_distances(field: Field | ArrayLike) -> NDArray[np.float64]:
    """Take the distances of a field."""
    distances = field.distances() if isinstance(field, Field) else np.asarray(field, dtype=np.float64)
    if distances.ndim != 2:
        raise ValueError(f"expected distances of shape (rows, columns), found shape {distances.shape}")
    return distances


def to_directions(flow: Field | ArrayLike) -> NDArray[np.float64]:
    """Take the directions of a field."""
    directions = flow.flow() if isinstance(flow, Field) else np.asarray(flow, dtype=np.float64)
    if directions.ndim != 3 or directions.shape[2] != 2:
        raise ValueError(f"expected directions of shape (rows, columns, 2), found shape {directions.shape}")
    return directions


def to_named(paths: SeveralPaths) -> Named:
    """Take one path or several, with their names."""
    if paths is None:
        return []
    if isinstance(paths, Mapping):
        return [(name, _to_points(path)) for name, path in paths.items()]
    several = list(cast("Iterable[Any]", paths))
    if several and several[0] is not None and np.ndim(several[0]) == 1:
        return [(None, _to_points(cast("ArrayLike", paths)))]
    return [(None, _to_points(path)) for path in several]


def _to_points(path: OnePath) -> NDArray[np.float64] | None:
    if path is None:
        return None
    points = np.asarray(path, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"expected a path of shape (n, 2), found shape {points.shape}")
    return points


def map_shape(array: NDArray[Any], placement: Placement) -> tuple[int, int]:
    """Give the shape of the map on which an array has a value for each vertex."""
    more = 0 if placement == "center" else 1
    return array.shape[0] - more, array.shape[1] - more


def free_vertices(blocked: NDArray[np.bool_], placement: Placement) -> NDArray[np.bool_]:
    """Say which vertices are free: at corners, those with a free cell beside them."""
    if placement == "center":
        return ~blocked
    free = np.pad(~blocked, 1)
    beside: NDArray[np.bool_] = free[1:, 1:] | free[1:, :-1] | free[:-1, 1:] | free[:-1, :-1]
    return beside


def check_on_map(blocked: NDArray[np.bool_], named: Named, placement: Placement) -> None:
    """Raise an error for a path that leaves the map: most likely its placement is the other one."""
    last = np.array(blocked.shape) - (1 if placement == "center" else 0)
    for _, points in named:
        if points is None:
            continue
        outside = points[((points < 0) | (points > last)).any(axis=1)]
        if len(outside):
            raise ValueError(
                f"expected points from (0, 0) to ({last[0]}, {last[1]}) at placement={placement!r}, found "
                f"({outside[0, 0]:g}, {outside[0, 1]:g}); pass the placement that the path was searched with"
            )


def check_shape(blocked: NDArray[np.bool_], array: NDArray[Any], placement: Placement) -> None:
    """Raise an error for an array whose vertices are not those of the map at this placement."""
    if map_shape(array, placement) != blocked.shape:
        rows, columns = np.array(blocked.shape) + (0 if placement == "center" else 1)
        raise ValueError(
            f"expected an array of {rows} x {columns} vertices at placement={placement!r}, found "
            f"{array.shape[0]} x {array.shape[1]}; pass the placement that it was made with"
        )


def _from_corners(world: World | None) -> Affine2D:
    """Make the map from (columns, rows), counted from the map's top left corner, to the axes."""
    if world is None:
        return Affine2D().translate(-0.5, -0.5)
    corners = np.array([(0, 0), (0, 1), (1, 0)])
    zero, right, down = np.asarray(world.point_of(corners, placement="corner"))
    (a, b), (c, d), (e, f) = right - zero, down - zero, zero
    return Affine2D.from_values(a, b, c, d, e, f)


def _shades_of_blocks(blocked: NDArray[np.bool_], block: int) -> NDArray[np.float64]:
    """Give the shade of each block of block x block cells: 0 if it is free, 1 if it is blocked.

    The shades of others are clearly between, and grow with the share of cells that are blocked.
    """
    shares = _mean_of_blocks(blocked, block)
    return np.where((shares == 0) | (shares == 1), shares, 0.35 + 0.4 * shares)


def _mean_of_blocks(array: NDArray[np.bool_], block: int) -> NDArray[np.float64]:
    if block == 1:
        return array.astype(np.float64)
    rows, columns = (np.arange(0, side, block) for side in array.shape)
    # In strips: 0.4 s for 18,000 x 12,000 cells, where `reduceat` takes 11 s.
    strips = [array[row : row + block].view(np.uint8).sum(axis=0, dtype=np.uint32) for row in rows]
    sums = np.add.reduceat(np.array(strips), columns, axis=1, dtype=np.int64)
    heights, widths = (np.diff(starts, append=side) for starts, side in zip((rows, columns), array.shape))
    means: NDArray[np.float64] = sums / np.outer(heights, widths)
    return means
