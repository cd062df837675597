"""Import modules only when they are first used as attributes of their package."""

from importlib import import_module


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
