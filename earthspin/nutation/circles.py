r"""Frequency analysis of nutation into circular terms, for any pole.

With nutation as one complex number, eta = dpsi sin(eps0) + i deps, a pole's motion against
the mean equator is a sum of circles,

    \eta(t) = \sum_k A_k^+ e^{i phi_k} + A_k^- e^{-i phi_k} + slow,

whose arguments phi_k are integer combinations of the five Delaunay arguments. The amplitudes follow
from least squares, so that the amplitudes of two poles can be compared term by term.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, cg

from earthspin.constants import ARCSEC, EPSILON_0
from earthspin.numerics.arrays import ComplexArray, FloatArray

#: Multiples of l, l', F, D and the node: the luni-solar terms of IAU 2000B (McCarthy & Luzum
#: 2003, Celest. Mech. 85, 37), which are the largest of IAU 2000A. Five are omitted, because
#: centuries of data cannot separate them from a larger neighbouring term (the arguments differ by
#: twice the
#: longitude of the perihelion, 10,467 years): 0 -2 2 -2 2 and 0 -2 2 -2 1, 0 2 0 0 0,
#: 0 -1 2 -2 1 and 0 -1 2 -2 2. Their amplitudes are included in those of the neighbours.
_TERMS = """
    0 0 0 0 1 / 0 0 2 -2 2 / 0 0 2 0 2 / 0 0 0 0 2 / 0 1 0 0 0 / 0 1 2 -2 2 / 1 0 0 0 0 /
    0 0 2 0 1 / 1 0 2 0 2 / 0 0 2 -2 1 / -1 0 2 0 2 / -1 0 0 2 0 / 1 0 0 0 1 / -1 0 0 0 1 /
    -1 0 2 2 2 / 1 0 2 0 1 / -2 0 2 0 1 / 0 0 0 2 0 / 0 0 2 2 2 / -2 0 0 2 0 / 2 0 2 0 2 /
    1 0 2 -2 2 / -1 0 2 0 1 / 2 0 0 0 0 / 0 0 2 0 0 / 0 1 0 0 1 / -1 0 0 2 1 / 0 2 2 -2 2 /
    0 0 -2 2 0 / 1 0 0 -2 1 / 0 -1 0 0 1 / -1 0 2 2 1 / 1 0 2 2 2 / -2 0 2 0 0 / 0 1 2 0 2 /
    0 0 2 2 1 / 0 -1 2 0 2 / 0 0 0 2 1 / 1 0 2 -2 1 / 2 0 2 -2 2 / -2 0 0 2 1 / 2 0 2 0 1 /
    0 0 0 -2 1 / -1 -1 0 2 0 / 2 0 0 -2 1 / 1 0 0 2 0 / 0 1 2 -2 1 / 1 -1 0 0 0 /
    -2 0 2 0 2 / 3 0 2 0 2 / 0 -1 0 2 0 / 1 -1 2 0 2 / 0 0 0 1 0 / -1 -1 2 2 2 / -1 0 2 0 0 /
    0 -1 2 2 2 / -2 0 0 0 1 / 1 1 2 0 2 / 2 0 0 0 1 / -1 1 0 1 0 / 1 1 0 0 0 / 1 0 2 0 0 /
    -1 0 2 -2 1 / 1 0 0 0 2 / -1 0 0 1 0 / 0 0 2 1 2 / -1 0 2 4 2 / -1 1 0 1 1 / 1 0 2 2 1 /
    -2 0 2 2 2 / -1 0 0 0 2 / 1 1 2 -2 2
