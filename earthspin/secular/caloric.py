"""Caloric half-years of Milankovitch, and the time of the year above a level of insolation.

The caloric summer is the half of the year in which the insolation of every day is above that of
every day of the other half, the winter. Its ends are on one level. Its energy is stationary with
respect to the level, so an error of the level counts in second order.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from earthspin.numerics.arrays import Array, FloatArray
from earthspin.numerics.bracketed_roots import bracketed_roots
from earthspin.numerics.kepler import mean_anomaly
from earthspin.secular.insolation import Season, daily, mean_longitude, true_longitude
from earthspin.secular.insolation_extremes import (
    extremes,
    has_night,
    like_earth,
    night_begins,
    night_ends,
    value_and_slope,
)
from earthspin.secular.season_means import accumulated, over_interval, over_year, pace, yearly_light

_TURN = 2 * np.pi
#: Most Newton steps for both ends of a half-year, convergence tolerance and largest step, rad.
NEWTON_STEPS, CLOSE, LARGEST_STEP = 9, 1e-7, 0.3
#: Tolerance of the level of several summers; its square is negligible.
LEVEL_CLOSE = 1e-8
#: On orbits like that of the Earth, there are two extremes only beyond the latitude (rad) with this
#: intercept and slope in the eccentricity (from a scan of obliquity, eccentricity and perihelion).
TROPICS = (0.3, 3.4)


def _rows(season: Season, rows: Array) -> Season:
    return Season(*(element[rows] for element in season))


# --- time above a level --------------------------------------------------------------------------


class Crossings(NamedTuple):
    """Longitudes at which the daily insolation crosses a level.

    Attributes
    ----------
    row : ndarray of int
    longitude : ndarray
        rad.
    down : ndarray
        1 where the insolation falls below the level, -1 where it rises.
    at_start : ndarray of bool
        By row, whether it is above the level at the first extreme, where the year begins.
    """

    row: Array
    longitude: FloatArray
    down: FloatArray
    at_start: Array


def crossings(
    season: Season,
    latitude: FloatArray,
    level: FloatArray,
    turning: FloatArray,
    tolerance: float = 1e-14,
) -> Crossings:
    """Find all crossings of a level, by roots between successive extremes `turning`."""
    ends = np.sort(np.concatenate([turning, turning[:, :1] + _TURN], axis=1), axis=1)  # NaN last
    column = Season(*(element[:, np.newaxis] for element in season))
    height = level * np.pi * (1 - season.eccentricity**2) ** 2
    above = value_and_slope(column, latitude[:, np.newaxis], ends)[0] > height[:, np.newaxis]
    crossed = (ends[:, 1:] > ends[:, :-1]) & (above[:, 1:] != above[:, :-1])
    row, piece = np.nonzero(crossed)
    orbit, place, height = _rows(season, row), latitude[row], height[row]

    def difference(at: FloatArray, which: Array) -> FloatArray:
        return value_and_slope(_rows(orbit, which), place[which], at)[0] - height[which]

    at = bracketed_roots(difference, ends[row, piece], ends[row, piece + 1], tolerance)
    return Crossings(row, at, np.where(above[row, piece], 1.0, -1.0), above[:, 0])


def share_above(season: Season, at: Crossings) -> FloatArray:
    """Share of the year above the level."""
    orbit = _rows(season, at.row)
    anomaly = mean_anomaly(at.longitude - orbit.perihelion - np.pi, orbit.eccentricity)
    total = np.bincount(at.row, at.down * anomaly, at.at_start.size)
    return np.asarray(total / _TURN + at.at_start)


def integral_above(season: Season, latitude: FloatArray, at: Crossings) -> FloatArray:
    """Integral of the insolation over the time above the level, in years."""
    light = accumulated(season.obliquity[at.row], latitude[at.row], at.longitude)
    total = np.bincount(at.row, at.down * light, at.at_start.size)
    whole = at.at_start * _TURN * yearly_light(season.obliquity, latitude)
    return np.asarray((total + whole) / (2 * np.pi**2 * np.sqrt(1 - season.eccentricity**2)))


# --- caloric half-years --------------------------------------------------------------------------


class HalfYears(NamedTuple):
    """Mean insolation in the caloric half-years, the level between them, and ends of the summer.

    Longitudes of the ends are in rad, and NaN if the summer has several parts or is not unique.
    """

    summer: FloatArray
    winter: FloatArray
    level: FloatArray
    start: FloatArray
    end: FloatArray


def caloric_half_years(season: Season, latitude: FloatArray) -> HalfYears:
    """Caloric half-years, as fractions of the solar constant.

    Parameters
    ----------
    season : Season
    latitude : ndarray, shape (n,)
        rad; the elements have the same shape.
    """
    start, end, level, single = _ends(season, latitude)
    summer = over_interval(season, latitude, start, np.where(single, end, start + np.pi))
    tropics = np.abs(latitude) < TROPICS[0] + TROPICS[1] * season.eccentricity
    check = np.flatnonzero(~single | tropics | ~like_earth(season))
    if check.size:
        orbit, place = _rows(season, check), latitude[check]
        turning = extremes(orbit, place)
        count = np.isfinite(turning).sum(axis=1) - has_night(orbit, place)
        several = (count > 2) | ~single[check]
        rows = check[several]
        orbit, place = _rows(season, rows), latitude[rows]
        summer[rows], level[rows] = _several_summers(orbit, place, turning[several])
        start[rows] = end[rows] = np.nan
    winter = 2 * over_year(season, latitude) - summer
    return HalfYears(summer, winter, level, start % _TURN, end % _TURN)


def _ends(season: Season, latitude: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, Array]:
    """Ends and level of a single summer by Newton's method, and whether it converged.

    The two equations are: same insolation, and mean anomalies half a turn apart.
    """
    solstice = np.where(latitude < 0, 1.5, 0.5) * np.pi
    middle = mean_longitude(season, solstice)
    start, end = (true_longitude(season, middle + side * np.pi / 2) for side in (-1, 1))
    level, converged = np.zeros(latitude.size), np.zeros(latitude.size, dtype=bool)
    todo = np.arange(latitude.size)
    for _ in range(NEWTON_STEPS):
        orbit, ends = _rows(season, todo), np.stack([start[todo], end[todo]])
        square = 1 - orbit.eccentricity**2
        value, slope = value_and_slope(orbit, latitude[todo], ends)
        v = ends - orbit.perihelion - np.pi
        near = 1 + orbit.eccentricity * np.cos(v)
        gradient, (speed, last_speed) = near * slope, square**1.5 / near**2
        anomaly = mean_anomaly(v, orbit.eccentricity)
        unequal, longer = value[0] - value[1], anomaly[1] - anomaly[0] - np.pi
        with np.errstate(divide="ignore", invalid="ignore"):
            determinant = last_speed * gradient[0] - speed * gradient[1]
            last = -(speed * unequal + longer * gradient[0]) / determinant
        last = np.clip(last, -LARGEST_STEP, LARGEST_STEP)
        first = np.clip((longer + last_speed * last) / speed, -2 * LARGEST_STEP, 2 * LARGEST_STEP)
        start[todo], end[todo] = ends + np.stack([first, last])
        level[todo] = (value[0] + gradient[0] * first) / (np.pi * square**2)
        done = np.maximum(np.abs(first), np.abs(last)) < CLOSE  # converges quadratically
        converged[todo] = done & (slope[0] > 0) & (slope[1] < 0)
        todo = todo[~done & np.isfinite(last)]
    return start, end, level, converged


def _several_summers(
    season: Season, latitude: FloatArray, turning: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean over a caloric summer of several parts and its level, by a root of the share above it.

    With a polar night of half a year or more, the level is zero and the summer holds all the light.
    """
    column = Season(*(element[:, np.newaxis] for element in season))
    values = daily(column, latitude[:, np.newaxis], turning)
    low, high = np.nanmin(values, axis=1), np.nanmax(values, axis=1)
    begin, end = night_begins(season, latitude), night_ends(season, latitude)
    dark = pace(season, begin, end) * (end - begin) >= np.pi
    level, light = np.zeros(latitude.size), np.flatnonzero(~dark)

    def excess(level: FloatArray, which: Array) -> FloatArray:
        rows = light[which]
        orbit = _rows(season, rows)
        at = crossings(orbit, latitude[rows], level, turning[rows], LEVEL_CLOSE / 10)
        return share_above(orbit, at) - 0.5

    low, high = low[light] - LEVEL_CLOSE, high[light] + LEVEL_CLOSE
    level[light] = bracketed_roots(excess, low, high, LEVEL_CLOSE)
    at = crossings(season, latitude, level, turning)
    half = integral_above(season, latitude, at) + level * (0.5 - share_above(season, at))
    return 2 * np.where(dark, over_year(season, latitude), half), level
