"""Plan of a run: functions (parts) that a question needs, in order, and those left out."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from graphlib import TopologicalSorter
from typing import Any

from earthspin.card import card
from earthspin.engine.part import Part
from earthspin.engine.question import NEGLECTED, Question
from earthspin.errors import SceneError, nearest

ALL = "all"
#: Row of the run times for importing modules; the run times of parts exclude it.
IMPORTS = "imports"
#: Status of a part whose result of an earlier run was used.
REUSED = "reused"
#: Attribute of an answer that holds the complete question as the text of a scene file.
SCENE = "scene"


def scene_of(answer: Any) -> str:
    """Text of the scene (input file) that a result stores; empty if there is none.

    A netCDF file holds the scene as a variable, so that ``ncdump -h`` stays readable.
    """
    text = answer.attrs.get(SCENE, "")
    if not text and SCENE in getattr(answer, "data_vars", ()):
        text = answer[SCENE].values.tolist()
    return text if isinstance(text, str) else ""


#: Number of recent runs whose run times are stored.
REMEMBERED = 64

#: Run times of recent runs, and names of reused parts, by the text of the scene.
_RUNS: OrderedDict[str, tuple[Mapping[str, float], frozenset[str]]] = OrderedDict()


@dataclass(frozen=True)
class Row:
    """One row in the table of a plan: part (function), status, reason and run time in s."""

    part: str
    status: str
    reason: str
    seconds: float | None = None

    @property
    def run_time(self) -> str:
        """Run time of the part as text; empty before the run."""
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
        Run time of each part by name, without imports, and that of imports under `IMPORTS`; empty
        before the run.
    reused : frozenset of str
        Names of parts whose result of an earlier run was reused.
    """

    question: Question
    parts: tuple[Part[..., Any], ...]
    sections: tuple[str, ...]
    left_out: dict[str, str]
    seconds: Mapping[str, float] = field(default_factory=dict)
    reused: frozenset[str] = frozenset()

    @property
    def rows(self) -> list[Row]:
        """Rows of the plan's table: first the parts that run, then those left out."""
        status, keys = "ran" if self.seconds else "runs", self.question.keys()
        rows = []
        for part in self.parts:
            seconds, is_reused = self.seconds.get(part.name), part.name in self.reused
            does = part.description(keys)
            rows.append(Row(part.title, REUSED if is_reused else status, does, seconds))
        if IMPORTS in self.seconds:
            note = "modules loaded on first use, once in each process"
            rows.append(Row(IMPORTS, status, note, self.seconds[IMPORTS]))
        return rows + [Row(title, "left out", why) for title, why in self.left_out.items()]

    def to_frame(self) -> Any:
        """Return the table of this plan as a pandas DataFrame."""
        import pandas as pd

        return pd.DataFrame([vars(row) for row in self.rows])

    def __str__(self) -> str:
        question = self.question
        width = max(len(row.part) for row in self.rows)
        lines = [f"{question.title}: compute = {question.word}", ""]
        shown = ""
        for row in self.rows:
            ran = "ran" if self.seconds else "runs"
            heading = "left out" if row.status == "left out" else f"{ran}, in this order"
            if heading != shown:
                lines += [""] * bool(shown) + [heading]
                shown = heading
            cost = f"  [{row.run_time}]" if row.run_time else ""
            lines.append(f"  {row.part:<{width}}  {row.reason}{cost}")
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return card(
            self.question.title,
            [(row.part, row.status, row.reason, row.run_time) for row in self.rows],
        )


NOT_REQUESTED = "its section was not requested"


