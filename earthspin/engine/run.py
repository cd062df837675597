"""Run a question: each function (part) of the computation is called when its result is needed.

Other parts are not computed. The plan that users read comes from the same walk through the parts,
without the calls.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from itertools import groupby
from typing import TYPE_CHECKING, Any, NamedTuple, Self

from earthspin._lazy import xr
from earthspin._version import __version__, version
from earthspin.engine.question import ALL, SCENE, Part, Question, names_in, scene_text
from earthspin.engine.variables import (
    Neglected,
    Variables,
    error_of,
    labels_of,
    texts_as_labels,
    variable_of,
)
from earthspin.errors import SceneError, UndefinedError, nearest
from earthspin.html_table import card
from earthspin.number_text import plain

if TYPE_CHECKING:
    import pandas as pd

#: Status of a part whose result of an earlier run was used.
REUSED = "reused"
#: Reason for leaving out a part that could run.
NOT_REQUESTED = "its section was not requested"


class Row(NamedTuple):
    """One row in the table of a plan: part (function), status, reason and run time in s."""

    part: str
    status: str
    reason: str
    seconds: float | None = None

    @property
    def run_time(self) -> str:
        """Run time of the function as text, or "reused"; empty before the run."""
        if self.status == REUSED:
            return REUSED
        return "" if self.seconds is None else f"{self.seconds * 1e3:.1f} ms"


@dataclass(frozen=True)
class Plan:
    """Plan of a run: functions (parts) that run, and those left out, with the reasons.

    Attributes
    ----------
    question : Question
    parts : tuple of Part
        Parts in the order in which they run.
    sections : tuple of str
        Sections that are computed besides the answer.
    left_out : dict of str to str
        Reasons for leaving out the other parts, by title of the part.
    seconds : mapping of str to float
        Run time of each part by name; empty before the run.
    reused : frozenset of str
        Names of parts whose result of an earlier run was reused.
    wall_time : float
        Time since the run began, with the loading of libraries and what is not in parts, s.
    """

    question: Question
    parts: tuple[Part[..., Any], ...]
    sections: tuple[str, ...]
    left_out: dict[str, str]
    seconds: Mapping[str, float]
    reused: frozenset[str]
    wall_time: float

    @property
    def computation_time(self) -> float:
        """Sum of the run times of all parts, s."""
        return sum(self.seconds.values())

    @property
    def rows(self) -> list[Row]:
        """Rows of the plan's table: functions (parts) that run, and functions left out."""
        status, keys = "ran" if self.seconds else "runs", self.question.keys()
        rows = []
        for part in self.parts:
            state = REUSED if part.name in self.reused else status
            summary = part.description(keys)
            rows.append(Row(part.title, state, summary, self.seconds.get(part.name)))
        return rows + [Row(title, "left out", why) for title, why in self.left_out.items()]

    def to_frame(self) -> pd.DataFrame:
        """Return the table of this plan as a pandas DataFrame."""
        import pandas as pd

        return pd.DataFrame(self.rows)

    def dataset(self) -> xr.Dataset:
        """Return the table of this plan as a Dataset along `part`, and both times of the run."""
        part, status, reason, seconds = map(list, zip(*self.rows, strict=True))
        why = "description of the part, or reason for leaving it out"
        run_time = {"units": "s", "long_name": "run time of the part"}
        columns = {
            "status": (status, {"long_name": "whether the part ran"}),
            "reason": (reason, {"long_name": why}),
            "run_time": ([cost or 0.0 for cost in seconds], run_time),
        }
        rows = {name: variable_of(("part",), *column) for name, column in columns.items()}
        whole = {"wall_time": "time since the run began", "computation_time": "time of its parts"}
        for name, words in whole.items():
            rows[name] = variable_of((), getattr(self, name), {"units": "s", "long_name": words})
        return xr.Dataset(
            rows, {"part": labels_of("part", part, {"long_name": "part of the plan"})}
        )

    def __str__(self) -> str:
        width = max(len(row.part) for row in self.rows)
        lines = [f"{self.question.title}: compute = {self.question.word}"]
        in_order = f"{'ran' if self.seconds else 'runs'}, in this order"
        for is_left_out, rows in groupby(self.rows, lambda row: row.status == "left out"):
            lines += ["", "left out" if is_left_out else in_order]
            for row in rows:
                cost = f"  [{row.run_time}]" if row.run_time else ""
                lines.append(f"  {row.part:<{width}}  {row.reason}{cost}")
        if self.seconds:
            lines += ["", run_time_words(self.wall_time, self.computation_time)]
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        rows = [(row.part, row.status, row.reason, row.run_time) for row in self.rows]
        return card(self.question.title, rows)


