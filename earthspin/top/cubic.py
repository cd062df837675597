"""Roots of the cubic in u = cos(theta) of a top's nutation, without loss of digits (I.7.16).

    u'^2 = (1 - u^2)(alpha - beta u) - (b - a u)^2 = beta (u - u1)(u - u2)(u - u3),  u = cos(theta)

For slow nutation, a sleeping top and a fast top, two or three roots are nearly equal, and a general
root finder loses half or two thirds of the digits. But the signs are known: the cubic is not
positive at either pole and not negative at the start,

    -1 <= u1 <= u(0) <= u2 <= 1 <= u3        (beta >= 0),

so that every difference of roots is a sum of non-negative gaps between these six points. This
module computes the gaps. One root is well separated from the other two. After it is divided out,
the pair straddles either the start or the upper pole, and the quadratic for the two gaps on either
side has a discriminant that is a sum of squares.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.top.start import HeavyTop, axis_heights

#: A top slower than the first number (rad/s) is at rest; theta' or a pendulum's rate below the
#: second number times the fastest rate counts as zero, to avoid underflow.
_SLOWEST, _NEGLIGIBLE = 1e-100, 1e-60


class AxisStart(NamedTuple):
    """Initial state of a top's axis; upside down if the weight moment is negative.

    A top with a negative weight moment is described by the opposite end of its axis: theta is
    replaced by pi - theta, and spin and weight change sign. Rates are in units of `rate_unit`.

    Attributes
    ----------
    turned : ndarray of bool
        Whether the opposite end is used.
    rate_unit : ndarray
        A power of two near the fastest rate, rad/s, to avoid overflow.
    below, above, cosine : ndarray
        1 - u, 1 + u and u at the start.
    theta_rate, phi_rate, a, beta : ndarray
        In units of `rate_unit`, or its square.
    """

    turned: BoolArray
    rate_unit: FloatArray
    below: FloatArray
    above: FloatArray
    cosine: FloatArray
    theta_rate: FloatArray
    phi_rate: FloatArray
    a: FloatArray
    beta: FloatArray

    @property
    def sine2(self) -> FloatArray:
        """Squared sine of the initial inclination, sin^2(theta)."""
        return self.below * self.above

    @property
    def rate2(self) -> FloatArray:
        """Squared initial speed of the tip of the axis, theta'^2 + phi'^2 sin^2(theta)."""
        return self.theta_rate**2 + self.phi_rate**2 * self.sine2

    @property
    def asleep(self) -> BoolArray:
        """Return True if the axis is vertical and not moving, whether stable or not."""
        return np.asarray((self.sine2 == 0) & (self.theta_rate == 0))

    @property
    def b_minus_a(self) -> FloatArray:
        """Difference b - a of vertical and axial angular momentum, divided by I1."""
        return self.below * (self.phi_rate * self.above - self.a)

    @property
    def b_plus_a(self) -> FloatArray:
        """Sum b + a of vertical and axial angular momentum, divided by I1."""
        return self.above * (self.phi_rate * self.below + self.a)

    @property
    def b(self) -> FloatArray:
        """Vertical component of the angular momentum, divided by I1."""
        return self.phi_rate * self.sine2 + self.a * self.cosine


class Gaps(NamedTuple):
    """Distances along u = cos(theta) between the poles, the cubic's roots and the start.

    No distance is negative.

    Attributes
    ----------
    lower_pole : ndarray
        1 + u1.
    lower : ndarray
        u(0) - u1.
    upper : ndarray
        u2 - u(0).
    upper_pole : ndarray
        1 - u2.
    outer : ndarray
        beta (u3 - 1); finite even without weight, for which u3 is infinite.
    """

    lower_pole: FloatArray
    lower: FloatArray
    upper: FloatArray
    upper_pole: FloatArray
    outer: FloatArray


def axis_start(top: HeavyTop) -> AxisStart:
    """Compute the initial state of a top's axis, upside down for a negative weight moment."""
    below, above, cosine = axis_heights(top.theta)
    a = top.axial_moment / top.transverse_moment * top.spin
    beta = 2 * top.weight_moment / top.transverse_moment
    across = top.phi_rate * np.sqrt(below * above)
    rates = np.abs(np.stack([top.theta_rate, across, a, np.sqrt(np.abs(beta))]))
    fastest = np.max(rates, axis=0)
    still = fastest < _SLOWEST
    unit = np.ldexp(1.0, np.frexp(np.where(still, 1.0, fastest))[1])
    theta_rate = top.theta_rate / unit
    weight = np.abs(beta) / unit / unit
    turned = np.asarray(beta < 0)
    sign = np.where(turned, -1.0, 1.0)
    return AxisStart(
        turned,
        unit,
        np.where(turned, above, below),
        np.where(turned, below, above),
        sign * cosine,
        np.where(np.abs(theta_rate) < _NEGLIGIBLE, 0.0, sign * theta_rate),
        np.where(still, 0.0, top.phi_rate / unit),
        np.where(still, 0.0, sign * a / unit),
        np.where(still | (weight < _NEGLIGIBLE**2), 0.0, weight),
    )


