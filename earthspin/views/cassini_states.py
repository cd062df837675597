"""Cassini states: where they are, and which of them stay."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from earthspin.views.drawing import BLUE, GREY, RED, Drawing, axes, drawn, style
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.table import Table, beside_observed

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def tables(tree: Result) -> list[Table]:
    """Each state, with its obliquity."""
    answer, left_out = answer_of(tree), needed(tree, "neglected")
    rows = [
        (
            f"{int(of.state)}",
            # sizes of what is left out are those in the upright state, the first
            beside_observed(of.obliquity, of.obliquity_error, None if place else left_out),
            beside_observed(of.tilt, of.tilt_error, None if place else left_out),
            "stable" if bool(of.stable) else "unstable",
        )
        for place, of in (
            (place, answer.isel(state=place)) for place in range(answer.sizes["state"])
        )
    ]
    heads = ("state", "obliquity, deg", "tilt, deg", "beside it")
    note = (
        "Obliquity is counted from the normal of the orbit, tilt from the pole that this normal "
        f"goes round. The spin is {answer.obliquity.attrs['spin']}. Errors hold the uncertainty of "
        "the body's numbers and the sizes of what the model leaves out; where these are not known, "
        "the table says numbers only."
    )
    return [Table("Cassini states", heads, rows, note)]


@style()
def drawings(tree: Result) -> list[Drawing]:
    """The axes of the states in the plane that they share."""
    caption = (
        "Spin axes in the states, in the plane of the orbit's normal (dashed) and of the pole that "
        "it goes round (dotted)."
    )
    if not bool(answer_of(tree).stable.all()):
        caption += " An axis beside a blue one stays there; beside the red one it leaves."
    return [drawn("The states", caption, plot_states(tree), square=True)]


def plot_states(result: Result, *, ax: Axes | None = None) -> Axes:
    """Spin axes of the states in the plane that they share.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``cassini-states``.
    ax : Axes, optional
    """
    answer = answer_of(result)
    ax = axes(ax, 4.6, 4.6)
    inclination = np.radians(answer.tilt.attrs["inclination"])
    named = (0.0, "--", "normal of the orbit ", "right"), (inclination, ":", " its pole", "left")
    for angle, line, words, side in named:
        ax.plot([0, 1.1 * np.sin(angle)], [0, 1.1 * np.cos(angle)], line, color=GREY, lw=1.2)
        ax.annotate(words, (1.1 * np.sin(angle), 1.1 * np.cos(angle)), ha=side, color=GREY)
    turn = np.linspace(0, 2 * np.pi, 200)
    ax.plot(np.sin(turn), np.cos(turn), color=GREY, lw=0.5)
    for place in range(answer.sizes["state"]):
        of = answer.isel(state=place)
        angle = np.radians(float(of.obliquity)) * (1 if bool(of.towards_pole) else -1)
        colour = BLUE if bool(of.stable) else RED
        x, y = np.sin(angle), np.cos(angle)
        ax.annotate("", (x, y), (0, 0), arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.6})
        beside = 0.8 * x + 0.08 * y, 0.8 * y - 0.08 * x
        ax.annotate(
            f"{int(of.state)}", beside, color=colour, weight="bold", ha="center", va="center"
        )
    ax.set(xlim=(-1.25, 1.25), ylim=(-1.15, 1.2), aspect="equal")
    ax.axis("off")
    return ax
