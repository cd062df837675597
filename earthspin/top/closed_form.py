"""Motion of a heavy top in closed form, and the effect of rounding on it (I.7.8 to I.7.17)."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from earthspin.errors import BodyError
from earthspin.numerics.arrays import BoolArray, ComplexArray, FloatArray
from earthspin.top.azimuth import mean_precession_rate, shared_rate, turned_at
from earthspin.top.height import (
    AxisHeight,
    Place,
    TopNutation,
    height_at,
    nutation_of,
    nutation_period,
    place_at,
    turning_angles,
)
from earthspin.top.patterns import nutation_pattern
from earthspin.top.start import AxisStart, HeavyTop

#: Longest time, s; longer ones would overflow.
_LONGEST = 1e100

# e^(i pi n/4)
_EIGHTHS = np.exp(0.25j * np.pi * np.arange(8))


@dataclass(frozen=True, eq=False)
class HeavyTopMotion:
    """Motion of one or more heavy tops; arrays have the shape of the tops, then of the times.

    Attributes
    ----------
    theta, phi, psi : ndarray
        Euler angles of I.7.1, rad; phi and psi are not reduced to one turn. If the axis passes
        exactly over a pole they jump by pi, in alternating directions; `attitude` is continuous.
    attitude : ndarray, shape (..., 4)
        Unit quaternion w, x, y, z, body to inertial, continuous in time.
    omega_body : ndarray, shape (..., 3)
        Angular velocity along the principal axes of the body (I.7.3), rad/s.
    turning_angle : ndarray, shape of the tops, then (2,)
        Smallest and largest theta, rad.
    pattern : ndarray of str, shape of the tops
        ``wave``, ``cusp``, ``loop``, ``steady`` or ``sleeping`` (I.7.19).
    nutation_period : ndarray, shape of the tops
        Period of nutation, s; for a steady top that of a small nutation, infinite if theta never
        returns.
    precession_rate : ndarray, shape of the tops
        Mean of phi' over a nutation, rad/s.
    """

    theta: FloatArray
    phi: FloatArray
    psi: FloatArray
    attitude: FloatArray
    omega_body: FloatArray
    turning_angle: FloatArray
    pattern: NDArray[np.str_]
    nutation_period: FloatArray
    precession_rate: FloatArray


class Angle(NamedTuple):
    """An angle as whole quarter turns plus a remainder, exact also after many turns.

    Attributes
    ----------
    quarters : ndarray
        Whole quarter turns.
    rest : ndarray
        rad.
    """

    quarters: FloatArray
    rest: FloatArray

    @property
    def radians(self) -> FloatArray:
        """Value of the angle in rad, not reduced to one turn."""
        return np.pi / 2 * self.quarters + self.rest

    @property
    def half(self) -> ComplexArray:
        """Complex number e^(i angle/2) of this angle, exact also after many turns."""
        eighths = np.mod(self.quarters, 8).astype(int)
        phase: ComplexArray = np.exp(0.5j * self.rest) * _EIGHTHS[eighths]
        return phase

    def plus(self, other: FloatArray) -> Angle:
        """Return the sum of this angle and another angle in rad."""
        return Angle(self.quarters, self.rest + other)

    def replaced(self, where: BoolArray, other: FloatArray) -> Angle:
        """Return this angle, but with the values of `other` (rad) where `where` is True."""
        return Angle(np.where(where, 0.0, self.quarters), np.where(where, other, self.rest))


def heavy_top_motion(top: HeavyTop, times: ArrayLike) -> HeavyTopMotion:
    """Compute the motion of a heavy top at given times in closed form.

    Parameters
    ----------
    top : HeavyTop
        One top or a batch.
    times : float or ndarray
        Since the start, s; negative times are the past.

    Returns
    -------
    HeavyTopMotion

    Raises
    ------
    BodyError
        If a time is not a finite number.
    """
    times = np.asarray(times, dtype=np.float64)
    usable = np.abs(times) <= _LONGEST
    if not np.all(usable):
        unusable = float(times[~usable].flat[0])
        raise BodyError("heavy top", "times", unusable, f"give seconds up to {_LONGEST:g}")
    shape = top.shape + (1,) * times.ndim
    spread = HeavyTop(**{f.name: np.reshape(getattr(top, f.name), shape) for f in fields(top)})
    nutation = nutation_of(spread)
    place = place_at(nutation, times * nutation.start.rate_unit)
    height = height_at(nutation, place)
    sine, cosine, flipped = np.sqrt(height.below), np.sqrt(height.above), nutation.start.turned
    theta = 2 * np.arctan2(np.where(flipped, cosine, sine), np.where(flipped, sine, cosine))
    phi, psi = _phi_and_psi(spread, nutation, times, place)
    return HeavyTopMotion(
        theta=theta,
        phi=phi.radians,
        psi=psi.radians,
        attitude=_attitude(theta, phi, psi),
        omega_body=_omega_body(spread, nutation, height, psi),
        turning_angle=turning_angles(nutation).reshape(*top.shape, 2),
        pattern=nutation_pattern(nutation.start).reshape(top.shape),
        nutation_period=nutation_period(nutation).reshape(top.shape),
        precession_rate=mean_precession_rate(spread, nutation).reshape(top.shape),
    )


def _phi_and_psi(
    top: HeavyTop, nutation: TopNutation, times: FloatArray, place: Place
) -> tuple[Angle, Angle]:
    """Euler angles phi and psi at given times: initial values plus the advance since the start."""
    quarters, remainder = turned_at(nutation, place)
    first_quarters, first_rest = turned_at(
        nutation, place_at(nutation, np.zeros((1,) * times.ndim))
    )
    phi = Angle(quarters.phi - first_quarters.phi, remainder.phi - first_rest.phi)
    psi = Angle(quarters.psi - first_quarters.psi, remainder.psi - first_rest.psi)
    # From the opposite end of the axis, the rotation has the opposite sense.
    sense = np.where(nutation.start.turned, -1.0, 1.0)
    shared = shared_rate(nutation) * nutation.start.rate_unit * times
    slack = (top.transverse_moment - top.axial_moment) / top.transverse_moment
    slack = np.where(shared_rate(nutation) == 0, slack, 1.0) * top.spin * times
    phi = phi.plus(shared)
    psi = Angle(sense * psi.quarters, sense * psi.rest + (slack - sense * shared))
    # Asleep, the rotation is divided between phi and psi as at the start.
    asleep = nutation.start.asleep
    psi_rate = top.spin - top.phi_rate * np.cos(top.theta)
    phi = phi.replaced(asleep, top.phi_rate * times)
    psi = psi.replaced(asleep, psi_rate * times)
    return phi.plus(top.phi), psi.plus(top.psi)


def _attitude(theta: FloatArray, phi: Angle, psi: Angle) -> FloatArray:
    """Attitude quaternion from Euler angles: successive rotations Rz(phi) Rx(theta) Rz(psi).

    The half rotations by phi and psi are applied separately: adding the angles would lose the slow
    precession of a top after a long time.
    """
    upright = np.cos(theta / 2) * phi.half * psi.half
    tilted = np.sin(theta / 2) * phi.half * np.conj(psi.half)
    return np.stack([upright.real, tilted.real, tilted.imag, upright.imag], axis=-1)


def _omega_body(top: HeavyTop, nutation: TopNutation, height: AxisHeight, psi: Angle) -> FloatArray:
    """Angular velocity of a top along its body axes, from rates of its Euler angles."""
    start = nutation.start
    sine = np.sqrt(height.below * height.above)
    tilted = sine > 0
    sine = np.where(tilted, sine, 1.0)
    theta_rate = np.where(tilted, -height.u_rate, 0.0) / sine
    theta_rate = np.where(start.turned, -theta_rate, theta_rate)
    horizontal = np.where(tilted, _vertical_excess(start, height), 0.0) / sine
    transverse = (theta_rate + 1j * horizontal) * np.conj(psi.half) ** 2 * start.rate_unit
    spin = np.broadcast_to(top.spin, transverse.shape)
    return np.stack([transverse.real, transverse.imag, spin], axis=-1)


def _vertical_excess(start: AxisStart, height: AxisHeight) -> FloatArray:
    """Compute phi' sin^2(theta): the precession rate times the squared sine of theta.

    The form that loses fewer digits is used.
    """
    by_rate, by_spin = start.phi_rate * start.sine2, start.a * height.climb
    upper, lower = start.b_plus_a * height.below, start.b_minus_a * height.above
    from_start = np.abs(by_rate) + np.abs(by_spin) < (np.abs(upper) + np.abs(lower)) / 2
    return np.where(from_start, by_rate - by_spin, (upper + lower) / 2)


# --- effect of rounding ---------------------------------------------------------------------------
# A top that nearly sleeps, or nearly stops at the highest point of its motion, amplifies rounding
# errors of the initial state, which limits every method. The effect is measured by changing one
# number at a time by one unit in its last place.

Numbers = ComplexArray | FloatArray

#: Error bound of the closed form, unless twice the effect of rounding is larger: measured with 500
#: starts in each of ten families (`python -m tests.top.accuracy 500`).
CLOSED_FORM_ERROR = 1e-13
#: Largest theta of a vertical axis, rad. An axis on the vertical is placed within 1e-120 of its
#: passage, so that its azimuth is defined.
UPRIGHT = 1e-100


def error_bound(top: HeavyTop, times: ArrayLike) -> FloatArray:
    """Bound on the largest relative error of `heavy_top_motion` over all times and quantities.

    Parameters
    ----------
    top : HeavyTop
    times : ndarray, shape (n,)
        s.

    Returns
    -------
    ndarray, of the shape of the tops
        Largest of the errors of theta, relative to theta; of phi, psi and the transverse angular
        velocity, relative to their largest values; and of the elements of the attitude.
    """
    return np.maximum(CLOSED_FORM_ERROR, 2 * effect_of_rounding(top, times))


def effect_of_rounding(top: HeavyTop, times: ArrayLike) -> FloatArray:
    """Total relative change of a top's motion if each input changes by one unit in its last place.

    Parameters
    ----------
    top : HeavyTop
    times : ndarray, shape (n,)
        s.

    Returns
    -------
    ndarray, of the shape of the tops
        As for `error_bound`.
    """
    t = np.atleast_1d(np.asarray(times, dtype=np.float64))
    start = {field.name: getattr(top, field.name) for field in fields(top)}
    motion = heavy_top_motion(top, t)
    total = _difference(heavy_top_motion(top, np.nextafter(t, np.inf)), motion)
    for name, value in start.items():
        neighbour = np.nextafter(value, 0.0)  # towards zero: all limits on a start are upper limits
        if np.any(neighbour != value):
            total = total + _difference(
                heavy_top_motion(HeavyTop(**(start | {name: neighbour})), t), motion
            )
    return total


def _difference(motion: HeavyTopMotion, reference: HeavyTopMotion) -> FloatArray:
    """Largest relative difference between two motions of each top, over times and quantities."""
    horizontal, horizontal_reference = (
        m.omega_body[..., 0] + 1j * m.omega_body[..., 1] for m in (motion, reference)
    )
    # a quaternion and its negative are the same attitude
    sign = np.copysign(1.0, np.sum(motion.attitude * reference.attitude, axis=-1, keepdims=True))
    rotation = 2 * np.abs(motion.attitude - sign * reference.attitude)
    # a vertical axis has no azimuth: the division of the rotation between phi and psi is arbitrary
    tilted = (reference.theta > UPRIGHT) & (reference.theta != np.pi)
    ratios = (
        _relative(motion.theta - reference.theta, np.where(tilted, np.abs(reference.theta), 0.0)),
        _relative(tilted * (motion.phi - reference.phi), _largest(reference.phi)),
        _relative(tilted * (motion.psi - reference.psi), _largest(reference.psi)),
        _relative(horizontal - horizontal_reference, _largest(horizontal_reference)),
        rotation.max(axis=(-2, -1)),
    )
    return np.asarray(np.max(ratios, axis=0))


def _largest(values: Numbers) -> FloatArray:
    """Largest absolute value over the last axis (times), which keeps length 1."""
    return np.asarray(np.max(np.abs(values), axis=-1, keepdims=True))


def _relative(difference: Numbers, size: FloatArray) -> FloatArray:
    """Largest ratio |difference|/size over the last axis (times); 0 where size is 0."""
    ratio = np.zeros(difference.shape)
    np.divide(np.abs(difference), size, out=ratio, where=size > 0)
    return np.asarray(np.max(ratio, axis=-1))
