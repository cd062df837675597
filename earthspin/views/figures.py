"""Figures: each draws one thing from a result, on axes of its own or on yours.

No pyplot: it costs half a second and keeps global state.
"""

from __future__ import annotations

import io
import re
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from earthspin.constants import JULIAN_YEAR
from earthspin.dataset import si
from earthspin.views.drawing import Drawing
from earthspin.views.stars import STARS

#: Colours that remain apart for colour-blind eyes (Okabe & Ito 2008) and in print.
COLOURS = {"sun": "#E69F00", "moon": "#0072B2", "total": "#222222"}
_CYCLE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")

#: Longer series are drawn with thin lines.
DENSE = 4000

STYLE: Any = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10,
    "axes.grid": True,
    "grid.alpha": 0.25,
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "svg.hashsalt": "earthspin",
    "svg.fonttype": "none",
}


def _axes(ax: Axes | None, **size: Any) -> Axes:
    if ax is not None:
        return ax
    return Figure(layout="constrained", **size).add_subplot()


def _legend_above(ax: Axes) -> None:
    """Legend outside the data, above the right corner."""
    legend = ax.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, borderaxespad=0.1, fontsize=8
    )
    for line in legend.get_lines():
        line.set_linewidth(1.4)


def _colour(label: str, number: int) -> str:
    return COLOURS.get(label, _CYCLE[number % len(_CYCLE)])


