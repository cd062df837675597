"""Version of this package, read by the build, and versions of installed packages."""

from functools import lru_cache

__version__ = "0.1.0"


@lru_cache
def version(package: str) -> str:
    """Version of an installed package, looked up once."""
    from importlib import metadata

    return metadata.version(package)
