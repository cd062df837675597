"""Figures of the free wobble period by Earth model, and of Love numbers."""

from __future__ import annotations

import numpy as np

from earthspin.views import drawing
from earthspin.views.drawing import BLUE, CYCLE, GREY, RED, Axes, Figure, Views, axes, page_figure
from earthspin.views.result_contents import Result, answer_of, section, stored_section
from earthspin.views.tables import along


@page_figure(
    "From the rigid to the deformable body",
    "Period of the free wobble from models of increasing detail, with 95 % errors from sampled "
    "inputs only; the band is the observed period.",
    uses=["observed"],
)
def plot_ladder(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the wobble period of each model in days, and the observed period as a band.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``wobble``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    answer, observed = answer_of(result), stored_section(result, "observed")
    ax = axes(ax, 7.5, 4)
    if observed is not None:
        period, error = float(observed.observed_period), float(observed.observed_period_error)
        ax.axhspan(period - error, period + error, color=RED, alpha=0.3, lw=0)
        drawing.note(ax, f"observed, {period:.1f} d", (-0.4, period), (0, 5), color=RED, fontsize=9)
    place, periods = np.arange(answer.rung.size), answer.period_solar.values
    ax.step(place, periods, where="mid", color=BLUE, lw=1, alpha=0.5)
    errors = answer.period_solar_error.values
    ax.errorbar(place, periods, errors, fmt="o", color=BLUE, ms=6, capsize=3, lw=1.2)
    for at, value, factor in zip(place, periods, answer.factor.values, strict=True):
        below = at == place[-1] or factor < 1
        words = f"{value:.1f} d" + (f"\n× {factor:.4f}" if at else "")
        by, side = ((0, -12), "top") if below else ((0, 10), "bottom")
        drawing.note(ax, words, (at, value), by, ha="center", va=side)
    ax.set_ylabel("period of the free wobble (d)")
    ax.margins(y=0.2)
    drawing.rungs(ax, answer.rung.values)
    return ax


# --- Love numbers --------------------------------------------------------------------------------


#: How a number is written in a figure.
SYMBOLS = {f"{name}2": f"${name}_2$" for name in "khl"}
SYMBOLS |= {f"{name}2_load": f"${name}'_2$" for name in "khl"}
#: Left out of the figure: small as it is, its changes would hide all others.
SMALL = "l2_load"
#: Vertical lines, by their periods in days.
MARKS = {"a day": 1.0, "14 months": 430.0, "the node": 6798.4}


@page_figure(
    "Love numbers by period",
    "Excess of the Love numbers of tide and load over those of the elastic body (at 1 s), "
    "and their phase lag, by period. The small tangential load Love number is left out.",
    section="by_period",
)
@drawing.style()
def plot_by_period(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the excess (%) of Love numbers over elastic values, and the lag (deg), against period.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``love-numbers``.
    figure : Figure, optional
        Drawn on one of its own by default.
    """
    data = section(result, "by_period")
    figure, (above, below) = drawing.stacked(2, 4.6, figure, width=7.5)
    days = data.love_period.values
    for number, (name, row) in enumerate(along(data, "love")):
        if name == SMALL:
            continue
        ratio = row.love_number_by_period + 1j * row.love_number_by_period_imaginary
        ratio = (ratio / row.elastic_love_number).values
        line, colour = "--" if name.endswith("load") else "-", CYCLE[number % 3]
        above.plot(days, 100 * (abs(ratio) - 1), line, color=colour, label=SYMBOLS[name])
        below.plot(days, -np.degrees(np.angle(ratio)), line, color=colour)
    above.set(xscale="log", ylabel="excess over the\nelastic value (%)")
    below.set(ylabel="lag (deg)", xlabel="period (d)")
    where = {"xycoords": ("data", "axes fraction"), "ha": "right", "color": GREY}
    for words, at in MARKS.items():
        for ax in (above, below):
            ax.axvline(at, color=GREY, lw=0.7, ls=":")
        drawing.note(below, words, (at, 0), (-3, 4), **where)
    above.legend(ncols=5, loc="upper left", fontsize=8)
    return figure


VIEWS = {
    "wobble": Views([plot_ladder]),
    "love-numbers": Views([plot_by_period]),
}
