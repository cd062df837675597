"""Import modules only when they are first used.

Functions of the packages above the engine that answers call are registered here by their names, by
``earthspin/__init__.py``.
"""

from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any

from earthspin.errors import EarthspinError, one_line

__all__ = ["FUNCTIONS", "METHODS", "erfa", "plug_in", "registered", "submodule", "xr"]

#: Modules of the registered functions, by the names of the functions.
FUNCTIONS: dict[str, str] = {}
#: Modules of the functions of an answer that are methods of its accessor, by their names.
METHODS: dict[str, str] = {}


def registered(name: str) -> Any:
    """Import the module of a function in `FUNCTIONS` or `METHODS`, and return the function."""
    return getattr(import_module((FUNCTIONS | METHODS)[name]), name)


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
            package = entry.dist.name if entry.dist else entry.value
            problem = f"'{name}' of the package {package} cannot be loaded: {one_line(error)}"
            raise EarthspinError(f"{problem}; update or remove that package") from error
    return None


class _Library:
    """Stand-in for a library that is imported only on first use, because the import is slow."""

    def __init__(self, name: str) -> None:
        self.__name__ = name

    def __getattr__(self, name: str) -> Any:
        return getattr(import_module(self.__name__), name)


if TYPE_CHECKING:
    import erfa
    import xarray as xr
else:
    erfa, xr = _Library("erfa"), _Library("xarray")


def submodule(package: str, name: str) -> object:
    """Import a module of a package when it is first used, as in ``earthspin.bodies``.

    Raises
    ------
    AttributeError
        If the package has no such module, or the name is private.
    """
    full = f"{package}.{name}"
    try:
        if not name.startswith("_"):
            return import_module(full)
    except ModuleNotFoundError as error:
        if error.name != full:
            raise
    raise AttributeError(f"module '{package}' has no attribute '{name}'")
