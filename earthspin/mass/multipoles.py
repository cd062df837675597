"""Multipole expansion of 1/R and of the potential of a body (I.9.3 to I.9.30).

Holds the Legendre functions, the multipoles of bodies of any shape by degree n and order m, and the
zonal moments of bodies of revolution.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from earthspin.constants import G
from earthspin.errors import AccuracyError, BodyError, UndefinedError
from earthspin.mass.figure import AxisymmetricMoments
from earthspin.mass.tensor import degree, first_wrong, point_masses, positive, vectors
from earthspin.numerics.arrays import ComplexArray, FloatArray

# --- Legendre functions ---------------------------------------------------------------------------
# P_nm is the associated Legendre function with the phase (-1)^m, not normalised, as in the source
# and in `scipy.special.lpmv`:
#
#     integral of P_nm P_n'm dz = K_nm delta_nn'      K_nm = f(n, m)/(n + 1/2)
#     f(n, m) = (n + m)!/(n - m)!
#
# They are computed as P_nm/sqrt(K_nm), which does not overflow and is more accurate near z = 1 than
# `lpmv` (for m = 1 at z = 0.999999, errors of 2e-14 and 1e-12).


def factorial_ratio(n: int, m: int) -> float:
    """Ratio f(n, m) = (n + m)!/(n - m)!, for |m| <= n (I.9.3).

    f(n, -m) is the weight of a term of 1/R (I.9.11).
    """
    _check_order(n, abs(m))
    try:
        ratio = float(math.perm(n + abs(m), 2 * abs(m)))
    except OverflowError:
        raise UndefinedError(
            f"f(n, m) of n = {n}, m = {m} exceeds 1e308; unnormalised functions end there"
        ) from None
    return ratio if m >= 0 else 1 / ratio


def legendre_norm(n: int, m: int = 0) -> float:
    """Squared norm K_nm: integral of P_nm squared over [-1, 1] (I.9.3)."""
    return factorial_ratio(n, m) / (n + 0.5)


def orthonormal_functions(n_max: int, z: ArrayLike, m: int = 0) -> FloatArray:
    """Normalised Legendre functions P_nm(z)/sqrt(K_nm) for degrees n = m to n_max.

    Parameters
    ----------
    n_max : int
        Last degree.
    z : array_like, shape (...)
        In [-1, 1].
    m : int
        Order, from 0 to n_max.

    Returns
    -------
    ndarray, shape (n_max + 1 - m, ...)
        Their squares integrate to 1.
    """
    _check_order(n_max, m)
    x = _argument(z)
    functions = np.zeros((n_max + 1 - m, *x.shape))
    sine = np.sqrt((1 - x) * (1 + x))
    functions[0] = np.sqrt(0.5)
    for k in range(1, m + 1):
        functions[0] *= -np.sqrt((2 * k + 1) / (2 * k)) * sine
    before, weight = np.zeros(x.shape), 0.0
    for k, n in enumerate(range(m + 1, n_max + 1)):
        # z p_(n-1) = c_n p_n + c_(n-1) p_(n-2)
        c = math.sqrt((n * n - m * m) / (4 * n * n - 1))
        functions[k + 1] = (x * functions[k] - weight * before) / c
        before, weight = functions[k], c
    return functions


def _argument(z: ArrayLike) -> FloatArray:
    """Return the argument z of Legendre functions as an array; refuse values outside [-1, 1]."""
    values = np.asarray(z, dtype=float)
    wrong = ~(np.abs(values) <= 1)
    if np.any(wrong):
        raise UndefinedError(
            f"z = {first_wrong(values, wrong)!r} is outside -1 to 1; give the cosine of an angle"
        )
    return values


def _check_order(n: int, m: int) -> None:
    """Raise an error unless the order m of a Legendre function satisfies 0 <= m <= n."""
    if degree("degree n", n) < degree("order m", m):
        raise UndefinedError(f"order m = {m} exceeds the degree n = {n}; allowed: 0 to {n}")


# --- multipoles of any body -----------------------------------------------------------------------
# The harmonics are Racah's, with the phase (-1)^m,
#
#     C_nm(theta, phi) = sqrt((n - m)!/(n + m)!) P_nm(cos theta) e^(i m phi)
#
# so that C_n0 = P_n; in terms of Jackson's Y_nm they are sqrt(4 pi/(2n + 1)) Y_nm. Then
#
#     1/R = sum over n, m of r<^n r>^(-n-1) C_nm(r) C*_nm(r')
#
# and the source's (I.9.17) to (I.9.19) hold as printed; with its own unnormalised harmonics
# (I.9.16) each term needs the factor f(n, -m) of (I.9.12), which (I.9.19) leaves out, and with
# Jackson's 4 pi/(2n + 1). Of each pair of orders m and -m only m >= 0 is stored and summed, with
# Neumann's factor (I.9.13): masses are real.
#
# Solid harmonics are computed from Cartesian coordinates by upward recurrence in the degree, which
# is stable and regular at the poles and the centre.


def solid_harmonics(position: FloatArray, n_max: int) -> Iterator[tuple[int, int, ComplexArray]]:
    """Yield degree n, order m and the solid harmonic r^n C_nm at given positions.

    Parameters
    ----------
    position : ndarray, shape (..., 3)
        Position in units of the reference radius.
    n_max : int
        Last degree.
    """
    x, y, z = np.moveaxis(position, -1, 0)
    square = x * x + y * y + z * z
    sectorial = np.ones(x.shape, dtype=complex)
    for m in range(n_max + 1):
        if m:
            sectorial = -np.sqrt((2 * m - 1) / (2 * m)) * (x + 1j * y) * sectorial
        before, harmonic = np.zeros_like(sectorial), sectorial
        yield m, m, harmonic
        for n in range(m + 1, n_max + 1):
            rising = (2 * n - 1) * z * harmonic - np.sqrt((n - 1) ** 2 - m**2) * square * before
            before, harmonic = harmonic, rising / np.sqrt(n**2 - m**2)
            yield n, m, harmonic


def inverse_distance(position: ArrayLike, source: ArrayLike, n_max: int) -> FloatArray:
    """Inverse distance 1/R of two points by a multipole series to degree n_max (I.9.10 to I.9.13).

    Parameters
    ----------
    position, source : array_like, shape (..., 3)
        The two points, in any order, m.
    n_max : int
        Last degree.

    Returns
    -------
    ndarray, shape (...)
        m-1; `inverse_distance_bound` bounds the truncation error.

    Raises
    ------
    UndefinedError
        If both points are at the same distance from the origin, where the series does not converge.
    """
    near, far, r_far, _ = _near_and_far(position, source)
    total = np.zeros(r_far.shape)
    pairs = zip(
        solid_harmonics(near / r_far[..., np.newaxis], degree("n_max", n_max)),
        solid_harmonics(far / r_far[..., np.newaxis], n_max),
        strict=True,
    )
    for (_, m, regular), (_, _, irregular) in pairs:
        total += _neumann(m) * np.real(regular * np.conj(irregular))
    return np.asarray(total / r_far)


def inverse_distance_bound(position: ArrayLike, source: ArrayLike, n_max: int) -> FloatArray:
    """Bound on the truncation error of the series in `inverse_distance`, m-1.

    It is (r</r>)^(n_max + 1)/(r> - r<) for the smaller distance r< and the larger r>.
    """
    near, _, r_far, gap = _near_and_far(position, source)
    ratio = np.sqrt(np.sum(near**2, axis=-1)) / r_far
    return np.asarray(ratio ** (degree("n_max", n_max) + 1) / gap)


@dataclass(frozen=True)
class Multipoles:
    """Multipole moments of a body, from which its potential outside the body is computed.

    Attributes
    ----------
    moments : ndarray of complex, shape (n_max + 1, n_max + 1)
        Integral of dm (r'/radius)^n C*_nm by n and m >= 0, kg.
    radius : float
        Radius of convergence and unit of length of the moments, m.
    """

    moments: ComplexArray
    radius: float

    @property
    def n_max(self) -> int:
        """Highest degree n of the stored multipole moments."""
        return len(self.moments) - 1

    @property
    def zonal(self) -> FloatArray:
        """Zonal moments Z_n (multipole moments of order 0) for n = 0 to n_max, kg.

        They are defined as in `zonal_integrals`.
        """
        return np.real(self.moments[:, 0])

    def moment(self, n: int, m: int) -> complex:
        """Multipole moment T_nm of degree n and order m (I.9.20), with Racah's harmonics, kg m^n.

        Divide by sqrt(f(n, -m)) for the source's unnormalised harmonics, and multiply by
        sqrt((2n + 1)/(4 pi)) for Jackson's q_nm.
        """
        if not abs(m) <= n <= self.n_max:
            raise UndefinedError(
                f"moment n = {n}, m = {m} is not stored; allowed: n to {self.n_max}, |m| to n"
            )
        value = complex(self.moments[n, abs(m)])
        if m < 0:
            value = (-1) ** m * value.conjugate()
        return value * self.radius**n

    def potential(self, position: ArrayLike) -> FloatArray:
        """Gravitational potential of the body by the multipole series (I.9.15, I.9.21), m2 s-2.

        Parameters
        ----------
        position : array_like, shape (..., 3)
            m.

        Raises
        ------
        UndefinedError
            If a position is not outside the radius of convergence.
        """
        scaled = vectors("position", position) / self.radius
        r = np.sqrt(np.sum(scaled**2, axis=-1))
        if np.any(r <= 1):
            raise UndefinedError(
                f"the exterior series does not converge at r = "
                f"{first_wrong(r, r <= 1) * self.radius:.6g} m; it holds beyond "
                f"{self.radius:.6g} m; elsewhere sum over the masses directly"
            )
        ratio = 1 / r
        # Inversion turns r^n C_nm into r^(-n-1) C_nm, apart from the factor 1/r.
        inverted = scaled * ratio[..., np.newaxis] ** 2
        total = np.zeros(ratio.shape)
        for n, m, harmonic in solid_harmonics(inverted, self.n_max):
            total += _neumann(m) * np.real(harmonic * self.moments[n, m])
        return np.asarray(-G.value / self.radius * (total * ratio))


def exterior_multipoles(
    masses: ArrayLike, positions: ArrayLike, n_max: int, radius: float | None = None
) -> Multipoles:
    """Multipole moments of point masses, for the potential outside the body (I.9.20).

    Parameters
    ----------
    masses : array_like, shape (k,)
        kg; for a density see `earthspin.mass.tensor.grid_masses`.
    positions : array_like, shape (k, 3)
        Positions relative to the origin of the expansion, m.
    n_max : int
        Last degree.
    radius : float, optional
        Radius of a sphere about the origin that contains the whole body, m. Default: the distance
        of the farthest mass. For point masses that represent cells, give that of the farthest
        corner.
    """
    m, r = point_masses(masses, positions)
    if r.ndim != 2:
        raise UndefinedError(f"positions have the shape {r.shape}; give one body, (k, 3)")
    farthest = float(np.max(np.sqrt(np.sum(r * r, axis=-1))))
    limit = farthest if radius is None else float(radius)
    if not limit >= farthest or limit == 0:
        raise UndefinedError(
            f"radius = {limit:g} m does not contain the mass at {farthest:g} m; give that or more"
        )
    moments = np.zeros((degree("n_max", n_max) + 1, n_max + 1), dtype=complex)
    for n, order, harmonic in solid_harmonics(r / limit, n_max):
        moments[n, order] = np.dot(m, np.conj(harmonic))
    return Multipoles(moments, limit)


def _near_and_far(
    position: ArrayLike, source: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Sort two points by distance from the origin, the nearer point first.

    Return also the larger distance and the difference of the distances.
    """
    point, other = np.broadcast_arrays(vectors("position", position), vectors("source", source))
    r_point, r_other = (np.sqrt(np.sum(p * p, axis=-1)) for p in (point, other))
    if np.any(r_point == r_other):
        r = float(np.asarray(r_point)[r_point == r_other].flat[0])
        raise UndefinedError(
            f"both points are {r:.6g} m from the origin, where the series of 1/R does not "
            f"converge; move one, or compute 1/R directly"
        )
    point_is_nearer = (r_point < r_other)[..., np.newaxis]
    near, far = np.where(point_is_nearer, point, other), np.where(point_is_nearer, other, point)
    return near, far, np.maximum(r_point, r_other), np.abs(r_point - r_other)


def _neumann(m: int) -> int:
    """Neumann's factor: 1 for m = 0, otherwise 2 (I.9.13)."""
    return 1 if m == 0 else 2


# --- zonal moments of bodies of revolution --------------------------------------------------------
# All follow from one kind of integral, in kg, with a reference radius s,
#
#     Z_n = integral of rho (r/s)^n P_n(cos theta) dV
#
#     source:  J_n = -G s^n Z_n     V = sum of J_n P_n r^(-n-1)                   (I.9.23)
#     geodesy: J_n = -Z_n/M, s = a  V = -GM/r [1 - sum over n >= 1 of J_n (a/r)^n P_n]
#
# The source's J2 is G (C - A), geodesy's (C - A)/(M a2). Z_n of point masses and grids is the
# `zonal` of `Multipoles`.

#: Successive numbers of Gauss points in the radius and in the cosine.
_POINTS = (32, 64, 128, 256)
#: Largest half-width of the integrals, as a fraction of the mass times the largest (r/s)^n in the
#: body.
ACCURACY = 1e-12

DensityFunction = Callable[[FloatArray, FloatArray], FloatArray]
PerimeterFunction = Callable[[FloatArray], FloatArray]


def zonal_integrals(
    density: DensityFunction, perimeter: PerimeterFunction, n_max: int, radius: float
) -> FloatArray:
    """Zonal integrals Z_n of the density of a body of revolution, to degree n_max (I.9.27).

    The degree n goes from 0 to n_max; the integrals are computed by Gauss quadrature.

    Parameters
    ----------
    density : callable
        rho(r, theta) in kg m-3 from arrays of distances (m) and colatitudes (rad); smooth.
    perimeter : callable
        Surface of the body, r(theta), m.
    n_max : int
        Last degree.
    radius : float
        Reference radius s, m.

    Returns
    -------
    ndarray, shape (n_max + 1,)
        kg.

    Raises
    ------
    AccuracyError
        If 256 points in each dimension do not reach `ACCURACY`, as for a density that is not
        smooth.
    """
    scale = float(positive("body", "radius", radius))
    degrees = np.arange(degree("n_max", n_max) + 1)[:, np.newaxis, np.newaxis]

    def harmonics(r: FloatArray, cosine: FloatArray) -> FloatArray:
        return np.asarray((r / scale) ** degrees * _polynomials(n_max, cosine))

    return _integrate(density, perimeter, harmonics)


def moments_of_density(
    density: DensityFunction, perimeter: PerimeterFunction
) -> AxisymmetricMoments:
    """Moments A, C and C - A of a body of revolution from its density (I.9.28, I.9.29), kg m2.

    C - A = -integral of rho r2 P2 is integrated directly, not computed as a difference.

    Parameters
    ----------
    density, perimeter
        As for `zonal_integrals`.
    """

    def squares(r: FloatArray, cosine: FloatArray) -> FloatArray:
        return np.stack([r**2, r**2 * (1.5 * cosine**2 - 0.5)])

    second_moment, quadrupole = _integrate(density, perimeter, squares)
    return AxisymmetricMoments(
        equatorial=np.asarray((2 * second_moment + quadrupole) / 3),
        polar=np.asarray(2 * (second_moment - quadrupole) / 3),
        difference=np.asarray(-quadrupole),
    )


def zonal_moments(integrals: ArrayLike, radius: float) -> FloatArray:
    """Zonal moments J_n of the potential (I.9.23), m^(n+3) s-2; not the dimensionless J_n.

    They are -G s^n Z_n, with the reference radius s and the zonal integrals Z_n.
    J0 = -GM and J2 = G (C - A).
    """
    z = np.asarray(integrals, dtype=float)
    return np.asarray(-G.value * float(radius) ** np.arange(z.size) * z)


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
            f"the zonal series may diverge at r = {first_wrong(r, r <= radius):.6g} m; "
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
) -> FloatArray:
    """Integrate density times each integrand over a body of revolution, by Gauss quadrature."""
    previous, error, size = None, np.inf, np.inf
    for points in _POINTS:
        node, weight = np.polynomial.legendre.leggauss(points)
        cosine, theta = node[:, np.newaxis], np.arccos(node)[:, np.newaxis]
        edge = positive("body", "perimeter", perimeter(theta))
        r = edge * (1 + node) / 2
        rho = np.asarray(density(r, theta * np.ones_like(r)), dtype=float) * np.ones_like(r)
        wrong = ~(np.isfinite(rho) & (rho >= 0))
        if np.any(wrong):
            raise BodyError("body", "density", first_wrong(rho, wrong), "it must not be negative")
        volume = 2 * np.pi * weight[:, np.newaxis] * (edge / 2 * weight) * r**2
        terms = integrand(r, cosine)
        current = np.sum(rho * volume * terms, axis=(-1, -2))
        size = np.sum(rho * volume * np.max(np.abs(terms), axis=0))
        if previous is not None:
            error = float(np.max(np.abs(current - previous)))
            if error <= ACCURACY * size:
                return np.asarray(current)
        previous = current
    raise AccuracyError(ACCURACY, error / size, "of the integral", "give a smooth density")
