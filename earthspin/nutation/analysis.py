"""Separation of a pole's motion into slow precession and circular nutation terms.

The same least-squares fit is applied to the computed pole and to the IAU pole, so that errors of
the method affect both equally.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import ARCSEC, DAY, DAYS_PER_CENTURY, EPSILON_0, JULIAN_YEAR, MAS
from earthspin.numerics.arrays import ComplexArray, FloatArray

# --- precession angles of a pole ------------------------------------------------------------------
# With the pole u and the pole e of the moving ecliptic in the axes of ecliptic and equinox of
# J2000.0,
#
#     u = (sin(omega) sin(psi), sin(omega) cos(psi), cos(omega)),     cos(eps) = u . e
#
# Torques change u only. eps_A, chi_A and p_A also depend on the ecliptic of date, which is an
# input.

#: Names of the angles, in the order of `precession_angles`.
ANGLES = ("psi_A", "omega_A", "eps_A", "chi_A", "p_A")


def on_fixed_ecliptic(pole: FloatArray, ecliptic: FloatArray) -> FloatArray:
    """Longitude psi and inclination omega of a pole on the fixed ecliptic, rad, shape (n, 2).

    Parameters
    ----------
    pole : ndarray, shape (n, 3)
        Unit vectors.
    ecliptic : ndarray, shape (3, 3)
        Rotation from the frame of the pole to the ecliptic and equinox of the epoch.
    """
    x, y, z = ecliptic @ pole.T
    return np.stack([np.arctan2(x, y), np.arctan2(np.hypot(x, y), z)], axis=-1)


def followed(psi: FloatArray, guide: FloatArray) -> FloatArray:
    """Add whole turns to longitudes psi, rad, so that each is nearest to its value in `guide`."""
    return np.asarray(psi + 2 * np.pi * np.rint((guide - psi) / (2 * np.pi)))


def pole_from(psi: FloatArray, omega: FloatArray) -> FloatArray:
    """Unit vector of a pole from longitude psi and inclination omega, shape (n, 3).

    The axes are those of the fixed ecliptic.
    """
    return np.stack(
        [np.sin(omega) * np.sin(psi), np.sin(omega) * np.cos(psi), np.cos(omega)], axis=-1
    )


def precession_angles(psi: FloatArray, omega: FloatArray, ecliptic_pole: FloatArray) -> FloatArray:
    """Return psi_A, omega_A, eps_A, chi_A and p_A of a mean pole, rad, shape (n, 5).

    Parameters
    ----------
    psi, omega : ndarray, shape (n,)
        Angles of the mean pole on the fixed ecliptic, rad.
    ecliptic_pole : ndarray, shape (n, 3)
        Pole of the moving ecliptic in the frame of the fixed one.
    """
    pole, ecliptic = pole_from(psi, omega), ecliptic_pole
    equinox = np.cross(pole, ecliptic)  # towards the equinox of date
    obliquity = np.arctan2(np.linalg.norm(equinox, axis=1), np.sum(pole * ecliptic, axis=1))
    fixed_node = np.cross(pole, [0.0, 0.0, 1.0])  # towards the node of the fixed ecliptic
    chi = _angle_about(pole, fixed_node, equinox)
    general = _angle_from_origin(equinox, ecliptic)
    return np.stack([psi, omega, obliquity, chi, general], axis=-1)


def general_precession(pole: FloatArray, ecliptic_pole: FloatArray) -> FloatArray:
    """General precession in longitude p_A, computed from a mean pole, rad, shape (...).

    Parameters
    ----------
    pole, ecliptic_pole : ndarray, shape (..., 3)
        Mean pole and pole of the moving ecliptic, in the frame of the fixed one.
    """
    return _angle_from_origin(np.cross(pole, ecliptic_pole), ecliptic_pole)


def _angle_from_origin(equinox: FloatArray, ecliptic: FloatArray) -> FloatArray:
    """Angle along the moving ecliptic from the equinox of date to a non-rotating origin, rad.

    See Lieske 1977.
    """
    x, z = np.eye(3)[[0, 2]]
    origin = x - (ecliptic[..., :1] / (1 + ecliptic[..., 2:])) * (ecliptic + z)
    return _angle_about(ecliptic, equinox, origin)


def polynomials(t: FloatArray, angles: FloatArray, degree: int) -> FloatArray:
    """Fit polynomials in time to angles by least squares, and return the coefficients.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Times, in any unit.
    angles : ndarray, shape (n, k)
        rad.
    degree : int

    Returns
    -------
    ndarray, shape (k, degree + 1)
        Coefficients; column j is in rad per (unit of t)^j.
    """
    powers = t[:, np.newaxis] ** np.arange(degree + 1)
    return np.asarray(np.linalg.lstsq(powers, angles, rcond=None)[0].T)


def _angle_about(axis: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Angle from one direction to another, measured about a given axis, rad."""
    sine = np.sum(np.cross(start, end) * axis, axis=-1)
    return np.asarray(np.arctan2(sine, np.sum(start * end, axis=-1)))