def plot_declination(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Declination of each perturber in time.

    Parameters
    ----------
    result : Dataset
        Of the question ``torque``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    ax = _axes(ax)
    for number, label in enumerate(result.perturber.values):
        ax.plot(
            result.time,
            result.declination.sel(perturber=label),
            color=_colour(str(label), number),
            lw=0.8 if result.time.size < DENSE else 0.3,
            zorder=3 - 0.1 * number,
            label=str(label),
        )
    ax.set_ylabel("declination (deg)")
    _legend_above(ax)
    return ax


def plot_torque(
    result: xr.Dataset, *, smooth_days: float | None = None, ax: Axes | None = None
) -> Axes:
    """Component of the torque that precession comes from, towards the equinox, in time.

    Parameters
    ----------
    result : Dataset
        Of the question ``torque``, evenly spaced.
    smooth_days : float, optional
        Width of a running mean that is drawn on top.
    ax : Axes, optional
    """
    ax = _axes(ax)
    torque = result.torque.sel(component="x") * 1e-22
    for number, label in enumerate(result.perturber.values):
        colour = _colour(str(label), number)
        one = torque.sel(perturber=label)
        thin = result.time.size >= DENSE
        ax.plot(result.time, one, color=colour, lw=0.3 if thin else 0.8, alpha=0.5 if thin else 1)
        if smooth_days:
            step = float((result.time[1] - result.time[0]) / np.timedelta64(1, "D"))
            width = max(1, round(smooth_days / step))
            ax.plot(
                result.time,
                one.rolling(time=width, center=True).mean(),
                color=colour,
                lw=1.4,
                zorder=4 - 0.1 * number,
                label=f"{label}, mean over {smooth_days:g} d",
            )
        else:
            ax.axhline(float(one.mean()), color=colour, lw=0.8, ls="--")
    ax.set_ylabel("torque towards\nthe equinox (10$^{22}$ N m)")
    ax.set_xlabel("TDB")
    if smooth_days:
        _legend_above(ax)
    return ax


def plot_convergence(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Distance of the averaged rate from the adopted one, against the window's length.

    Parameters
    ----------
    result : Dataset
        Of the question ``precession``.
    ax : Axes, optional
    """
    ax = _axes(ax)
    to_mas_per_century = 1e5
    adopted = result.precession_rate.isel(perturber=-1)
    for number, window in enumerate(result.window.values):
        off = abs(result.rate_by_window.sel(window=window) - adopted) * to_mas_per_century
        ax.semilogy(
            result.window_cycles, np.maximum(off, 1e-3), color=_CYCLE[number], lw=1.2, label=window
        )
    error = float(result.precession_rate_error_method.isel(perturber=-1)) * to_mas_per_century
    ax.axhline(error, color="0.3", lw=0.9, ls="--")
    ax.annotate(
        f"error claimed for averaging, {error:.2g} mas/cy",
        (1.05, error),
        xytext=(0, -3),
        textcoords="offset points",
        va="top",
        fontsize=8,
        color="0.3",
    )
    ax.set_xlabel("length of the window (turns of the slowest cycle)")
    ax.set_ylabel("off by (mas per century)")
    ax.set_ylim(3e-2, None)
    ax.legend(loc="upper right", ncols=2)
    return ax


def plot_pole_circle(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Path of the celestial pole among the stars through one turn of precession.

    The sky from inside, centred on the pole of the ecliptic, the present pole on top; the
    obliquity is held at its present value.

    Parameters
    ----------
    result : Dataset
        Of the question ``precession``.
    ax : Axes, optional
    """
    ax = _axes(ax, figsize=(6.4, 6.4))
    obliquity = float(np.radians(result.obliquity))
    radius = np.degrees(obliquity)
    turn = np.linspace(0, 2 * np.pi, 361)
    ax.plot(radius * np.sin(turn), radius * np.cos(turn), color="#D55E00", lw=1.4)
    ax.plot(0, 0, marker="+", color="0.3", ms=9)
    ax.annotate("pole of the ecliptic", (0, 0), xytext=(6, 6), textcoords="offset points")

    for name, ra, dec, magnitude in STARS:
        x, y = _on_the_chart(np.radians(ra), np.radians(dec), obliquity)
        ax.plot(x, y, "o", color="0.1", ms=max(1.5, 5.5 - 1.1 * magnitude))
        ax.annotate(
            name,
            (x, y),
            xytext=(5, 3) if x > -1 else (-5, 3),
            ha="left" if x > -1 else "right",
            textcoords="offset points",
            fontsize=8,
            color="0.35",
        )

    rate = float(si(result.precession_rate.isel(perturber=-1)))
    period = float(result.precession_period.isel(perturber=-1))
    before_christ = [1 - year for year in range(10000, 0, -2000)]
    for year in [*before_christ, 1, *range(2000, 14001, 2000)]:
        back = rate * (year - 2000) * JULIAN_YEAR  # the pole's longitude falls: to the left
        x, y = -radius * np.sin(back), radius * np.cos(back)
        ax.plot(x, y, "o", color="#D55E00", ms=4)
        label = f"{year}" if year > 0 else f"{1 - year} BC"
        ax.annotate(
            label,
            (x, y),
            xytext=(20 * np.sin(back), -13 * np.cos(back)),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=8,
            color="#D55E00",
        )
    ax.set_title(f"once round in {period:,.0f} years")
    ax.set_aspect("equal")
    ax.set_xlim(-34, 34)
    ax.set_ylim(-34, 34)
    ax.set_xlabel("degrees from the pole of the ecliptic")
    ax.set_ylabel("degrees")
    return ax


def _on_the_chart(ra: float, dec: float, obliquity: float) -> tuple[float, float]:
    """Place of a star on the chart, degrees: distance from the ecliptic pole, longitude."""
    x = np.cos(dec) * np.cos(ra)
    y = np.cos(obliquity) * np.cos(dec) * np.sin(ra) + np.sin(obliquity) * np.sin(dec)
    z = -np.sin(obliquity) * np.cos(dec) * np.sin(ra) + np.cos(obliquity) * np.sin(dec)
    away, longitude = np.degrees(np.arctan2(np.hypot(x, y), z)), np.arctan2(y, x)
    # The present pole has longitude 90 degrees. Longitude grows clockwise, seen from inside.
    return float(away * np.sin(longitude - np.pi / 2)), float(away * np.cos(longitude - np.pi / 2))


# --- drawings for the page -------------------------------------------------------------------


def torque_through(result: xr.Dataset, title: str, smooth_days: float | None = None) -> Drawing:
    """Declination above, torque below."""
    with rc_context(STYLE):
        figure = Figure(figsize=(8, 4.6), layout="constrained")
        upper, lower = figure.subplots(2, 1, sharex=True)
        plot_declination(result, ax=upper)
        plot_torque(result, smooth_days=smooth_days, ax=lower)
        caption = (
            f"Above: declination, {result.torque.attrs['frame']}. Below: the component of the "
            "torque towards the equinox; it hardly ever changes sign, so the axis is pushed "
            "the same way all the time. "
        )
        caption += (
            f"Thin: once a day; thick: mean over {smooth_days:g} days, which swings with the "
            "tilt of the Moon's orbit."
            if smooth_days
            else "Dashed: mean. It vanishes when the body crosses the equator."
        )
        return Drawing(title, caption, _svg(figure))


def convergence_of_windows(result: xr.Dataset) -> Drawing:
    """Convergence of the average with the length of the window."""
    with rc_context(STYLE):
        figure = Figure(figsize=(8, 3.8), layout="constrained")
        plot_convergence(result, ax=figure.subplots())
        return Drawing(
            "How the average converges",
            "Distance of the averaged rate from the adopted one. A plain mean misses by whole "
            "arcseconds a century wherever it stops; a taper on a whole number of turns, three or "
            "more, is within a few thousandths of one.",
            _svg(figure),
        )


def circle_of_pole(result: xr.Dataset) -> Drawing:
    """The circle of the pole through the stars."""
    with rc_context({**STYLE, "axes.grid": False}):
        ax = plot_pole_circle(result)
        assert isinstance(ax.figure, Figure)
        return Drawing(
            "The pole's circle through the stars",
            "The sky from inside, centred on the pole of the ecliptic, at the present rate and "
            "obliquity; stars where they stand today.",
            _svg(ax.figure),
            square=True,
        )


def _svg(figure: Figure) -> str:
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    svg = text.getvalue()
    # The metadata name the drawing library, and addresses that no page needs.
    return re.sub(r"<metadata>.*?</metadata>", "", svg[svg.index("<svg") :], flags=re.DOTALL)


def free_rotor_drawings(result: xr.Dataset) -> list[Drawing]:
    """Angular velocity in the body in time, and the herpolhode."""
    with rc_context(STYLE):
        figure = Figure(figsize=(8, 3.4), layout="constrained")
        plot_components(result, ax=figure.subplots())
        drawn = [
            Drawing(
                "Angular velocity in the body",
                "Components along the principal axes.",
                _svg(figure),
            )
        ]
        if "herpolhode" in result:
            ax = plot_herpolhode(result)
            assert isinstance(ax.figure, Figure)
            drawn.append(
                Drawing(
                    "Herpolhode",
                    "The tip of the angular velocity in the invariable plane, between its bounds "
                    f"(dashed). {_round_of_polhode(result)}",
                    _svg(ax.figure),
                    square=True,
                )
            )
        return drawn


def _round_of_polhode(result: xr.Dataset) -> str:
    if "herpolhode_advance" not in result:
        return "It does not come back to where it was."
    turned = float(np.degrees(result.herpolhode_advance))
    period = float(result.polhode_period)
    return f"A round of the polhode, {period:.4g} s, turns it by {turned:.4f} deg."


def top_drawings(result: xr.Dataset) -> list[Drawing]:
    """Effective potential, and inclination in time."""
    with rc_context(STYLE):
        figure = Figure(figsize=(8, 3.4), layout="constrained")
        left, right = figure.subplots(1, 2)
        plot_effective_potential(result, ax=left)
        right.plot(result.time, np.degrees(result.theta), color=_CYCLE[0], lw=1.2)
        right.set_xlabel("time (s)")
        right.set_ylabel("inclination (deg)")
        return [
            Drawing(
                "Effective potential and nutation",
                "Left: the effective potential of the inclination and the top's own energy "
                "(dashed); it swings where the energy lies above. Right: the inclination in time.",
                _svg(figure),
            )
        ]


def plot_components(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Angular velocity along the principal axes in time."""
    ax = _axes(ax)
    for number, component in enumerate(result.component.values):
        ax.plot(
            result.time,
            result.omega_body.sel(component=component),
            color=_CYCLE[number],
            lw=1.2,
            label=f"{component}",
        )
    ax.set_xlabel("time (s)")
    ax.set_ylabel("angular velocity (rad/s)")
    _legend_above(ax)
    return ax


def plot_herpolhode(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Path of the angular velocity in the invariable plane, and its two bounds."""
    ax = _axes(ax, figsize=(5, 5))
    turn = np.linspace(0, 2 * np.pi, 181)
    for radius in result.herpolhode_radius.values:
        ax.plot(radius * np.cos(turn), radius * np.sin(turn), color="0.5", lw=0.8, ls="--")
    x, y = result.herpolhode.transpose("in_plane", ...).values
    ax.plot(x, y, color=_CYCLE[1], lw=1.0)
    ax.set_aspect("equal")
    ax.set_xlabel("rad/s")
    ax.set_ylabel("rad/s")
    return ax


def plot_effective_potential(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Effective potential of a top against its inclination, with the level of its energy."""
    ax = _axes(ax)
    at_turning = np.interp(
        np.degrees(result.turning_angle.values), result.inclination, result.effective_potential
    )
    level = float(at_turning.max())
    lowest = float(result.effective_potential.min())
    reach = max(level - lowest, 0.05 * abs(lowest), 1e-9)
    ax.plot(result.inclination, result.effective_potential, color=_CYCLE[0], lw=1.2)
    ax.axhline(level, color="0.4", lw=0.9, ls="--")
    ax.set_ylim(lowest - 0.2 * reach, level + 2 * reach)
    ax.set_xlabel("inclination (deg)")
    ax.set_ylabel("effective potential (rad$^2$/s$^2$)")
    return ax
