"""Sun and Moon without a kernel, from the theories in ERFA."""

from __future__ import annotations

import numpy as np

from earthspin._lazy import erfa
from earthspin.constants import AU, J2000_JD
from earthspin.numerics.arrays import FloatArray


def sun(days: FloatArray) -> FloatArray:
    """Geocentric position of the Sun in the GCRS by `erfa.epv00`, m, shape (n, 3).

    Parameters
    ----------
    days : ndarray, shape (n,)
        Days from J2000.0 TDB; from 1950 to 2050 it is within 11 km of DE421.
    """
    return -AU * np.asarray(erfa.epv00(J2000_JD, days)[0]["p"])


def moon(days: FloatArray) -> FloatArray:
    """Geocentric position of the Moon in the GCRS by `erfa.moon98`, m, shape (n, 3).

    Parameters
    ----------
    days : ndarray, shape (n,)
        Days from J2000.0 TDB; from 1950 to 2050 it is within 32 km of DE421.
    """
    return AU * np.asarray(erfa.moon98(J2000_JD, days)["p"])