# --- circular terms -------------------------------------------------------------------------------
# With nutation as one complex number, eta = dpsi sin(eps0) + i deps, a pole's motion against the
# mean equator is a sum of circles,
#
#     \eta(t) = \sum_k A_k^+ e^{i phi_k} + A_k^- e^{-i phi_k} + slow,
#
# whose arguments phi_k are integer combinations of the five Delaunay arguments. The amplitudes
# follow from least squares, so that the amplitudes of two poles can be compared term by term.

#: Multiples of l, l', F, D and the node: the luni-solar terms of IAU 2000B (McCarthy & Luzum
#: 2003, Celest. Mech. 85, 37), which are the largest of IAU 2000A. Five are omitted, because
#: centuries of data cannot separate them from a larger neighbouring term (the arguments differ by
#: twice the
#: longitude of the perihelion, 10,467 years): 0 -2 2 -2 2 and 0 -2 2 -2 1, 0 2 0 0 0,
#: 0 -1 2 -2 1 and 0 -1 2 -2 2. Their amplitudes are included in those of the neighbours.
_TERMS = """
    0 0 0 0 1 / 0 0 2 -2 2 / 0 0 2 0 2 / 0 0 0 0 2 / 0 1 0 0 0 / 0 1 2 -2 2 / 1 0 0 0 0 /
    0 0 2 0 1 / 1 0 2 0 2 / 0 0 2 -2 1 / -1 0 2 0 2 / -1 0 0 2 0 / 1 0 0 0 1 / -1 0 0 0 1 /
    -1 0 2 2 2 / 1 0 2 0 1 / -2 0 2 0 1 / 0 0 0 2 0 / 0 0 2 2 2 / -2 0 0 2 0 / 2 0 2 0 2 /
    1 0 2 -2 2 / -1 0 2 0 1 / 2 0 0 0 0 / 0 0 2 0 0 / 0 1 0 0 1 / -1 0 0 2 1 / 0 2 2 -2 2 /
    0 0 -2 2 0 / 1 0 0 -2 1 / 0 -1 0 0 1 / -1 0 2 2 1 / 1 0 2 2 2 / -2 0 2 0 0 / 0 1 2 0 2 /
    0 0 2 2 1 / 0 -1 2 0 2 / 0 0 0 2 1 / 1 0 2 -2 1 / 2 0 2 -2 2 / -2 0 0 2 1 / 2 0 2 0 1 /
    0 0 0 -2 1 / -1 -1 0 2 0 / 2 0 0 -2 1 / 1 0 0 2 0 / 0 1 2 -2 1 / 1 -1 0 0 0 /
    -2 0 2 0 2 / 3 0 2 0 2 / 0 -1 0 2 0 / 1 -1 2 0 2 / 0 0 0 1 0 / -1 -1 2 2 2 / -1 0 2 0 0 /
    0 -1 2 2 2 / -2 0 0 0 1 / 1 1 2 0 2 / 2 0 0 0 1 / -1 1 0 1 0 / 1 1 0 0 0 / 1 0 2 0 0 /
    -1 0 2 -2 1 / 1 0 0 0 2 / -1 0 0 1 0 / 0 0 2 1 2 / -1 0 2 4 2 / -1 1 0 1 1 / 1 0 2 2 1 /
    -2 0 2 2 2 / -1 0 0 0 2 / 1 1 2 -2 2
"""
MULTIPLES = np.array([term.split() for term in _TERMS.split("/")], dtype=int)

