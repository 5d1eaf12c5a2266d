"""The table of calls that every language answers alike: see `crates/mediant/tests/calls.json`."""

from __future__ import annotations

import json
from pathlib import Path

import mediant
import numpy as np
import pytest

TABLE = json.loads((Path(__file__).parents[2] / "mediant" / "tests" / "calls.json").read_text("utf-8"))
CASES = TABLE["cases"]


def test_the_table_is_whole():
    assert len(CASES) >= 140


@pytest.mark.parametrize("case", CASES, ids=lambda case: json.dumps(case["call"]))
def test_call(case):
    grid = mediant.Grid.from_rows(TABLE["maps"][case["map"]])
    how = {name.replace("-", "_"): value for name, value in case["call"].items()}
    ends = [(row, column) for column, row in (case["start"], case["goal"])]
    expected = case["expected"]
    if case.get("published"):
        # Options that only reproduce publications are in the program, not in the package.
        with pytest.raises((mediant.MediantError, TypeError)):
            grid.find(*ends, **how)
        return
    if "code" in expected:
        with pytest.raises((mediant.MediantError, TypeError)) as caught:
            grid.find(*ends, **how)
        # Of another type: Python has an exception of its own for that.
        code = "argument" if isinstance(caught.value, TypeError) else caught.value.code
        assert code == expected["code"], caught.value
        return
    answer = grid.find(*ends, **how)
    assert (grid.setup(**how), answer.status) == (expected["setup"], expected["status"])
    assert answer.stopped_by == expected.get("stopped_by")
    assert (answer.path is None) == ("path" not in expected)
    if answer.path is not None:
        assert np.array_equal(answer.path[:, ::-1], expected["path"])
        assert answer.distance == expected["distance"]
