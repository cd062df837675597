r"""What stays the same in a free rotation: the numbers of Jacobi's closed form.

Number the principal axes so that the angular momentum m circles axis 3 and axis 2 has the
middle moment; point them so that m1, m3 >= 0 at the start and 1, 2, 3 are right-handed. Then

    omega = (a1 cn u, a2 sn u, a3 dn u),        u = lambda t + u0

solves Euler's equations (I.4.4). What else moves is one angle about the angular momentum,

    psi' = G/I3 + D3 (I3 - I1)/(I3 (G + m3)),

that follows the shortest turn from m to the angular momentum; m3 stays above 0, so there is
no singular place. With

    r = (I3 - I2)/(I3 - I1),             s = (I2 - I1)/(I3 - I1)
    D1 = s m2^2/I2 + m3^2/I3,            D3 = m1^2/I1 + r m2^2/I2
    k'^2 = (r m3^2/I3 - s m1^2/I1)/(r D1),      lambda = |I3 - I1| sqrt(r D1/(I1 I2 I3))
    a1^2 = D3/I1,        a2^2 = D3/(r I2),      a3^2 = D1/I3

(G^2 - 2T I1 is D1 (I3 - I1), and 2T I3 - G^2 is D3 (I3 - I1).) Only k'^2 takes a
difference, which is small near the separatrix; all constants are therefore formed with
twice the digits, from inputs taken as exact.

Sources: Jacobi 1850, J. reine angew. Math. 39, 293; Whittaker, Analytical Dynamics, sect. 69.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import BodyError, UndefinedError
from earthspin.rotor.double_double import DoubleDouble, stack, where
from earthspin.rotor.elliptic import LandenDescent, first_kind, landen_descent, third_kind_mean
from earthspin.rotor.moments import Moments, PrincipalMoments, finite, principal_moments

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

#: A component of omega this far below the largest counts as zero: its square would underflow.
_NEGLIGIBLE = 2.0**-450


@dataclass(frozen=True, slots=True, eq=False)
class Precession:
    """How the angle psi about the angular momentum runs: a mean rate and a periodic part.

    Attributes
    ----------
    rate : DoubleDouble, shape (...)
        Mean of psi', rad/s.
    swing : ndarray, shape (...)
        Factor of the periodic part, rad.
    n, mean : ndarray, shape (...)
        Parameter of the elliptic integral of the third kind, and the mean of its integrand.
    """

    rate: DoubleDouble
    swing: FloatArray
    n: FloatArray
    mean: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class JacobiMotion:
    """The constants of one free motion, or of many along the leading axes.

    Attributes
    ----------
    moments : PrincipalMoments
        Of the body, in its own order of axes.
    axes : ndarray of int, shape (..., 3)
        Which of the body's axes are 1, 2, 3 of the closed form.
    signs : ndarray, shape (..., 3)
        Which way along them 1, 2, 3 point.
    amplitudes : ndarray, shape (..., 3)
        Of cn, sn and dn in omega along 1, 2, 3, rad/s; the second carries a sign.
    cosines : ndarray, shape (..., 3)
        The same of the angular momentum over its length.
    angular_momentum, twice_energy : ndarray, shape (...)
        G, kg m2/s, and 2T, J.
    sense : ndarray, shape (...)
        1 if axis 3 has the largest moment, -1 if the smallest, 0 for a sphere.
    rate : DoubleDouble, shape (...)
        lambda, rad/s; 0 if the moments make omega stand still in the body.
    start : ndarray, shape (...)
        u0, the argument at t = 0; infinite for a rotation about the middle axis.
    start_angle : ndarray, shape (...)
        The amplitude of u0, whose sine is sn, rad.
    complementary_modulus : ndarray, shape (...)
        k': 0 on the separatrix, 1 for circular cones.
    descent : LandenDescent
        From k'.
    precession : Precession
        Of psi.
    """

    moments: PrincipalMoments
    axes: IntArray
    signs: FloatArray
    amplitudes: FloatArray
    cosines: FloatArray
    angular_momentum: FloatArray
    twice_energy: FloatArray
    sense: FloatArray
    rate: DoubleDouble
    start: FloatArray
    start_angle: FloatArray
    complementary_modulus: FloatArray
    descent: LandenDescent
    precession: Precession

    @property
    def exact_period(self) -> DoubleDouble:
        """Time in which omega comes back in the body, 4K/lambda, s; 0 if it never does."""
        quarter = self.descent.quarter_period
        moves = self.rate.hi > 0
        return where(moves, quarter.scaled(4.0) / where(moves, self.rate, 1.0), 0.0)

    @property
    def period(self) -> FloatArray:
        """Time in which omega comes back in the body, s; infinite if it never does."""
        period = np.asarray(self.exact_period.hi)
        return np.where(period > 0, period, np.inf)


class _Canonical(NamedTuple):
    """Body and start along axes 1, 2, 3; each field of shape (..., 3) or (...)."""

    moment: DoubleDouble
    spin: FloatArray
    momentum: DoubleDouble
    twice_energy: DoubleDouble  # m^2/I, one per axis
    span: DoubleDouble  # I3 - I1
    side: DoubleDouble  # G^2 - 2T I2
    r: DoubleDouble
    s: DoubleDouble
    parity: FloatArray  # -1 if 1, 2, 3 are left-handed


def jacobi_motion(moments: Moments, omega: Any) -> JacobiMotion:
    """Form the constants of a free motion from the body and its start.

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        As for `principal_moments`, kg m2; of shape (..., 3) for many bodies.
    omega : array_like, shape (..., 3)
        Angular velocity at t = 0 along the principal axes, rad/s. Bodies and starts
        broadcast against each other.

    Raises
    ------
    BodyError
        For moments that no body has, and for numbers that are not finite.
    UndefinedError
        For a start without angular momentum.
    """
    body, spin = _broadcast(principal_moments(moments), _start(omega))
    # Dividing by powers of two is exact, and makes every number one of order one.
    size, speed = _power_of_two(body.values), _power_of_two(spin)
    unit = PrincipalMoments(
        body.moment.scaled(1 / size[..., np.newaxis]),
        body.difference.scaled(1 / size[..., np.newaxis]),
    )
    spin = spin / speed[..., np.newaxis]
    spin = np.where(np.abs(spin) < _NEGLIGIBLE, 0.0, spin)
    axes = _circled_axis_last(unit, spin)
    return _constants(body, axes, _canonical(unit, spin, axes), size, speed)


def _constants(
    body: PrincipalMoments, axes: IntArray, start: _Canonical, size: FloatArray, speed: FloatArray
) -> JacobiMotion:
    signs = np.where(start.spin < 0, -1.0, 1.0)
    signs[..., 1] = start.parity * signs[..., 0] * signs[..., 2]
    i1, i2, i3 = (start.moment[..., axis] for axis in range(3))
    x1, x2, x3 = (start.twice_energy[..., axis] for axis in range(3))
    r, s, span = start.r, start.s, start.span

    d1, d3 = s * x2 + x3, x1 + r * x2
    still = d1.hi == 0
    circular = still | (span.hi == 0)
    k2_complementary = where(circular, 1.0, start.side / where(circular, 1.0, r * d1 * span))
    k_complementary = k2_complementary.sqrt()
    descent = landen_descent(k_complementary)
    rate = _absolute(span) * (r * d1 / (i1 * i2 * i3)).sqrt()

    g = _sum(start.momentum * start.momentum).sqrt()
    sense = np.sign(span.hi)
    towards = np.where(sense < 0, -1.0, 1.0)  # the sign that sn needs with lambda above 0
    amplitudes = stack((d3 / i1).sqrt(), (d3 / (r * i2)).sqrt() * towards, (d1 / i3).sqrt())
    sine, cosine = _start_angle(amplitudes, start.spin * signs)
    return JacobiMotion(
        moments=body,
        axes=axes,
        signs=signs,
        amplitudes=amplitudes.hi * speed[..., np.newaxis],
        cosines=(amplitudes * start.moment / g[..., np.newaxis]).hi,
        angular_momentum=g.hi * size * speed,
        twice_energy=_sum(start.twice_energy).hi * size * speed**2,
        sense=sense,
        rate=rate.scaled(speed),
        start=first_kind(sine, cosine, np.asarray(k2_complementary.hi)),
        start_angle=np.arctan2(sine, cosine),
        complementary_modulus=np.asarray(k_complementary.hi),
        descent=descent,
        precession=_precession(start, d1, d3, g, k_complementary, descent, speed),
    )


def _precession(
    start: _Canonical,
    d1: DoubleDouble,
    d3: DoubleDouble,
    g: DoubleDouble,
    k_complementary: DoubleDouble,
    descent: LandenDescent,
    speed: FloatArray,
) -> Precession:
    """Integrate psi' = G/I3 + D3 (I3 - I1)/(G I3) / (1 + b dn u), with b = a3 I3/G.

    One step down Landen's descent, to k1 = (1 - k')/(1 + k') and v = (1 + k')u/2,

        1/(1 + b dn u) = [1 + 2 b k1/(1 + b) sn^2 v/(1 + n sn^2 v)]/(1 + b)

    with n = k1 (1 - b)/(1 + b): all terms are positive and 1 + n needs no care, while the
    usual form divides by 1 - b^2 dn^2, which vanishes with the cone.
    """
    i1, i2, i3 = (start.moment[..., axis] for axis in range(3))
    b = (d1 * i3).sqrt() / g
    k1 = (1.0 - k_complementary) / (1.0 + k_complementary)
    n = k1 * (1.0 - b) / (1.0 + b)
    mean = third_kind_mean(n, descent)
    inverse = (1.0 + b.scaled(2.0) * k1 / (1.0 + b) * mean) / (1.0 + b)
    rate = g / i3 + d3 * start.span / (i3 * g) * inverse
    swing = (
        np.sign(start.span.hi)
        * (d3 / (g * g)).hi
        * np.sqrt((i1 * i2 / start.r).hi)
        * (2 * k1.hi * (1 + k1.hi) / (1 + b.hi) ** 2)
    )
    return Precession(rate.scaled(speed), swing, np.asarray(n.hi), np.asarray(mean.hi))


def _circled_axis_last(unit: PrincipalMoments, spin: FloatArray) -> IntArray:
    """Order the axes: the one that m circles last, the middle moment second."""
    ascending = _ascending(unit)
    start = _canonical(unit, spin, ascending)
    # On the separatrix either end will do, unless two moments are equal: then the other one.
    smallest = (start.side.hi < 0) | ((start.side.hi == 0) & (start.r.hi < start.s.hi))
    return np.where(smallest[..., np.newaxis], ascending[..., ::-1], ascending)


def _ascending(unit: PrincipalMoments) -> IntArray:
    """Axes from the smallest moment to the largest, told apart by the differences alone."""
    c_b, a_c, b_a = np.moveaxis(unit.difference.hi, -1, 0)
    rank = np.stack(
        [(b_a < 0) * 1 + (a_c > 0), (b_a >= 0) * 1 + (c_b < 0), (a_c <= 0) * 1 + (c_b >= 0)],
        axis=-1,
    )
    return np.argsort(rank, axis=-1)


def _canonical(unit: PrincipalMoments, spin: FloatArray, axes: IntArray) -> _Canonical:
    """Take body and start to the axes 1, 2, 3."""
    parity = np.where((axes[..., 1] - axes[..., 0]) % 3 == 1, 1.0, -1.0)
    moment, difference = (
        _take(unit.moment, axes),
        _take(unit.difference, axes).scaled(parity[..., np.newaxis]),
    )
    spin = np.take_along_axis(spin, axes, -1)
    momentum = moment * spin
    twice_energy = momentum * spin
    span = -difference[..., 1]
    sphere = span.hi == 0
    divisor = where(sphere, 1.0, span)
    return _Canonical(
        moment=moment,
        spin=spin,
        momentum=momentum,
        twice_energy=twice_energy,
        span=span,
        # No quotients here: a start in whole numbers is on the separatrix exactly.
        side=difference[..., 0] * twice_energy[..., 2] - difference[..., 2] * twice_energy[..., 0],
        r=where(sphere, 1.0, difference[..., 0] / divisor),
        s=where(sphere, 0.0, difference[..., 2] / divisor),
        parity=parity,
    )


def _start_angle(amplitudes: DoubleDouble, spin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Sine and cosine of the amplitude of u0; 0 and 1 for a rotation about axis 3."""
    upright = amplitudes.hi[..., 0] == 0
    divisor = np.where(upright[..., np.newaxis], 1.0, amplitudes.hi)
    sine, cosine = spin[..., 1] / divisor[..., 1], spin[..., 0] / divisor[..., 0]
    return sine, np.where(upright, 1.0, cosine)


