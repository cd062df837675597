"""The axisymmetric rotor without torque (I.6)."""

from __future__ import annotations

from typing import Any

import numpy as np

from earthspin.constants import NORMAL_95

Numeric = Any


def free_wobble_period(ellipticity: Numeric, spin_period: Numeric) -> Numeric:
    """Period of the body cone of a rotor that spins nearly about its axis (I.6.7), s.

    The angular velocity circles the figure axis at Omega' = omega (I3 - I1)/I1; the
    denominator is the equatorial moment, not the polar one.

    Parameters
    ----------
    ellipticity : float
        (C - A)/A; a sphere does not wobble and gives infinity.
    spin_period : float
        s; the result is in the same unit, and positive whichever way the wobble goes.
    """
    with np.errstate(divide="ignore"):
        return np.abs(np.divide(spin_period, ellipticity))


def free_wobble_error(period: Numeric, h: Numeric, u_h: float) -> Numeric:
    """95 % half-width of the wobble's period from the uncertainty of H.

    Parameters
    ----------
    period : float
        s; the result is in the same unit.
    h : float
        Dynamical flattening; the period is (1 - H)/H turns, so dP/P = dH/H/(1 - H).
    u_h : float
        Relative standard uncertainty of the dynamical flattening.
    """
    return NORMAL_95 * period * u_h / (1 - h)