#: Terms whose amplitude changes noticeably in a century.
_GROWING = ("0 0 0 0 1", "0 0 2 -2 2", "0 0 2 0 2", "0 1 0 0 0", "0 0 0 0 2")
SLOW_DEGREE = 4
#: Rows of the normal matrix that are computed together.
BLOCK = 16
#: Convergence tolerance of the least squares, relative to the initial residual.
NEAR_ENOUGH = 1e-12


@dataclass(frozen=True)
class Circles:
    """Circular terms of a pole's motion: Delaunay multiples, frequencies and complex amplitudes.

    Attributes
    ----------
    multiples : ndarray, shape (k, 5)
        Multiples of the Delaunay arguments; negated for the circular term of opposite sense.
    frequency : ndarray, shape (k,)
        Frequency in space at J2000.0, rad/s; negative if retrograde.
    amplitude : ndarray, shape (k,), complex
        Factor of exp(i phi), rad.
    slow : ndarray, shape (SLOW_DEGREE + 1,), complex
        Coefficients of the secular polynomial in Julian centuries, rad.
    """

    multiples: NDArray[np.int64]
    frequency: FloatArray
    amplitude: ComplexArray
    slow: ComplexArray

    def at(self, arguments: FloatArray) -> ComplexArray:
        """Sum of the circular terms at given times; the secular motion is not included.

        Parameters
        ----------
        arguments : ndarray, shape (5, t)
            Delaunay arguments, rad.
        """
        return responses(self, arguments, {"": np.ones(1, dtype=complex)})[""]


def term_names(multiples: NDArray[np.int64]) -> list[str]:
    """Names of nutation terms, from the multiples of their Delaunay arguments, shape (k, 5)."""
    return [" ".join(f"{m:+d}" for m in multiple) for multiple in multiples]


def responses(
    circles: Circles, arguments: FloatArray, factors: Mapping[str, ComplexArray]
) -> dict[str, ComplexArray]:
    """Sum the circular terms at given times after multiplying their amplitudes by response factors.

    There is one result for each set of factors.

    Parameters
    ----------
    circles : Circles
    arguments : ndarray, shape (5, t)
        Delaunay arguments, rad.
    factors : mapping of str to ndarray, shape (k,), complex
        Factors of the amplitudes, by name.

    Returns
    -------
    dict of str to ndarray, shape (t,), complex
        rad.
    """
    amplitudes = np.array([factor * circles.amplitude for factor in factors.values()])
    total = np.zeros((len(amplitudes), arguments.shape[1]), dtype=complex)
    for multiple, amplitude in zip(circles.multiples, amplitudes.T, strict=True):
        total += amplitude[:, np.newaxis] * np.exp(1j * (multiple @ arguments))
    return dict(zip(factors, total, strict=True))


