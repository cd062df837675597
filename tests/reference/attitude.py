r"""Attitude of a body with three different moments of inertia, by integrating its quaternion.

    q' = (1/2) q \omega,     l' = R(q) n_b,     \omega_b = I^{-1} R(q)^T L

with R(q) from the body's axes to the sky's, l = L/(C Omega) in the sky's axes, and the torque
on the body's axes from N = 3 GM/r5 r x I r (I.9.34):

    n_b = 3 ((C - B) Q_yz, (A - C) Q_xz, (B - A) Q_xy)

Nothing is averaged and nothing is assumed slow: any spin, any shape of three moments.
The differences of the moments are given, never formed.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from earthspin.motion.forces import equatorial_basis
from tests.reference.momentum_and_figure import Tide
from tests.reference.stepping import FloatArray, integrate, quaternion_rate


def attitude_motion(
    tide: Tide,
    h: float,
    triaxiality: float,
    spin_rate: float,
    momentum: FloatArray,
    quaternion: FloatArray,
    times: FloatArray,
    *,
    rtol: float = 1e-13,
) -> tuple[FloatArray, FloatArray]:
    """Integrate attitude and angular momentum of a rigid body with SciPy's DOP853.

    Parameters
    ----------
    tide : callable
        Sum of GM r r^T / r^5 in the axes of the sky, shape (3, 3), s-2, at a time in s.
    h : float
        (C - (A + B)/2)/C.
    triaxiality : float
        (B - A)/C; the x axis of the body is that of A.
    spin_rate : float
        Unit of spin, rad/s.
    momentum : ndarray, shape (3,)
        Angular momentum at the first time in the axes of the sky, in units of C Omega.
    quaternion : ndarray, shape (4,)
        Attitude at the first time, scalar first, from the axes of the body to those of the sky.
    times : ndarray, shape (t,)
        Times in the order of integration, s.
    rtol : float
        Relative tolerance of a step.

    Returns
    -------
    momentum : ndarray, shape (t, 3)
    quaternion : ndarray, shape (t, 4)
    """
    c_minus_a, c_minus_b = h + triaxiality / 2, h - triaxiality / 2
    spin_per_momentum = spin_rate / np.array([1 - c_minus_a, 1 - c_minus_b, 1.0])
    torque_scale = 3 / spin_rate * np.array([c_minus_b, -c_minus_a, triaxiality])

    def slope(t: float, state: FloatArray) -> FloatArray:
        matrix = Rotation.from_quat(state[3:], scalar_first=True).as_matrix()
        spin = spin_per_momentum * (state[:3] @ matrix)
        tensor = matrix.T @ tide(t) @ matrix
        torque = torque_scale * np.array([tensor[1, 2], tensor[0, 2], tensor[0, 1]])
        return np.concatenate([matrix @ torque, quaternion_rate(state[3:], spin)])

    start, radian = np.concatenate([momentum, quaternion]), 1 / abs(spin_rate)
    state, _ = integrate(slope, start, times, rtol, begin=times[0], max_step=radian)
    return state[:, :3], state[:, 3:]


def attitude_about(axis: FloatArray, angle: float) -> FloatArray:
    """Attitude quaternion, scalar first, from the third axis and the rotation angle about it.

    Parameters
    ----------
    axis : ndarray, shape (3,)
        Third axis of the body, a unit vector in the axes of the sky.
    angle : float
        Angle of the body's first axis from the first vector of `equatorial_basis`, rad.
    """
    first, second = equatorial_basis(axis)
    x = np.cos(angle) * first + np.sin(angle) * second
    frame = Rotation.from_matrix(np.stack([x, np.cross(axis, x), axis], axis=1))
    return np.asarray(frame.as_quat(scalar_first=True))


def figure_axis(quaternion: FloatArray) -> FloatArray:
    """Third axis of the body in inertial axes, shape (t, 3), from attitude quaternions."""
    return np.asarray(Rotation.from_quat(quaternion, scalar_first=True).as_matrix()[:, :, 2])
