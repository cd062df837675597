"""Figures of obliquity, precession and eccentricity over millennia."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from earthspin.constants import EPSILON_0
from earthspin.engine.variables import places
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.views import drawing
from earthspin.views.drawing import Axes, Views, axes, page_figure
from earthspin.views.result_contents import Result, answer_of, section
from earthspin.views.star_chart import YEARS, plot_path, project, year_labels

#: Sentence at the end of captions.
BANDS = "Bands are 95 % half-widths; where none is seen, it is thinner than the line."


def in_order(data: xr.Dataset) -> xr.Dataset:
    """Sort the epochs of a Dataset in ascending order, and remove repeated epochs."""
    return data.isel(epoch=np.unique(data.epoch.values, return_index=True)[1])


@page_figure(
    "Obliquity, eccentricity and climatic precession",
    "Climatic precession is the eccentricity times the sine of the longitude of perihelion from "
    "the moving equinox: where it is positive, northern summer falls in the half of the orbit that "
    f"is far from the Sun; where it is negative, in the near half. {BANDS}",
)
def plot_climate(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw obliquity, eccentricity and climatic precession over time, with error bands.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``long-term``.
    ax : Axes, optional
        Axes to draw only the obliquity on.
    """
    answer = in_order(answer_of(result))
    panels = (
        ("obliquity", "obliquity (deg)"),
        ("eccentricity", "eccentricity"),
        ("climatic_precession", "climatic precession"),
    )
    curves = [(label, answer[name], answer[f"{name}_error"]) for name, label in panels]
    return _plot_curves(ax, curves, 5.6)


