"""Compute the result of a question as a Dataset or DataTree, and make the public functions."""

from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from earthspin._lazy import xr
from earthspin.engine.ensemble import Ensemble
from earthspin.engine.members import MEMBER, Members
from earthspin.engine.question import ALL, NEGLECTED, Key, Question, define_parts, keys_of
from earthspin.engine.run import Run
from earthspin.errors import SceneError, checked
from earthspin.progress import progress

# --- answers --------------------------------------------------------------------------------------

#: Default number of members of a sample.
MEMBERS = 1000
#: Quantiles at the ends of the central 95 % interval.
_ENDS = (0.025, 0.975)
_NO_ERROR = "no number of this answer has an error that can be sampled; leave it out"


@progress("answer")
def answer(question: Question) -> xr.Dataset:
    """Compute the result of a question (a computation with inputs), as a Dataset.

    Parameters
    ----------
    question : Question

    Returns
    -------
    Dataset
        With dimension `member` if the question has members; with sampled errors if
        ``uncertainty = "sample"``.

    Raises
    ------
    EarthspinError
        If the question cannot be answered; the message is one line.
    """
    if question.members is not None:
        return Ensemble(question, in_memory=True).hold()
    result = Run(question).answer()
    return _with_sample(question, result) if question.uncertainty == "sample" else result


@progress("answer with sections")
def answer_tree(question: Question, sections: str | Iterable[str] = ALL) -> xr.DataTree:
    """Compute the result of a question and the requested sections, as a DataTree.

    An ensemble has only the sections `plan` and `neglected`.

    Parameters
    ----------
    question : Question
    sections : str or iterable of str
        Names, or ``"all"``.

    Raises
    ------
    EarthspinError
        If the question cannot be answered, or another section of an ensemble is requested.
    """
    if question.members is not None:
        named = [sections] if isinstance(sections, str) else [*sections]
        if not {*named} <= {ALL, NEGLECTED}:
            problem = f"an ensemble has only the section '{NEGLECTED}'; request that or none"
            raise SceneError("sections", sections, problem)
        work = Ensemble(question, in_memory=True)
        nodes = {"/": work.hold(), "plan": work.nominal_run.plan().dataset()}
        if named:
            nodes[NEGLECTED] = work.nominal_run.tree(NEGLECTED).earthspin.section(NEGLECTED)
        return xr.DataTree.from_dict(nodes)
    tree = Run(question).tree(sections)
    if question.uncertainty == "sample":
        tree.dataset = _with_sample(question, tree.to_dataset())
    return tree


def _with_sample(question: Question, answer: xr.Dataset) -> xr.Dataset:
    """Add errors to a result, estimated by repeating the computation with random inputs.

    Parameters
    ----------
    question : Question
        With ``uncertainty = "sample"``.
    answer : Dataset

    Returns
    -------
    Dataset
        The answer with a variable ``<name>_error_sampled`` for each number with an error, its own
        or one that it shares with other numbers: half the width of the central 95 % interval of
        the members. Its attributes hold the largest difference from the linear error if that has
        the same unit, and the largest difference between the median of the sample and the value.

    Raises
    ------
    EarthspinError
        If the members cannot be computed, or no number of the answer has an error.
    """
    linear_errors = {
        str(name): error
        for name, array in answer.data_vars.items()
        if array.dtype.kind == "f"
        and (error := _linear_error(answer, str(name))) is not None
        # the error of a vector is an angle or a length, not that of a component
        and not {*array.dims}.difference(error.dims) & {"component", "quaternion"}
    }
    if not linear_errors:
        raise question.error("uncertainty", "sample", _NO_ERROR)
    count = MEMBERS if question.n is None else question.n
    members = Members(n=count, published=True)
    drawn = question.replace(uncertainty=None, n=None, members=members)
    sample = Ensemble(drawn, in_memory=True).hold()
    sampled: dict[str, Any] = {}
    for name, linear in linear_errors.items():
        number, values = answer[name], sample[name]
        units, width, shift = number.attrs.get("units", "1"), np.zeros(number.shape), 0.0
        if MEMBER in values.dims:
            low, middle, high = np.quantile(values.values, (_ENDS[0], 0.5, _ENDS[1]), axis=0)
            width = (high - low) / 2
            shift = float(np.max(np.abs(middle - number.values)))
        meaning = f"95 % half-width of the {number.attrs['long_name']}"
        attrs = {
            "long_name": f"{meaning} from {count} members",
            "units": units,
            "members": count,
            "middle_of_the_sample": f"{shift:.3g} {units} at most from {name}",
        }
        if linear.attrs.get("units") == units and linear.dims == number.dims:
            size = float(np.max(np.abs(linear.values - width), initial=0.0))
            attrs["difference_from_linear"] = f"{size:.3g} {units} at most from {linear.name}"
        sampled[f"{name}_error_sampled"] = (number.dims, width, attrs)
    inputs = ", ".join(str(c.attrs["input"]) for c in sample.coords.values() if "input" in c.attrs)
    return answer.assign(sampled).assign_attrs(sampled=f"{count} members in {inputs}")


