r"""Daily mean insolation at the top of an atmosphere, from orbit and obliquity.

The Sun's longitude L is seen from the body and measured along the orbit from the moving equinox: 0
at the March equinox, 90 degrees at the June solstice. The *body's* perihelion has the longitude w,
so at perihelion the Sun is at w + 180 degrees, and the true anomaly is v = L - w - 180 degrees. For
a solar constant S at the mean distance a, the daily mean insolation on a day with the Sun's
declination d is

    W = (S/pi) (a/r)^2 (H sin(phi) sin(d) + cos(phi) cos(d) sin(H)),   cos(H) = -tan(phi) tan(d),
    sin(d) = sin(eps) sin(L),   a/r = (1 + e cos v)/(1 - e^2)

(Berger 1978, J. Atmos. Sci. 35, 2362; the same in Laskar et al. 2004, A&A 428, 261). A *mean*
longitude increases uniformly with time and equals that of the true Sun at the March equinox, after
Berger.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.kepler import mean_anomaly, true_anomaly
from earthspin.numerics.varied_inputs import Quantiles, draws

#: Half-width of the longitude of perihelion, rad, above which its contribution is sampled.
SAMPLED_FROM = 0.1
#: Gauss-Legendre nodes in each piece of a window, and bound on the error of a window's mean as a
#: fraction of the solar constant (measured: 2e-9 for obliquities near 90 degrees, 7e-10 by rounding
#: in windows of seconds, 1e-11 otherwise).
NODES, WINDOW_ERROR = 24, 5e-9
#: Least length of a window as a fraction of the year (10 s), because of rounding.
SHORTEST = 3e-7


class Season(NamedTuple):
    """Obliquity, eccentricity and longitude of perihelion, from which insolation is computed.

    Attributes
    ----------
    obliquity : ndarray
        rad.
    eccentricity : ndarray
    perihelion : ndarray
        Longitude of the body's perihelion from the moving equinox, rad.
    """

    obliquity: FloatArray
    eccentricity: FloatArray
    perihelion: FloatArray


def daily(season: Season, latitude: FloatArray, longitude: FloatArray) -> FloatArray:
    """Daily mean insolation as a fraction of the solar constant at the mean distance.

    Parameters
    ----------
    season : Season
    latitude : ndarray
        rad.
    longitude : ndarray
        True longitude of the Sun, rad.
    """
    closeness = inverse_square(season, longitude)
    return np.asarray(closeness * daylight(season.obliquity, latitude, longitude) / np.pi)


def inverse_square(season: Season, longitude: FloatArray) -> FloatArray:
    """Factor (a/r)^2 of the insolation, which does not depend on latitude and obliquity."""
    e = season.eccentricity
    nearness = (1 + e * np.cos(longitude - season.perihelion - np.pi)) / (1 - e * e)
    return np.asarray(nearness**2)


def daylight(obliquity: FloatArray, latitude: FloatArray, longitude: FloatArray) -> FloatArray:
    """Sine of the Sun's height, integrated over the hour angle from noon to sunset, rad.

    It depends on the orbit only through the true longitude.
    """
    sine = np.sin(obliquity) * np.sin(longitude)
    return _at_declination(sine, np.sin(latitude), np.cos(latitude))


def _at_declination(sine: FloatArray, up: FloatArray, across: FloatArray) -> FloatArray:
    """`daylight` from sines of declination and latitude, and the cosine of the latitude."""
    polar, equatorial = up * sine, across * np.sqrt(1 - sine * sine)
    # half the length of daylight is pi during a polar day and 0 during a polar night
    half_day = np.arccos(np.clip(-polar / np.maximum(equatorial, 1e-300), -1.0, 1.0))
    return np.asarray(half_day * polar + equatorial * np.sin(half_day))


def true_longitude(season: Season, mean: FloatArray) -> FloatArray:
    """True longitude of the Sun, rad, from a mean one that equals it at the March equinox."""
    e = season.eccentricity
    at_equinox = mean_anomaly(-season.perihelion - np.pi, e)
    anomaly = true_anomaly(at_equinox + mean, e)
    return np.asarray(anomaly + season.perihelion + np.pi)


def mean_longitude(season: Season, true: FloatArray) -> FloatArray:
    """Mean longitude of the Sun, rad, from the true one, which equals it at the March equinox."""
    e, opposite = season.eccentricity, season.perihelion + np.pi
    return np.asarray(mean_anomaly(true - opposite, e) - mean_anomaly(-opposite, e))


def over_days(
    season: Season, latitude: FloatArray, longitude: FloatArray, days: float
) -> FloatArray:
    """Mean insolation over a time window centred on the day of a true longitude of the Sun.

    As (a/r)^2 dt is proportional to dL, the mean follows from the integral of the daylight over the
    true longitude. It is computed piece by piece between the solstices, or between the longitudes
    at which polar day and night begin and end, with a substitution that removes the root there.

    Parameters
    ----------
    season : Season
    latitude, longitude : ndarray
        rad; the longitude is a true longitude.
    days : float
        Length of the window as a fraction of the year.
    """
    half = np.pi * max(days, SHORTEST)
    middle = mean_longitude(season, longitude)
    first, last = (true_longitude(season, middle + end) for end in (-half, half))
    tilt, level = np.sin(season.obliquity), np.abs(np.cos(latitude))
    night = np.arcsin(level / np.maximum(np.abs(tilt), level))  # where sin(d) = cos(phi)
    half_turns = np.pi * np.rint(first / np.pi)
    kinks = [half_turns + n * np.pi + side * night for n in range(3) for side in (-1, 1)]
    edges = np.broadcast_arrays(first, *np.clip(kinks, first, last), last)
    numbers = np.broadcast_arrays(tilt, np.sin(latitude), level, edges[0])[:3]
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    angles = np.pi / 2 * (1 + nodes)
    rule = np.stack([np.sin(angles / 2) ** 2, np.pi / 4 * weights * np.sin(angles)], axis=1)
    total = np.zeros(edges[0].shape)
    for start, stop in itertools.pairwise(edges):
        piece = stop > start
        if piece.any():
            at, width = start[piece], (stop - start)[piece]
            tilts, *place = (number[piece] for number in numbers)
            light = (w * _at_declination(tilts * np.sin(at + x * width), *place) for x, w in rule)
            total[piece] += width * sum(light)
    return np.asarray(total / (2 * np.pi * half * np.sqrt(1 - season.eccentricity**2)))


def with_error(
    season: Season,
    half_widths: Season,
    latitude: FloatArray,
    longitude: FloatArray,
    is_true: bool = True,
    days: float | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Daily (or longer) mean insolation and 95 % half-width, as fractions of the solar constant.

    Parameters
    ----------
    season : Season
    half_widths : Season
        95 % half-widths of obliquity, eccentricity and perihelion, treated as independent.
    latitude, longitude : ndarray
        rad.
    is_true : bool
        Whether the longitudes of the Sun are true longitudes; mean longitudes if False.
    days : float, optional
        Length of a window as a fraction of the year; by default the mean over one day. The
        half-width includes the bound `WINDOW_ERROR` of a window.
    """
    if is_true and days is None:
        # Obliquity changes only the daylight, eccentricity and perihelion only the distance.
        def factor(season: Season) -> FloatArray:
            return inverse_square(season, longitude)

        def light_on_day(season: Season) -> FloatArray:
            return daylight(season.obliquity, latitude, longitude)

        by_tilt = _squared_changes(light_on_day, season, half_widths, "obliquity")
        by_orbit = _squared_changes(factor, season, half_widths, "eccentricity", "perihelion")
        nearness, light = factor(season), light_on_day(season)
        total = nearness**2 * by_tilt + light**2 * by_orbit
        return nearness * light / np.pi, np.sqrt(total / np.pi**2)

    def mean(season: Season) -> FloatArray:
        true = longitude if is_true else true_longitude(season, longitude)
        if days is None:
            return daily(season, latitude, true)
        return over_days(season, latitude, true, days)

    total = _squared_changes(mean, season, half_widths, *Season._fields)
    return mean(season), np.sqrt(total + (0.0 if days is None else WINDOW_ERROR**2))


def _squared_changes(
    function: Callable[[Season], FloatArray], season: Season, half_widths: Season, *names: str
) -> FloatArray:
    """Sum of the squared changes of a function if each named element varies by its half-width."""

    def varied(name: str, multiple: float) -> FloatArray:
        value = getattr(season, name) + multiple * getattr(half_widths, name)
        return function(season._replace(**{name: value}))

    total: FloatArray = np.zeros(1)
    for name in names:
        change = (varied(name, 1) - varied(name, -1)) / 2
        half_width = getattr(half_widths, name)
        if name == "perihelion" and np.any(half_width > SAMPLED_FROM):
            value, quantiles = function(season), Quantiles()
            for (multiple,) in draws(1):
                quantiles.add({name: varied(name, float(multiple)) - value})
            change = np.where(half_width <= SAMPLED_FROM, change, quantiles.at_probability()[name])
        total = total + change**2
    return total
