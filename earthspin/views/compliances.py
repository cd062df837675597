"""Tables and figure of compliances, coupling numbers and free modes, with published values."""

from __future__ import annotations

import numpy as np

from earthspin.views.drawing import BLUE, GREY, RED, Axes, PageFigure, axes
from earthspin.views.reading import Result, answer_of, needed, section
from earthspin.views.table import Column, Table, beside, beside_published, table_along

#: How a number is written in a figure; others as they are named.
SYMBOLS = {
    **{
        name: rf"$\{name}$"
        for name in ("kappa", "xi", "zeta", "gamma", "beta", "delta", "theta", "chi", "nu")
    },
    "e": "$e$", "e_f": "$e_f$", "e_s": "$e_s$",
    "a1": r"$\alpha_1$", "a2": r"$\alpha_2$", "a3": r"$\alpha_3$",
    "fluid": "$A_f/A$", "inner": "$A_s/A$",
}  # fmt: skip
#: Up to here, in size, the axis of the figure is a straight one.
LINEAR = 1e-10


def numbers(tree: Result) -> Table:
    """Table of a body's compliances and coupling numbers, with published values if known."""
    answer, known = answer_of(tree), section(tree, "published")
    published, sources = beside_published(known, "number", "number_value")
    note = (
        "Products of inertia over the moment of the part (whole: kappa, xi, zeta; fluid core: "
        "gamma, beta, delta; inner core: theta, chi, nu), for a wobble of size 1 of mantle, fluid "
        "core and inner core; ellipticities, coupling numbers and moments. Layers: "
        f"{answer.number_value.attrs['references']}."
    )
    if sources:
        note += f" Published: {sources}."
    return table_along(answer, "number", "Compliances", ["number_value:.6g", *published], note)


def modes(tree: Result) -> Table:
    """Table of the periods of the free modes (wobbles, nutations) of the elastic body."""
    columns = Column("free_mode", head="mode"), "compliance_mode_period:.1f"
    note = "Nutations have their periods in space, negative if retrograde; wobbles in the body."
    title = "Free modes of the elastic body"
    return table_along(needed(tree, "modes"), "free_mode", title, columns, note, first="")


TABLES = [("", numbers), ("modes", modes)]


def plot_compliances(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw each compliance as a dot and its published value as a ring, on a symmetric log axis.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``compliances``, of a body of which numbers are published.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    answer, known = answer_of(result), needed(result, "published")
    ax = axes(ax, 7.5, 5.2)
    names = [str(name) for name in known.published_number.values]
    place = np.arange(len(names))
    ours = answer.number_value.sel(number=names).values
    theirs = known.published_value.values
    ax.axvline(0, color=GREY, lw=0.8)
    ax.plot(theirs, place, "o", mfc="none", mec=RED, ms=9, label="published")
    ax.plot(ours, place, "o", color=BLUE, ms=4, label="from the layers")
    for at, value, published in zip(place, ours, theirs, strict=True):
        _, over = beside(value, published)
        ax.annotate(
            f"{over} %".replace("-", "\N{MINUS SIGN}"), (1.0, at),
            xycoords=("axes fraction", "data"), xytext=(4, 0), textcoords="offset points",
            va="center", fontsize=8, color=RED if abs(float(over)) > 1 else GREY,
        )  # fmt: skip
    ax.set_xscale("symlog", linthresh=LINEAR)
    ax.set(xticks=[-1e-4, -1e-7, 0.0, 1e-7, 1e-4, 1e-1], xlim=(-1e-3, 3.0))
    ax.set_yticks(place, [SYMBOLS.get(name, name) for name in names])
    ax.invert_yaxis()
    ax.set_xlabel("value (ratio of moments of inertia)")
    ax.legend(loc="lower left")
    return ax


FIGURES = [
    PageFigure(
        "Beside the published ones",
        "Compliances, ellipticities, coupling numbers and moments, on an axis that is logarithmic "
        "to either side of zero. Rings: as published. At the right what ours are over them.",
        plot_compliances,
        section="published",
    )
]
