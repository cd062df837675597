"""Principal moments of inertia, and Euler's equations of rigid-body rotation (I.4).

The integrator is independent of the closed forms and serves to check them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.errors import BodyError, EarthspinError
from earthspin.numerics import quaternion
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.double_double import DoubleDouble, as_double_double, stack, two_sum

# --- principal moments ----------------------------------------------------------------------------
# A torque-free motion depends on the differences of the moments. Computed from rounded moments,
# they lose five of sixteen digits for the Earth, so they may be given directly:
#
#     [A, B, C]                                 three numbers, in any order of size
#     {"A": ..., "B-A": ..., "C-A": ...}        full precision
#
# A, B and C belong to the x, y and z axes of the body, in any order of size. For a nearly
# axisymmetric body, A should be one of the two nearly equal moments.

#: Three numbers, a mapping with the keys of `KEYS`, or a `PrincipalMoments`.
Moments = Any

KEYS = ("A", "B-A", "C-A")
#: Tolerance of C <= A + B for rounding errors, relative to C; a lamina has C = A + B.
_LAMINA = 4 * np.finfo(float).eps


@dataclass(frozen=True, slots=True, eq=False)
class PrincipalMoments:
    """Principal moments of inertia and their differences, as double-double numbers.

    Attributes
    ----------
    moment : DoubleDouble, shape (..., 3)
        A, B, C about the x, y, z axes of the body, kg m2 (or any unit).
    difference : DoubleDouble, shape (..., 3)
        C - B, A - C, B - A: the factors of Euler's equations (I.4.3).
    """

    moment: DoubleDouble
    difference: DoubleDouble

    @property
    def values(self) -> FloatArray:
        """Principal moments of inertia A, B, C as floats, kg m2, shape (..., 3)."""
        return np.asarray(self.moment.hi)


def principal_moments(moments: Moments) -> PrincipalMoments:
    """Convert input to principal moments of inertia; raise an error if no body can have them.

    Parameters
    ----------
    moments : sequence of three numbers, mapping, or PrincipalMoments
        A, B, C, as array of shape (..., 3) for many bodies; or ``{"A", "B-A", "C-A"}``,
        whose values broadcast against each other; kg m2.

    Returns
    -------
    PrincipalMoments

    Raises
    ------
    BodyError
        If a moment is not positive, or exceeds the sum of the other two.
    """
    if isinstance(moments, PrincipalMoments):
        return moments
    read = _from_differences if isinstance(moments, Mapping) else _from_three
    body = read(moments)
    _check(body)
    return body


def _from_differences(moments: Mapping[str, Any]) -> PrincipalMoments:
    if set(moments) != set(KEYS):
        raise BodyError(
            "rotor", "moments", sorted(map(str, moments)), f"the keys are {', '.join(KEYS)}"
        )
    parts = [finite(moments[key], key, "kg m2") for key in KEYS]
    try:
        a, b_a, c_a = np.broadcast_arrays(*parts)
    except ValueError:
        shapes = [array.shape for array in parts]
        rule = "A, B-A and C-A must have shapes that broadcast together"
        raise BodyError("rotor", "shape of moments", shapes, rule) from None
    zero = np.zeros_like(a)
    exact_a, towards_b, towards_c = (DoubleDouble(x, zero) for x in (a, b_a, c_a))
    return PrincipalMoments(
        stack(exact_a, exact_a + towards_b, exact_a + towards_c),
        stack(towards_c - towards_b, -towards_c, towards_b),
    )


def _from_three(moments: Any) -> PrincipalMoments:
    abc = finite(moments, "moments", "kg m2")
    if abc.ndim == 0 or abc.shape[-1] != 3:
        raise BodyError("rotor", "shape of moments", abc.shape, "give three numbers, A, B, C")
    a, b, c = np.moveaxis(abc, -1, 0)
    return PrincipalMoments(
        as_double_double(abc),
        stack(*(DoubleDouble(*two_sum(x, -y)) for x, y in ((c, b), (a, c), (b, a)))),
    )


def _check(moments: PrincipalMoments) -> None:
    values = moments.values
    for axis, name in enumerate("ABC"):
        moment = values[..., axis]
        if not np.all(moment > 0):
            raise BodyError(
                "rotor", name, float(np.min(moment)), "a principal moment must be positive"
            )
    for axis, name in enumerate("ABC"):
        moment = values[..., axis]
        # Ij + Ik - Ii, with the original difference Ij - Ii
        room = values[..., axis - 1] + moments.difference.hi[..., axis - 1]
        if np.any(room < -_LAMINA * moment):
            index = np.unravel_index(np.argmin(room / moment), moment.shape)
            others = " + ".join(f"{values[(*index, i)]:.16g}" for i in range(3) if i != axis)
            rule = f"no principal moment may exceed the sum of the other two, here {others}"
            raise BodyError("rotor", name, float(moment[index]), rule)


def finite(values: Any, name: str, unit: str) -> FloatArray:
    """Convert an input to an array of floats; raise an error for infinite or missing values.

    Parameters
    ----------
    values : array_like
    name, unit : str
        Name and unit of the input, for messages.
    """
    try:
        numbers = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise BodyError("rotor", name, values, f"give numbers, in {unit}") from None
    infinite = numbers[~np.isfinite(numbers)]
    if infinite.size:
        raise BodyError("rotor", name, float(infinite.flat[0]), f"give finite numbers, in {unit}")
    return numbers


# --- Euler's equations ----------------------------------------------------------------------------
# In the body's principal axes (I.4.3)
#
#     A wx' = Nx - (C - B) wy wz
#     B wy' = Ny - (A - C) wz wx
#     C wz' = Nz - (B - A) wx wy
#
# Without torque 2T = sum I w^2 and L2 = sum (I w)^2 are constant.

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
    """Angular acceleration along the principal axes from Euler's equations, rad/s2 (I.4.3).

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        Moments of inertia, see `principal_moments`, kg m2.
    omega : array_like, shape (..., 3)
        rad/s.
    torque : array_like, shape (..., 3)
        N m, along the principal axes.
    """
    body, w = principal_moments(moments), np.asarray(omega, dtype=np.float64)
    products = w[..., [1, 2, 0]] * w[..., [2, 0, 1]]
    return np.asarray((torque - body.difference.hi * products) / body.values)


def twice_energy(moments: Moments, omega: Any) -> FloatArray:
    """Twice the kinetic energy, 2T = sum of I w^2, J, invariant without torque (I.5.1).

    Parameters
    ----------
    moments, omega
        As for `euler_rates`.
    """
    return np.asarray(np.sum(principal_moments(moments).values * np.square(omega), axis=-1))


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
        moment = 0.0 if torque is None else torque(time, w, q)
        spin = quaternion.multiply(q, np.concatenate([[0.0], w])) / 2
        return np.concatenate([euler_rates(body, w, moment), spin])

    floor = atol * np.array([float(np.linalg.norm(start))] * 3 + [1.0] * 4)
    initial = np.concatenate([start, [1.0, 0.0, 0.0, 0.0]])
    states = np.tile(initial, (t.size, 1))
    evaluations = 0
    for direction in (t > 0, t < 0):
        if not np.any(direction):
            continue
        stops, order = np.unique(np.abs(t[direction]), return_inverse=True)
        stops = stops * np.sign(t[direction][0])
        run = solve_ivp(rates, (0.0, stops[-1]), initial, "DOP853", stops, rtol=rtol, atol=floor)
        if not run.success:
            raise EarthspinError(f"the integration stopped: {run.message}")
        states[direction] = run.y.T[order]
        evaluations += int(run.nfev)
    return IntegratedRotation(t, states[:, :3], states[:, 3:], evaluations)
