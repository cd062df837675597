"""Poinsot's picture of free rotation: an ellipsoid that rolls on a plane (I.5).

The angular velocity runs along the *polhode*, where two ellipsoids fixed in the body meet
(I.5.1),

    2T = sum I w^2,        L2 = sum (I w)^2

and along the *herpolhode* in the invariable plane, which stands across the angular momentum
at 2T/L from the centre (I.5.7). The polhode closes; the herpolhode does if a period of the
polhode turns it by a rational part of a whole turn.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import UndefinedError
from earthspin.numerics import quaternion
from earthspin.numerics.double_double import TWO_PI
from earthspin.rotor.constants_of_motion import JacobiMotion, jacobi_motion
from earthspin.rotor.moments import Moments, finite, principal_moments
from earthspin.rotor.triaxial import Phase, momentum_frame, phase_at, to_body

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Polhode:
    """The path of the angular velocity in the body.

    Attributes
    ----------
    omega : ndarray, shape (..., n, 3)
        Points of the path along the principal axes, rad/s, evenly spread over the amplitude
        of the elliptic functions.
    closed : ndarray of bool, shape (...)
        True if the last point repeats the first, the start; about an axis all are the same.
        On the separatrix the path is open: from one end of the middle axis to the other,
        neither of which it reaches in a finite time.
    period : ndarray, shape (...)
        Time of one round, s; infinite if there is none.
    """

    omega: FloatArray
    closed: NDArray[np.bool_]
    period: FloatArray


class Closure(NamedTuple):
    """How nearly a herpolhode closes.

    Attributes
    ----------
    turns, periods : int
        Whole turns after so many whole periods of the polhode.
    gap : float
        Angle by which it then misses, rad.
    """

    turns: int
    periods: int
    gap: float


def inertia_ellipsoid(moments: Moments, omega: Any) -> FloatArray:
    """Semi-axes of the inertia ellipsoid in omega space, sqrt(2T/I), rad/s (I.5.1).

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        As for `principal_moments`, kg m2.
    omega : array_like, shape (..., 3)
        Angular velocity along the principal axes at any time, rad/s.

    Returns
    -------
    ndarray, shape (..., 3)
        Along x, y, z of the body.
    """
    motion = jacobi_motion(moments, omega)
    return np.sqrt(motion.twice_energy[..., np.newaxis] / motion.moments.values)


def rescaled_inertia_ellipsoid(moments: Moments) -> FloatArray:
    """Semi-axes of the inertia ellipsoid of rho = omega/sqrt(2T), 1/sqrt(I), kg-1/2 m-1 (I.5.1).

    Goldstein's form, rho . I rho = 1: it belongs to the body alone, whatever its motion.

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        As for `principal_moments`, kg m2.

    Returns
    -------
    ndarray, shape (..., 3)
        Along x, y, z of the body.
    """
    return np.asarray(1 / np.sqrt(principal_moments(moments).values))


def momentum_ellipsoid(moments: Moments, omega: Any) -> FloatArray:
    """Semi-axes of the L-ellipsoid in omega space, L/I, rad/s (I.5.1).

    Parameters and result as for `inertia_ellipsoid`.
    """
    motion = jacobi_motion(moments, omega)
    return np.asarray(motion.angular_momentum[..., np.newaxis] / motion.moments.values)


def invariable_plane_distance(moments: Moments, omega: Any) -> FloatArray:
    """Distance of the invariable plane from the centre in omega space, 2T/L, rad/s (I.5.7).

    Parameters as for `inertia_ellipsoid`; shape (...).
    """
    motion = jacobi_motion(moments, omega)
    return np.asarray(motion.twice_energy / motion.angular_momentum)


def polhode(moments: Moments, omega: Any, n: int = 361) -> Polhode:
    """The closed curve that the angular velocity runs along in the body (I.5.6).

    Parameters
    ----------
    moments, omega
        As for `inertia_ellipsoid`.
    n : int
        Number of points; the last of a closed curve repeats the first.
    """
    motion = jacobi_motion(moments, omega)
    point = np.isinf(motion.start)  # the middle axis itself
    is_open = motion.descent.separatrix & ~point
    part = np.linspace(0.0, 1.0, n)
    round_trip = motion.start_angle[..., np.newaxis] + 2 * np.pi * part
    angle = np.where(is_open[..., np.newaxis], np.pi * (part - 0.5), round_trip)
    sine, cosine = np.sin(angle), np.cos(angle)
    sine = np.where(point[..., np.newaxis], np.sign(motion.start)[..., np.newaxis], sine)
    cosine = np.where(point[..., np.newaxis], 0.0, cosine)
    third = np.hypot(cosine, motion.complementary_modulus[..., np.newaxis] * sine)
    curve = np.stack([cosine, sine, third], axis=-1)
    path = to_body(motion, curve * motion.amplitudes[..., np.newaxis, :])
    path[..., -1, :] = np.where(is_open[..., np.newaxis], path[..., -1, :], path[..., 0, :])
    return Polhode(path, ~is_open, motion.period)


def herpolhode(moments: Moments, omega: Any, times: Any) -> FloatArray:
    """Path of the angular velocity in the invariable plane, about the plane's foot (I.5.9).

    Parameters
    ----------
    moments, omega
        As for `inertia_ellipsoid`, omega at t = 0.
    times : array_like, shape (n,)
        s.

    Returns
    -------
    ndarray, shape (..., n, 2)
        rad/s, as seen from the tip of the angular momentum; the point of t = 0 lies on the
        first axis.
    """
    motion = jacobi_motion(moments, omega)
    phase = phase_at(motion, np.concatenate([[0.0], finite(times, "times", "s")]))
    across = quaternion.rotate(momentum_frame(motion, phase), _across(motion, phase))
    # A quarter turn from the path itself, which turning the start to the first axis undoes.
    x, y = across[..., 0], across[..., 1]
    size = np.hypot(x[..., :1], y[..., :1])
    divisor = np.where(size > 0, size, 1.0)
    cosine, sine = x[..., :1] / divisor, y[..., :1] / divisor
    return np.stack([x * cosine + y * sine, y * cosine - x * sine], axis=-1)[..., 1:, :]


def herpolhode_radii(moments: Moments, omega: Any) -> FloatArray:
    """The two circles between which the herpolhode runs, rad/s (I.5.9).

    The smaller radius is 0 on the separatrix, where the path winds in to the centre.

    Parameters
    ----------
    moments, omega
        As for `inertia_ellipsoid`.

    Returns
    -------
    ndarray, shape (..., 2)
        The smaller radius first.
    """
    motion = jacobi_motion(moments, omega)
    to_2, to_1, _ = np.moveaxis(np.abs(_differences(motion)), -1, 0)
    a1, a2, a3 = np.moveaxis(np.abs(motion.amplitudes), -1, 0)
    # omega is furthest from the angular momentum, or nearest, where sn or cn vanish.
    ends = np.stack([a1 * a3 * to_1, a2 * a3 * motion.complementary_modulus * to_2], axis=-1)
    ends = np.where(np.isinf(motion.start)[..., np.newaxis], 0.0, ends)  # the middle axis
    return np.sort(ends / motion.angular_momentum[..., np.newaxis], axis=-1)


def herpolhode_advance(moments: Moments, omega: Any) -> FloatArray:
    """Angle about the angular momentum that one period of the polhode turns the herpolhode.

    The figure axis that the angular momentum circles advances by as much.

    Parameters
    ----------
    moments, omega
        As for `inertia_ellipsoid`.

    Returns
    -------
    ndarray, shape (...)
        rad, above 0.

    Raises
    ------
    UndefinedError
        Where the polhode has no period: on the separatrix, and if omega stands still because
        moments are equal.
    """
    motion = jacobi_motion(moments, omega)
    if not np.all(np.isfinite(motion.period)):
        raise UndefinedError(
            "the polhode has no period, so its herpolhode has no advance: the start is on the "
            "separatrix, or equal moments let omega stand still; move the start"
        )
    # psi counts the turns of the body too, one per period about the axis that is circled.
    advance = motion.precession.rate * motion.exact_period + TWO_PI * motion.sense
    return np.asarray(advance.hi)


def nearest_closure(advance: float, most_periods: int = 100) -> Closure:
    """The rational part of a turn that an advance is nearest to.

    The herpolhode closes if its advance is a rational multiple of 2 pi. No float says which
    numbers are rational; the gap says how far the path is from closing.

    Parameters
    ----------
    advance : float
        As `herpolhode_advance` gives it, rad.
    most_periods : int
        Largest denominator to try.
    """
    part = Fraction(advance / (2 * np.pi)).limit_denominator(most_periods)
    gap = advance * part.denominator - 2 * np.pi * part.numerator
    return Closure(part.numerator, part.denominator, abs(gap))


def _across(motion: JacobiMotion, phase: Phase) -> FloatArray:
    """Omega x (angular momentum/G) along 1, 2, 3, from the differences of the moments."""
    w = phase.along(motion.amplitudes)
    factor = _differences(motion) * [1.0, -1.0, 1.0] / motion.angular_momentum[..., np.newaxis]
    return np.asarray(w[..., [1, 2, 0]] * w[..., [2, 0, 1]] * factor[..., np.newaxis, :])


def _differences(motion: JacobiMotion) -> FloatArray:
    """I3 - I2, I3 - I1, I2 - I1, which are of one sign."""
    sizes = np.abs(np.take_along_axis(motion.moments.difference.hi, motion.axes, -1))
    return np.asarray(motion.sense[..., np.newaxis] * sizes)
