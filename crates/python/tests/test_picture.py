"""Pictures for notebooks: what Pillow reads from them, against the map cell by cell."""

import io
import subprocess
import sys

import mediant
import numpy as np
import pytest

Image = pytest.importorskip("PIL.Image")

SIDES = [(1, 1), (5, 9), (32, 4), (300, 513), (1025, 1024), (5000, 1)]


def decoded(png):
    """The pixels, shape (rows, columns, 3)."""
    with Image.open(io.BytesIO(png)) as picture:
        assert picture.format == "PNG"
        return np.asarray(picture.convert("RGB")).astype(int)


def middles(pixels, shape):
    """The pixel in the middle of each cell, or of each vertex at centers."""
    rows, columns = (((np.arange(n) + 0.5) * m / n).astype(int) for n, m in zip(shape, pixels.shape))
    return pixels[np.ix_(rows, columns)]


@pytest.mark.parametrize("shape", SIDES)
def test_size_is_bounded_and_keeps_the_proportions(shape):
    height, width, _ = decoded(mediant.Grid(np.zeros(shape, dtype=bool))._repr_png_()).shape
    # There is a margin around the map, and there are lines between large cells.
    rows, columns = height - 30, width - 30
    assert 0 < rows < 1030
    assert 0 < columns < 1030
    if min(shape) > 100:
        assert abs(columns / rows - shape[1] / shape[0]) < 0.02


def test_blocked_cells_are_darker_than_free_ones(rng):
    blocked = rng.random((7, 12)) < 0.4
    lightness = middles(decoded(mediant.Grid(blocked)._repr_png_()), blocked.shape).sum(axis=2)
    assert lightness[blocked].max() + 100 < lightness[~blocked].min()


def test_a_field_is_darker_farther_away():
    field = mediant.Grid.from_rows(["........", "######.#", "........"]).field((0, 0))
    distances = field.distances()
    lightness = middles(decoded(field._repr_png_()), distances.shape) @ (0.2126, 0.7152, 0.0722)
    reached = np.isfinite(distances)
    order = np.argsort(distances[reached], kind="stable")
    assert (np.diff(lightness[reached][order]) <= 1).all()
    assert lightness[0, 0] > lightness[2, 0] + 40


def test_without_matplotlib_and_pillow():
    program = (
        "import sys; sys.modules['matplotlib'] = sys.modules['PIL'] = None\n"
        "import mediant\n"
        "print(len(mediant.Grid.from_rows(['..'])._repr_png_()) > 0)\n"
        "import mediant.plot\n"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert run.stdout == "True\n"
    assert 'pip install "mediant[plot]"' in run.stderr.splitlines()[-1]
