"""Compute the result of a question as a Dataset or DataTree, and make the public functions."""

from __future__ import annotations

import inspect
import re
import textwrap
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from earthspin._lazy import xr
from earthspin.engine.ensemble import Ensemble
from earthspin.engine.origin import with_labels
from earthspin.engine.question import ALL, Graph, Key, Question, define_parts, hint, keys_of
from earthspin.engine.run import Run
from earthspin.engine.variables import Neglected, Variable
from earthspin.errors import SceneError, checked
from earthspin.progress import progress

# --- answers --------------------------------------------------------------------------------------


@progress("answer")
def answer(question: Question) -> xr.Dataset:
    """Compute the result of a question (a computation with inputs), as a Dataset.

    Parameters
    ----------
    question : Question

    Returns
    -------
    Dataset
        With dimension `member` if the question has members.

    Raises
    ------
    EarthspinError
        If the question cannot be answered; the message is one line.
    """
    if question.members is not None:
        return Ensemble(question, in_memory=True).hold()
    return with_labels(Run(question).answer())


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
        named, name = [sections] if isinstance(sections, str) else [*sections], Neglected.PART
        if not {*named} <= {ALL, name}:
            problem = f"an ensemble has only the section '{name}'; request that or none"
            raise SceneError("sections", sections, problem)
        begun, work = time.perf_counter(), Ensemble(question, in_memory=True)
        nodes = {"/": work.hold(), "plan": work.nominal_run.plan().dataset()}
        for duration in ("wall_time", "computation_time"):  # of all members
            nodes["plan"][duration][...] = time.perf_counter() - begun
        if named:
            nodes[name] = work.nominal_run.tree(name).earthspin.section(name)
        return xr.DataTree.from_dict(nodes)
    tree = Run(question).tree(sections)
    with_labels(tree)
    return tree


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
            others = [name for name in ("times", "file") if name in signature.parameters]
            raise SceneError(missing[0], None, f"give both start and stop, or {others[0]}=...")
        if ends and not missing:
            if "span" in values:
                raise SceneError("span", values["span"], "give either start and stop, or span")
            values["span"] = tuple(ends.values())
        return answer(question(**values))

    call.__name__ = call.__qualname__ = question.call
    call.__doc__ = docstring_of(question)
    call.__module__ = question.__module__
    call.__signature__ = signature  # type: ignore[attr-defined]
    call.question = question  # type: ignore[attr-defined]
    return checked(call, hint)


def arguments_of(question: type[Question]) -> dict[str, Key | None]:
    """Arguments of a question's public function, by name: the `Key`, or None for start and stop.

    The arguments `start` and `stop` are not keys; they map to None.
    """
    keys = {name: entry for name, entry in keys_of(question).items() if name != "title"}
    ends = "step" in question.positional  # without, a span is one word or two
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
        "Parameters": "\n".join(parameters), "Returns": "\n".join(_returns(question.graph)),
        **of_class, "Raises": "\n".join(raises), "Notes": notes, "Examples": examples,
    }  # fmt: skip
    blocks = (
        f"{title}\n{'-' * len(title)}\n{body.rstrip()}" for title, body in ordered.items() if body
    )
    return "\n\n".join([text, *blocks, ""])


def _returns(graph: Graph) -> list[str]:
    """Lines of "Returns": variables of the answer, and sections with the names of their own."""
    lines = ["Dataset", f"    {_VARIABLES}", ""]
    for name, variable, shares in _described(graph, graph.answer):
        place = "; ".join(filter(None, (variable.units.strip("1"), ", ".join(variable.dims))))
        more = "; shares of the error: " + ", ".join(shares) if shares else ""
        lines += _entry(f"{name} ({place})" if place else name, variable.long_name + more)
    lines += ["", "    Sections, from `earthspin.run_tree`:", ""]
    for section, parts in graph.sections.items():
        names = ", ".join(name for name, _, _ in _described(graph, parts))
        does = graph.parts[parts[0]].summary
        lines += _entry(f"`{section}`", f"{does} ({names})" if names else does)
    return lines


#: Explains the marks of the lines below.
_VARIABLES = (
    "Variables, with units and dimensions; ± has ``<name>_error``, a 95 % half-width or a bound:"
)


def _described(graph: Graph, parts: Iterable[str]) -> Iterator[tuple[str, Variable, list[str]]]:
    """Yield each variable that parts declare: its name, marked ± if it has an error, and shares.

    Shares are the suffixes of further errors, such as `_error_input`.
    """
    declared = {name: entry for part in parts for name, entry in graph.parts[part].gives.items()}
    for name, entry in declared.items():
        before, error, _ = name.partition("_error")
        if not (error and before in declared):
            errors = [other for other in declared if other.startswith(f"{name}_error")]
            shares = [f"`{other.removeprefix(name)}`" for other in errors[1:]]
            yield f"`{name}`\N{NO-BREAK SPACE}±" if errors else f"`{name}`", entry, shares


def _entry(name: str, meaning: str) -> list[str]:
    """Lines of one entry of a list in a docstring."""
    text = f"- {name}: {meaning}"
    return textwrap.wrap(text, 96, initial_indent="    ", subsequent_indent="      ")


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
