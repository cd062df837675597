"""The table I.7.20, corrected: each row for a free rotor and for a spinning top.

The source's last rows have the constants exchanged: L_z = b I1 and L_z' = a I1 (I.7.7).
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from earthspin.top.closed_form import HeavyTopMotion, heavy_top_motion
from earthspin.top.start import HeavyTop, top_constants

I1, I3, WEIGHT = 1.25, 0.75, 2.0
TIMES = np.linspace(0, 6, 400)
STEP = 1e-3


@pytest.fixture(scope="module")
def top() -> HeavyTop:
    return HeavyTop(
        transverse_moment=I1,
        axial_moment=I3,
        weight_moment=WEIGHT,
        theta=0.9,
        spin=4.0,
        phi_rate=-0.5,
        theta_rate=0.7,
        phi=0.3,
        psi=1.1,
    )


@pytest.fixture(scope="module")
def motion(top: HeavyTop) -> HeavyTopMotion:
    return heavy_top_motion(top, TIMES)


def rates(top: HeavyTop) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """theta', phi', psi' by central differences of eighth order, good to 1e-11."""
    weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    total = np.zeros((3, TIMES.size))
    for k, weight in weights.items():
        ahead, behind = (heavy_top_motion(top, TIMES + s * k * STEP) for s in (1, -1))
        for row, name in enumerate(("theta", "phi", "psi")):
            total[row] += weight * (getattr(ahead, name) - getattr(behind, name)) / STEP
    return total[0], total[1], total[2]


def inertial(motion: HeavyTopMotion, vectors: np.ndarray) -> np.ndarray:
    return Rotation.from_quat(motion.attitude[:, [1, 2, 3, 0]]).apply(vectors)


CLOSE = {"rtol": 0, "atol": 3e-11}  # measured 6.5e-12, from the differences


def test_body_components_of_omega(top: HeavyTop, motion: HeavyTopMotion) -> None:
    theta_rate, phi_rate, psi_rate = rates(top)
    sine, sin, cos = np.sin(motion.theta), np.sin(motion.psi), np.cos(motion.psi)
    one, two, three = motion.omega_body.T
    np.testing.assert_allclose(one, phi_rate * sine * sin + theta_rate * cos, **CLOSE)
    np.testing.assert_allclose(two, phi_rate * sine * cos - theta_rate * sin, **CLOSE)
    np.testing.assert_allclose(three, phi_rate * np.cos(motion.theta) + psi_rate, **CLOSE)
    assert np.all(three == top_constants(top).a * I1 / I3)


def test_size_of_omega(top: HeavyTop, motion: HeavyTopMotion) -> None:
    theta_rate, phi_rate, _ = rates(top)
    a = top_constants(top).a
    square = phi_rate**2 * np.sin(motion.theta) ** 2 + theta_rate**2 + (a * I1 / I3) ** 2
    np.testing.assert_allclose(np.sum(motion.omega_body**2, axis=-1), square, **CLOSE)


def test_rates_of_the_euler_angles(top: HeavyTop, motion: HeavyTopMotion) -> None:
    """I.7.9, I.7.10, and I.7.15 for theta."""
    theta_rate, phi_rate, psi_rate = rates(top)
    a, b, alpha, beta = top_constants(top)
    u, sine = np.cos(motion.theta), np.sin(motion.theta)
    np.testing.assert_allclose(phi_rate, (b - a * u) / sine**2, **CLOSE)
    np.testing.assert_allclose(psi_rate, a * I1 / I3 - u * (b - a * u) / sine**2, **CLOSE)
    right = sine**2 * (alpha - beta * u) - (b - a * u) ** 2
    np.testing.assert_allclose(sine**2 * theta_rate**2, right, **CLOSE)


def test_energy_is_constant_and_kinetic_energy_is_not(motion: HeavyTopMotion) -> None:
    kinetic = np.sum(motion.omega_body**2 * [I1, I1, I3], axis=-1) / 2
    assert np.ptp(kinetic + WEIGHT * np.cos(motion.theta)) < 3e-14  # measured 4.4e-15
    assert np.ptp(kinetic) > 0.1


def test_angular_momentum_along_the_vertical_and_the_axis(
    top: HeavyTop, motion: HeavyTopMotion
) -> None:
    a, b, _, _ = top_constants(top)
    body = motion.omega_body * [I1, I1, I3]
    upward = inertial(motion, body)[:, 2]
    np.testing.assert_allclose(upward, b * I1, rtol=0, atol=1e-14)  # measured 2.0e-15
    np.testing.assert_allclose(body[:, 2], a * I1, rtol=1e-15)
    # as printed, the other way round, neither holds
    assert np.abs(upward - a * I1).min() > 0.1
    assert np.ptp(np.linalg.norm(body, axis=-1)) > 0.1  # and |L| is no constant


def test_inertial_components_of_omega(top: HeavyTop, motion: HeavyTopMotion) -> None:
    theta_rate, phi_rate, psi_rate = rates(top)
    sine, sin, cos = np.sin(motion.theta), np.sin(motion.phi), np.cos(motion.phi)
    one, two, three = inertial(motion, motion.omega_body).T
    np.testing.assert_allclose(one, psi_rate * sine * sin + theta_rate * cos, **CLOSE)
    np.testing.assert_allclose(two, -psi_rate * sine * cos + theta_rate * sin, **CLOSE)
    np.testing.assert_allclose(three, psi_rate * np.cos(motion.theta) + phi_rate, **CLOSE)


@pytest.mark.parametrize("axial", [0.75, 1.25, 2.25])
def test_free_rotor_column(axial: float) -> None:
    """L along z: theta and the rates of phi and psi are constant (I.6.19 to I.6.29)."""
    theta, spin = 0.7, 3.0
    momentum = axial * spin / np.cos(theta)
    top = HeavyTop(
        transverse_moment=I1,
        axial_moment=axial,
        weight_moment=0.0,
        theta=theta,
        spin=spin,
        phi_rate=momentum / I1,
        psi=np.pi / 2,
    )
    motion = heavy_top_motion(top, TIMES)
    alpha = np.arctan2(momentum * np.sin(theta) / I1, spin)
    omega, wobble = spin / np.cos(alpha), spin * (axial - I1) / I1
    close = {"rtol": 0, "atol": 1e-13}  # measured 1.7e-14, of angles up to 42 rad
    np.testing.assert_allclose(motion.theta, theta, **close)
    np.testing.assert_allclose(motion.phi, momentum / I1 * TIMES, **close)
    np.testing.assert_allclose(motion.psi, np.pi / 2 - wobble * TIMES, **close)
    angle = wobble * TIMES
    sin, cos = omega * np.sin(alpha), omega * np.cos(alpha)
    body = np.stack([sin * np.cos(angle), sin * np.sin(angle), cos + 0 * angle], axis=-1)
    np.testing.assert_allclose(motion.omega_body, body, **close)
    across = omega * np.sin(theta - alpha)
    turn = momentum / I1 * TIMES - np.pi / 2
    space = np.stack([across * np.cos(turn), across * np.sin(turn), 0 * turn], axis=-1)
    space[:, 2] = omega * np.cos(theta - alpha)
    np.testing.assert_allclose(inertial(motion, motion.omega_body), space, **close)
    assert np.ptp(np.sum(motion.omega_body**2, axis=-1)) < 2e-13  # measured 2.8e-14
    assert motion.pattern == "steady"