def run_time_words(wall_time: float, computation_time: float) -> str:
    """Both times of a run, s, as text: ``"2.1 s, of it 0.03 s computation"``."""
    return f"{plain(wall_time)} s, of it {plain(computation_time)} s computation"


# --- run ------------------------------------------------------------------------------------------


class Run:
    """Run of a question: inputs and results of its functions (parts), computed when needed.

    Parameters
    ----------
    question : Question
    **values
        Values that the question does not have: the block of a long series.

    Attributes
    ----------
    values : dict of str to object
        Inputs of the question, and the results so far, by name.

    Raises
    ------
    SceneError
        If nothing that answers the question can run; it gives the reason.
    """

    def __init__(self, question: Question, **values: Any) -> None:
        self.question, self.graph, self.keys = question, question.graph, question.keys()
        self.values: dict[str, Any] = self.keys | values
        self._seconds: dict[str, float] = {}
        self._begun = time.perf_counter()
        self._reused: set[str] = set()
        self._reasons: dict[str, str] = {}
        self._dependencies: dict[str, dict[str, None]] = {}
        self._refuse_taken_dimensions()
        if why := self.why_not(self.graph.answer[0]):
            raise question.error("compute", question.word, f"nothing to do: {why}")

    def __getitem__(self, name: str) -> Any:
        """Return an input or the result of a part (function) by name; compute a missing result."""
        if name not in self.values:
            part = self.graph.parts[name]
            inputs = {other: self[other] for other in self.inputs(name)}
            begun = time.perf_counter()
            with in_range(name):
                result, is_stored = part.stored_or_computed(inputs)
                self.values[name] = result.dataset() if isinstance(result, Variables) else result
            self._seconds[name] = time.perf_counter() - begun
            if is_stored:
                self._reused.add(name)
        return self.values[name]

    # --- the walk --------------------------------------------------------------------------------

    def why_not(self, name: str) -> str:
        """Return the reason (text) why a part (function) is left out; empty if the part can run."""
        if name in self._reasons:
            return self._reasons[name]
        part, parts = self.graph.parts[name], self.graph.parts
        lacking = [other for other in part.needs if other in parts and self.why_not(other)]
        offered = [other for other in part.uses if other in parts]
        why = part.reason(self.keys) or ""
        if not why and lacking:
            reason = self.why_not(lacking[0])
            why = f"it needs {parts[lacking[0]].title}, which is left out: {reason}"
        if not why and offered and not part.needs and all(map(self.why_not, offered)):
            # without required inputs, it needs one of the optional ones
            why = "; ".join(f"no {parts[other].title}: {self.why_not(other)}" for other in offered)
        self._reasons[name] = why
        return why

    def inputs(self, name: str) -> list[str]:
        """Names of the arguments that a function (part) takes in this run; none for an input."""
        part, parts = self.graph.parts.get(name), self.graph.parts
        if part is None:
            return []
        offered = (
            n for n in part.uses if (not self.why_not(n) if n in parts else n in self.values)
        )
        return [*part.needs, *offered]

    def dependencies(self, names: Iterable[str]) -> dict[str, None]:
        """Names of parts (functions) and of all that they depend on, in the order of computation.

        Parts that are left out are omitted.
        """
        union: dict[str, None] = {}
        for name in names:
            if name in self.graph.parts and self.why_not(name):
                continue
            if name not in self._dependencies:
                self._dependencies[name] = self.dependencies(self.inputs(name)) | {name: None}
            union |= self._dependencies[name]
        return union

    def plan(self, sections: str | Iterable[str] = ()) -> Plan:
        """Plan of the run: functions for the answer and requested sections, and functions left out.

        Parameters
        ----------
        sections : str or iterable of str
            Names of the requested sections; ``"all"`` requests all that apply.

        Raises
        ------
        SceneError
            If a section does not exist, or does not apply.
        """
        names, graph = self._named(sections), self.graph
        of_sections = (part for name in names for part in graph.sections[name])
        ends = (*graph.ends, *of_sections)
        parts = tuple(graph.parts[name] for name in self.dependencies(ends) if name in graph.parts)
        others = {name: part.title for name, part in graph.parts.items() if part not in parts}
        left_out = {title: self.why_not(n) or NOT_REQUESTED for n, title in others.items()}
        ran = dict(self._seconds), frozenset(self._reused), time.perf_counter() - self._begun
        return Plan(self.question, parts, tuple(names), left_out, *ran)

    def _named(self, sections: str | Iterable[str]) -> list[str]:
        """Names of the requested sections that apply, without duplicates, in standard order."""
        known, requested = self.graph.sections, names_in(sections, "sections")
        applicable = [name for name in known if not all(map(self.why_not, known[name]))]
        if requested == [ALL]:
            return applicable
        for name in requested:
            if name not in known:
                raise SceneError("sections", name, nearest(name, [*known, ALL]))
            if name not in applicable:
                why = self.why_not(known[name][0])
                raise SceneError("sections", name, f"it does not apply: {why}")
        return [name for name in known if name in requested]

    def again(self, question: Question | None = None, **values: Any) -> Self:
        """Return a new run with changed inputs; results that do not depend on them are reused.

        Parameters
        ----------
        question : Question, optional
            Question of the same class; the same question by default.
        **values
            As for `Run`.
        """
        new = type(self)(question or self.question, **values)
        same = {
            name for name, value in new.values.items() if _is_same(self.values.get(name), value)
        }
        for name in new.dependencies(self.graph.ends):
            inputs = new.inputs(name)
            if name in self.graph.parts and same.issuperset(inputs) and inputs == self.inputs(name):
                new.values[name] = self[name]
                same.add(name)
        return new

    # --- answers ---------------------------------------------------------------------------------

    def numbers(self, names: Iterable[str] = (), effects: Sequence[str] = ()) -> xr.Dataset:
        """Merge the results of several functions (parts) into a Dataset without global attributes.

        Parameters
        ----------
        names : iterable of str
            Names of the parts, of which those that are left out are omitted; by default, those of
            the answer.
        effects : sequence of str
            Labels of the neglected effects.
        """
        results = [self[name] for name in names or self.graph.answer if not self.why_not(name)]
        merged, *others = (
            self.neglected.dataset(effects) if isinstance(result, Neglected) else result
            for result in results
        )
        for other in others:
            merged = merged.merge(other, join="exact", combine_attrs="override")
        return merged.copy()

    def answer(self) -> xr.Dataset:
        """Return the answer as a Dataset, with title, references and other attributes."""
        self._load_modules(self.graph.ends)
        result, neglected = texts_as_labels(self.numbers()), self.neglected
        results = map(self.__getitem__, self.dependencies(self.graph.ends))
        result.attrs = _described(self.question, results) | self.provenance(self.graph.ends)
        result.attrs |= {Neglected.PART: neglected.largest, SCENE: scene_text(self.question)}
        error = error_of(result, self.question.headline)
        if neglected.sizes and error in result:  # errors do not contain what the model leaves out
            result[error].attrs["not_modelled"] = neglected.largest
        return result

    def tree(self, sections: str | Iterable[str]) -> xr.DataTree:
        """Return a DataTree: the answer at the root, its sections, and the plan of the run."""
        names = self._named(sections)
        self._load_modules(part for name in names for part in self.graph.sections[name])
        answer = self.answer()
        effects = answer["effect"].values.tolist() if "effect" in answer.coords else ()
        nodes = {"/": answer}
        for name in names:
            parts = self.graph.sections[name]
            nodes[name] = texts_as_labels(self.numbers(parts, effects))
            sources = self.provenance(parts)
            nodes[name].attrs |= {key: sources[key] for key in sources if key not in answer.attrs}
        return xr.DataTree.from_dict(nodes | {"plan": self.plan(names).dataset()})

    @property
    def neglected(self) -> Neglected:
        """Effects that the model does not include, with sizes if known, as a `Neglected`."""
        neglected: Neglected = self[Neglected.PART]
        return neglected.also(self.question.unused)

    def provenance(self, names: Iterable[str], without: Iterable[str] = ()) -> dict[str, str]:
        """Software versions and checksums of data files on which the results of given parts depend.

        Parameters
        ----------
        names : iterable of str
            Names of the parts. Sources of all inputs of the question are included.
        without : iterable of str
            Names of inputs; parts that depend on them are omitted, and not computed.
        """
        sources: dict[str, str] = {}
        for name in [*self.keys, *self.dependencies(names)]:
            if not self.dependencies([name]).keys() & {*without}:
                sources |= getattr(self[name], "provenance", {})
        return sources

    def _load_modules(self, names: Iterable[str]) -> None:
        """Import the modules that some parts (functions) need, so that run times exclude this."""
        import earthspin.engine.accessor  # noqa: F401 - registers ds.earthspin

        for name in self.dependencies(names):
            if name in self.graph.parts:
                for module in self.graph.parts[name].loads:
                    import_module(module)

    def _refuse_taken_dimensions(self) -> None:
        """Raise an error if an input array has a dimension whose name the results already use."""
        for name, value in self.keys.items():
            for inner, number in getattr(value, "__dict__", {}).items():
                own = {*getattr(number, "dims", ()), *getattr(number, "coords", ())}
                if clash := own and self.graph.labels & own:
                    problem = "results already have this name; rename the dimension of the array"
                    raise self.question.error(f"{name}.{inner}", min(clash), problem)


