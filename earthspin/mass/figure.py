"""Surface, mean radius and moments of a homogeneous spheroid (I.9.35 to I.9.52).

The spheroid has the equatorial radius a, the polar one c = a (1 - f), and

    e2 = (a2 - c2)/a2 = f (2 - f)

The flattening f is an input, positive for an oblate body and negative for a prolate one, so that a2
- c2 is never computed by subtraction. Both exact and first-order formulas are given. The source
writes epsilon for f, A for the equatorial radius and a for the mean radius; here `radius` is always
the equatorial radius and `mean_radius` the mean.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import elliprc

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass._checks import first, positive
from earthspin.numerics.arrays import FloatArray

#: Most prolate figure tested: c = 10^6 a.
LEAST_FLATTENING = -1e6


class Moments(NamedTuple):
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
        raise BodyError(
            "spheroid",
            "flattening",
            first(values, wrong),
            "allowed: -1e6 (a needle) to below 1 (a disc), 0 for a sphere",
        )
    return values


def polar_radius(radius: ArrayLike, flattening: ArrayLike) -> FloatArray:
    """Polar radius c = a (1 - f) of a spheroid, in the unit of the equatorial radius a."""
    return np.asarray(np.asarray(radius, dtype=float) * (1 - check_flattening(flattening)))


def eccentricity_squared(flattening: ArrayLike) -> FloatArray:
    """Squared eccentricity (a2 - c2)/a2 = f (2 - f) of a spheroid, negative if prolate (I.9.38)."""
    f = check_flattening(flattening)
    return np.asarray(f * (2 - f))


def perimeter(radius: ArrayLike, flattening: ArrayLike, colatitude: ArrayLike) -> FloatArray:
    """Exact radius of a spheroid's surface at a given colatitude (I.9.36), m.

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


def perimeter_first_order(
    radius: ArrayLike, flattening: ArrayLike, colatitude: ArrayLike
) -> FloatArray:
    """Radius of a spheroid's surface at a given colatitude, to first order in f (I.9.39), m.

    In terms of the mean radius, `mean_radius_first_order`, the distance is <r> [1 - (2/3) f P2(cos
    theta)] to first order in f (I.9.43).
    """
    a = positive("spheroid", "radius", radius)
    return np.asarray(a * (1 - check_flattening(flattening) * np.cos(colatitude) ** 2))


