"""The rigid rungs of the ladder."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import earthspin
from earthspin import EARTH, UndefinedError
from earthspin.wobble import ladder
from tests.conftest import load_pins

PINS = load_pins("precession")


def test_rungs() -> None:
    result = earthspin.wobble_ladder()
    solar = result.period_solar
    PINS["flattening wobble"].check(solar.sel(rung="flattening"))
    PINS["rigid wobble"].check(solar.sel(rung="rigid"))
    PINS["triaxial wobble"].check(solar.sel(rung="triaxial"))
    PINS["rigid wobble in turns"].check(result.period_sidereal.sel(rung="rigid"))
    assert np.isclose(np.prod(result.factor) * solar[0], solar[-1], rtol=1e-14)


def test_the_wobble_of_the_precession_scene_is_the_same(precession_result: xr.Dataset) -> None:
    rigid = earthspin.wobble_ladder().period_solar.sel(rung="rigid")
    assert float(precession_result.free_wobble_period) == float(rigid)
    assert float(precession_result.wobble_by_model.sel(earth_model="measured")) == float(rigid)


@given(st.floats(0.05, 0.45), st.floats(0.0, 0.9))
def test_triaxial_rung_against_eulers_equations(h: float, share: float) -> None:
    """Count the time of one turn of omega in a numerical solution at small amplitude."""
    j2, e = h * 0.4, h / (1 - h)  # C = 0.4 M a2
    mean = 0.4 - j2
    half = share * min(e, 0.5) * mean
    a, b, c = mean - half, mean + half, 0.4
    turns = ladder.turns_triaxial(h, j2, 2 * half)

    def euler(t: float, w: np.ndarray) -> list[float]:
        return [
            (b - c) / a * w[1] * w[2],
            (c - a) / b * w[2] * w[0],
            (a - b) / c * w[0] * w[1],
        ]

    def crossing(t: float, w: np.ndarray) -> float:
        return float(w[1])

    crossing.direction = 1.0  # type: ignore[attr-defined]
    solution = solve_ivp(
        euler, (0, 2.6 * 2 * np.pi * turns), [1e-7, 0, 1], events=crossing, rtol=1e-11, atol=1e-18
    )
    periods = np.diff(solution.t_events[0])
    assert np.isclose(periods[-1] / (2 * np.pi), turns, rtol=1e-8)


def test_a_round_body_has_the_axisymmetric_rung() -> None:
    assert ladder.turns_triaxial(0.003, 0.001, 0.0) == ladder.turns_rigid(0.003)


def test_a_sphere_does_not_wobble() -> None:
    sphere = EARTH.replace(j2=0.0, dynamical_flattening=0.0, triaxiality=0.0, flattening=0.0)
    result = earthspin.wobble_ladder(body=sphere)
    assert np.all(np.isinf(result.period_solar))
    assert np.all(result.factor == 1)


def test_a_prolate_body_wobbles_in_as_many_days() -> None:
    thin = EARTH.replace(j2=-EARTH.j2, dynamical_flattening=-EARTH.dynamical_flattening)
    periods = earthspin.wobble_ladder(body=thin).period_solar
    assert np.all(periods > 0)
    assert np.isclose(periods[1], periods[2], rtol=1e-4)


def test_sidereal_days_are_those_of_the_body() -> None:
    result = earthspin.wobble_ladder(body="mars")
    day = earthspin.MARS.spin_period / 86400
    assert np.allclose(result.period_sidereal * day, result.period_solar, rtol=1e-14)


def test_an_unstable_axis_is_refused() -> None:
    with pytest.raises(UndefinedError, match="middle one"):
        earthspin.wobble_ladder(body=EARTH.replace(triaxiality=0.01))
    with pytest.raises(UndefinedError, match="H = 0"):
        ladder.turns_triaxial(0.0, 0.0, 1e-6)


def test_many_bodies_at_once() -> None:
    h = xr.DataArray([0.003, 0.0033], dims="draw")
    result = earthspin.wobble_ladder(body=EARTH.replace(dynamical_flattening=h))
    assert result.period_solar.dims == ("rung", "draw")
    assert result.factor.dims == ("rung", "draw")
