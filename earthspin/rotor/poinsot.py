"""Poinsot's construction: the inertia ellipsoid rolls on the invariable plane (I.5).

The angular velocity moves along the *polhode*, the intersection of two ellipsoids fixed in the body
(I.5.1),

    2T = sum I w^2,        L2 = sum (I w)^2

and along the *herpolhode* in the invariable plane, which is perpendicular to the angular momentum
at 2T/L from the centre (I.5.7). The polhode is closed; the herpolhode is closed if it advances by a
rational fraction of a turn per polhode period.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.numerics import double_double, quaternion
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.rotor import triaxial
from earthspin.rotor.euler import Moments, finite, principal_moments
from earthspin.rotor.triaxial import JacobiMotion, Phase, jacobi_motion


@dataclass(frozen=True, slots=True, eq=False)
class Polhode:
    """Polhode: path of the angular velocity in a freely rotating body.

    Attributes
    ----------
    omega : ndarray, shape (..., n, 3)
        Points of the path along the principal axes, rad/s, evenly spaced in the amplitude of the
        elliptic functions.
    closed : ndarray of bool, shape (...)
        True if the last point equals the first; for rotation about an axis all points are equal. On
        the separatrix the path is open, and connects the two ends of the intermediate axis, which
        are reached only asymptotically.
    period : ndarray, shape (...)
        Period of the path, s; infinite if it is open.
    """

    omega: FloatArray
    closed: BoolArray
    period: FloatArray


def inertia_ellipsoid(moments: Moments, omega: Any) -> FloatArray:
    """Semi-axes sqrt(2T/I) of the ellipsoid of angular velocities with energy T, rad/s (I.5.1).

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        Moments of inertia, see `principal_moments`, kg m2.
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
    """Semi-axes 1/sqrt(I) of the inertia ellipsoid scaled to 2T = 1, kg-1/2 m-1 (I.5.1).

    Its coordinates are rho = omega/sqrt(2T).

    Goldstein's form, rho . I rho = 1, depends only on the body and not on its motion.

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        Moments of inertia, see `principal_moments`, kg m2.

    Returns
    -------
    ndarray, shape (..., 3)
        Along x, y, z of the body.
    """
    return np.asarray(1 / np.sqrt(principal_moments(moments).values))


def momentum_ellipsoid(moments: Moments, omega: Any) -> FloatArray:
    """Semi-axes L/I of the ellipsoid of angular velocities with angular momentum L, rad/s (I.5.1).

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
    """Compute points of the polhode, the path of the angular velocity in the body (I.5.6).

    Parameters
    ----------
    moments, omega
        As for `inertia_ellipsoid`.
    n : int
        Number of points; the last point of a closed curve equals the first.
    """
    motion = jacobi_motion(moments, omega)
    point = np.isinf(motion.start)  # the middle axis itself
    is_open = motion.descent.separatrix & ~point
    fraction = np.linspace(0.0, 1.0, n)
    round_trip = motion.start_angle[..., np.newaxis] + 2 * np.pi * fraction
    angle = np.where(is_open[..., np.newaxis], np.pi * (fraction - 0.5), round_trip)
    sine, cosine = np.sin(angle), np.cos(angle)
    sine = np.where(point[..., np.newaxis], np.sign(motion.start)[..., np.newaxis], sine)
    cosine = np.where(point[..., np.newaxis], 0.0, cosine)
    third = np.hypot(cosine, motion.complementary_modulus[..., np.newaxis] * sine)
    curve = np.stack([cosine, sine, third], axis=-1)
    path = triaxial.to_body(motion, curve * motion.amplitudes[..., np.newaxis, :])
    path[..., -1, :] = np.where(is_open[..., np.newaxis], path[..., -1, :], path[..., 0, :])
    return Polhode(path, ~is_open, motion.period)


def herpolhode(moments: Moments, omega: Any, times: Any) -> FloatArray:
    """Herpolhode: path of the angular velocity in the invariable plane, rad/s (I.5.9).

    The origin is the point where the line of the angular momentum meets the plane.

    Parameters
    ----------
    moments, omega
        As for `inertia_ellipsoid`, omega at t = 0.
    times : array_like, shape (n,)
        s.

    Returns
    -------
    ndarray, shape (..., n, 2)
        rad/s, seen from the tip of the angular momentum; the point at t = 0 is on the first axis.
    """
    motion = jacobi_motion(moments, omega)
    phase = triaxial.phase_at(motion, np.concatenate([[0.0], finite(times, "times", "s")]))
    projection = quaternion.rotate(triaxial.momentum_frame(motion, phase), _across(motion, phase))
    # Rotated by a quarter turn; moving the first point to the first axis removes the rotation.
    x, y = projection[..., 0], projection[..., 1]
    size = np.hypot(x[..., :1], y[..., :1])
    divisor = np.where(size > 0, size, 1.0)
    cosine, sine = x[..., :1] / divisor, y[..., :1] / divisor
    return np.stack([x * cosine + y * sine, y * cosine - x * sine], axis=-1)[..., 1:, :]


def herpolhode_radii(moments: Moments, omega: Any) -> FloatArray:
    """Radii of the two circles between which the herpolhode lies, rad/s (I.5.9).

    The smaller radius is 0 on the separatrix, where the path spirals to the centre.

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
    # omega is farthest from or nearest to the angular momentum where sn or cn vanishes.
    ends = np.stack([a1 * a3 * to_1, a2 * a3 * motion.complementary_modulus * to_2], axis=-1)
    ends = np.where(np.isinf(motion.start)[..., np.newaxis], 0.0, ends)  # the middle axis
    return np.sort(ends / motion.angular_momentum[..., np.newaxis], axis=-1)


def herpolhode_advance(moments: Moments, omega: Any) -> FloatArray:
    """Angle by which the herpolhode advances in one period of the polhode, rad.

    The principal axis about which the angular momentum moves advances by the same angle.

    Parameters
    ----------
    moments, omega
        As for `inertia_ellipsoid`.

    Returns
    -------
    ndarray, shape (...)
        Advance, positive, rad.

    Raises
    ------
    UndefinedError
        If the polhode has no period: on the separatrix, or if omega is constant because moments are
        equal.
    """
    motion = jacobi_motion(moments, omega)
    if not np.all(np.isfinite(motion.period)):
        raise UndefinedError(
            "the polhode has no period, so its herpolhode has no advance: the start is on the "
            "separatrix, or equal moments let omega stand still; move the start"
        )
    # psi includes one turn of the body per period about this axis.
    advance = motion.precession.rate * motion.exact_period + double_double.TWO_PI * motion.sense
    return np.asarray(advance.hi)


def _across(motion: JacobiMotion, phase: Phase) -> FloatArray:
    """Cross product of angular velocity and angular momentum direction, along axes 1, 2, 3."""
    w = phase.along(motion.amplitudes)
    factor = _differences(motion) * [1.0, -1.0, 1.0] / motion.angular_momentum[..., np.newaxis]
    return np.asarray(w[..., [1, 2, 0]] * w[..., [2, 0, 1]] * factor[..., np.newaxis, :])


def _differences(motion: JacobiMotion) -> FloatArray:
    """Differences I3 - I2, I3 - I1, I2 - I1 of the moments along the renumbered axes."""
    sizes = np.abs(np.take_along_axis(motion.moments.difference.hi, motion.axes, -1))
    return np.asarray(motion.sense[..., np.newaxis] * sizes)
