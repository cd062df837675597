"""Error bounds of kernels: largest differences between DE421 and DE440, by pair of bodies.

Each is the largest difference of the direction (angle between positions) and of the distance at
steps of 1.7 d over the coverage of DE421, 1899 to 2053, as both kernels give them. Outside that
span nothing was measured, and the bound grows with the square of the time from J2000.0, as a
difference of lunar tidal accelerations does (DE421 and DE440 differ by 7.3 mas per century squared
along the track). The bound for a pair does not depend on which body is the reference.
"""

from __future__ import annotations

from earthspin.constants import JULIAN_YEAR

#: Days from J2000.0 TDB beyond which a difference grows. Both kernels cover -36,684 to 19,639; the
#: limits are slightly inside, so that the bound for the Moon in 1560 is the 141 mas of the two
#: accelerations.
GROWS_FROM = (-35700.0, 19600.0)

#: Difference of an axis between two kernels, relative to the angle of its motion: the largest value
#: for the Earth with Sun and Moon (3.4e-9), with the Sun only (3.2e-9), and for Mars (2.7e-9), 1901
#: to 2050.
DRIFT = 3.6e-9
#: Allowance for short-period differences: the motion of the axis in this time, s.
DRIFT_FROM = 4 * JULIAN_YEAR
#: Pairs for which `DRIFT` was measured, by their codes.
DRIFT_MEASURED = ((10, 399), (301, 399), (4, 10))

#: Differences of direction (mas) and distance (m) by two NAIF codes, the smaller first; a planet's
#: barycentre represents the planet.
DIFFERENCES: dict[tuple[int, int], tuple[float, float]] = {
    (1, 2): (15, 1300),
    (1, 4): (17, 5000),
    (1, 5): (21, 3000),
    (1, 6): (1.5, 2800),
    (1, 7): (320, 980000),
    (1, 8): (210, 2.2e06),
    (1, 10): (12, 290),
    (1, 301): (7.3, 1400),
    (1, 399): (7.3, 1400),
    (2, 4): (19, 6500),
    (2, 5): (22, 2700),
    (2, 6): (1.2, 2300),
    (2, 7): (320, 1.1e06),
    (2, 8): (210, 2.3e06),
    (2, 10): (2.4, 12),
    (2, 301): (2.2, 190),
    (2, 399): (2.2, 180),
    (4, 5): (27, 7500),
    (4, 6): (2.1, 9300),
    (4, 7): (340, 1.2e06),
    (4, 8): (210, 2.4e06),
    (4, 10): (9.5, 990),
    (4, 301): (30, 7400),
    (4, 399): (30, 7400),
    (5, 6): (21, 7200),
    (5, 7): (430, 1.7e06),
    (5, 8): (200, 2.8e06),
    (5, 10): (19, 770),
    (5, 301): (23, 2900),
    (5, 399): (23, 2900),
    (6, 7): (500, 2.3e06),
    (6, 8): (230, 2.6e06),
    (6, 10): (1.1, 1300),
    (6, 301): (1.2, 2600),
    (6, 399): (1.2, 2600),
    (7, 8): (110, 5.7e06),
    (7, 10): (310, 930000),
    (7, 301): (330, 1.1e06),
    (7, 399): (322, 1.1e06),
    (8, 10): (200, 2.2e06),
    (8, 301): (210, 2.3e06),
    (8, 399): (207, 2.3e06),
    (10, 301): (2.1, 34),
    (10, 399): (2.1, 23),
    (301, 399): (7.2, 1.1),
}


def largest_difference(centre: int, target: int) -> tuple[float, float]:
    """Largest difference between two kernels for a pair of bodies: direction (mas), distance (m).

    Parameters
    ----------
    centre, target : int
        NAIF codes. For a pair that was not measured, the largest measured values with the same
        centre, or of all pairs, are returned.
    """
    pair = sorted((_barycentre(centre), _barycentre(target)))
    entries = DIFFERENCES.get((pair[0], pair[1]))
    if entries is not None:
        return entries
    near = [size for codes, size in DIFFERENCES.items() if _barycentre(centre) in codes]
    mas, metres = zip(*(near or DIFFERENCES.values()), strict=True)
    return max(mas), max(metres)


def growth(day: float) -> float:
    """Factor by which kernel differences grow outside the dates for which they were measured.

    Parameters
    ----------
    day : float
        Days from J2000.0 TDB; the factor is 1 inside `GROWS_FROM`.
    """
    edge = GROWS_FROM[0] if day < 0 else GROWS_FROM[1]
    return max(1.0, (day / edge) ** 2)


def drift_is_measured(centre: int, target: int) -> bool:
    """Return True if the error `DRIFT` of the axis motion was measured for a body and perturber."""
    pair = sorted((_barycentre(centre), _barycentre(target)))
    return (pair[0], pair[1]) in DRIFT_MEASURED


def _barycentre(code: int) -> int:
    """NAIF code of the barycentre of a planet with its moons; Earth and others keep their code."""
    planet = code // 100 if 100 < code < 1000 and code % 100 == 99 else code
    return code if planet == 3 else planet
