"""Love numbers beside published ones, and how they soften and lag with the period."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from earthspin.views.drawing import CYCLE, GREY, Drawing, empty, style
from earthspin.views.reading import Result, answer_of, needed, of_sections, section
from earthspin.views.table import Table, along, beside

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

#: Sections that the figure stands on.
DRAWN = ("by_period",)

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
    answer, known = answer_of(tree), section(tree, "published")
    there = {} if known is None else dict(along(known, "published_love"))
    rows = [
        (
            name,
            f"{float(of.love_number):.5f}",
            f"{float(of.love_number_imaginary):.5f}" if of.love_number_imaginary else "",
            *beside(of.love_number, there[name].published_love_number if name in there else None),
        )
        for name, of in along(answer, "love")
    ]
    note = f"Layers: {answer.love_number.attrs['references']}."
    if there:
        sources = dict.fromkeys(str(of.published_love_source.values) for of in there.values())
        note += (
            f" Published: {'; '.join(sources)}. The tidal ones are of a body that turns and is "
            "flattened, which this sphere is not."
        )
    heads = ("Love number", "real part", "imaginary part", "published", "difference, %")
    return Table("Love numbers of degree two", heads, rows, note)


def by_period(tree: Result) -> Table:
    """Real parts by period, and how late the body is."""
    data = needed(tree, "by_period")
    names = [name for name in map(str, data.love.values) if name != SMALL]
    rows = [
        (
            f"{float(of.love_period):.3g}",
            *(f"{float(of.love_number_by_period.sel(love=name)):.4f}" for name in names),
            f"{_lag(of.sel(love='k2')):.2f}",
        )
        for _, of in along(data.isel(love_period=slice(None, None, EVERY)), "love_period")
    ]
    heads = ("period, d", *names, "lag of k2, deg")
    return Table("Love numbers by period, real parts", heads, rows, words=())


def _lag(of: xr.Dataset) -> float:
    late = of.love_number_by_period_imaginary, of.love_number_by_period
    return -float(np.degrees(np.arctan2(*late)))


@style()
def drawings(tree: Result) -> list[Drawing]:
    """How much softer, and how late, by period."""
    if section(tree, "by_period") is None:
        return []
    caption = (
        "Love numbers of tide and load, by the period of what deforms the body: how much larger "
        "they are than those of the elastic body, at 1 s, and by which angle they lag. The small "
        "tangential one of a load is left out."
    )
    return [Drawing("Softer and later with the period", caption, plot_by_period(tree))]


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
    figure = figure or empty(7.5, 4.6)
    above, below = figure.subplots(2, 1, sharex=True)
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
    below.set_ylabel("lag (deg)")
    below.set_xlabel("period (d)")
    for ax in (above, below):
        for at in MARKS.values():
            ax.axvline(at, color=GREY, lw=0.7, ls=":")
    for words, at in MARKS.items():
        below.annotate(
            words, (at, 0), xycoords=("data", "axes fraction"), xytext=(-3, 4),
            textcoords="offset points", ha="right", fontsize=8, color=GREY,
        )  # fmt: skip
    above.legend(ncols=5, loc="upper left", fontsize=8)
    return figure
