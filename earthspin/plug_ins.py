"""Effects and questions of other installed packages, which name them by entry points."""

from __future__ import annotations

from functools import cache
from importlib.metadata import entry_points
from typing import Any

from earthspin.errors import EarthspinError, one_line

__all__ = ["plug_in"]


@cache
def plug_in(group: str, name: str) -> Any:
    """Load what another package offers under a name as an entry point, ``earthspin.<group>``.

    Returns
    -------
    object
        None if no installed package has the entry point.

    Raises
    ------
    EarthspinError
        If it cannot be loaded.
    """
    for entry in entry_points(group=f"earthspin.{group}", name=name):
        try:
            return entry.load()
        except Exception as error:  # any error of someone else's module
            problem = f"'{name}' cannot be loaded from {entry.value}: {one_line(error)}"
            raise EarthspinError(f"{problem}; update or remove its package") from error
    return None
