"""Relations between the moments of inertia of an oblate body and J2, H and e.

    J2 = (C - A)/(M a2)    H = (C - A)/C    e = (C - A)/A

with C the polar moment, A the (mean) equatorial one, a the equatorial radius. This J2 is
geodesy's; the source text's (I.9.30) is G (C - A). All functions accept arrays, including labelled
ones.
"""

from __future__ import annotations

from typing import Any

from earthspin.errors import UndefinedError

Numeric = Any


def moment_difference(j2: Numeric, mass: Numeric, radius: Numeric) -> Numeric:
    """Difference C - A of the moments of inertia of a body from its J2 (I.9.30), kg m2.

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
    """Zonal coefficient J2 from the difference C - A of the moments of inertia (I.9.30)."""
    return difference / (mass * radius**2)


def ellipticity_from_h(h: Numeric) -> Numeric:
    """Dynamical ellipticity e = (C - A)/A (of wobble) from H = (C - A)/C (of precession)."""
    return h / (1 - h)


def h_from_ellipticity(e: Numeric) -> Numeric:
    """Dynamical flattening H = (C - A)/C from the dynamical ellipticity e = (C - A)/A."""
    return e / (1 + e)


def h_mccullough(flattening: Numeric) -> Numeric:
    """Dynamical flattening H from the geometric flattening f, assuming (C - A)/A = f (I.9.52).

    McCullough's formula holds for a homogeneous spheroid, to first order in the flattening.
    """
    return h_from_ellipticity(flattening)


def h_homogeneous(j2: Numeric) -> Numeric:
    """Dynamical flattening H of a homogeneous body from its J2, with C = 0.4 M a2 (I.9.49)."""
    return j2 / 0.4


def homogeneous_ellipsoid(a: float, b: float, c: float) -> tuple[float, float, float]:
    """J2, H and triaxiality (B - A)/(M a2) of a homogeneous ellipsoid with longest semi-axis a.

    J2 has a as reference radius. The moments are M (b2 + c2)/5, M (a2 + c2)/5 and M (a2 + b2)/5.

    Parameters
    ----------
    a, b, c : float
        Semi-axes in one unit, the longest first and the spin axis last.
    """
    b2, c2 = (b / a) ** 2, (c / a) ** 2
    j2 = (1 + b2 - 2 * c2) / 10
    return j2, 5 * j2 / (1 + b2), (1 - b2) / 5


def polar_moment_factor(j2: Numeric, h: Numeric) -> Numeric:
    """Polar moment factor C/(M a2) = J2/H."""
    return j2 / h


def polar_moment(j2: Numeric, h: Numeric, mass: Numeric, radius: Numeric) -> Numeric:
    """Polar moment of inertia C from J2 and H, kg m2.

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
    """Inverse polar moment factor M a2/C = H/J2; 0 if H is 0.

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
