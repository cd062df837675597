"""Figures of a polar motion forecast, and of the errors of past forecasts."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from earthspin.numerics.arrays import FloatArray
from earthspin.views import drawing
from earthspin.views.drawing import Axes, Figure, PageFigure, axes, note
from earthspin.views.reading import Result, answer_of, needed, section
from earthspin.views.table import date

#: Days after the origin that the axis of the skill names, and at which the path has an ellipse.
TICKS, ELLIPSES = (1, 3, 10, 30, 90, 180, 365, 730), (30, 90, 365)
#: Half-width of an interval over the standard deviation, and the same of an ellipse of 95 %.
ONE_COORDINATE, BOTH = 1.959964, float(np.sqrt(-2 * np.log(0.05)))
#: Sets of origins whose skill is drawn, with their colours and the forecast beside ours: those that
#: no parameter was chosen on.
DRAWN = {
    "C04 2014-2025": (drawing.BLUE, "least squares with autoregression"),
    "releases": (drawing.RED, "Bulletin A"),
}


def _days(answer: xr.Dataset) -> FloatArray:
    """Times of a forecast, in days after the last observation that the forecast uses."""
    origin = np.datetime64(answer.x.attrs["origin"])
    days: FloatArray = (answer.time.values - origin) / np.timedelta64(1, "D")
    return days


def plot_coordinates(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the forecast coordinates x and y of the pole over time, with 95 % bands.

    The prediction of Bulletin A is added if the answer has it.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``forecast``.
    figure : Figure, optional
        Drawn on one of its own by default.
    """
    answer, bulletin = answer_of(result), section(result, "bulletin_a")
    figure, panels = drawing.stacked(2, 5.2, figure, width=7.5)
    for ax, name, colour in zip(panels, ("x", "y"), (drawing.BLUE, drawing.GREEN), strict=True):
        value, error = answer[name].values * 1e3, answer[f"{name}_error"].values * 1e3
        drawing.band(ax, answer.time.values, value, error, colour, label=f"{name}, 95 %")
        if bulletin is not None:
            predicted = bulletin[f"bulletin_a_{name}"] * 1e3
            words = "Bulletin A"
            ax.plot(bulletin.time, predicted, color=drawing.RED, lw=1, ls="--", label=words)
        ax.set_ylabel(f"{name} (mas)")
        ax.legend(loc="best")
    return figure


def plot_path(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the forecast path of the pole, with 95 % ellipses after 30, 90 and 365 days.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``forecast``.
    ax : Axes, optional
    """
    from matplotlib.patches import Ellipse

    ax = axes(ax, 6.0, 6.0)
    answer = answer_of(result)
    x, y = answer.x.values * 1e3, answer.y.values * 1e3
    ax.plot(y, x, color=drawing.BLUE, lw=1.4)
    ax.plot(y[0], x[0], "o", color=drawing.BLUE, ms=4)
    note(ax, date(answer.time[0]), (y[0], x[0]), (5, 4), color=drawing.BLUE)
    for day in ELLIPSES:
        near = np.flatnonzero(abs(_days(answer) - day) < 0.5)
        if near.size == 0:
            continue
        row = answer.isel(time=int(near[0]))
        sx, sy = (1e3 * float(row[name]) / ONE_COORDINATE for name in ("x_error", "y_error"))
        across = float(row.correlation_xy) * sx * sy
        values, vectors = np.linalg.eigh([[sy**2, across], [across, sx**2]])
        width, height = 2 * BOTH * np.sqrt(values)
        turn = np.degrees(np.arctan2(vectors[1, 0], vectors[0, 0]))
        centre = float(row.y) * 1e3, float(row.x) * 1e3
        ax.add_patch(Ellipse(centre, width, height, angle=turn, fc="none", ec=drawing.RED, lw=1))
        ax.plot(*centre, "o", color=drawing.RED, ms=4)
        clear = {"fc": "white", "ec": "none", "alpha": 0.7, "pad": 0.5}
        note(ax, f"{day} d", centre, (6, 5), color=drawing.RED, bbox=clear)
    ax.set(aspect="equal", ylabel="x, towards the prime meridian (mas)")
    ax.set_xlabel("y, towards 90° west (mas)")
    return ax


def plot_skill(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the measured error of past forecasts, and the coverage of their 95 % intervals.

    The origins were not used to choose parameters.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``forecast``.
    figure : Figure, optional
    """
    data = needed(result, "skill").mean("coordinate")
    figure, (errors, shares) = drawing.stacked(2, 5.6, figure, width=7.0, height_ratios=(2, 1))
    for name, (colour, other) in DRAWN.items():
        rows = data.sel(case=data.skill_set == name)
        days = rows.horizon.values
        how: dict[str, Any] = {"color": colour, "lw": 1.4, "marker": "o", "ms": 4}
        errors.plot(days, rows.mean_absolute_error, label=f"forecast, {name}", **how)
        beside = how | {"ls": "--", "mfc": "white"}
        errors.plot(days, rows.other_mean_absolute_error, label=f"{other}, {name}", **beside)
        shares.plot(days, 100 * rows.coverage, **how)
    shares.axhline(95, color=drawing.GREY, lw=1, ls=":")
    errors.set(xscale="log", yscale="log", ylabel="mean absolute error (mas)")
    errors.set_yticks([0.1, 1, 10], ["0.1", "1", "10"])
    errors.legend(loc="lower right")
    shares.set(xlabel="time after the origin (days)", ylabel="coverage (%)", ylim=(80, 101))
    shares.set_xticks(TICKS, [str(day) for day in TICKS])
    shares.minorticks_off()
    return figure


FIGURES = [
    PageFigure(
        "Forecast of both coordinates",
        "Forecast of x and y with 95 % intervals; dashed, the prediction of Bulletin A where the "
        "table has one from the same day.",
        plot_coordinates,
        uses=("bulletin_a",),
    ),
    PageFigure(
        "Path of the pole",
        "Forecast path of the pole over the ground; ellipses hold it in 95 % of cases.",
        plot_path,
    ),
    PageFigure(
        "Error and coverage by horizon",
        "Mean absolute error of one coordinate and share of 95 % intervals that hold the observed "
        "pole, in hindcasts with C04 and on releases of finals2000A; dashed, the other forecast "
        "from the same origins.",
        plot_skill,
        section="skill",
    ),
]