def _start(omega: Any) -> FloatArray:
    spin = finite(omega, "omega", "rad/s")
    if spin.ndim == 0 or spin.shape[-1] != 3:
        raise BodyError("rotor", "omega", omega, "give three components, in rad/s")
    if np.any(np.all(spin == 0, axis=-1)):
        raise UndefinedError(
            "omega = [0, 0, 0] rad/s gives no angular momentum, so there is no rotation to "
            "follow; give a start with at least one component other than zero"
        )
    return spin


def _broadcast(body: PrincipalMoments, spin: FloatArray) -> tuple[PrincipalMoments, FloatArray]:
    moment, difference = body.moment, body.difference
    try:
        a, b, c, d, spin = np.broadcast_arrays(
            moment.hi, moment.lo, difference.hi, difference.lo, spin
        )
    except ValueError:
        raise BodyError(
            "rotor", "omega", np.shape(spin), f"its shape must go with {moment.hi.shape}"
        ) from None
    return PrincipalMoments(DoubleDouble(a, b), DoubleDouble(c, d)), spin


def _power_of_two(numbers: FloatArray) -> FloatArray:
    _, exponent = np.frexp(np.max(np.abs(numbers), axis=-1))
    return np.asarray(np.ldexp(1.0, exponent))


def _take(numbers: DoubleDouble, axes: IntArray) -> DoubleDouble:
    return DoubleDouble(
        np.take_along_axis(numbers.hi, axes, -1), np.take_along_axis(numbers.lo, axes, -1)
    )


def _sum(components: DoubleDouble) -> DoubleDouble:
    return components[..., 0] + components[..., 1] + components[..., 2]


def _absolute(number: DoubleDouble) -> DoubleDouble:
    return number.scaled(np.where(number.hi < 0, -1.0, 1.0))
