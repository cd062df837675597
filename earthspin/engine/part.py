"""A part: a typed function that computes one thing.

What it needs follows from its signature: each parameter is a key of the question or the result of
another part, by name; one whose default is None is used if it is there. A part all of whose
parameters may be None stands on one part or more of those.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property, update_wrapper
from typing import Any, Generic, ParamSpec, TypeVar, overload

from earthspin.engine.variables import Variable, Variables

P = ParamSpec("P")
R = TypeVar("R", covariant=True)

#: Says why a part is left out, from keys of the question; None keeps it.
Reason = Callable[..., str | None]

#: Says for people what a part does, from keys of the question.
Teller = Callable[..., str]

#: The parameter by which a part asks for one stretch of a long series.
BLOCK = "block"


@dataclass(frozen=True)
class Block:
    """A stretch of a long series, from the epoch numbered `first` up to `last`."""

    first: int
    last: int


class Part(Generic[P, R]):
    """One thing to compute; call it as the function that it is.

    Attributes
    ----------
    name : str
        Of the function, by which other parts ask for its result.
    does : str
        What it does: the first line of the docstring.
    needs, uses : tuple of str
        Keys and parts without which it does not run, and those that it takes if they are there.
    gives : mapping of str to Variable
        The variables that it adds to an answer or section; empty for an intermediate part.
    unless : tuple of callable
        Each takes keys of the question by name and gives a reason for leaving the part out.
    chooses : bool
        Whether it chooses settings for an accuracy that was asked for.
    tells : callable or None
        Takes keys of the question by name and says what the part does with them.
    """

    def __init__(
        self,
        function: Callable[P, R],
        unless: tuple[Reason, ...],
        chooses: bool,
        tells: Teller | None = None,
    ) -> None:
        self.function, self.unless, self.chooses, self.tells = function, unless, chooses, tells
        self.gives = _schema_of(function)
        self.name = function.__name__
        self.does = _first_sentence(function)
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Compute."""
        return self.function(*args, **kwargs)

    def __reduce__(self) -> str:
        # A module holds the part under the name of its function: pickle and copy refer to it.
        return self.name

    def __repr__(self) -> str:
        return f"<part {self.title}: {self.does}>"

    @property
    def title(self) -> str:
        """Its name in plans."""
        return self.name.replace("_", "-")

    @cached_property
    def needs(self) -> tuple[str, ...]:
        """Parameters without a default."""
        return _parameters(self.function, inspect.Parameter.empty)

    @cached_property
    def uses(self) -> tuple[str, ...]:
        """Parameters that may be None."""
        return _parameters(self.function, None)

    def reason(self, keys: dict[str, Any]) -> str | None:
        """Why it is left out of the answer to a question with these keys; None if it is not."""
        for says in self.unless:
            why = says(**_wanted(says, keys))
            if why is not None:
                return why
        return None

    def told(self, keys: dict[str, Any]) -> str:
        """What it does for a question with these keys, as it stands in a plan."""
        return self.does if self.tells is None else self.tells(**_wanted(self.tells, keys))


@overload
def part(function: Callable[P, R], /) -> Part[P, R]: ...
@overload
def part(
    *,
    unless: Reason | tuple[Reason, ...] = ...,
    chooses: bool = ...,
    tells: Teller | None = ...,
) -> Callable[[Callable[P, R]], Part[P, R]]: ...
def part(
    function: Callable[P, R] | None = None,
    /,
    *,
    unless: Reason | tuple[Reason, ...] = (),
    chooses: bool = False,
    tells: Teller | None = None,
) -> Part[P, R] | Callable[[Callable[P, R]], Part[P, R]]:
    """Make a part of a typed function.

    Parameters
    ----------
    function : callable
        Its parameters name keys of the question and other parts.
    unless : callable or tuple of them
        Reasons for leaving it out, by keys of the question.
    chooses : bool
        Whether it chooses settings for an accuracy.
    tells : callable, optional
        Says for a plan what it does, by keys of the question; its docstring by default.
    """
    reasons = unless if isinstance(unless, tuple) else (unless,)

    if function is None:
        return lambda function: Part(function, reasons, chooses, tells)
    return Part(function, reasons, chooses, tells)


def _wanted(function: Callable[..., Any], keys: dict[str, Any]) -> dict[str, Any]:
    """The keys that a function takes."""
    return {name: keys[name] for name in _parameters(function, inspect.Parameter.empty)}


def _schema_of(function: Callable[..., Any]) -> Mapping[str, Variable]:
    """Variables of the class that a function returns by its annotation; none of another type."""
    returned = function.__annotations__.get("return")
    if isinstance(returned, str):
        returned = function.__globals__.get(returned)
    if isinstance(returned, type) and issubclass(returned, Variables):
        return returned.schema
    return {}


@cache
def _parameters(function: Callable[..., Any], default: object) -> tuple[str, ...]:
    parameters = inspect.signature(function).parameters.values()
    return tuple(entry.name for entry in parameters if entry.default is default)


def _first_sentence(function: Callable[..., Any]) -> str:
    """First line of a docstring, as it stands in a list."""
    line = (function.__doc__ or "").strip().split("\n")[0].rstrip(".")
    return line[:1].lower() + line[1:] if line[1:2].islower() else line
