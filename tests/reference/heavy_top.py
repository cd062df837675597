"""Motion of a heavy top by numerical integration of Euler's equations (I.4.3).

It is an independent check of the closed form, with which it shares only the initial state.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from earthspin.top.start import HeavyTop
from tests.reference.stepping import FloatArray, integrate, quaternion_rate


class IntegratedMotion(NamedTuple):
    """Numerically integrated motion of one heavy top: attitude and angular velocity.

    Attributes
    ----------
    attitude : ndarray, shape (n, 4)
        Unit quaternion w, x, y, z, body to inertial.
    omega_body : ndarray, shape (n, 3)
        Angular velocity along the principal axes of the body, rad/s.
    evaluations : int
        Number of evaluations of the equations.
    """

    attitude: FloatArray
    omega_body: FloatArray
    evaluations: int


def integrate_heavy_top(
    top: HeavyTop, times: ArrayLike, *, relative_tolerance: float = 1e-13
) -> IntegratedMotion:
    """Integrate Euler's equations of one top with the torque of its weight (I.4.3).

    Parameters
    ----------
    top : HeavyTop
        One top.
    times : ndarray, shape (n,)
        Ascending times from the start at t = 0, s.
    relative_tolerance : float
        Relative tolerance of each step of the eighth-order Runge-Kutta method.

    Returns
    -------
    IntegratedMotion
    """
    times = np.atleast_1d(np.asarray(times, dtype=np.float64))
    across = top.phi_rate * np.sin(top.theta)
    omega, attitude = state_of_angles(top.theta, top.phi, top.psi, across, top.theta_rate, top.spin)
    scale = np.abs(omega).max() + np.sqrt(abs(top.weight_moment) / top.transverse_moment)
    state, evaluations = integrate(
        lambda _, state: _rates(state, top),
        np.concatenate([attitude, omega]),
        times,
        relative_tolerance,
        atol=relative_tolerance * np.array([1.0] * 4 + [scale or 1.0] * 3),
    )
    attitude = state[:, :4]
    norm = np.sqrt(np.sum(attitude**2, axis=-1, keepdims=True))
    return IntegratedMotion(attitude / norm, state[:, 4:], evaluations)


def state_of_angles(
    theta: FloatArray,
    phi: FloatArray,
    psi: FloatArray,
    across: FloatArray,
    theta_rate: FloatArray,
    spin: ArrayLike,
) -> tuple[FloatArray, FloatArray]:
    """Angular velocity (I.7.3) and attitude of a top, from Euler angles and their rates.

    The attitude is Rz(phi) Rx(theta) Rz(psi).

    Parameters
    ----------
    theta, phi, psi : ndarray
        Euler angles, rad.
    across : ndarray
        Rate of phi times sin(theta), rad/s.
    theta_rate, spin : ndarray
        rad/s.

    Returns
    -------
    omega : ndarray, shape (..., 3)
    attitude : ndarray, shape (..., 4)
    """
    omega = (
        across * np.sin(psi) + theta_rate * np.cos(psi),
        across * np.cos(psi) - theta_rate * np.sin(psi),
        np.full_like(theta, spin),
    )
    angles = np.stack(np.broadcast_arrays(phi, theta, psi), axis=-1)
    attitude = Rotation.from_euler("ZXZ", angles).as_quat(scalar_first=True)
    return np.stack(omega, axis=-1), attitude


def _rates(state: FloatArray, top: HeavyTop) -> list[Any]:
    """Rates of change of attitude quaternion and angular velocity of a top under its weight.

    The torque is m g r z' x (-z), where z' is the axis of the top and z the vertical.
    """
    w, x, y, z, p, q, r = state
    i1, i3 = float(top.transverse_moment), float(top.axial_moment)
    weight = float(top.weight_moment)
    up_1, up_2 = 2 * (x * z - w * y), 2 * (y * z + w * x)  # the vertical in the body
    return [
        *quaternion_rate(state[:4], state[4:]),
        (weight * up_2 + q * r * (i1 - i3)) / i1,
        (-weight * up_1 + r * p * (i3 - i1)) / i1,
        0.0,
    ]
