"""The free wobble of the rigid body, beside what is observed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.bodies import all_of
from earthspin.dataset import Variable, with_error
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def free_wobble(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Period of the rigid free wobble."""
    from earthspin.dataset import build
    from earthspin.mass.inertia import ellipticity_from_h
    from earthspin.rotor.axisymmetric import free_wobble_error, free_wobble_period

    body = scene.body
    h = body.needed("dynamical_flattening")
    period = free_wobble_period(ellipticity_from_h(h), body.needed("spin_period"))
    error = free_wobble_error(period, h, body.relative_uncertainty.get("dynamical_flattening", 0.0))
    return build(
        "free-wobble",
        FREE_WOBBLE.gives,
        {
            "free_wobble_period": period,
            "free_wobble_period_error": error,
            "free_wobble_period_sidereal": free_wobble_period(ellipticity_from_h(h), 1.0),
        },
    )


def observed_wobble(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Quote the observed period of the wobble."""
    from earthspin.constants import DAY, NORMAL_95
    from earthspin.dataset import build

    observed = scene.body.observed_wobble
    assert observed is not None
    period = observed.value * DAY
    result = build(
        "observed-wobble",
        OBSERVED_WOBBLE.gives,
        {
            "observed_period": period,
            "observed_period_error": NORMAL_95 * period * observed.relative_uncertainty,
        },
    )
    result.observed_period.attrs["references"] = observed.source
    return result


FREE_WOBBLE = Part(
    name="free-wobble",
    does="period of the free wobble of the rigid body",
    function="earthspin.scene.parts.free_wobble:free_wobble",
    keys=("body",),
    left_out=lambda scene: (
        None
        if all_of(scene.body.needed("dynamical_flattening") != 0)
        else "a sphere does not wobble"
    ),
    gives={
        **with_error(
            "free_wobble_period", Variable((), "d", "period of the rigid free wobble, A/(C - A)")
        ),
        "free_wobble_period_sidereal": Variable(
            (), "1", "period of the rigid free wobble in turns of the body, its sidereal days"
        ),
    },
)

OBSERVED_WOBBLE = Part(
    name="observed-wobble",
    does="the observed Chandler period, a cited figure",
    function="earthspin.scene.parts.free_wobble:observed_wobble",
    keys=("body",),
    left_out=lambda scene: (
        None if scene.body.observed_wobble else f"no observed wobble of {scene.body.name} is kept"
    ),
    gives=with_error("observed_period", Variable((), "d", "observed period of the free wobble")),
)
