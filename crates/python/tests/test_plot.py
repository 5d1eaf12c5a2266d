"""Pictures by matplotlib: where things are, pixel by pixel, and what is said of mistakes."""

import subprocess
import sys
from pathlib import Path

import mediant
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402
from mediant import _drawing, plot  # noqa: E402

SIDE = 20
"""Pixels along a side of a cell, in the tests that count them."""


@pytest.fixture(autouse=True)
def _close_figures():
    yield
    plt.close("all")


def fitted(ax, rows, columns):
    """The axes, without the room that there is around a map."""
    ax.set_xlim(-0.5, columns - 0.5)
    ax.set_ylim(rows - 0.5, -0.5)
    return ax


def axes_of(rows, columns):
    """Axes that fill their figure, with 20 x 20 pixels for each cell of a map."""
    figure = plt.figure(figsize=(columns * SIDE / 100, rows * SIDE / 100), dpi=100)
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    return ax


def pixels_of(ax):
    ax.figure.canvas.draw()
    return np.asarray(ax.figure.canvas.buffer_rgba())[..., :3].astype(int)


def color(name):
    return np.rint(np.array(to_rgb(name)) * 255).astype(int)


def is_color(pixels, name, tolerance=2):
    return (abs(pixels - color(name)) <= tolerance).all(axis=-1)


def centroid(mask):
    """The mean place of pixels, (row, column), counted in cells from the top left corner of the picture."""
    rows, columns = np.nonzero(mask)
    assert len(rows) > 0
    return (rows.mean() + 0.5) / SIDE, (columns.mean() + 0.5) / SIDE


def is_within(figure):
    """Whether a figure cuts nothing of what is drawn."""
    around = figure.get_tightbbox()
    width, height = figure.get_size_inches()
    return around.x0 >= 0 and around.y0 >= 0 and around.x1 <= width and around.y1 <= height


def test_cells_are_sharp_squares():
    blocked = np.random.default_rng(2).random((6, 9)) < 0.4
    ax = axes_of(6, 9)
    plot.grid(mediant.Grid(blocked), ax)
    pixels = pixels_of(fitted(ax, 6, 9))
    expected = np.where(blocked[..., None], color(_drawing.BLOCKED), 255)
    wrong = (abs(pixels - expected.repeat(SIDE, axis=0).repeat(SIDE, axis=1)) > 1).any(axis=-1)
    assert not wrong[2:-2, 2:-2].any(), "but for the outline"


@pytest.mark.parametrize(("placement", "more"), [("center", 0.5), ("corner", 0.0)])
@pytest.mark.parametrize("point", [(2, 3), (4, 1), (1, 6)])
def test_a_vertex_is_at_the_center_or_the_top_left_corner_of_its_cell(placement, more, point):
    ax = axes_of(6, 9)
    plot.grid(np.zeros((6, 9), dtype=bool), ax)
    plot.path([point], ax, placement=placement)
    at = centroid(is_color(pixels_of(fitted(ax, 6, 9)), "black", 20))
    assert at == pytest.approx((point[0] + more, point[1] + more), abs=0.06)


@pytest.mark.parametrize(("placement", "more"), [("center", 0.5), ("corner", 0.0)])
def test_a_line_runs_from_vertex_to_vertex(placement, more):
    ax = axes_of(6, 9)
    plot.grid(np.zeros((6, 9), dtype=bool), ax)
    plot.path([(1, 2), (5, 2), (5, 7)], ax, placement=placement, color="red", linewidth=3)
    red = is_color(pixels_of(fitted(ax, 6, 9)), "red")
    down, across = red.copy(), red.copy()
    # Between the ends' marks and the bend.
    down[: 2 * SIDE] = down[4 * SIDE :] = False
    across[:, : 4 * SIDE] = across[:, 6 * SIDE :] = False
    assert centroid(down)[1] == pytest.approx(2 + more, abs=0.06)
    assert centroid(across)[0] == pytest.approx(5 + more, abs=0.06)
    assert down.any(axis=1)[2 * SIDE : 4 * SIDE].all()
    assert across.any(axis=0)[4 * SIDE : 6 * SIDE].all()


