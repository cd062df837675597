"""What people look at: tables, figures, the HTML page."""

from earthspin._lazy import submodule


def __getattr__(name: str) -> object:
    return submodule(__name__, name)
