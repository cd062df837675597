"""Run the parts (functions) of a plan in order, and merge their results into an answer."""

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
from earthspin.engine.plan import IMPORTS, SCENE, Plan, plan_parts, remember_run
from earthspin.engine.question import NEGLECTED, Question
from earthspin.engine.variables import Variables
from earthspin.errors import UndefinedError

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Run:
    """A completed run: its plan, and the results of all parts (functions) by name."""

    plan: Plan
    results: dict[str, Any]

    @property
    def provenance(self) -> dict[str, str]:
        """Software versions, and checksums of data files, behind all results of the run."""
        return _sources(self.results.values())

    def provenance_of(self, parts: Iterable[str]) -> dict[str, str]:
        """Software versions, and checksums of data files, behind the results of some parts.

        Sources of the inputs of these parts and of the keys of the question are included.
        """
        others = {part.name for part in self.plan.parts} - behind(self.plan, parts)
        return _sources(value for name, value in self.results.items() if name not in others)

    def numbers(self) -> xr.Dataset:
        """Merge the results of all parts of the answer into a Dataset without attributes."""
        return self._merged(self.plan.question.graph.answer)

    def answer(self) -> xr.Dataset:
        """Return the answer as a Dataset, with title, references and other attributes."""
        import earthspin.engine.accessor  # noqa: F401 - registers ds.earthspin

        result = self.numbers()
        result.attrs = _attributes(self)
        self.results[NEGLECTED].mark(result, self.plan.question.headline)
        remember_run(result.attrs[SCENE], self.plan)
        return result

    def tree(self) -> xr.DataTree:
        """Return a DataTree: the answer at the root, its sections, and the plan of the run."""
        import xarray as xr

        answer = self.answer()
        effects = answer["effect"].values.tolist() if "effect" in answer.coords else ()
        sections = self.plan.question.graph.sections
        nodes = {name: self._merged(sections[name], effects) for name in self.plan.sections}
        for name, node in nodes.items():
            sources = self.provenance_of(sections[name])
            node.attrs |= {key: word for key, word in sources.items() if key not in answer.attrs}
        return xr.DataTree.from_dict({"/": answer, **nodes, "plan": plan_data(self.plan)})

    def _merged(self, parts: Iterable[str], effects: Sequence[str] = ()) -> xr.Dataset:
        """Merge the results of some parts into one Dataset."""
        results = [self.results[name] for name in parts if name in self.results]
        first, *others = (
            result.dataset(effects) if isinstance(result, Neglected) else result
            for result in results
        )
        for other in others:
            first = first.merge(other, join="exact", combine_attrs="override")
        return first.copy()


def _sources(values: Iterable[Any]) -> dict[str, str]:
    """Collect software versions, and checksums of data files, from results or inputs."""
    sources: dict[str, str] = {}
    for value in values:
        sources |= getattr(value, "provenance", {})
    return sources


def behind(plan: Plan, parts: Iterable[str]) -> set[str]:
    """Names of the given parts, and of all parts and inputs on which they depend."""
    names = {*parts}
    for part in reversed(plan.parts):
        if part.name in names:
            names |= {*part.needs, *part.uses}
    return names


class Rerun:
    """Run a question repeatedly with some inputs changed; recompute only what depends on them.

    Parameters
    ----------
    question : Question
    changing : iterable of str
        Names of the keys that change; ``"block"`` for blocks of a long series.
    """

    def __init__(self, question: Question, changing: Iterable[str]) -> None:
        self.plan, self.changing = plan_parts(question), {*changing}
        for part in self.plan.parts:
            if self.changing & {*part.needs, *part.uses}:
                self.changing.add(part.name)
        fixed = tuple(part for part in self.plan.parts if part.name not in self.changing)
        self.fixed = run_parts(replace(self.plan, parts=fixed))

    def __call__(self, question: Question | None = None, **values: object) -> Run:
        """Run the parts that depend on the changed inputs, and reuse all other results.

        The question may differ from the original one in these keys.
        """
        plan = self.plan if question is None else plan_parts(question)
        names = {part.name for part in plan.parts} - self.changing
        before = {name: value for name, value in self.fixed.results.items() if name in names}
        return run_parts(plan, before | values)