def _linear_error(answer: xr.Dataset, name: str) -> xr.DataArray | None:
    """Return the error of a variable due to inputs, or else its total or shared error, or None."""
    shared = str(answer[name].attrs.get("ancillary_variables", "")).split()
    names = (f"{name}_error_input", f"{name}_error", *shared)
    return next((answer[error] for error in names if error in answer), None)


# --- the public function of a question ------------------------------------------------------------

#: Arguments of a call that give the two ends of a span, with their meaning.
ENDS = {
    "start": "First time; plain dates mean TDB, others are converted.",
    "stop": "Last time, which is included if the step meets it.",
}


def public_call(question: type[Question], **parts: Any) -> Callable[..., xr.Dataset]:
    """Make the public function for a question class, from the functions that compute the answer.

    Parameters
    ----------
    question : type
    **parts
        The parts for its answer and sections; see `define_parts`.
    """
    define_parts(question, **parts)
    signature = signature_of(question)

    def call(*args: Any, **kwargs: Any) -> xr.Dataset:
        values = signature.bind(*args, **kwargs).arguments
        ends = {end: values.pop(end, None) for end in ENDS if end in question.positional}
        missing = [end for end, value in ends.items() if value is None]
        if len(missing) == 1:
            raise SceneError(missing[0], None, "give both start and stop, or times")
        if ends and not missing:
            values["span"] = tuple(ends.values())
        return answer(question(**values))

    call.__name__ = call.__qualname__ = question.call
    call.__doc__ = docstring_of(question)
    call.__module__ = question.__module__
    call.__signature__ = signature  # type: ignore[attr-defined]
    call.question = question  # type: ignore[attr-defined]
    return checked(call)


def arguments_of(question: type[Question]) -> dict[str, Key | None]:
    """Arguments of a question's public function, by name: the `Key`, or None for start and stop.

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
    """Convert a default value to the form that a user would type: bodies are replaced by names."""
    if isinstance(value, tuple):
        return tuple(_as_written(item) for item in value)
    return getattr(value, "name", value)


def docstring_of(question: type[Question]) -> str:
    """Make the docstring of a question's public function from class docstring and inputs."""
    text, *sections = re.split(r"\n\n(\w+)\n-{4,}\n", inspect.cleandoc(question.__doc__ or ""))
    of_class = dict(zip(sections[::2], sections[1::2], strict=True))
    arguments, parameters = arguments_of(question), list[str]()
    for name, entry in arguments.items():
        if entry is None:
            parameters += [f"{name} : date", f"    {ENDS[name]}"]
            continue
        optional = "" if entry.required else ", optional"
        default = f" Default: {entry.default_words}." if entry.default_words else ""
        parameters.append(f"{name} : {entry.kind.words}{optional}")
        sentence = f"{entry.doc[:1].upper()}{entry.doc[1:]}.{default}"
        parameters += textwrap.wrap(sentence, 88, initial_indent="    ", subsequent_indent="    ")
    raises = [
        f"{error}\n    {case}" for error, (key, case) in _RAISES.items() if key in ("", *arguments)
    ]
    if own := of_class.pop("Raises", ""):
        raises.append(own.rstrip())
    notes = "\n".join(SOURCE_TEXT) if _NUMBERED.search(text + "".join(of_class.values())) else ""
    examples = of_class.pop("Examples", "")
    ordered = {
        "Parameters": "\n".join(parameters), **of_class, "Raises": "\n".join(raises),
        "Notes": notes, "Examples": examples,
    }  # fmt: skip
    blocks = (
        f"{title}\n{'-' * len(title)}\n{body.rstrip()}" for title, body in ordered.items() if body
    )
    return "\n\n".join([text, *blocks, ""])


#: Errors that several questions raise: the key that a question must have, if any, and the case.
_RAISES = {
    "SceneError": ("", "If a key is unknown or missing, or its value is not allowed."),
    "UnitsError": ("", "If a unit has the wrong dimension."),
    "BodyError": ("body", "If a body lacks a needed number, or its numbers contradict each other."),
    "KernelError": ("ephemeris", "If a kernel cannot be read, or lacks one of the bodies."),
    "CoverageError": ("ephemeris", "If the kernel does not cover the dates."),
}
#: Note of docstrings that cite an equation of the source text by its number.
SOURCE_TEXT = (
    "Numbers such as I.8.7 are equations and sections of the source text, Appendix I,",
    '"Rigid Body Dynamics", sections I.1 to I.9; docs/equations.md maps each to its function.',
)
_NUMBERED = re.compile(r"\bI\.\d")