@pytest.mark.parametrize("placement", ["center", "corner"])
def test_a_field_has_its_color_around_each_vertex_and_no_more_than_the_map(placement):
    more = 0 if placement == "center" else 1
    distances = (
        np.random.default_rng(3).permutation((6 + more) * (9 + more)).reshape(6 + more, -1).astype(float)
    )
    # Axes of two more rows and columns, to see that nothing is drawn outside the map.
    ax = axes_of(8, 11)
    image = plot.field(distances, ax, placement=placement)
    ax.set_xlim(-1.5, 9.5)
    ax.set_ylim(6.5, -1.5)
    pixels = pixels_of(ax)
    colors = np.rint(image.cmap(image.norm(distances))[..., :3] * 255)
    padded = np.full((8 * SIDE, 11 * SIDE, 3), 255.0)
    middle = padded[SIDE:-SIDE, SIDE:-SIDE]
    squares = colors.repeat(SIDE, axis=0).repeat(SIDE, axis=1)
    half = SIDE // 2 * more
    middle[:] = squares[half : half + 6 * SIDE, half : half + 9 * SIDE]
    wrong = (abs(pixels - padded) > 2).any(axis=-1)
    # But for the borders of squares, which old versions of matplotlib round otherwise, and for the outline.
    borders = [(np.arange(size) - half + 2) % SIDE < 4 for size in wrong.shape]
    outline = [abs(np.arange(size) + 0.5 - at) < 3 for size in wrong.shape for at in (SIDE, size - SIDE)]
    wrong[borders[0] | outline[0] | outline[1]] = False
    wrong[:, borders[1] | outline[2] | outline[3]] = False
    assert not wrong.any(), np.argwhere(wrong)[:5]


def test_no_distance_is_hatched_and_not_the_color_of_zero():
    distances = np.array([[0.0, 1.0, np.inf], [np.inf, np.nan, 2.0]])
    ax = axes_of(2, 3)
    image = plot.field(distances, ax)
    pixels = pixels_of(fitted(ax, 2, 3))
    assert (image.norm.vmin, image.norm.vmax) == (0.0, 2.0)
    for row, column in np.ndindex(2, 3):
        cell = pixels[row * SIDE + 2 : (row + 1) * SIDE - 2, column * SIDE + 2 : (column + 1) * SIDE - 2]
        shades = len(np.unique(cell.reshape(-1, 3), axis=0))
        if np.isfinite(distances[row, column]):
            assert shades == 1
        else:
            assert shades > 2, "hatched"
            assert (np.ptp(cell, axis=-1) <= 2).all(), "gray"
            assert cell.min() > 150, "light"


def test_distances_grow_lighter_all_the_way():
    lightness = _drawing.COLORMAP(np.linspace(0, 1, 256))[:, :3] @ (0.2126, 0.7152, 0.0722)
    assert (np.diff(lightness) >= 0).all()
    assert len(np.unique(lightness)) > 200
    assert lightness[0] > 0.15, "lighter than blocked cells"


@pytest.mark.parametrize("wall", range(50, 1950, 131))
def test_a_wall_of_one_cell_stays_visible_on_a_map_with_more_cells_than_pixels(wall):
    blocked = np.zeros((2000, 2000), dtype=bool)
    blocked[:, wall] = True
    figure = plt.figure(figsize=(3, 3), dpi=100)
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    plot.grid(blocked, ax)
    within = pixels_of(ax)[100:200, 10:-10]
    assert (within.min(axis=(1, 2)) < 200).all()
    assert (within == 255).all(axis=-1).sum() > 0.97 * 100 * 280


