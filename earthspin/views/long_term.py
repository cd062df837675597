"""Obliquity, precession and eccentricity over millennia, and how well they are known."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import EPSILON_0
from earthspin.errors import UndefinedError
from earthspin.views.drawing import (
    BLUE,
    CYCLE,
    GREEN,
    GREY,
    NARROW,
    RED,
    Drawing,
    axes,
    drawn,
    empty,
    for_phone,
    legend_above,
    style,
)  # fmt: skip
from earthspin.views.reading import Result, answer_of, needed, section
from earthspin.views.stars import YEARS, Label, on_the_chart, plot_path, year_words
from earthspin.views.table import Table, with_error

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

#: Sections that the figures need.
DRAWN = ("budget",)
#: Rows of the table, about.
ROWS = 11
TIME = "time from J2000.0 (1000 years)"


def tables(tree: Result) -> list[Table]:
    """Obliquity, eccentricity, climatic precession and period at a dozen epochs."""
    answer = in_order(answer_of(tree))
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
    """The pole among the stars, what a palaeoclimatologist draws, periods, and the errors."""
    years = in_order(answer_of(tree)).epoch.values
    span = f"{years[0] / 1000:g} to {years[-1] / 1000:g} kyr from J2000.0"
    found = []
    if path_is_there(years):
        caption = (
            "Path of the celestial pole among the stars, seen from inside, within 13,000 years of "
            "the present. It does not close: the plane of the orbit moves, too. The cross is the "
            "pole of the ecliptic of J2000.0; stars stand where they stood then."
        )
        phone = plot_pole(tree, ax=for_phone(NARROW))
        found.append(
            drawn("The pole among the stars", caption, plot_pole(tree), square=True, phone=phone)
        )
    found += [
        drawn(
            "Obliquity, eccentricity and climatic precession",
            f"From {span}. Climatic precession is the eccentricity times the sine of the longitude "
            "of perihelion from the moving equinox: where it is positive, northern summer falls in "
            "the half of the orbit that is far from the Sun; where it is negative, in the near "
            "half. Bands are 95 % half-widths.",
            plot_climate(tree),
        ),
        drawn(
            "Period of precession",
            "Time of one full turn at the rate of each epoch, and by each alone of those that "
            "pull. Bands are 95 % half-widths.",
            plot_periods(tree),
        ),
    ]
    if section(tree, "budget") is not None:
        caption = (
            "What each cause adds to the 95 % half-width of the longitude of perihelion: the "
            "largest up to that distance from J2000.0, past or future. Far out, what is not "
            "known of tides and figure counts for more than any method."
        )
        found.append(drawn("How well the perihelion is known", caption, plot_budget(tree)))
    return found


def in_order(of: xr.Dataset) -> xr.Dataset:
    """The same by ascending epoch, each once: `times` may be given in any order."""
    return of.isel(epoch=np.unique(of.epoch.values, return_index=True)[1])


def plot_climate(result: Result, *, ax: Axes | None = None) -> Axes:
    """Obliquity, eccentricity and climatic precession, one above the other, with error bands.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``.
    ax : Axes, optional
        For the obliquity alone.
    """
    of = in_order(answer_of(result))
    panels = (
        ("obliquity", "obliquity (deg)", BLUE),
        ("eccentricity", "eccentricity (ratio)", RED),
        ("climatic_precession", "climatic precession (ratio)", GREEN),
    )
    rows = _rows(ax, len(panels), 5.6)
    for row, (name, label, colour) in zip(rows, panels, strict=False):
        _with_band(row, of.epoch.values, of[name].values, of[f"{name}_error"].values, colour)
        row.set_ylabel(label)
    rows[-1].set_xlabel(TIME)
    return rows[0]


def plot_periods(result: Result, *, ax: Axes | None = None) -> Axes:
    """Period of precession, of all together and by perturber, one above the other.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``.
    ax : Axes, optional
        For that of all together alone.
    """
    of = in_order(answer_of(result))
    labels = [str(label) for label in of.perturber.values[::-1]]
    rows = _rows(ax, len(labels), 1.2 + 1.4 * len(labels))
    for row, label, colour in zip(rows, labels, CYCLE, strict=False):
        by = of.sel(perturber=label)
        error = by.precession_period_error.values / 1000
        _with_band(row, of.epoch.values, by.precession_period.values / 1000, error, colour)
        row.set_ylabel(f"{label} (1000 years)")
    rows[-1].set_xlabel(TIME)
    return rows[0]


def _rows(ax: Axes | None, count: int, height: float) -> list[Axes]:
    """Axes one above the other with one axis of time, or those that are given."""
    if ax is not None:
        return [ax]
    figure = empty(8.0, height)
    rows = list(figure.subplots(count, sharex=True))
    figure.align_ylabels(rows)
    return rows


def _with_band(
    ax: Axes, years: FloatArray, value: FloatArray, error: FloatArray, colour: str
) -> None:
    """A curve over time with its 95 % half-width."""
    kyr = years / 1000
    marker = "o" if kyr.size == 1 else None
    ax.fill_between(kyr, value - error, value + error, color=colour, alpha=0.3, lw=0)
    ax.plot(kyr, value, color=colour, lw=1.0, marker=marker)
    if kyr.size > 1:
        ax.set_xlim(kyr[0], kyr[-1])


#: How far the path of the pole is drawn, yr: half a turn either way. Epochs further apart than
#: `WIDEST` are not joined: a cubic through them would leave the path by more than the line is wide.
PATH, WIDEST = 13_000.0, 2_500.0
#: Points that a cubic needs, and distance between two points of the line that is drawn, yr.
FEWEST, FINE = 4, 50.0


def path_is_there(years: FloatArray) -> bool:
    """Whether ascending epochs lie close enough together near the present to draw the path."""
    near = years[np.abs(years) <= PATH]
    return near.size >= FEWEST and bool(np.max(np.diff(near)) <= WIDEST)


def plot_pole(result: Result, *, ax: Axes | None = None) -> Axes:
    """Path of the pole among the stars, within half a turn of the present.

    The sky from inside, centred on the pole of the ecliptic of J2000.0, the present pole on top.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``; of its span what lies within 13,000 years is drawn. Epochs
        of every thousand years are joined by a cubic.
    ax : Axes, optional
    """
    from scipy.interpolate import CubicSpline

    of = in_order(answer_of(result))
    years = of.epoch.values
    if not path_is_there(years):
        raise UndefinedError(
            "no path to draw: give epochs within 13,000 years of J2000.0, at most 2,500 years apart"
        )
    near = np.abs(years) <= PATH
    joined = CubicSpline(years[near], of.pole.values[near])
    obliquity = np.radians(EPSILON_0.value / 3600)

    def on(times: FloatArray) -> FloatArray:
        poles = joined(times)
        return on_the_chart(poles / np.linalg.norm(poles, axis=1, keepdims=True), obliquity)

    first, last = years[near][[0, -1]]
    marked = [year for year in YEARS if first <= year - 2000 <= last]
    at = on(np.array(marked, dtype=float) - 2000).tolist()
    dates = [Label(year_words(year), (x, y), RED) for year, (x, y) in zip(marked, at, strict=True)]
    count = int((last - first) / FINE) + 2
    return plot_path(on(np.linspace(first, last, count)), dates, obliquity, ax)


#: Share below which nothing is drawn, as a part of the largest.
LEAST = 1e-6


def plot_budget(result: Result, *, ax: Axes | None = None) -> Axes:
    """Error of the longitude of perihelion by cause, against the distance from J2000.0.

    Drawn is the largest up to that distance, past or future: a share that passes through zero is
    not known better there.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``long-term``; the section ``budget`` is run if it is not there.
    ax : Axes, optional
    """
    shares: xr.Dataset = needed(result, "budget")
    ax = axes(ax, 8.0, 3.6)
    away = np.abs(shares.epoch.values) / 1000
    order = np.argsort(away, kind="stable")[np.count_nonzero(away == 0) :]
    away = away[order]
    found = {
        str(cause): np.maximum.accumulate(shares.longitude_share.sel(cause=cause).values[order])
        for cause in shares.cause.values
    }
    together = np.sqrt(sum(share**2 for share in found.values()))
    ax.plot(away, together, color="black", lw=2.0, label="together")
    for (cause, share), colour in zip(found.items(), (*CYCLE, GREY), strict=False):
        ax.plot(away, share, color=colour, lw=1.2, label=cause)
    ax.set_xscale("log")
    ax.set_yscale("log")
    if away.size > 1:
        ax.set_xlim(away[0], away[-1])
        ax.set_ylim(LEAST * together[-1], 2 * together[-1])
    ax.set_xlabel("distance from J2000.0 (1000 years)")
    ax.set_ylabel("share of the half-width (deg)")
    legend_above(ax)
    return ax
