"""Tables, figures and HTML pages of results."""

from earthspin._lazy import submodule

#: Interactive pages, named after their templates.
PLAYS = ("precession", "rotor", "sunlight", "top", "wobble")


def __getattr__(name: str) -> object:
    return submodule(__name__, name)
