"""The public calls of the package, as its stub says: names, parameters, and values that they take."""

from __future__ import annotations

import ast
import dataclasses
import pathlib

import mediant
import numpy as np

# Not called with mistakes: what Python itself calls, with its own checks.
SKIPPED = {"__reduce__", "__eq__", "__ne__", "__hash__", "__len__", "__array__", "_repr_png_", "__iter__"}


@dataclasses.dataclass(frozen=True)
class Parameter:
    """One parameter: its name, its type in the stub, and whether it can be left out, or has to be named."""

    name: str
    type: str
    is_required: bool
    is_keyword: bool


@dataclasses.dataclass(frozen=True)
class Call:
    """A public callable: its owner ('' for a function), its name and its parameters.

    `takes_more` says whether it reads the keywords of motion, wishes or options.
    """

    owner: str
    name: str
    is_static: bool
    parameters: tuple[Parameter, ...]
    takes_more: bool = False

    def __str__(self):
        return ".".join(filter(None, (self.owner, self.name)))


def stub():
    """The stub's syntax tree."""
    return ast.parse((pathlib.Path(mediant.__file__).parent / "_mediant.pyi").read_text(encoding="utf-8"))


def _typed_dicts(tree):
    """The keywords of each TypedDict, with those of its bases."""
    known: dict[str, dict[str, str]] = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            bases = [base.id for base in node.bases if isinstance(base, ast.Name)]
            if "TypedDict" in bases or any(base in known for base in bases):
                items = [item for item in node.body if isinstance(item, ast.AnnAssign)]
                own = {item.target.id: ast.unparse(item.annotation) for item in items}
                inherited = {name: kind for base in bases for name, kind in known.get(base, {}).items()}
                known[node.name] = {**inherited, **own}
    return known


def _parameters(function, dicts, is_method):
    a = function.args
    positional = (a.posonlyargs + a.args)[is_method:]
    first_optional = len(positional) - len(a.defaults)
    for i, arg in enumerate(positional):
        yield Parameter(arg.arg, ast.unparse(arg.annotation), i < first_optional, False)
    for arg, default in zip(a.kwonlyargs, a.kw_defaults):
        yield Parameter(arg.arg, ast.unparse(arg.annotation), default is None, True)
    if a.kwarg:
        name = ast.unparse(a.kwarg.annotation)[len("Unpack[") : -1]
        for keyword, kind in dicts[name].items():
            yield Parameter(keyword, kind, False, True)


def all_calls():
    """All public callables."""
    tree, found = stub(), {}
    dicts = _typed_dicts(tree)
    owners = [("", tree.body), *((c.name, c.body) for c in tree.body if isinstance(c, ast.ClassDef))]
    for owner, body in owners:
        if owner in dicts or owner in ("DataArray", "Dataset"):
            continue
        for node in body:
            decorators = [ast.unparse(d) for d in getattr(node, "decorator_list", [])]
            is_public = isinstance(node, ast.FunctionDef) and node.name not in SKIPPED
            if is_public and not {"property", "overload"} & set(decorators):
                is_static = "staticmethod" in decorators
                parameters = tuple(_parameters(node, dicts, bool(owner) and not is_static))
                more = node.args.kwarg is not None
                found[owner, node.name] = Call(owner, node.name, is_static, parameters, more)
    index = (Parameter("index", "SupportsIndex", True, False),)
    found["Paths", "__getitem__"] = Call("Paths", "__getitem__", False, index)
    return list(found.values())


# The engine that takes an option.
TAKERS = {
    "heuristic": "astar",
    "levels": "subgoal",
    "memory": "subgoal",
    "side": "hpa",
    "landmarks": "landmarks",
}


class Raster:
    """A raster that is like one of xarray."""

    def __init__(self, values, coords=None, dims=("y", "x"), name=None, attrs=None):
        self.values = self.data = values
        self.shape, self.dtype, self.dims, self.name = values.shape, values.dtype, dims, name
        self.coords, self.attrs = coords or {}, attrs or {}


