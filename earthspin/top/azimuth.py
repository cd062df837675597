"""Euler angles phi and psi of a top in time, accurate also near the poles (I.7.9).

The angles are computed by integrals of the third kind that are regular at the poles.

Half the sum and half the difference of phi and psi (for I1 = I3),

    sigma' = (a + b)/(2 (1 + u)),    delta' = (b - a)/(2 (1 - u)),

are the phases of the Cayley-Klein parameters cos(theta/2) e^(i sigma), sin(theta/2) e^(i delta).
From a turning point ur, with us the other turning point, each is the sum of an arctangent and a
regular integral:

    sigma = arctan[(a + b)(u - ur)/((1 + ur) u')] + int (a + b)/2 w(1 + ur) dt
    delta = arctan[(b - a)(u - ur)/((1 - ur) u')] - int (b - a)/2 w(ur - 1) dt
    w(x)  = (u - ur)/((ur - us)(ur - u3) + x (u - ur))

The arctangent describes the fast half turn during a passage near a pole. The integral is
proportional to the weight, so a free rotor has only the arctangents. As a function of the phase the
integral is the same from either turning point,

    int w dt = beta/(4 Omega^3) sn^3/3 RJ(cn^2, dn^2, 1, 1 + (1 + u1)/(u3 - u1) sn^2)

for sigma, and 1 - (1 - u1)/(u3 - u1) sn^2 for delta. For |b| < |a|, as in a fast top, the
arctangents have opposite signs and cancel exactly, while the integrals add, so the slow precession
is accurate. If the pole is far away compared with u3, there is no fast half turn; the two parts of
delta would cancel and those of sigma be large, so Legendre's form is used.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.special import ellipkm1, elliprj

from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.numerics.elliptic import complete_third_kind
from earthspin.top.height import Place, TopNutation
from earthspin.top.start import HeavyTop

# cosine of a whole number of quarter turns
_COSINE = np.array([1.0, 0.0, -1.0, 0.0])
_SINE = np.array([0.0, 1.0, 0.0, -1.0])


class Turned(NamedTuple):
    """Angles by which the Euler angles phi and psi of a top have advanced.

    Attributes
    ----------
    phi, psi : ndarray
        rad.
    """

    phi: FloatArray
    psi: FloatArray


def turned_at(nutation: TopNutation, place: Place) -> tuple[Turned, Turned]:
    """Advance of a top's phi and psi since the first lower turning point, without the linear part.

    The part that is linear in time, of the rate `shared_rate`, is left out.

    Returns
    -------
    quarters : Turned
        Whole quarter turns, stored separately because they are exact over any time.
    remainder : Turned
        Remainder, rad.
    """
    full, partial = _complete_integrals(nutation), _partial_integrals(nutation, place)
    arc = _arc_tangents(nutation, place)
    remainder = Turned(
        arc.phi + (place.halves * full.phi + partial.phi),
        arc.psi + (place.halves * full.psi + partial.psi),
    )
    # Whole quarter turns that the arctangents add up to the nearest turning point. For a passage
    # exactly over a pole the direction of the half turn is arbitrary; it alternates.
    quarter = np.mod(place.halves, 4).astype(int)
    lower, upper = nutation.crosses_lower_pole, nutation.crosses_upper_pole
    sigma = np.where(lower, _SINE[quarter], place.halves * _lower_winding(nutation))
    delta = np.where(upper, -_COSINE[quarter], place.halves * _upper_winding(nutation))
    return Turned(sigma + delta, sigma - delta), remainder


def shared_rate(nutation: TopNutation) -> FloatArray:
    """Constant rate of phi and psi that the angles of `turned_at` do not include.

    It is half the axial angular momentum over I1, or zero. It is separated if the axis stays so
    near the upper pole that phi and psi are nearly degenerate; their sum then advances almost at
    the rate of the spin.
    """
    return np.where(_has_lower_arc(nutation), 0.0, nutation.start.a / 2)


def mean_precession_rate(top: HeavyTop, nutation: TopNutation) -> FloatArray:
    """Mean precession rate phi' of a top over one nutation period, rad/s.

    For a top that passes exactly over a pole it is the mean of the limits from both sides, for a
    sleeping top its initial phi', and for a top that approaches the upright position asymptotically
    the limit b/2.
    """
    start = nutation.start
    full = _complete_integrals(nutation)
    sigma = np.where(nutation.crosses_lower_pole, 0.0, _lower_winding(nutation))
    delta = np.where(nutation.crosses_upper_pole, 0.0, _upper_winding(nutation))
    turning = (np.pi / 2 * (sigma + delta) + full.phi) / nutation.half_period
    periodic = turning + shared_rate(nutation)
    mean = np.where(nutation.complement > 0, periodic, start.b / 2)
    still = start.asleep | (nutation.stiffness == 0)
    return np.where(still, top.phi_rate, mean * start.rate_unit)


def _lower_winding(nutation: TopNutation) -> FloatArray:
    """Quarter turns (-1, 0 or 1) that an arctangent adds to (phi + psi)/2 per half nutation."""
    return np.where(_has_lower_arc(nutation), np.sign(nutation.start.b_plus_a), 0.0)


def _upper_winding(nutation: TopNutation) -> FloatArray:
    """Quarter turns (-1, 0 or 1) that an arctangent adds to (phi - psi)/2 per half nutation."""
    return np.where(_has_upper_arc(nutation), np.sign(nutation.start.b_minus_a), 0.0)


def _has_lower_arc(nutation: TopNutation) -> BoolArray:
    """Return True if (phi + psi)/2 is computed with a separate arctangent term.

    That is so if u1 is not nearer to u3 than to the lower pole.
    """
    return np.asarray(nutation.stiffness >= nutation.start.beta * nutation.gaps.lower_pole)


def _has_upper_arc(nutation: TopNutation) -> BoolArray:
    """Return True if (phi - psi)/2 is computed with a separate arctangent term.

    That is so if u3 is not nearer to the upper pole than u2.
    """
    return np.asarray(nutation.gaps.outer >= nutation.start.beta * nutation.gaps.upper_pole)


def _arc_tangents(nutation: TopNutation, place: Place) -> Turned:
    """Arctangent terms of the Euler angles phi and psi, without cancellation, rad.

    They are the sum and the difference of the arctangents of sigma and delta.

    With tan sigma = (l/h) t and tan delta = (k/g) t, where h and g are the distances of the turning
    point from the two poles, the sum is arctan2(t (l g + k h), g h - k l t^2). The nearer pole has
    distance h, and l = pole_rate sqrt(h).
    """
    start, gaps, upper = nutation.start, nutation.gaps, place.upper
    meets = np.where(upper, gaps.upper_pole, gaps.lower_pole)
    distance = np.where(upper, nutation.height, nutation.depth)
    pole_rate = np.where(upper, _upper_pole_rate(nutation), _lower_pole_rate(nutation))
    other = np.where(upper, start.b_plus_a, start.b_minus_a)
    climb = np.where(upper, gaps.upper, -gaps.lower)  # ur - u(0)
    root = np.sqrt(meets)

    sense = np.where(upper, 1, -1)
    b_minus_au = _sum_over_root(
        (pole_rate * distance, other * root), (start.phi_rate * start.sine2, -start.a * climb), root
    )
    a_minus_bu = _sum_over_root(
        (-sense * pole_rate * distance, sense * other * root),
        (start.sine2 * (start.a - start.phi_rate * start.cosine), -start.b * climb),
        root,
    )
    y = place.sn * np.where(upper, place.dn, 1.0)
    x = 2 * nutation.rate * place.cn * np.where(upper, 1.0, place.dn)
    straight, crossed = distance * root * x**2, pole_rate * other * y**2
    sign = _side_of_pole(nutation, place)
    # Separate arctangents, for cases with only one of them.
    met = np.arctan2(sign * pole_rate * y, sign * root * x)
    unmet = np.arctan2(other * y, distance * x)
    has_lower, has_upper = _has_lower_arc(nutation), _has_upper_arc(nutation)
    sigma = np.where(has_lower, np.where(upper, unmet, met), 0.0)
    delta = np.where(has_upper, np.where(upper, met, unmet), 0.0)
    has_both = has_lower & has_upper
    total = np.arctan2(sign * b_minus_au * x * y, sign * (straight - crossed))
    difference = np.arctan2(sign * a_minus_bu * x * y, sign * (straight + crossed))
    return Turned(
        np.where(has_both, total, sigma + delta), np.where(has_both, difference, sigma - delta)
    )


def _sum_over_root(
    from_poles: tuple[FloatArray, FloatArray],
    from_start: tuple[FloatArray, FloatArray],
    root: FloatArray,
) -> FloatArray:
    """Return 2 (b - a u)/root, or 2 (a - b u)/root, at a turning point u, without cancellation.

    Two terms that follow from the distances to the poles have this sum; two that follow from the
    start have the sum without the factor 2/root. The sum with the smaller terms is returned.
    """
    regular = root > 0
    factor = 2 / np.where(regular, root, 1.0)
    sizes = factor * (np.abs(from_start[0]) + np.abs(from_start[1]))
    better = sizes < np.abs(from_poles[0]) + np.abs(from_poles[1])
    return np.where(
        regular & better, factor * (from_start[0] + from_start[1]), from_poles[0] + from_poles[1]
    )


def _lower_pole_rate(nutation: TopNutation) -> FloatArray:
    """Value of (a + b)/sqrt(1 + cos theta) at the largest inclination, finite at the lower pole.

    Here a and b are the axial and vertical angular momentum over I1. The value is the rate at which
    the axis passes the pole.
    """
    start, gaps = nutation.start, nutation.gaps
    size = np.sqrt(nutation.height * (2 * start.beta + gaps.outer))
    return size * np.where(nutation.crosses_lower_pole, 1.0, np.sign(start.b_plus_a))


def _upper_pole_rate(nutation: TopNutation) -> FloatArray:
    """Value of (b - a)/sqrt(1 - cos theta) at the smallest inclination, finite at the upper pole.

    Here a and b are the axial and vertical angular momentum over I1, in the rate unit of the
    nutation. The value is the rate at which the axis passes the pole.
    """
    size = np.sqrt(nutation.depth * nutation.gaps.outer)
    sense = np.sign(nutation.start.b_minus_a)
    return size * np.where(nutation.crosses_upper_pole, 1.0, sense)


def _side_of_pole(nutation: TopNutation, place: Place) -> FloatArray:
    """Sign of the half turn of phi if the axis passes exactly over a pole; otherwise 1."""
    quarter = np.mod(place.halves, 4).astype(int)
    lower = np.where(nutation.crosses_lower_pole, _COSINE[quarter], 1.0)
    upper = np.where(nutation.crosses_upper_pole, _SINE[quarter], 1.0)
    return np.where(place.upper, upper, lower)


class _Integral(NamedTuple):
    """Coefficients of one elliptic integral in the advance of a top's Euler angles.

    The integral is F first_kind + third_kind sn^3 RJ(cn^2, dn^2, 1, cn^2 + shape sn^2).

    F is the time since the turning point times Omega.
    """

    first_kind: FloatArray
    third_kind: FloatArray
    shape: FloatArray


def _integrals(nutation: TopNutation, upper: BoolArray) -> tuple[_Integral, _Integral]:
    """Coefficients of the elliptic integrals in (phi + psi)/2 and (phi - psi)/2.

    They start from a turning point; the arctangents are left out.
    """
    start, gaps, stiffness = nutation.start, nutation.gaps, 4 * nutation.rate**2
    ends, shape = (gaps.lower_pole, nutation.height), 1 + start.beta * gaps.lower_pole / stiffness
    sigma = _integral(nutation, start.b_plus_a, ends, upper, _has_lower_arc(nutation), shape)
    ends, shape = (-nutation.depth, -gaps.upper_pole), gaps.outer / stiffness
    delta = _integral(nutation, -start.b_minus_a, ends, upper, _has_upper_arc(nutation), shape)
    # (a + b)/(1 + u) - a = (b - a u)/(1 + u); the rate a/2 is treated separately.
    climb = np.where(upper, gaps.upper, -gaps.lower)
    upper_end = np.where(upper, nutation.height, gaps.lower_pole)
    excess = start.phi_rate * start.sine2 - start.a * climb
    shared = shared_rate(nutation) != 0
    pace = excess / (2 * nutation.rate * np.where(shared, upper_end, 1))
    return sigma._replace(first_kind=np.where(shared, pace, sigma.first_kind)), delta


def _integral(
    nutation: TopNutation,
    total: FloatArray,
    ends: tuple[FloatArray, FloatArray],
    upper: BoolArray,
    arc: BoolArray,
    regular_shape: FloatArray,
) -> _Integral:
    """Coefficients of the elliptic integral over time of (total/2)/(u - u_pole), u = cos(theta).

    If the arctangent is separate, only the regular part is returned.

    The ends are the distances of the turning points from the pole.
    """
    (lower_end, upper_end), pace = ends, total / (2 * nutation.rate)
    near = np.where(arc, 1.0, np.where(upper, upper_end, lower_end))
    far = np.where(upper, lower_end, upper_end)
    squeeze = np.where(upper, nutation.complement, 1.0)
    swing = np.where(upper, nutation.swing, -nutation.swing)
    third = np.where(arc, nutation.start.beta / (4 * nutation.rate**2), squeeze * swing / near**2)
    shape = np.where(arc, regular_shape, squeeze * far / near)
    return _Integral(np.where(arc, 0.0, pace / near), pace / 3 * third, shape)


def _partial_integrals(nutation: TopNutation, place: Place) -> Turned:
    """Advance of phi and psi since the nearest turning point, without arctangent terms, rad.

    The rate `shared_rate` is left out, too.
    """
    sn, cn2, dn2 = place.sn, place.cn**2, place.dn**2
    sigma, delta = (
        x.first_kind * place.phase
        + x.third_kind * sn**3 * elliprj(cn2, dn2, 1.0, cn2 + x.shape * sn**2)
        for x in _integrals(nutation, place.upper)
    )
    return Turned(sigma + delta, sigma - delta)


def _complete_integrals(nutation: TopNutation) -> Turned:
    """Advance of phi and psi between two turning points, without arctangent terms, rad.

    The rate `shared_rate` is left out, too.
    """
    returns = nutation.complement > 0
    complement = np.where(returns, nutation.complement, 1.0)
    quarter_period = ellipkm1(complement)
    angles = []
    for x in _integrals(nutation, np.asarray(False)):
        shape = np.where(x.shape > 0, x.shape, 1.0)  # 0 without motion
        third = 3 * x.third_kind * complete_third_kind(complement, shape)
        angles.append(np.where(returns, x.first_kind * quarter_period + third, 0.0))
    sigma, delta = angles
    return Turned(sigma + delta, sigma - delta)
