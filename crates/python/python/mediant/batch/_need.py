"""Packages that only some of us need."""

from __future__ import annotations

import importlib
from typing import Any

__all__ = ["need"]


def need(name: str, extra: str) -> Any:
    """Import the package `name`, or say which extra of ours brings it.

    It also keeps our functions `dask` and `ray` apart from the packages of these names.
    """
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f'mediant.batch needs {name}: pip install "mediant[{extra}]" ({error})') from error
