"""Lunar standstills in the span, from the ephemeris."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable, with_error
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import needs_iau

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def standstills(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Find every standstill, its date and its declination."""
    import numpy as np

    from earthspin.dataset import build
    from earthspin.sky.equator import equator_of_date, rotate, spherical
    from earthspin.sky.standstill import find_standstills
    from earthspin.units import datetime64

    sky, body = given["ephemeris"], scene.body
    moon = {"moon": sky.targets["moon"]}

    def declination(days: Any) -> Any:
        position = sky.ephemeris.positions(moon, sky.centre, days)["moon"]
        equator = equator_of_date(body.needed("pole"), body.orbit_pole, days)
        return spherical(rotate(equator, position))[1]

    kernel_error, _ = sky.ephemeris.error(sky.targets["moon"])
    found = find_standstills(declination, *sky.span)
    return build(
        "standstills",
        STANDSTILLS.gives,
        {
            "standstill_kind": np.array([s.kind for s in found], dtype=str),
            "standstill_declination": np.array([s.declination for s in found], dtype=float),
            "standstill_declination_error": np.full(len(found), kernel_error),
        },
        coords={
            "standstill": (
                "standstill",
                datetime64(np.array([s.day for s in found], dtype=float)),
                {"long_name": "day of the extreme declination (TDB)"},
            )
        },
    )


def _why_not(scene: Scene) -> str | None:
    if needs_iau(scene):
        return needs_iau(scene)
    if "moon" not in {p.name for p in scene.perturbers}:
        return "the moon is not among the perturbers"
    return None


STANDSTILLS = Part(
    name="standstills",
    does="major and minor standstills of the moon: dates and extreme declinations",
    function="earthspin.scene.parts.standstills:standstills",
    needs=("ephemeris",),
    left_out=_why_not,
    gives={
        "standstill_kind": Variable(("standstill",), "", "major or minor"),
        **with_error(
            "standstill_declination",
            Variable(("standstill",), "deg", "extreme declination, mean equator of date"),
        ),
    },
)
