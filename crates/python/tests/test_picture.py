"""Pictures for notebooks: what Pillow reads from them, against the map cell by cell."""

import io
import subprocess
import sys

import mediant
import numpy as np
import pytest
from mediant import _picture
from mediant._picture import BLOCKED, FRAME, FREE, NO_PATH, png_of, png_of_field

Image = pytest.importorskip("PIL.Image")


def decoded(png):
    """The pixels (rows, columns, 3) within the frame, which is tested here."""
    with Image.open(io.BytesIO(png)) as picture:
        assert picture.format == "PNG"
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    for edge in (pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]):
        assert (edge == FRAME).all()
    return pixels[1:-1, 1:-1]


def test_a_small_map_is_enlarged_and_each_cell_is_a_square_of_one_color():
    blocked = np.random.default_rng(1).random((5, 9)) < 0.4
    pixels = decoded(png_of(mediant.Grid(blocked)))
    side = _picture.LARGEST_CELL
    assert pixels.shape == (5 * side, 9 * side, 3)
    expected = np.where(blocked[..., None], BLOCKED, FREE)
    assert (pixels == expected.repeat(side, axis=0).repeat(side, axis=1)).all()


@pytest.mark.parametrize(
    ("shape", "size"),
    [((1, 1), (16, 16)), ((32, 4), (512, 64)), ((33, 4), (495, 60)), ((512, 300), (512, 300)),
     ((513, 300), (257, 150)), ((1, 5000), (1, 500)), ((5000, 1), (500, 1)), ((1025, 1024), (342, 342))],
)  # fmt: skip
def test_size_is_bounded_and_keeps_the_proportions(shape, size):
    assert decoded(png_of(mediant.Grid(np.zeros(shape, dtype=bool)))).shape[:2] == size


@pytest.mark.parametrize("seed", range(30))
def test_blocks_of_a_large_map_are_free_blocked_or_clearly_between(monkeypatch, seed):
    monkeypatch.setattr(_picture, "LONGEST", 16)
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(17, 70, 2)
    blocked = rng.random((rows, columns)) < rng.choice([0.02, 0.5, 0.98])
    pixels = decoded(png_of(mediant.Grid(blocked)))
    block = -(-max(rows, columns) // 16)
    assert pixels.shape[:2] == (-(-rows // block), -(-columns // block))
    for row, column in np.ndindex(*pixels.shape[:2]):
        cells = blocked[row * block : (row + 1) * block, column * block : (column + 1) * block]
        red = pixels[row, column, 0]
        where = (seed, row, column)
        if not cells.any():
            assert (pixels[row, column] == FREE).all(), where
        elif cells.all():
            assert (pixels[row, column] == BLOCKED).all(), where
        else:
            # Visible on white, and a door in a wall is visible too.
            assert BLOCKED[0] + 40 < red < FREE[0] - 60, where


def test_more_blocked_is_darker(monkeypatch):
    monkeypatch.setattr(_picture, "LONGEST", 4)
    blocked = np.zeros((4, 16), dtype=bool)
    for count in range(4):
        blocked[: count + 1, 4 * count] = True
    reds = decoded(png_of(mediant.Grid(blocked)))[0, :, 0]
    assert (np.diff(reds) < 0).all()


def test_a_field_is_dark_near_its_source_and_striped_where_no_path_leads():
    grid = mediant.Grid.from_rows(["........", "######.#", "........", "########", "........"])
    field = grid.field((0, 0))
    distances = field.distances()
    side = _picture.LARGEST_CELL
    pixels = decoded(png_of_field(field))
    assert pixels.shape == (5 * side, 8 * side, 3)
    for row, column in np.ndindex(5, 8):
        colors = pixels[row * side : (row + 1) * side, column * side : (column + 1) * side].reshape(-1, 3)
        kinds = {tuple(color) for color in colors.tolist()}
        if np.isfinite(distances[row, column]):
            assert len(kinds) == 1
        else:
            assert kinds == set(NO_PATH)
    reached = np.isfinite(distances)
    lightness = pixels[::side, ::side] @ (0.2126, 0.7152, 0.0722)
    order = np.argsort(distances[reached], kind="stable")
    assert (np.diff(lightness[reached][order]) >= 0).all()
    assert tuple(pixels[0, 0]) == _picture.RAMP[0]
    assert lightness[2, 0] == lightness[reached].max()


def test_a_large_field_shows_the_least_distance_of_each_block(monkeypatch):
    monkeypatch.setattr(_picture, "LONGEST", 8)
    blocked = np.random.default_rng(5).random((23, 30)) < 0.3
    blocked[0, 0] = False
    field = mediant.Grid(blocked).field((0, 0))
    distances = field.distances()
    pixels = decoded(png_of_field(field))
    least = np.array(
        [[distances[r : r + 4, c : c + 4].min() for c in range(0, 30, 4)] for r in range(0, 23, 4)]
    )
    assert pixels.shape[:2] == least.shape == (6, 8)
    striped = np.isin(pixels, NO_PATH).all(axis=-1)
    assert (striped == ~np.isfinite(least)).all()
    reached = np.isfinite(least)
    lightness = (pixels @ (0.2126, 0.7152, 0.0722))[reached]
    assert (np.diff(lightness[np.argsort(least[reached])]) >= 0).all()


def test_a_field_of_its_source_alone_is_near():
    with np.errstate(all="raise"):
        pixels = decoded(png_of_field(mediant.Grid.from_rows([".#", "##"]).field((0, 0))))
    assert tuple(pixels[0, 0]) == _picture.RAMP[0]


def test_notebooks_show_maps_and_fields():
    grid = mediant.Grid.from_rows([".#.", "..."])
    assert grid._repr_png_() == png_of(grid)
    field = grid.field((0, 0))
    assert field._repr_png_() == png_of_field(field)


def test_without_matplotlib_and_pillow():
    program = (
        "import sys; sys.modules['matplotlib'] = sys.modules['PIL'] = None\n"
        "import mediant, mediant._picture\n"
        "print(len(mediant._picture.png_of(mediant.Grid.from_rows(['..']))) > 0)\n"
        "import mediant.plot\n"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert run.stdout == "True\n"
    assert 'pip install "mediant[plot]"' in run.stderr.splitlines()[-1]