def plan_parts(question: Question, sections: str | Iterable[str] = ()) -> Plan:
    """Determine which parts (functions) a question needs, and in which order they run.

    Parameters
    ----------
    question : Question
    sections : str or iterable of str
        Names of the requested sections; ``"all"`` requests all that apply.

    Raises
    ------
    SceneError
        If the answer cannot be computed, or a named section does not apply.
    """
    graph, keys = question.graph, question.keys()
    _refuse_taken_dimensions(question)
    chosen: dict[str, tuple[str, ...]] = {}
    reasons: dict[str, str] = {}

    def choose(name: str) -> bool:
        """Return True if a part can run; otherwise store the reason why it cannot.

        For a part that can run, the names of its inputs are stored.
        """
        if name in chosen or name in reasons:
            return name in chosen
        part, used = graph.parts[name], list[str]()
        needed = [other for other in part.needs if other in graph.parts]
        offered = [other for other in part.uses if other in graph.parts]
        why = part.reason(keys)
        if why is None and not all(map(choose, needed)):
            lacking = next(other for other in needed if other in reasons)
            why = f"it needs {graph.parts[lacking].title}, which is left out: {reasons[lacking]}"
        if why is None:
            used = [other for other in offered if choose(other)]
            if offered and not used and not part.needs:  # it needs one of several
                missing = (f"no {graph.parts[other].title}: {reasons[other]}" for other in offered)
                why = "; ".join(missing)
        if why is None:
            chosen[name] = (*needed, *used)
        else:
            reasons[name] = why
        return why is None

    answer = [name for name in graph.answer if choose(name)]
    if graph.answer[0] not in answer:
        why = reasons[graph.answer[0]]
        raise question.error("compute", question.word, f"nothing to do: {why}")
    for name in graph.sections[NEGLECTED]:
        choose(name)
    applicable = []
    for section in _named_sections(question, sections):
        names = [name for name in graph.sections[section] if choose(name)]
        if names:
            applicable.append(section)
        elif sections != ALL:
            why = reasons[graph.sections[section][0]]
            raise SceneError("sections", section, f"it does not apply: {why}")
    order = tuple(graph.parts[name] for name in TopologicalSorter(chosen).static_order())
    left_out = {
        part.title: reasons.get(name) or part.reason(keys) or NOT_REQUESTED
        for name, part in graph.parts.items()
        if name not in chosen
    }
    return Plan(question, order, tuple(applicable), left_out)


def _named_sections(question: Question, sections: str | Iterable[str]) -> list[str]:
    """Names of the requested result sections, without duplicates, in standard order."""
    known = question.graph.sections
    if isinstance(sections, str) and sections == ALL:
        return list(known)
    try:
        named = [sections] if isinstance(sections, str) else [*sections]
    except Exception:  # not iterable
        raise SceneError("sections", sections, f"give names, or '{ALL}'") from None
    for name in named:
        if not isinstance(name, str) or name not in known:  # type: ignore[redundant-expr]
            raise SceneError("sections", name, nearest(name, [*known, ALL]))
    return [name for name in known if name in named]


def _refuse_taken_dimensions(question: Question) -> None:
    """Raise an error if an array of a body uses a dimension name that results also use."""
    parts = question.graph.parts.values()
    taken = {dim for part in parts for declared in part.gives.values() for dim in declared.dims}
    taken |= {name for part in parts for name in part.gives}
    for name, value in question.keys().items():
        for inner, number in getattr(value, "__dict__", {}).items():
            clash = taken & {*getattr(number, "dims", ()), *getattr(number, "coords", ())}
            if clash:
                raise question.error(
                    f"{name}.{inner}",
                    sorted(clash)[0],
                    "results already have this name; rename the dimension of the array",
                )


def remember_run(scene: str, plan: Plan) -> None:
    """Store the run times of a plan that has run, by the text of its scene."""
    _RUNS[scene] = plan.seconds, plan.reused
    _RUNS.move_to_end(scene)
    if len(_RUNS) > REMEMBERED:
        _RUNS.popitem(last=False)


def with_run_times(plan: Plan, scene: str) -> Plan:
    """Add to a plan the run times of the last run of the same question, if they are stored."""
    seconds, reused = _RUNS.get(scene, ({}, frozenset()))
    return replace(plan, seconds=seconds, reused=reused)
