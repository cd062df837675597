"""Figure of Love numbers by the period of the deformation."""

from __future__ import annotations

import numpy as np

from earthspin.views.drawing import CYCLE, GREY, Figure, PageFigure, note, stacked, style
from earthspin.views.reading import Result, needed
from earthspin.views.table import along

#: How a number is written in a figure.
SYMBOLS = {
    "k2": "$k_2$", "h2": "$h_2$", "l2": "$l_2$",
    "k2_load": "$k'_2$", "h2_load": "$h'_2$", "l2_load": "$l'_2$",
}  # fmt: skip
#: Left out of the figure: small as it is, its changes would hide all others.
SMALL = "l2_load"
#: Vertical lines, by their periods in days.
MARKS = {"a day": 1.0, "14 months": 430.0, "the node": 6798.4}


@style()
def plot_by_period(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw how much the Love numbers exceed the elastic ones, and their phase lag, by period.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``love-numbers``.
    figure : Figure, optional
        Drawn on one of its own by default.
    """
    data = needed(result, "by_period")
    figure, (above, below) = stacked(2, 4.6, figure, width=7.5)
    days = data.love_period.values
    for number, (name, row) in enumerate(along(data, "love")):
        if name == SMALL:
            continue
        ratio = row.love_number_by_period + 1j * row.love_number_by_period_imaginary
        ratio = (ratio / row.elastic_love_number).values
        line, colour = "--" if name.endswith("load") else "-", CYCLE[number % 3]
        above.plot(days, 100 * (abs(ratio) - 1), line, color=colour, label=SYMBOLS[name])
        below.plot(days, -np.degrees(np.angle(ratio)), line, color=colour)
    above.set(xscale="log", ylabel="over the elastic one (%)")
    below.set(ylabel="lag (deg)", xlabel="period (d)")
    where = {"xycoords": ("data", "axes fraction"), "ha": "right", "color": GREY}
    for words, at in MARKS.items():
        for ax in (above, below):
            ax.axvline(at, color=GREY, lw=0.7, ls=":")
        note(below, words, (at, 0), (-3, 4), **where)
    above.legend(ncols=5, loc="upper left", fontsize=8)
    return figure


FIGURES = [
    PageFigure(
        "Softer and later with the period",
        "Love numbers of tide and load, by the period of what deforms the body: how much larger "
        "they are than those of the elastic body, at 1 s, and by which angle they lag. The small "
        "tangential one of a load is left out.",
        plot_by_period,
        section="by_period",
    )
]