def test_paths_along_the_edge_and_their_ends_are_seen_as_a_whole():
    ax = plot.show(np.zeros((6, 9), dtype=bool), [(0, 0), (0, 9), (6, 9)], placement="corner")
    ax.set_axis_off()
    dark = is_color(pixels_of(ax), "black", 20)
    rows, columns = np.nonzero(dark)
    edge = ax.get_window_extent()
    left, top = ax.transData.transform((-0.5, -0.5))
    start = columns < edge.x0 + 30
    # The disc is as wide to the left of the vertex as to its right.
    assert (columns[start].min() + columns[start].max() + 1) / 2 == pytest.approx(left, abs=1)
    assert (rows[start].min() + rows[start].max() + 1) / 2 == pytest.approx(len(dark) - top, abs=1)
    right, bottom = ax.transData.transform((8.5, 5.5))
    goal = columns >= edge.x1 - 30
    assert (columns[goal].min() + columns[goal].max() + 1) / 2 == pytest.approx(right, abs=1)
    assert (rows[goal].min() + rows[goal].max() + 1) / 2 == pytest.approx(len(dark) - bottom, abs=1)


def test_flow_points_to_the_next_vertex():
    # Right, down, left, up, and to the lower right, on the screen.
    flow = np.full((3, 6, 2), np.nan)
    flow[1, :5] = [(0, 1), (1, 0), (0, -1), (-1, 0), (0.6, 0.8)]
    flow[1, 5] = 0
    ax = axes_of(3, 6)
    plot.grid(np.zeros((3, 6), dtype=bool), ax)
    arrows = plot.flow(flow, ax)
    assert arrows.N == 5
    dark = is_color(pixels_of(fitted(ax, 3, 6)), "black", 40)
    for column in range(5):
        cell = dark[:, column * SIDE : (column + 1) * SIDE]
        row_of, column_of = centroid(cell)
        # An arrow is heavier at its head.
        leaning = np.array([row_of - 1.5, column_of - 0.5])
        assert np.hypot(*leaning) > 0.05
        assert leaning @ flow[1, column] > 0.97 * np.hypot(*leaning)
    assert not dark[:, 5 * SIDE :].any()


def test_flow_of_a_large_map_has_few_arrows():
    flow = np.ones((300, 100, 2))
    arrows = plot.flow(flow, plt.figure().add_subplot(), arrows=20)
    assert arrows.N == 20 * 7


def test_levels_follow_the_distances():
    ax = plt.figure().add_subplot()
    rows, columns = np.indices((21, 31))
    plot.field(np.hypot(rows - 10, columns - 15), ax, levels=[5.0])
    [path] = ax.collections[0].get_paths()
    assert np.hypot(*(path.vertices - (15, 10)).T) == pytest.approx(5, abs=0.05)
    ax = plt.figure().add_subplot()
    plot.field(np.hypot(rows - 10, columns - 15), ax, levels=[5.0], placement="corner")
    [path] = ax.collections[0].get_paths()
    assert np.hypot(*(path.vertices - (14.5, 9.5)).T) == pytest.approx(5, abs=0.05)


@pytest.fixture(params=[0.0, 0.4])
def map_of_robot(tmp_path, request):
    """A map of 4 x 7 cells of half a meter, at (-1, 2), without and with a yaw."""
    rows = ["0 255 255 255 255 255 255", *["255 255 255 255 255 255 255"] * 3]
    (tmp_path / "map.pgm").write_text("P2\n7 4\n255\n" + "\n".join(rows) + "\n")
    (tmp_path / "map.yaml").write_text(
        f"image: map.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, {request.param}]\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.25\nnegate: 0\n"
    )
    return mediant.Grid.open(tmp_path / "map.yaml")


