"""IAU precession and nutation, through ERFA.

Matrices turn vectors from the axes of the GCRS to an equator and equinox of date: their
third row is the pole. Times are days from J2000.0 TDB, which serves for TT here (they
differ by 2 ms, 1e-10 arcsec of precession).
"""

from __future__ import annotations

from dataclasses import dataclass

import erfa
import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from earthspin.constants import DAY, J2000_JD

FloatArray = NDArray[np.float64]

#: Days between the nodes from which nutation is interpolated; no term is shorter than 2 days.
NUTATION_NODE_STEP = 1.0
_SPLINE_DEGREE = 5
_MARGIN = 4  # nodes beyond each end, so that every time lies well inside


def mean_equator(days: FloatArray) -> FloatArray:
    """Bias and precession matrix of IAU 2006.

    Parameters
    ----------
    days : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (n, 3, 3)
        GCRS to mean equator and equinox of date (`erfa.pmat06`).
    """
    return np.asarray(erfa.pmat06(J2000_JD, days))


def ecliptic_pole() -> FloatArray:
    """Pole of the ecliptic of J2000.0 (IAU 2006) in the GCRS, shape (3,)."""
    return np.asarray(erfa.ecm06(J2000_JD, 0.0)[2])


@dataclass(frozen=True)
class PrecessionRates:
    """Rates of the precession angles of IAU 2006 at an epoch, rad/s.

    Attributes
    ----------
    psi_a, omega_a : float
        Of the mean equator against the fixed ecliptic of J2000.0: longitude, obliquity.
    chi_a : float
        Of the ecliptic along the equator.
    """

    psi_a: float
    omega_a: float
    chi_a: float


def precession_rates(day: float) -> PrecessionRates:
    """Rates of the angles of IAU 2006, from `erfa.p06e` by central differences.

    Parameters
    ----------
    day : float
        Days from J2000.0 TDB.
    """
    step = 365.25  # the angles are polynomials in centuries: exact to 1e-13 of the rate
    before, after = (np.array(erfa.p06e(J2000_JD, day + s * step)) for s in (-1, 1))
    rates = (after - before) / (2 * step * DAY)
    # p06e gives, in this order, eps0, psia, oma, bpa, bqa, pia, bpia, epsa, chia, ...
    return PrecessionRates(psi_a=float(rates[1]), omega_a=float(rates[2]), chi_a=float(rates[8]))


def mean_longitude_of_node(days: FloatArray) -> FloatArray:
    """Mean longitude of the Moon's ascending node, rad (IERS 2003, `erfa.faom03`)."""
    return np.asarray(erfa.faom03(days / 36525.0))


class Nutation:
    """Nutation IAU 2000A adapted to IAU 2006, interpolated between nodes.

    `erfa.nut06a` costs some 30 us an epoch, a quintic spline through one node a day a few
    tenths of one, and between the nodes it is off by 7e-12 rad at most.

    Parameters
    ----------
    start, end : float
        Days from J2000.0 TDB between which angles will be asked for.
    size : int, optional
        How many epochs there will be; where they are fewer than the nodes, nothing is
        interpolated.
    """

    def __init__(self, start: float, end: float, size: int | None = None) -> None:
        if size is not None and size * NUTATION_NODE_STEP < end - start:
            self._angles = _nutation_angles
            return
        margin = _MARGIN * NUTATION_NODE_STEP
        count = int(np.ceil((end - start + 2 * margin) / NUTATION_NODE_STEP)) + 1
        nodes = start - margin + NUTATION_NODE_STEP * np.arange(count)
        self._angles = make_interp_spline(
            nodes, _nutation_angles(np.asarray(nodes)), k=_SPLINE_DEGREE
        )

    def true_equator(self, days: FloatArray) -> FloatArray:
        """GCRS to true equator and equinox of date.

        Parameters
        ----------
        days : ndarray, shape (n,)

        Returns
        -------
        ndarray, shape (n, 3, 3)
        """
        dpsi, deps = self._angles(days).T
        mean_obliquity = erfa.obl06(J2000_JD, days)
        nutation = erfa.numat(mean_obliquity, dpsi, deps)
        return np.asarray(erfa.rxr(nutation, mean_equator(days)))


def _nutation_angles(days: FloatArray) -> FloatArray:
    """Nutation in longitude and obliquity, rad, shape (n, 2) (`erfa.nut06a`)."""
    return np.stack(erfa.nut06a(J2000_JD, days), axis=-1)
