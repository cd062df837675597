"""The motion: invariants, poles, pendulums, batches, and numerical integration."""

from typing import Any

import mpmath as mp
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from earthspin.numerics.arrays import FloatArray
from earthspin.top.closed_form import HeavyTopMotion, heavy_top_motion
from earthspin.top.start import HeavyTop, top_constants
from tests.conftest import load_pins
from tests.reference.heavy_top import integrate_heavy_top
from tests.top.families import cases

PINS = load_pins("top")
#: The top that the pins of tests/reference/top.json are for, and a time in seconds.
PINNED = {
    "transverse_moment": 0.002,
    "axial_moment": 0.0008,
    "weight_moment": 0.06,
    "theta": 0.5,
    "spin": 70.0,
    "phi_rate": 1.25,
    "theta_rate": -0.75,
}
PINNED_TIME = 1.625

BODY = {"transverse_moment": 1.25, "axial_moment": 0.75, "weight_moment": 2.0}


def invariants(top: HeavyTop, motion: HeavyTopMotion) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Energy, L_z and |q| of one top, from attitude and angular velocity alone."""
    w, x, y, z = motion.attitude.T
    up = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z], -1)
    momentum = motion.omega_body * [top.transverse_moment, top.transverse_moment, top.axial_moment]
    kinetic = np.sum(momentum * motion.omega_body, axis=-1) / 2
    upward = np.sum(momentum * up, axis=-1)
    return kinetic + top.weight_moment * up[:, 2], upward, np.sqrt(w * w + x * x + y * y + z * z)


@pytest.mark.parametrize("name", ["theta", "phi", "psi", "nutation_period", "precession_rate"])
def test_pinned_motion(name: str) -> None:
    motion = heavy_top_motion(HeavyTop(**PINNED), PINNED_TIME)
    PINS[name].check(getattr(motion, name))


def test_pinned_turning_angles() -> None:
    motion = heavy_top_motion(HeavyTop(**PINNED), PINNED_TIME)
    PINS["theta1"].check(motion.turning_angle[0])
    PINS["theta2"].check(motion.turning_angle[1])


@pytest.mark.parametrize(
    "family", ["generic", "fast", "near-steady", "cusp", "near-pole", "weightless", "pendulum"]
)
def test_invariants_hold_over_ten_thousand_nutations(family: str) -> None:
    phases = np.sort(np.random.default_rng(5).uniform(0, 1e4, 200))
    for start in cases(family, 40):
        top = HeavyTop(**start)
        period = float(heavy_top_motion(top, 0.0).nutation_period)
        motion = heavy_top_motion(top, phases * period)
        energy, upward, unit = invariants(top, motion)
        i1, i3 = top.transverse_moment, top.axial_moment
        fastest = np.sqrt(np.sum(motion.omega_body[:, :2] ** 2, axis=-1).max())
        size = (i1 * fastest**2 + i3 * top.spin**2) / 2 + np.abs(top.weight_moment)
        # measured 2.0e-15, 1.2e-15 and 4.5e-16
        assert np.ptp(energy) <= 1e-14 * size
        assert np.ptp(upward) <= 1e-14 * (i1 * fastest + i3 * np.abs(top.spin))
        assert np.all(np.abs(unit - 1) < 2e-15)
        assert np.all(motion.omega_body[:, 2] == top.spin)


@pytest.mark.parametrize("family", ["generic", "cusp", "pendulum", "near-pole", "weightless"])
def test_the_full_equations_integrated_agree(family: str) -> None:
    """Euler's equations with torque (I.4.3) by DOP853, which holds 1e-10 here."""
    for start in cases(family, 4):
        top = HeavyTop(**start)
        period = float(heavy_top_motion(top, 0.0).nutation_period)
        times = np.linspace(0, 2.5 * period, 12)
        found, other = heavy_top_motion(top, times), integrate_heavy_top(top, times)
        assert np.abs(found.attitude - other.attitude).max() < 5e-10  # measured 6.6e-11
        size = np.abs(other.omega_body).max()
        assert np.abs(found.omega_body - other.omega_body).max() < 5e-11 * size  # 5.4e-12


