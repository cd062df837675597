"""Effects of precession on the position of the equinox, the year and the calendar.

Sun and Moon move the equator along the fixed ecliptic; the planets tilt the ecliptic. The sum, the
general precession, shifts the seasons. The calendar drifts relative to the *tropical* year, which
includes precession, by one day in 128 years; the source text has 129.4 without a derivation.
"""

from __future__ import annotations

import math
from typing import Any

from earthspin.constants import DAY, JULIAN_YEAR

Numeric = Any

#: Years in which the Gregorian calendar drops one leap day: three in 400 years (I.8).
DROPPED_LEAP_DAY = 400 / 3
#: Mean Gregorian year: 97 leap days in 400 years, s.
GREGORIAN_YEAR = (365 + 97 / 400) * DAY


def general_precession(rate: Numeric, chi_rate: float, obliquity: float) -> Numeric:
    """General precession in longitude: lunisolar precession minus ecliptic motion, rad/s.

    p_A = psi_A - chi_A cos(epsilon), Capitaine et al. 2003, sect. 6.

    Parameters
    ----------
    rate : float
        Precession of the equator in longitude, rad/s.
    chi_rate : float
        Rate of the ecliptic along the equator, rad/s.
    obliquity : float
        rad.
    """
    return rate - chi_rate * math.cos(obliquity)


def time_per_degree(rate: Numeric) -> Numeric:
    """Time in which a given rate (rad/s) accumulates to one degree, s."""
    return math.radians(1.0) / rate


def tropical_year(rate: Numeric, sidereal_year: float) -> Numeric:
    """Length of the tropical year, s.

    Parameters
    ----------
    rate : float
        General precession, rad/s; the equinox moves towards the Sun.
    sidereal_year : float
        s.
    """
    return 2 * math.pi / (2 * math.pi / sidereal_year + rate)


def time_per_day_of_drift(tropical: Numeric, calendar: float = JULIAN_YEAR) -> Numeric:
    """Time in which a calendar year of given length drifts by one day from the seasons, s.

    Parameters
    ----------
    tropical : float
        Tropical year, s.
    calendar : float
        Mean year of the calendar, s: the Julian one, 365.25 days, by default.
    """
    return DAY / (calendar - tropical) * JULIAN_YEAR
