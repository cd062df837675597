"""Tables and figure of Love numbers, compliances and free modes of a layered body."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.views.drawing import CYCLE, GREY, Figure, PageFigure, note, stacked, style
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.table import Column, Table, along, table_along

#: How a number is written in a figure.
SYMBOLS = {
    "k2": "$k_2$", "h2": "$h_2$", "l2": "$l_2$",
    "k2_load": "$k'_2$", "h2_load": "$h'_2$", "l2_load": "$l'_2$",
}  # fmt: skip
#: Left out of the figure: small as it is, its changes would hide all others.
SMALL = "l2_load"
#: Of the periods, as many to a row of the table.
EVERY = 4
#: Vertical lines, by their periods in days.
MARKS = {"a day": 1.0, "14 months": 430.0, "the node": 6798.4}


def numbers(tree: Result) -> Table:
    """Table of the Love numbers."""
    answer = answer_of(tree)

    def unless_zero(row: xr.Dataset) -> str:
        return f"{float(row.love_number_imaginary):.5f}" if row.love_number_imaginary else ""

    imaginary = Column("love_number_imaginary", unless_zero)
    words = f"Layers: {answer.love_number.attrs['references']}."
    title, columns = "Love numbers of degree two", ("love_number:.5f", imaginary)
    return table_along(answer, "love", title, columns, words, first="Love number")


def by_period(tree: Result) -> Table:
    """Table of the Love numbers for different tidal periods: real part and phase lag."""
    data = needed(tree, "by_period").isel(love_period=slice(None, None, EVERY))

    def real_part(name: str) -> Column:
        return Column(
            "", lambda row: f"{float(row.love_number_by_period.sel(love=name)):.4f}", name
        )

    def lag(row: xr.Dataset) -> str:
        k2 = row.sel(love="k2")
        late = np.arctan2(k2.love_number_by_period_imaginary, k2.love_number_by_period)
        return f"{-float(np.degrees(late)):.2f}"

    columns = (
        Column("love_period", ".3g", "period, d"),
        *(real_part(name) for name in map(str, data.love.values) if name != SMALL),
        Column("", lag, "lag of k2, deg"),
    )
    title = "Love numbers by period, real parts"
    return table_along(data, "love_period", title, columns, first="", words=())


def compliances(tree: Result) -> Table:
    """Table of a body's compliances and coupling numbers."""
    data = needed(tree, "compliances")
    note = f"{data.number_value.attrs['comment'].capitalize()}."
    return table_along(data, "number", "Compliances", ["number_value:.6g"], note)


def modes(tree: Result) -> Table:
    """Table of the periods of the free modes (wobbles, nutations) of the elastic body."""
    columns = Column("free_mode", head="mode"), "compliance_mode_period:.1f"
    note = "Nutations have their periods in space, negative if retrograde; wobbles in the body."
    title = "Free modes of the elastic body"
    return table_along(needed(tree, "modes"), "free_mode", title, columns, note, first="")


TABLES = [("", numbers), ("by_period", by_period), ("compliances", compliances), ("modes", modes)]


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
