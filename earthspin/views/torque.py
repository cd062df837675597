"""Figures of torques, and of the Cassini states of a spin axis."""

from __future__ import annotations

from functools import partial

import numpy as np
import xarray as xr

from earthspin.views import drawing, tables
from earthspin.views.drawing import BLUE, CYCLE, GREY, RED, Axes, Figure, Views, axes, page_figure
from earthspin.views.result_contents import Result, answer_of

COLOURS = {"sun": drawing.ORANGE, "moon": BLUE, "total": "#222222"}
#: What turns more often than this in a figure is drawn as a band.
MANY_SWINGS = 200


def _caption_of_torque(tree: Result, smooth_days: float | None = None) -> str:
    lines = (
        "Dashed lines are means. To see: the torque vanishes when a perturber crosses the "
        "equator, and is largest at its extremes."
    )
    if smooth_days:
        lines = (
            f"Bands lie between the extremes within {smooth_days:g} days, thick lines are means "
            "over the same time. To see: the band of the Moon swells and shrinks with the "
            "inclination of its orbit to the equator, and its mean with it."
        )
    return (
        f"Above: declination, referred to the {answer_of(tree).torque.attrs['frame']}. Below: the "
        "component of the torque towards the equinox; it hardly ever changes sign, so it always "
        f"turns the axis in the same direction. {lines}"
    )


@page_figure("Declination and torque", _caption_of_torque)
def _plot_both(tree: Result, smooth_days: float | None = None) -> Figure:
    """Draw the declination of the perturbers in an upper panel and their torque in a lower one."""
    figure, (upper, lower) = drawing.stacked(2, 4.6)
    plot_declination(tree, smooth_days=smooth_days, ax=upper)
    plot_torque(tree, smooth_days=smooth_days, ax=lower)
    return figure


def torque_figure(tree: Result, title: str, smooth_days: float) -> drawing.Drawing:
    """Figure, for an HTML page, of declination and torque over time; fast oscillations as bands."""
    plot = partial(_plot_both, smooth_days=smooth_days)
    return drawing.PageFigure(title, _caption_of_torque(tree, smooth_days), plot).drawn(tree)


def plot_declination(
    result: Result, *, smooth_days: float | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the declination of each perturber over time.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``torque``.
    smooth_days : float, optional
        Fast oscillations are drawn as a band between their extremes within this time.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    answer = answer_of(result)
    ax = axes(ax)
    for number, (label, row) in enumerate(tables.along(answer, "perturber")):
        words, colour = drawing.literal(label), _colour(label, number)
        _line_or_band(ax, row.declination, words, number, colour, smooth_days)
    ax.set_ylabel("declination (deg)")
    drawing.legend_above(ax)
    return ax


def plot_torque(
    result: Result, *, smooth_days: float | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the component of the torque towards the equinox over time (the cause of precession).

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``torque``, evenly spaced.
    smooth_days : float, optional
        Width of a running mean, drawn as a second line; what swings more often than is seen is
        drawn as a band, between the extremes within this time.
    ax : Axes, optional
    """
    answer = answer_of(result)
    ax = axes(ax)
    for number, (label, row) in enumerate(tables.along(answer, "perturber")):
        torque, colour = row.torque.sel(component="x") * 1e-22, _colour(label, number)
        _line_or_band(ax, torque, "", number, colour, smooth_days)
        if smooth_days:
            mean = torque.rolling(time=_samples(answer, smooth_days), center=True).mean()
            words, over = f"{drawing.literal(label)}, mean over {smooth_days:g} d", 4 - 0.1 * number
            ax.plot(answer.time, mean, color=colour, lw=1.4, zorder=over, label=words)
        else:
            ax.axhline(float(torque.mean()), color=colour, lw=0.8, ls="--")
    ax.set_ylabel("torque towards\nthe equinox (10²² N m)")
    drawing.few_dates(ax)
    ax.set_xlabel("time (TDB)")
    if smooth_days:
        drawing.legend_above(ax)
    return ax


def _line_or_band(
    ax: Axes, series: xr.DataArray, label: str, number: int, colour: str, smooth_days: float | None
) -> None:
    """Draw a time series as a line, or as a band between its extremes if it oscillates fast."""
    swings = int((np.diff(np.sign(np.diff(series.values))) != 0).sum())
    if not smooth_days or swings < MANY_SWINGS:
        ax.plot(series.time, series, color=colour, lw=0.8, zorder=3 - 0.1 * number, label=label)
        return
    width = _samples(series, smooth_days)
    window, some = series.rolling(time=width, center=True), slice(None, None, max(1, width // 6))
    low, high = window.min()[some], window.max()[some]
    ax.fill_between(series.time[some], low, high, color=colour, alpha=0.3, lw=0, label=label)


def _samples(series: xr.Dataset | xr.DataArray, days: float) -> int:
    """Number of samples in a given number of days, for an evenly sampled time series."""
    step = float((series.time[1] - series.time[0]) / np.timedelta64(1, "D"))
    return max(1, round(days / step))


def _colour(label: str, number: int) -> str:
    return COLOURS.get(label, CYCLE[number % len(CYCLE)])


# --- Cassini states ------------------------------------------------------------------------------


@page_figure(
    "The states",
    "Spin axes, in the plane of the orbit normal (dashed) and its mean (dotted). An axis near a "
    "blue state stays near it; near a red one it does not.",
    square=True,
)
def plot_states(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the spin axes of all Cassini states, which lie in one plane with the orbit normal.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``cassini-states``.
    ax : Axes, optional
    """
    answer = answer_of(result)
    ax = axes(ax, 4.6, 4.6)
    inclination = np.radians(answer.tilt.attrs["inclination"])
    named = (0.0, "--", "normal of the orbit ", "right"), (inclination, ":", " its pole", "left")
    for angle, line, words, side in named:
        x, y = 1.1 * np.sin(angle), 1.1 * np.cos(angle)
        ax.plot([0, x], [0, y], line, color=GREY, lw=1.2)
        ax.annotate(words, (x, y), ha=side, color=GREY)
    turn = np.linspace(0, 2 * np.pi, 200)
    ax.plot(np.sin(turn), np.cos(turn), color=GREY, lw=0.5)
    for state, row in tables.along(answer, "state"):
        angle = np.radians(float(row.obliquity)) * (1 if row.towards_pole else -1)
        colour = BLUE if row.stable else RED
        x, y = np.sin(angle), np.cos(angle)
        ax.annotate("", (x, y), (0, 0), arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.6})
        label_point = 0.8 * x + 0.08 * y, 0.8 * y - 0.08 * x
        ax.annotate(state, label_point, color=colour, weight="bold", ha="center", va="center")
    ax.set(xlim=(-1.25, 1.25), ylim=(-1.15, 1.2), aspect="equal")
    ax.axis("off")
    return ax


VIEWS = {"torque": Views([_plot_both]), "cassini-states": Views([plot_states])}
