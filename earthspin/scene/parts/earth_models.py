"""Three models of the figure side by side: what precession and wobble each implies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.bodies import all_of
from earthspin.dataset import Variable
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene

MODELS = ("mccullough", "homogeneous", "measured")


def earth_models(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Precession period of all perturbers, and wobble, for each way to get H."""
    import xarray as xr

    from earthspin.dataset import build
    from earthspin.mass import inertia
    from earthspin.rotor.axisymmetric import free_wobble_period
    from earthspin.torque import rates

    body, samples = scene.body, given["torque-samples"]
    j2, measured = body.needed("j2"), body.needed("dynamical_flattening")
    push = samples.window.mean(samples.times, samples.push.sum(axis=1))
    h = xr.concat(
        [
            xr.DataArray(inertia.h_mccullough(body.needed("flattening"))),
            xr.DataArray(inertia.h_homogeneous(j2)),
            xr.DataArray(measured),
        ],
        dim=xr.Variable("earth_model", list(MODELS)),
    )
    spin_period = body.needed("spin_period")
    difference = inertia.moment_difference(j2, body.mass, body.needed("radius"))
    return build(
        "earth-models",
        EARTH_MODELS.gives,
        {
            "h_by_model": h,
            "period_by_model": rates.period(rates.precession_rate(push, h, body.spin_rate)),
            "wobble_by_model": free_wobble_period(inertia.ellipticity_from_h(h), spin_period),
            "moment_difference": difference,
            "polar_moment_factor": inertia.polar_moment_factor(j2, measured),
            "j2_from_moment_difference": inertia.j2_from_moment_difference(
                difference, body.mass, body.needed("radius")
            ),
        },
    )


def _why_not(scene: Scene) -> str | None:
    missing = [k for k in ("j2", "flattening", "radius") if getattr(scene.body, k) is None]
    if missing:
        return f"{scene.body.name} has no {missing[0]}"
    if not all_of((scene.body.flattening > -1) & (scene.body.flattening < 1)):
        return "McCullough's formula needs a flattening between -1 and 1"
    if not all_of(scene.body.needed("dynamical_flattening") != 0):
        return "with H = 0 the polar moment does not follow from J2"
    return None


_MODEL = ("earth_model",)

EARTH_MODELS = Part(
    name="earth-models",
    does="three ways to the dynamical flattening, and what each implies",
    function="earthspin.scene.parts.earth_models:earth_models",
    needs=("torque-samples",),
    left_out=_why_not,
    gives={
        "h_by_model": Variable(_MODEL, "1", "dynamical flattening (C - A)/C"),
        "period_by_model": Variable(_MODEL, "yr", "time for one turn of precession"),
        "wobble_by_model": Variable(_MODEL, "d", "period of the rigid free wobble"),
        "moment_difference": Variable((), "kg m2", "C - A from J2"),
        "polar_moment_factor": Variable((), "1", "C/(M a2) from J2 and H"),
        "j2_from_moment_difference": Variable((), "1", "J2 from C - A, and back"),
    },
)