@pytest.mark.parametrize("weight", [2.0, -2.0, 0.0])
@pytest.mark.parametrize(
    "start",
    [
        {"theta": 0.0, "theta_rate": 1.0, "spin": 1.0},
        {"theta": 0.0, "theta_rate": -1.0, "spin": 1.0},
        {"theta": np.pi, "theta_rate": 2.0, "spin": 0.5},
        {"theta": np.pi, "theta_rate": -2.0, "spin": 0.5},
        {"theta": np.pi, "theta_rate": 9.0, "spin": 0.0},
        {"theta": 1.0, "spin": 0.0},
        {"theta": 2.5, "theta_rate": 7.0, "spin": 0.0},
        {"theta": np.pi / 2, "spin": 3.0},
        {"theta": np.pi / 2, "spin": 0.0, "phi_rate": 0.8},
    ],
)
def test_poles_pendulums_and_level_tops_are_answers(start: dict[str, float], weight: float) -> None:
    """The attitude goes smoothly over the poles, where phi and psi jump by pi."""
    top = HeavyTop(**BODY | {"weight_moment": weight, "phi": 0.3, "psi": -0.8} | start)
    times = np.linspace(0, 12, 300)
    found, other = heavy_top_motion(top, times), integrate_heavy_top(top, times)
    assert np.abs(found.attitude - other.attitude).max() < 2e-11  # measured 2.0e-12
    assert np.abs(found.omega_body - other.omega_body).max() < 4e-11  # measured 4.7e-12
    assert found.phi[0] == pytest.approx(0.3, abs=1e-15)
    assert found.psi[0] == pytest.approx(-0.8, abs=1e-15)


def test_attitude_is_the_rotation_of_the_euler_angles() -> None:
    for start in cases("generic", 10):
        motion = heavy_top_motion(HeavyTop(**start, phi=0.4, psi=2.0), np.linspace(-2, 2, 50))
        angles = np.stack([motion.phi, motion.theta, motion.psi], axis=-1)
        exact = Rotation.from_euler("ZXZ", angles).as_matrix()
        found = Rotation.from_quat(motion.attitude[:, [1, 2, 3, 0]]).as_matrix()
        assert np.abs(found - exact).max() < 2e-14  # measured 2.6e-15


def test_omega_is_that_of_the_euler_rates() -> None:
    """I.7.3, with theta' and phi' from the constants."""
    top = HeavyTop(**BODY, theta=0.9, spin=3.0, phi_rate=-0.4, theta_rate=0.6, psi=1.0)
    a, b, alpha, beta = top_constants(top)
    motion = heavy_top_motion(top, np.linspace(0, 5, 200))
    u, sine = np.cos(motion.theta), np.sin(motion.theta)
    phi_rate = (b - a * u) / sine**2
    one, two, three = motion.omega_body.T
    sin, cos = np.sin(motion.psi), np.cos(motion.psi)
    np.testing.assert_allclose(one * sin + two * cos, phi_rate * sine, rtol=0, atol=1e-14)
    theta_rate = one * cos - two * sin
    square = alpha - beta * u - phi_rate**2 * sine**2
    np.testing.assert_allclose(theta_rate**2, square, rtol=0, atol=3e-14)
    step = 1e-6
    ahead = heavy_top_motion(top, np.linspace(0, 5, 200) + step)
    np.testing.assert_allclose(theta_rate, (ahead.theta - motion.theta) / step, rtol=0, atol=1e-5)
    assert np.all(three == 3.0)


