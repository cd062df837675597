"""Parts: typed functions, each of which computes one piece of the answer to a question.

The inputs of a part follow from its signature: each parameter is a key of the question or the
result of another part, by name. A parameter whose default is None is optional. A part with only
optional parameters needs at least one of them.
"""

from __future__ import annotations

import inspect
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from functools import cache, cached_property, partial, update_wrapper
from threading import Lock
from typing import Any, Generic, NamedTuple, ParamSpec, TypeVar, overload

from earthspin.engine.variables import Variables

P = ParamSpec("P")
R = TypeVar("R", covariant=True)

#: Returns why a part is left out, from keys of the question; None if the part runs.
Reason = Callable[..., str | None]

#: Returns one sentence on what a part does, from keys of the question.
Describer = Callable[..., str]

#: Returns what the result of a part depends on, from the inputs of the part; None if the result
#: must be computed anew.
SameFor = Callable[..., Hashable]

#: Name of the parameter of a part that computes one block of a long series.
BLOCK = "block"
#: Number of results of a part that are stored for later calls.
STORED = 4


class Block(NamedTuple):
    """One block of a long series: the epochs with indices from `first` to `last` - 1."""

    first: int
    last: int


class Part(Generic[P, R]):
    """A typed function that computes one piece of an answer; it can be called as usual.

    Attributes
    ----------
    name : str
        Name of the function; other parts take the result as a parameter of this name.
    does : str
        Description of the part: the first line of the docstring.
    needs, uses : tuple of str
        Names of the required and of the optional parameters.
    gives : mapping of str to Variable
        The variables that the part adds to an answer or section; empty for an intermediate part.
    fields : frozenset of str
        Names of the declared variables and labels.
    unless : tuple of callable
        Each takes keys of the question by name and returns a reason for leaving the part out.
    describe : callable or None
        Takes keys of the question by name and returns a description of the part.
    same_for : callable or None
        Takes the inputs of the part and returns a value; a result is reused if the value is equal.
    loads : tuple of str
        Modules that the function, or what it calls, imports when it runs, if this takes long.
    """

    def __init__(
        self,
        function: Callable[P, R],
        unless: Reason | tuple[Reason, ...] = (),
        describe: Describer | None = None,
        same_for: SameFor | None = None,
        loads: tuple[str, ...] = (),
    ) -> None:
        self.function, self.loads = function, loads
        self.unless = unless if isinstance(unless, tuple) else (unless,)
        self.describe, self.same_for = describe, same_for
        self._stored: OrderedDict[Hashable, R] = OrderedDict()
        self._lock = Lock()
        returned = _returned(function)
        self.gives, self.fields = returned.schema, frozenset(returned.fields)
        self.name = function.__name__
        line = (function.__doc__ or "").strip().split("\n")[0].rstrip(".")
        self.does = line[:1].lower() + line[1:] if line[1:2].islower() else line
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Call the wrapped function."""
        return self.function(*args, **kwargs)

    def stored_or_computed(self, inputs: Mapping[str, Any]) -> tuple[R, bool]:
        """Return the result for given inputs, and whether an earlier result was reused."""
        key = None if self.same_for is None else self.same_for(**inputs)
        with self._lock:
            if key is not None and key in self._stored:
                return self._stored[key], True
        result = self.function(**inputs)  # type: ignore[call-arg]
        if key is not None:
            with self._lock:
                self._stored[key] = result
                if len(self._stored) > STORED:
                    self._stored.popitem(last=False)
        return result, False

    def __reduce__(self) -> str:
        # A module holds the part under the name of its function, so pickle stores only the name.
        return self.name

    def __repr__(self) -> str:
        return f"<part {self.title}: {self.does}>"

    @property
    def title(self) -> str:
        """Name of this part (function) in the table of a plan."""
        return self.name.replace("_", "-")

    @cached_property
    def needs(self) -> tuple[str, ...]:
        """Names of the inputs that this part (function) requires: parameters without default."""
        return _parameters(self.function, inspect.Parameter.empty)

    @cached_property
    def uses(self) -> tuple[str, ...]:
        """Names of the optional inputs of this part (function): parameters with default None."""
        return _parameters(self.function, None)

    def reason(self, keys: dict[str, Any]) -> str | None:
        """Return the reason (text) to omit this part for given inputs, else None."""
        reasons = (condition(**_arguments(condition, keys)) for condition in self.unless)
        return next((why for why in reasons if why is not None), None)

    def description(self, keys: dict[str, Any]) -> str:
        """Describe what this part does for the given inputs, for the table of a plan."""
        describe = self.describe
        return self.does if describe is None else describe(**_arguments(describe, keys))


@overload
def part(function: Callable[P, R], /) -> Part[P, R]: ...
@overload
def part(**options: Any) -> Callable[[Callable[P, R]], Part[P, R]]: ...
def part(function: Callable[P, R] | None = None, /, **options: Any) -> Any:
    """Make a `Part` from a typed function; a decorator.

    Parameters
    ----------
    function : callable
        Its parameters are names of keys of the question and of other parts.
    unless : callable or tuple of callable
        Functions of keys of the question that return a reason for leaving the part out, or None.
    describe : callable, optional
        Function of keys of the question that describes the part in a plan; the first line of the
        docstring by default.
    same_for : callable, optional
        Function of the inputs of the part. The result is stored, and reused in later runs for which
        the function returns an equal value; None means that the result is not stored.
    loads : tuple of str
        Modules that the function, or what it calls, imports when it runs, if this takes long. A run
        imports them before its first part, so that the run time of the part is that of its work.
    """
    return partial(Part, **options) if function is None else Part(function, **options)


def _arguments(function: Callable[..., Any], keys: dict[str, Any]) -> dict[str, Any]:
    """Select, from the inputs of a question, those that a function takes as arguments."""
    return {name: keys[name] for name in _parameters(function, inspect.Parameter.empty)}


def _returned(function: Callable[..., Any]) -> type[Variables]:
    """Class of variables that a function returns; the base class, which has none, by default."""
    returned = function.__annotations__.get("return")
    if isinstance(returned, str):
        returned = function.__globals__.get(returned)
    if isinstance(returned, type) and issubclass(returned, Variables):
        return returned
    return Variables


@cache
def _parameters(function: Callable[..., Any], default: object) -> tuple[str, ...]:
    parameters = inspect.signature(function).parameters.values()
    return tuple(entry.name for entry in parameters if entry.default is default)