class FrequencyAnalysis:
    """Simultaneous least-squares fit of the amplitudes of all circular terms to nutation.

    Parameters
    ----------
    centuries : ndarray, shape (t,)
        Julian centuries from J2000.0.
    arguments : ndarray, shape (5, t)
        Delaunay arguments, rad.
    rates : ndarray, shape (5,)
        Their rates at J2000.0, rad/s.
    """

    def __init__(self, centuries: FloatArray, arguments: FloatArray, rates: FloatArray) -> None:
        from scipy.sparse.linalg import LinearOperator  # late: the angles are used without it

        # Real functions with complex factors: x cos(phi) + y sin(phi) is A+ e^(i phi) + A- e^(-i
        # phi) with A+, A- = (x -+ i y) / 2. No BLAS here and below: its rounding depends on the
        # number of threads, and results must be reproducible to the bit.
        phase = np.einsum("kj,jt->kt", MULTIPLES, arguments)
        circles = np.concatenate([np.cos(phase), np.sin(phase)])
        terms = [MULTIPLES.tolist().index([int(m) for m in t.split()]) for t in _GROWING]
        growing_rows = centuries * circles[[*terms, *(len(MULTIPLES) + k for k in terms)]]
        slow = centuries ** np.arange(SLOW_DEGREE + 1)[:, np.newaxis]
        self._rows = np.concatenate([circles, slow, growing_rows])
        self._scale = np.linalg.norm(self._rows, axis=1)
        self._rows /= self._scale[:, np.newaxis]
        normal = np.empty((len(self._rows), len(self._rows)))
        for first in range(0, len(normal), BLOCK):  # symmetric, so half of it is enough
            block = slice(first, first + BLOCK)
            normal[block, first:] = np.einsum("it,jt->ij", self._rows[block], self._rows[first:])
            normal[first:, block] = normal[block, first:].T
        self._normal = LinearOperator(
            normal.shape, matvec=lambda x: np.einsum("ij,j->i", normal, x), dtype=float
        )
        self._multiples = np.concatenate([MULTIPLES, -MULTIPLES])
        self._frequency = self._multiples @ rates

    def __call__(self, eta: ComplexArray) -> Circles:
        """Fit circular terms to the complex nutation of a pole, and return them.

        Parameters
        ----------
        eta : ndarray, shape (t,), complex
            dpsi sin(eps0) + i deps, rad.
        """
        components = np.stack([eta.real, eta.imag])
        factors = self._solved(components)
        residual = components - np.einsum("it,ci->ct", self._rows, factors)
        factors += self._solved(residual)
        coefficients: ComplexArray = factors[0] + 1j * factors[1]
        coefficients /= self._scale
        x, y = coefficients[: 2 * len(MULTIPLES)].reshape(2, -1)
        amplitude: ComplexArray = np.concatenate([x - 1j * y, x + 1j * y])
        amplitude /= 2
        slow = coefficients[2 * len(MULTIPLES) :][: SLOW_DEGREE + 1]
        return Circles(self._multiples, self._frequency, amplitude, slow)

    def _solved(self, components: FloatArray) -> FloatArray:
        """Solve the least-squares problem for real and imaginary part of nutation, shape (2, t).

        The solution is for rows of unit length. They are nearly orthogonal (condition number 20
        over 150 years), so that the normal equations are accurate enough, and conjugate gradients
        converge in forty iterations.
        """
        from scipy.sparse.linalg import cg

        sides = np.einsum("it,ct->ci", self._rows, components)
        return np.array([cg(self._normal, side, rtol=NEAR_ENOUGH, atol=0.0)[0] for side in sides])


def complex_nutation(angles: FloatArray) -> ComplexArray:
    """Complex nutation dpsi sin(eps0) + i deps from the two nutation angles, shape (t, 2), rad."""
    sine = np.sin(EPSILON_0.value * ARCSEC)
    return np.asarray(angles[:, 0] * sine + 1j * angles[:, 1])


