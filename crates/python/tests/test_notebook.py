"""Notebooks: each runs from a fresh kernel, its asserts hold, and what is committed shows its pictures."""

import re
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))

PICTURES = {"corridor.ipynb": 9, "k.ipynb": 9}
"""The fewest pictures of each."""


def pictures(notebook):
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [output for output in outputs if "image/png" in output.get("data", {})]


def test_there_is_a_notebook():
    assert {notebook.name for notebook in NOTEBOOKS} == set(PICTURES)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_what_is_committed_was_run_in_order_and_is_small(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    assert not [output for cell in code for output in cell.outputs if output.output_type == "error"]
    assert not [output for cell in code for output in cell.outputs if output.get("name") == "stderr"]
    assert len(pictures(notebook)) >= PICTURES[path.name]
    assert path.stat().st_size < 500_000
    # The times of cells change each run.
    assert not [cell for cell in notebook.cells if "execution" in cell.metadata]
    texts = [output.get("text", "") for cell in code for output in cell.outputs]
    assert not re.search(r"/(home|root|tmp|usr|Users)/", "".join(texts)), "paths of a machine"


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_runs_from_a_fresh_kernel(path):
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    committed = nbformat.read(path, as_version=4)
    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    nbclient.NotebookClient(notebook, timeout=60, kernel_name="python3").execute()
    assert len(pictures(notebook)) == len(pictures(committed))
    # Its printed texts have no times, and are the same on each machine.
    for now, before in zip(notebook.cells, committed.cells):
        # A kernel may hand over a text in pieces.
        printed, expected = (
            "".join(output.text for output in cell.get("outputs", []) if output.get("name") == "stdout")
            for cell in (now, before)
        )
        assert printed == expected
