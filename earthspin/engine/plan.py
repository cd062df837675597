"""From a question back to the parts that it needs, in order, and what is left out and why."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from graphlib import TopologicalSorter
from typing import Any

from earthspin.card import card
from earthspin.engine.part import Part
from earthspin.engine.question import NEGLECTED, Question
from earthspin.errors import SceneError, nearest

ALL = "all"
#: Line of the run times for the time spent in importing modules, which no part is charged for.
IMPORTS = "imports"
#: Attribute of an answer that holds its question, complete, as the text of a scene file.
SCENE = "scene"
#: How many of the last runs are remembered with their run times.
REMEMBERED = 64

_SECONDS: OrderedDict[str, Mapping[str, float]] = OrderedDict()


@dataclass(frozen=True)
class Row:
    """One part of a plan: its name, whether it runs, what it does or why it does not, seconds."""

    part: str
    status: str
    reason: str
    seconds: float | None = None

    @property
    def run_time(self) -> str:
        """Its run time in words; empty before it has run."""
        return "" if self.seconds is None else f"{self.seconds * 1e3:.1f} ms"


@dataclass(frozen=True)
class Plan:
    """What will run for a question, and what will not.

    Attributes
    ----------
    question : Question
    parts : tuple of Part
        In the order in which they run.
    sections : tuple of str
        Those that will be given beside the answer.
    left_out : dict of str to str
        Reason by title, for the other parts of the question and its sections.
    seconds : mapping of str to float
        By name of the part, once it has run, without imports; these are under `IMPORTS`.
    """

    question: Question
    parts: tuple[Part[..., Any], ...]
    sections: tuple[str, ...]
    left_out: dict[str, str]
    seconds: Mapping[str, float] = field(default_factory=dict)

    @property
    def rows(self) -> list[Row]:
        """The plan as a table: what runs first, then what is left out."""
        status, keys = "ran" if self.seconds else "runs", self.question.keys()
        rows = [
            Row(part.title, status, part.told(keys), self.seconds.get(part.name))
            for part in self.parts
        ]
        if IMPORTS in self.seconds:
            words = "modules loaded on first use, once in each process"
            rows.append(Row(IMPORTS, status, words, self.seconds[IMPORTS]))
        return rows + [Row(title, "left out", why) for title, why in self.left_out.items()]

    def to_frame(self) -> Any:
        """Give the table as a DataFrame of pandas."""
        import pandas as pd

        return pd.DataFrame([vars(row) for row in self.rows])

    def __str__(self) -> str:
        question = self.question
        width = max(len(row.part) for row in self.rows)
        lines = [f"{question.title}: compute = {question.word}", ""]
        shown = ""
        for row in self.rows:
            heading = "left out" if row.status == "left out" else f"{row.status}, in this order"
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


NOT_ASKED = "its section is not asked for"


def plan_parts(question: Question, sections: str | Iterable[str] = ()) -> Plan:
    """Work out which parts a question needs.

    Parameters
    ----------
    question : Question
    sections : str or iterable of str
        Sections that are wanted beside the answer, by name; ``"all"`` takes all that apply.

    Raises
    ------
    SceneError
        If the answer cannot be given or a section that is named does not apply, with the reason.
    """
    graph, keys = question.graph, question.keys()
    _refuse_taken_dimensions(question)
    chosen: dict[str, tuple[str, ...]] = {}
    reasons: dict[str, str] = {}

    def choose(name: str) -> bool:
        """Choose a part and all that it stands on, or note why it is left out."""
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
                lack = (f"no {graph.parts[other].title}: {reasons[other]}" for other in offered)
                why = "; ".join(lack)
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
        part.title: reasons.get(name) or part.reason(keys) or NOT_ASKED
        for name, part in graph.parts.items()
        if name not in chosen
    }
    return Plan(question, order, tuple(applicable), left_out)


def _named_sections(question: Question, sections: str | Iterable[str]) -> list[str]:
    """Names of sections, each once, in the order of the question."""
    known = question.graph.sections
    if isinstance(sections, str) and sections == ALL:
        return list(known)
    try:
        named = [sections] if isinstance(sections, str) else [*sections]
    except Exception:  # whatever it is, it is no list
        raise SceneError("sections", sections, f"give names, or '{ALL}'") from None
    for name in named:
        if not isinstance(name, str) or name not in known:  # type: ignore[redundant-expr]
            raise SceneError("sections", name, nearest(name, [*known, ALL]))
    return [name for name in known if name in named]


def _refuse_taken_dimensions(question: Question) -> None:
    """Refuse labelled arrays of a body along a dimension that results have already."""
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
                    "results have this name already; give the array another",
                )


def remember_seconds(scene: str, seconds: Mapping[str, float]) -> None:
    """Remember the seconds of each part of a scene that has run."""
    _SECONDS[scene] = dict(seconds)
    _SECONDS.move_to_end(scene)
    if len(_SECONDS) > REMEMBERED:
        _SECONDS.popitem(last=False)


def seconds_of(scene: str) -> Mapping[str, float]:
    """Seconds of each part when this scene last ran in this process; empty if it did not."""
    return _SECONDS.get(scene, {})
