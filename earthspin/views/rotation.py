"""Figures and animated picture of the attitude of a rigid body."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.constants import DAY
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.quaternion import rotate
from earthspin.views import drawing, solids
from earthspin.views.drawing import BLUE, CYCLE, GREEN, RED, Axes, PageFigure, axes
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.solids import BLACK, Solid

#: An attitude is lost where its error is a quarter of a turn, deg.
LOST = 90.0
#: Poses that a picture which plays shows at most.
POSES = 481


# --- figures -------------------------------------------------------------------------------------


def _lyapunov_time(neighbour: xr.Dataset) -> str:
    time, error = float(neighbour.lyapunov_time), float(neighbour.lyapunov_time_error)
    return f"{time:.3g} ± {error:.2g}"


def _days(answer: xr.Dataset) -> FloatArray:
    time = answer.time.values
    return np.asarray((time - time[0]) / np.timedelta64(1, "D"))


def _label(ax: Axes, words: str) -> Axes:
    ax.set(xlabel="time from the start (d)", ylabel=words)
    drawing.legend_above(ax)
    return ax


def plot_spin(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the components of angular velocity along the principal axes over time.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``rotation``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    ax = axes(ax, 8, 3.4)
    answer = answer_of(result)
    drawing.lines(ax, _days(answer), np.degrees(answer.omega) * DAY, lw=1.1)
    return _label(ax, "angular velocity (deg/d)")


def plot_attitude_error(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the error of the attitude in time, by cause.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``rotation``.
    ax : Axes, optional
    """
    ax = axes(ax, 8, 3.4)
    answer = answer_of(result)
    for colour, share in zip(CYCLE, ("method", "input", "kernel"), strict=False):
        error = answer[f"attitude_error_{share}"].values
        shown = np.isfinite(error) & (error > 0)
        if shown.any():
            ax.semilogy(_days(answer)[shown], error[shown], color=colour, lw=1.2, label=share)
    ax.axhline(LOST, color="0.4", lw=0.8, ls="--")
    return _label(ax, "error of the attitude (deg)")


def plot_growth(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the logarithm of a small, growing change of the rotation, and its mean growth rate.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``rotation``; without the section ``divergence`` it is run again.
    ax : Axes, optional
    """
    ax = axes(ax, 8, 3.4)
    neighbour = needed(result, "divergence")
    days = _days(neighbour)
    ax.plot(days, neighbour.growth, color=RED, lw=1.2, label="neighbour")
    if "lyapunov_time" in neighbour:
        words = f"e-fold in {_lyapunov_time(neighbour)} d"
        ax.plot(days, days / float(neighbour.lyapunov_time), "k--", lw=0.9, label=words)
    return _label(ax, "logarithm of the distance (1)")


FIGURES = [
    PageFigure(
        "Spin in the body",
        "Components of the angular velocity along the principal axes, C last.",
        plot_spin,
    ),
    PageFigure(
        "How well the attitude is known",
        "What the attitude may be off by at each time: what two ways of following it differ by, "
        "and what the uncertainty of given numbers and positions does.",
        plot_attitude_error,
    ),
    PageFigure(
        "How neighbours part",
        "Logarithm of the distance of a neighbour; a straight line is chaos.",
        plot_growth,
        section="divergence",
    ),
]


# --- solids --------------------------------------------------------------------------------------

#: Semi-axes of what is drawn: the shape of no body in particular.
SHAPE = (1.0, 0.8, 0.6)


def turning_body(tree: Result) -> Solid:
    """Animated three-dimensional ellipsoid with the principal moments of the body."""
    few = answer_of(tree).isel(time=slice(0, POSES))
    attitude, momentum = few.attitude.values, few.angular_momentum.values
    omega = rotate(attitude, few.omega.values)
    return Solid(
        title="The body turns",
        caption="An ellipsoid fixed to the principal axes, its longest axis that of least "
        "moment (A, red) and its shortest that of most (C, black); the angular velocity "
        "(green) and the angular momentum (blue) in space, each over its largest length.",
        items=[
            solids.mesh(solids.ellipsoid(SHAPE), BLUE, frame="body", opacity=0.2),
            solids.arrow(np.array([1.25, 0.0, 0.0]), RED, "A", frame="body"),
            solids.arrow(np.array([0.0, 0.0, 1.0]), BLACK, "C", frame="body"),
            solids.moving_arrow(1.3 * omega / _largest(few.omega.values), GREEN, "ω"),
            solids.moving_arrow(1.3 * momentum / _largest(momentum), BLUE, "L"),
        ],
        radius=1.5,
        times=_days(few),
        unit="d",
        attitude=attitude,
    )


def _largest(vectors: FloatArray) -> float:
    """Length of the longest of several vectors; 1 if all vectors are zero."""
    return float(np.max(np.linalg.norm(vectors, axis=1))) or 1.0


SOLIDS = [("", turning_body)]
