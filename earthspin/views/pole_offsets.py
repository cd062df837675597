"""Figures of observed celestial pole offsets and of their free core nutation."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.views import drawing
from earthspin.views.drawing import Axes, Figure, PageFigure, axes, note
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.table import date

#: Largest offset that is drawn, mas: the noise of the first years is larger.
DRAWN = 1.5


def plot_offsets(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the observed celestial pole offsets dX and dY over time, with 95 % error bands.

    Parameters
    ----------
    result : Dataset or DataTree
        `dX`, `dY` over `time`.
    figure : Figure, optional
    """
    answer = answer_of(result)
    figure, panels = drawing.stacked(2, 4.8, figure, width=7.5, sharey=True)
    for ax, name, colour in zip(panels, ("dX", "dY"), (drawing.BLUE, drawing.RED), strict=True):
        value, error = answer[name].values, answer[f"{name}_error"].values
        ax.fill_between(answer.time.values, value - error, value + error, color="0.85", lw=0)
        ax.plot(answer.time.values, value, color=colour, lw=0.5)
        ax.set(ylabel=f"{name} (mas)", ylim=(-DRAWN, DRAWN))
    return figure


def plot_core_nutation(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the amplitude of the free core nutation over time, with 95 % band and detection limit.

    The line is faint where nothing is detected.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``pole-offsets``, which is run again without its section
        ``core_nutation``.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.6)
    fit = needed(result, "core_nutation")
    time, size = fit.middle.values, fit.core_nutation_amplitude.values
    detected = fit.detected.values.astype(bool)
    error = fit.core_nutation_amplitude_error.values
    drawing.band(
        ax, time, size, error, drawing.BLUE, alpha=0.2, lowest=0.0, lw=0.8, ls=":", zorder=2
    )
    label = "amplitude, detected"
    for run in np.split(np.arange(time.size), np.flatnonzero(np.diff(detected)) + 1):
        if detected[run[0]]:
            ax.plot(time[run], size[run], color=drawing.BLUE, lw=1.8, label=label)
            label = "_repeated"
    ax.plot(time, fit.detection_limit, color=drawing.GREY, lw=1, ls="--", label="detection limit")
    if not detected[-1]:
        last = time[detected][-1] if detected.any() else time[0]
        ax.axvspan(last, time[-1], color="0.93", lw=0, zorder=0)
        where = {"xycoords": ("data", "axes fraction"), "ha": "right", "va": "top"}
        words = f"not detected\nafter {date(last)}"
        note(ax, words, (time[-1], 0.96), (-2, 0), color=drawing.GREY, **where)
    highest = 1.1 * float(np.max(size + np.minimum(error, size)))
    ax.set(ylim=(0, highest), ylabel="amplitude (µas)")
    ax.legend(loc="upper left", ncols=2)
    return ax


def _caption(tree: Result) -> str:
    fit: xr.Dataset = needed(tree, "core_nutation")
    words = (
        "Amplitude of the free core nutation in sliding windows, with its 95 % band. Noise alone "
        "exceeds the dashed limit in 1 % of the windows."
    )
    if not bool(fit.detected[-1]):
        words += " In the last windows, which are shaded, it is not detected."
    return words


FIGURES = [
    PageFigure(
        "Observed offsets in time",
        "Observed celestial pole minus that of IAU 2006/2000A, with the 95 % half-widths of the "
        "table in grey.",
        plot_offsets,
    ),
    PageFigure("Free core nutation", _caption, plot_core_nutation, section="core_nutation"),
]
