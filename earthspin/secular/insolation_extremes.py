"""Days of the year with the largest and smallest daily insolation: all of its extremes.

There are two to eight. They are the roots of the derivative of the insolation with respect to the
true longitude,

    W' ~ (1 + e cos v) D' - 2 e sin(v) D,   D' = k cos(L) [(pi/2 + eta) sin(phi) - s R/(1 - s^2)],

in the notation of `season_means`. The polar night is a flat minimum: its two edges are in the list.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from earthspin.numerics.arrays import Array, FloatArray
from earthspin.numerics.bracketed_roots import bracketed_roots
from earthspin.secular.insolation import SMALLEST, Season, daily

_TURN = 2 * np.pi
#: Longitudes at which signs of the derivative are compared, for orbits like that of the Earth (none
#: of 12,000 random cases had a pair of extremes between two of 48 points) and for all others.
POINTS, FINE_POINTS = 48, 180
#: Parts of an interval that may hide two roots.
PARTS = 64
#: Rows computed together, so that they fit into the cache.
ROWS = 4000


def value_and_slope(
    season: Season, latitude: FloatArray, longitude: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Daily insolation times pi (1 - e^2)^2, and its derivative divided by 1 + e cos(v).

    Parameters
    ----------
    season : Season
    latitude, longitude : ndarray
        rad.
    """
    e, v = season.eccentricity, longitude - season.perihelion - np.pi
    k, up = np.abs(np.sin(season.obliquity)), np.sin(latitude)
    c = np.maximum(np.abs(np.cos(latitude)), SMALLEST)
    s = k * np.sin(longitude)
    u = np.clip(s / c, -1.0, 1.0)
    root = np.sqrt((1 - u) * (1 + u))
    high, level = (np.pi / 2 + np.arctan2(up * u, root)) * up, c * root
    day, near = high * s + level, 1 + e * np.cos(v)
    change = k * np.cos(longitude) * (high - s * level / np.maximum(1 - s * s, SMALLEST))
    return near * near * day, near * change - 2 * e * np.sin(v) * day


def like_earth(season: Season) -> Array:
    """Return True where the obliquity is 20 to 27 degrees, and the eccentricity below 0.1."""
    tilt, e = np.sin(season.obliquity), season.eccentricity
    return np.asarray((tilt > 0.342) & (tilt < 0.454) & (e < 0.1))


def night_begins(season: Season, latitude: FloatArray) -> FloatArray:
    """True longitude at which the polar night begins, rad, or at which the Sun is lowest.

    The night lasts up to the same distance beyond the solstice.
    """
    ratio = np.abs(np.cos(latitude)) / np.maximum(np.abs(np.sin(season.obliquity)), SMALLEST)
    return np.asarray(np.where(latitude < 0, 0, np.pi) + np.arcsin(np.minimum(ratio, 1.0)))


def night_ends(season: Season, latitude: FloatArray) -> FloatArray:
    """True longitude at which the polar night ends, rad."""
    return np.where(latitude < 0, np.pi, 3 * np.pi) - night_begins(season, latitude)


def has_night(season: Season, latitude: FloatArray) -> Array:
    """Return True where there is a polar night."""
    return np.asarray(np.abs(np.cos(latitude)) < np.abs(np.sin(season.obliquity)))


