r"""Angular momentum and figure axis of an axisymmetric body by numerical integration.

    l' = N(F, t)/(C Omega),     F' = l x F / \tau,     \tau = A/(C Omega)

With l in units of C Omega, these equations are exact at any spin and include the free wobble.
Because F rotates about once a day, the steps must be short (steps near a day resonate with it). The
solver shares only the formula of the torque with `earthspin.motion.axes`.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from tests.reference.stepping import FloatArray, integrate

#: Tidal tensor, shape (3, 3), s-2, at a time in s.
Tide = Callable[[float], FloatArray]


def axisymmetric_motion(
    tide: Tide,
    h: float,
    spin_rate: float,
    momentum: FloatArray,
    figure: FloatArray,
    times: FloatArray,
    *,
    rtol: float = 1e-13,
) -> tuple[FloatArray, FloatArray]:
    """Integrate angular momentum and figure axis of an axisymmetric body with SciPy's DOP853.

    Parameters
    ----------
    tide : callable
        Sum of GM r r^T / r^5, s-2.
    h : float
        (C - A)/C.
    spin_rate : float
        Angular velocity about the figure axis, rad/s.
    momentum, figure : ndarray, shape (3,)
        Angular momentum in units of C Omega and unit figure axis at the first time.
    times : ndarray, shape (t,)
        Times in the order of integration, s.
    rtol : float
        Relative tolerance of a step.

    Returns
    -------
    momentum, figure : ndarray, shape (t, 3)
    """
    start = np.concatenate([momentum, figure])
    state, _ = integrate(
        lambda t, state: slopes(state, tide(t) @ state[3:], h, spin_rate),
        start, times, rtol, begin=times[0], max_step=abs((1 - h) / spin_rate),
    )  # fmt: skip
    axis = state[:, 3:]
    return state[:, :3], axis / np.linalg.norm(axis, axis=1, keepdims=True)


def slopes(state: Any, pull: Any, h: float, spin_rate: float) -> list[Any]:
    """Rates of change of angular momentum and figure axis, s-1, for numbers or symbols.

    Parameters
    ----------
    state : six numbers
    pull : three numbers
        Tidal tensor times the figure axis, s-2.
    h, spin_rate : float
        See `axisymmetric_motion`.
    """
    tau = (1 - h) / spin_rate
    torque_scale = 3 * h / spin_rate
    lx, ly, lz, fx, fy, fz = state
    qx, qy, qz = pull
    return [
        torque_scale * (qy * fz - qz * fy),
        torque_scale * (qz * fx - qx * fz),
        torque_scale * (qx * fy - qy * fx),
        (ly * fz - lz * fy) / tau,
        (lz * fx - lx * fz) / tau,
        (lx * fy - ly * fx) / tau,
    ]
