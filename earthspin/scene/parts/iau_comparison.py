"""The IAU's precession beside ours, and the published size of what the model leaves out."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.constants import PUBLISHED_EFFECTS
from earthspin.dataset import Variable, with_error
from earthspin.scene.part import Part
from earthspin.scene.parts.seasons import needs_both_and_iau

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def iau_2006(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Difference from psi_A, and what closes it."""
    from earthspin.compare import budget
    from earthspin.dataset import build, si

    total = given["mean-rates"].isel(perturber=-1, drop=True)
    rate, error = si(total.precession_rate), si(total.precession_rate_error)
    effects = budget.published_effects()
    return build(
        "iau-2006",
        IAU_2006_COMPARISON.gives,
        {
            "iau_rate": budget.iau_rate(),
            "difference_from_iau": budget.difference_from_iau(rate),
            "difference_from_iau_error": error,
            "neglected_effect": list(effects.values()),
            "closure": budget.closure(rate),
            "closure_error": error,
        },
        coords={"effect": list(effects)},
    )


IAU_2006_COMPARISON = Part(
    name="iau-2006",
    does="IAU 2006 precession beside ours, published size of each neglected effect",
    function="earthspin.scene.parts.iau_comparison:iau_2006",
    needs=("mean-rates",),
    left_out=needs_both_and_iau,
    gives={
        "iau_rate": Variable((), "arcsec/yr", "rate of psi_A at J2000.0, IAU 2006"),
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
