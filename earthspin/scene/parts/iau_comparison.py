"""The IAU's precession beside ours, and the published size of what the model leaves out."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.constants import PUBLISHED_EFFECTS
from earthspin.dataset import Variable, with_error
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import needs_sun_and_moon_alone

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def iau_2006(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Difference from psi_A, and what closes it."""
    from earthspin.compare import budget
    from earthspin.constants import DAY
    from earthspin.dataset import build, si
    from earthspin.sky.iau import precession_rates

    total = given["mean-rates"].isel(perturber=-1, drop=True)
    rate, error = si(total.precession_rate), si(total.precession_rate_error)
    iau_rate = precession_rates(given["torque-samples"].window.centre / DAY).psi_a
    effects = budget.published_effects()
    return build(
        "iau-2006",
        IAU_2006_COMPARISON.gives,
        {
            "iau_rate": iau_rate,
            "difference_from_iau": rate - iau_rate,
            "difference_from_iau_error": error,
            "neglected_effect": list(effects.values()),
            "closure": budget.closure(rate, iau_rate),
            "closure_error": error,
        },
        coords={"effect": list(effects)},
    )


IAU_2006_COMPARISON = Part(
    name="iau-2006",
    does="IAU 2006 precession beside ours, published size of each neglected effect",
    function="earthspin.scene.parts.iau_comparison:iau_2006",
    needs=("torque-samples", "mean-rates"),
    left_out=needs_sun_and_moon_alone,
    gives={
        "iau_rate": Variable((), "arcsec/yr", "rate of psi_A in IAU 2006 at the same epoch"),
        **with_error("difference_from_iau", Variable((), "arcsec/yr", "our rate minus the IAU's")),
        "neglected_effect": Variable(
            ("effect",),
            "arcsec/yr",
            "published contribution to the rate that the model leaves out",
            (("references", next(iter(PUBLISHED_EFFECTS.values())).source),),
        ),
        **with_error(
            "closure",
            Variable((), "arcsec/yr", "difference left after every published contribution"),
        ),
    },
)
