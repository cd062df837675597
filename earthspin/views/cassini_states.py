"""Figure of Cassini states and their stability."""

from __future__ import annotations

import numpy as np

from earthspin.views.drawing import BLUE, GREY, RED, Axes, PageFigure, axes
from earthspin.views.reading import Result, answer_of
from earthspin.views.table import along


def _caption(tree: Result) -> str:
    words = (
        "Spin axes in the states, in the plane of the orbit's normal (dashed) and of the pole that "
        "it goes round (dotted)."
    )
    if not bool(answer_of(tree).stable.all()):
        words += " An axis beside a blue one stays there; beside the red one it leaves."
    return words


def plot_states(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the spin axes of the Cassini states in the plane in which all of them lie.

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
        x, y = 1.1 * np.sin(angle), 1.1 * np.cos(angle)
        ax.plot([0, x], [0, y], line, color=GREY, lw=1.2)
        ax.annotate(words, (x, y), ha=side, color=GREY)
    turn = np.linspace(0, 2 * np.pi, 200)
    ax.plot(np.sin(turn), np.cos(turn), color=GREY, lw=0.5)
    for state, row in along(answer, "state"):
        angle = np.radians(float(row.obliquity)) * (1 if row.towards_pole else -1)
        colour = BLUE if row.stable else RED
        x, y = np.sin(angle), np.cos(angle)
        ax.annotate("", (x, y), (0, 0), arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.6})
        beside = 0.8 * x + 0.08 * y, 0.8 * y - 0.08 * x
        ax.annotate(state, beside, color=colour, weight="bold", ha="center", va="center")
    ax.set(xlim=(-1.25, 1.25), ylim=(-1.15, 1.2), aspect="equal")
    ax.axis("off")
    return ax


FIGURES = [PageFigure("The states", _caption, plot_states, square=True)]
