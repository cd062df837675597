"""Figures of the pole in time, its residuals, its nutations, and the budget."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from earthspin.constants import DAY, MOON_NODE_PERIOD
from earthspin.views.drawing import Drawing
from earthspin.views.figures import STYLE, _svg
from earthspin.views.pole_tables import MAS_PER_CENTURY, MODELS

_MODEL_COLOURS = {"first-order": "#E69F00", "rigid": "#0072B2", "nonrigid": "#009E73"}


def _axes(ax: Axes | None, width: float = 6.4, height: float = 4.8) -> Axes:
    if ax is not None:
        return ax
    with rc_context(STYLE):
        return Figure(figsize=(width, height), layout="constrained").add_subplot()


def plot_pole_path(result: xr.Dataset, *, axis: str = "figure", ax: Axes | None = None) -> Axes:
    """Nutation of an axis about its own precession, psi sin(eps) against eps.

    Parameters
    ----------
    result : Dataset
        Of the question ``pole``; some years of it, with psi and eps.
    axis : str
        Which of the three.
    ax : Axes, optional
    """
    ax = _axes(ax, 6.4, 5.0)
    of = result.sel(axis=axis)
    days = (of.time.values - of.time.values[0]) / np.timedelta64(1, "D")
    angles = np.stack([of.psi * np.sin(np.radians(of.eps / 3600)), of.eps], axis=1)
    turn = 2 * np.pi * days * DAY / MOON_NODE_PERIOD.value
    design = np.stack([np.ones_like(days), days, np.cos(turn), np.sin(turn)], axis=1)
    line = np.linalg.lstsq(design, angles, rcond=None)[0]
    x, y = (angles - design[:, :2] @ line[:2]).T
    drawn = ax.scatter(x, y, c=days / 365.25, s=2, cmap="viridis")
    ax.figure.colorbar(drawn, ax=ax, label="years from the start")
    ax.set_aspect("equal")
    ax.set_xlabel("psi sin(eps), arcsec, straight line removed")
    ax.set_ylabel("eps, arcsec, straight line removed")
    ax.set_title(f"{axis.replace('_', ' ')} axis")
    return ax


def plot_pole_residuals(result: xr.Dataset, *, figure: Figure | None = None) -> Figure:
    """Our pole less the IAU's for three models, one above the other.

    Parameters
    ----------
    result : Dataset
        Of the question ``iau``.
    figure : Figure, optional
    """
    with rc_context(STYLE):
        figure = figure or Figure(figsize=(8, 6.4), layout="constrained")
        rows = figure.subplots(result.sizes["model"], 1, sharex=True)
        for ax, model in zip(np.atleast_1d(rows), result.model.values, strict=True):
            of = result.sel(model=model)
            for name, colour in (("dpsi_sineps", "#0072B2"), ("deps", "#D55E00")):
                rms = float(of.residual_rms.sel(direction=name))
                values = of[f"{name}_by_model"]
                label = "dpsi sin(eps)" if name == "dpsi_sineps" else "deps"
                ax.plot(of.time, values, color=colour, lw=0.6, label=f"{label}: {rms:.2f} mas rms")
            ax.set_title(MODELS[str(model)], loc="left")
            ax.set_ylabel("mas")
            ax.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2, borderaxespad=0.1)
        ax.set_xlabel("TDB")
        return figure


def plot_nutation_ratio(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Ratio of IAU 2000A to our rigid amplitudes against frequency, and the fitted response.

    Parameters
    ----------
    result : Dataset
        Of the question ``iau``.
    ax : Axes, optional
    """
    ax = _axes(ax, 7.2, 4.2)
    frequency = 365.25 / result.period
    order = np.argsort(frequency.values)
    ax.axvline(365.25 / float(result.core_nutation_period), color="0.6", lw=0.8, ls="--", zorder=0)
    ax.annotate(
        f"free core nutation\n{float(result.core_nutation_period):.1f} d",
        (365.25 / float(result.core_nutation_period), 1.3),
        xytext=(-8, 0),
        textcoords="offset points",
        ha="right",
        fontsize=8,
        color="0.4",
    )
    ax.axhline(1, color="0.8", lw=0.8, zorder=0)
    size = np.abs(result.rigid_in_phase.values)
    ax.scatter(
        frequency,
        result.ratio_in_phase,
        s=10 + 25 * np.log10(1 + size),
        color="#0072B2",
        label="IAU 2000A over ours",
        zorder=3,
    )
    ax.plot(
        frequency[order],
        result.transfer_in_phase[order],
        "x",
        color="#D55E00",
        ms=5,
        label="fitted response",
        zorder=4,
    )
    ax.set_xscale("symlog", linthresh=0.1)
    ax.set_xticks([-27, -13, -2, -1, -0.2, -0.05, 0.05, 0.2, 1, 2, 13, 27])
    ax.set_xticklabels([f"{t:g}" for t in ax.get_xticks()], fontsize=7)
    ax.set_xlabel("cycles a year in space (negative: retrograde)")
    ax.set_ylabel("ratio, in phase")
    ax.legend(loc="upper right")
    return ax


