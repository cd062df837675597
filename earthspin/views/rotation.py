"""The whole attitude: spin in the body, how well it is known, and how neighbours part."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from earthspin.constants import DAY
from earthspin.numerics.quaternion import rotate
from earthspin.views.drawing import CYCLE, RED, Drawing, axes, drawn, legend_above, style
from earthspin.views.reading import Result, answer_of, body_of, needed, of_sections, section
from earthspin.views.solids import BLACK, BLUE, GREEN, Solid, arrow, ellipsoid, mesh, moving_arrow
from earthspin.views.solids import RED as RED_LINE
from earthspin.views.table import Table, along, date, listed

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from earthspin.units import FloatArray

#: Sections that the figures stand on.
DRAWN = ("divergence",)
#: An attitude is lost where its error is a quarter of a turn, deg.
LOST = 90.0
#: Poses that a picture which plays shows at most.
POSES = 481


def known_until(answer: xr.Dataset) -> np.datetime64 | None:
    """First date at which the attitude is lost, as far as the method and given numbers go."""
    error = np.hypot(answer.attitude_error_method, answer.attitude_error_input).values
    lost = np.flatnonzero(error >= LOST)
    return answer.time.values[lost[0]] if lost.size else None


def tables(tree: Result) -> list[Table]:
    """The rotation at both ends of the span, and Lyapunov's time."""
    answer = answer_of(tree)
    rows = [
        (
            date(at.time, "s"),
            listed(at.attitude.values),
            listed(at.omega.values),
            f"{float(at.attitude_error_method):.2g}",
        )
        for _, at in along(answer.isel(time=[0, -1]), "time")
    ]
    lost = known_until(answer)
    note = (
        f"The error of the method stays below {LOST:g} deg."
        if lost is None
        else f"From {str(lost)[:16]} on the attitude is not known: its error is {LOST:g} deg or "
        "more, and what follows is one motion of many."
    )
    found = [
        Table(
            f"The attitude of {body_of(answer)}",
            (
                "TDB",
                "quaternion, body to ICRF",
                "spin in the body, rad/s",
                "error of the method, deg",
            ),
            rows,
            note,
            words=(0, 1, 2),
        )
    ]
    parting = section(tree, "divergence")
    if parting is not None:
        found.append(_divergence(parting))
    return found


def _divergence(parting: xr.Dataset) -> Table:
    rate, spread = (float(parting[f"growth_rate{of}"]) * DAY for of in ("", "_error"))
    rows = [
        ("course", str(parting.course.values)),
        ("growth rate, 1/d", f"{rate:.3g} ± {spread:.2g}"),
    ]
    if "lyapunov_time" in parting:
        time, error = float(parting.lyapunov_time), float(parting.lyapunov_time_error)
        rows.append(("Lyapunov time, d", f"{time:.3g} ± {error:.2g}"))
    return Table(
        "How neighbouring rotations part",
        ("quantity", "value"),
        rows,
        "The half-width comes from the scatter of the rate between eight stretches of the span.",
    )


# --- figures -------------------------------------------------------------------------------------


@style()
def drawings(tree: Result) -> list[Drawing]:
    """Spin in the body, error of the attitude, growth of a neighbour's distance."""
    words = "Components of the angular velocity along the principal axes, C last."
    error = (
        "What the attitude may be off by at each time: what two ways of following it differ by, "
        "and what the uncertainty of given numbers and positions does."
    )
    return [
        drawn("Spin in the body", words, plot_spin(tree)),
        drawn("How well the attitude is known", error, plot_attitude_error(tree)),
        *of_sections(tree, {"divergence": _drawn_growth}),
    ]


def _drawn_growth(tree: Result) -> Drawing:
    words = "Logarithm of the distance of a neighbour; a straight line is chaos."
    return drawn("How neighbours part", words, plot_growth(tree))


def _days(answer: xr.Dataset) -> FloatArray:
    time = answer.time.values
    return np.asarray((time - time[0]) / np.timedelta64(1, "D"))


def _daily(ax: Axes) -> None:
    ax.set_xlabel("time from the start (d)")


def plot_spin(result: Result, *, ax: Axes | None = None) -> Axes:
    """Angular velocity along the principal axes in time.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``rotation``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    ax = axes(ax, 8, 3.4)
    answer = answer_of(result)
    for colour, (component, of) in zip(CYCLE, along(answer, "component"), strict=False):
        turns = np.degrees(of.omega.values) * DAY
        ax.plot(_days(answer), turns, color=colour, lw=1.1, label=str(component))
    _daily(ax)
    ax.set_ylabel("angular velocity (deg/d)")
    legend_above(ax)
    return ax


def plot_attitude_error(result: Result, *, ax: Axes | None = None) -> Axes:
    """Error of the attitude in time, by where it comes from.

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
    _daily(ax)
    ax.set_ylabel("error of the attitude (deg)")
    legend_above(ax)
    return ax


def plot_growth(result: Result, *, ax: Axes | None = None) -> Axes:
    """Logarithm of the distance of a neighbour, and its mean rate.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``rotation``; without the section ``divergence`` it is run again.
    ax : Axes, optional
    """
    ax = axes(ax, 8, 3.4)
    parting = needed(result, "divergence")
    days = _days(parting)
    ax.plot(days, parting.growth, color=RED, lw=1.2, label="neighbour")
    if "lyapunov_time" in parting:
        time, error = float(parting.lyapunov_time), float(parting.lyapunov_time_error)
        ax.plot(days, days / time, "k--", lw=0.9, label=f"e-fold in {time:.3g} ± {error:.2g} d")
    _daily(ax)
    ax.set_ylabel("logarithm of the distance (1)")
    legend_above(ax)
    return ax


# --- solids --------------------------------------------------------------------------------------


def solids(tree: Result) -> list[Solid]:
    """The body as it turns: an ellipsoid that is as long as its moments tell."""
    answer = answer_of(tree)
    few = answer.isel(time=slice(0, POSES))
    attitude, omega = few.attitude.values, few.omega.values
    speed = float(np.max(np.linalg.norm(omega, axis=1))) or 1.0
    momentum = few.angular_momentum.values
    size = float(np.max(np.linalg.norm(momentum, axis=1))) or 1.0
    return [
        Solid(
            title="The body turns",
            caption="An ellipsoid fixed to the principal axes, its longest axis that of least "
            "moment (A, red) and its shortest that of most (C, black); the angular velocity "
            "(green) and the angular momentum (blue) in space, each over its largest length.",
            items=[
                mesh(ellipsoid(SHAPE), BLUE, frame="body", opacity=0.2),
                arrow(np.array([1.25, 0.0, 0.0]), RED_LINE, "A", frame="body"),
                arrow(np.array([0.0, 0.0, 1.0]), BLACK, "C", frame="body"),
                moving_arrow(1.3 * rotate(attitude, omega) / speed, GREEN, "ω"),
                moving_arrow(1.3 * momentum / size, BLUE, "L"),
            ],
            radius=1.5,
            times=_days(few),
            unit="d",
            attitude=attitude,
        )
    ]


#: Semi-axes of what is drawn: the shape of no body in particular.
SHAPE = (1.0, 0.8, 0.6)
