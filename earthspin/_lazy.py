"""Import modules only when they are first used.

Functions of the packages above the engine that answers call are registered here by their names, by
``earthspin/__init__.py``.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

__all__ = ["FUNCTIONS", "METHODS", "erfa", "registered", "submodule", "xr"]

#: Modules of the registered functions, by the names of the functions.
FUNCTIONS: dict[str, str] = {}
#: Modules of the functions of an answer that are methods of its accessor, by their names.
METHODS: dict[str, str] = {}


def registered(name: str) -> Any:
    """Import the module of a function in `FUNCTIONS` or `METHODS`, and return the function."""
    return getattr(import_module((FUNCTIONS | METHODS)[name]), name)


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