@pytest.mark.parametrize("placement", ["center", "corner"])
def test_in_the_world_things_are_where_their_points_are(map_of_robot, placement):
    grid = map_of_robot
    world = grid.world
    path = np.array([(1, 0), (1, 3), (3, 5)])
    ax = plt.figure().add_subplot()
    [line] = plot.path(path, ax, placement=placement, world=world)
    assert line.get_xydata() == pytest.approx(world.point_of(path, placement=placement))
    flow = np.zeros((4 + (placement == "corner"), 7 + (placement == "corner"), 2))
    flow[1, 3] = (2 / np.sqrt(8), 2 / np.sqrt(8))
    arrow = plot.flow(flow, ax, placement=placement, world=world)
    towards = (
        world.point_of(path[2:], placement=placement)[0] - world.point_of(path[1:2], placement=placement)[0]
    )
    assert np.array([arrow.U[0], arrow.V[0]]) / np.hypot(arrow.U[0], arrow.V[0]) == pytest.approx(
        towards / np.hypot(*towards)
    )


def test_in_the_world_cells_are_where_their_points_are(map_of_robot):
    grid = map_of_robot
    ax = plot.show(grid, world=grid.world)
    pixels = pixels_of(ax)
    for row, column in np.ndindex(4, 7):
        place = grid.world.point_of([(row, column)])
        x, y = ax.transData.transform(place)[0]
        shade = pixels[int(pixels.shape[0] - y), int(x)]
        assert (abs(shade - color(_drawing.BLOCKED if grid.to_numpy()[row, column] else "white")) <= 2).all()
    assert grid.to_numpy()[0, 0]
    assert ax.get_xlabel() == "x (m)"
    assert not ax.yaxis_inverted()


@pytest.mark.parametrize("shape", [(9, 12), (5, 60), (60, 5), (300, 200)])
def test_show_in_one_call_names_its_paths_and_cuts_no_text(shape):
    blocked = np.zeros(shape, dtype=bool)
    blocked[1:4, 1:4] = True
    blocked[2, 2] = False
    grid = mediant.Grid(blocked)
    goal = (shape[0] - 1, shape[1] - 1)
    paths = {f"k = {k}": grid.path((0, 0), goal, k=k, placement="corner") for k in (2, 3, 4, "any")}
    paths["none"] = None
    field = grid.field(goal, k=4, placement="corner")
    ax = plot.show(grid, paths, field=field, flow=field, levels=4, placement="corner")
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert names == ["k = 2", "k = 3", "k = 4", "k = any", "not reached"]
    figure = ax.figure
    figure.canvas.draw()
    legend, box = ax.get_legend().get_window_extent(), ax.get_window_extent()
    assert legend.y0 >= box.y1 - 1, "the legend hides nothing"
    assert box.width > 150 or box.height > 150
    assert ax.yaxis_inverted(), "the first row is on top"
    assert is_within(figure)


@pytest.mark.parametrize("shape", [(1024, 1024), (300, 200), (9, 12), (1000, 3000)])
def test_show_cuts_no_label(shape):
    ax = plot.show(np.zeros(shape, dtype=bool), field=np.hypot(*np.indices(shape)))
    ax.figure.canvas.draw()
    assert is_within(ax.figure)


def test_corners_are_free_beside_a_free_cell():
    blocked = np.array([[1, 1, 1], [1, 1, 0], [1, 1, 1]], dtype=bool)
    expected = np.zeros((4, 4), dtype=bool)
    expected[1:3, 2:4] = True
    assert (_drawing.free_vertices(blocked, "corner") == expected).all()
    assert (_drawing.free_vertices(blocked, "center") == ~blocked).all()


def test_everything_reached_is_not_said_to_be_missed():
    grid = mediant.Grid.from_rows(["..#", "..."])
    for placement in ("center", "corner"):
        ax = plot.show(grid, field=grid.field((0, 0), placement=placement), placement=placement)
        assert ax.get_legend() is None


def test_lines_of_several_paths_differ():
    lines = plot.path([[(0, i), (5, i)] for i in range(7)], plt.figure().add_subplot())
    assert len({line.get_color() for line in lines}) == 7
    assert len({str(line.get_linestyle()) + str(line._unscaled_dash_pattern) for line in lines}) == 4