@contextmanager
def in_range(what: str) -> Iterator[None]:
    """Raise an error if numbers overflow or become undefined; context manager and decorator.

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
        problem = f"numbers are too large or too small to compute with ({what}: {error})"
        raise UndefinedError(f"{problem}; check the input") from error


def _is_same(old: object, new: object) -> bool:
    """Return True if two values of an input are the same object, or equal tuples."""
    return old is new or (isinstance(old, tuple) and isinstance(new, tuple) and old == new)


# --- attributes ----------------------------------------------------------------------------------


def _described(question: Question, parts: Iterable[object]) -> dict[str, str]:
    """Attributes of a result as texts: title, references, names of bodies, and versions."""
    references: list[str] = []
    bodies: dict[str, str] = {}
    for name, value in question.keys().items():
        items = value if isinstance(value, tuple) else (value,)
        sources = (source for item in items for source in (item, getattr(item, "orbit", None)))
        references += filter(None, (getattr(source, "reference", "") for source in sources))
        if items and all(hasattr(item, "changes") for item in items):
            bodies[name] = " ".join(body.name for body in items)
            if changed := [body for body in items if body.changes]:
                words = (b.changes if b is value else f"{b.name}: {b.changes}" for b in changed)
                bodies[f"{name}_changes"] = "; ".join(words)
        elif items is value and items and all(isinstance(item, str) for item in items):
            bodies[name] = " ".join(items)
    references += filter(None, (getattr(result, "reference", "") for result in parts))
    return {
        "title": question.title,
        "source": f"earthspin {__version__}",
        "history": f"earthspin {__version__}: compute = {question.word}",
        "references": "; ".join(dict.fromkeys(references)),
        "earthspin_version": __version__,
        "numpy_version": version("numpy"),
        "compute": question.word,
        **bodies,
    }
