"""Multipole expansion of 1/R and of the potential of a body, in degree n and order m.

The harmonics are Racah's, with the phase (-1)^m,

    C_nm(theta, phi) = sqrt((n - m)!/(n + m)!) P_nm(cos theta) e^(i m phi)

so that C_n0 = P_n; in terms of Jackson's Y_nm they are sqrt(4 pi/(2n + 1)) Y_nm. Then

    1/R = sum over n, m of r<^n r>^(-n-1) C_nm(r) C*_nm(r')

and the source's (I.9.17) to (I.9.19) hold as printed; with its own unnormalised harmonics
(I.9.16) each term needs the factor f(n, -m) of (I.9.12), which (I.9.19) leaves out, and with
Jackson's 4 pi/(2n + 1). Of each pair of orders m and -m only m >= 0 is stored and summed,
with Neumann's factor (I.9.13): masses are real.

Solid harmonics are computed from Cartesian coordinates by upward recurrence in the degree, which is
stable and regular at the poles and the centre.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from earthspin.constants import G
from earthspin.errors import UndefinedError
from earthspin.mass._checks import degree, vectors
from earthspin.mass.distribution import point_masses
from earthspin.numerics.arrays import ComplexArray, FloatArray


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
    """Multipole moments of a body, from which its potential is computed.

    Attributes
    ----------
    side : str
        ``"exterior"``: outside all mass; ``"interior"``: nearer to the origin than any mass.
    moments : ndarray of complex, shape (n_max + 1, n_max + 1)
        By n and m >= 0, in kg: integral of dm (r'/radius)^n C*_nm outside, and of
        dm (radius/r')^(n + 1) C*_nm inside.
    radius : float
        Radius of convergence and unit of length of the moments, m.
    mass : float
        Total mass of the sources, kg.
    """

    side: str
    moments: ComplexArray
    radius: float
    mass: float

    @property
    def n_max(self) -> int:
        """Highest degree n of the stored multipole moments."""
        return len(self.moments) - 1

    @property
    def zonal(self) -> FloatArray:
        """Zonal moments Z_n (multipole moments of order 0) for n = 0 to n_max, kg.

        They are defined as in `earthspin.mass.zonal`.
        """
        return np.real(self.moments[:, 0])

    def moment(self, n: int, m: int) -> complex:
        """Multipole moment T_nm of degree n and order m (I.9.20), with Racah's harmonics.

        The unit is kg m^n for exterior and kg m^(-n-1) for interior moments.

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
        return value * self.radius ** (n if self.side == "exterior" else -n - 1)

    def potential(self, position: ArrayLike) -> FloatArray:
        """Gravitational potential of the body by the multipole series (I.9.15, I.9.21), m2 s-2.

        Parameters
        ----------
        position : array_like, shape (..., 3)
            m.

        Raises
        ------
        UndefinedError
            If a position is on the side of the radius where the series diverges.
        """
        scaled, ratio = self._converging(position)
        if self.side == "exterior":
            # Inversion turns r^n C_nm into r^(-n-1) C_nm, apart from the factor 1/r.
            scaled = scaled * ratio[..., np.newaxis] ** 2
        total = np.zeros(ratio.shape)
        for n, m, harmonic in solid_harmonics(scaled, self.n_max):
            total += _neumann(m) * np.real(harmonic * self.moments[n, m])
        if self.side == "exterior":
            total = total * ratio
        return np.asarray(-G.value / self.radius * total)

    def truncation_bound(self, position: ArrayLike) -> FloatArray:
        """Bound on the error of `potential` from the terms above degree n_max, m2 s-2.

        The bound is G M/|r - radius| q^(n_max + 1), where q < 1 is the ratio of r and radius.
        """
        _, ratio = self._converging(position)
        scale = G.value * self.mass / self.radius
        if self.side == "exterior":
            return np.asarray(scale * ratio ** (self.n_max + 2) / (1 - ratio))
        return np.asarray(scale * ratio ** (self.n_max + 1) / (1 - ratio))

    def _converging(self, position: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return position over reference radius, and convergence ratio; refuse divergence."""
        scaled = vectors("position", position) / self.radius
        r = np.sqrt(np.sum(scaled**2, axis=-1))
        wrong = r <= 1 if self.side == "exterior" else r >= 1
        if np.any(wrong):
            relation = "beyond" if self.side == "exterior" else "below"
            raise UndefinedError(
                f"the {self.side} series does not converge at r = "
                f"{float(r[wrong].flat[0]) * self.radius:.6g} m; it holds {relation} "
                f"{self.radius:.6g} m; elsewhere sum over the masses directly"
            )
        return scaled, 1 / r if self.side == "exterior" else r


def exterior_multipoles(
    masses: ArrayLike, positions: ArrayLike, n_max: int, radius: float | None = None
) -> Multipoles:
    """Compute multipole moments for the potential outside a body (I.9.20).

    Parameters
    ----------
    masses : array_like, shape (k,)
        kg; for a density see `earthspin.mass.distribution.grid_masses`.
    positions : array_like, shape (k, 3)
        Positions relative to the origin of the expansion, m.
    n_max : int
        Last degree.
    radius : float, optional
        Radius of a sphere about the origin that contains the whole body, m. Default: the distance
        of the farthest mass. For point masses that represent cells, give that of the farthest
        corner.
    """
    m, r, distance = _sources(masses, positions)
    farthest = float(np.max(distance))
    outer = farthest if radius is None else float(radius)
    if not outer >= farthest or outer == 0:
        raise UndefinedError(
            f"radius = {outer:g} m does not contain the mass at {farthest:g} m; give that or more"
        )
    return Multipoles("exterior", _moments(m, r / outer, n_max), outer, float(np.sum(m)))


def interior_multipoles(
    masses: ArrayLike, positions: ArrayLike, n_max: int, radius: float | None = None
) -> Multipoles:
    """Compute multipole moments for the potential in a cavity of a body (below I.9.21).

    Parameters
    ----------
    masses, positions, n_max
        As for `exterior_multipoles`; no mass may be at the origin.
    radius : float, optional
        Radius of an empty sphere about the origin, m. Default: the distance of the nearest mass.
    """
    m, r, distance = _sources(masses, positions)
    nearest = float(np.min(distance))
    inner = nearest if radius is None else float(radius)
    if not 0 < inner <= nearest:
        raise UndefinedError(
            f"radius = {inner:g} m is not an empty sphere: the nearest mass is at {nearest:g} m; "
            f"give that or less, above zero"
        )
    ratio = inner / distance
    inverted = r / inner * ratio[:, np.newaxis] ** 2
    return Multipoles("interior", _moments(m * ratio, inverted, n_max), inner, float(np.sum(m)))


def _moments(masses: FloatArray, scaled: FloatArray, n_max: int) -> ComplexArray:
    """Multipole moments by degree and order: sums of mass times conjugate solid harmonic."""
    moments = np.zeros((degree("n_max", n_max) + 1, n_max + 1), dtype=complex)
    for n, m, harmonic in solid_harmonics(scaled, n_max):
        moments[n, m] = np.dot(masses, np.conj(harmonic))
    return moments


def _sources(masses: ArrayLike, positions: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Check one body of point masses; return masses, positions and distances from the origin."""
    m, r = point_masses(masses, positions)
    if r.ndim != 2:
        raise UndefinedError(f"positions have the shape {r.shape}; give one body, (k, 3)")
    return m, r, np.sqrt(np.sum(r * r, axis=-1))


def _near_and_far(
    position: ArrayLike, source: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Sort two points by distance from the origin; return also the larger distance and the gap.

    Return also the larger distance and the difference of the distances.
    """
    point, other = np.broadcast_arrays(vectors("position", position), vectors("source", source))
    r_one, r_other = (np.sqrt(np.sum(p * p, axis=-1)) for p in (point, other))
    if np.any(r_one == r_other):
        r = float(np.asarray(r_one)[r_one == r_other].flat[0])
        raise UndefinedError(
            f"both points are {r:.6g} m from the origin, where the series of 1/R does not "
            f"converge; move one, or compute 1/R directly"
        )
    first = (r_one < r_other)[..., np.newaxis]
    near, far = np.where(first, point, other), np.where(first, other, point)
    return near, far, np.maximum(r_one, r_other), np.abs(r_one - r_other)


def _neumann(m: int) -> int:
    """Neumann's factor: 1 for m = 0, otherwise 2 (I.9.13)."""
    return 1 if m == 0 else 2
