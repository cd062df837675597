"""Legendre functions on [-1, 1]: projection on them and sums of their series (I.9.3, I.9.4).

P_nm is the associated Legendre function with the phase (-1)^m, not normalised, as in the
source and in `scipy.special.lpmv`:

    integral of P_nm P_n'm dz = K_nm delta_nn'      K_nm = f(n, m)/(n + 1/2)
    f(n, m) = (n + m)!/(n - m)!

They are computed as P_nm/sqrt(K_nm), which does not overflow and is more accurate near z = 1 than
`lpmv` (for m = 1 at z = 0.999999, errors of 2e-14 and 1e-12).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad_vec

from earthspin.errors import AccuracyError, UndefinedError
from earthspin.mass._checks import degree
from earthspin.numerics.arrays import FloatArray

#: Maximum number of intervals in the quadrature of a projection.
_INTERVALS = 500


def factorial_ratio(n: int, m: int) -> float:
    """Ratio f(n, m) = (n + m)!/(n - m)!, for |m| <= n (I.9.3).

    f(n, -m) is the weight of a term of 1/R (I.9.11).
    """
    _check_order(n, abs(m))
    try:
        ratio = float(math.perm(n + abs(m), 2 * abs(m)))
    except OverflowError:
        raise UndefinedError(
            f"f(n, m) of n = {n}, m = {m} exceeds 1e308; unnormalised functions end there"
        ) from None
    return ratio if m >= 0 else 1 / ratio


def legendre_norm(n: int, m: int = 0) -> float:
    """Squared norm K_nm: integral of P_nm squared over [-1, 1] (I.9.3)."""
    return factorial_ratio(n, m) / (n + 0.5)


def orthonormal_functions(n_max: int, z: ArrayLike, m: int = 0) -> FloatArray:
    """Normalised Legendre functions P_nm(z)/sqrt(K_nm) for degrees n = m to n_max.

    Parameters
    ----------
    n_max : int
        Last degree.
    z : array_like, shape (...)
        In [-1, 1].
    m : int
        Order, from 0 to n_max.

    Returns
    -------
    ndarray, shape (n_max + 1 - m, ...)
        Their squares integrate to 1.
    """
    _check_order(n_max, m)
    x = _argument(z)
    functions = np.zeros((n_max + 1 - m, *x.shape))
    sine = np.sqrt((1 - x) * (1 + x))
    functions[0] = np.sqrt(0.5)
    for k in range(1, m + 1):
        functions[0] *= -np.sqrt((2 * k + 1) / (2 * k)) * sine
    before, share = np.zeros(x.shape), 0.0
    for k, n in enumerate(range(m + 1, n_max + 1)):
        # z p_(n-1) = c_n p_n + c_(n-1) p_(n-2)
        c = math.sqrt((n * n - m * m) / (4 * n * n - 1))
        functions[k + 1] = (x * functions[k] - share * before) / c
        before, share = functions[k], c
    return functions


def legendre_coefficients(
    function: Callable[[float], float],
    n_max: int,
    m: int = 0,
    breaks: Sequence[float] = (),
    accuracy: float = 1e-12,
) -> FloatArray:
    """Coefficients of the expansion of a function in Legendre functions of order m (I.9.3, I.9.4).

    Parameters
    ----------
    function : callable
        g(z), real, z in [-1, 1].
    n_max : int
        Last degree.
    m : int
        Order, from 0 to n_max.
    breaks : sequence of float
        Points at which g or its slope is discontinuous.
    accuracy : float
        Largest half-width of the integrals, as a fraction of the largest coefficient (for functions
        of unit norm).

    Returns
    -------
    ndarray, shape (n_max + 1 - m,)
        g_nm for n = m to n_max.

    Raises
    ------
    AccuracyError
        If the quadrature does not reach the accuracy.
    """
    roots = _roots_of_norms(n_max, m)
    result, error = quad_vec(
        lambda z: function(z) * orthonormal_functions(n_max, z, m),
        -1.0,
        1.0,
        epsabs=0.0,
        epsrel=accuracy,
        norm="max",
        points=breaks,
        limit=_INTERVALS,
    )
    scale = float(np.max(np.abs(result)))
    # The odd coefficients of an even function are nonzero at this level by rounding; this is no
    # failure.
    if not error <= max(10 * accuracy, 1e-14) * max(scale, np.finfo(float).tiny):
        raise AccuracyError(
            accuracy * scale,
            error,
            "(of a coefficient)",
            "list the discontinuities of the function in breaks",
        )
    return np.asarray(result / roots)


def legendre_sum(coefficients: ArrayLike, z: ArrayLike, m: int = 0) -> FloatArray:
    """Sum over n of coefficients g_nm times Legendre functions P_nm(z) (I.9.3, I.9.4).

    The degree n runs from m on.

    Parameters
    ----------
    coefficients : array_like, shape (k,)
        g_nm from n = m on.
    z : array_like, shape (...)
        In [-1, 1].
    """
    weights = np.atleast_1d(np.asarray(coefficients, dtype=float))
    n_max = m + weights.size - 1
    weights = weights * _roots_of_norms(n_max, m)
    return np.asarray(np.tensordot(weights, orthonormal_functions(n_max, z, m), axes=1))


def completeness_kernel(n_max: int, z: ArrayLike, other: ArrayLike, m: int = 0) -> FloatArray:
    """Sum over n of P_nm(z) P_nm(z')/K_nm, which tends to delta(z - z') (I.9.3, I.9.4).

    Parameters
    ----------
    n_max : int
        Last degree.
    z, other : array_like
        Points in [-1, 1]; they broadcast.
    m : int
        Order.

    Returns
    -------
    ndarray
        Integrated with a polynomial of degree up to n_max, times (1 - z2)^(m/2), the kernel
        reproduces that function.
    """
    first, second = np.broadcast_arrays(_argument(z), _argument(other))
    products = orthonormal_functions(n_max, first, m) * orthonormal_functions(n_max, second, m)
    return np.asarray(np.sum(products, axis=0))


def _roots_of_norms(n_max: int, m: int) -> FloatArray:
    """Square roots of K_nm, the integrals of P_nm squared, for n = m to n_max."""
    _check_order(n_max, m)
    return np.sqrt([legendre_norm(n, m) for n in range(m, n_max + 1)])


def _argument(z: ArrayLike) -> FloatArray:
    """Return the argument z of Legendre functions as an array; refuse values outside [-1, 1]."""
    values = np.asarray(z, dtype=float)
    wrong = ~(np.abs(values) <= 1)
    if np.any(wrong):
        raise UndefinedError(
            f"z = {float(values[wrong].flat[0])!r} is outside -1 to 1; give the cosine of an angle"
        )
    return values


def _check_order(n: int, m: int) -> None:
    """Raise an error unless the order m of a Legendre function satisfies 0 <= m <= n."""
    if degree("degree n", n) < degree("order m", m):
        raise UndefinedError(f"order m = {m} exceeds the degree n = {n}; allowed: 0 to {n}")