"""
MULTIPLES = np.array([term.split() for term in _TERMS.split("/")], dtype=int)

#: Terms whose amplitude changes noticeably in a century.
_GROWING = ("0 0 0 0 1", "0 0 2 -2 2", "0 0 2 0 2", "0 1 0 0 0", "0 0 0 0 2")
SLOW_DEGREE = 4
#: Rows of the normal matrix that are computed together.
BLOCK = 16
#: Convergence tolerance of the least squares, relative to the initial residual.
NEAR_ENOUGH = 1e-12


@dataclass(frozen=True)
class Circles:
    """Circular terms of a pole's motion: Delaunay multiples, frequencies and complex amplitudes.

    Attributes
    ----------
    multiples : ndarray, shape (k, 5)
        Multiples of the Delaunay arguments; negated for the circular term of opposite sense.
    frequency : ndarray, shape (k,)
        Frequency in space at J2000.0, rad/s; negative if retrograde.
    amplitude : ndarray, shape (k,), complex
        Factor of exp(i phi), rad.
    slow : ndarray, shape (SLOW_DEGREE + 1,), complex
        Coefficients of the secular polynomial in Julian centuries, rad.
    """

    multiples: NDArray[np.int64]
    frequency: FloatArray
    amplitude: ComplexArray
    slow: ComplexArray

    def at(self, arguments: FloatArray) -> ComplexArray:
        """Sum of the circular terms at given times; the secular motion is not included.

        Parameters
        ----------
        arguments : ndarray, shape (5, t)
            Delaunay arguments, rad.
        """
        total = np.zeros(arguments.shape[1], dtype=complex)
        for multiple, amplitude in zip(self.multiples, self.amplitude, strict=True):
            total += amplitude * np.exp(1j * (multiple @ arguments))
        return total


def term_names(multiples: NDArray[np.int64]) -> list[str]:
    """Names of nutation terms, from the multiples of their Delaunay arguments, shape (k, 5)."""
    return [" ".join(f"{m:+d}" for m in multiple) for multiple in multiples]


def responses(
    circles: Circles, arguments: FloatArray, factors: Mapping[str, ComplexArray]
) -> dict[str, ComplexArray]:
    """Sum the circular terms at given times after multiplying their amplitudes by response factors.

    There is one result for each set of factors.

    Parameters
    ----------
    circles : Circles
    arguments : ndarray, shape (5, t)
        Delaunay arguments, rad.
    factors : mapping of str to ndarray, shape (k,), complex
        Factors of the amplitudes, by name.

    Returns
    -------
    dict of str to ndarray, shape (t,), complex
        rad.
    """
    sizes = np.array([factor * circles.amplitude for factor in factors.values()])
    total = np.zeros((len(sizes), arguments.shape[1]), dtype=complex)
    for multiple, amplitude in zip(circles.multiples, sizes.T, strict=True):
        total += amplitude[:, np.newaxis] * np.exp(1j * (multiple @ arguments))
    return dict(zip(factors, total, strict=True))


class FrequencyAnalysis:
    """Least-squares fit of the amplitudes of all circular terms together.

    Parameters
    ----------
    centuries : ndarray, shape (t,)
        Julian centuries from J2000.0.
    arguments : ndarray, shape (5, t)
        Delaunay arguments, rad.
    rates : ndarray, shape (5,)
        Their rates at J2000.0, rad/s.
    """

    def __init__(self, centuries: FloatArray, arguments: FloatArray, rates: FloatArray) -> None:
        # Real functions with complex factors: x cos(phi) + y sin(phi) is A+ e^(i phi) + A- e^(-i
        # phi) with A+, A- = (x -+ i y) / 2. No BLAS here and below: its rounding depends on the
        # number of threads, and results must be reproducible to the bit.
        phase = np.einsum("kj,jt->kt", MULTIPLES, arguments)
        circles = np.concatenate([np.cos(phase), np.sin(phase)])
        growing = [MULTIPLES.tolist().index([int(m) for m in t.split()]) for t in _GROWING]
        drift = centuries * circles[[*growing, *(len(MULTIPLES) + k for k in growing)]]
        slow = centuries ** np.arange(SLOW_DEGREE + 1)[:, np.newaxis]
        self._rows = np.concatenate([circles, slow, drift])
        self._scale = np.linalg.norm(self._rows, axis=1)
        self._rows /= self._scale[:, np.newaxis]
        normal = np.empty((len(self._rows), len(self._rows)))
        for first in range(0, len(normal), BLOCK):  # symmetric, so half of it is enough
            block = slice(first, first + BLOCK)
            normal[block, first:] = np.einsum("it,jt->ij", self._rows[block], self._rows[first:])
            normal[first:, block] = normal[block, first:].T
        self._normal = LinearOperator(
            normal.shape, matvec=lambda x: np.einsum("ij,j->i", normal, x), dtype=float
        )
        self._multiples = np.concatenate([MULTIPLES, -MULTIPLES])
        self._frequency = self._multiples @ rates

    def __call__(self, eta: ComplexArray) -> Circles:
        """Fit circular terms to the complex nutation of a pole, and return them.

        Parameters
        ----------
        eta : ndarray, shape (t,), complex
            dpsi sin(eps0) + i deps, rad.
        """
        both = np.stack([eta.real, eta.imag])
        factors = self._solved(both)
        residual = both - np.einsum("it,ci->ct", self._rows, factors)
        factors += self._solved(residual)
        together: ComplexArray = factors[0] + 1j * factors[1]
        together /= self._scale
        x, y = together[: 2 * len(MULTIPLES)].reshape(2, -1)
        amplitude: ComplexArray = np.concatenate([x - 1j * y, x + 1j * y])
        amplitude /= 2
        slow = together[2 * len(MULTIPLES) :][: SLOW_DEGREE + 1]
        return Circles(self._multiples, self._frequency, amplitude, slow)

    def _solved(self, both: FloatArray) -> FloatArray:
        """Solve the least-squares problem for the two parts of the complex nutation, shape (2, t).

        The solution is for rows of unit length. They are nearly orthogonal (condition number 20
        over 150 years), so that the normal equations are accurate enough, and conjugate gradients
        converge in forty iterations.
        """
        right = np.einsum("it,ct->ci", self._rows, both)
        return np.array([cg(self._normal, part, rtol=NEAR_ENOUGH, atol=0.0)[0] for part in right])


def complex_nutation(angles: FloatArray) -> ComplexArray:
    """Complex nutation dpsi sin(eps0) + i deps from the two nutation angles, shape (t, 2), rad."""
    sine = np.sin(EPSILON_0.value * ARCSEC)
    return np.asarray(angles[:, 0] * sine + 1j * angles[:, 1])


def phases(amplitude: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """In-phase and out-of-phase parts of complex nutation amplitudes, in the IERS convention.

    eta = -i sum (in + i out) exp(i phi) (Mathews, Herring & Buffett 2002).
    """
    turned = 1j * amplitude
    return turned.real, turned.imag


def without_line(centuries: FloatArray, series: FloatArray) -> FloatArray:
    """Subtract the least-squares linear trend from a series along its first axis."""
    design = np.stack([np.ones_like(centuries), centuries], axis=1)
    fit = np.linalg.lstsq(design, series, rcond=None)[0]
    return np.asarray(series - design @ fit)
