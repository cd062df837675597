"""Torque in time: extremes, declination, and the component that causes precession."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from earthspin.views.drawing import CYCLE, Drawing, axes, empty, legend_above, style
from earthspin.views.reading import Result, answer_of
from earthspin.views.table import Table, along, date

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = {"sun": "#E69F00", "moon": "#0072B2", "total": "#222222"}
#: Longer series are drawn with thin lines.
DENSE = 4000


def tables(tree: Result) -> list[Table]:
    """Extremes by perturber."""
    answer = answer_of(tree)
    first, last = date(answer.time[0], "s"), date(answer.time[-1], "s")
    table = Table(
        "Torque",
        ("pulled by", "declination, deg", "distance, m", "largest torque, N m", "error, N m"),
        [
            (
                label,
                f"{float(of.declination.min()):+.4f} to {float(of.declination.max()):+.4f}",
                f"{float(of.distance.min()):.6e} to {float(of.distance.max()):.6e}",
                f"{float(of.torque_magnitude.max()):.4e}",
                f"{float(of.torque_magnitude_error.max()):.1e}",
            )
            for label, of in along(answer, "perturber")
        ],
        f"{answer.time.size} times from {first} to {last} TDB, {answer.torque.attrs['frame']}.",
    )
    return [table]


def drawings(tree: Result) -> list[Drawing]:
    """Declination and torque in time."""
    return [through(tree, "Declination and torque")]


@style()
def through(tree: Result, title: str, smooth_days: float | None = None) -> Drawing:
    """Declination above, torque below."""
    figure = empty(8, 4.6)
    upper, lower = figure.subplots(2, 1, sharex=True)
    plot_declination(tree, ax=upper)
    plot_torque(tree, smooth_days=smooth_days, ax=lower)
    lines = (
        f"Thin lines are daily values, thick lines means over {smooth_days:g} days; the mean for "
        "the Moon varies with the inclination of its orbit to the equator."
        if smooth_days
        else "Dashed lines are means. The torque vanishes when the perturber crosses the equator."
    )
    return Drawing(
        title,
        f"Above: declination, referred to the {answer_of(tree).torque.attrs['frame']}. Below: the "
        "component of the torque towards the equinox; it hardly ever changes sign, so it always "
        f"turns the axis in the same direction. {lines}",
        figure,
    )


def plot_declination(result: Result, *, ax: Axes | None = None) -> Axes:
    """Declination of each perturber in time.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``torque``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    answer = answer_of(result)
    ax = axes(ax)
    thin = answer.time.size >= DENSE
    for number, (label, of) in enumerate(along(answer, "perturber")):
        ax.plot(
            answer.time,
            of.declination,
            color=_colour(label, number),
            lw=0.3 if thin else 0.8,
            zorder=3 - 0.1 * number,
            label=label,
        )
    ax.set_ylabel("declination (deg)")
    legend_above(ax)
    return ax


def plot_torque(
    result: Result, *, smooth_days: float | None = None, ax: Axes | None = None
) -> Axes:
    """Component of the torque towards the equinox, which causes precession, in time.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``torque``, evenly spaced.
    smooth_days : float, optional
        Width of a running mean, drawn as a second line.
    ax : Axes, optional
    """
    answer = answer_of(result)
    ax = axes(ax)
    thin = answer.time.size >= DENSE
    for number, (label, of) in enumerate(along(answer, "perturber")):
        torque, colour = of.torque.sel(component="x") * 1e-22, _colour(label, number)
        lw, alpha = (0.3, 0.5) if thin else (0.8, 1.0)
        ax.plot(answer.time, torque, color=colour, lw=lw, alpha=alpha)
        if smooth_days:
            step = float((answer.time[1] - answer.time[0]) / np.timedelta64(1, "D"))
            ax.plot(
                answer.time,
                torque.rolling(time=max(1, round(smooth_days / step)), center=True).mean(),
                color=colour,
                lw=1.4,
                zorder=4 - 0.1 * number,
                label=f"{label}, mean over {smooth_days:g} d",
            )
        else:
            ax.axhline(float(torque.mean()), color=colour, lw=0.8, ls="--")
    ax.set_ylabel("torque towards\nthe equinox (10$^{22}$ N m)")
    ax.set_xlabel("time (TDB)")
    if smooth_days:
        legend_above(ax)
    return ax


def _colour(label: str, number: int) -> str:
    return COLOURS.get(label, CYCLE[number % len(CYCLE)])