def plot_budget(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """How far each effect is from its published size, and the closure.

    Parameters
    ----------
    result : Dataset
        Of the question ``iau``.
    ax : Axes, optional
    """
    ax = _axes(ax, 7.2, 3.4)
    shown = [e for e in result.effect.values if e != "first-order"]
    of = result.sel(effect=shown)
    sizes = np.maximum(np.abs(of.psi_rate) * MAS_PER_CENTURY, 1e-3)
    published = np.maximum(np.abs(of.psi_rate_published) * MAS_PER_CENTURY, 1e-3)
    place = np.arange(len(shown))
    ax.barh(place + 0.2, sizes, height=0.36, color="#0072B2", label="measured by switching")
    ax.barh(place - 0.2, published, height=0.36, color="#E69F00", label="published")
    ax.axvline(abs(float(result.closure)) * MAS_PER_CENTURY, color="#D55E00", lw=1, ls="--")
    ax.annotate(
        f"closure {float(result.closure) * MAS_PER_CENTURY:+.1f}",
        (abs(float(result.closure)) * MAS_PER_CENTURY, len(shown) - 0.6),
        xytext=(3, 0),
        textcoords="offset points",
        fontsize=8,
        color="#D55E00",
    )
    ax.set_yticks(place, shown)
    ax.set_xscale("log")
    ax.set_xlim(1e-3, 1e4)
    ax.set_xlabel("size of the contribution to the rate of psi_A, mas a century")
    ax.legend(loc="center right")
    return ax


def pole_drawings(result: xr.Dataset) -> list[Drawing]:
    """The path of the figure axis, for the page."""
    with rc_context(STYLE):
        return [
            _drawing(
                plot_pole_path(result),
                "The path of the pole",
                "The figure axis among the stars: precession carries it along, nutation makes it "
                "swing.",
            )
        ]


def iau_drawings(result: xr.Dataset) -> list[Drawing]:
    """Budget, residuals and ratios, for the page."""
    with rc_context(STYLE):
        return [
            _drawing(
                plot_budget(result),
                "The budget",
                "Contribution of each effect to the rate of psi_A, measured by switching it off, "
                "beside the published one.",
            ),
            Drawing(
                "Residuals in time",
                "Our pole less the IAU's, with what was fitted taken off.",
                _svg(plot_pole_residuals(result)),
            ),
            _drawing(
                plot_nutation_ratio(result),
                "How the yielding body answers",
                "IAU 2000A over our rigid amplitudes, and the fitted resonance form.",
            ),
        ]


def _drawing(ax: Axes, title: str, caption: str) -> Drawing:
    assert isinstance(ax.figure, Figure)
    return Drawing(title, caption, _svg(ax.figure))
