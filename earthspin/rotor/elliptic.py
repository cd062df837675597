"""Elliptic functions from the complementary modulus, whole up to the separatrix.

Everything follows from the arithmetic-geometric mean of 1 and k' (Landen's descent; DLMF
19.8 and 22.7). The modulus k itself is never needed, so nothing is lost as k' tends to 0 or
to 1, and no step subtracts nearly equal numbers. The leading axes hold bodies, the last one
times.

One step down from k the modulus is k1 = (1 - k')/(1 + k') and the argument v = (1 + k')u/2;
the functions of both are kept, because the third kind has no cancellation there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import elliprc, elliprf, elliprj

from earthspin.rotor.double_double import DoubleDouble, as_double_double, where

FloatArray = NDArray[np.float64]

_HALF_PI = DoubleDouble(1.5707963267948966, 6.123233995736766e-17)
#: Below this modulus sin and cos are sn and cn to the last digit (they differ by k2/4).
_CIRCULAR = 1e-8


@dataclass(frozen=True, slots=True, eq=False)
class LandenDescent:
    """The arithmetic-geometric mean of 1 and k', step by step.

    Attributes
    ----------
    arithmetic, geometric : tuple of DoubleDouble
        The means a_n and b_n, from a_0 = 1 and b_0 = k'.
    separatrix : ndarray of bool
        Where k' = 0: no period, hyperbolic functions. The means there are those of k' = 1.
    """

    arithmetic: tuple[DoubleDouble, ...]
    geometric: tuple[DoubleDouble, ...]
    separatrix: NDArray[np.bool_]

    @property
    def quarter_period(self) -> DoubleDouble:
        """K(k), half pi over the mean; on the separatrix 0, since nothing repeats."""
        return where(self.separatrix, 0.0, _HALF_PI / self.arithmetic[-1])


class Jacobi(NamedTuple):
    """sn, cn and dn of one argument."""

    sn: FloatArray
    cn: FloatArray
    dn: FloatArray


def landen_descent(complementary_modulus: DoubleDouble) -> LandenDescent:
    """Descend from k' until a_n and b_n agree to 32 digits.

    Parameters
    ----------
    complementary_modulus : DoubleDouble
        k' = sqrt(1 - k2), from 0 to 1.
    """
    separatrix = np.asarray(complementary_modulus.hi == 0)
    b = where(separatrix, 1.0, complementary_modulus)
    a = as_double_double(np.ones_like(b.hi))
    arithmetic, geometric = [a], [b]
    while len(arithmetic) < 2 or np.any(np.abs((a - b).hi) > 1e-15 * a.hi):
        a, b = (a + b).scaled(0.5), (a * b).sqrt()
        arithmetic.append(a)
        geometric.append(b)
    arithmetic.append((a + b).scaled(0.5))
    return LandenDescent(tuple(arithmetic), tuple(geometric), separatrix)


def jacobi(u: FloatArray, descent: LandenDescent) -> tuple[Jacobi, Jacobi]:
    """Jacobi's functions at the modulus k, and one step down (DLMF 22.7).

    Parameters
    ----------
    u : ndarray, shape (..., n)
        Argument, from -K to K.
    descent : LandenDescent
        Of shape (...).

    Returns
    -------
    upper, lower : Jacobi
        Of u at the modulus k, and of v = (1 + k')u/2 at k1 = (1 - k')/(1 + k').
    """
    a = [mean.hi[..., np.newaxis] for mean in descent.arithmetic]
    b = [mean.hi[..., np.newaxis] for mean in descent.geometric]
    on = descent.separatrix[..., np.newaxis]
    regular = np.where(on, 0.0, u)  # u may be infinite on the separatrix
    depth = 1
    while depth < len(b) and np.any(a[depth - 1] - b[depth - 1] > 2 * _CIRCULAR * a[depth - 1]):
        depth += 1
    s, c, d = np.sin(a[depth] * regular), np.cos(a[depth] * regular), np.ones_like(u)
    lower = Jacobi(s, c, d)
    for step in range(depth - 1, -1, -1):
        lower = Jacobi(s, c, d)
        half = (a[step] - b[step]) / 2
        rise, run = a[step] * s, a[step + 1] * c * d
        d = (b[step] + half * c * c) / (a[step + 1] + half * s * s)
        # From the ratio alone: errors of cn would double in every step, those of sn halve.
        length = np.sqrt(rise * rise + run * run)
        s, c = rise / length, run / length
    upper = Jacobi(s, c, d)
    if not np.any(on):
        return upper, lower
    return _choose(on, _hyperbolic(u), upper), _choose(on, _hyperbolic(u / 2), lower)


def first_kind(sine: FloatArray, cosine: FloatArray, complementary: FloatArray) -> FloatArray:
    """F of the angle with that sine and cosine, from -K to K (DLMF 19.25.5).

    Parameters
    ----------
    sine, cosine : ndarray
        The cosine not below 0.
    complementary : ndarray
        k'^2. Where it is 0 the result is arsinh(tan), infinite at a right angle.
    """
    separatrix = complementary == 0
    c2 = np.where(separatrix, 1.0, cosine * cosine)
    elliptic = sine * elliprf(c2, c2 + complementary * sine * sine, 1.0)
    with np.errstate(divide="ignore"):
        hyperbolic = np.arcsinh(np.divide(sine, np.where(separatrix, cosine, 1.0)))
    return np.asarray(np.where(separatrix, hyperbolic, elliptic))


def third_kind_mean(n: DoubleDouble, descent: LandenDescent) -> DoubleDouble:
    """Mean of sn^2/(1 + n sn^2) over a period, at the lower modulus (DLMF 19.8.7).

    Parameters
    ----------
    n : DoubleDouble
        From 0 up.
    descent : LandenDescent
    """
    a, b = descent.arithmetic, descent.geometric
    p = a[1] * (n + 1.0).sqrt()
    term = total = as_double_double(np.ones_like(p.hi))
    step = 1
    while np.any(term.hi > 1e-32):
        product = a[step] * b[step]
        square = p * p
        term = (term * (square - product) / (square + product)).scaled(0.5)
        total = total + term
        p = (square + product) / p.scaled(2.0)
        step = min(step + 1, len(b) - 1)
    return where(descent.separatrix, 1.0, total.scaled(0.5)) / (n + 1.0)


def third_kind_periodic(
    u: FloatArray, lower: Jacobi, n: FloatArray, mean: FloatArray, descent: LandenDescent
) -> FloatArray:
    """Integral of sn^2/(1 + n sn^2) dv less its mean, at the lower modulus (DLMF 19.25.14).

    Parameters
    ----------
    u : ndarray, shape (..., n)
        Argument at the modulus k, from -K to K.
    lower : Jacobi
        Of u, one step down.
    n, mean : ndarray, shape (...)
        The parameter, and what `third_kind_mean` gives for it.
    descent : LandenDescent
    """
    s, c, d = lower
    n, on = n[..., np.newaxis], descent.separatrix[..., np.newaxis]
    c2 = np.where(on, 1.0, c * c)
    v = descent.arithmetic[1].hi[..., np.newaxis] * np.where(on, 0.0, u)
    periodic = s**3 / 3 * elliprj(c2, d * d, 1.0, 1 + n * s * s) - mean[..., np.newaxis] * v
    if not np.any(on):
        return np.asarray(periodic)
    return np.asarray(np.where(on, -s * elliprc(1.0, 1 + n * s * s) / (1 + n), periodic))


def _hyperbolic(u: FloatArray) -> Jacobi:
    fall = np.exp(-np.abs(u))
    sech = 2 * fall / (1 + fall * fall)
    return Jacobi(np.tanh(u), sech, sech)


def _choose(condition: NDArray[np.bool_], yes: Jacobi, no: Jacobi) -> Jacobi:
    return Jacobi(*(np.where(condition, y, n) for y, n in zip(yes, no, strict=True)))
