"""Table and figure of the directions of a body's axes over time."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.bodies import MOON
from earthspin.constants import DAY
from earthspin.views.drawing import Axes, PageFigure, axes
from earthspin.views.reading import Result, answer_of
from earthspin.views.table import Column, Table, date, table_along


def ends(tree: Result) -> Table:
    """Table of the directions of the body's axes at the first and the last date."""
    answer = answer_of(tree)
    ends = answer.isel(time=[0, -1]).stack(place=("time", "axis"), create_index=False)

    def date_and_axis(row: xr.Dataset) -> str:
        return f"{date(row.time, 's')} {row.axis.item().replace('_', ' ')}"

    method, given = (
        f"{1e6 * float(answer[f'direction_error_{share}'].max()):.2g}"
        for share in ("method", "input")
    )
    note = (
        f"The path has {answer.time.size} epochs, of which the first and the last are shown. The "
        f"error of the method is at most {method} uas; the uncertainty of H adds up to {given} uas "
        "over this span (95 %)."
    )
    angles = ("psi:.6f", "eps:.6f") if "psi" in answer else ()
    columns = Column("", date_and_axis, "TDB, axis"), "X:+.12f", "Y:+.12f", *angles
    return table_along(ends, "place", "The axes in the GCRS", columns, note, first="")


TABLES = [("", ends)]


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
    path = LineCollection(steps, array=days[:-1] / 365.25, cmap="viridis", lw=0.7)
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
