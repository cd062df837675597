"""The free wobble of a body, rung by rung, from a formula of flattening to a rigid body.

Each rung gives the period in turns of the body. The rungs are factors, not steps of
days: they do not commute. Later rungs (elastic mantle, core, oceans) stand on these.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.mass.inertia import ellipticity_from_h, polar_moment_factor

Numeric = Any


def turns_from_flattening(flattening: Numeric) -> Numeric:
    """Turns per wobble if the flattening stood for (C - A)/A, McCullough's formula (I.9.52)."""
    return _over(1.0, flattening)


def turns_rigid(h: Numeric) -> Numeric:
    """Turns per wobble of a rigid axisymmetric body, A/(C - A) (I.6.7)."""
    return np.abs(_over(1.0, ellipticity_from_h(h)))


def turns_triaxial(h: Numeric, j2: Numeric, triaxiality: Numeric) -> Numeric:
    """Turns per wobble of a rigid triaxial body at small amplitude.

    sqrt(A B/((C - A)(C - B))), linearised Euler equations (I.4.4), from differences only.

    Parameters
    ----------
    h : float
        (C - (A + B)/2)/C.
    j2 : float
        (C - (A + B)/2)/(M a2).
    triaxiality : float
        (B - A)/(M a2).

    Raises
    ------
    UndefinedError
        If the polar moment does not follow from J2 and H, or is not an extreme one.
    """
    if not np.any(triaxiality):
        return turns_rigid(h)
    if np.any(np.equal(h, 0)):
        raise UndefinedError(
            "with H = 0 the polar moment does not follow from J2; set triaxiality to 0"
        )
    e = ellipticity_from_h(h)
    mean_equatorial = polar_moment_factor(j2, h) - j2
    half = triaxiality / mean_equatorial / 2
    if np.any(abs(half) > abs(e)):
        raise UndefinedError(
            "the spin axis is the middle one of the three principal axes: it is not stable, "
            "so there is no wobble about it"
        )
    return np.sqrt(_over(1 - half**2, (e - half) * (e + half)))


def factors(turns: Numeric) -> Numeric:
    """Each rung over the one before it; 1 for the first. Rungs along the first axis."""
    values = np.asarray(turns)
    below, above = values[:-1], values[1:]
    with np.errstate(invalid="ignore"):  # a sphere has every rung at infinity
        steps = np.where(above == below, 1.0, above / below)
    return np.concatenate([np.ones_like(values[:1]), steps])


def _over(numerator: Numeric, denominator: Numeric) -> Numeric:
    """Quotient that is infinite where the denominator vanishes: a sphere does not wobble."""
    with np.errstate(divide="ignore"):
        return np.divide(numerator, denominator)
