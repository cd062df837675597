"""The nutation predicted from the layers of the body, rung by rung."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from earthspin.interior.published import CORE_NUTATION
from earthspin.views.drawing import BLUE, ORANGE, RED, Drawing, axes, drawn, empty, note, style
from earthspin.views.reading import Result, answer_of, needed, of_sections
from earthspin.views.table import Table, along, date, measured, with_error

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Sections that the figures stand on.
DRAWN = ("beside", "terms", "transfer", "residuals")

#: Frequencies in space between which the transfer function is shown, cycles per year.
SHOWN = 6.0
#: How far from 1 the transfer function is drawn, on its way to infinity.
BEYOND = 0.6


# --- tables --------------------------------------------------------------------------------------


def tables(tree: Result) -> list[Table]:
    """The ladder, and a table for each section that is there."""
    makers = {"beside": beside, "modes": modes, "terms": terms, "compliances": compliances}
    return [ladder(tree), *of_sections(tree, makers)]


def _sizes(title: str, data: xr.Dataset, dim: str, words: str, prefix: str = "") -> Table:
    return Table(
        title,
        (dim, "dpsi sin(eps), mas", "deps, mas", "what it adds"),
        [
            (
                name,
                with_error(of[f"{prefix}rms_dpsi_sineps"], data[f"{prefix}rms_error"]),
                with_error(of[f"{prefix}rms_deps"], data[f"{prefix}rms_error"]),
                str(of[f"{prefix}adds"].values),
            )
            for name, of in along(data, dim)
        ],
        words,
        words=(0, 3),
    )


def ladder(tree: Result) -> Table:
    """What is left against IAU 2000A, rung by rung."""
    return _sizes(
        "Nutation predicted from the layers",
        answer_of(tree),
        "rung",
        "Root mean square of the predicted pole minus the IAU's; a constant and a rate are "
        "removed. The error in brackets is that of H and of the integration, not that of the "
        "model: what is left is the measure of the model. H is the observed one throughout; the "
        "rungs up to 'anelastic' take no other number from the motion of the pole.",
    )


def beside(tree: Result) -> Table:
    """Two models beside the ladder."""
    return _sizes(
        "Beside the ladder",
        needed(tree, "beside"),
        "model",
        "A core in a rigid mantle has a far shorter nutation of its own; a body in hydrostatic "
        "equilibrium has an H that is one per cent too small.",
        "model_",
    )


def modes(tree: Result) -> Table:
    """Free modes of each rung."""
    return Table(
        "Free modes",
        ("rung", "mode", "period, d", "Q"),
        [
            (
                str(of.mode_rung.values),
                str(of.mode_name.values).replace("_", " "),
                measured(of, "mode_period"),
                f"{q:.3g}" if np.isfinite(q := float(of.mode_quality)) else "",
            )
            for _, of in along(needed(tree, "modes"), "mode")
        ],
        "Nutations have their periods in space, negative if retrograde; wobbles in the body. A "
        "rung that lacks a part lacks its mode. The errors follow from the uncertainty of the "
        "Love numbers, of the core's size and of its flattening.",
        words=(0, 1),
    )


def terms(tree: Result) -> Table:
    """Largest circular terms, of the last rung and of the IAU."""
    data = needed(tree, "terms")
    last = data.isel(rung=-1)
    return Table(
        f"The largest nutations, rung '{data.rung.values[-1]}'",
        ("l l' F D node", "period, d", "in phase", "IAU", "out of phase", "IAU, out"),
        [
            (
                term,
                f"{float(of.period):.2f}",
                with_error(of.predicted_in_phase, of.predicted_error),
                f"{float(of.iau_in_phase):.3f}",
                with_error(of.predicted_out_of_phase, of.predicted_error),
                f"{float(of.iau_out_of_phase):+.3f}",
            )
            for term, of in along(last, "term")
        ],
        "Circular amplitudes are in mas; a negative period is retrograde. The errors hold the "
        "uncertainty of the numbers of the inside only, not the sizes of what the rung leaves out.",
    )


def compliances(tree: Result) -> Table:
    """How the parts of the elastic body answer to wobbles."""
    return Table(
        "Compliances",
        ("name", "value"),
        [
            (name, f"{float(of.compliance):.6e}")
            for name, of in along(needed(tree, "compliances"), "compliance_name")
        ],
        "Product of inertia over the moment of the part (whole: kappa, xi, zeta; fluid core: "
        "gamma, beta, delta; inner core: theta, chi, nu), for a wobble of size 1 of the mantle, "
        "the fluid core and the inner core.",
    )


# --- figures -------------------------------------------------------------------------------------


@style()
def drawings(tree: Result) -> list[Drawing]:
    """The ladder, the transfer function and the residuals in time."""
    shown = drawn(
        "From a rigid body to half a milliarcsecond",
        "What is left of each model against IAU 2000A. To see: which steps down are large.",
        plot_nutation_ladder(tree),
    )
    makers = {"transfer": _transfer, "residuals": _in_time}
    return [shown, *of_sections(tree, makers)]


def _transfer(tree: Result) -> Drawing:
    caption = (
        "Nutation of the body over that of a rigid one. Dots: the terms of IAU 2000A over the "
        "rigid ones. The resonance is the free core nutation."
    )
    return drawn("Through the resonance", caption, plot_transfer(tree))


def _in_time(tree: Result) -> Drawing:
    caption = "Predicted pole minus the IAU's; a fitted constant and rate are removed."
    return Drawing("Residuals in time, rung by rung", caption, plot_rung_residuals(tree))


def plot_nutation_ladder(result: Result, *, ax: Axes | None = None) -> Axes:
    """What is left of each rung against IAU 2000A, on a logarithmic axis.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``nutation``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    answer = answer_of(result)
    ax = axes(ax, 7.5, 4)
    place = np.arange(answer.rung.size)
    for name, words, colour, marker in (
        ("rms_dpsi_sineps", "dpsi sin(eps)", BLUE, "o"),
        ("rms_deps", "deps", RED, "D"),
    ):
        ax.step(place, answer[name], where="mid", color=colour, lw=1, alpha=0.5)
        ax.plot(place, answer[name], marker, color=colour, ms=6, label=words)
    for at, value in zip(place, answer.rms_dpsi_sineps.values, strict=True):
        note(ax, f"{value:.2g}" if value < 10 else f"{value:.0f}", (at, value), (0, 8), ha="center")
    ax.set_yscale("log")
    ax.set_xticks(place, [str(rung).replace("-", "\n") for rung in answer.rung.values])
    ax.set_ylabel("left against IAU 2000A, rms (mas)")
    ax.margins(x=0.08, y=0.15)
    ax.grid(axis="x", visible=False)
    ax.legend(loc="upper right")
    return ax


