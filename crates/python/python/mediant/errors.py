"""The errors of the package. Each has `code`, a stable name, the same in all languages."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._mediant import Answer

__all__ = [
    "ArgumentError",
    "BrokenPathError",
    "FileError",
    "IndexFileError",
    "LimitReached",
    "MapError",
    "MediantError",
    "MismatchError",
    "MissingFileError",
    "OptionError",
    "QueryError",
]


class MediantError(ValueError):
    """Something that cannot be made, read, written or asked.

    Parameters
    ----------
    message : str
        A text: what was expected, what was found, and how to mend it.
    code : str
        A stable name of the kind of mistake, such as ``"start-blocked"``.

    Examples
    --------
    >>> import mediant
    >>> grid = mediant.Grid.from_rows(["..#", "..."])
    >>> try:
    ...     grid.path((0, 2), (0, 0))
    ... except mediant.MediantError as error:
    ...     print(error.code)
    start-blocked
    """

    code: str

    def __init__(self, message: str = "", code: str = "other") -> None:
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type[MediantError], tuple[str, str]]:
        return type(self), (str(self), self.code)


class ArgumentError(MediantError):
    """An argument with a value or shape that it cannot have. The text names it."""


class MapError(MediantError):
    """A map, or an edit of one, that cannot be made."""


class OptionError(MediantError):
    """An engine, a k, a rule of motion or an option that does not exist, or does not fit the others."""


class QueryError(MediantError):
    """A start or goal that is blocked or outside the map, or a number that is none."""


class MismatchError(MediantError):
    """Two things that belong to other maps, rules of motion or k."""


class IndexFileError(MediantError):
    """Bytes or a file that is no whole index, or one of another engine or version."""


class FileError(MediantError):
    """A file that cannot be read or written, or is no map."""


class MissingFileError(FileError, FileNotFoundError):
    """A file that does not exist."""


class BrokenPathError(MediantError):
    """A path that does not hold on a map.

    Attributes
    ----------
    holds_up_to : int
        The number of waypoints, from the start, up to which it can still be followed.
    """

    holds_up_to: int

    def __init__(self, message: str = "", code: str = "other", holds_up_to: int = 0) -> None:
        super().__init__(message, code)
        self.holds_up_to = holds_up_to

    def __reduce__(self) -> tuple[type[BrokenPathError], tuple[str, str, int]]:  # type: ignore[override]
        return type(self), (str(self), self.code, self.holds_up_to)


class LimitReached(MediantError):
    """A limit stopped the search, so that it is not known whether there is a path.

    Attributes
    ----------
    answer : Answer or None
        The best path so far, and a lower bound.
    """

    answer: Answer | None

    def __init__(self, message: str = "", code: str = "stopped", answer: Answer | None = None) -> None:
        super().__init__(message, code)
        self.answer = answer

    def __reduce__(self) -> tuple[type[LimitReached], tuple[str, str]]:
        return type(self), (str(self), self.code)
