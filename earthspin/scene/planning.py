"""From a question back to the parts that it needs, in order, and what was left out and why."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass, fields
from graphlib import TopologicalSorter

from earthspin.errors import SceneError
from earthspin.scene.part import Part
from earthspin.scene.parts import PARTS
from earthspin.scene.questions import QUESTIONS
from earthspin.scene.spec import Scene

#: Why most parts are left out of most plans.
NOT_NEEDED = "nothing that is asked for needs it"


@dataclass(frozen=True)
class Plan:
    """What will run for a scene, and what will not.

    Attributes
    ----------
    scene : Scene
    parts : tuple of Part
        In the order in which they run.
    left_out : dict of str to str
        Reason by name, for every other part that there is.
    """

    scene: Scene
    parts: tuple[Part, ...]
    left_out: dict[str, str]

    def unused_keys(self) -> list[str]:
        """Keys that the scene sets and no part of the plan depends on."""
        used = set().union(*(part.keys for part in self.parts))
        settings = ("perturbers", "equator", "ephemeris", "span", "step", "times")
        plain = {f.name: f.default for f in fields(Scene)}
        return [
            key
            for key in settings
            if key not in used and not _is_default(getattr(self.scene, key), plain[key])
        ]

    def __str__(self) -> str:
        width = max(len(name) for name in PARTS)
        lines = [f"{self.scene.title}: compute = {self.scene.compute}", "", "runs, in this order"]
        lines += [f"  {p.name:<{width}}  {p.does}" for p in self.parts]
        lines += ["", "left out"]
        for_a_reason = {n: why for n, why in self.left_out.items() if why != NOT_NEEDED}
        lines += [f"  {name:<{width}}  {why}" for name, why in for_a_reason.items()]
        others = ", ".join(name for name in self.left_out if name not in for_a_reason)
        lines += textwrap.wrap(
            f"{NOT_NEEDED}: {others}",
            96,
            initial_indent="  ",
            subsequent_indent="    ",
            break_on_hyphens=False,
        )
        if self.unused_keys():
            lines += [
                "",
                f"set in the scene, used by nothing here: {', '.join(self.unused_keys())}",
            ]
        return "\n".join(lines)


def plan(scene: Scene) -> Plan:
    """Work out which parts a scene needs.

    Parameters
    ----------
    scene : Scene

    Raises
    ------
    SceneError
        If nothing that answers the question can run; it gives the reason.
    """
    _refuse_taken_dimensions(scene)
    wanted = QUESTIONS[scene.compute].wants
    reasons: dict[str, str] = {}
    chosen: dict[str, tuple[str, ...]] = {}
    for name in wanted:
        _choose(name, scene, chosen, reasons)
    if not any(name in chosen for name in wanted):
        raise SceneError(
            "compute", scene.compute, f"nothing to do: {reasons[wanted[0]]}", source=scene.source
        )
    order = TopologicalSorter(chosen).static_order()
    left_out = {name: reasons.get(name, NOT_NEEDED) for name in PARTS if name not in chosen}
    return Plan(scene, tuple(PARTS[name] for name in order), left_out)


def _refuse_taken_dimensions(scene: Scene) -> None:
    """Refuse labelled arrays along a dimension that results have already."""
    declared = (variable.dims for part in PARTS.values() for variable in part.gives.values())
    taken = {"part"}.union(*declared)
    for field in fields(scene.body):
        clash = taken & set(getattr(getattr(scene.body, field.name), "dims", ()))
        if clash:
            raise SceneError(
                f"body.{field.name}",
                sorted(clash)[0],
                "results have this dimension already; give the array another",
                source=scene.source,
            )


def _choose(
    name: str, scene: Scene, chosen: dict[str, tuple[str, ...]], reasons: dict[str, str]
) -> bool:
    """Choose a part and all that it stands on, or note why it is left out."""
    if name in chosen:
        return True
    if name in reasons:
        return False
    part = PARTS[name]
    why = part.left_out(scene)
    if why is None:
        missing = _first_missing(part.needs, scene, chosen, reasons)
        why = missing and f"it needs {missing}, which is left out: {reasons[missing]}"
    if why is not None:
        reasons[name] = why
        return False
    used = tuple(other for other in part.uses if _choose(other, scene, chosen, reasons))
    chosen[name] = part.needs + used
    return True


def _first_missing(
    names: Iterable[str], scene: Scene, chosen: dict[str, tuple[str, ...]], reasons: dict[str, str]
) -> str | None:
    return next((n for n in names if not _choose(n, scene, chosen, reasons)), None)


def _is_default(value: object, default: object) -> bool:
    """Whether a key has been left alone; bodies stand for their names."""
    names = tuple(getattr(v, "name", v) for v in value) if isinstance(value, tuple) else value
    return names is default or (isinstance(names, (str, tuple)) and names == default)
