"""Figure, moments of inertia and distant gravity of oblate bodies.

Holds the geometry and moments of homogeneous spheroids (I.9.35 to I.9.52),
the relations between J2, H and e, and MacCullagh's potential and torque.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from earthspin.constants import G
from earthspin.errors import BodyError, UndefinedError
from earthspin.mass.tensor import first_wrong, positive, vectors
from earthspin.numerics.arrays import FloatArray, Numeric

# --- homogeneous spheroids ------------------------------------------------------------------------
# The spheroid has the equatorial radius a, the polar one c = a (1 - f), and
#
#     e2 = (a2 - c2)/a2 = f (2 - f)
#
# The flattening f is an input, positive for an oblate body and negative for a prolate one, so that
# a2 - c2 is never computed by subtraction. The source writes epsilon for f, A for the equatorial
# radius and a for the mean radius; here `radius` is always the equatorial radius and `mean_radius`
# the mean.

#: Most prolate figure tested: c = 10^6 a.
LEAST_FLATTENING = -1e6


class AxisymmetricMoments(NamedTuple):
    """Moments of inertia A, C and their difference C - A of an axisymmetric body.

    Attributes
    ----------
    equatorial : ndarray
        A, about any axis in the plane of the equator, kg m2.
    polar : ndarray
        C, about the axis of symmetry, kg m2.
    difference : ndarray
        C - A, computed without subtraction, kg m2.
    """

    equatorial: FloatArray
    polar: FloatArray
    difference: FloatArray


def check_flattening(flattening: ArrayLike) -> FloatArray:
    """Return flattenings as an array; refuse values outside -10^6 (needle) to 1 (disc).

    Parameters
    ----------
    flattening : array_like
        f = (a - c)/a.

    Raises
    ------
    BodyError
        If f is outside -10^6 (a needle) <= f < 1 (a disc).
    """
    values = np.asarray(flattening, dtype=float)
    wrong = ~((values >= LEAST_FLATTENING) & (values < 1))
    if np.any(wrong):
        allowed = "allowed: -1e6 (a needle) to below 1 (a disc), 0 for a sphere"
        raise BodyError("spheroid", "flattening", first_wrong(values, wrong), allowed)
    return values


def polar_radius(radius: ArrayLike, flattening: ArrayLike) -> FloatArray:
    """Polar radius c = a (1 - f) of a spheroid, in the unit of the equatorial radius a."""
    return np.asarray(np.asarray(radius, dtype=float) * (1 - check_flattening(flattening)))


def eccentricity_squared(flattening: ArrayLike) -> FloatArray:
    """Squared eccentricity (a2 - c2)/a2 = f (2 - f) of a spheroid, negative if prolate (I.9.38)."""
    f = check_flattening(flattening)
    return np.asarray(f * (2 - f))


def perimeter(radius: ArrayLike, flattening: ArrayLike, colatitude: ArrayLike) -> FloatArray:
    """Exact distance from the centre of a spheroid to its surface at a colatitude (I.9.36), m.

    Parameters
    ----------
    radius : array_like
        Equatorial radius a, m.
    flattening : array_like
        f.
    colatitude : array_like
        theta, from the axis of symmetry, rad.
    """
    a = positive("spheroid", "radius", radius)
    axis_ratio = 1 - check_flattening(flattening)
    cosine, sine = np.cos(colatitude), np.sin(colatitude)
    return np.asarray(a * axis_ratio / np.hypot(axis_ratio * sine, cosine))


def perimeter_about_mean(
    mean_radius: ArrayLike, flattening: ArrayLike, colatitude: ArrayLike
) -> FloatArray:
    """Distance from the centre of a spheroid to its surface, to first order in f (I.9.43), m.

    The formula is of first order in the flattening.

    Parameters
    ----------
    mean_radius : array_like
        Mean of the distance over all directions, m.
    flattening : array_like
        f.
    colatitude : array_like
        theta, from the axis of symmetry, rad.
    """
    mean = positive("spheroid", "mean radius", mean_radius)
    p2 = 1.5 * np.cos(colatitude) ** 2 - 0.5
    return np.asarray(mean * (1 - 2 / 3 * check_flattening(flattening) * p2))


def mean_radius(radius: ArrayLike, flattening: ArrayLike) -> FloatArray:
    """Exact radius of a spheroid, averaged over all directions from the centre, m.

    The integral (I.9.40) is a asinh(k)/k with k2 = e2/(1 - f)2, or the arcsine form for negative
    k2; Carlson's R_C covers both cases.
    """
    from scipy.special import elliprc

    a = positive("spheroid", "radius", radius)
    axis_ratio = 1 - check_flattening(flattening)
    return np.asarray(a * axis_ratio * elliprc(1.0, axis_ratio**2))


def spheroid_moments(
    mass: ArrayLike, radius: ArrayLike, flattening: ArrayLike
) -> AxisymmetricMoments:
    """Exact moments of inertia A, C and C - A of a homogeneous spheroid.

    A = (1/5) M (a2 + c2), C = (2/5) M a2, C - A = (1/5) M a2 f (2 - f).

    Parameters
    ----------
    mass : array_like
        kg.
    radius : array_like
        Equatorial radius a, m.
    flattening : array_like
        f; 0 gives the sphere's (2/5) M a2 about any axis.
    """
    fifth = positive("spheroid", "mass", mass) * positive("spheroid", "radius", radius) ** 2 / 5
    e2 = eccentricity_squared(flattening)
    axis_ratio = 1 - np.asarray(flattening, dtype=float)
    polar = 2 * fifth * np.ones_like(e2)
    return AxisymmetricMoments(
        np.asarray(fifth * (1 + axis_ratio**2)), polar, np.asarray(fifth * e2)
    )


# --- J2, H and e ----------------------------------------------------------------------------------
#     J2 = (C - A)/(M a2)    H = (C - A)/C    e = (C - A)/A
#
# with C the polar moment, A the (mean) equatorial one, a the equatorial radius. This J2 is
# geodesy's; the source text's (I.9.30) is G (C - A). All functions accept arrays, including
# labelled ones.


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
    """Dynamical ellipticity e = (C - A)/A, used for wobble, from H = (C - A)/C, for precession."""
    return h / (1 - h)


def h_maccullagh(flattening: Numeric) -> Numeric:
    """Dynamical flattening H from the geometric flattening f, assuming (C - A)/A = f (I.9.52).

    MacCullagh's formula holds for a homogeneous spheroid, to first order in the flattening.
    """
    return flattening / (1 + flattening)


def h_homogeneous(j2: Numeric) -> Numeric:
    """Dynamical flattening H of a homogeneous body from its J2, with C = 0.4 M a2 (I.9.49)."""
    return j2 / 0.4


def homogeneous_ellipsoid(a: float, b: float, c: float) -> tuple[float, float, float]:
    """J2, H and triaxiality (B - A)/(M a2) of a homogeneous ellipsoid, from the semi-axes.

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