@page_figure(
    "Period of precession",
    "Period of precession at the rate of each epoch, in total and for each perturber alone. "
    + BANDS,
)
def plot_periods(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the period of precession over time, in total and for each perturber.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``long-term``.
    ax : Axes, optional
        Axes to draw only the period of all perturbers together on.
    """
    answer = in_order(answer_of(result))
    period, error = answer.precession_period / 1000, answer.precession_period_error / 1000
    curves = [
        (f"period, {label}\n(1000 years)", period.sel(perturber=label), error.sel(perturber=label))
        for label in answer.perturber.values[::-1]
    ]
    return _plot_curves(ax, curves, 1.2 + 1.4 * len(curves))


def _plot_curves(
    ax: Axes | None, curves: list[tuple[str, xr.DataArray, xr.DataArray]], height: float
) -> Axes:
    """Draw curves with error bands, one panel for each; if axes are given, only the first curve."""
    if ax is None:
        figure, rows = drawing.stacked(len(curves), height)
        figure.align_ylabels(rows)
    else:
        rows = [ax]
    for row, (label, value, error), colour in zip(rows, curves, drawing.CYCLE, strict=False):
        kyr, marker = value.epoch.values / 1000, "o" if value.size == 1 else None
        drawing.band(row, kyr, value.values, error.values, colour, lw=1.0, marker=marker)
        if kyr.size > 1:
            row.set_xlim(kyr[0], kyr[-1])
        row.set_ylabel(label)
    if drawing.INTERVAL in rows[0].get_legend_handles_labels()[1]:
        drawing.legend_above(rows[0])
    rows[-1].set_xlabel("time from J2000.0 (1000 years)")
    return rows[0]


#: Seasons of the Earth from a true longitude of the Sun of 0, each 90 degrees later.
_SEASONS = ("March equinox", "June solstice", "September equinox", "December solstice")
#: Labels of the axes along which an insolation may be drawn, and words for one of their values.
_AXES = {
    "latitude": ("latitude (deg)", "latitude {:g}°"),
    "longitude": ("true longitude of the Sun (deg)", "Sun at {:g}°"),
    "mean_longitude": ("mean longitude of the Sun (deg)", "Sun at mean {:g}°"),
    "day": ("day of the year", "day {:g}"),
    "band": ("latitudes (deg)", "{}°"),
    "interval": ("longitudes (deg)", "Sun at {}°"),
    "season": ("season", "{}"),
    "extreme": ("extreme", "extreme {}"),
    "epoch": ("time from J2000.0 (1000 years)", "{:g} kyr"),
}


def _words(line: xr.Dataset, name: str) -> str:
    """Value of a coordinate as text: a latitude with N or S, a solar longitude as season, ..."""
    value = line[name].item()
    if name == "longitude" and value % 90 == 0 and line.attrs.get("body") == "earth":
        return _SEASONS[int(value // 90) % 4]
    if name == "latitude" and value:
        return f"{abs(value):g}° {'N' if value > 0 else 'S'}"
    return _AXES[name][1].format(value).replace("-", "−")


@page_figure(
    "Insolation",
    "Sunlight at the top of the atmosphere, averaged over a day or as given by `mean`. The true "
    f"longitude of the Sun is 90° at the June solstice. {BANDS}",
)
def plot_insolation(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw an insolation over time as lines with error bands, or as a map if lines are too many.

    The first variable of the answer is drawn, such as `caloric_summer`. For a single
    epoch, the horizontal axis is the longest of the other dimensions.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``insolation``. If it has three dimensions, a map shows the first
        label of the third one.
    ax : Axes, optional
    """
    answer, ax = in_order(answer_of(result)), axes(ax, 8.0, 3.8)
    variable = str(next(iter(answer.data_vars)))
    name = "insolation" if variable == "insolation" else answer[variable].long_name
    label = f"{name} ({answer[variable].units.replace('W m-2', 'W/m²')})"
    size = answer.sizes
    dims = [str(name) for name in sorted(size, key=lambda name: -size[name]) if size[name] > 1]
    across = "epoch" if size["epoch"] > 1 or not dims else dims[0]
    others = [name for name in dims if name != across]
    answer = answer.assign_coords(epoch=answer.epoch / 1000).sortby(dims)
    answer = answer.squeeze([name for name in size if name not in {*dims, across}])
    constant = [name for name in _AXES if name in answer.coords and name != across]

    def place(line: xr.Dataset) -> str:
        return ", ".join(_words(line, name) for name in constant)

    ax.set_xlabel(_AXES[across][0])
    if math.prod(size[name] for name in others) > len(drawing.CYCLE):
        constant.remove(others[0])
        data = answer.isel(dict.fromkeys(others[1:], 0)).transpose(others[0], across)
        x, y = data[across].values, data[others[0]].values
        image = ax.contourf(x, y, data[variable].values, levels=13)
        ax.set(ylabel=_AXES[others[0]][0], title=place(data))
        ax.figure.colorbar(image, ax=ax, label=label)
        return ax
    for colour, at in zip(drawing.CYCLE, places(answer, others), strict=False):
        line = answer.isel(at)
        x, value, error = (line[name].values for name in (across, variable, f"{variable}_error"))
        marker = "o" if x.size == 1 else None
        drawing.band(ax, x, value, error, colour, lw=1.0, marker=marker, label=place(line))
    ax.margins(x=0)
    ax.set_ylabel(label)
    if others:
        drawing.legend_above(ax)
    else:
        ax.set_title(place(answer))
    return ax


#: How far the path of the pole is drawn, yr: half a turn either way. Epochs further apart than
#: `WIDEST` are not joined: a cubic through them would leave the path by more than the line is wide.
PATH, WIDEST = 13_000.0, 2_500.0
#: Points that a cubic needs, and distance between two points of the line that is drawn, yr.
FEWEST, FINE = 4, 50.0


def path_is_there(years: FloatArray) -> bool:
    """Return True if epochs near the present are dense enough to draw the path of the pole."""
    near = years[np.abs(years) <= PATH]
    return near.size >= FEWEST and bool(np.max(np.diff(near)) <= WIDEST)


@page_figure(
    "The pole among the stars",
    "Path of the celestial pole among the stars, seen from inside, within 13,000 years of "
    "the present. It does not close: the plane of the orbit moves, too. The cross is the "
    "pole of the ecliptic of J2000.0; the stars are at their positions of J2000.0.",
    applies=lambda tree: path_is_there(in_order(answer_of(tree)).epoch.values),
    square=True,
    phone=drawing.NARROW,
)
def plot_pole(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the path of the pole among the stars, up to half a turn before and after the present.

    The sky from inside, centred on the pole of the ecliptic of J2000.0, the present pole on top.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``long-term``; only the part within 13,000 years of J2000.0 is drawn.
        Epochs of every thousand years are joined by a cubic.
    ax : Axes, optional
    """
    from scipy.interpolate import CubicSpline

    answer = in_order(answer_of(result))
    years = answer.epoch.values
    if not path_is_there(years):
        raise UndefinedError(
            "no path to draw: give epochs within 13,000 years of J2000.0, at most 2,500 years apart"
        )
    near = np.abs(years) <= PATH
    joined = CubicSpline(years[near], answer.pole.values[near])
    obliquity = np.radians(EPSILON_0.value / 3600)

    def on(times: FloatArray) -> FloatArray:
        poles = joined(times)
        return project(poles / np.linalg.norm(poles, axis=1, keepdims=True), obliquity)

    first, last = years[near][[0, -1]]
    marked = [year for year in YEARS if first <= year - 2000 <= last]
    dates = year_labels(marked, on(np.array(marked, dtype=float) - 2000))
    count = int((last - first) / FINE) + 2
    return plot_path(on(np.linspace(first, last, count)), dates, obliquity, ax)


#: Share below which nothing is drawn, as a part of the largest.
LEAST = 1e-6


@page_figure(
    "How well the perihelion is known",
    "Contribution of each cause to the 95 % half-width of the longitude of perihelion: the "
    "largest up to that distance from J2000.0, past or future. Far from the present, the "
    "uncertainty of tides and figure exceeds that of the method.",
    section="budget",
)
def plot_budget(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the error of the longitude of perihelion over time from J2000.0, for each cause.

    Drawn is the largest up to that distance, past or future: a share that passes through zero is
    not known better there.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``long-term``; the section ``budget`` is computed if it is missing.
    ax : Axes, optional
    """
    shares: xr.Dataset = section(result, "budget")
    ax = axes(ax, 8.0, 3.6)
    kyr = np.abs(shares.epoch.values) / 1000
    order = np.argsort(kyr, kind="stable")[np.count_nonzero(kyr == 0) :]
    kyr, share = kyr[order], shares.longitude_share.isel(epoch=order).transpose("epoch", "cause")
    share = share.copy(data=np.maximum.accumulate(share.values))
    together = np.sqrt(np.sum(share.values**2, axis=1))
    ax.plot(kyr, together, color="0.75", lw=4.0, label="together")
    ax.set_prop_cycle(linestyle=("-", "--", "-.", ":"))  # some lines lie upon others
    drawing.lines(ax, kyr, share, lw=1.2)
    ax.set(xscale="log", yscale="log")
    if kyr.size > 1:
        ax.set_xlim(kyr[0], kyr[-1])
        ax.set_ylim(LEAST * together[-1], 2 * together[-1])
    ax.set(xlabel="distance from J2000.0 (1000 years)")
    ax.set_ylabel("error of the longitude\nof perihelion (deg)")
    drawing.legend_above(ax)
    return ax


VIEWS = {
    "long-term": Views([plot_pole, plot_climate, plot_periods, plot_budget]),
    "insolation": Views([plot_insolation]),
}
