"""Run the parts of a question in order, each timed, and lay out what they gave."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping
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
class Ran:
    """A plan that has run, and what its parts gave by name."""

    plan: Plan
    given: dict[str, Any]

    @property
    def provenance(self) -> dict[str, str]:
        """What its parts say of where their numbers come from."""
        return _provenance(self.given)

    def answer(self) -> xr.Dataset:
        """Lay out the answer, with all that it carries."""
        return _answer(self)


def run(question: Question) -> xr.Dataset:
    """The answer to a question for one, its complete question among the attributes."""
    return _run_parts(plan(question)).answer()


def run_tree(question: Question, sections: str | Iterable[str] = "all") -> xr.DataTree:
    """The answer at the root, a node for each section, and the node ``plan``."""
    import xarray as xr

    ran = _run_parts(plan(question, sections))
    answer = ran.answer()
    nodes = {"/": answer}
    for name in ran.plan.sections:
        nodes[name] = _section(ran, name, answer)
    return xr.DataTree.from_dict(nodes | {"plan": plan_data(ran.plan)})


class Again:
    """A question that is asked again and again with something changed: the rest runs once.

    Parameters
    ----------
    question : Question
    changing : iterable of str
        Names of the keys that change; ``"block"`` for stretches of a long series.
    """

    def __init__(self, question: Question, changing: Iterable[str]) -> None:
        planned, moving = plan(question), {*changing}
        for one in planned.parts:
            if moving & {*one.needs, *one.uses}:
                moving.add(one.name)
        still = tuple(one for one in planned.parts if one.name not in moving)
        self.planned, self.moving = planned, moving
        self.still = _run_parts(replace(planned, parts=still)).given

    @property
    def provenance(self) -> dict[str, str]:
        """What the parts that run once say of where their numbers come from."""
        return _provenance(self.still)

    def __call__(self, question: Question | None = None, **given: object) -> Ran:
        """Run the rest, of the question as it is or with keys changed."""
        planned = self.planned if question is None else plan(question)
        kept = {part.name for part in planned.parts} - self.moving
        before = {name: value for name, value in self.still.items() if name in kept}
        return _run_parts(planned, before | given)

    def answer(self, question: Question | None = None, **given: object) -> xr.Dataset:
        """Answer it, with all that an answer carries."""
        return self(question, **given).answer()

    def numbers(self, question: Question | None = None, **given: object) -> xr.Dataset:
        """Answer it, without the attributes of the whole."""
        return _numbers(self(question, **given))


def run_choosing(question: Question) -> list[Any]:
    """What the parts choose that choose settings for an accuracy; no other part runs.

    Parameters
    ----------
    question : Question
    """
    planned = plan(question)
    needed = {one.name for one in planned.parts if one.chooses}
    for one in reversed(planned.parts):
        if one.name in needed:
            needed |= {*one.needs, *one.uses}
    few = replace(planned, parts=tuple(one for one in planned.parts if one.name in needed))
    given = _run_parts(few).given
    return [given[one.name] for one in few.parts if one.chooses]


def _run_parts(planned: Plan, given: Mapping[str, Any] | None = None) -> Ran:
    """Run what has not been given yet."""
    values = planned.question.keys() | dict(given or {})
    seconds: dict[str, float] = {}
    with import_clock() as imports:
        before = imports.seconds
        for one in planned.parts:
            if one.name in values:
                continue
            inputs = {name: values[name] for name in one.needs}
            inputs |= {name: values[name] for name in one.uses if name in values}
            begun = time.perf_counter() - imports.seconds
            with in_range(one.name):
                value = one(**inputs)
                values[one.name] = value.dataset() if isinstance(value, Variables) else value
            seconds[one.name] = time.perf_counter() - imports.seconds - begun
        seconds[IMPORTS] = imports.seconds - before
    return Ran(replace(planned, seconds=seconds), values)


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


def _answer(ran: Ran) -> xr.Dataset:
    """The parts of the answer as one Dataset, with its attributes."""
    import earthspin.engine.accessor  # noqa: F401 - registers ds.earthspin

    result = _numbers(ran)
    result.attrs = _attributes(ran)
    remember_seconds(result.attrs[SCENE], ran.plan.seconds)
    return result


def _numbers(ran: Ran) -> xr.Dataset:
    """The parts of the answer as one Dataset."""
    graph = ran.plan.question.graph
    return _together([ran.given[name] for name in graph.answer if name in ran.given])


def _provenance(given: Mapping[str, Any]) -> dict[str, str]:
    told: dict[str, str] = {}
    for value in given.values():
        told |= getattr(value, "provenance", {})
    return told


def _section(ran: Ran, name: str, answer: xr.Dataset) -> xr.Dataset:
    """The parts of a section as one Dataset; effects that the answer names keep their labels."""
    parts = [ran.given[one] for one in ran.plan.question.graph.sections[name] if one in ran.given]
    labels = answer["effect"].values.tolist() if "effect" in answer.coords else ()
    return _together([p.dataset(labels) if isinstance(p, Neglected) else p for p in parts])


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


def _attributes(ran: Ran) -> dict[str, str]:
    """Global attributes: text alone, the same from run to run."""
    question = ran.plan.question
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
        several = value if isinstance(value, tuple) else (value,)
        if several and all(hasattr(one, "reference") for one in several):
            references += [one.reference for one in several if one.reference]
        if several and all(hasattr(one, "changes") for one in several):
            attributes[name] = " ".join(one.name for one in several)
            changed = [one for one in several if getattr(one, "changes", "")]
            if changed:
                words = [
                    one.changes if one is value else f"{one.name}: {one.changes}" for one in changed
                ]
                attributes[f"{name}_changes"] = "; ".join(words)
        elif isinstance(value, tuple) and value and all(isinstance(one, str) for one in value):
            attributes[name] = " ".join(value)
    attributes["references"] = "; ".join(dict.fromkeys(references))
    attributes |= ran.provenance
    attributes[NEGLECTED] = ran.given[NEGLECTED].largest
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
        return [_without_bytes(one, packed) for one in value]
    if not isinstance(value, dict):
        return value
    short = {name: _without_bytes(one, packed) for name, one in value.items() if name != "float64"}
    if "float64" in value:
        packed.append(value["float64"])
        short["float64"] = _PACKED.format(len(packed) - 1)
    return short
