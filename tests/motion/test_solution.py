"""The whole attitude in time, held against closed forms and against other solvers."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy.special import ellipj, ellipk

from earthspin.errors import UndefinedError
from earthspin.motion.equations import Equations, Perturbers
from earthspin.motion.solution import AttitudeIntegrator
from earthspin.numerics import rotations
from earthspin.rotor.triaxial import free_rotation
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.start import HeavyTop
from tests.motion.kepler import ALONE, AS_SKY, Ellipse, angle, followed, of_moments, rigid, start
from tests.reference.attitude import attitude_motion

#: H, (B - A)/C, spin and eccentricity: a tumbling moon, a moon that keeps its face, a fast planet.
WORLDS = {
    "hyperion": (0.29, 0.29, (0.3, 0.2, 1.5), 0.1),
    "moon": (5.2e-4, 2.3e-4, (0.0, 1e-3, 1.0), 0.055),
    "planet": (3.3e-3, 2.2e-5, (0.0, 1e-3, 27.0), 0.02),
    "backward": (1e-2, 1e-3, (0.0, 0.1, -5.0), 0.2),
}


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9, 1e-13])
def test_without_torque_against_jacobis_closed_form(tolerance: float) -> None:
    """The error that is claimed holds, and is no more than a thousand times too large."""
    moments, omega, times = (1.0, 1.7, 2.4), (0.5, 0.2, 0.8), np.linspace(0, 100, 201)
    true = free_rotation(moments, omega, times)
    found = followed(of_moments(*moments), ALONE, omega, 100.0, tolerance=tolerance).at(times)
    claimed = found.error[0, 0]
    assert np.all(angle(found.attitude, true.attitude) <= claimed)
    # 9.6e-9, 2.8e-12 and 8e-14 measured
    assert claimed[-1] < max(0.05 * tolerance, 1e-12)
    spin = np.linalg.norm(found.omega - true.omega_body, axis=1)
    assert np.all(spin <= found.error[0, 1] + 1e-15)


@given(
    st.tuples(*[st.floats(1.0, 3.0)] * 3),
    st.tuples(*[st.floats(-2.0, 2.0)] * 3),
    st.sampled_from([1e-7, 1e-10, 1e-13]),
)
@example((1.0, 1.375, 1.5), (0.0, 1.0, 0.0078125), 1e-7)  # beside the middle axis
@settings(max_examples=25, deadline=None)
def test_what_is_claimed_holds_for_any_free_body(
    moments: tuple[float, float, float], omega: tuple[float, float, float], tolerance: float
) -> None:
    a, b, c = sorted(moments)
    assume(a + b > 1.01 * c and np.linalg.norm(omega) > 0.1)
    times = np.linspace(0.0, 20.0, 41)
    true = free_rotation((a, b, c), omega, times)
    found = followed(of_moments(a, b, c), ALONE, omega, 20.0, tolerance=tolerance).at(times)
    # the closed form itself has rounding errors
    assert np.all(angle(found.attitude, true.attitude) <= found.error[0, 0] + 2e-13)


@pytest.mark.parametrize("world", WORLDS)
def test_under_a_tide_against_dop853(world: str) -> None:
    h, triaxiality, omega, eccentricity = WORLDS[world]
    orbit, unit = Ellipse(eccentricity), float(np.max(np.abs(omega)))
    body = rigid(h, triaxiality, unit)
    times = np.linspace(0.0, 12.0, 25)
    found = followed(body, orbit.masses(), omega, 12.0).at(times)
    momentum, turned = attitude_motion(
        orbit.tide, h, triaxiality, unit, start(body, omega).momentum[:, 0], AS_SKY, times
    )
    # the other solver's steps: 3e-13 to 9e-12 measured
    assert np.max(angle(found.attitude, turned)) < 4e-11
    np.testing.assert_allclose(found.momentum, momentum, rtol=0, atol=1e-11)
    assert found.error[0, 0, -1] < 1e-12


def test_a_locked_moon_swings_as_a_pendulum() -> None:
    """In the plane of a circular orbit, 2 (theta - t) is a pendulum (elliptic functions)."""
    triaxiality, amplitude = 0.1, 0.6
    body = rigid(0.2, triaxiality)
    strength = np.sqrt(3 * triaxiality)
    # at theta - t = 0 with the speed that reaches the amplitude
    speed = strength * np.sin(amplitude)
    times = np.linspace(0.0, 60.0, 121)
    found = followed(body, Ellipse().masses(), (0.0, 0.0, 1.0 + speed), 60.0).at(times)
    m = np.sin(amplitude) ** 2
    swing = np.arcsin(np.sqrt(m) * ellipj(strength * times, m)[0])
    half = (times + swing) / 2
    true = np.stack([np.cos(half), 0 * half, 0 * half, np.sin(half)], axis=1)
    assert np.max(angle(found.attitude, true)) < 1e-12  # 1.5e-13 measured
    assert 4 * ellipk(m) / strength < 20  # several swings


def test_a_torque_of_ones_own_makes_a_heavy_top() -> None:
    """Against elliptic functions: gravity on the axis, along the body's axes."""
    top = HeavyTop(transverse_moment=1.0, axial_moment=1.2, weight_moment=1.5, theta=0.7, spin=3.0)
    times = np.linspace(0.0, 30.0, 61)
    true = heavy_top_motion(top, times)

    def gravity(times: np.ndarray, q: np.ndarray, omega: np.ndarray) -> np.ndarray:
        w, x, y, z = q.T
        up = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1)
        return 1.5 / 1.2 * np.cross(up, [0.0, 0.0, 1.0])

    body = of_moments(1.0, 1.0, 1.2, custom_torque=gravity)
    motion = AttitudeIntegrator(
        body, ALONE, start(body, tuple(true.omega_body[0]), true.attitude[0]), 30.0
    )
    found = motion.at(times)
    assert np.max(angle(found.attitude, true.attitude)) < 3e-12  # 6e-13 measured
    np.testing.assert_allclose(found.omega, true.omega_body, rtol=0, atol=1e-11)


