"""Generate the public Python function of a question from its class."""

from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from earthspin.engine.answering import answer
from earthspin.engine.question import Key, Question, keys_of
from earthspin.errors import SceneError

if TYPE_CHECKING:
    import xarray as xr

#: Arguments of a call that give the two ends of a span.
ENDS = ("start", "stop")


def public_call(question: type[Question]) -> Callable[..., xr.Dataset]:
    """Make the public Python function that answers a question of the given class.

    Parameters
    ----------
    question : type
    """
    signature = signature_of(question)

    def call(*args: Any, **kwargs: Any) -> xr.Dataset:
        try:
            values = dict(signature.bind(*args, **kwargs).arguments)
        except TypeError as error:
            raise TypeError(f"{question.call}() {error}") from None
        return answer(question(**_with_span(question, values)))

    call.__name__ = call.__qualname__ = question.call
    call.__doc__ = docstring_of(question)
    call.__module__ = question.__module__
    call.__signature__ = signature  # type: ignore[attr-defined]
    call.question = question  # type: ignore[attr-defined]
    return call


def _with_span(question: type[Question], values: dict[str, Any]) -> dict[str, Any]:
    """Replace the arguments `start` and `stop` by `span`; raise an error if one is missing."""
    if "start" not in question.positional:
        return values
    ends = {end: values.pop(end, None) for end in ENDS}
    missing = [end for end, value in ends.items() if value is None]
    if len(missing) == len(ENDS):
        return values
    if missing:
        raise SceneError(missing[0], None, "give both start and stop, or times")
    return values | {"span": tuple(ends.values())}


def arguments_of(question: type[Question]) -> dict[str, Key | None]:
    """Argument names of the public function of a question, each with its `Key` or None.

    The arguments `start` and `stop` are not keys; they map to None.
    """
    keys = {name: entry for name, entry in keys_of(question).items() if name != "title"}
    ends = "start" in question.positional
    rest = [n for n in keys if n not in question.positional and not (ends and n == "span")]
    return {name: keys.get(name) for name in (*question.positional, *rest)}


def signature_of(question: type[Question]) -> inspect.Signature:
    """Signature (argument names, types and defaults) of the public function of a question."""
    parameters = []
    for name, entry in arguments_of(question).items():
        free = name in question.positional
        place = inspect.Parameter.POSITIONAL_OR_KEYWORD if free else inspect.Parameter.KEYWORD_ONLY
        default: Any = None
        if entry is not None:
            default = inspect.Parameter.empty if entry.required else _as_written(entry.shown)
        parameters.append(inspect.Parameter(name, place, default=default))
    return inspect.Signature(parameters)


def _as_written(value: Any) -> Any:
    """Convert a default value to the form that a user would type, with bodies by name."""
    if isinstance(value, tuple):
        return tuple(_as_written(item) for item in value)
    return getattr(value, "name", value)


def docstring_of(question: type[Question]) -> str:
    """Make the docstring of a question's public function from its class and its arguments."""
    head, _, rest = inspect.cleandoc(question.__doc__ or "").partition("\n")
    lines = [head, "", "Parameters", "----------"]
    for name, entry in arguments_of(question).items():
        if entry is None:
            lines += [f"{name} : date", f"    {_END[name]}"]
            continue
        optional = "" if entry.required else ", optional"
        default = f" Default: {entry.default_words}." if entry.default_words else ""
        lines.append(f"{name} : {entry.kind.words}{optional}")
        sentence = f"{entry.doc[:1].upper()}{entry.doc[1:]}.{default}"
        lines += textwrap.wrap(sentence, 88, initial_indent="    ", subsequent_indent="    ")
    notes = ["", "Notes", "-----", *SOURCE_TEXT] if _NUMBERED.search(head + rest) else []
    before, heading, after = rest.rstrip().partition("\nExamples\n")
    return "\n".join([*lines, before.rstrip(), *notes, f"{heading}{after}", ""])


#: Note of docstrings that cite an equation of the source text by its number.
SOURCE_TEXT = (
    "Numbers such as I.8.7 are equations and sections of the source text, Appendix I,",
    '"Rigid Body Dynamics", sections I.1 to I.9; docs/equations.md maps each to its function.',
)
_NUMBERED = re.compile(r"\bI\.\d")


_END = {
    "start": "First time; plain dates mean TDB, others are converted.",
    "stop": "Last time, which is included if the step meets it.",
}