def cubic_gaps(start: AxisStart) -> Gaps:
    """Compute distances between the cubic's roots, the poles and the start (I.7.16)."""
    # Expanded about the start, u = u(0) + x, and times beta^2 with X = beta x:
    # X^3 + c2 X^2 + beta c1 X + beta^2 c0.
    beta = start.beta
    # a^2 - 2 beta is nearly zero for a sleeping top near its critical spin.
    c2 = -(start.rate2 + (start.a**2 - 2 * beta) + 2 * beta * start.below)
    pull = 2 * start.phi_rate * (start.a - start.cosine * start.phi_rate) - beta
    c1 = start.sine2 * pull - 2 * start.cosine * start.theta_rate**2
    c0 = start.sine2 * start.theta_rate**2
    centre = -c2 / 3
    # At the mean of the roots the cubic is negative if the lower two are closer together.
    outer_apart = ((centre + c2) * centre + beta * c1) * centre + beta**2 * c0 <= 0
    from_start = _pair_about_start(start, c0, c1, c2, outer_apart)
    from_pole = _pair_about_pole(start, c0, ~outer_apart)
    lower, upper, upper_pole, outer = (
        np.where(outer_apart, x, y) for x, y in zip(from_start, from_pole, strict=True)
    )
    # The cubic at the lower pole is -(b + a)^2: the product of the gaps there.
    near_pole = _ratio(start.b_plus_a**2, (start.above + upper) * (2 * beta + outer))
    lower_pole = np.where(lower <= 0.75 * start.above, start.above - lower, near_pole)
    return Gaps(lower_pole, lower, upper, upper_pole, outer)


def _pair_about_start(
    start: AxisStart, c0: FloatArray, c1: FloatArray, c2: FloatArray, wanted: BoolArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Distances between roots, start and poles, if the two lower roots are close together.

    The start lies between u1 and u2.
    """
    beta, below = start.beta, start.below
    far = _largest_root(c2, beta * c1, beta**2 * c0, wanted)  # beta (u3 - u(0))
    product = _ratio(c0, far)
    lower, upper = _straddling(-_ratio(c1 + beta * product, far), product)
    # The cubic at the upper pole is -(b - a)^2, the product of the gaps there. It gives the gap
    # that is inaccurate from the start; the two are never both small compared with 1 - u(0).
    accurate = upper <= 0.75 * below
    at_pole = _ratio(start.b_minus_a**2, below + lower)
    closely = accurate & (far < 2 * beta * below)
    outer = np.where(closely, _ratio(at_pole, below - upper), far - beta * below)
    upper_pole = np.where(accurate, below - upper, _ratio(at_pole, outer))
    return lower, upper, upper_pole, outer


def _pair_about_pole(
    start: AxisStart, c0: FloatArray, wanted: BoolArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Distances between roots, start and poles, if the two upper roots are close together.

    The upper pole lies between u2 and u3.
    """
    beta, below = start.beta, start.below
    # Expanded about the pole, u = 1 - p, and times beta^2 with P = beta p:
    # P^3 - d2 P^2 - 2 beta d1 P + beta^2 (b - a)^2.
    d2 = (2 * beta - start.a**2) - start.rate2 + beta * below
    tilt = start.above * start.phi_rate * (start.phi_rate - start.a) + start.a**2 - beta
    d1 = start.theta_rate**2 + below * tilt
    d0 = start.b_minus_a**2
    far = _largest_root(-d2, -2 * beta * d1, beta**2 * d0, wanted)  # beta (1 - u1)
    depth = _ratio(far, beta)
    product = _ratio(d0, far)
    outer, upper_pole = _straddling(_ratio(2 * d1 - beta * product, far), product)
    outer = beta * outer
    # The cubic at the start is sin^2 theta'^2: the product of the gaps there.
    third = beta * below + outer
    lower = np.where(depth >= 1.5 * below, depth - below, 0.0)
    upper = np.where(upper_pole <= 0.75 * below, below - upper_pole, _ratio(c0, lower * third))
    lower = np.where(depth >= 1.5 * below, lower, _ratio(c0, upper * third))
    return lower, upper, upper_pole, outer


def _largest_root(c2: FloatArray, c1: FloatArray, c0: FloatArray, wanted: BoolArray) -> FloatArray:
    """Largest root of x^3 + c2 x^2 + c1 x + c0, well separated, by Newton's method.

    Newton's method converges monotonically from above.
    """
    centre = -c2 / 3
    spread = np.sqrt(np.maximum(centre**2 - c1 / 3, 0.0))
    x = centre + 2 * spread
    wanted = wanted & (x > 0)
    x = np.where(wanted, x, 0.0)
    for _ in range(6):  # from at most 16 % above, quadratically
        slope = (3 * x + 2 * c2) * x + c1
        value = ((x + c2) * x + c1) * x + c0
        x = x - np.where(wanted, _ratio(value, slope), 0.0)
    return x


def _straddling(middle: FloatArray, product: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the non-negative g and h for which g - h = middle and g h = product."""
    larger = (np.hypot(middle, 2 * np.sqrt(product)) + np.abs(middle)) / 2
    smaller = _ratio(product, larger)
    return np.where(middle > 0, larger, smaller), np.where(middle > 0, smaller, larger)


def _ratio(numerator: FloatArray, denominator: FloatArray) -> FloatArray:
    """Quotient of two arrays; 0 where the denominator is 0."""
    empty = denominator == 0
    return np.where(empty, 0.0, numerator / np.where(empty, 1.0, denominator))
