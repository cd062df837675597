"""Moments of inertia of an oblate body, and the numbers that stand for them.

    J2 = (C - A)/(M a2)    H = (C - A)/C    e = (C - A)/A

with C the polar moment, A the (mean) equatorial one, a the equatorial radius. This J2 is
geodesy's; the source text's (I.9.30) is G (C - A). The relations are plain arithmetic and
take arrays, labelled ones too.
"""

from __future__ import annotations

from typing import Any

from earthspin.errors import UndefinedError

Numeric = Any


def moment_difference(j2: Numeric, mass: Numeric, radius: Numeric) -> Numeric:
    """C - A from J2: the bulge that torques act on, kg m2 (I.9.30).

    Parameters
    ----------
    j2 : float
    mass : float
        kg.
    radius : float
        Equatorial radius that j2 refers to, m.
    """
    return j2 * mass * radius**2


def j2_from_moment_difference(difference: Numeric, mass: Numeric, radius: Numeric) -> Numeric:
    """J2 from C - A, the inverse of `moment_difference` (I.9.30)."""
    return difference / (mass * radius**2)


def ellipticity_from_h(h: Numeric) -> Numeric:
    """(C - A)/A from H = (C - A)/C: the wobble divides by A, the precession by C."""
    return h / (1 - h)


def h_from_ellipticity(e: Numeric) -> Numeric:
    """H = (C - A)/C from e = (C - A)/A."""
    return e / (1 + e)


def h_mccullough(flattening: Numeric) -> Numeric:
    """H if the flattening of the figure stood for (I3 - I1)/I1 (I.9.52).

    McCullough's formula holds for a homogeneous spheroid, to first order in the flattening.
    """
    return h_from_ellipticity(flattening)


def h_homogeneous(j2: Numeric) -> Numeric:
    """H from J2 if the body were as dense throughout, C = 0.4 M a2 (I.9.49)."""
    return j2 / 0.4


def homogeneous_ellipsoid(a: float, b: float, c: float) -> tuple[float, float, float]:
    """J2, H and (B - A)/(M a2) of an ellipsoid of one density; J2 refers to its longest axis.

    Its moments are M (b2 + c2)/5, M (a2 + c2)/5 and M (a2 + b2)/5.

    Parameters
    ----------
    a, b, c : float
        Semi-axes, the longest first and that of the spin last, in one unit.
    """
    b2, c2 = (b / a) ** 2, (c / a) ** 2
    j2 = (1 + b2 - 2 * c2) / 10
    return j2, 5 * j2 / (1 + b2), (1 - b2) / 5


def polar_moment_factor(j2: Numeric, h: Numeric) -> Numeric:
    """C/(M a2) from the two numbers that are measured."""
    return j2 / h


def polar_moment(j2: Numeric, h: Numeric, mass: Numeric, radius: Numeric) -> Numeric:
    """C from the two numbers that are measured, kg m2.

    Parameters
    ----------
    j2, h : float
    mass : float
        kg.
    radius : float
        Equatorial radius that j2 refers to, m.
    """
    return polar_moment_factor(j2, h) * mass * radius**2


def inverse_polar_moment(j2: float, h: float) -> float:
    """M a2/C from the two numbers that are measured; 0 where H is 0, whatever J2.

    Raises
    ------
    UndefinedError
        If there is a flattening H but no J2.
    """
    if h == 0:
        return 0.0
    if j2 == 0:
        raise UndefinedError(f"M a2/C = H/J2 is not defined for H = {h!r} and j2 = 0; set j2")
    return h / j2
