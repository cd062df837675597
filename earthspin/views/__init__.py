"""Tables, figures and HTML pages of results."""

from earthspin._lazy import submodule


def __getattr__(name: str) -> object:
    return submodule(__name__, name)