def run_parts(plan: Plan, before: Mapping[str, Any] | None = None) -> Run:
    """Run the parts (functions) of a plan in order, except those with a result in `before`."""
    values = plan.question.keys() | dict(before or {})
    seconds: dict[str, float] = {}
    reused: set[str] = set()
    with import_clock() as imports:
        imported = imports.seconds
        for part in plan.parts:
            if part.name in values:
                continue
            inputs = {name: values[name] for name in part.needs}
            inputs |= {name: values[name] for name in part.uses if name in values}
            begun = time.perf_counter() - imports.seconds
            with in_range(part.name):
                value, is_stored = part.stored_or_computed(inputs)
                if isinstance(value, Neglected):
                    value = value.also(plan.question.unused)
                values[part.name] = value.dataset() if isinstance(value, Variables) else value
            seconds[part.name] = time.perf_counter() - imports.seconds - begun
            if is_stored:
                reused.add(part.name)
        seconds[IMPORTS] = imports.seconds - imported
    return Run(replace(plan, seconds=seconds, reused=frozenset(reused)), values)


@contextmanager
def in_range(what: str) -> Iterator[None]:
    """Raise an error if numbers overflow in a block of code; context manager and decorator.

    Parameters
    ----------
    what : str
        Name of the computed quantity or part, for the message.

    Raises
    ------
    UndefinedError
        If a number overflows or is undefined.
    """
    import numpy as np

    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            yield
    except ArithmeticError as error:
        raise UndefinedError(
            f"numbers are too large or too small to compute with ({what}: {error}); check the input"
        ) from error


# --- attributes ----------------------------------------------------------------------------------


def plan_data(plan: Plan) -> xr.Dataset:
    """Return the plan of a run as a Dataset, with the run time of each part."""
    import xarray as xr

    rows = plan.rows
    why = "description of the part, or reason for leaving it out"
    seconds = {"units": "s", "long_name": "run time of the part"}
    return xr.Dataset(
        {
            "status": ("part", [row.status for row in rows], {"long_name": "whether the part ran"}),
            "reason": ("part", [row.reason for row in rows], {"long_name": why}),
            "run_time": ("part", [row.seconds or 0.0 for row in rows], seconds),
        },
        {"part": ("part", [row.part for row in rows], {"long_name": "part of the plan"})},
    )


def _attributes(run: Run) -> dict[str, str]:
    """Global attributes of a result, such as title and references; equal in every run."""
    question = run.plan.question
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
        items = value if isinstance(value, tuple) else (value,)
        if items and all(hasattr(item, "reference") for item in items):
            references += [item.reference for item in items if item.reference]
        if items and all(hasattr(item, "changes") for item in items):
            attributes[name] = " ".join(body.name for body in items)
            alone = items[0] is value
            changes = [
                body.changes if alone else f"{body.name}: {body.changes}"
                for body in items
                if body.changes
            ]
            if changes:
                attributes[f"{name}_changes"] = "; ".join(changes)
        elif isinstance(value, tuple) and value and all(isinstance(item, str) for item in value):
            attributes[name] = " ".join(value)
    attributes["references"] = "; ".join(dict.fromkeys(references))
    attributes |= run.provenance_of([*question.graph.answer, NEGLECTED])
    attributes[NEGLECTED] = run.results[NEGLECTED].largest
    attributes[SCENE] = scene_text(question)
    return attributes


def scene_text(question: Question) -> str:
    """Write a question, with the values of all its inputs, as the text of a scene file."""
    import tomli_w

    packed: list[str] = []
    text = tomli_w.dumps(_without_bytes(question.to_table(), packed))
    for number, data in enumerate(packed):
        text = text.replace(f'"{_PACKED.format(number)}"', f'"{data}"', 1)
    return text


#: Placeholder for packed arrays while tomli_w writes a scene, since it writes long text slowly.
_PACKED = "earthspin: packed array {}"


def _without_bytes(value: Any, packed: list[str]) -> Any:
    """Copy a table with encoded arrays replaced by placeholders; append the arrays to `packed`."""
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
