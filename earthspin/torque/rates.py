"""Rates and periods of precession from mean torques, with their errors.

With N the torque per unit of C - A, k the axis and n the normal of the orbit,

    psi' = (H/Omega) < N . (k x n)/sin2(obliquity) >

where the mean is that of `earthspin.torque.average.precessing_torque`,

so the rate depends on H but not on C and C - A separately, nor on G. The torque depends on C - A,
hence on the mass in kilograms and on G, which is known to 2e-5 only. The functions accept labelled
arrays, such as ten thousand bodies with different H.
"""

from __future__ import annotations

import math

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.numerics.arrays import Estimate, Numeric


def precession_estimate(
    precessing: Numeric,
    precessing_error: Numeric,
    h: Numeric,
    spin_rate: Numeric,
    u_h: float,
    u_gm: Numeric,
) -> Estimate:
    """Precession rate in longitude with its error, from the mean torque, rad/s.

    Parameters
    ----------
    precessing, precessing_error : float
        Mean `precessing_torque` of the torque per unit of C - A, and its half-width, s-2.
    h : float
        Dynamical flattening (C - A)/C.
    spin_rate : float
        rad/s.
    u_h, u_gm : float
        Relative standard uncertainties of H and of the perturber's GM.
    """
    rate = precession_rate(precessing, h, spin_rate)
    method = np.abs(precession_rate(precessing_error, h, spin_rate))
    return Estimate(rate, method, half_width(rate, u_h, u_gm))


def torque_estimate(
    vector: Numeric, vector_error: Numeric, bulge: Numeric, u_bulge: float, u_gm: Numeric
) -> Estimate:
    """Magnitude of the mean torque with its error, from the value per C - A, N m.

    Parameters
    ----------
    vector, vector_error : float
        Magnitude of the mean torque per unit of C - A, and its half-width, s-2.
    bulge : float
        C - A, kg m2.
    u_bulge, u_gm : float
        Relative standard uncertainties of C - A and of the perturber's GM.
    """
    torque = np.abs(bulge) * vector
    return Estimate(torque, np.abs(bulge) * vector_error, half_width(torque, u_bulge, u_gm))


def precession_rate(precessing: Numeric, h: Numeric, spin_rate: Numeric) -> Numeric:
    """Rate of precession in longitude from a mean torque, rad/s; positive westward.

    Parameters
    ----------
    precessing : float
        Mean `precessing_torque` of the torque per unit of C - A, s-2.
    h : float
        Dynamical flattening (C - A)/C.
    spin_rate : float
        rad/s.
    """
    return h / spin_rate * precessing


def period(rate: Numeric) -> Numeric:
    """Period of one revolution at a given rate (rad per unit of time); infinite for rate 0."""
    with np.errstate(divide="ignore"):
        return 2 * math.pi / np.abs(rate)


def period_error(rate: Numeric, rate_error: Numeric) -> Numeric:
    """Half-width of a period, from a rate and the half-width of the rate, to first order.

    The result is infinite for rate zero, and NaN if the error of any other rate is unknown.
    """
    with np.errstate(divide="ignore"):
        # x**0 is 1 even for NaN, so that an infinite period has an infinite half-width
        return period(rate) * (rate_error ** np.not_equal(rate, 0.0) / np.abs(rate))


def rate_ratio(precessing: Numeric) -> Numeric:
    """Ratio of each precessing torque to the first perturber's torque; 1 if both are 0."""
    reference = precessing[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(precessing == reference, 1.0, precessing / reference)


def total_uncertainty(precessing: Numeric, u_gm: Numeric) -> Numeric:
    """Relative uncertainties due to GM of each precessing torque and of the total torque.

    Parameters
    ----------
    precessing : ndarray, shape (perturber + 1, ...)
        The precessing torques and their total.
    u_gm : sequence of float, shape (perturber,)

    Returns
    -------
    ndarray
        Of the same shape as `precessing`.
    """
    u = np.reshape(np.asarray(u_gm, dtype=float), (-1, *(1,) * (precessing.ndim - 1)))
    individual = np.broadcast_to(u, (u.size, *precessing.shape[1:]))
    absolute = np.sqrt(np.sum((precessing[:-1] * u) ** 2, axis=0, keepdims=True))
    size = np.abs(precessing[-1:])
    total = np.divide(absolute, size, out=np.full_like(absolute, u.max()), where=size != 0)
    return np.concatenate([individual, total])


def half_width(value: Numeric, *relative_uncertainties: Numeric) -> Numeric:
    """95 % half-width of a product, from relative standard uncertainties of its factors."""
    variance = sum(u * u for u in relative_uncertainties)
    return NORMAL_95 * np.abs(value) * np.sqrt(variance)
