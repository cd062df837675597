"""Double-double numbers: unevaluated sums of two floats, with about 32 digits.

The phases of a rotor may extend over 10^4 periods, and near the separatrix the period depends on
the difference of two nearly equal numbers. The constants of a motion are therefore computed with
twice the digits; functions of time are plain floats. Algorithms and bounds: Joldes,
Muller & Popescu 2017, ACM Trans. Math. Softw. 44, 15res.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.numerics.arrays import Numeric

_SPLITTER = 2.0**27 + 1.0  # Veltkamp: cuts 53 bits into 26 and 26


@dataclass(frozen=True, slots=True, eq=False)
class DoubleDouble:
    """Number hi + lo with about 32 digits, where hi is the number rounded to a float.

    Attributes
    ----------
    hi, lo : float or ndarray
        Parts of the same shape; `hi` is the value as a float.
    """

    hi: Numeric
    lo: Numeric

    __array_ufunc__ = None  # an array on the left delegates the operation to this class

    def __neg__(self) -> DoubleDouble:
        return DoubleDouble(-self.hi, -self.lo)

    def __add__(self, other: Numeric) -> DoubleDouble:
        other = as_double_double(other)
        high, error = two_sum(self.hi, other.hi)
        low, low_error = two_sum(self.lo, other.lo)
        high, error = _fast_two_sum(high, error + low)
        return DoubleDouble(*_fast_two_sum(high, low_error + error))

    def __sub__(self, other: Numeric) -> DoubleDouble:
        return self + -as_double_double(other)

    def __rsub__(self, other: Numeric) -> DoubleDouble:
        return as_double_double(other) - self

    def __mul__(self, other: Numeric) -> DoubleDouble:
        other = as_double_double(other)
        high, error = two_product(self.hi, other.hi)
        return DoubleDouble(*_fast_two_sum(high, error + (self.hi * other.lo + self.lo * other.hi)))

    def __truediv__(self, other: Numeric) -> DoubleDouble:
        other = as_double_double(other)
        quotient = self.hi / other.hi
        rest = self - other * quotient
        return DoubleDouble(*_fast_two_sum(quotient, rest.hi / other.hi))

    def __getitem__(self, key: Any) -> DoubleDouble:
        return DoubleDouble(self.hi[key], self.lo[key])

    __radd__ = __add__
    __rmul__ = __mul__

    def sqrt(self) -> DoubleDouble:
        """Square root of this non-negative number, with about 32 digits."""
        root = np.sqrt(self.hi)
        square, error = two_product(root, root)
        rest = (self.hi - square) - error + self.lo
        return DoubleDouble(*_fast_two_sum(root, rest / (2 * np.where(root > 0, root, 1.0))))

    def scaled(self, power_of_two: Numeric) -> DoubleDouble:
        """Return this number multiplied by a power of two, without rounding."""
        return DoubleDouble(self.hi * power_of_two, self.lo * power_of_two)


def as_double_double(number: Numeric) -> DoubleDouble:
    """Convert a float or an array of floats to a `DoubleDouble`."""
    return number if isinstance(number, DoubleDouble) else DoubleDouble(number, 0.0 * number)


def where(condition: Numeric, yes: Numeric, no: Numeric) -> DoubleDouble:
    """Choose elements of `yes` where `condition` is true, otherwise of `no`, like `numpy.where`."""
    yes, no = as_double_double(yes), as_double_double(no)
    return DoubleDouble(np.where(condition, yes.hi, no.hi), np.where(condition, yes.lo, no.lo))


def stack(*parts: DoubleDouble) -> DoubleDouble:
    """Stack double-double arrays along a new last axis."""
    return DoubleDouble(np.stack([p.hi for p in parts], -1), np.stack([p.lo for p in parts], -1))


def two_sum(a: Numeric, b: Numeric) -> tuple[Numeric, Numeric]:
    """Rounded sum of two floats, and its exact rounding error (Knuth)."""
    total = a + b
    b_seen = total - a
    return total, (a - (total - b_seen)) + (b - b_seen)


def two_product(a: Numeric, b: Numeric) -> tuple[Numeric, Numeric]:
    """Rounded product of two floats, and its exact rounding error (Dekker)."""
    product = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def _fast_two_sum(a: Numeric, b: Numeric) -> tuple[Numeric, Numeric]:
    """Rounded sum of two floats and its exact rounding error, for |a| >= |b| or a = 0."""
    total = a + b
    return total, b - (total - a)


def _split(a: Numeric) -> tuple[Numeric, Numeric]:
    shifted = _SPLITTER * a
    high = shifted - (shifted - a)
    return high, a - high


TWO_PI = DoubleDouble(6.283185307179586, 2.4492935982947064e-16)
