"""Errors of the upper rungs by sampling: fixed draws, the same for every body."""

from dataclasses import fields, replace

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin.bodies import EARTH, MARS, Body
from earthspin.interior.named import INTERIORS
from earthspin.wobble import ladder, propagation


def settings(body: Body) -> tuple[ladder.Inputs, dict[str, float], tuple]:
    """Inputs of a body, their uncertainties, and what the ladder is climbed with."""
    interior = INTERIORS[str(body.interior)]
    spin = ladder.Rotator(body.gm, body.radius, body.spin_period)
    figure = {n: body.needed(n) for n in ("dynamical_flattening", "j2", "triaxiality")}
    uncertainty = {**interior.relative_uncertainty, **body.relative_uncertainty}
    return ladder.inputs_of(interior, spin, figure), uncertainty, (spin, interior, "real")


@pytest.mark.parametrize(("body", "tolerance"), [(EARTH, 4e-3), (MARS, 7e-3)])
def test_parabolas_against_the_ladder_climbed_for_every_draw(body: Body, tolerance: float) -> None:
    """Measured: 2e-3 with the exponent, 6.2e-3 with the core of Mars, at the end of one tail."""
    inputs, uncertainty, climbed_with = settings(body)
    ours = propagation.sampled_half_widths(inputs, uncertainty, *climbed_with)
    samples = propagation.draw(uncertainty)
    exponent = samples.pop("anelastic_exponent")
    varied = {n: getattr(inputs, n) * (1 + uncertainty[n] * z) for n, z in samples.items()}
    drawn = replace(inputs, **varied, anelastic_exponent=exponent)
    nominal = ladder.non_rigid(inputs, *climbed_with).rotations
    for name, turns in ladder.non_rigid(drawn, *climbed_with).rotations.items():
        half_width = np.quantile(np.abs(turns - nominal[name]), 0.95)
        np.testing.assert_allclose(ours[name], half_width, rtol=tolerance, atol=0)


@pytest.mark.parametrize("rung", ["elastic", "fluid-core", "ocean"])
def test_normal_inputs_against_propagation_in_line(rung: str) -> None:
    """Without the exponent the errors add in squares: within 4 per cent, as 1000 draws tell it."""
    inputs, uncertainty, climbed_with = settings(EARTH)
    variance = 0.0
    for name, share in uncertainty.items():
        if name in {one.name for one in fields(inputs)}:
            step = 1e-3 * share * getattr(inputs, name)
            up, down = (
                ladder.non_rigid(
                    replace(inputs, **{name: getattr(inputs, name) + s}), *climbed_with
                )
                for s in (step, -step)
            )
            variance += ((up.rotations[rung] - down.rotations[rung]) / 2e-3) ** 2
    found = propagation.sampled_half_widths(inputs, uncertainty, *climbed_with)[rung]
    np.testing.assert_allclose(found, 1.96 * np.sqrt(variance), rtol=0.05, atol=0)


def test_an_error_does_not_depend_on_which_other_bodies_are_asked_for() -> None:
    """Once 100 draws were taken for many bodies, and 1000 for one."""
    h = EARTH.dynamical_flattening * np.linspace(0.999, 1.001, 300)  # more than are held at once
    many = earthspin.wobble_ladder(
        body=EARTH.replace(dynamical_flattening=xr.DataArray(h, dims="member"))
    )
    for member in (0, 255, 256, 299):
        alone = earthspin.wobble_ladder(body=EARTH.replace(dynamical_flattening=float(h[member])))
        np.testing.assert_allclose(
            many.period_solar_error[:, member], alone.period_solar_error, rtol=1e-13, atol=0
        )
    assert many.period_solar_error.attrs["draws"] == 1000


def test_draws_of_one_input_do_not_depend_on_which_others_are_uncertain() -> None:
    all_of, one = propagation.draw({"j2": 1e-3, "k2": 1e-3}), propagation.draw({"k2": 1e-3})
    assert list(one) == ["k2", "anelastic_exponent"]
    for name, values in one.items():
        np.testing.assert_array_equal(all_of[name], values)