def test_plane_pendulum_is_the_textbook_one() -> None:
    """Swinging, over the top, and almost on the separatrix: sin(half angle) = k sn."""
    i1, weight = BODY["transverse_moment"], BODY["weight_moment"]
    natural = mp.sqrt(mp.mpf(weight) / i1)
    for start_rate in (1.0, 2 * float(natural) * (1 - 1e-12), 2 * float(natural) * 1.3):
        top = HeavyTop(**BODY, theta=np.pi, theta_rate=-start_rate, spin=0.0)
        times = np.array([0.1, 0.9, 2.3, 5.1])
        found = heavy_top_motion(top, times).theta
        with mp.workdps(50):
            k = mp.mpf(start_rate) / (2 * natural)
            for moment, theta in zip(times, found, strict=True):
                if k < 1:
                    sine = k * mp.ellipfun("sn", natural * moment, m=k**2)
                else:
                    sine = mp.ellipfun("sn", natural * k * moment, m=1 / k**2)
                exact = mp.pi - 2 * abs(mp.asin(sine))
                # next to the separatrix one unit of the rate moves theta by 4e-13
                assert abs(float(theta / exact - 1)) < (2e-12 if abs(k - 1) < 1e-9 else 1e-14)


def test_on_the_separatrix_the_pendulum_comes_to_the_top_for_ever() -> None:
    """From rest at the very top plus nothing: theta' = 2 omega0 cos(half angle) is met exactly."""
    top = HeavyTop(transverse_moment=1, axial_moment=1, weight_moment=1, theta=np.pi, spin=0)
    going = HeavyTop(
        transverse_moment=1, axial_moment=1, weight_moment=1, theta=np.pi, spin=0, theta_rate=-2
    )
    times = np.array([0.0, 0.5, 1.0, 3.0, 15.0, 30.0])
    motion = heavy_top_motion(going, times)
    assert motion.nutation_period == np.inf
    exact = 4 * np.arctan(np.exp(-times))
    np.testing.assert_allclose(motion.theta, exact, rtol=4e-15)
    assert heavy_top_motion(top, 1.0).theta == np.pi


def test_a_top_is_the_same_to_the_bit_among_others() -> None:
    """Each takes its own number of steps down to the circle; near the separatrix it takes more."""
    starts = [*cases("generic", 40), *cases("near-separatrix", 20)]
    fields = {k: np.reshape([s.get(k, 0.0) for s in starts], (20, 3)) for k in _fields(starts)}
    times = np.linspace(-1, 9, 8).reshape(4, 2)
    together = heavy_top_motion(HeavyTop(**fields), times)
    for index, start in enumerate(starts):
        alone, where = heavy_top_motion(HeavyTop(**start), times), divmod(index, 3)
        for name in (
            *("theta", "phi", "psi", "attitude", "omega_body"),
            *("precession_rate", "turning_angle", "pattern", "nutation_period"),
        ):
            np.testing.assert_array_equal(getattr(together, name)[where], getattr(alone, name))


def test_one_top_at_one_time_gives_numbers() -> None:
    motion = heavy_top_motion(HeavyTop(**PINNED), 0.25)
    assert motion.theta.shape == motion.pattern.shape == motion.precession_rate.shape == ()
    assert motion.attitude.shape == (4,)


def test_a_motion_taken_up_again_goes_on_as_it_was() -> None:
    for start in cases("generic", 10):
        first = heavy_top_motion(HeavyTop(**start), [0.8, 1.7])
        one, two, spin = first.omega_body[0]
        sin, cos = np.sin(first.psi[0]), np.cos(first.psi[0])
        again = start | {
            "theta": first.theta[0],
            "phi": first.phi[0],
            "psi": first.psi[0],
            "theta_rate": one * cos - two * sin,
            "phi_rate": (one * sin + two * cos) / np.sin(first.theta[0]),
            "spin": spin,
        }
        second = heavy_top_motion(HeavyTop(**again), 1.7 - 0.8)
        same = Rotation.from_quat(first.attitude[1]).inv() * Rotation.from_quat(second.attitude)
        assert same.magnitude() < 2e-14  # measured 2.4e-15


def _fields(starts: list[dict[str, Any]]) -> set[str]:
    return {name for start in starts for name in start}
