"""Figures and three-dimensional picture of a heavy top."""

from __future__ import annotations

import numpy as np

from earthspin.views import solids
from earthspin.views.drawing import BLUE, RED, Axes, Figure, PageFigure, axes, empty
from earthspin.views.reading import Result, answer_of, needed


def _plot_potential_and_nutation(tree: Result) -> Figure:
    answer, figure = answer_of(tree), empty(8, 3.4)
    left, right = figure.subplots(1, 2)
    plot_effective_potential(tree, ax=left)
    right.plot(answer.time, np.degrees(answer.theta), color=BLUE, lw=1.2)
    right.set(xlabel="time (s)", ylabel="inclination (deg)")
    return figure


def plot_effective_potential(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw a top's effective potential over the inclination of its axis, and its energy level.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``top``; without the sections ``potential`` and ``turning`` it is run
        again.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    potential = needed(result, "potential").effective_potential
    ax = axes(ax, 4, 3.4)
    turning = np.degrees(needed(result, "turning").turning_angle.values)
    level = float(np.interp(turning, potential.inclination, potential).max())
    lowest = float(potential.min())
    reach = max(level - lowest, 0.05 * abs(lowest), 1e-9)
    ax.plot(potential.inclination, potential, color=BLUE, lw=1.2)
    ax.axhline(level, color="0.4", lw=0.9, ls="--")
    ax.set_ylim(lowest - 0.2 * reach, level + 2 * reach)
    ax.set(xlabel="inclination (deg)", ylabel="effective potential (rad²/s²)")
    return ax


FIGURES = [
    PageFigure(
        "Effective potential and nutation",
        "Left: the effective potential as a function of the inclination, and the energy of the top "
        "(dashed); the inclination varies where the energy lies above the potential. Right: the "
        "inclination in time.",
        _plot_potential_and_nutation,
        section="potential",
        uses=["turning"],
    )
]


def path_of_top(tree: Result) -> solids.Solid:
    """Three-dimensional picture of the path of the top's axis on a sphere.

    The path lies between two turning angles (source text, I.7.19).
    """
    answer = answer_of(tree)
    theta, phi = answer.theta.values, answer.phi.values
    tip = np.stack(
        [np.sin(theta) * np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta)], axis=-1
    )
    bounds = needed(tree, "turning").turning_angle.values
    return solids.Solid(
        title=f"{answer.attrs['title']}: {answer.pattern.item()}",
        caption="The tip of the axis (red) moves between two circles (grey), the turning angles.",
        items=[
            solids.mesh(solids.ellipsoid((1.0, 1.0, 1.0), 19, 37), BLUE, opacity=0.06),
            *(solids.line(solids.circle(float(b)), solids.GREY, width=1.2) for b in bounds),
            solids.line(tip, RED, width=2.5, grows=True),
            solids.moving_arrow(tip, solids.BLACK, "axis"),
        ],
        radius=1.15,
        times=answer.time.values,
        attitude=answer.attitude.values,
    )


SOLIDS = [("turning", path_of_top)]
