"""Each public item has a docstring in the form of numpydoc, and its examples run as they are."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import re

import calls
import mediant
import pytest

ERRORS = [
    value for value in vars(mediant).values() if isinstance(value, type) and issubclass(value, ValueError)
]
PARSER, RUNNER = doctest.DocTestParser(), doctest.DocTestRunner
FLAGS = doctest.NORMALIZE_WHITESPACE


def modules():
    """The modules of the package, and those that cannot be imported here."""
    found = [mediant]
    for info in pkgutil.walk_packages(mediant.__path__, "mediant."):
        if info.name != "mediant._mediant":
            try:
                found.append(importlib.import_module(info.name))
            except ImportError as error:
                assert "pip install" in str(error) or error.name not in (None, "mediant"), info.name
    return found


def documented():
    """All docstrings by name: of modules, classes, functions and methods, also compiled ones."""
    found = {}
    for module in [*modules(), importlib.import_module("mediant._mediant")]:
        found[module.__name__] = module.__doc__
        for name, value in vars(module).items():
            is_here = getattr(value, "__module__", None) == module.__name__
            if module.__name__ == "mediant._mediant":
                is_here = not name.startswith("_")
            if not (is_here and (inspect.isroutine(value) or inspect.isclass(value))):
                continue
            where = f"{module.__name__}.{name}"
            found[where] = value.__doc__
            members = vars(value).items() if inspect.isclass(value) else ()
            for member, _ in members:
                if not member.startswith("_"):
                    found[f"{where}.{member}"] = getattr(value, member).__doc__
    return {name: inspect.cleandoc(text) for name, text in found.items() if text}


TEXTS = documented()


@pytest.mark.parametrize("name", [name for name, text in TEXTS.items() if ">>>" in text])
def test_examples(name):
    """The examples of a docstring. The finder of doctest skips compiled methods; this one does not."""
    if name.startswith(("mediant.plot", "mediant._drawing")):
        pytest.importorskip("matplotlib").use("agg")
    if name.startswith("mediant.batch"):
        pytest.importorskip("pyarrow")
    for cluster in ("dask", "ray"):
        if name.startswith(f"mediant.batch.on_{cluster}"):
            pytest.importorskip(cluster)
    output = []
    test = PARSER.get_doctest(TEXTS[name], {}, name, None, None)
    result = RUNNER(optionflags=FLAGS).run(test, out=output.append)
    assert result.failed == 0, "".join(output)


def test_examples_are_found():
    compiled = [name for name, text in TEXTS.items() if name.startswith("mediant._mediant") and ">>>" in text]
    assert len(compiled) >= 60


def sections(text):
    """The titles of the sections."""
    return re.findall(r"^(\w[\w ]*)\n-{3,}$", text, re.MULTILINE)


@pytest.mark.parametrize("call", [c for c in calls.all_calls() if not c.name.startswith("_")], ids=str)
def test_sections_of_calls(call):
    """Parameters are named in their section; what is returned, and an example, are there."""
    text = TEXTS[f"mediant._mediant.{call}"]
    titles = sections(text)
    assert "Examples" in titles
    assert ("Parameters" in titles) == bool(call.parameters)
    if call.name not in ("check", "save", "write_trace"):
        assert "Returns" in titles
    order = ["Parameters", "Returns", "Raises", "Notes", "Examples"]
    assert titles == [title for title in order if title in titles]
    if call.parameters:
        body = text.split("Parameters\n----------\n")[1].split("\n\n")[0]
        entries = re.findall(r"^(\S[^:\n]*?)(?: :.*)?$", body, re.MULTILINE)
        named = [name.strip("* ") for entry in entries for name in entry.split(",")]
        wanted = [p.name for p in call.parameters]
        first = [p.name for p in call.parameters if not p.is_keyword]
        assert named[: len(first)] == first
        required = [p.name for p in call.parameters if p.is_required]
        assert set(required) <= set(named)
        unknown = set(named) - set(wanted) - {"motion", "how", "wishes", "options"}
        assert not unknown


@pytest.mark.parametrize(
    "name", ["Grid", "Disc", "Index", "Search", "Paths", "Answer", "Field", "World", "Scenario"]
)
def test_attributes(name):
    """Each property has an entry among the attributes of its class, which has an example."""
    text, kind = TEXTS[f"mediant._mediant.{name}"], getattr(mediant, name)
    properties = [member for member, value in vars(kind).items() if inspect.isgetsetdescriptor(value)]
    body = text.split("Attributes\n----------\n")[1].split("\n\n")[0] if properties else ""
    entries = re.findall(r"^(\w+) :", body, re.MULTILINE)
    assert sorted(entries) == sorted(properties)
    assert "Examples" in sections(text)


@pytest.mark.parametrize("name", mediant.__all__)
def test_public_items_are_documented(name):
    value = getattr(mediant, name)
    if callable(value):
        summary = inspect.cleandoc(value.__doc__).splitlines()[0]
        assert summary.endswith(".")


@pytest.mark.parametrize("call", [c for c in calls.all_calls() if not c.name.startswith("_")], ids=str)
def test_validator(call):
    """Numpydoc finds no mistake, but for sections that we leave out on purpose."""
    validate = pytest.importorskip("numpydoc.validate")
    ignored = {
        "EX01",
        "SA01",
        "ES01",
        "GL03",
        "GL08",
        "PR01",
        "PR02",
        "PR04",
        "PR06",
        "PR08",
        "PR09",
        "RT02",
        "RT03",
    }
    ignored |= {"RT04", "RT05", "SS05", "SS06", "PR03", "PR05", "PR10", "GL01", "GL02"}
    found = [error for error in validate.validate(f"mediant.{call}")["errors"] if error[0] not in ignored]
    assert not found
