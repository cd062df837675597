r"""An independent check: angular momentum and figure axis of an axisymmetric body, integrated.

    l' = N(F, t)/(C Omega),     F' = l x F / \tau,     \tau = A/(C Omega)

with l in units of C Omega is exact at any spin, the free wobble included, but F turns once
a day, so that the steps must be short (steps near a day resonate with it). It shares
with `earthspin.motion.axes` the torque's formula and nothing else.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from earthspin.errors import UndefinedError

FloatArray = NDArray[np.float64]

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
    """Integrate the equations above with scipy's DOP853.

    Parameters
    ----------
    tide : callable
        Sum of GM r r^T / r^5, s-2.
    h : float
        (C - A)/C.
    spin_rate : float
        About the figure axis, rad/s.
    momentum, figure : ndarray, shape (3,)
        At the first time: angular momentum in units of C Omega, and unit figure axis.
    times : ndarray, shape (t,)
        s, in the order of integration.
    rtol : float
        Relative tolerance of a step.

    Returns
    -------
    momentum, figure : ndarray, shape (t, 3)
    """
    tau = (1 - h) / spin_rate
    torque_scale = 3 * h / spin_rate

    def slope(t: float, state: FloatArray) -> FloatArray:
        lx, ly, lz, fx, fy, fz = state
        qx, qy, qz = tide(t) @ state[3:]
        return np.array(
            [
                torque_scale * (qy * fz - qz * fy),
                torque_scale * (qz * fx - qx * fz),
                torque_scale * (qx * fy - qy * fx),
                (ly * fz - lz * fy) / tau,
                (lz * fx - lx * fz) / tau,
                (lx * fy - ly * fx) / tau,
            ]
        )

    state = integrate(slope, np.concatenate([momentum, figure]), times, rtol, abs(tau))
    axis = state[:, 3:]
    return state[:, :3], axis / np.linalg.norm(axis, axis=1, keepdims=True)


def integrate(
    slope: Callable[[float, FloatArray], FloatArray],
    start: FloatArray,
    times: FloatArray,
    rtol: float,
    radian: float,
) -> FloatArray:
    """DOP853 through the times given, shape (t, state).

    Parameters
    ----------
    slope : callable
        Time and state to rate of the state.
    start : ndarray
    times : ndarray, shape (t,)
    rtol : float
        Relative and absolute tolerance: states are of order 1.
    radian : float
        Time in which the fastest mode turns by a radian, s; no step is longer than that.
    """
    result = solve_ivp(
        slope,
        (times[0], times[-1]),
        start,
        method="DOP853",
        t_eval=times,
        rtol=rtol,
        atol=rtol,
        max_step=radian,
    )
    if not result.success:
        raise UndefinedError(f"the integration stopped at {result.t[-1]:.6g} s: {result.message}")
    return np.asarray(result.y.T)
