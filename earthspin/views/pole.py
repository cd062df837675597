"""Figure of the directions of a body's axes over time."""

from __future__ import annotations

import numpy as np

from earthspin.bodies import MOON
from earthspin.constants import DAY, DAYS_PER_YEAR
from earthspin.views.drawing import Axes, PageFigure, axes
from earthspin.views.reading import Result, answer_of


def plot_pole_path(result: Result, *, axis: str = "figure", ax: Axes | None = None) -> Axes:
    """Draw the nutation of an axis: psi sin(eps) against eps, without its mean precession.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``pole``; some years of it, with psi and eps.
    axis : str
        Which of the three.
    ax : Axes, optional
    """
    from matplotlib.collections import LineCollection

    ax = axes(ax, 6.4, 6.4)
    answer = answer_of(result).sel(axis=axis)
    days = (answer.time.values - answer.time.values[0]) / np.timedelta64(1, "D")
    angles = np.stack([answer.psi * np.sin(np.radians(answer.eps / 3600)), answer.eps], axis=1)
    turn = 2 * np.pi * days * DAY / MOON.cycle
    design = np.stack([np.ones_like(days), days, np.cos(turn), np.sin(turn)], axis=1)
    line = np.linalg.lstsq(design, angles, rcond=None)[0]
    x, y = (angles - design[:, :2] @ line[:2]).T
    points = np.stack([x, y], axis=1)
    steps = list(np.stack([points[:-1], points[1:]], axis=1))
    path = LineCollection(steps, array=days[:-1] / DAYS_PER_YEAR, cmap="viridis", lw=0.7)
    ax.add_collection(path)
    ax.autoscale_view()
    words = "time from the start (years)"
    ax.figure.colorbar(path, ax=ax, location="bottom", shrink=0.8, aspect=40, label=words)
    ax.set(
        aspect="equal",
        xlabel="psi sin(eps), straight line removed (arcsec)",
        ylabel="eps, straight line removed (arcsec)",
        title=f"{axis.replace('_', ' ')} axis",
    )
    return ax


FIGURES = [
    PageFigure(
        "The path of the pole",
        "Nutation of the figure axis in space; precession, a straight line fitted to its motion, "
        "is removed.",
        plot_pole_path,
        applies=lambda tree: "psi" in answer_of(tree),
        phone=5.8,
    )
]