def perimeter_about_mean(
    mean_radius: ArrayLike, flattening: ArrayLike, colatitude: ArrayLike
) -> FloatArray:
    """Radius of a spheroid's surface from the mean radius, to first order in f (I.9.43), m.

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
    a = positive("spheroid", "radius", radius)
    axis_ratio = 1 - check_flattening(flattening)
    return np.asarray(a * axis_ratio * elliprc(1.0, axis_ratio**2))


def mean_radius_first_order(radius: ArrayLike, flattening: ArrayLike) -> FloatArray:
    """Mean radius a (1 - f/3) of a spheroid, to first order in the flattening f (I.9.42), m."""
    a = positive("spheroid", "radius", radius)
    return np.asarray(a * (1 - check_flattening(flattening) / 3))


def spheroid_mass(density: ArrayLike, radius: ArrayLike, flattening: ArrayLike) -> FloatArray:
    """Mass of a homogeneous spheroid, (4 pi/3) rho a3 (1 - f), kg.

    (I.9.48) omits the factor 1 - f.
    """
    rho = positive("spheroid", "density", density)
    a = positive("spheroid", "radius", radius)
    return np.asarray(4 * np.pi / 3 * rho * a**3 * (1 - check_flattening(flattening)))


def spheroid_moments(mass: ArrayLike, radius: ArrayLike, flattening: ArrayLike) -> Moments:
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
    return Moments(np.asarray(fifth * (1 + axis_ratio**2)), polar, np.asarray(fifth * e2))


def moment_difference_first_order(
    mass: ArrayLike, radius: ArrayLike, flattening: ArrayLike
) -> FloatArray:
    """C - A of a homogeneous spheroid to first order in f: (2/5) f M a2 (I.9.49), kg m2.

    To this order the equatorial and the mean radius give the same result.
    """
    m, a = positive("spheroid", "mass", mass), positive("spheroid", "radius", radius)
    return np.asarray(0.4 * check_flattening(flattening) * m * a**2)


def moment_difference_from_density(
    density: ArrayLike, mean_radius: ArrayLike, flattening: ArrayLike
) -> FloatArray:
    """C - A of a homogeneous spheroid to first order in f: (8 pi/15) f rho a5 (I.9.47), kg m2.

    Parameters
    ----------
    density : array_like
        kg m-3.
    mean_radius : array_like
        Mean radius, m; any other radius of the body differs in second order.
    flattening : array_like
        f.
    """
    rho = positive("spheroid", "density", density)
    a = positive("spheroid", "mean radius", mean_radius)
    return np.asarray(8 * np.pi / 15 * check_flattening(flattening) * rho * a**5)


def ellipticity_homogeneous(flattening: ArrayLike) -> FloatArray:
    """Exact dynamical ellipticity (C - A)/A = (a2 - c2)/(a2 + c2) of a homogeneous spheroid.

    McCullough's formula (I.9.52) approximates it by the flattening.
    """
    e2 = eccentricity_squared(flattening)
    return np.asarray(e2 / (2 - e2))


def mccullough_error(flattening: ArrayLike) -> FloatArray:
    """Exact error of the approximation (C - A)/A = f for a homogeneous spheroid.

    It is about f2/2. For the effect of density variations, see `layered_moments`.
    """
    f = check_flattening(flattening)
    return np.asarray(f**2 * (1 - f) / (2 - eccentricity_squared(f)))


def layered_moments(
    radii: ArrayLike, densities: ArrayLike, flattenings: ArrayLike
) -> tuple[float, Moments]:
    """Exact mass and moments of homogeneous layers between concentric coaxial spheroids.

    If all layers have the same flattening, (C - A)/A = (a2 - c2)/(a2 + c2) for any density profile.
    If the core is rounder than the surface, as in the Earth, (C - A)/A is smaller than the
    flattening given by McCullough's formula.

    Parameters
    ----------
    radii : array_like, shape (n,)
        Equatorial radii of the outer surfaces of the layers, from the core outwards, m.
    densities : array_like, shape (n,)
        Densities of the layers, kg m-3.
    flattenings : array_like, shape (n,)
        Flattenings of the outer surfaces.

    Returns
    -------
    mass : float
        kg.
    moments : Moments
        kg m2.

    Raises
    ------
    UndefinedError
        If a surface does not lie within the next.
    """
    a = positive("layered spheroid", "radius", np.atleast_1d(radii))
    rho = positive("layered spheroid", "density", np.atleast_1d(densities))
    f = check_flattening(np.atleast_1d(flattenings))
    if not a.shape == rho.shape == f.shape or a.ndim != 1:
        raise UndefinedError(
            f"radii, densities and flattenings have the shapes {a.shape}, {rho.shape} and "
            f"{f.shape}; give one of each per layer"
        )
    _check_nested(a, f)
    excess = rho - np.append(rho[1:], 0.0)  # of each spheroid over the layer around it
    mass = 4 * np.pi / 3 * excess * a**3 * (1 - f)
    fifth = mass * a**2 / 5
    e2 = f * (2 - f)
    moments = Moments(
        np.asarray(np.sum(fifth * (1 + (1 - f) ** 2))),
        np.asarray(np.sum(2 * fifth)),
        np.asarray(np.sum(fifth * e2)),
    )
    return float(np.sum(mass)), moments


def _check_nested(radii: FloatArray, flattenings: FloatArray) -> None:
    """Raise an error if layers intersect or touch, at the equator or at the pole."""
    for name, sizes in (("equatorial", radii), ("polar", radii * (1 - flattenings))):
        wrong = np.diff(sizes) <= 0
        if np.any(wrong):
            k = int(np.argmax(wrong))
            raise UndefinedError(
                f"layer {k} has the {name} radius {sizes[k]:g} m and the one around it "
                f"{sizes[k + 1]:g} m; give the layers from the core outwards, each inside the next"
            )
