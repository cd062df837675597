"""Windows solved together, held against windows in succession, a closed form and another solver."""

from dataclasses import replace

import numpy as np
import pytest

from earthspin.motion.equations import LiquidCore, Rigid
from earthspin.motion.march import Masses
from earthspin.motion.solution import AttitudeIntegrator, RotationSeries, State
from earthspin.motion.together import Together
from earthspin.numerics.arrays import FloatArray
from earthspin.rotor.triaxial import free_rotation
from earthspin.torque.gravity import cross, dot
from tests.motion.kepler import ALONE, AS_SKY, Ellipse, angle, followed, of_moments, rigid, start
from tests.reference.attitude import attitude_motion

TIMES = np.linspace(0.0, 40.0, 201)


def in_both_ways(
    monkeypatch: pytest.MonkeyPatch, body: Rigid, masses: Masses, first: State, end: float = 40.0
) -> tuple[RotationSeries, RotationSeries, list[bool]]:
    """A motion as the package solves it, with windows in succession only, and what was together."""
    solve, tried = Together.solve, []

    def noted(*args: object) -> object:
        pair = solve(*args)  # type: ignore[arg-type]
        tried.append(pair is not None)
        return pair

    times = TIMES * end / TIMES[-1]
    monkeypatch.setattr(Together, "solve", noted)
    together = AttitudeIntegrator(body, masses, first, end).at(times)
    monkeypatch.setattr(Together, "solve", lambda *args: None)
    return together, AttitudeIntegrator(body, masses, first, end).at(times), tried


def agree(one: RotationSeries, other: RotationSeries) -> bool:
    """The two are apart by no more than their errors say."""
    return bool(np.all(angle(one.attitude, other.attitude) <= one.error[0, 0] + other.error[0, 0]))


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9, 1e-13])
def test_a_planet_against_dop853(tolerance: float) -> None:
    orbit, body, omega = Ellipse(0.3), rigid(3.3e-3, 2e-5, 27.0), (0.0, 1e-3, 27.0)
    times = np.linspace(0.0, 6.0, 61)
    found = followed(body, orbit.masses(), omega, 6.0, tolerance=tolerance).at(times)
    first = start(body, omega).momentum[:, 0]
    _, turned = attitude_motion(orbit.tide, 3.3e-3, 2e-5, 27.0, first, AS_SKY, times)
    # the other solver is off by 1e-11
    assert np.all(angle(found.attitude, turned) <= found.error[0, 0] + 4e-11)
    assert found.error[0, 0, -1] < 0.1 * tolerance + 1e-12


@pytest.mark.parametrize("wobble", [1e-6, 0.1, 1.0])
def test_a_free_wobble_against_jacobis_closed_form(wobble: float) -> None:
    moments, omega = (0.99, 0.993, 1.0), (wobble, 0.0, 1.0)
    body = of_moments(*moments)
    assert Together(body, ALONE, 1e-13, 300.0).solve(0.0, *states(start(body, omega)))
    times = np.linspace(0.0, 300.0, 101)
    found = followed(body, ALONE, omega, 300.0).at(times)
    true = free_rotation(moments, omega, times)
    assert np.all(angle(found.attitude, true.attitude) <= found.error[0, 0])
    assert found.error[0, 0, -1] < 1e-11


def states(first: State) -> tuple[FloatArray, FloatArray]:
    """States at the start of a body that stands along the sky's axes."""
    columns = np.concatenate([first.momentum, first.attitude, first.core])
    return columns[:, :1], columns


def test_bodies_that_tumble_are_left_to_windows_in_succession() -> None:
    body = of_moments(0.6, 0.75, 1.0)
    for omega in ((0.5, 0.5, 0.5), (1.0, 0.01, 0.01), (1e-3, 1.0, 1e-3)):
        solver = Together(body, ALONE, 1e-13, 100.0)
        assert solver.solve(0.0, *states(start(body, omega))) is None


def test_neighbours_are_away_as_in_windows_in_succession(monkeypatch: pytest.MonkeyPatch) -> None:
    body = rigid(3.3e-3, 2e-5, 27.0)
    changed = np.array([1.0, 1 + 1e-6, 1.0, 1.0])
    body = replace(
        body,
        c_minus_a=body.c_minus_a * changed,
        c_minus_b=body.c_minus_b * changed,
        tide=np.array([1.0, 1.0, 1 + 1e-6, 1.0]),
    )
    first = start(body, (0.0, 1e-3, 27.0)).turned_last(np.array([0.0, 1e-3, 1e-3]), 1e-6)
    together, other, tried = in_both_ways(monkeypatch, body, Ellipse(0.1).masses(), first)
    assert all(tried)
    assert agree(together, other)
    # 2e-13 measured, for 3e-8 rad
    away = abs(together.error[1:, 0, -1] - other.error[1:, 0, -1])
    assert np.all(away < 2e-12 + 1e-3 * other.error[1:, 0, -1])


def test_core_tides_and_further_torques(monkeypatch: pytest.MonkeyPatch) -> None:
    """All that acts, with one body and its neighbour, on a locked moon."""
    core = LiquidCore(moment=7e-4, flattening=1e-2, friction=1e-5, spin=np.array([0.0, 0.0, 1.0]))
    body = rigid(5.2e-4, 2.3e-4).first(copies=2)
    body = replace(
        body,
        tide=np.array([1.0, 1 + 1e-6]),
        zonal=[(3, 1e-4)],
        radius=0.01,
        trend=1e-5,
        core=core,
        custom_torque=lambda times, q, omega: 1e-6 * np.cos(times)[:, np.newaxis] - 1e-6 * omega,
    )
    masses = replace(
        Ellipse(0.055).masses(),
        near=1,
        laws=lambda windows, places: [
            lambda axis, momentum: 1e-6 * cross(places["mass"], momentum) + 1e-7 * axis
        ],
        body_torques=lambda windows, places: [
            lambda matrix, spin: 1e-6 * dot(matrix[:, 0], places["mass"]) * spin
        ],
        inertia_changes=lambda windows, places: [
            lambda matrix, spin: 1e-6 * np.concatenate([spin, spin * dot(places["mass"], spin)])
        ],
    )
    first = start(body, (0.0, 1e-3, 1.0))
    first = replace(first, core=first.core * np.array([[1.0], [1.0], [1.001]]))
    together, other, tried = in_both_ways(monkeypatch, body, masses, first)
    assert all(tried)
    assert agree(together, other)
    assert together.error[0, 0, -1] < 1e-11
    np.testing.assert_allclose(together.core, other.core, rtol=0, atol=1e-14)
    np.testing.assert_allclose(together.omega, other.omega, rtol=0, atol=1e-12)


def test_a_passage_in_between_is_solved_in_succession(monkeypatch: pytest.MonkeyPatch) -> None:
    orbit, body = Ellipse(0.9), rigid(0.2, 0.1)
    together, other, tried = in_both_ways(
        monkeypatch, body, orbit.masses(), start(body, (0.1, 0.0, 1.0)), 14.0
    )
    assert {*tried} == {True, False}
    assert agree(together, other)