def test_one_path_or_several():
    ax = plt.figure().add_subplot()
    one = np.array([(0, 0), (1, 1)])
    for same in (one, one.tolist(), [tuple(one[0]), one[1]]):
        assert len(plot.path(same, ax)) == 1
    assert len(plot.path([one, None, one], ax)) == 2
    assert len(plot.path([None, one], ax)) == 1
    assert plot.path(None, ax) == plot.path([], ax) == plot.path({"a": None}, ax) == []
    starts, goals = [(0, 0), (1, 0), (0, 0)], [(0, 0), (1, 2), (1, 2)]
    index = mediant.Grid.from_rows(["...", "..."]).prepare()
    assert len(plot.path(index.paths(starts, goals), ax)) == 3


def test_mistakes_are_named():
    grid = mediant.Grid.from_rows(["...", "..."])
    with pytest.raises(ValueError, match=r"from \(0, 0\) to \(1, 2\).*found \(2, 3\).*placement"):
        plot.show(grid, [(0, 0), (2, 3)])
    plot.show(grid, [(0, 0), (2, 3)], placement="corner")
    with pytest.raises(ValueError, match=r"2 x 3 vertices.*found 3 x 4"):
        plot.show(grid, field=np.zeros((3, 4)))
    with pytest.raises(ValueError, match=r"3 x 4 vertices.*found 2 x 3"):
        plot.show(grid, flow=np.zeros((2, 3, 2)), placement="corner")
    with pytest.raises(ValueError, match=r'"center" or "corner"'):
        plot.show(grid, placement="middle")
    with pytest.raises(ValueError, match="path of shape"):
        plot.path([[(0, 0, 0)]])
    with pytest.raises(ValueError, match="shape"):
        plot.flow(np.zeros((3, 4)))
    with pytest.raises(ValueError, match="shape"):
        plot.grid(np.zeros(3, dtype=bool))


def test_the_package_alone_imports_no_matplotlib():
    program = "import sys, mediant; print('matplotlib' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert run.stdout == "False\n"


def test_the_figure_of_the_readme(tmp_path):
    folder = Path(__file__).parent.parent / "figures"
    subprocess.run([sys.executable, folder / "paths.py", tmp_path / "paths.png"], check=True)
    drawn, committed = (plt.imread(at / "paths.png") for at in (tmp_path, folder))
    # Versions of matplotlib draw texts a little differently, but the same map.
    assert drawn.shape == pytest.approx(committed.shape, rel=0.03)
    assert (drawn[..., :3].max(axis=-1) < 0.4).mean() == pytest.approx(
        (committed[..., :3].max(axis=-1) < 0.4).mean(), rel=0.03
    )
    assert (folder / "paths.png").stat().st_size < 60_000


def test_costs_are_the_background():
    """Costs have colors, by their logarithms where they are far apart; fields of costs say so."""
    costs = np.array([[1.0, 2.0, 20.0], [4.0, 9.0, 1.0]])
    grid = mediant.Grid(costs > 10, costs=costs)
    drawn = plot.grid(grid, plt.figure().add_subplot())
    assert drawn.get_array().filled(-1).tolist() == [[1, 2, -1], [4, 9, 1]]
    shades = [drawn.cmap(drawn.norm(cost)) for cost in (1, 4, 9)]
    assert [sum(shade[:3]) for shade in shades] == sorted((sum(shade[:3]) for shade in shades), reverse=True)
    wide = plot.grid(mediant.Grid.from_costs(costs * [[1, 1, 1], [1, 100, 1]]), plt.figure().add_subplot())
    assert type(wide.norm).__name__ == "LogNorm"
    for how, label in [({}, "cost of a cell"), ({"field": grid.field((0, 0))}, "cost")]:
        ax = plot.show(grid, grid.path((0, 0), (1, 2)), **how)
        assert [one.get_ylabel() for one in ax.child_axes] == [label]
    plt.close("all")
