"""Nutation at a few nodes, for a series at the true equator."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import needs_iau

if TYPE_CHECKING:
    from earthspin.scene.spec import Scene
    from earthspin.sky.iau import Nutation


def nutation(scene: Scene, given: Mapping[str, Any]) -> Nutation | None:
    """Prepare nutation over the times of the scene; None where the mean equator will do."""
    from earthspin.sky.iau import Nutation

    start, end = given["times"].span()
    choice = given.get("chosen-nutation")
    if choice is not None and not choice.settings:
        return None
    return Nutation(start, end, given["times"].size, **(choice.settings if choice else {}))


def _why_not(scene: Scene) -> str | None:
    if scene.equator == "mean":
        return "the equator is the mean one"
    return needs_iau(scene)


NUTATION = Part(
    name="nutation",
    does="IAU nutation from nodes, for the true equator",
    function="earthspin.scene.parts.nutation_nodes:nutation",
    needs=("times",),
    uses=("chosen-nutation",),
    keys=("equator", "body"),
    left_out=_why_not,
)
