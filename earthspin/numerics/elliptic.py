"""Elliptic functions and integrals with full accuracy for all moduli, including 0 and 1.

`scipy.special.ellipj` takes the parameter m, so it loses the digits of 1 - m near a separatrix.
`scipy.special.elliprj` loses up to three digits of a complete integral whose integrand peaks at its
end. The functions of this module take the complementary modulus k', or the complementary parameter
k'^2 = 1 - m, and no step subtracts nearly equal numbers.

There are two families of functions. Those from `landen_descent` on compute the arithmetic-geometric
mean of 1 and k' (DLMF 19.8 and 22.7) with 32 digits, for phases over 10^4 periods. Their arrays
have bodies on the leading axes and times on the last axis. One Landen step down from k, the modulus
is k1 = (1 - k')/(1 + k') and the argument v = (1 + k')u/2; the functions of both are returned,
because the integral of the third kind has no cancellation at k1. `jacobi_sncndn` and
`complete_third_kind` take plain floats and broadcast. Each element takes as many steps as it needs,
so its bits are the same alone and in an array.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.special import elliprc, elliprf, elliprj

from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.numerics.double_double import DoubleDouble, as_double_double, where

_HALF_PI = DoubleDouble(1.5707963267948966, 6.123233995736766e-17)
#: Modulus below which sn and cn equal sin and cos to the last digit (the difference is k2/4).
_CIRCULAR = 1e-8


@dataclass(frozen=True, slots=True, eq=False)
class LandenDescent:
    """Arithmetic and geometric means, iterated from 1 and the complementary modulus k'.

    Attributes
    ----------
    arithmetic, geometric : tuple of DoubleDouble
        Means a_n and b_n, from a_0 = 1 and b_0 = k'.
    separatrix : ndarray of bool
        True for k' = 0, where the functions are hyperbolic and have no period; the means are then
        those of k' = 1.
    """

    arithmetic: tuple[DoubleDouble, ...]
    geometric: tuple[DoubleDouble, ...]
    separatrix: BoolArray

    @property
    def quarter_period(self) -> DoubleDouble:
        """Quarter period K(k) of the elliptic functions; 0 if K is infinite (separatrix, k = 1)."""
        return where(self.separatrix, 0.0, _HALF_PI / self.arithmetic[-1])


class Jacobi(NamedTuple):
    """Values of Jacobi's elliptic functions sn, cn and dn at one argument."""

    sn: FloatArray
    cn: FloatArray
    dn: FloatArray


def landen_descent(complementary_modulus: DoubleDouble) -> LandenDescent:
    """Compute the arithmetic-geometric mean iteration from 1 and k' to 32 digits.

    Parameters
    ----------
    complementary_modulus : DoubleDouble
        Complementary modulus k' = sqrt(1 - k2), from 0 to 1.
    """
    separatrix = np.asarray(complementary_modulus.hi == 0)
    b = where(separatrix, 1.0, complementary_modulus)
    a = as_double_double(np.ones_like(b.hi))
    arithmetic, geometric = [a], [b]
    unequal = np.ones_like(separatrix)
    while np.any(unequal):
        mean = (a + b).scaled(0.5)
        a, b = mean, where(unequal, (a * b).sqrt(), mean)
        unequal = np.abs((a - b).hi) > 1e-15 * a.hi
        arithmetic.append(a)
        geometric.append(b)
    arithmetic.append((a + b).scaled(0.5))
    return LandenDescent(tuple(arithmetic), tuple(geometric), separatrix)


