"""Obliquity, precession and eccentricity over millennia, and how well they are known."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import EPSILON_0
from earthspin.views.drawing import (
    BLUE,
    CYCLE,
    GREEN,
    GREY,
    RED,
    Drawing,
    axes,
    drawn,
    empty,
    legend_above,
    note,
    style,
)  # fmt: skip
from earthspin.views.reading import Result, answer_of, needed, section
from earthspin.views.stars import STARS
from earthspin.views.table import Table, with_error

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

#: Sections that the figures need.
DRAWN = ("budget",)
#: Rows of the table, about.
ROWS = 11


def tables(tree: Result) -> list[Table]:
    """Obliquity, eccentricity, climatic precession and period at a dozen epochs."""
    answer = answer_of(tree)
    shown = answer.isel(epoch=np.unique(np.linspace(0, answer.epoch.size - 1, ROWS).astype(int)))
    rows = []
    for place in range(shown.epoch.size):
        at = shown.isel(epoch=place)
        rows.append(
            (
                f"{float(at.epoch) / 1000:g}",
                with_error(float(at.obliquity), float(at.obliquity_error)),
                with_error(float(at.eccentricity), float(at.eccentricity_error)),
                with_error(float(at.climatic_precession), float(at.climatic_precession_error)),
                f"{float(at.precession_period.sel(perturber='total')):.0f}",
            )
        )
    note = (
        "Epochs count from J2000.0 TDB. Climatic precession is the eccentricity times the sine of "
        "the longitude of perihelion from the moving equinox. Errors are 95 % half-widths: method, "
        "orbit, start, and what tides and figure of the past are taken to be uncertain by."
    )
    heads = ("kyr", "obliquity, deg", "eccentricity", "climatic precession", "period, yr")
    return [Table("Over millennia", heads, rows, note)]


@style()
def drawings(tree: Result) -> list[Drawing]:
    """What a palaeoclimatologist draws, the pole among the stars, periods, and the errors."""
    answer = answer_of(tree)
    first, last = float(answer.epoch[0]) / 1000, float(answer.epoch[-1]) / 1000
    span = f"{first:g} to {last:g} kyr from J2000.0"
    found = [
        drawn(
            "Obliquity, eccentricity and climatic precession",
            f"From {span}. Climatic precession is the eccentricity times the sine of the longitude "
            "of perihelion from the moving equinox: where it is large, northern summer falls far "
            "from the Sun now and near it half a cycle later. Bands are 95 % half-widths.",
            plot_climate(tree),
        ),
        drawn(
            "Period of precession",
            "Period of one full turn at the rate of each epoch, by Sun and Moon together and with "
            "what is published of other effects.",
            plot_periods(tree),
        ),
    ]
    if np.any(np.abs(answer.epoch) < PATH):
        caption = (
            "Path of the celestial pole among the stars, seen from inside, 13,000 years before and "
            "after the present: it does not close, because the ecliptic moves, too."
        )
        found.insert(0, drawn("The pole among the stars", caption, plot_pole(tree), square=True))
    if section(tree, "budget") is not None:
        caption = (
            "Shares of the 95 % half-width of the longitude of perihelion, by what they come from. "
            "Past ten thousand years the unknown Earth, its tides and its figure, counts for more "
            "than any method."
        )
        found.append(drawn("How well the perihelion is known", caption, plot_budget(tree)))
    return found


def plot_climate(result: Result, *, ax: Axes | None = None) -> Axes:
    """Obliquity, eccentricity and climatic precession, one above the other, with error bands.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``.
    ax : Axes, optional
        For the obliquity alone.
    """
    of = answer_of(result)
    kyr = of.epoch / 1000
    panels = (
        ("obliquity", "obliquity (deg)", BLUE),
        ("eccentricity", "eccentricity", RED),
        ("climatic_precession", "climatic precession", GREEN),
    )
    rows = [ax] if ax is not None else list(empty(8.0, 5.6).subplots(3, sharex=True))
    for row, (name, label, colour) in zip(rows, panels, strict=False):
        value, error = of[name], of[f"{name}_error"]
        row.fill_between(kyr, value - error, value + error, color=colour, alpha=0.3, lw=0)
        row.plot(kyr, value, color=colour, lw=1.0)
        row.set_ylabel(label)
    rows[-1].set_xlabel("time from J2000.0 (kyr)")
    rows[0].set_xlim(float(kyr.min()), float(kyr.max()))
    return rows[0]


def plot_periods(result: Result, *, ax: Axes | None = None) -> Axes:
    """Period of precession by perturber, against time.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``.
    ax : Axes, optional
    """
    of = answer_of(result)
    ax = axes(ax, 8.0, 3.2)
    for label, colour in zip(of.perturber.values, CYCLE, strict=False):
        period = of.precession_period.sel(perturber=label)
        ax.plot(of.epoch / 1000, period / 1000, color=colour, lw=1.0, label=str(label))
    ax.set_yscale("log")
    ax.yaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_minor_formatter("{x:g}")
    ax.tick_params(axis="y", which="minor", labelsize=8)
    ax.set_xlabel("time from J2000.0 (kyr)")
    ax.set_ylabel("period (kyr)")
    legend_above(ax)
    return ax


#: How far the path of the pole is drawn, yr: half a turn either way.
PATH = 13_000.0


def plot_pole(result: Result, *, ax: Axes | None = None) -> Axes:
    """Path of the pole among the stars, within half a turn of the present.

    The sky from inside, centred on the pole of the ecliptic of J2000.0, the present pole on top.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``; of its span what lies within 13,000 years is drawn.
    ax : Axes, optional
    """
    of = answer_of(result)
    of = of.isel(epoch=np.flatnonzero(np.abs(of.epoch.values) <= PATH))
    obliquity = np.radians(EPSILON_0.value / 3600)
    ax = axes(ax, 6.4, 6.4)
    ax.grid(visible=False)
    x, y = _on_chart(of.pole.values, obliquity)
    ax.plot(x, y, color=RED, lw=1.4)
    ax.plot(0, 0, marker="+", color="0.3", ms=9)
    note(ax, "pole of the ecliptic", (0, 0), (6, 6))
    for name, ra, dec, magnitude in STARS:
        a, d = np.radians(ra), np.radians(dec)
        star = np.array([[np.cos(d) * np.cos(a), np.cos(d) * np.sin(a), np.sin(d)]])
        sx, sy = (float(one[0]) for one in _on_chart(star, obliquity))
        ax.plot(sx, sy, "o", color="0.1", ms=max(1.5, 5.5 - 1.1 * magnitude))
        outside = np.hypot(sx, sy) > np.degrees(obliquity)
        by, side = ((5, 3), "left") if (sx > -1) == outside else ((-5, 3), "right")
        note(ax, name, (sx, sy), by, ha=side, color=GREY)
    for place in range(of.epoch.size):
        year = round(2000 + float(of.epoch[place]))
        if year % 2000 == 0:
            ax.plot(x[place], y[place], "o", color=RED, ms=4)
            away = np.hypot(x[place], y[place])
            by = -16 * x[place] / away, -11 * y[place] / away
            label = f"{year}" if year > 0 else f"{1 - year} BC"
            note(ax, label, (x[place], y[place]), by, ha="center", va="center", color=RED)
    ax.set_aspect("equal")
    ax.set_xlim(-34, 34)
    ax.set_ylim(-34, 34)
    ax.set_xlabel("distance from the pole of the ecliptic (deg)")
    ax.set_ylabel("distance (deg)")
    return ax


def _on_chart(vectors: FloatArray, obliquity: float) -> tuple[FloatArray, FloatArray]:
    """Distance from the pole of the ecliptic of J2000.0 along two directions, degrees."""
    x, y, z = vectors.T
    c, s = np.cos(obliquity), np.sin(obliquity)
    y, z = c * y + s * z, c * z - s * y
    away, longitude = np.degrees(np.arctan2(np.hypot(x, y), z)), np.arctan2(y, x)
    # the present pole has longitude 90 degrees; longitude grows clockwise, seen from inside
    turned = longitude - np.pi / 2
    return away * np.sin(turned), away * np.cos(turned)


def plot_budget(result: Result, *, ax: Axes | None = None) -> Axes:
    """Error of the longitude of perihelion by cause, against the distance from J2000.0.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``; the section ``budget`` is run if it is not there.
    ax : Axes, optional
    """
    shares: xr.Dataset = needed(result, "budget")
    ax = axes(ax, 8.0, 3.6)
    apart = np.abs(shares.epoch.values) / 1000
    later = apart > 0
    for cause, colour in zip(shares.cause.values, (*CYCLE, GREY), strict=False):
        share = shares.longitude_share.sel(cause=cause).values
        ax.plot(apart[later], share[later], color=colour, lw=1.2, label=str(cause))
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("distance from J2000.0 (kyr)")
    ax.set_ylabel("share of the half-width (deg)")
    legend_above(ax)
    return ax
