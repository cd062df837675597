"""Effects and questions of other installed packages, which name them by entry points.

Only they can bring arrays of dask or pint to a command. xarray imports both, where they are
installed, as soon as it looks for such arrays; a command without them hides them.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib.metadata import entry_points
from typing import Any

from earthspin.errors import EarthspinError, one_line

__all__ = ["hide_array_libraries", "plug_in"]

_ARRAY_LIBRARIES = ("dask", "pint")


def hide_array_libraries() -> None:
    """Make dask and pint look absent to xarray, until a plug-in is loaded: 0.5 s less."""
    for name in _ARRAY_LIBRARIES:
        sys.modules.setdefault(name, None)  # type: ignore[arg-type]


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
        for library in _ARRAY_LIBRARIES:
            if library in sys.modules and sys.modules[library] is None:
                del sys.modules[library]
        try:
            return entry.load()
        except Exception as error:  # any error of someone else's module
            problem = f"'{name}' cannot be loaded from {entry.value}: {one_line(error)}"
            raise EarthspinError(f"{problem}; update or remove its package") from error
    return None