def jacobi(u: FloatArray, descent: LandenDescent) -> tuple[Jacobi, Jacobi]:
    """Jacobi's elliptic functions at a modulus, and at the modulus after one Landen step.

    The transformation is in DLMF 22.7.

    Parameters
    ----------
    u : ndarray, shape (..., n)
        Argument, from -K to K.
    descent : LandenDescent
        Descent with arrays of shape (...).

    Returns
    -------
    upper, lower : Jacobi
        Functions of u at the modulus k, and of v = (1 + k')u/2 at k1 = (1 - k')/(1 + k').
    """
    a = [mean.hi[..., np.newaxis] for mean in descent.arithmetic]
    b = [mean.hi[..., np.newaxis] for mean in descent.geometric]
    singular = descent.separatrix[..., np.newaxis]
    regular = np.where(singular, 0.0, u)  # u may be infinite on the separatrix
    depth, mean = np.ones(singular.shape, dtype=int), a[1]  # step where sn and cn are sin and cos
    for step in range(1, len(b)):
        deeper = (depth == step) & (a[step - 1] - b[step - 1] > 2 * _CIRCULAR * a[step - 1])
        depth, mean = depth + deeper, np.where(deeper, a[step + 1], mean)
    s, c, d = np.sin(mean * regular), np.cos(mean * regular), np.ones_like(u)
    lower = Jacobi(s, c, d)
    for step in range(int(np.max(depth, initial=1)) - 1, -1, -1):
        lower = Jacobi(s, c, d)
        half = (a[step] - b[step]) / 2
        rise, run = a[step] * s, a[step + 1] * c * d
        up = (b[step] + half * c * c) / (a[step + 1] + half * s * s)
        # Use only the ratio of sn and cn: errors of cn alone would double in every step.
        length = np.sqrt(rise * rise + run * run)
        s, c, d = _choose(step < depth, Jacobi(rise / length, run / length, up), lower)
    upper = Jacobi(s, c, d)
    if not np.any(singular):
        return upper, lower
    return _choose(singular, _hyperbolic(u), upper), _choose(singular, _hyperbolic(u / 2), lower)


def first_kind(sine: FloatArray, cosine: FloatArray, complementary: FloatArray) -> FloatArray:
    """Elliptic integral of the first kind F from sine and cosine of the angle (DLMF 19.25.5).

    The result is from -K to K.

    Parameters
    ----------
    sine, cosine : ndarray
        Sine and non-negative cosine of the angle.
    complementary : ndarray
        Complementary parameter k'^2. If it is 0, the result is arsinh(tan), infinite at a right
        angle.
    """
    separatrix = complementary == 0
    c2 = np.where(separatrix, 1.0, cosine * cosine)
    elliptic = sine * elliprf(c2, c2 + complementary * sine * sine, 1.0)
    with np.errstate(divide="ignore"):
        hyperbolic = np.arcsinh(np.divide(sine, np.where(separatrix, cosine, 1.0)))
    return np.asarray(np.where(separatrix, hyperbolic, elliptic))


def third_kind_mean(n: DoubleDouble, descent: LandenDescent) -> DoubleDouble:
    """Mean of sn^2/(1 + n sn^2) over a period, at the modulus after one Landen step (DLMF 19.8.7).

    The modulus is k1 = (1 - k')/(1 + k'), the next one in the Landen descent.

    Parameters
    ----------
    n : DoubleDouble
        Parameter, not negative.
    descent : LandenDescent
    """
    a, b = descent.arithmetic, descent.geometric
    p = a[1] * (n + 1.0).sqrt()
    term = total = as_double_double(np.ones_like(p.hi))
    step = 1
    while np.any(counts := term.hi > 1e-32):
        product = a[step] * b[step]
        square = p * p
        term = (term * (square - product) / (square + product)).scaled(0.5)
        total = where(counts, total + term, total)
        p = (square + product) / p.scaled(2.0)
        step = min(step + 1, len(b) - 1)
    return where(descent.separatrix, 1.0, total.scaled(0.5)) / (n + 1.0)


def third_kind_periodic(
    u: FloatArray, lower: Jacobi, n: FloatArray, mean: FloatArray, descent: LandenDescent
) -> FloatArray:
    """Periodic part of the elliptic integral of sn^2/(1 + n sn^2) (DLMF 19.25.14).

    The integral is over the argument v = (1 + k')u/2, from 0; the modulus is k1 as in `jacobi`.

    Parameters
    ----------
    u : ndarray, shape (..., n)
        Argument at the modulus k, from -K to K.
    lower : Jacobi
        Functions of u, one Landen step down.
    n, mean : ndarray, shape (...)
        Parameter, and the result of `third_kind_mean` for it.
    descent : LandenDescent
    """
    s, c, d = lower
    n, singular = n[..., np.newaxis], descent.separatrix[..., np.newaxis]
    c2 = np.where(singular, 1.0, c * c)
    v = descent.arithmetic[1].hi[..., np.newaxis] * np.where(singular, 0.0, u)
    periodic = s**3 / 3 * elliprj(c2, d * d, 1.0, 1 + n * s * s) - mean[..., np.newaxis] * v
    if not np.any(singular):
        return np.asarray(periodic)
    return np.asarray(np.where(singular, -s * elliprc(1.0, 1 + n * s * s) / (1 + n), periodic))