def phases(amplitude: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """In-phase and out-of-phase parts of complex nutation amplitudes, in the IERS convention.

    eta = -i sum (in + i out) exp(i phi) (Mathews, Herring & Buffett 2002).
    """
    rotated = 1j * amplitude
    return rotated.real, rotated.imag


def without_line(centuries: FloatArray, series: FloatArray) -> FloatArray:
    """Subtract the least-squares linear trend from a series along its first axis."""
    design = np.stack([np.ones_like(centuries), centuries], axis=1)
    fit = np.linalg.lstsq(design, series, rcond=None)[0]
    return np.asarray(series - design @ fit)


# --- terms that cannot be separated from a larger neighbour ---------------------------------------
# The arguments of most pairs differ by twice the longitude of the Sun's perihelion, with a period
# of 10,467 years, so that an analysis over the span of the kernels merges the two terms. The
# contribution of the smaller term to a fitted amplitude is known from the series of IAU 2000A (IERS
# Conventions 2003, IERS Technical Note 32, tables 5.3a and 5.3b).


class Term(NamedTuple):
    """One term of the tabulated nutation series at J2000.0, with coefficients in units of 0.1 uas.

    Attributes
    ----------
    multiples : tuple of int
        Multiples of l, l', F, D and the node.
    sine, cosine : float
        Coefficients of dpsi.
    deps_cosine, deps_sine : float
        Coefficients of deps.
    """

    multiples: tuple[int, int, int, int, int]
    sine: float
    cosine: float
    deps_cosine: float
    deps_sine: float


#: The terms above 0.06 mas that have a larger neighbour. Another one, 0 -2 2 -2 2, itself has a
#: period of 10,467 years and is absorbed by the secular part.
LEFT_OUT = (
    Term((0, -1, 2, -2, 2), 215829.0, 111.0, -95929.0, 132.0),
    Term((0, 2, 0, 0, 0), 16707.0, -10.0, 168.0, 10.0),
    Term((0, -1, 2, -2, 1), -4752.0, -3.0, 2719.0, -3.0),
    Term((0, -2, 2, -2, 1), -1283.0, 0.0, 672.0, 0.0),
    Term((-1, 0, 1, 0, 1), 0.0, -1044.0, 0.0, -891.0),
)


def neighbours_of(
    multiples: NDArray[np.int64], frequency: FloatArray, rates: FloatArray, arguments: FloatArray
) -> tuple[list[str], ComplexArray]:
    """Compute how much omitted nutation terms change fitted terms with almost equal frequency.

    The fitted interval is centred on J2000.0.

    Parameters
    ----------
    multiples : ndarray, shape (k, 5)
        Multiples of the fitted terms.
    frequency : ndarray, shape (k,)
        Frequencies of the fitted terms, rad/s.
    rates : ndarray, shape (5,)
        Rates of the Delaunay arguments, rad/s.
    arguments : ndarray, shape (5,)
        Delaunay arguments at J2000.0, rad.

    Returns
    -------
    names : list of str
        Multiples of the omitted neighbour of each fitted term; empty if there is none.
    amplitude : ndarray, shape (k,), complex
        Contribution to the factor of exp(i phi) of the fitted term, rad.
    """
    names, amplitude = [""] * len(multiples), np.zeros(len(multiples), dtype=complex)
    for term in LEFT_OUT:
        forward, backward = circles_of(term)
        for sign, size in ((1, forward), (-1, backward)):
            multiple = sign * np.array(term.multiples)
            nearest = int(np.argmin(np.abs(frequency - multiple @ rates)))
            phase_factor = np.exp(1j * ((multiple - multiples[nearest]) @ arguments))
            (names[nearest],) = term_names(multiple[np.newaxis])
            amplitude[nearest] += size * phase_factor
    return names, amplitude


def circles_of(term: Term) -> tuple[complex, complex]:
    """Complex amplitudes of a nutation term's prograde and retrograde circular motion, rad."""
    longitude = np.sin(EPSILON_0.value * ARCSEC) * np.array([term.cosine, term.sine])
    obliquity = 1j * np.array([term.deps_cosine, term.deps_sine])
    cosine, sine = 1e-4 * MAS * (longitude + obliquity)
    return complex(cosine - 1j * sine) / 2, complex(cosine + 1j * sine) / 2


def amplitude_error(frequency: FloatArray) -> FloatArray:
    """Error of a fitted nutation amplitude, rad, without the error due to close frequencies.

    Measured with the series of IAU 2000A, whose amplitudes are known: 0.042 mas for the 18.6-year
    and 9.3-year terms, 0.038 mas for the semi-annual term, 0.007 mas for periods below 100 days.

    Parameters
    ----------
    frequency : ndarray, shape (k,)
        rad/s.
    """
    days = np.abs(2 * np.pi / frequency) / DAY
    return MAS * np.select([days > 1000.0, days > 100.0], [0.06, 0.05], 0.01)


# --- slow precession and circular terms together --------------------------------------------------

CENTURY = 100 * JULIAN_YEAR


@dataclass(frozen=True)
class Secular:
    """Secular longitude psi and inclination omega of a pole on the ecliptic of J2000.0.

    They are polynomials in Julian centuries from J2000.0.

    Attributes
    ----------
    psi, omega : ndarray, shape (SLOW_DEGREE + 1,)
        Coefficients, rad.
    """

    psi: FloatArray
    omega: FloatArray

    @property
    def psi_rate(self) -> float:
        """Rate of the longitude psi of the mean pole at J2000.0, rad/s."""
        return float(self.psi[1]) / CENTURY

    @property
    def omega_rate(self) -> float:
        """Rate of the inclination omega of the mean pole at J2000.0, rad/s."""
        return float(self.omega[1]) / CENTURY

    def at(self, centuries: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Mean longitude psi and inclination omega, rad, at Julian centuries from J2000.0."""
        powers = centuries[:, np.newaxis] ** np.arange(len(self.psi))
        return powers @ self.psi, powers @ self.omega


class PoleAnalysis:
    """Separate the motion of poles at given times into a secular part and circular terms.

    Parameters
    ----------
    days : ndarray, shape (t,)
        Times, days from J2000.0.
    arguments : ndarray, shape (5, t)
        Delaunay arguments, rad.
    rates : ndarray, shape (5,)
        Their rates at J2000.0, rad/s.
    ecliptic : ndarray, shape (3, 3)
        Rotation from the frame of the poles to the ecliptic and equinox of J2000.0.
    """

    def __init__(
        self, days: FloatArray, arguments: FloatArray, rates: FloatArray, ecliptic: FloatArray
    ) -> None:
        self.ecliptic = ecliptic
        self._least_squares = FrequencyAnalysis(days / DAYS_PER_CENTURY, arguments, rates)
        self._sine = float(np.sin(EPSILON_0.value * ARCSEC))

    def secular(self, pole: FloatArray) -> Secular:
        """Fit the secular longitude psi and inclination omega to pole vectors, shape (t, 3)."""
        psi, omega = on_fixed_ecliptic(pole, self.ecliptic).T
        slow = self._least_squares(psi * self._sine + 1j * omega).slow
        return Secular(slow.real / self._sine, slow.imag.copy())

    def circles(self, eta: ComplexArray) -> Circles:
        """Fit circular terms to the nutation eta = dpsi sin(eps0) + i deps, and return them."""
        return self._least_squares(eta)


def shifted_start(
    start: FloatArray, computed: Secular, wanted: Secular, ecliptic: FloatArray, epoch: float
) -> FloatArray:
    """Correct the initial axis of an integration so that the mean pole follows a wanted motion.

    Parameters
    ----------
    start : ndarray, shape (3,)
        Initial axis of the previous integration.
    computed, wanted : Secular
        Secular motion that `start` led to, and the motion to match.
    ecliptic : ndarray, shape (3, 3)
    epoch : float
        Time of the start, Julian centuries from J2000.0.
    """
    psi, omega = on_fixed_ecliptic(start[np.newaxis], ecliptic)[0]
    computed_psi, computed_omega = computed.at(np.array([epoch]))
    wanted_psi, wanted_omega = wanted.at(np.array([epoch]))
    pole = pole_from(psi + wanted_psi - computed_psi, omega + wanted_omega - computed_omega)
    return np.asarray(pole[0] @ ecliptic)