def test_friction_slows_a_spin_as_it_should() -> None:
    body = of_moments(1.0, 1.5, 2.0, custom_torque=lambda times, q, omega: -0.1 * omega)
    times = np.linspace(0.0, 50.0, 11)
    found = followed(body, ALONE, (0.0, 0.0, 2.0), 50.0).at(times)
    np.testing.assert_allclose(found.omega[:, 2], 2 * np.exp(-0.1 * times), rtol=1e-13, atol=0)


def test_a_close_passage_is_met_with_short_windows() -> None:
    """An orbit of eccentricity 0.95: the tide changes by 6e4 within a thousandth of it."""
    orbit, body = Ellipse(0.95), rigid(0.2, 0.1)
    times = np.array([0.0, 3.0, 6.0, 6.28, 6.3, 7.0, 9.0])
    motion = followed(body, orbit.masses(), (0.1, 0.0, 1.0), 9.0)
    found = motion.at(times)
    _, turned = attitude_motion(
        orbit.tide, 0.2, 0.1, 1.0, start(body, (0.1, 0.0, 1.0)).momentum[:, 0], AS_SKY, times
    )
    difference = angle(found.attitude, turned)
    assert difference[-1] < 1e-8
    assert found.error[0, 0, -1] < 1e-10
    assert np.all(difference < 100 * found.error[0, 0] + 1e-11)


def test_times_are_asked_for_in_any_pieces() -> None:
    orbit, body = Ellipse(0.1), rigid(0.29, 0.29)
    times = np.linspace(0.0, 40.0, 301)
    whole = followed(body, orbit.masses(), (0.3, 0.2, 1.5), 40.0).at(times)
    motion = followed(body, orbit.masses(), (0.3, 0.2, 1.5), 40.0)
    for part in np.array_split(np.arange(301), 7):
        found = motion.at(times[part])
        assert np.array_equal(found.attitude, whole.attitude[part])
        assert np.array_equal(found.error, whole.error[..., part])
    # from the start again
    assert np.array_equal(motion.at(times[:9]).attitude, whole.attitude[:9])


def test_both_forms_have_the_same_rates() -> None:
    """Where a window begins, angular momentum and attitude change alike, in space and in the body.

    With effects on the angular momentum and a harmonic of the body's figure.
    """
    body = replace(rigid(0.2, 0.1, 1.3), zonal=[(3, 0.01), (4, -0.02)], radius=0.2, trend=0.5)
    turn = np.array([0.1, 0.7, -0.3, 0.6])
    turn /= np.linalg.norm(turn)
    place = np.array([[[1.2]], [[-0.3]], [[0.4]]])
    masses = Perturbers(
        np.array([2.0]), np.array([0.9]), place, 1, [lambda axis, momentum: 0.3 * axis + momentum]
    )
    state = start(body, (0.3, -0.2, 0.9), turn)
    matrix = rotations.matrices(state.attitude)[:, :, 0]
    seen = np.concatenate([state.momentum, state.attitude])
    in_sky = np.concatenate([matrix @ state.momentum, state.attitude])
    since = np.zeros(1)
    of_body = Equations(body, masses, False, seen, since).rates(seen)[:3, 0]
    of_sky = Equations(body, masses, True, in_sky, since).rates(in_sky)[:3, 0]
    # l' = R (m' + omega x m)
    carried = of_body + np.cross(state.spin[:, 0], state.momentum[:, 0])
    np.testing.assert_allclose(of_sky, matrix @ carried, rtol=0, atol=1e-14)


def test_a_torque_that_runs_away_is_refused() -> None:
    body = of_moments(1.0, 1.5, 2.0, custom_torque=lambda times, q, omega: omega**3)
    with pytest.raises(UndefinedError, match="changes too fast"):
        followed(body, ALONE, (0.0, 0.0, 1.0), 10.0).at(np.array([0.0, 10.0]))


def test_the_error_of_a_tumbling_body_grows_to_half_a_turn_and_says_so() -> None:
    orbit, body = Ellipse(0.1), rigid(0.29, 0.29)
    times = np.linspace(0.0, 500.0, 4001)
    found = followed(body, orbit.masses(), (0.5, 0.3, 1.5), 500.0, tolerance=1e-10).at(times)
    error = found.error[0, 0]
    # never much below what it has been; between the ends of windows it may have been more
    assert np.all(error >= 0.3 * np.maximum.accumulate(error))
    assert error[40] < 1e-8
    assert error[-1] > 1.0