class Things:
    """The objects that are called, and good values of their parameters."""

    ROWS = (".........", "..#......", "..#..#...", "..#..##..", ".....#...", ".........")
    SCENARIO = b"version 1\n0 room.map 9 6 0 0 8 5 10.5\n"

    def __init__(self, folder):
        self.folder = folder
        self.grid = mediant.Grid.from_rows(self.ROWS)
        self.costs = mediant.Grid.from_costs(np.arange(1, 55).reshape(6, 9))
        self.index = self.grid.prepare("hpa", side=4)
        self.index.save(folder / "index")
        (folder / "room.scen").write_bytes(self.SCENARIO)
        (folder / "room.pgm").write_text("P2 4 3 255 " + "254 " * 12)
        lines = ["image: room.pgm", "resolution: 0.5", "origin: [1, 2, 0]", "negate: 0"]
        (folder / "room.yaml").write_text(
            "\n".join([*lines, "occupied_thresh: 0.65", "free_thresh: 0.25", ""])
        )
        self.owners = {
            "Grid": self.grid,
            "Index": self.index,
            "Paths": self.index.paths((0, 0), [(1, 1), (5, 8), (0, 3)]),
            "Field": self.grid.field((0, 1)),
            "World": mediant.Grid.open(folder / "room.yaml").world,
            "Disc": self.grid.disc(0.7),
            "Scenario": mediant.Scenario.from_bytes(self.SCENARIO),
        }

    def function(self, call):
        """The callable."""
        if call.name == "__new__":
            return getattr(mediant, call.owner)
        if not call.owner:
            return getattr(mediant, call.name)
        if call.owner == "Search":  # A step changes it.
            return getattr(self.index.search((0, 0), (5, 8), trace=True), call.name)
        if call.name == "edit_costs":
            return self.costs.edit_costs
        return getattr(getattr(mediant, call.owner) if call.is_static else self.owners[call.owner], call.name)

    def good_call(self, call, mistaken):
        """Arguments by name that the call takes, fit for a value of the parameters that are mistaken."""
        arguments = {p.name: self.good(call, p) for p in call.parameters if p.is_required}
        if call.name == "__new__" and {"above", "below", "values"} & set(mistaken):
            arguments["array"] = np.arange(12).reshape(3, 4)
        if call.name == "__new__" and "cell_size" in mistaken:
            arguments["costs"] = np.full((3, 4), 2.5)
        if call.name == "from_elevation" and "transform" not in mistaken:
            arguments["cell_size"] = 10  # It is not known of an array.
        if call.name in ("for_disc", "disc") and "meters" not in mistaken:
            arguments["radius"] = 1.5  # One of the two is needed.
        engines = [TAKERS[name] for name in mistaken if name in TAKERS]
        if engines and any(p.name == "engine" for p in call.parameters):
            arguments["engine"] = engines[0]
        return arguments

    def call(self, call, arguments):
        """Calls with these arguments, by position where they can be."""
        named = {p.name for p in call.parameters if p.is_keyword}
        order = [p.name for p in call.parameters if p.name in arguments and p.name not in named]
        is_dense = order == [p.name for p in call.parameters if p.name not in named][: len(order)]
        keywords = {name: value for name, value in arguments.items() if name not in order or not is_dense}
        return self.function(call)(*[arguments[name] for name in order if is_dense], **keywords)

    def good(self, call, parameter):
        """A value that the call takes."""
        by_name = {
            "array": np.zeros((3, 4), dtype=bool),
            "occupancy": np.zeros((3, 4), dtype=np.int8),
            "width": 4,
            "height": 3,
            "origin": (1, 2, 0),
            "blocked": np.ones((2, 1), dtype=bool),
            "path": [(0, 0), (0, 8), (5, 8)],
            "points": [(0, 0), (2, 3)],
            "data": self.index.to_bytes(),
            "grid": self.grid.edit((0, 0), [[False]]),
            "rows": [".#.", "..."],
            "threshold": 0.5,
            "engine": "astar",
            "values": [1, 3],
            "side": 2,
            "landmarks": 4,
            "cells": [(0, 0), (1, 2)],
            "shape": (3, 4),
            "world": mediant.World(0.5, shape=(6, 9)),
            "costs": np.full((3, 4), 2.5),
            "elevation": np.arange(12).reshape(3, 4),
            "friction": np.full((3, 4), 0.5),
            "pace": [(-1, 2.0), (0, 0.7), (1, 5.0)],
            "cell_size": (2, 3),
            "nodata": -9999,
            "transform": (2.0, 0.0, 10.0, 0.0, -2.0, 50.0),
            "other": self.owners["Field"],
            "like": Raster(np.ones((6, 9))),
            "costmap": np.arange(12).reshape(3, 4),
        }
        if "PathLike" in parameter.type:
            names = {"load": "index", "save": "saved", "write_trace": "trace"}
            names["open"] = "room.scen" if call.owner == "Scenario" else "room.pgm"
            return self.folder / names[call.name]
        if call.name == "find_except" and parameter.name in {"blocked", "free"}:
            return [(0, 2)]
        if call.name == "edit_cells" and parameter.name == "blocked":
            return [True, False]
        if call.name == "edit_costs":
            return {"cells": [(0, 0), (1, 2)], "costs": [3, 4.5]}[parameter.name]
        if call.name == "from_bytes":
            return self.SCENARIO
        if parameter.name in {"free", "blocked"} and parameter.type == "str | None":
            return {"free": ".", "blocked": "#"}[parameter.name]
        if parameter.name in by_name and not parameter.type.startswith("PathPoints"):
            return by_name[parameter.name]
        kinds = {"Point": (1, 3), "Points": [(1, 3), (0, 4)], "K": 3, "bool": True, "PathPoints": "touched"}
        kinds.update({"Place": (1, 3), "Places": [(1, 3), (0, 4)]})
        kinds.update({"Placement": "center", "Corners": "one", "Gap": "open", "Heuristic": "zero"})
        kinds.update({"Variant": "exact", "Smooth": "taut", "Heading": "from"})
        kind = parameter.type.split(" | ")[0].split("[")[0]
        if kind == "Literal":
            return ast.literal_eval(parameter.type.split("[")[1].split(",")[0].rstrip("]"))
        return kinds.get(kind) or {"SupportsFloat": 2.5, "SupportsIndex": 2, "Callable": print_nothing}[kind]


def print_nothing(*_):
    """A callback."""
