"""Run the parts of a question in order, each timed, and lay out what they gave."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from earthspin._version import __version__, version
from earthspin.engine.imports import import_clock
from earthspin.engine.labels import CONVENTIONS
from earthspin.engine.neglected import Neglected
from earthspin.engine.plan import IMPORTS, SCENE, Plan, plan, remember_seconds
from earthspin.engine.question import NEGLECTED, Question
from earthspin.engine.variables import Variables
from earthspin.errors import UndefinedError

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Run:
    """A plan that has run, with the results of its parts and the keys of its question by name."""

    plan: Plan
    results: dict[str, Any]

    @property
    def provenance(self) -> dict[str, str]:
        """Sources of its numbers: versions, and checksums of files."""
        sources: dict[str, str] = {}
        for value in self.results.values():
            sources |= getattr(value, "provenance", {})
        return sources

    def numbers(self) -> xr.Dataset:
        """Lay out the answer, without the attributes of the whole."""
        names = self.plan.question.graph.answer
        return _together([self.results[name] for name in names if name in self.results])

    def answer(self) -> xr.Dataset:
        """Lay out the answer, with all that it carries."""
        import earthspin.engine.accessor  # noqa: F401 - registers ds.earthspin

        result = self.numbers()
        result.attrs = _attributes(self)
        remember_seconds(result.attrs[SCENE], self.plan.seconds)
        return result

    def section(self, name: str, effects: Sequence[str] = ()) -> xr.Dataset:
        """Lay out a section; the labels along `effect` are those of the answer, if it has any."""
        names = self.plan.question.graph.sections[name]
        parts = [self.results[part] for part in names if part in self.results]
        return _together([p.dataset(effects) if isinstance(p, Neglected) else p for p in parts])


def run(question: Question) -> xr.Dataset:
    """The answer to a question for one, its complete question among the attributes."""
    return _run_parts(plan(question)).answer()


def run_tree(question: Question, sections: str | Iterable[str] = "all") -> xr.DataTree:
    """The answer at the root, a node for each section, and the node ``plan``."""
    import xarray as xr

    done = _run_parts(plan(question, sections))
    answer = done.answer()
    effects = answer["effect"].values.tolist() if "effect" in answer.coords else ()
    nodes = {name: done.section(name, effects) for name in done.plan.sections}
    return xr.DataTree.from_dict({"/": answer, **nodes, "plan": plan_data(done.plan)})


class Rerun:
    """A question that is run repeatedly with something changed: the other parts run once.

    Parameters
    ----------
    question : Question
    changing : iterable of str
        Names of the keys that change; ``"block"`` for stretches of a long series.
    """

    def __init__(self, question: Question, changing: Iterable[str]) -> None:
        self.planned, self.changing = plan(question), {*changing}
        for part in self.planned.parts:
            if self.changing & {*part.needs, *part.uses}:
                self.changing.add(part.name)
        fixed = tuple(part for part in self.planned.parts if part.name not in self.changing)
        self.fixed = _run_parts(replace(self.planned, parts=fixed))

    @property
    def provenance(self) -> dict[str, str]:
        """Sources of the numbers of the parts that run once."""
        return self.fixed.provenance

    def __call__(self, question: Question | None = None, **given: object) -> Run:
        """Run the rest, of the question as it is or with keys changed."""
        planned = self.planned if question is None else plan(question)
        names = {part.name for part in planned.parts} - self.changing
        before = {name: value for name, value in self.fixed.results.items() if name in names}
        return _run_parts(planned, before | given)


def run_choosing(question: Question) -> list[Any]:
    """What the parts choose that choose settings for an accuracy; no other part runs.

    Parameters
    ----------
    question : Question
    """
    planned = plan(question)
    needed = {part.name for part in planned.parts if part.chooses}
    for part in reversed(planned.parts):
        if part.name in needed:
            needed |= {*part.needs, *part.uses}
    few = tuple(part for part in planned.parts if part.name in needed)
    results = _run_parts(replace(planned, parts=few)).results
    return [results[part.name] for part in few if part.chooses]


def _run_parts(planned: Plan, given: Mapping[str, Any] | None = None) -> Run:
    """Run what has not been given yet."""
    values = planned.question.keys() | dict(given or {})
    seconds: dict[str, float] = {}
    with import_clock() as imports:
        before = imports.seconds
        for part in planned.parts:
            if part.name in values:
                continue
            inputs = {name: values[name] for name in part.needs}
            inputs |= {name: values[name] for name in part.uses if name in values}
            begun = time.perf_counter() - imports.seconds
            with in_range(part.name):
                value = part(**inputs)
                values[part.name] = value.dataset() if isinstance(value, Variables) else value
            seconds[part.name] = time.perf_counter() - imports.seconds - begun
        seconds[IMPORTS] = imports.seconds - before
    return Run(replace(planned, seconds=seconds), values)


@contextmanager
def in_range(what: str) -> Iterator[None]:
    """Make numbers that overflow an error, never infinity with a warning; also a decorator.

    Parameters
    ----------
    what : str
        What is computed, for the message.

    Raises
    ------
    UndefinedError
        If they do.
    """
    import numpy as np

    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            yield
    except ArithmeticError as error:
        raise UndefinedError(
            f"numbers go beyond what can be computed ({what}: {error}); check their sizes"
        ) from error


# --- laying out ----------------------------------------------------------------------------------


def _together(pieces: list[xr.Dataset]) -> xr.Dataset:
    first, *others = pieces
    for other in others:
        first = first.merge(other, join="exact", combine_attrs="override")
    return first.copy()


def plan_data(planned: Plan) -> xr.Dataset:
    """The plan as data, with the seconds."""
    import xarray as xr

    rows = planned.rows
    columns = {
        "status": ([row.status for row in rows], {"long_name": "whether the part ran"}),
        "reason": (
            [row.reason for row in rows],
            {"long_name": "what the part does, or why it was left out"},
        ),
        "run_time": (
            [row.seconds or 0.0 for row in rows],
            {"units": "s", "long_name": "run time of the part"},
        ),
    }
    return xr.Dataset(
        {name: ("part", values, attrs) for name, (values, attrs) in columns.items()},
        {"part": ("part", [row.part for row in rows], {"long_name": "part of the plan"})},
    )


def _attributes(done: Run) -> dict[str, str]:
    """Global attributes: text alone, the same from run to run."""
    question = done.plan.question
    attributes = {
        "Conventions": CONVENTIONS,
        "title": question.title,
        "source": f"earthspin {__version__}",
        "history": f"earthspin {__version__}: compute = {question.word}",
        "references": "",
        "earthspin_version": __version__,
        "numpy_version": version("numpy"),
        "compute": question.word,
    }
    references: list[str] = []
    for name, value in question.keys().items():
        bodies = value if isinstance(value, tuple) else (value,)
        if bodies and all(hasattr(body, "reference") for body in bodies):
            references += [body.reference for body in bodies if body.reference]
        if bodies and all(hasattr(body, "changes") for body in bodies):
            attributes[name] = " ".join(body.name for body in bodies)
            changed = [body for body in bodies if getattr(body, "changes", "")]
            if changed:
                words = [
                    body.changes if body is value else f"{body.name}: {body.changes}"
                    for body in changed
                ]
                attributes[f"{name}_changes"] = "; ".join(words)
        elif isinstance(value, tuple) and value and all(isinstance(body, str) for body in value):
            attributes[name] = " ".join(value)
    attributes["references"] = "; ".join(dict.fromkeys(references))
    attributes |= done.provenance
    attributes[NEGLECTED] = done.results[NEGLECTED].largest
    attributes[SCENE] = scene_text(question)
    return attributes


def scene_text(question: Question) -> str:
    """Write a question with every number as the text of a scene file."""
    import tomli_w

    packed: list[str] = []
    text = tomli_w.dumps(_without_bytes(question.to_table(), packed))
    for number, data in enumerate(packed):
        text = text.replace(f'"{_PACKED.format(number)}"', f'"{data}"', 1)
    return text


#: Stands for an array's bytes while a scene is written, letter by letter, by the library.
_PACKED = "earthspin: packed array {}"


def _without_bytes(value: Any, packed: list[str]) -> Any:
    """A table whose packed arrays are set aside: their letters need no escaping."""
    if isinstance(value, list):
        return [_without_bytes(item, packed) for item in value]
    if not isinstance(value, dict):
        return value
    short = {
        name: _without_bytes(item, packed) for name, item in value.items() if name != "float64"
    }
    if "float64" in value:
        packed.append(value["float64"])
        short["float64"] = _PACKED.format(len(packed) - 1)
    return short
