"""IAU precession and nutation, computed with ERFA, and lunar standstills.

Matrices rotate vectors from the GCRS to an equator and equinox of date; their third row is the
pole. Times are days from J2000.0 TDB, which is used for TT (the difference of 2 ms is 1e-10 arcsec
of precession).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from earthspin._lazy import erfa
from earthspin.constants import DAY, DAYS_PER_CENTURY, DAYS_PER_YEAR, J2000_JD
from earthspin.numerics.arrays import ComplexArray, FloatArray

# --- precession and nutation ----------------------------------------------------------------------

#: Days between the nodes of the interpolation of nutation; the shortest period is above 2 days.
NUTATION_NODE_STEP = 1.0
#: Largest interpolation error of an angle, rad; 7.7e-12 measured against `erfa.nut06a`.
NODE_ERROR = 8e-12
_SPLINE_DEGREE = 5
_MARGIN = 4  # nodes beyond each end, for accuracy at the ends
#: Nutation of IAU 2000A on the days from J2000.0 on which it is analysed, four periods of the node
#: in each direction: rad, shape (2, n). `python -m data_tools nutation` writes the file; the sum of
#: the series over these days takes most of a second.
SERIES = Path(__file__).with_name("nutation.npy")
SERIES_STEP = 4.0
SERIES_DAYS = np.arange(-27200.0, 27200.0, SERIES_STEP)
#: Terms of IAU 2000A: 678 luni-solar and 687 planetary ones.
TERMS = 1365


def mean_equator(days: FloatArray) -> FloatArray:
    """Bias-precession matrices of IAU 2006, from the GCRS to the mean equator of date.

    Parameters
    ----------
    days : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (n, 3, 3)
        GCRS to mean equator and equinox of date (`erfa.pmat06`).
    """
    return np.asarray(erfa.pmat06(J2000_JD, days))


def ecliptic_pole() -> FloatArray:
    """Pole of the ecliptic of J2000.0 (IAU 2006) in the GCRS, shape (3,)."""
    return np.asarray(erfa.ecm06(J2000_JD, 0.0)[2])


@dataclass(frozen=True)
class PrecessionRates:
    """Rates of the IAU 2006 precession angles psi_A, omega_A and chi_A at an epoch, rad/s.

    Attributes
    ----------
    psi_a, omega_a : float
        Rates of the mean equator relative to the fixed ecliptic of J2000.0, in longitude and
        obliquity.
    chi_a : float
        Rate of planetary precession along the equator.
    """

    psi_a: float
    omega_a: float
    chi_a: float


def precession_rates(day: float) -> PrecessionRates:
    """Compute the rates of the IAU 2006 precession angles at an epoch, by central differences.

    Parameters
    ----------
    day : float
        Days from J2000.0 TDB.
    """
    step = 3.6525  # error of cubic terms: 2e-15 of the rate
    before, after = (np.array(erfa.p06e(J2000_JD, day + s * step)) for s in (-1, 1))
    rates = (after - before) / (2 * step * DAY)
    # p06e returns, in this order, eps0, psia, oma, bpa, bqa, pia, bpia, epsa, chia, ...
    return PrecessionRates(psi_a=float(rates[1]), omega_a=float(rates[2]), chi_a=float(rates[8]))


def mean_longitude_of_node(days: FloatArray) -> FloatArray:
    """Mean longitude of the Moon's ascending node, rad (IERS 2003, `erfa.faom03`)."""
    return np.asarray(erfa.faom03(days / DAYS_PER_CENTURY))


def true_equator(days: FloatArray) -> FloatArray:
    """Matrices from the GCRS to the true equator and equinox of IAU 2006/2000A, shape (n, 3, 3).

    Parameters
    ----------
    days : ndarray, shape (n,)
    """
    return np.asarray(erfa.pnm06a(J2000_JD, days))


def true_pole(days: FloatArray) -> FloatArray:
    """Celestial intermediate pole of IAU 2006/2000A in the GCRS, bias included, shape (n, 3).

    Parameters
    ----------
    days : ndarray, shape (n,)
    """
    return true_equator(days)[..., 2, :]