def plot_transfer(result: Result, *, ax: Axes | None = None) -> Axes:
    """The transfer function through the resonance of the core, with the main terms on it.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``nutation``; without its sections ``transfer`` and ``terms`` it is run
        again.
    ax : Axes, optional
    """
    data, main = needed(result, "transfer"), needed(result, "terms")
    per_year = 365.25 * 1.00273781191135448
    frequency = data.frequency.values * per_year
    ax = axes(ax, 7.5, 4.2)
    ax.axhline(1, color="0.8", lw=0.8, zorder=0)
    near = np.abs(frequency) < SHOWN
    for rung, colour, width in (("elastic", "0.6", 1.0), (data.rung.values[-1], BLUE, 1.4)):
        of = data.transfer_real.sel(rung=rung).values
        shown = np.flatnonzero(near & (np.abs(of - 1) < BEYOND))
        # no line from pole to pole, nor through rest in space
        steps = np.diff(shown) > 1
        steps |= np.diff(np.sign(frequency[shown])) > 0
        for number, piece in enumerate(np.split(shown, np.flatnonzero(steps) + 1)):
            words = str(rung) if number == 0 else None
            ax.plot(frequency[piece], of[piece], color=colour, lw=width, label=words)
    rigid = main.predicted_in_phase.sel(rung="rigid")
    at = 365.25 / main.period.values
    inside = np.abs(at) < SHOWN
    ax.plot(
        at[inside], (main.iau_in_phase / rigid).values[inside], "o", color=ORANGE, ms=5,
        label="IAU 2000A / rigid",
    )  # fmt: skip
    ax.set_ylim(0.85, 1.45)
    note(ax, "free core nutation", (365.25 / CORE_NUTATION.value, 0.9), (-8, 0), ha="right")
    ax.set_xlabel("frequency in space, negative if retrograde (cycles per year)")
    ax.set_ylabel("over a rigid body, in phase (ratio)")
    ax.legend(loc="upper right")
    return ax


def plot_rung_residuals(result: Result, *, figure: Figure | None = None) -> Figure:
    """Predicted pole minus the IAU's in time, one rung above the other.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``nutation``; without its section ``residuals`` it is run again.
    figure : Figure, optional
    """
    series, sizes = needed(result, "residuals"), answer_of(result)
    rungs = [str(rung) for rung in series.rung.values if rung not in ("elastic", "inner-core")]
    with style():
        figure = figure or empty(8, 1.5 * len(rungs))
        rows = np.atleast_1d(figure.subplots(len(rungs), 1, sharex=True))
        for ax, rung in zip(rows, rungs, strict=True):
            of, size = series.sel(rung=rung), sizes.sel(rung=rung)
            for name, words, colour in (
                ("dpsi_sineps", "dpsi sin(eps)", BLUE),
                ("deps", "deps", RED),
            ):
                ax.plot(of.time, of[name], color=colour, lw=0.6, label=words)
            ax.set_title(rung, loc="left", fontsize=9)
            words = f"{float(size.rms_dpsi_sineps):.2f} and {float(size.rms_deps):.2f}"
            ax.set_title(f"rms {words} mas", loc="right", fontsize=8)
            ax.set_ylabel("left (mas)")
        ends = f"{date(series.time[0], 'Y')} to {date(series.time[-1], 'Y')}"
        rows[-1].set_xlabel(f"time (TDB), {ends}")
        rows[0].legend(loc="lower right", bbox_to_anchor=(1, 1.12), ncols=2, borderaxespad=0.1)
        return figure
