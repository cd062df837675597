"""Nutation terms that 150 years of data cannot separate from a larger neighbouring term.

The arguments of most pairs differ by twice the longitude of the Sun's perihelion, with a period of
10,467 years, so that an analysis over the span of the kernels merges the two terms. The
contribution of the smaller term to a fitted amplitude is known from the series of IAU 2000A.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import ARCSEC, DAY, EPSILON_0, MAS
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation.circles import term_names

SOURCE = "IAU 2000A, IERS Conventions (2003), IERS Technical Note 32, tables 5.3a and 5.3b"


class Term(NamedTuple):
    """One term of the tabulated nutation series at J2000.0, with coefficients in units of 0.1 uas.

    Attributes
    ----------
    multiples : tuple of int
        Multiples of l, l', F, D and the node.
    sine, cosine : float
        Coefficients of dpsi.
    deps_cosine, deps_sine : float
        Coefficients of deps.
    """

    multiples: tuple[int, int, int, int, int]
    sine: float
    cosine: float
    deps_cosine: float
    deps_sine: float


#: The terms above 0.06 mas that have a larger neighbour. Another one, 0 -2 2 -2 2, itself has a
#: period of 10,467 years and is absorbed by the secular part.
LEFT_OUT = (
    Term((0, -1, 2, -2, 2), 215829.0, 111.0, -95929.0, 132.0),
    Term((0, 2, 0, 0, 0), 16707.0, -10.0, 168.0, 10.0),
    Term((0, -1, 2, -2, 1), -4752.0, -3.0, 2719.0, -3.0),
    Term((0, -2, 2, -2, 1), -1283.0, 0.0, 672.0, 0.0),
    Term((-1, 0, 1, 0, 1), 0.0, -1044.0, 0.0, -891.0),
)


class Neighbours(NamedTuple):
    """Errors of fitted nutation amplitudes due to small terms of almost the same frequency.

    Attributes
    ----------
    names : list of str
        Multiples of the omitted neighbour of each fitted term; empty if there is none.
    amplitude : ndarray, shape (k,), complex
        Contribution to the factor of exp(i phi) of the fitted term, rad.
    """

    names: list[str]
    amplitude: ComplexArray


def neighbours_of(
    multiples: NDArray[np.int64], frequency: FloatArray, rates: FloatArray, arguments: FloatArray
) -> Neighbours:
    """Compute how much omitted nutation terms change fitted terms with almost equal frequency.

    The fitted interval is centred on J2000.0.

    Parameters
    ----------
    multiples : ndarray, shape (k, 5)
        Multiples of the fitted terms.
    frequency : ndarray, shape (k,)
        Frequencies of the fitted terms, rad/s.
    rates : ndarray, shape (5,)
        Rates of the Delaunay arguments, rad/s.
    arguments : ndarray, shape (5,)
        Delaunay arguments at J2000.0, rad.
    """
    names, amplitude = [""] * len(multiples), np.zeros(len(multiples), dtype=complex)
    for term in LEFT_OUT:
        forward, backward = circles_of(term)
        for sign, size in ((1, forward), (-1, backward)):
            multiple = sign * np.array(term.multiples)
            nearest = int(np.argmin(np.abs(frequency - multiple @ rates)))
            turned = np.exp(1j * ((multiple - multiples[nearest]) @ arguments))
            (names[nearest],) = term_names(multiple[np.newaxis])
            amplitude[nearest] += size * turned
    return Neighbours(names, amplitude)


def circles_of(term: Term) -> tuple[complex, complex]:
    """Complex amplitudes of a nutation term's prograde and retrograde circular motion, rad."""
    longitude = np.sin(EPSILON_0.value * ARCSEC) * np.array([term.cosine, term.sine])
    obliquity = 1j * np.array([term.deps_cosine, term.deps_sine])
    cosine, sine = 1e-4 * MAS * (longitude + obliquity)
    return complex(cosine - 1j * sine) / 2, complex(cosine + 1j * sine) / 2


def amplitude_error(frequency: FloatArray) -> FloatArray:
    """Error of a fitted nutation amplitude, rad; the error due to close frequencies is excluded.

    Measured with the series of IAU 2000A, whose amplitudes are known: 0.042 mas for the 18.6-year
    and 9.3-year terms, 0.038 mas for the semi-annual term, 0.007 mas for periods below 100 days.

    Parameters
    ----------
    frequency : ndarray, shape (k,)
        rad/s.
    """
    days = np.abs(2 * np.pi / frequency) / DAY
    return MAS * np.select([days > 1000.0, days > 100.0], [0.06, 0.05], 0.01)
