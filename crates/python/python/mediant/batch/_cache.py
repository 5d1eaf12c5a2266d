"""The indexes of a process: each is made once, whoever asks for it, and the least used go first."""

from __future__ import annotations

import os
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from concurrent.futures import Future

from .._mediant import Index
from ._sources import have_costs

__all__ = ["Cache", "cache"]

LIMIT = "MEDIANT_BATCH_CACHE_BYTES"


class Cache:
    """Indexes by their keys, in all no larger than a limit. Threads can share it.

    The index used last is always kept, however large: it would be made again for each part of a table
    otherwise. An index that leaves the cache lives on while a query uses it.

    Parameters
    ----------
    limit_bytes : int
        The most memory of all indexes together, by their `memory_bytes`, with their maps.

    Examples
    --------
    >>> import mediant
    >>> from mediant import batch
    >>> batch.cache.clear()
    >>> queries = {"start_row": [0], "start_column": [0], "goal_row": [0], "goal_column": [1]}
    >>> for _ in range(3):
    ...     _ = batch.solve(queries, mediant.Grid.from_rows([".."]))
    >>> info = batch.cache.info()
    >>> info["made"], info["found"], info["indexes"]
    (1, 2, 1)
    """

    def __init__(self, limit_bytes: int) -> None:
        self.limit_bytes = limit_bytes
        self._lock = threading.Lock()
        self._indexes: OrderedDict[Hashable, Future[Index]] = OrderedDict()
        self._made = self._found = self._dropped = 0

    def get(self, key: Hashable, make: Callable[[], Index]) -> Index:
        """Give the index of a key, and make it if it is not there.

        Parameters
        ----------
        key : hashable
            The identity of the index: its map, engine, motion and options.
        make : callable
            Makes it. While it runs, others who ask for the same key wait, and others work on.

        Returns
        -------
        Index

        Raises
        ------
        Exception
            Whatever `make` raises. The next who asks tries anew.
        """
        with self._lock:
            future = self._indexes.get(key)
            mine = future is None
            if future is None:
                future = self._indexes[key] = Future()
            else:
                self._indexes.move_to_end(key)
                self._found += 1
        if mine:
            self._fill(key, future, make)
        return future.result()

    def _fill(self, key: Hashable, future: Future[Index], make: Callable[[], Index]) -> None:
        try:
            index = make()
        except BaseException as error:
            with self._lock:
                if self._indexes.get(key) is future:
                    del self._indexes[key]
            future.set_exception(error)
            return
        future.set_result(index)
        with self._lock:
            self._made += 1
            self._shrink()

    def _shrink(self) -> None:
        ready = [(key, future) for key, future in self._indexes.items() if future.done()]
        total = sum(_size(future.result()) for _, future in ready)
        for key, future in ready[:-1]:
            if total <= self.limit_bytes:
                return
            total -= _size(future.result())
            del self._indexes[key]
            self._dropped += 1

    def info(self) -> dict[str, int]:
        """Give what happened in this process since the last `clear`.

        Returns
        -------
        dict of str to int
            `made`, indexes that were prepared or loaded; `found`, requests that found theirs; `dropped`,
            indexes that left for want of room; `indexes`, those that are here; `bytes`, what they take; and
            `process`, the number of the process.
        """
        with self._lock:
            ready = [future.result() for future in self._indexes.values() if _is_ready(future)]
            return {
                "process": os.getpid(),
                "made": self._made,
                "found": self._found,
                "dropped": self._dropped,
                "indexes": len(ready),
                "bytes": sum(map(_size, ready)),
            }

    def clear(self) -> None:
        """Forget all indexes, and what `info` counts."""
        with self._lock:
            self._indexes.clear()
            self._made = self._found = self._dropped = 0


def _size(index: Index) -> int:
    """Give the bytes of an index and of its map: a bit for a cell, and four bytes for its cost or height."""
    rows, columns = index.grid.shape
    return index.memory_bytes + rows * columns // 8 + 4 * rows * columns * have_costs(index.grid)


def _is_ready(future: Future[Index]) -> bool:
    return future.done() and future.exception() is None


cache = Cache(int(os.environ.get(LIMIT) or 1 << 30))
"""The cache of this process."""
