"""What the rate means in the sky and in the calendar."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable, with_error
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import needs_sun_and_moon_alone

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def seasons(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """General precession, and the slide of the seasons."""
    from earthspin.compare import seasons as s
    from earthspin.constants import DAY
    from earthspin.dataset import build, si
    from earthspin.sky.iau import precession_rates
    from earthspin.torque import rates

    mean, samples = given["mean-rates"], given["torque-samples"]
    total = mean.isel(perturber=-1, drop=True)
    chi_rate = precession_rates(samples.window.centre / DAY).chi_a
    general = s.general_precession(si(total.precession_rate), chi_rate, samples.obliquity)
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


SEASONS = Part(
    name="seasons",
    does="general precession, years a degree, drift of the calendar",
    function="earthspin.scene.parts.seasons:seasons",
    needs=("torque-samples", "mean-rates"),
    left_out=needs_sun_and_moon_alone,
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
