r"""Insolation averaged over intervals of longitude, windows of time, seasons and the year.

With k = sin(eps), s = k sin(L) = sin(d), c = cos(phi), the day integral (`daylight`) is

    D(L) = (pi/2 + eta) sin(phi) s + R,   R = sqrt(c^2 - s^2), eta = atan2(sin(phi) s, R),

where R = 0 and eta = ±pi/2 during the polar day and night. As (a/r)^2 dt is proportional to dL, the
mean over a time is S/(pi sqrt(1 - e^2)) times the integral of D over L, divided by the change of
the mean anomaly: eccentricity and perihelion leave the integral. The integral of the part of D that
has the period pi is, by parts, from 0 to |L| <= pi/2,

    P(L) = J - eta sin(phi) k cos(L),
    J = g [(c^2 + k^2 sin(phi)^2) R_F - (c u)^2/3 (R_D + sin(phi)^2 cos(eps)^2 R_J)],
    u = s/c,   g = sin(L)/c,

with Carlson's integrals at cos(L)^2, 1 - u^2, 1 and p = 1 - s^2. Where the polar day or night has
begun, sin(L) and u, but not cos(L) in P, remain those of its first day: one formula for all cases.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.kepler import mean_anomaly
from earthspin.secular.insolation import (
    SMALLEST,
    Band,
    Place,
    Season,
    daylight,
    inverse_square,
    mean_longitude,
    true_longitude,
)

#: Function of the true longitude of the Sun.
Curve = Callable[[FloatArray], FloatArray]
#: Span of true longitude, rad (a minute of time), below which differences of integrals lose digits
#: and Gauss-Legendre quadrature is used, and its number of nodes. At the edge of the polar night
#: both have an error of at most 5e-11.
SHORT_SPAN, SHORT_NODES = 1e-5, 4
#: Nodes in each piece of the integral over longitudes of a band of latitudes.
BAND_NODES = 24


def over_interval(season: Season, place: Place, first: FloatArray, last: FloatArray) -> FloatArray:
    """Mean insolation over the time in which the Sun moves between two true longitudes.

    Parameters
    ----------
    season : Season
    place : ndarray or Band
    first, last : ndarray
        rad; the last longitude is larger, by any number of turns.
    """
    return light(season.obliquity, place, first, last) * rate(season, first, last) / np.pi


def light(obliquity: FloatArray, place: Place, first: FloatArray, last: FloatArray) -> FloatArray:
    """Mean of `daylight` over the true longitude; it does not depend on the orbit."""
    return _mean(
        lambda longitude: daylight(obliquity, place, longitude),
        lambda longitude: accumulated(obliquity, place, longitude),
        first,
        last,
    )


def rate(season: Season, first: FloatArray, last: FloatArray) -> FloatArray:
    """Mean of (a/r)^2 over time, which turns `light` into a mean; it depends on the orbit alone."""
    return 1 / (np.sqrt(1 - season.eccentricity**2) * pace(season, first, last))


def pace(season: Season, first: FloatArray, last: FloatArray) -> FloatArray:
    """Change of the mean anomaly between two true longitudes, divided by their difference."""
    opposite, e = season.perihelion + np.pi, season.eccentricity
    return _mean(
        lambda longitude: 1 / (inverse_square(season, longitude) * np.sqrt(1 - e * e)),
        lambda longitude: mean_anomaly(longitude - opposite, e),
        first,
        last,
    )


def _mean(function: Curve, integral: Curve, first: FloatArray, last: FloatArray) -> FloatArray:
    """Mean of a function of the longitude from its integral, or over short spans by quadrature."""
    span = last - first
    short = span < SHORT_SPAN
    mean = (integral(last) - integral(first)) / np.where(short, 1.0, span)
    if short.any():
        nodes, weights = np.polynomial.legendre.leggauss(SHORT_NODES)
        rule = zip(nodes, weights / 2, strict=True)
        middle = (first + last) / 2
        mean = np.where(short, sum(w * function(middle + span / 2 * x) for x, w in rule), mean)
    return np.asarray(mean)


def over_window(season: Season, place: Place, longitude: FloatArray, share: float) -> FloatArray:
    """Mean insolation over a share of the year, centred in time on a true longitude of the Sun."""
    middle = mean_longitude(season, longitude)
    first, last = (true_longitude(season, middle + side * np.pi * share) for side in (-1, 1))
    return np.maximum(over_interval(season, place, first, last), 0.0)


def over_year(season: Season, place: Place) -> FloatArray:
    """Mean insolation over the year."""
    light = yearly_light(season.obliquity, place) / np.pi
    return light / np.sqrt(1 - season.eccentricity**2)


def yearly_light(obliquity: FloatArray, place: Place) -> FloatArray:
    """Mean of `daylight` over the true longitude in a year."""
    return np.asarray(2 * _quadrant(obliquity, place) / np.pi)


# --- integral over the true longitude ------------------------------------------------------------


def accumulated(obliquity: FloatArray, place: Place, longitude: FloatArray) -> FloatArray:
    """Integral of `daylight` over the true longitude from the March equinox, rad."""
    half_turns = np.rint(longitude / np.pi)
    even = _even_part(obliquity, place, longitude - np.pi * half_turns)
    if half_turns.any():
        even = even + 2 * half_turns * _quadrant(obliquity, place)
    odd = np.pi * _sine(place) * np.abs(np.sin(obliquity)) * np.sin(longitude / 2) ** 2
    return np.asarray(even + odd)


def _sine(place: Place) -> FloatArray:
    """Sine of the latitude, or its mean over a band."""
    sines = [np.sin(latitude) for latitude in (place if isinstance(place, Band) else [place])]
    return np.asarray(sum(sines) / len(sines))


def _quadrant(obliquity: FloatArray, place: Place) -> FloatArray:
    """Integral of the part of `daylight` that has the period pi, over a quarter turn."""
    return _even_part(obliquity, place, np.array(np.pi / 2))


def _even_part(obliquity: FloatArray, place: Place, longitude: FloatArray) -> FloatArray:
    """Integral P of the part of `daylight` that has the period pi, up to |L| <= pi/2."""
    from scipy.special import elliprd, elliprf, elliprj  # imported here because it takes 0.1 s

    if isinstance(place, Band):
        return _even_part_of_band(obliquity, place, longitude)
    k = np.maximum(np.abs(np.sin(obliquity)), SMALLEST)
    up, c = np.sin(place), np.maximum(np.abs(np.cos(place)), SMALLEST)
    sine, cosine = np.sin(longitude), np.cos(longitude)
    ratio = k * sine / c
    polar = np.abs(ratio) > 1
    u = np.clip(ratio, -1.0, 1.0)
    # cos(L)^2 and sin(L) on the first polar day are (k - c)(k + c)/k^2 and c/k, without cancelling
    square = np.where(polar, (k - c) * (k + c) / k**2, cosine**2)
    s = k * np.where(polar, c / k * np.sign(sine), sine)
    g = np.where(k > c, u / k, np.where(polar, np.sign(sine) / k, sine / c))
    # eta and R_F take the same rounded 1 - u^2, so that they cancel at the edge of the night
    rest = (1 - u) * (1 + u)
    x, y, p = (np.maximum(q, SMALLEST) for q in (square, rest, (1 - s) * (1 + s)))
    tilted = (up * np.cos(obliquity)) ** 2
    third = (elliprd(x, y, 1.0) + tilted * elliprj(x, y, 1.0, p)) / 3
    carlson = (c * c + (k * up) ** 2) * elliprf(x, y, 1.0) - (c * u) ** 2 * third
    return np.asarray(g * carlson - np.arctan2(up * u, np.sqrt(rest)) * up * k * cosine)


def _even_part_of_band(obliquity: FloatArray, band: Band, longitude: FloatArray) -> FloatArray:
    """`_even_part` for a band of latitudes, by quadrature between the edges of polar day and night.

    It is not an elliptic integral. The substitution t^3 (10 - 15 t + 6 t^2) flattens the integrand
    at both ends of each piece.
    """
    nodes, weights = np.polynomial.legendre.leggauss(BAND_NODES)
    t = (1 + nodes) / 2
    rule = zip(t**3 * (10 - 15 * t + 6 * t * t), 15 * weights * (t - t * t) ** 2, strict=True)
    k, up = np.abs(np.sin(obliquity)), _sine(band)
    size = np.abs(longitude)
    ratios = (np.abs(np.cos(edge)) / np.maximum(k, SMALLEST) for edge in band)
    starts = [np.arcsin(np.minimum(ratio, 1.0)) for ratio in ratios]
    cuts: list[FloatArray] = [
        0 * size,
        *(np.minimum(start, size) for start in (np.minimum(*starts), np.maximum(*starts))),
    ]
    total: FloatArray = np.zeros(())
    for place, weight in rule:
        for start, stop in zip(cuts, [*cuts[1:], size], strict=True):
            at = start + (stop - start) * place
            even = daylight(obliquity, band, at) - np.pi / 2 * up * k * np.sin(at)
            total = total + weight * (stop - start) * even
    return np.asarray(np.sign(longitude) * total)
