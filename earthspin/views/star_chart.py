"""Chart of the northern sky around the pole of the ecliptic, with the celestial pole's path."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.sky.stars import STARS as STARS
from earthspin.sky.stars import directions
from earthspin.views.drawing import GREY, RED, Axes, axes, figure_of, note

#: Years at which a path is marked, counted astronomically: 2000 BC is the year -1999.
YEARS = (*range(-11999, 1, 2000), 1, *range(2000, 14001, 2000))
#: How far the chart reaches from its middle, degrees.
REACH = 34.0
#: Size of the text, in points; width of a letter and height of a line in parts of it.
TEXT, LETTER, LINE = 8.0, 0.6, 1.15
#: Distance of a label from its dot, and from other labels, points; what a point of the path under a
#: label counts for.
GAP, CLEAR, CROSSED = 7.0, 4.0, 60.0
#: Where a label may stand about its dot, what is liked best first.
SIDES = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1))


class Label(NamedTuple):
    """Text label for a point of the star chart (position in degrees), with its colour."""

    text: str
    at: tuple[float, float]
    colour: str


def year_words(year: int) -> str:
    """Write an astronomical year number as historians do, such as "44 BC" for -43."""
    if year > 0:
        return f"{year}" if year >= 1000 else f"AD {year}"
    return f"{1 - year} BC"


def year_labels(years: Iterable[int], places: FloatArray) -> list[Label]:
    """Labels with the year for points on the path of the celestial pole."""
    pairs = zip(years, places.tolist(), strict=True)
    return [Label(year_words(year), (x, y), RED) for year, (x, y) in pairs]


def star_vectors() -> FloatArray:
    """Unit vectors in the ICRF, at J2000.0, of the stars on the chart, shape (n, 3)."""
    return directions(np.zeros(1))[:, 0]


def project(vectors: FloatArray, obliquity: float) -> FloatArray:
    """Positions of unit vectors on the star chart, degrees, by azimuthal equidistant projection.

    The sky is seen from inside, with the pole of J2000.0 on top.

    Parameters
    ----------
    vectors : ndarray, shape (n, 3)
        Unit vectors, ICRF.
    obliquity : float
        rad, of the equator of J2000.0 to the ecliptic of which the pole is the middle.
    """
    x, y, z = vectors.T
    c, s = np.cos(obliquity), np.sin(obliquity)
    y, z = c * y + s * z, c * z - s * y
    away, longitude = np.degrees(np.arctan2(np.hypot(x, y), z)), np.arctan2(y, x)
    # the pole of J2000.0 has longitude 90 degrees; longitude grows clockwise, seen from inside
    turned = longitude - np.pi / 2
    return np.stack([away * np.sin(turned), away * np.cos(turned)], axis=-1)


def plot_path(
    path: FloatArray, dates: list[Label], obliquity: float, ax: Axes | None = None
) -> Axes:
    """Draw a path of the celestial pole on the star chart, with labels placed to overlap little.

    Parameters
    ----------
    path : ndarray, shape (n, 2)
        Places on the chart.
    dates : list of Label
        Points of it to be marked.
    obliquity : float
        rad, as of `project`.
    ax : Axes, optional
    """
    ax = axes(ax, 6.4, 6.4)
    ax.grid(visible=False)
    ax.set(aspect="equal", xlim=(-REACH, REACH), ylim=(-REACH, REACH))
    ax.set_xlabel("from the pole of the ecliptic towards longitude 180° (deg)")
    ax.set_ylabel("from the pole of the ecliptic towards longitude 90° (deg)")
    ax.plot(*path.T, color=RED, lw=1.4)
    ax.plot(0, 0, marker="+", color="0.3", ms=9)
    stars = project(star_vectors(), obliquity)
    names = [Label("pole of the ecliptic", (0.0, 0.0), "0.3")]
    for star, (x, y) in zip(STARS, stars.tolist(), strict=True):
        ax.plot(x, y, "o", color="0.1", ms=max(1.5, 5.5 - 1.1 * star.magnitude))
        names.append(Label(star.name, (x, y), GREY))
    for _, (x, y), colour in dates:
        ax.plot(x, y, "o", color=colour, ms=4)
    layout = figure_of(ax).get_layout_engine()
    if layout is not None:
        layout.execute(figure_of(ax))
    ax.apply_aspect()  # labels are placed in the final layout
    _place_labels(ax, [*dates, *names], path)
    return ax


def _place_labels(ax: Axes, labels: list[Label], path: FloatArray) -> None:
    """Place labels on the chart one after another, each at the side with the least overlap."""
    window = ax.get_window_extent()
    points = min(window.width, window.height) * 72 / ax.figure.dpi / (2 * REACH)
    line, dots = _resampled(path * points), np.array([label.at for label in labels]) * points
    boxes = [(dot - 2, dot + 2) for dot in dots]
    for label, dot in zip(labels, dots, strict=True):
        half = np.array([LETTER * len(label.text), LINE]) * TEXT / 2
        shifts = [np.array(side) * (half + GAP / np.hypot(*side)) for side in SIDES]
        costs = [_cost(dot + shift, half, boxes, line, points * REACH) for shift in shifts]
        shift = shifts[int(np.argmin(costs))]
        boxes.append((dot + shift - half, dot + shift + half))
        how = {"ha": "center", "va": "center", "fontsize": TEXT, "in_layout": False}
        note(ax, label.text, label.at, tuple(shift.tolist()), color=label.colour, **how)


def _resampled(path: FloatArray) -> FloatArray:
    """Resample a path (in typographic points) at equal steps of two points.

    The path's overlap with a label can then be counted.
    """
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    even = np.arange(0.0, along[-1], 2.0)
    return np.stack([np.interp(even, along, axis) for axis in path.T], axis=-1)


def _cost(
    middle: FloatArray,
    half: FloatArray,
    boxes: list[tuple[FloatArray, FloatArray]],
    line: FloatArray,
    edge: float,
) -> float:
    """Penalty for a label that overlaps other labels, the edge of the chart or the path."""
    low, high = np.array(boxes).transpose(1, 0, 2)
    wide = half + CLEAR
    shared = np.clip(np.minimum(middle + wide, high) - np.maximum(middle - wide, low), 0, None)
    beyond = np.clip(np.abs(middle) + half - edge, 0, None)
    crossed = np.all(np.abs(line - middle) < half + 1, axis=1)
    area = shared.prod(axis=1).sum() + 10 * (beyond @ (2 * half[::-1]))
    return float(area + CROSSED * np.count_nonzero(crossed))