def pole_and_nutation(first: float, last: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pole of IAU 2006/2000A and nutation of IAU 2000A on those `SERIES_DAYS` that a span holds.

    Parameters
    ----------
    first, last : float
        Days from J2000.0; the last is not included.

    Returns
    -------
    days : ndarray, shape (n,)
    -------
    pole : ndarray, shape (n, 3)
        Unit vectors, bit-identical to those of `true_pole`.
    nutation : ndarray, shape (n, 2)
        Nutation in longitude and obliquity (`erfa.nut00a`), rad.
    """
    selected = (first <= SERIES_DAYS) & (last > SERIES_DAYS)
    days, (psi, eps) = SERIES_DAYS[selected], np.load(SERIES)[:, selected]
    # IAU 2006 adjusts IAU 2000A to its obliquity and to its rate of J2 (`erfa.nut06a`).
    by_j2 = -2.7774e-6 * (days / DAYS_PER_CENTURY)
    gamma, phi, psi_bar, eps_bar = erfa.pfw06(J2000_JD, days)
    psi_true = psi_bar + (psi + psi * (0.4697e-6 + by_j2))
    matrix = erfa.fw2m(gamma, phi, psi_true, eps_bar + (eps + eps * by_j2))
    return days, np.asarray(matrix[..., 2, :]), np.stack([psi, eps], axis=-1)


def delaunay_arguments(days: FloatArray) -> FloatArray:
    """Delaunay arguments l, l', F, D and Omega (IERS 2003), rad, shape (5, n)."""
    t = days / DAYS_PER_CENTURY
    return np.stack([erfa.fal03(t), erfa.falp03(t), erfa.faf03(t), erfa.fad03(t), erfa.faom03(t)])


def delaunay_rates() -> FloatArray:
    """Rates of the Delaunay arguments at J2000.0, rad/s, shape (5,)."""
    day = 1.0
    arguments = delaunay_arguments(np.array([-day, day]))
    return np.asarray(np.unwrap(arguments, axis=1)[:, 1] - arguments[:, 0]) / (2 * day * DAY)


def precession_angles(days: FloatArray) -> FloatArray:
    """Precession angles psi_A, omega_A, eps_A, chi_A and p_A of IAU 2006, rad, shape (n, 5).

    They are from `erfa.p06e`.
    """
    angles = erfa.p06e(J2000_JD, days)
    return np.stack([angles[place] for place in (1, 2, 7, 8, 12)], axis=-1)


def moved_by_nutation(pole: FloatArray, eta: ComplexArray, days: FloatArray) -> FloatArray:
    """Unit vectors of poles in the GCRS, after a shift by small nutation angles, shape (n, 3).

    Parameters
    ----------
    pole : ndarray, shape (n, 3)
        Unit vectors in the GCRS.
    eta : ndarray, shape (n,), complex
        Shift dpsi sin(eps0) + i deps along x and y of the equator of date, rad.
    days : ndarray, shape (n,)
    """
    x, y, _ = np.moveaxis(mean_equator(days), 1, 0)
    shift = eta.real[:, np.newaxis] * x + eta.imag[:, np.newaxis] * y
    true_pole = pole + shift
    return np.asarray(true_pole / np.linalg.norm(true_pole, axis=1, keepdims=True))


def nutation_of(pole: FloatArray, days: FloatArray) -> FloatArray:
    """Nutation in longitude and obliquity of a pole from the IAU 2006 mean pole, rad, shape (n, 2).

    Parameters
    ----------
    pole : ndarray, shape (n, 3)
        Unit vectors in the GCRS.
    days : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (n, 2)
        In longitude and in obliquity, referred to the ecliptic of date.
    """
    mean = erfa.obl06(J2000_JD, days)
    x, y, z = np.einsum("tij,tj->it", mean_equator(days), pole)
    # to the ecliptic of date, in which the pole has the longitude 90 degrees minus dpsi
    y, z = np.cos(mean) * y + np.sin(mean) * z, np.cos(mean) * z - np.sin(mean) * y
    return np.stack([np.arctan2(x, y), np.arctan2(np.hypot(x, y), z) - mean], axis=-1)


def fixed_ecliptic() -> FloatArray:
    """Matrix from the GCRS to the ecliptic and mean equinox of J2000.0 (IAU 2006), shape (3, 3)."""
    return np.asarray(erfa.ecm06(J2000_JD, 0.0))


def ecliptic_of_date(days: FloatArray) -> FloatArray:
    """Pole of the ecliptic of date from P_A and Q_A, in the frame of `fixed_ecliptic`, (n, 3)."""
    p, q = (np.asarray(angle) for angle in erfa.p06e(J2000_JD, days)[3:5])
    return np.stack([p, -q, np.sqrt(1 - p * p - q * q)], axis=-1)


def _nodes(start: float, end: float) -> FloatArray:
    margin = _MARGIN * NUTATION_NODE_STEP
    count = int(np.ceil((end - start + 2 * margin) / NUTATION_NODE_STEP)) + 1
    return np.asarray(start - margin + NUTATION_NODE_STEP * np.arange(count))


def _spline(nodes: FloatArray, values: FloatArray) -> Callable[[FloatArray], FloatArray]:
    from scipy.interpolate import make_interp_spline

    spline: Callable[[FloatArray], FloatArray] = make_interp_spline(nodes, values, k=_SPLINE_DEGREE)
    return spline


def at_days(angles: Callable[[FloatArray], FloatArray], days: FloatArray) -> FloatArray:
    """Evaluate nutation angles at given days; interpolate them if the days are closely spaced.

    Parameters
    ----------
    angles : callable
        Function of days, shape (n,), that returns rad, shape (n, ...); its shortest period must not
        be below that of nutation.
    days : ndarray, shape (n,)
        Days from J2000.0 TDB.
    """
    if not node_error(days):
        return angles(days)
    nodes = _nodes_of(days)
    return _spline(nodes, angles(nodes))(days)


def node_error(days: FloatArray) -> float:
    """Half-width of the nutation error due to interpolation between times, rad; 0 if exact."""
    return NODE_ERROR if days.size > _nodes_of(days).size else 0.0


def _nodes_of(days: FloatArray) -> FloatArray:
    return _nodes(float(np.min(days)), float(np.max(days)))


class NutationSpline:
    """Nutation of IAU 2000A, interpolated in time, for use with IAU 2006 precession.

    `erfa.nut06a` takes about 30 us per epoch. A quintic spline with one node per day takes a few
    tenths of a microsecond, with an error of at most 8e-12 rad.

    Parameters
    ----------
    start, end : float
        First and last day of the interpolation, from J2000.0 TDB.
    size : int, optional
        Number of epochs to evaluate; if there are fewer than nodes, the series is evaluated
        directly.
    """

    def __init__(self, start: float, end: float, size: int | None = None) -> None:
        def exact(days: FloatArray) -> FloatArray:
            return np.stack(erfa.nut06a(J2000_JD, days), axis=-1)

        nodes = _nodes(start, end)
        #: Number of terms of the series that are evaluated.
        self.evaluations = TERMS * min(nodes.size, size or nodes.size)
        #: Angles in longitude and obliquity, rad, shape (n, 2), at days of shape (n,).
        self.angles: Callable[[FloatArray], FloatArray] = exact
        #: Whether angles are interpolated between nodes.
        self.interpolates = size is None or size > nodes.size
        if self.interpolates:
            self.angles = _spline(nodes, exact(nodes))

    def true_equator(self, days: FloatArray) -> FloatArray:
        """Matrices from the GCRS to the true equator and equinox of date.

        Parameters
        ----------
        days : ndarray, shape (n,)

        Returns
        -------
        ndarray, shape (n, 3, 3)
        """
        dpsi, deps = self.angles(days).T
        mean_obliquity = erfa.obl06(J2000_JD, days)
        nutation = erfa.numat(mean_obliquity, dpsi, deps)
        return np.asarray(erfa.rxr(nutation, mean_equator(days)))


# --- lunar standstills ----------------------------------------------------------------------------
# The orbit is inclined by 5.1 degrees to the ecliptic and its node has a period of 18.6 years. When
# the ascending node is at the equinox, inclination and obliquity add (major standstill); half a
# period later they subtract (minor). The extreme of a single month differs from 23.44 +- 5.14
# degrees because solar perturbations vary the inclination between 5.0 and 5.3 degrees.

#: Spacing of the samples among which extremes are looked for, d.
_SAMPLING = 2.0
#: Spacings of three samples about each extreme, by which its time is refined to 0.5 s, d.
_CLOSER = (2.0, 0.2, 0.02)
_REACH = 2.0 * DAYS_PER_YEAR  # days searched before and after the passage of the node


@dataclass(frozen=True)
class Standstill:
    """Date and declination of the northern or southern extreme of a lunar standstill.

    Attributes
    ----------
    kind : str
        ``"major"`` or ``"minor"``.
    day : float
        Time of the extreme, days from J2000.0 TDB.
    declination : float
        Declination at that time, rad; negative for a southern extreme.
    """

    kind: str
    day: float
    declination: float


def node_passages(start: float, end: float) -> list[tuple[str, float]]:
    """Times when the Moon's mean node passes the equinox (major) or the opposite point (minor).

    Parameters
    ----------
    start, end : float
        Days from J2000.0 TDB; only passages whose search range is inside are listed.
    """
    days = np.arange(start, end, 10.0)
    if days.size < 2:
        return []
    half_turns = np.unwrap(mean_longitude_of_node(days)) / np.pi  # falls steadily
    passages = []
    for k in range(int(np.ceil(half_turns[-1])), int(np.floor(half_turns[0])) + 1):
        day = float(np.interp(-k, -half_turns, days))
        if start + _REACH < day < end - _REACH:
            passages.append(("minor" if k % 2 else "major", day))
    return sorted(passages, key=lambda passage: passage[1])


def find_standstills(
    declination: Callable[[FloatArray], FloatArray], start: float, end: float
) -> list[Standstill]:
    """Find the northern and southern extreme of each lunar standstill within a time span.

    Parameters
    ----------
    declination : callable
        Function of days from J2000.0 TDB, shape (n,), that returns declination, rad, shape (n,).
    start, end : float
        The span, days from J2000.0 TDB.

    Returns
    -------
    list of Standstill
        In order of time, two for each passage of the node; empty if there are none in the span.
    """
    passages = node_passages(start, end)
    if not passages:
        return []
    centres = [day for _, day in passages]
    days = np.add.outer(centres, np.arange(-_REACH, _REACH, _SAMPLING))
    rising = np.diff(declination(days.ravel()).reshape(days.shape), axis=1) > 0
    owner, place = np.nonzero(rising[:, 1:] != rising[:, :-1])
    turning = days[owner, place + 1]
    for spacing in _CLOSER:
        turning = _vertices(declination, turning, spacing)
    extremes = declination(turning)
    standstills = []
    for number, (kind, _) in enumerate(passages):
        for extreme in (extremes > 0, extremes < 0):
            places = np.flatnonzero(extreme & (owner == number))
            if places.size:
                swing = np.abs(extremes[places])
                best = places[np.argmax(swing) if kind == "major" else np.argmin(swing)]
                standstills.append(Standstill(kind, float(turning[best]), float(extremes[best])))
    return sorted(standstills, key=lambda standstill: standstill.day)


def _vertices(
    declination: Callable[[FloatArray], FloatArray], days: FloatArray, spacing: float
) -> FloatArray:
    """Days of extreme declination near given days, from a parabola through three values each."""
    before, middle, after = np.split(
        declination(np.concatenate([days - spacing, days, days + spacing])), 3
    )
    return days + spacing / 2 * (before - after) / (before - 2 * middle + after)
