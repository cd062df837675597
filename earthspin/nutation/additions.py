r"""Amplitudes that IAU 2000A adds to some nutation terms, besides the response of the interior.

Mathews, Herring & Buffett (2002) multiply a rigid series by a resonance form (`response`) and add a
few terms: the Sun-synchronous atmospheric tide in the prograde annual term, second-order effects at
18.6 years, and corrections to the form itself, largest near the resonance of the core. If a form is
fitted to the sum, these terms bias the frequency and the damping of the resonance.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import UAS
from earthspin.numerics.arrays import ComplexArray

SOURCE = (
    "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068, as applied in a public VLBI code (SGDASS, "
    "vtd/include, series of 2003-12-27): REN-2000 times the resonance form with its corrections, "
    "mhb2000_addon_heo.i, less the same without, mhb2000_transf_heo.i; geodesic nutation is in "
    "neither"
)


class Addition(NamedTuple):
    """Amplitude that IAU 2000A adds to one circular term of nutation, uas.

    Attributes
    ----------
    multiples : tuple of int
        Multiples of l, l', F, D and the node; negated for the circular term of opposite sense.
    in_phase, out_of_phase : float
        Amplitudes in the convention of `circles.phases`, uas.
    """

    multiples: tuple[int, int, int, int, int]
    in_phase: float
    out_of_phase: float


#: All additions of 1 uas or more to the analysed luni-solar terms.
ADDITIONS = (
    Addition((0, -1, 0, 0, 0), -86.6, 107.2),
    Addition((0, 1, 0, 0, 0), -9.8, 107.5),
    Addition((0, 0, 0, 0, -1), -34.3, 0.9),
    Addition((0, 0, 2, -2, 2), -22.3, 23.1),
    Addition((0, 0, -2, 2, -2), -6.4, 7.3),
    Addition((0, 0, 2, 0, 2), 1.0, -6.4),
    Addition((0, 0, 0, 0, 1), 3.5, 0.0),
    Addition((-1, 0, 0, 0, 0), -2.0, 2.6),
    Addition((1, 0, 2, 0, 2), 0.8, -2.9),
    Addition((-1, 0, 0, 1, 0), 1.3, -2.4),
    Addition((0, 0, 0, 0, 2), -2.1, -0.1),
    Addition((0, -1, 0, 0, 1), -1.0, 1.2),
    Addition((0, 1, 2, -2, 2), -1.0, 1.0),
    Addition((0, 0, -2, 0, -2), -0.7, -1.0),
    Addition((0, 0, 2, 0, 1), 0.2, -1.2),
    Addition((0, -1, 0, 0, -1), -0.7, 0.9),
)


def added_to(multiples: NDArray[np.int64]) -> ComplexArray:
    """Amplitudes that IAU 2000A adds to given circular nutation terms; zero for most terms.

    Parameters
    ----------
    multiples : ndarray, shape (k, 5)
        Multiples of the Delaunay arguments.

    Returns
    -------
    ndarray, shape (k,), complex
        Factor of exp(i phi), rad.
    """
    by_multiples = {row.multiples: complex(row.in_phase, row.out_of_phase) for row in ADDITIONS}
    amplitudes = [by_multiples.get(tuple(multiple), 0j) for multiple in multiples.tolist()]
    return -1j * UAS * np.array(amplitudes)
