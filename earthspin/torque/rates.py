"""From mean torques to rates and periods of precession, each with its error.

With N the mean torque per unit of C - A, turned into a rate of the node by
`earthspin.torque.average.longitude_rate`,

    psi' = (H/Omega) <N . (k x n)> / sin2(obliquity)

so the rate needs H alone, not C and C - A apart, and not G. The torque itself needs C - A,
hence the mass in kilograms, hence G, which is known to 2e-5 only. The formulas are plain
arithmetic and take labelled arrays: ten thousand bodies with different H are one call.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.mass.inertia import moment_difference

Numeric = Any


def precession_rate(geometry: Numeric, h: Numeric, spin_rate: Numeric) -> Numeric:
    """Rate of precession in longitude, rad/s; positive westward, as the Earth's is.

    Parameters
    ----------
    geometry : float
        Mean `longitude_rate` of the torque per unit of C - A, s-2.
    h : float
        Dynamical flattening (C - A)/C.
    spin_rate : float
        rad/s.
    """
    return h / spin_rate * geometry


def period(rate: Numeric) -> Numeric:
    """Time for one turn, in the unit of time of the rate (radians); infinite at rest."""
    with np.errstate(divide="ignore"):
        return 2 * math.pi / np.abs(rate)


def period_error(rate: Numeric, rate_error: Numeric) -> Numeric:
    """Half-width of the period, to first order; infinite at rest."""
    with np.errstate(divide="ignore", invalid="ignore"):
        # fmax takes the other where 0/0 leaves no number, so that infinity stays infinity
        return period(rate) * np.fmax(rate_error / np.abs(rate), np.finfo(float).tiny)


def rate_ratio(geometry: Numeric) -> Numeric:
    """Each rate over that of the first; 1 where they are equal, be they both nothing."""
    first = geometry[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(geometry == first, 1.0, geometry / first)


def rate_input_error(rate: Numeric, u_h: float, u_gm: Numeric) -> Numeric:
    """95 % half-width of the rate from the uncertainty of H and of the perturber's GM.

    Parameters
    ----------
    rate : float
    u_h, u_gm : float
        Relative standard uncertainties.
    """
    return NORMAL_95 * np.abs(rate) * np.hypot(u_h, u_gm)


def mean_torque(vector: Numeric, j2: Numeric, mass: Numeric, radius: Numeric) -> Numeric:
    """Magnitude of the mean torque, N m, from the mean torque per unit of C - A, s-2."""
    return np.abs(moment_difference(j2, mass, radius)) * vector


def torque_input_error(torque: Numeric, u_bulge: float, u_gm: Numeric) -> Numeric:
    """95 % half-width of a mean torque from C - A and from the perturber's GM.

    Parameters
    ----------
    torque : float
        N m.
    u_bulge, u_gm : float
        Relative standard uncertainties.
    """
    return NORMAL_95 * torque * np.hypot(u_bulge, u_gm)


def circular_orbit_rate(gm: float, distance: float, obliquity: float) -> float:
    """Closed form of the mean geometry for a circular orbit in the plane of reference, s-2.

    Parameters
    ----------
    gm : float
        m3 s-2.
    distance : float
        Radius of the orbit, m.
    obliquity : float
        rad.
    """
    return 1.5 * gm / distance**3 * math.cos(obliquity)
