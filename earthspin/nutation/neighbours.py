"""Terms of nutation that a century and a half does not part from a larger neighbour.

The arguments of most differ by twice the longitude of the Sun's perihelion, which goes round in
10,467 years: an analysis of what the kernels cover finds the two as one. How much of an amplitude
is the neighbour's is known from the series of IAU 2000A.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import ARCSEC, DAY, EPSILON_0, MAS
from earthspin.nutation.circles import ComplexArray, FloatArray, term_names

SOURCE = "IAU 2000A, IERS Conventions (2003), IERS Technical Note 32, tables 5.3a and 5.3b"


class Term(NamedTuple):
    """One term of the series, at J2000.0, in units of 0.1 uas, as it is tabulated.

    Attributes
    ----------
    multiples : tuple of int
        Of l, l', F, D and the node.
    sine, cosine : float
        Of dpsi.
    deps_cosine, deps_sine : float
        Of deps.
    """

    multiples: tuple[int, int, int, int, int]
    sine: float
    cosine: float
    deps_cosine: float
    deps_sine: float


#: The terms above 0.06 mas that stand beside a larger one. A further one, 0 -2 2 -2 2, goes round
#: in 10,467 years itself and is found with the slow part.
LEFT_OUT = (
    Term((0, -1, 2, -2, 2), 215829.0, 111.0, -95929.0, 132.0),
    Term((0, 2, 0, 0, 0), 16707.0, -10.0, 168.0, 10.0),
    Term((0, -1, 2, -2, 1), -4752.0, -3.0, 2719.0, -3.0),
    Term((0, -2, 2, -2, 1), -1283.0, 0.0, 672.0, 0.0),
    Term((-1, 0, 1, 0, 1), 0.0, -1044.0, 0.0, -891.0),
)


class Neighbours(NamedTuple):
    """What the terms left out add to the amplitudes of those that are found.

    Attributes
    ----------
    names : list of str
        Multiples of the neighbour by term; empty where there is none.
    amplitude : ndarray, shape (k,), complex
        Factor of exp(i phi) of the *found* term, rad.
    """

    names: list[str]
    amplitude: ComplexArray


def neighbours_of(
    multiples: NDArray[np.int64], frequency: FloatArray, rates: FloatArray, arguments: FloatArray
) -> Neighbours:
    """Share of the terms left out in the amplitudes that an analysis about J2000.0 finds.

    Parameters
    ----------
    multiples : ndarray, shape (k, 5)
        Of the terms found.
    frequency : ndarray, shape (k,)
        rad/s.
    rates : ndarray, shape (5,)
        Of the Delaunay arguments, rad/s.
    arguments : ndarray, shape (5,)
        At J2000.0, rad.
    """
    names, amplitude = [""] * len(multiples), np.zeros(len(multiples), dtype=complex)
    for term in LEFT_OUT:
        forward, backward = circles_of(term)
        for sign, size in ((1, forward), (-1, backward)):
            own = sign * np.array(term.multiples)
            nearest = int(np.argmin(np.abs(frequency - own @ rates)))
            turned = np.exp(1j * ((own - multiples[nearest]) @ arguments))
            (names[nearest],) = term_names(own[np.newaxis])
            amplitude[nearest] += size * turned
    return Neighbours(names, amplitude)


def circles_of(term: Term) -> tuple[complex, complex]:
    """Factors of exp(i phi) and exp(-i phi) of dpsi sin(eps0) + i deps, rad."""
    longitude = np.sin(EPSILON_0.value * ARCSEC) * np.array([term.cosine, term.sine])
    obliquity = 1j * np.array([term.deps_cosine, term.deps_sine])
    cosine, sine = 1e-4 * MAS * (longitude + obliquity)
    return complex(cosine - 1j * sine) / 2, complex(cosine + 1j * sine) / 2


def amplitude_error(frequency: FloatArray) -> FloatArray:
    """What the analysis may miss of an amplitude, its neighbour apart, rad.

    Measured on the series of IAU 2000A, whose amplitudes are known: 0.042 mas for the terms of the
    node, 0.038 mas for half a year, 0.007 mas for what is shorter than 100 days.

    Parameters
    ----------
    frequency : ndarray, shape (k,)
        rad/s.
    """
    days = np.abs(2 * np.pi / frequency) / DAY
    return MAS * np.select([days > 1000.0, days > 100.0], [0.06, 0.05], 0.01)
