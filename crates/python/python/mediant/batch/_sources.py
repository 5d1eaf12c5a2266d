"""The sources of an index: a map, a file, an index, or the bytes of one of these."""

from __future__ import annotations

import hashlib
import os
import pickle
from collections.abc import Hashable, Mapping
from typing import Any, NamedTuple, Protocol, Union

import numpy as np
from numpy.typing import NDArray

from .._mediant import Grid, Index
from ..errors import FileError, MismatchError, MissingFileError

__all__ = ["Setup", "Source", "sources_of"]

OneMap = Union[Grid, Index, str, "os.PathLike[str]", "tuple[Any, Any]", Any]


class Setup(NamedTuple):
    """The engine, motion and options of indexes. None leaves a choice to the engine, or to a given index."""

    engine: str | None
    k: Any
    placement: str | None
    corners: str | None
    gap: str | None
    options: tuple[tuple[str, Any], ...]

    def prepare(self, grid: Grid, threads: int | None) -> Index:
        """Prepare a map."""
        how = {**self._motion(), **dict(self.options)}
        return grid.prepare(self.engine, threads=threads, **how)  # type: ignore[arg-type]

    def check(self, index: Index, name: str) -> Index:
        """Give the index, if nothing that was asked for is otherwise."""
        has = {"engine": index.engine, "k": index.k, "placement": index.placement, "rule": index.rule}
        wanted = {"engine": self.engine, **self._motion()}
        wanted["rule"] = wanted.pop("gap", None) or wanted.pop("corners", None)
        wrong = [
            f"{word}={wanted[word]!r} (it has {has[word]!r})"
            for word in has
            if wanted.get(word) not in (None, has[word])
        ]
        if wrong:
            raise MismatchError(f"the index of {name} is not of {' and '.join(wrong)}", "index-setup")
        return index

    def _motion(self) -> dict[str, Any]:
        motion = {"k": self.k, "placement": self.placement, "corners": self.corners, "gap": self.gap}
        return {name: value for name, value in motion.items() if value is not None}


class Source(Protocol):
    """A maker of the index of a map. Sources pickle, and are small in the process that gets them."""

    def key(self) -> Hashable:
        """Tell it from others: those of one key make the same index."""

    def open(self, setup: Setup, threads: int | None) -> Index:
        """Make the index."""

    def packed(self) -> Source:
        """Give one that can be sent to another process, and costs nothing there until it is opened."""


class OfGrid(NamedTuple):
    """A map in memory."""

    grid: Grid

    def key(self) -> Hashable:
        return self.grid.id

    def open(self, setup: Setup, threads: int | None) -> Index:
        return setup.prepare(self.grid, threads)

    def packed(self) -> Source:
        return Packed.of(self.grid, self.grid.id)


class OfIndex(NamedTuple):
    """An index in memory."""

    ready: Index

    def key(self) -> Hashable:
        return ("index", id(self.ready))  # It is never in the cache of a process that has it.

    def open(self, setup: Setup, threads: int | None) -> Index:
        return setup.check(self.ready, "a map")

    def packed(self) -> Source:
        return Packed.of(self.ready, None)


class OfFiles(NamedTuple):
    """The file of a map, and that of its index, or none. Whoever opens it must be able to read them."""

    path: str
    index_path: str | None = None

    def key(self) -> Hashable:
        return tuple(_version(path) for path in self if path is not None)

    def open(self, setup: Setup, threads: int | None) -> Index:
        grid = Grid.open(self.path)
        return (
            setup.prepare(grid, threads) if self.index_path is None else _load(grid, self.index_path, setup)
        )

    def packed(self) -> Source:
        return self


class WithIndexFile(NamedTuple):
    """A map in memory, and the file of its index."""

    grid: Grid
    index_path: str

    def key(self) -> Hashable:
        return (self.grid.id, _version(self.index_path))

    def open(self, setup: Setup, threads: int | None) -> Index:
        return _load(self.grid, self.index_path, setup)

    def packed(self) -> Source:
        return Packed.of(self.grid, self.grid.id, self.index_path)


class Packed(NamedTuple):
    """The pickled bytes of a map or an index. They are an array, so that processes can share them."""

    data: NDArray[np.uint8]
    name: str
    index_path: str | None = None

    @staticmethod
    def of(thing: Any, name: str | None, index: str | None = None) -> Packed:
        """Pack a map or an index. Without a name, it is called after its bytes."""
        data = pickle.dumps(thing, protocol=5)
        name = name or hashlib.blake2b(data, digest_size=16).hexdigest()
        return Packed(np.frombuffer(data, dtype=np.uint8), name, index)

    def key(self) -> Hashable:
        return (self.name, None if self.index_path is None else _version(self.index_path))

    def open(self, setup: Setup, threads: int | None) -> Index:
        return source_of(pickle.loads(self.data.data), self.index_path).open(setup, threads)

    def packed(self) -> Source:
        return self


def sources_of(maps: Any) -> tuple[dict[Any, Source], bool]:
    """Take maps by their keys, or one map. Says whether there are keys."""
    if isinstance(maps, Mapping):
        return {key: source_of(value, name=f"the map {key!r}") for key, value in maps.items()}, True
    return {None: source_of(maps)}, False


def source_of(value: OneMap, index: str | None = None, name: str = "the map") -> Source:
    """Take a map, an index, the path of a map file, or a pair of a map and the path of its index."""
    if isinstance(value, tuple) and len(value) == 2 and index is None:
        return source_of(value[0], _absolute(value[1]), name)
    if isinstance(value, (str, os.PathLike)):
        return OfFiles(_absolute(value), index)
    if isinstance(value, np.ndarray):
        value = Grid(value)
    if isinstance(value, Grid):
        return OfGrid(value) if index is None else WithIndexFile(value, index)
    if isinstance(value, Index) and index is None:
        return OfIndex(value)
    raise TypeError(
        f"expected for {name} a mediant.Grid or mediant.Index, an array of bool, the path of a map file, or "
        f"a pair of a map and the path of its index; found {type(value).__name__}"
    )


def have_costs(grid: Grid | None) -> bool:
    """Whether the paths of a grid have costs: its cells have costs or elevations."""
    return grid is not None and (grid.has_costs or grid.pace is not None)


def _load(grid: Grid, path: str, setup: Setup) -> Index:
    return setup.check(grid.load(path, **dict(setup.options)), repr(path))


def _absolute(path: str | os.PathLike[str]) -> str:
    return os.path.abspath(os.fspath(path))


def _version(path: str) -> Hashable:
    """Tell a file from what it was before."""
    try:
        status = os.stat(path)
    except FileNotFoundError:
        raise MissingFileError(f"there is no file {path!r} (on this machine)", "missing-file") from None
    except OSError as error:
        raise FileError(f"cannot read {path!r}: {error}", "file") from None
    return (path, status.st_size, status.st_mtime_ns)
