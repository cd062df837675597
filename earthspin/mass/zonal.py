"""Zonal moments of bodies of revolution, and the potential from them (I.9.22 to I.9.30).

All follow from one kind of integral, in kg, with a reference radius s,

    Z_n = integral of rho (r/s)^n P_n(cos theta) dV

    source:  J_n = -G s^n Z_n     V = sum of J_n P_n r^(-n-1)                   (I.9.23)
    geodesy: J_n = -Z_n/M, s = a  V = -GM/r [1 - sum over n >= 1 of J_n (a/r)^n P_n]

The source's J2 is G (C - A), geodesy's (C - A)/(M a2). Z_n of point masses and grids is the
`zonal` of `earthspin.mass.multipoles.Multipoles`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from earthspin.constants import G
from earthspin.errors import AccuracyError, BodyError, UndefinedError
from earthspin.mass._checks import degree, first, positive
from earthspin.mass.figure import Moments, eccentricity_squared
from earthspin.mass.legendre import orthonormal_functions
from earthspin.numerics.arrays import FloatArray

#: Successive numbers of Gauss points in the radius and in the cosine.
_POINTS = (32, 64, 128, 256)

DensityFunction = Callable[[FloatArray, FloatArray], FloatArray]
PerimeterFunction = Callable[[FloatArray], FloatArray]


def zonal_integrals(
    density: DensityFunction,
    perimeter: PerimeterFunction,
    n_max: int,
    radius: float,
    accuracy: float = 1e-12,
) -> FloatArray:
    """Zonal integrals Z_n of the density of a body of revolution, to degree n_max (I.9.27).

    The degree n goes from 0 to n_max; the integrals are computed by Gauss quadrature.

    Parameters
    ----------
    density : callable
        rho(r, theta) in kg m-3 from arrays of distances (m) and colatitudes (rad); smooth.
        For a layered body use `earthspin.mass.figure.layered_moments`.
    perimeter : callable
        Surface of the body, r(theta), m.
    n_max : int
        Last degree.
    radius : float
        Reference radius s, m.
    accuracy : float
        Largest half-width of the integrals, as a fraction of the mass times the largest (r/s)^n in
        the body.

    Returns
    -------
    ndarray, shape (n_max + 1,)
        kg.

    Raises
    ------
    AccuracyError
        If 256 points in each dimension do not reach the accuracy, as for a density that is not
        smooth.
    """
    scale = float(positive("body", "radius", radius))
    degrees = np.arange(degree("n_max", n_max) + 1)[:, np.newaxis, np.newaxis]

    def harmonics(r: FloatArray, cosine: FloatArray) -> FloatArray:
        return np.asarray((r / scale) ** degrees * _polynomials(n_max, cosine))

    return _integrate(density, perimeter, harmonics, accuracy)


def moments_of_density(
    density: DensityFunction, perimeter: PerimeterFunction, accuracy: float = 1e-12
) -> Moments:
    """Moments A, C and C - A of a body of revolution from its density (I.9.28, I.9.29), kg m2.

    C - A = -integral of rho r2 P2 is integrated directly, not computed as a difference.

    Parameters
    ----------
    density, perimeter, accuracy
        As for `zonal_integrals`.
    """

    def squares(r: FloatArray, cosine: FloatArray) -> FloatArray:
        return np.stack([r**2, r**2 * (1.5 * cosine**2 - 0.5)])

    whole, quadrupole = _integrate(density, perimeter, squares, accuracy)
    return Moments(
        equatorial=np.asarray((2 * whole + quadrupole) / 3),
        polar=np.asarray(2 * (whole - quadrupole) / 3),
        difference=np.asarray(-quadrupole),
    )


def zonal_moments(integrals: ArrayLike, radius: float) -> FloatArray:
    """Zonal moments J_n of a potential as defined in (I.9.23), m^(n+3) s-2.

    They are -G s^n Z_n, with the reference radius s and the zonal integrals Z_n.
    J0 = -GM and J2 = G (C - A).
    """
    z = np.asarray(integrals, dtype=float)
    return np.asarray(-G.value * float(radius) ** np.arange(z.size) * z)


def geodetic_zonals(integrals: ArrayLike) -> FloatArray:
    """Dimensionless zonal coefficients J_n of geodesy, from the zonal integrals Z_n.

    They are -Z_n/M, so that J0 = -1 and J2 = (C - A)/(M s2) with the reference radius s.
    """
    z = np.asarray(integrals, dtype=float)
    return np.asarray(-z / positive("body", "mass", z[0]))


def spheroid_zonals(flattening: float, n_max: int) -> FloatArray:
    """Exact zonal coefficients J_n of a homogeneous spheroid, for its equatorial radius.

    J_2k = (-1)^(k+1) 3 e^2k/[(2k + 1)(2k + 3)], J0 = -1, and odd coefficients are zero.
    """
    e2 = float(eccentricity_squared(flattening))
    zonals = np.zeros(degree("n_max", n_max) + 1)
    for k in range(n_max // 2 + 1):
        zonals[2 * k] = -3 * (-e2) ** k / ((2 * k + 1) * (2 * k + 3))
    return zonals


def zonal_potential(
    integrals: ArrayLike, radius: float, distance: ArrayLike, colatitude: ArrayLike
) -> FloatArray:
    """Gravitational potential of a body of revolution by its zonal series, m2 s-2.

    The series is that of (I.9.22) and (I.9.23).

    Parameters
    ----------
    integrals : array_like, shape (n_max + 1,)
        Z_n, kg.
    radius : float
        Reference radius, of a sphere that contains the body, m.
    distance, colatitude : array_like
        Coordinates of the points, m and rad; they broadcast.

    Raises
    ------
    UndefinedError
        If a distance is at or below the radius, where the series may diverge.
    """
    z = np.asarray(integrals, dtype=float)
    r, theta = np.broadcast_arrays(positive("point", "distance", distance), colatitude)
    if np.any(r <= radius):
        raise UndefinedError(
            f"the zonal series may diverge at r = {first(r, r <= radius):.6g} m; "
            f"give distances beyond {float(radius):.6g} m"
        )
    legendre = np.moveaxis(_polynomials(z.size - 1, np.cos(theta)), 0, -1)
    powers = (float(radius) / r)[..., np.newaxis] ** np.arange(z.size)
    return np.asarray(-G.value / r * np.sum(z * legendre * powers, axis=-1))


def _polynomials(n_max: int, cosine: FloatArray) -> FloatArray:
    """Legendre polynomials P_n at given cosines for n = 0 to n_max, along the first axis."""
    functions = orthonormal_functions(n_max, cosine)
    norms = np.sqrt(np.arange(n_max + 1) + 0.5)
    return np.asarray(functions / norms.reshape(-1, *[1] * cosine.ndim))


def _integrate(
    density: DensityFunction,
    perimeter: PerimeterFunction,
    integrand: Callable[[FloatArray, FloatArray], FloatArray],
    accuracy: float,
) -> FloatArray:
    """Integrals over a body of the density times each integrand, by Gauss quadrature."""
    previous, error, size = None, np.inf, np.inf
    for points in _POINTS:
        node, weight = np.polynomial.legendre.leggauss(points)
        cosine, theta = node[:, np.newaxis], np.arccos(node)[:, np.newaxis]
        edge = positive("body", "perimeter", perimeter(theta))
        r = edge * (1 + node) / 2
        rho = np.asarray(density(r, theta * np.ones_like(r)), dtype=float) * np.ones_like(r)
        wrong = ~(np.isfinite(rho) & (rho >= 0))
        if np.any(wrong):
            raise BodyError("body", "density", first(rho, wrong), "it must not be negative")
        volume = 2 * np.pi * weight[:, np.newaxis] * (edge / 2 * weight) * r**2
        terms = integrand(r, cosine)
        current = np.sum(rho * volume * terms, axis=(-1, -2))
        size = np.sum(rho * volume * np.max(np.abs(terms), axis=0))
        if previous is not None:
            error = float(np.max(np.abs(current - previous)))
            if error <= accuracy * size:
                return np.asarray(current)
        previous = current
    raise AccuracyError(accuracy, error / size, "of the integral", "give a smooth density")
