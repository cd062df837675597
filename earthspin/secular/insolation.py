r"""Daily mean insolation at the top of an atmosphere, from orbit and obliquity.

The Sun's longitude L is seen from the body and measured along the orbit from the moving equinox: 0
at the March equinox, 90 degrees at the June solstice. The *body's* perihelion has the longitude w,
so at perihelion the Sun is at w + 180 degrees, and the true anomaly is v = L - w - 180 degrees. For
a solar constant S at the mean distance a, the daily mean insolation on a day with the Sun's
declination d is

    W = (S/pi) (a/r)^2 (H sin(phi) sin(d) + cos(phi) cos(d) sin(H)),   cos(H) = -tan(phi) tan(d),
    sin(d) = sin(eps) sin(L),   a/r = (1 + e cos v)/(1 - e^2)

(Berger 1978, J. Atmos. Sci. 35, 2362; the same in Laskar et al. 2004, A&A 428, 261). The mean over
a band of latitudes is weighted by area; that over the globe is S/4 (a/r)^2. A *mean*
longitude increases uniformly with time and equals that of the true Sun at the March equinox, after
Berger.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.kepler import mean_anomaly, true_anomaly

#: Least value of squares and cosines that are divided by, or that elliptic integrals are given.
SMALLEST = 1e-32


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


class Band(NamedTuple):
    """Latitudes between which insolation is averaged by area, rad."""

    south: FloatArray
    north: FloatArray


Place = FloatArray | Band


def daily(season: Season, place: Place, longitude: FloatArray) -> FloatArray:
    """Daily mean insolation as a fraction of the solar constant at the mean distance.

    Parameters
    ----------
    season : Season
    place : ndarray or Band
        Latitude, rad, or two latitudes.
    longitude : ndarray
        True longitude of the Sun, rad.
    """
    closeness = inverse_square(season, longitude)
    return np.asarray(closeness * daylight(season.obliquity, place, longitude) / np.pi)


def inverse_square(season: Season, longitude: FloatArray) -> FloatArray:
    """Factor (a/r)^2 of the insolation, which does not depend on latitude and obliquity."""
    e = season.eccentricity
    nearness = (1 + e * np.cos(longitude - season.perihelion - np.pi)) / (1 - e * e)
    return np.asarray(nearness**2)


def daylight(obliquity: FloatArray, place: Place, longitude: FloatArray) -> FloatArray:
    """Sine of the Sun's height, integrated over the hour angle from noon to sunset, rad.

    It depends on the orbit only through the true longitude.
    """
    sine = np.sin(obliquity) * np.sin(longitude)
    if isinstance(place, Band):
        north, south = (_from_equator(sine, latitude) for latitude in (place.north, place.south))
        return np.asarray((north - south) / (np.sin(place.north) - np.sin(place.south)))
    polar, equatorial = np.sin(place) * sine, np.cos(place) * np.sqrt(1 - sine * sine)
    # half the length of daylight is pi during a polar day and 0 during a polar night
    half_day = np.arccos(np.clip(-polar / np.maximum(equatorial, 1e-300), -1.0, 1.0))
    return np.asarray(half_day * polar + equatorial * np.sin(half_day))


def _from_equator(sine: FloatArray, latitude: FloatArray) -> FloatArray:
    """Integral of `daylight` over the sine of the latitude, from the equator to a latitude.

    Parameters
    ----------
    sine : ndarray
        Sine of the Sun's declination.
    latitude : ndarray
        rad.
    """
    y, square = np.sin(latitude), np.maximum((1 - sine) * (1 + sine), SMALLEST)
    ratio = np.clip(y / np.sqrt(square), -1.0, 1.0)
    root = np.sqrt((1 - ratio) * (1 + ratio))
    edge = np.sign(sine * y) * np.pi / 2  # polar day or night
    excess = np.where(y * y > square, edge, np.arctan2(sine * ratio, root))  # half-day less pi/2
    even = np.arcsin(ratio) + square * ratio * root - sine * excess * np.cos(latitude) ** 2
    return np.asarray((np.pi / 2 * sine * y * y + even) / 2)


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
