"""Nutation at a few nodes, for a series at the true equator."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.bodies import IAU_2006
from earthspin.scene.part import Part

if TYPE_CHECKING:
    from earthspin.scene.spec import Scene
    from earthspin.sky.iau import Nutation


def nutation(scene: Scene, given: Mapping[str, Any]) -> Nutation:
    """Prepare nutation over the times of the scene."""
    from earthspin.scene.parts.torque_at_times import series_times
    from earthspin.sky.iau import Nutation

    times = series_times(scene)
    return Nutation(times.first, times.last, times.size)


def _why_not(scene: Scene) -> str | None:
    if scene.equator == "mean":
        return "the equator is the mean one"
    if scene.body.pole != IAU_2006:
        return f"no nutation model for {scene.body.name}"
    return None


NUTATION = Part(
    name="nutation",
    does="IAU 2000A nutation at one node a day, for the true equator",
    function="earthspin.scene.parts.nutation_nodes:nutation",
    keys=("equator", "body", "span", "step", "times"),
    left_out=_why_not,
)