def _hyperbolic(u: FloatArray) -> Jacobi:
    fall = np.exp(-np.abs(u))
    sech = 2 * fall / (1 + fall * fall)
    return Jacobi(np.tanh(u), sech, sech)


def _choose(condition: BoolArray, yes: Jacobi, no: Jacobi) -> Jacobi:
    return Jacobi(*(np.where(condition, y, n) for y, n in zip(yes, no, strict=True)))


# --- functions of plain floats -------------------------------------------------------------------


def jacobi_sncndn(
    argument: FloatArray, complement: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Jacobi's elliptic functions sn, cn, dn with full relative accuracy up to argument K/2.

    The method is the descending Gauss transformation, as a recurrence of positive terms (Bulirsch
    1965, Numer. Math. 7, 78).

    Parameters
    ----------
    argument : ndarray
        Argument between -K and K; beyond K/2, cn loses relative accuracy towards its zero at K.
    complement : ndarray
        Complementary parameter 1 - m, from 0 to 1; it broadcasts with `argument`.

    Returns
    -------
    sn, cn, dn : ndarray
    """
    argument, complement = np.broadcast_arrays(argument, complement)
    on_separatrix = complement == 0
    mean, root = np.ones_like(complement), np.sqrt(np.where(on_separatrix, 1.0, complement))
    means = [(mean, root, np.ones_like(on_separatrix))]
    while np.any(unequal := mean - root > 1e-8 * mean):  # then the next mean is exact
        mean, root = (
            np.where(unequal, (mean + root) / 2, mean),
            np.where(unequal, np.sqrt(mean * root), root),
        )
        means.append((mean, root, unequal))
    mean = (mean + root) / 2

    at_zero = np.abs(argument) < 1e-100  # sn equals the argument
    angle = np.where(at_zero, 1.0, mean * argument)
    cotangent = mean / np.tan(angle)  # cotangent of the amplitude, times the mean of this step
    dn = np.ones_like(mean)
    for upper_mean, upper_root, taken in reversed(means):
        square = cotangent**2 / mean
        up = (upper_root + square) / (upper_mean + square)
        cotangent = np.where(taken, cotangent * dn, cotangent)
        dn, mean = np.where(taken, up, dn), np.where(taken, upper_mean, mean)
    sn = np.sign(angle) / np.hypot(1.0, cotangent)
    cn = sn * cotangent
    sn, cn, dn = (np.where(at_zero, limit, f) for limit, f in ((argument, sn), (1, cn), (1, dn)))
    if not np.any(on_separatrix):
        return sn, cn, dn
    sech = 1 / np.cosh(np.where(on_separatrix, np.clip(argument, -700.0, 700.0), 0.0))
    return (
        np.where(on_separatrix, np.tanh(argument), sn),
        np.where(on_separatrix, sech, cn),
        np.where(on_separatrix, sech, dn),
    )


def complete_third_kind(complement: FloatArray, shape: FloatArray) -> FloatArray:
    """Complete elliptic integral of sn^2/(cn^2 + shape sn^2) from 0 to K (third kind).

    The integrand is sn^2/(cn^2 + shape sn^2), from 0 to the quarter period K. The integral equals
    RJ(0, 1 - m, 1, shape)/3 and is computed by Landen steps with positive terms (Bulirsch 1969,
    Numer. Math. 13, 305: cel with a = 0, b = 1).

    Parameters
    ----------
    complement : ndarray
        Complementary parameter 1 - m, above 0 and up to 1.
    shape : ndarray
        Positive parameter.
    """
    complement, shape = np.broadcast_arrays(complement, shape)
    root, product = np.sqrt(complement), np.sqrt(complement)
    mean, p = np.ones_like(root), np.sqrt(shape)
    a, b = np.zeros_like(root), 1 / p
    integral, computed = np.zeros_like(root), np.zeros(root.shape, dtype=bool)
    while not np.all(computed):
        a, b = b / p + a, 2 * (a * product / p + b)
        p = product / p + p
        last, mean = mean, root + mean
        settled = ~computed & (last - root <= 1e-8 * last)
        integral = np.where(settled, np.pi / 2 * (b + a * mean) / (mean * (mean + p)), integral)
        computed |= settled
        root = 2 * np.sqrt(product)
        product = root * mean
    return integral
