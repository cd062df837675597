r"""What IAU 2000A adds to a response: at single terms its authors correct the resonance form.

Mathews, Herring & Buffett (2002) multiply a rigid series by a resonance form (`response`) and add a
few numbers: what the Sun-synchronous tide of the air does to the prograde year, what is of the
second order at 18.6 years, and corrections of the form itself, largest beside the resonance of the
core. A form that is fitted to the sum takes them for a shift of the resonance, or for a loss.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import UAS
from earthspin.nutation.circles import ComplexArray

SOURCE = (
    "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068, as applied in a public VLBI code (SGDASS, "
    "vtd/include, series of 2003-12-27): REN-2000 times the resonance form with its corrections, "
    "mhb2000_addon_heo.i, less the same without, mhb2000_transf_heo.i; geodesic nutation is in "
    "neither"
)


class Addition(NamedTuple):
    """What is added to one circle.

    Attributes
    ----------
    multiples : tuple of int
        Of l, l', F, D and the node; negated for the circle that turns the other way.
    in_phase, out_of_phase : float
        uas, as `nutation.phases` has them.
    """

    multiples: tuple[int, int, int, int, int]
    in_phase: float
    out_of_phase: float


#: All of a microarcsecond or more among the luni-solar terms that are analysed.
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
    """What IAU 2000A adds to each of some circles; 0 to most.

    Parameters
    ----------
    multiples : ndarray, shape (k, 5)
        Of the Delaunay arguments.

    Returns
    -------
    ndarray, shape (k,), complex
        Factor of exp(i phi), rad.
    """
    of = {one.multiples: complex(one.in_phase, one.out_of_phase) for one in ADDITIONS}
    found = [of.get(tuple(multiple), 0j) for multiple in multiples.tolist()]
    return -1j * UAS * np.array(found)
