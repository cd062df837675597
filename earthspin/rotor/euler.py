"""Euler's equations of rigid-body rotation, with and without torque (I.4).

In the body's principal axes (I.4.3)

    A wx' = Nx - (C - B) wy wz
    B wy' = Ny - (A - C) wz wx
    C wz' = Nz - (B - A) wx wy

Without torque 2T = sum I w^2 and L2 = sum (I w)^2 are constant. The integrator here is independent
of the closed forms and serves to check them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.errors import BodyError, EarthspinError
from earthspin.numerics import quaternion
from earthspin.numerics.arrays import FloatArray
from earthspin.rotor.moments import Moments, finite, principal_moments

#: Function of time (s), omega (rad/s) and attitude that returns the torque along the principal
#: axes, N m.
Torque = Callable[[float, FloatArray, FloatArray], FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class AxisStability:
    """Stability of the free rotation of a body about each of its principal axes.

    Attributes
    ----------
    frequency : ndarray, shape (..., 3)
        Angular frequency of a small disturbance about a stable axis, otherwise 0, rad/s.
    growth_rate : ndarray, shape (..., 3)
        Growth rate of a disturbance about the unstable intermediate axis, otherwise 0, 1/s. Both
        are 0 if another moment is equal; the disturbance then grows at most linearly.
    """

    frequency: FloatArray
    growth_rate: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class IntegratedRotation:
    """Angular velocity and attitude of a numerically integrated rotation.

    Attributes
    ----------
    times : ndarray, shape (n,)
        s.
    omega_body : ndarray, shape (n, 3)
        Along the principal axes, rad/s.
    attitude : ndarray, shape (n, 4)
        Quaternion w, x, y, z from body to inertial axes, of unit length within the
        tolerance; 1, 0, 0, 0 at t = 0.
    evaluations : int
        Number of evaluations of the equations.
    """

    times: FloatArray
    omega_body: FloatArray
    attitude: FloatArray
    evaluations: int


def euler_rates(moments: Moments, omega: Any, torque: Any = 0.0) -> FloatArray:
    """Rate of change of the angular velocity along the principal axes, rad/s2 (I.4.3).

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        As for `principal_moments`, kg m2.
    omega : array_like, shape (..., 3)
        rad/s.
    torque : array_like, shape (..., 3)
        N m, along the principal axes.
    """
    body, w = principal_moments(moments), np.asarray(omega, dtype=np.float64)
    across = w[..., [1, 2, 0]] * w[..., [2, 0, 1]]
    return np.asarray((torque - body.difference.hi * across) / body.values)


def twice_energy(moments: Moments, omega: Any) -> FloatArray:
    """Twice the kinetic energy, 2T = sum of I w^2, J, invariant without torque (I.5.1).

    Parameters
    ----------
    moments, omega
        As for `euler_rates`.
    """
    return np.asarray(np.sum(principal_moments(moments).values * np.square(omega), axis=-1))


def angular_momentum_squared(moments: Moments, omega: Any) -> FloatArray:
    """Squared angular momentum L2 = sum of (I w)^2, kg2 m4/s2, invariant without torque.

    Parameters
    ----------
    moments, omega
        As for `euler_rates`.
    """
    return np.asarray(np.sum((principal_moments(moments).values * omega) ** 2, axis=-1))


def axis_stability(moments: Moments, speed: Any) -> AxisStability:
    """Frequency or growth rate of small disturbances of the rotation about principal axes.

    Linear in the disturbance, Euler's equations give w'' = -q w across axis i, with
    q = speed^2 (Ii - Ij)(Ii - Ik)/(Ij Ik): an oscillation about the largest and the smallest
    moment, exponential growth about the middle one.

    Parameters
    ----------
    moments
        As for `euler_rates`.
    speed : array_like, shape (...)
        Angular velocity about the axis, rad/s.
    """
    body = principal_moments(moments)
    abc, d = body.values, body.difference.hi  # d = (C - B, A - C, B - A)
    # Ii - Ij = d_k and Ii - Ik = -d_j, with i, j, k in cyclic order.
    square = -d[..., [2, 0, 1]] * d[..., [1, 2, 0]] / (abc[..., [1, 2, 0]] * abc[..., [2, 0, 1]])
    rate = np.sqrt(np.abs(square)) * np.abs(np.asarray(speed, dtype=np.float64))[..., np.newaxis]
    return AxisStability(np.where(square > 0, rate, 0.0), np.where(square < 0, rate, 0.0))


def integrate_rotation(
    moments: Moments,
    omega: Any,
    times: Any,
    *,
    torque: Torque | None = None,
    method: str = "DOP853",
    rtol: float = 1e-13,
    atol: float = 1e-15,
) -> IntegratedRotation:
    """Integrate Euler's equations and the attitude of a body numerically (I.4.3).

    Parameters
    ----------
    moments
        Of one body, as for `euler_rates`.
    omega : array_like, shape (3,)
        At t = 0, rad/s.
    times : array_like, shape (n,)
        s, of either sign, in any order.
    torque : callable, optional
        Torque along the principal axes, N m, given time, omega and attitude.
    method : str
        Any method of `scipy.integrate.solve_ivp`.
    rtol, atol : float
        Tolerances; for omega, `atol` is relative to the initial |omega|.

    Raises
    ------
    EarthspinError
        If the integrator fails.
    """
    from scipy.integrate import solve_ivp

    body, t = principal_moments(moments), finite(times, "times", "s")
    start = finite(omega, "omega", "rad/s")
    if start.shape != (3,) or body.values.shape != (3,):
        raise BodyError("rotor", "shape of omega", start.shape, "integrate one body from one start")

    def rates(time: float, state: FloatArray) -> FloatArray:
        w, q = state[:3], state[3:]
        push = 0.0 if torque is None else torque(time, w, q)
        spin = quaternion.multiply(q, np.concatenate([[0.0], w])) / 2
        return np.concatenate([euler_rates(body, w, push), spin])

    floor = atol * np.array([float(np.linalg.norm(start))] * 3 + [1.0] * 4)
    first = np.concatenate([start, [1.0, 0.0, 0.0, 0.0]])
    states = np.tile(first, (t.size, 1))
    evaluations = 0
    for side in (t > 0, t < 0):
        if not np.any(side):
            continue
        stops, place = np.unique(np.abs(t[side]), return_inverse=True)
        stops = stops * np.sign(t[side][0])
        run = solve_ivp(rates, (0.0, stops[-1]), first, method, stops, rtol=rtol, atol=floor)
        if not run.success:
            raise EarthspinError(f"the integration stopped: {run.message}")
        states[side] = run.y.T[place]
        evaluations += int(run.nfev)
    return IntegratedRotation(t, states[:, :3], states[:, 3:], evaluations)