# --- MacCullagh's formulas ------------------------------------------------------------------------
#     V = -GM/r - G/(2 r3) (A + B + C - 3 I)      I = n . I n, about the line to the point
#     N = 3 GM/r3 n x (I n)
#
# to order 1/r3, for any distribution of mass about its centre of mass. The quadrupole and the
# torque do not change if a multiple of the unit matrix is subtracted from the tensor. For a nearly
# spherical body pass the differences, np.diag([0, B - A, C - A]), to avoid cancellation.


def maccullagh_potential(mass: ArrayLike, tensor: ArrayLike, position: ArrayLike) -> FloatArray:
    """Gravitational potential far from a body of any shape, to order 1/r3, m2 s-2.

    Parameters
    ----------
    mass : array_like
        kg.
    tensor : array_like, shape (..., 3, 3)
        Inertia about the centre of mass, or its differences as above, kg m2.
    position : array_like, shape (..., 3)
        From the centre of mass, outside the body, along the axes of the tensor, m.
    """
    m = positive("rigid body", "mass", mass)
    n, r = _direction(position)
    # A + B + C - 3 I, as one contraction.
    shape = np.eye(3) - 3 * n[..., :, np.newaxis] * n[..., np.newaxis, :]
    quadrupole = np.sum(_less_sphere(tensor) * shape, axis=(-1, -2))
    return np.asarray(-G.value * (m / r + quadrupole / (2 * r**3)))


def maccullagh_potential_axisymmetric(
    mass: ArrayLike, moment_difference: ArrayLike, distance: ArrayLike, colatitude: ArrayLike
) -> FloatArray:
    """Gravitational potential far from a body of revolution, to order 1/r3 (I.9.31), m2 s-2.

    Parameters
    ----------
    mass : array_like
        kg.
    moment_difference : array_like
        C - A, kg m2.
    distance : array_like
        From the centre of mass, m.
    colatitude : array_like
        From the axis of symmetry, rad.
    """
    m = positive("rigid body", "mass", mass)
    r = positive("point", "distance", distance)
    p2 = 1.5 * np.cos(colatitude) ** 2 - 0.5
    return np.asarray(-G.value * (m / r - np.asarray(moment_difference) * p2 / r**3))


def maccullagh_torque(gm: ArrayLike, tensor: ArrayLike, position: ArrayLike) -> FloatArray:
    """Torque by a distant mass on a body of any shape, to order 1/r3 (I.9.32), N m.

    Parameters
    ----------
    gm : array_like
        Gravitational parameter of the distant mass, m3 s-2.
    tensor : array_like, shape (..., 3, 3)
        Inertia of the body about its centre of mass, or its differences as above, kg m2.
    position : array_like, shape (..., 3)
        From the body to the mass, along the axes of the tensor, m.

    Returns
    -------
    ndarray, shape (..., 3)
        Torque; for a body of revolution it is 3 GM (C - A)/r5 (r . k) (r x k).
    """
    mu = positive("point mass", "gm", gm)
    n, r = _direction(position)
    moment = np.einsum("...ij,...j->...i", _less_sphere(tensor), n)
    return np.asarray(3 * (mu / r**3)[..., np.newaxis] * np.cross(n, moment))


def _less_sphere(tensor: ArrayLike) -> FloatArray:
    """Inertia tensor minus its first diagonal element times the unit matrix.

    The torque is unchanged, but has no cancellation.
    """
    values = np.asarray(tensor, dtype=float)
    return np.asarray(values - values[..., :1, :1] * np.eye(3))


def _direction(position: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Unit vectors and lengths of position vectors; raise an error if a length is zero."""
    r = vectors("position", position)
    distance = np.asarray(np.sqrt(np.sum(r * r, axis=-1)))
    if np.any(distance == 0):
        raise UndefinedError(
            "position = [0, 0, 0] is the centre of the body; MacCullagh's formula holds outside it"
        )
    return r / distance[..., np.newaxis], distance
