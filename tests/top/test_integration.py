"""Euler's equations with torque, by numerical integration."""

import numpy as np
from scipy.spatial.transform import Rotation

from earthspin.top.start import HeavyTop
from tests.reference.heavy_top import integrate_heavy_top

BODY = {"transverse_moment": 1.25, "axial_moment": 0.75, "weight_moment": 2.0}


def test_a_top_that_precesses_steadily_turns_about_the_vertical() -> None:
    """phi' = 1, theta = pi/2 and I3 omega3 = m g r: exact, with no elliptic function."""
    top = HeavyTop(**BODY, theta=np.pi / 2, phi_rate=1.0, spin=2.0 / 0.75)
    times = np.linspace(0, 10, 40)
    found = Rotation.from_quat(integrate_heavy_top(top, times).attitude[:, [1, 2, 3, 0]])
    angles = np.stack([times, np.full(40, np.pi / 2), times * 2.0 / 0.75], axis=-1)
    off = (found * Rotation.from_euler("ZXZ", angles).inv()).magnitude()
    assert off.max() < 3e-11  # measured 4.1e-12


def test_a_free_sphere_turns_about_a_fixed_axis() -> None:
    top = HeavyTop(
        transverse_moment=1, axial_moment=1, weight_moment=0, theta=0.7, spin=2, theta_rate=1
    )
    times = np.array([0.0, 1.0, 4.0])
    motion = integrate_heavy_top(top, times)
    np.testing.assert_allclose(motion.omega_body, np.tile(motion.omega_body[0], (3, 1)), rtol=1e-15)
    start = Rotation.from_euler("ZXZ", [0.0, 0.7, 0.0])
    exact = Rotation.from_rotvec(np.outer(times, start.apply(motion.omega_body[0]))) * start
    found = Rotation.from_quat(motion.attitude[:, [1, 2, 3, 0]])
    assert (found * exact.inv()).magnitude().max() < 2e-12  # measured 2.5e-13
