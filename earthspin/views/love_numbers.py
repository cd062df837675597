"""Love numbers beside published ones, and how they soften and lag with the period."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from earthspin.views.drawing import CYCLE, GREY, PageFigure, note, stacked, style
from earthspin.views.reading import Result, answer_of, needed, of_sections, section
from earthspin.views.table import Column, Table, along, beside_published, table_along

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

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


def tables(tree: Result) -> list[Table]:
    """The numbers, and some of them by period."""
    return [numbers(tree), *of_sections(tree, {"by_period": by_period})]


def numbers(tree: Result) -> Table:
    """Each number, with the published one where there is one."""
    answer = answer_of(tree)
    known, published = section(tree, "published"), "published_love_number"
    beside, sources = beside_published(
        known, "love", "love_number", published, "published_love_source"
    )
    columns: list[Column | str] = [
        "love_number:.5f",
        Column("love_number_imaginary", _unless_zero),
        *beside,
    ]
    words = f"Layers: {answer.love_number.attrs['references']}."
    if sources:
        words += (
            f" Published: {sources}. The tidal ones are of a body that turns and is "
            "flattened, which this sphere is not."
        )
    title = "Love numbers of degree two"
    return table_along(answer, "love", title, columns, words, first="Love number")


def _unless_zero(row: xr.Dataset) -> str:
    value = float(row.love_number_imaginary)
    return f"{value:.5f}" if value else ""


def by_period(tree: Result) -> Table:
    """Real parts by period, and how late the body is."""
    data = needed(tree, "by_period").isel(love_period=slice(None, None, EVERY))

    def real_part(name: str) -> Column:
        return Column(
            "", lambda row: f"{float(row.love_number_by_period.sel(love=name)):.4f}", name
        )

    names = [name for name in map(str, data.love.values) if name != SMALL]
    columns = [
        Column("love_period", ".3g", "period, d"),
        *map(real_part, names),
        Column(
            "love_number_by_period", lambda row: f"{_lag(row.sel(love='k2')):.2f}", "lag of k2, deg"
        ),
    ]
    title = "Love numbers by period, real parts"
    return table_along(data, "love_period", title, columns, first="", words=())


def _lag(row: xr.Dataset) -> float:
    late = row.love_number_by_period_imaginary, row.love_number_by_period
    return -float(np.degrees(np.arctan2(*late)))


@style()
def plot_by_period(result: Result, *, figure: Figure | None = None) -> Figure:
    """Excess of the Love numbers over the elastic ones, and their lag, by period.

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
    for number, (name, of) in enumerate(along(data, "love")):
        if name == SMALL:
            continue
        ratio = of.love_number_by_period + 1j * of.love_number_by_period_imaginary
        ratio = (ratio / of.elastic_love_number).values
        line, colour = "--" if name.endswith("load") else "-", CYCLE[number % 3]
        above.plot(days, 100 * (abs(ratio) - 1), line, color=colour, label=SYMBOLS[name])
        below.plot(days, -np.degrees(np.angle(ratio)), line, color=colour)
    above.set_xscale("log")
    above.set_ylabel("over the elastic one (%)")
    below.set(ylabel="lag (deg)", xlabel="period (d)")
    for ax in (above, below):
        for at in MARKS.values():
            ax.axvline(at, color=GREY, lw=0.7, ls=":")
    for words, at in MARKS.items():
        where = {"xycoords": ("data", "axes fraction"), "ha": "right", "color": GREY}
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
