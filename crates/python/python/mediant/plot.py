"""Pictures of maps, paths, distances and flow, drawn by matplotlib: ``pip install "mediant[plot]"``.

`show` draws all of it in one call. `grid`, `field`, `path` and `flow` add one thing each to axes that you
have, and return what matplotlib made of it.

Rows go down, columns to the right. The axes count in cells: the center of cell (row, column) is at
x = column, y = row, and its top left corner is half a cell before that. So paths between corners
(``placement="corner"``, and all paths at any angle) lie half a cell off from paths between centers. An array
does not say which of the two it means: pass the placement that you searched with. With ``world=grid.world``
the axes are in meters, with y up.

Examples
--------
>>> import mediant
>>> from mediant import plot
>>> grid = mediant.Grid.from_rows(["...#....", ".#.#.##.", ".#...#.."])
>>> path = grid.path((0, 0), (0, 7), k="any")
>>> ax = plot.show(grid, path, placement="corner")
>>> ax.figure.savefig("path.png")  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._drawing import (
    ARROWS,
    COLORS,
    Canvas,
    check_on_map,
    check_shape,
    free_vertices,
    new_axes,
    to_blocked,
    to_costs,
    to_directions,
    to_distances,
    to_named,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D
    from matplotlib.quiver import Quiver
    from numpy.typing import ArrayLike

    from ._drawing import SeveralPaths
    from ._mediant import Field, Grid, Placement, World

__all__ = ["COLORS", "field", "flow", "grid", "path", "show"]


def show(
    grid: Grid | ArrayLike,
    paths: SeveralPaths = None,
    *,
    field: Field | ArrayLike | None = None,
    flow: Field | ArrayLike | None = None,
    placement: Placement = "center",
    levels: ArrayLike | None = None,
    ax: Axes | None = None,
    world: World | None = None,
) -> Axes:
    """Draw a map, with paths, distances and directions on it if there are any.

    Costs of cells are drawn where there is no field: cheap cells light, dear ones brown.

    Parameters
    ----------
    grid : Grid or array of bool, shape (rows, columns)
        The map; True is blocked.
    paths : path, sequence of paths, `Paths`, or mapping of names to paths, optional
        Each an array of shape (n, 2), or None where there is no path. The names of a mapping make a legend.
    field : Field or array of float, optional
        The distance of each vertex, in cells, or its cost; where it is infinite, the picture is hatched.
    flow : Field or array of float, shape (..., 2), optional
        The direction at each vertex, as (rows, columns); drawn as arrows.
    placement : {"center", "corner"}
        The placement of the vertices of all of these.
    levels : int or sequence of float, optional
        Draw lines of equal distance: about how many, or at which distances.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on. Otherwise those of a new figure, in the proportions of the map.
    world : World, optional
        ``grid.world``, to draw in meters.

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were drawn on. ``ax.figure.savefig("map.png")`` saves it.

    Raises
    ------
    ValueError
        If a path or a field does not fit on the map at this placement.

    Examples
    --------
    >>> import mediant
    >>> from mediant import plot
    >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    >>> field = grid.field((0, 0))
    >>> ax = plot.show(grid, {"k = 3": grid.path((2, 3), (0, 0))}, field=field, flow=field)
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['k = 3']
    """
    blocked, named, costs = to_blocked(grid), to_named(paths), to_costs(grid)
    check_on_map(blocked, named, placement)
    own = ax is None
    has_colors = field is not None or costs is not None
    ax = new_axes(blocked, world, color_bar=has_colors) if ax is None else ax
    canvas = Canvas(ax, placement, world)
    not_reached = False
    if field is not None:
        distances = to_distances(field)
        check_shape(blocked, distances, placement)
        label = "distance (cells)" if costs is None else "cost"
        canvas.color_bar(canvas.distances(distances, levels, {}), label)
        not_reached = bool((free_vertices(blocked, placement) & ~np.isfinite(distances)).any())
    elif costs is not None:
        canvas.color_bar(canvas.costs(costs, {}), "cost of a cell")
    canvas.cells(blocked, {}, on_field=has_colors)
    if flow is not None:
        directions = to_directions(flow)
        check_shape(blocked, directions, placement)
        canvas.arrows(directions, ARROWS, {})
    canvas.paths(named, {})
    canvas.legend(not_reached=not_reached)
    if own:
        canvas.settle()
    return ax


def grid(
    grid: Grid | ArrayLike, ax: Axes | None = None, *, world: World | None = None, **image: Any
) -> AxesImage:
    """Draw a map: free cells white, blocked ones dark, each a sharp square.

    A map that has more cells than the axes have pixels is drawn in blocks of cells. A block that is blocked
    in part is gray, far from white, so that a wall of one cell stays visible. Of a grid with costs, free
    cells have the color of their cost.

    Parameters
    ----------
    grid : Grid or array of bool, shape (rows, columns)
        The map; True is blocked.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on; the current ones by default.
    world : World, optional
        ``grid.world``, to draw in meters.
    **image
        Passed on to `matplotlib.axes.Axes.imshow`.

    Returns
    -------
    matplotlib.image.AxesImage
        The map; of a grid with costs, the costs, which a color bar wants.

    Examples
    --------
    >>> import mediant
    >>> from mediant import plot
    >>> plot.grid(mediant.Grid.from_rows([".#.", "..."])).get_array().shape
    (2, 3)
    """
    canvas, costs = Canvas(ax, "center", world), to_costs(grid)
    if costs is None:
        return canvas.cells(to_blocked(grid), image, on_field=False)
    drawn = canvas.costs(costs, image)
    canvas.cells(to_blocked(grid), {}, on_field=True)
    return drawn


def field(
    field: Field | ArrayLike,
    ax: Axes | None = None,
    *,
    placement: Placement = "center",
    levels: ArrayLike | None = None,
    world: World | None = None,
    **image: Any,
) -> AxesImage:
    """Draw distances, near ones dark, far ones light. Where there is none, the picture is hatched.

    At placement "corner" each vertex colors the half cell around it.

    Parameters
    ----------
    field : Field or array of float
        The distance of each vertex, in cells; infinite where there is none.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on; the current ones by default.
    placement : {"center", "corner"}
        The placement of the vertices: an array at corners has a row and a column more than the map.
    levels : int or sequence of float, optional
        Draw lines of equal distance: about how many, or at which distances.
    world : World, optional
        ``grid.world``, to draw in meters.
    **image
        Passed on to `matplotlib.axes.Axes.imshow`, for instance ``cmap`` or ``vmax``.

    Returns
    -------
    matplotlib.image.AxesImage
        The distances, which a color bar wants.

    Examples
    --------
    >>> import mediant
    >>> from mediant import plot
    >>> image = plot.field(mediant.Grid.from_rows([".#.", "..."]).field((0, 0)))
    >>> bar = image.figure.colorbar(image, label="distance (cells)")
    """
    return Canvas(ax, placement, world).distances(to_distances(field), levels, image)


def path(
    path: SeveralPaths,
    ax: Axes | None = None,
    *,
    placement: Placement = "center",
    world: World | None = None,
    **line: Any,
) -> list[Line2D]:
    """Draw a path or several: a disc at the start, a diamond at the goal.

    Several paths differ in color and in the style of their lines.

    Parameters
    ----------
    path : path, sequence of paths, `Paths`, or mapping of names to paths
        Each an array of shape (n, 2), or None where there is no path. Names are the labels of a legend.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on; the current ones by default.
    placement : {"center", "corner"}
        The placement of the vertices.
    world : World, optional
        ``grid.world``, to draw in meters.
    **line
        Passed on to `matplotlib.axes.Axes.plot`, for instance ``color`` or ``linewidth``.

    Returns
    -------
    list of matplotlib.lines.Line2D
        A line for each path that is not None.

    Raises
    ------
    ValueError
        If a path is no array of shape (n, 2).

    Examples
    --------
    >>> from mediant import plot
    >>> [line] = plot.path([(0, 0), (3, 3), (3, 8)])
    >>> line.get_xydata().tolist()
    [[0.0, 0.0], [3.0, 3.0], [8.0, 3.0]]
    >>> [line] = plot.path([(0, 0), (3, 3), (3, 8)], placement="corner")
    >>> line.get_xydata().tolist()
    [[-0.5, -0.5], [2.5, 2.5], [7.5, 2.5]]
    """
    return Canvas(ax, placement, world).paths(to_named(path), line)


def flow(
    flow: Field | ArrayLike,
    ax: Axes | None = None,
    *,
    placement: Placement = "center",
    arrows: int = ARROWS,
    world: World | None = None,
    **quiver: Any,
) -> Quiver:
    """Draw directions as arrows.

    Parameters
    ----------
    flow : Field or array of float, shape (..., 2)
        The direction at each vertex, as (rows, columns). There is no arrow where it is (0, 0) or no number.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on; the current ones by default.
    placement : {"center", "corner"}
        The placement of the vertices.
    arrows : int
        The most arrows along a side. On a larger map there is one for every few vertices.
    world : World, optional
        ``grid.world``, to draw in meters.
    **quiver
        Passed on to `matplotlib.axes.Axes.quiver`.

    Returns
    -------
    matplotlib.quiver.Quiver
        The arrows.

    Examples
    --------
    >>> import mediant
    >>> from mediant import plot
    >>> plot.flow(mediant.Grid.from_rows([".#.", "..."]).field((0, 0))).N
    4
    """
    return Canvas(ax, placement, world).arrows(to_directions(flow), arrows, quiver)