def extremes(season: Season, latitude: FloatArray) -> FloatArray:
    """True longitudes of all extremes in ascending order, rad, and of the edges of the polar night.

    Parameters
    ----------
    season : Season
    latitude : ndarray, shape (n,)
        rad; the elements have the same shape.

    Returns
    -------
    ndarray, shape (n, most)
        NaN fills shorter rows. The equinox stands for a year in which nothing varies.
    """
    near, tables = like_earth(season), []
    for rows, points in ((np.flatnonzero(near), POINTS), (np.flatnonzero(~near), FINE_POINTS)):
        for block in np.array_split(rows, rows.size // ROWS + 1):
            at = Season(*(element[block] for element in season))
            tables.append((block, _extremes(at, latitude[block], points)))
    result = np.full((latitude.size, max(table.shape[1] for _, table in tables)), np.nan)
    for block, table in tables:
        result[block, : table.shape[1]] = table
    return result


class Range(NamedTuple):
    """Largest and smallest daily insolation of the year, as fractions of the solar constant.

    Longitudes of the Sun are in rad. That of the smallest value is the solstice if there is a polar
    night, which counts as one extreme. Longitudes are NaN if nothing varies.
    """

    largest: FloatArray
    longitude_of_largest: FloatArray
    smallest: FloatArray
    longitude_of_smallest: FloatArray
    count: FloatArray  # type: ignore[assignment]


def yearly_range(season: Season, latitude: FloatArray) -> Range:
    """Largest and smallest daily insolation of the year; see `extremes`."""
    at = extremes(season, latitude)
    column = Season(*(element[:, np.newaxis] for element in season))
    value = daily(column, latitude[:, np.newaxis], at)
    every, up, down = np.arange(latitude.size), np.nanargmax(value, 1), np.nanargmin(value, 1)
    night, count = has_night(season, latitude), np.isfinite(at).sum(axis=1)
    varies = count > 1
    solstice = np.where(latitude < 0, np.pi / 2, 3 * np.pi / 2)
    lowest = np.where(night, solstice, at[every, down])
    return Range(
        value[every, up],
        np.where(varies, at[every, up], np.nan),
        np.where(night, 0.0, value[every, down]),
        np.where(varies, lowest, np.nan),
        np.where(varies, count - night, 0.0),
    )


def _extremes(season: Season, latitude: FloatArray, points: int) -> FloatArray:
    """`extremes`, from signs at equidistant longitudes."""
    row, low, high = _brackets(season, latitude, points)

    def slope(longitude: FloatArray, which: Array) -> FloatArray:
        orbit = Season(*(element[row[which]] for element in season))
        return value_and_slope(orbit, latitude[row[which]], longitude)[1]

    at = bracketed_roots(slope, low, high)
    night = np.flatnonzero(has_night(season, latitude))
    begin, end = night_begins(season, latitude), night_ends(season, latitude)
    inside = (at - begin[row]) % _TURN <= end[row] - begin[row]
    keep = ~(inside & has_night(season, latitude)[row])
    row = np.concatenate([row[keep], night, night])
    at = np.concatenate([at[keep], begin[night], end[night]])
    still = np.flatnonzero(np.bincount(row, minlength=latitude.size) == 0)
    row, at = np.append(row, still), np.append(at, 0.0 * still) % _TURN
    order = np.lexsort((at, row))
    row, at = row[order], at[order]
    count = np.bincount(row, minlength=latitude.size)
    table = np.full((latitude.size, count.max(initial=1)), np.nan)
    table[row, np.arange(row.size) - np.repeat(np.cumsum(count) - count, count)] = at
    return table


def _brackets(
    season: Season, latitude: FloatArray, points: int
) -> tuple[Array, FloatArray, FloatArray]:
    """Row, lower and upper longitude of each change of sign of the derivative."""
    grid = np.arange(points + 1) * _TURN / points + 0.0123  # away from equinoxes and solstices
    values = np.array([value_and_slope(season, latitude, at)[1] for at in grid])
    step, row = np.nonzero(values[:-1] * values[1:] < 0)
    found = [(row, grid[step], grid[step + 1])]
    # where the derivative approaches zero and turns away, two roots may lie within a step
    before, here, after = (np.abs(values[n : points - 1 + n]) for n in range(3))
    same = (values[:-2] * values[1:-1] > 0) & (values[1:-1] * values[2:] > 0)
    turns = same & (here <= np.minimum(before, after)) & (here < 2 * (before + after - 2 * here))
    step, row = np.nonzero(turns)
    if row.size:
        fine = grid[step] + np.linspace(0, 2 * _TURN / points, PARTS + 1)[:, np.newaxis]
        orbit = Season(*(element[row] for element in season))
        values = value_and_slope(orbit, latitude[row], fine)[1]
        part, pair = np.nonzero(values[:-1] * values[1:] < 0)
        found.append((row[pair], fine[part, pair], fine[part + 1, pair]))
    rows, low, high = (np.concatenate(column) for column in zip(*found, strict=True))
    return rows, low, high
