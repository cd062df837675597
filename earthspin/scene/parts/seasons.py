"""What the rate means in the sky and in the calendar."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.bodies import IAU_2006
from earthspin.dataset import Variable, with_error
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def seasons(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """General precession, and the slide of the seasons."""
    from earthspin.compare import seasons as s
    from earthspin.dataset import build, si
    from earthspin.torque import rates

    total = given["mean-rates"].isel(perturber=-1, drop=True)
    general = s.general_precession(si(total.precession_rate))
    error = si(total.precession_rate_error)
    year = s.tropical_year(general, scene.body.needed("orbital_period"))
    return build(
        "seasons",
        SEASONS.gives,
        {
            "general_precession": general,
            "general_precession_error": error,
            "general_precession_period": rates.period(general),
            "general_precession_period_error": rates.period_error(general, error),
            "time_per_degree": s.time_per_degree(general),
            "tropical_year": year,
            "time_per_day_of_drift": s.time_per_day_of_drift(year),
        },
    )


def needs_both_and_iau(scene: Scene) -> str | None:
    """Leave out what only the luni-solar precession of the IAU's planet can answer."""
    if scene.body.pole != IAU_2006:
        return f"the IAU has no precession model for {scene.body.name}"
    names = {p.name for p in scene.perturbers}
    missing = [name for name in ("sun", "moon") if name not in names]
    return f"the {missing[0]} is not among the perturbers" if missing else None


SEASONS = Part(
    name="seasons",
    does="general precession, years a degree, drift of the calendar",
    function="earthspin.scene.parts.seasons:seasons",
    needs=("mean-rates",),
    left_out=needs_both_and_iau,
    gives={
        **with_error(
            "general_precession",
            Variable((), "arcsec/yr", "slide of the equinox along the moving ecliptic"),
        ),
        **with_error(
            "general_precession_period", Variable((), "yr", "time for one turn of the equinox")
        ),
        "time_per_degree": Variable((), "yr", "time in which the equinox slides by one degree"),
        "tropical_year": Variable((), "d", "time from season to season"),
        "time_per_day_of_drift": Variable(
            (), "yr", "time in which years of 365.25 d drift by a day against the seasons"
        ),
    },
)
