"""Mistaken calls of everything public: a right answer, or an error that names the argument.

`MEDIANT_CALLS` says how many calls are made in all.
"""

from __future__ import annotations

import os
import re

import mediant
import numpy as np
import pytest

hypothesis = pytest.importorskip("hypothesis")

import calls  # noqa: E402
import mistakes  # noqa: E402
from hypothesis import HealthCheck, given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402

CALLS = [call for call in calls.all_calls() if call.parameters]
COUNT = int(os.environ.get("MEDIANT_CALLS", "10000"))
# Words of messages that stand for an argument.
SYNONYMS = {
    "rows": ["a map of"],
    "side": ["clusters"],
    "gap": ["k = "],
    "corners": ["k = "],
    "neighbors": ["k from"],
}


@pytest.fixture(scope="module")
def things(tmp_path_factory):
    """The objects that are called. Files of any name are written where nothing is lost."""
    before = os.getcwd()
    os.chdir(tmp_path_factory.mktemp("cwd"))
    yield calls.Things(tmp_path_factory.mktemp("files"))
    os.chdir(before)


def test_calls_are_found():
    """The stub has all public callables of the module."""
    public = {
        (owner, name)
        for owner in ("Grid", "Disc", "Index", "Search", "Paths", "Field", "World", "Scenario", "Answer")
        for name, value in vars(getattr(mediant, owner)).items()
        if callable(value) and not name.startswith("_")
    }
    assert public <= {(call.owner, call.name) for call in calls.all_calls()}
    assert len(CALLS) >= 35
    assert sum(len(call.parameters) for call in CALLS) > 250


def outcome(things, call, arguments):
    """The result and the error of a call."""
    try:
        return things.call(call, arguments), None
    except Exception as error:  # A PanicException is none.
        return None, error


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::RuntimeWarning", "ignore::UserWarning")
@pytest.mark.filterwarnings("error::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("call", CALLS, ids=str)
def test_mistakes(things, call):
    """Up to two arguments are mistaken."""

    @settings(
        max_examples=max(1, COUNT * len(call.parameters) // sum(len(c.parameters) for c in CALLS)),
        deadline=None,
        database=None,
        derandomize=True,
        suppress_health_check=list(HealthCheck),
    )
    @given(
        st.dictionaries(
            st.sampled_from([p.name for p in call.parameters]), mistakes.VALUES, min_size=1, max_size=2
        )
    )
    def check(mistaken):
        arguments = {**things.good_call(call, list(mistaken)), **mistaken}
        before = [bytes_of(value) for value in mistaken.values()]
        result, error = outcome(things, call, arguments)
        assert before == [bytes_of(value) for value in mistaken.values()], "an array was changed"
        if error is not None:
            check_error(error, mistaken)
        clean = {name: plain(value) for name, value in mistaken.items()}
        # Numbers of NumPy have bytes, too.
        if "data" not in mistaken and all(value is not UNKNOWN for value in clean.values()):
            wanted, wanted_error = outcome(things, call, {**arguments, **clean})
            assert type(error) is type(wanted_error), (error, wanted_error)
            assert same(result, wanted), (result, wanted)

    check()


def bytes_of(value):
    """The content of an array."""
    return value.tobytes() if type(value) in (np.ndarray, np.memmap, np.matrix) else None


def check_error(error, mistaken):
    """It is of a kind that is allowed, and names an argument that is mistaken."""
    if isinstance(error, mistakes.EvilError) or any(callable(value) for value in mistaken.values()):
        return
    assert isinstance(error, (TypeError, mediant.MediantError, IndexError)), repr(error)
    if isinstance(error, (mediant.LimitReached, mediant.IndexFileError, mediant.FileError)):
        return  # An answer, and what is wrong with a file, which is named, or within bytes.
    text = " ".join([str(error), *getattr(error, "__notes__", [])])
    names = [
        name for argument in mistaken for name in (argument, argument.rstrip("s"), argument.replace("_", " "))
    ]
    names += [word for argument in mistaken for word in SYNONYMS.get(argument, [])]
    known = [str(value) for value in mistaken.values() if type(value) in (str, int, float) and str(value)]
    found = any(re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) for name in names)
    # Python's own words about an object that lies.
    found = found or "returned non-" in text
    assert found or isinstance(error, IndexError) or any(word in text for word in known), (text, mistaken)


UNKNOWN = object()


def plain(value):
    """The same as Python's own objects or a fresh array; UNKNOWN if that may be another thing."""
    if type(value) in (np.ndarray, np.memmap, np.matrix) and value.dtype.kind in "biuf":
        return np.array(value.tolist(), dtype=value.dtype.newbyteorder("=")).reshape(value.shape)
    if isinstance(value, np.integer) or type(value) is np.float64:
        return value.item()
    if type(value) in (type(None), bool, int, float, str, bytes):
        return value
    if type(value) in (tuple, list) and all(type(item) in (int, float) for item in value):
        return value
    return UNKNOWN


def same(a, b):
    """Whether two results are the same."""
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        is_float = a.dtype.kind == "f"
        return (a.dtype, a.shape) == (b.dtype, b.shape) and np.array_equal(a, b, equal_nan=is_float)
    if isinstance(a, (tuple, list)):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, float):
        return a == b or (a != a and b != b)
    if isinstance(a, mediant.Paths):
        return same((a.points, a.offsets, a.distances), (b.points, b.offsets, b.distances))
    if isinstance(a, mediant.Field):
        return same(a.distances(), b.distances())
    if isinstance(a, mediant.Index):
        return a.setup == b.setup and a.grid == b.grid
    if isinstance(a, mediant.Disc):
        return a.grid == b.grid and a.obstacles == b.obstacles
    if isinstance(a, mediant.Search):
        return same(a.finish(), b.finish())
    if isinstance(a, mediant.Answer):
        return same((a.status, a.distance, a.path, a.best), (b.status, b.distance, b.path, b.best))
    return bool(a == b)


def test_numbers_too_long_to_print(things, capfd):
    """Python refuses to write integers of more than 4300 digits."""
    for call in CALLS:
        for parameter in call.parameters:
            for number in (10**5000, -(10**5000)):
                _, error = outcome(
                    things, call, {**things.good_call(call, [parameter.name]), parameter.name: number}
                )
                allowed = (type(None), TypeError, mediant.MediantError, IndexError)
                assert isinstance(error, allowed), (call, parameter)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("call", CALLS, ids=str)
def test_unknown_and_missing_names(things, call):
    """A keyword that does not exist, one argument too many, one too few."""
    arguments = things.good_call(call, [])
    if call.name != "__getitem__":
        with pytest.raises(TypeError, match="nonsense"):
            things.call(call, {**arguments, "nonsense": 1})
    many = [things.good(call, p) for p in call.parameters]
    with pytest.raises(TypeError):
        things.function(call)(*many, 1, 2, 3)
    if call.parameters[0].is_required:
        with pytest.raises(TypeError):
            things.function(call)()
