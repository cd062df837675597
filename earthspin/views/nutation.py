"""Tables and figures of the nutation predicted from the layers of the body."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.interior.published import CORE_NUTATION
from earthspin.views import drawing
from earthspin.views.drawing import Axes, PageFigure, axes, note
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.table import (
    Column,
    Table,
    neighbour_share,
    quality,
    table_along,
    with_error,
)

#: Frequencies in space between which the transfer function is shown, cycles per year.
SHOWN = 6.0
#: How far from 1 the transfer function is drawn, on its way to infinity.
BEYOND = 0.6


# --- tables --------------------------------------------------------------------------------------


def _sizes(title: str, data: xr.Dataset, dim: str, note: str, prefix: str = "") -> Table:
    def size(angle: str) -> Column:
        name = f"{prefix}rms_{angle}"
        return Column(name, lambda row: with_error(row[name], row[f"{prefix}rms_error"]))

    columns = size("dpsi_sineps"), size("deps"), f"{prefix}adds"
    return table_along(data, dim, title, columns, note, words=(0, 3))


def ladder(tree: Result) -> Table:
    """Table of the rms of predicted pole minus IAU 2000A, for each model of the ladder."""
    return _sizes(
        "Nutation predicted from the layers",
        answer_of(tree),
        "rung",
        "Root mean square of the predicted pole minus the IAU's; a constant and a rate are "
        "removed. The error in brackets is that of the inputs of the interior, of H and of the "
        "integration; what a model leaves out is not in it. H is the observed one throughout; the "
        "rungs up to 'anelastic' take no other number from the motion of the pole.",
    )


def beside(tree: Result) -> Table:
    """Table of the rms of predicted pole minus IAU 2000A, for two models outside the ladder."""
    return _sizes(
        "Beside the ladder",
        needed(tree, "beside"),
        "model",
        "A core in a rigid mantle has a far shorter nutation of its own; a body in hydrostatic "
        "equilibrium has an H that is one per cent too small.",
        "model_",
    )


def modes(tree: Result) -> Table:
    """Table of the free modes (wobbles and nutations) of each model of the ladder."""
    columns = (
        *("mode_rung", "mode_name", "mode_period"),
        Column("mode_quality", lambda row: quality(row, "mode_quality", ".3g")),
    )
    note = (
        "Nutations have their periods in space, negative if retrograde; wobbles in the body. A "
        "rung that lacks a part lacks its mode. The errors follow from the uncertainty of the "
        "Love numbers, of size, flattening and density of the core and the inner core, of the "
        "ocean, of the mantle's loss, and of numbers inferred from nutation."
    )
    modes = needed(tree, "modes")
    return table_along(modes, "mode", "Free modes", columns, note, first="", words=(0, 1))


def terms(tree: Result) -> Table:
    """Table of the largest circular nutation terms, of the most detailed model and of the IAU."""
    data = needed(tree, "terms")

    def predicted(phase: str, head: str) -> Column:
        name = f"predicted_{phase}"
        return Column(name, lambda row: with_error(row[name], row.predicted_error), head)

    columns = (
        "period:.2f",
        predicted("in_phase", "in phase"),
        Column("iau_in_phase", ".3f", "IAU"),
        Column("neighbour_in_phase", neighbour_share, "neighbour"),
        predicted("out_of_phase", "out of phase"),
        Column("iau_out_of_phase", "+.3f", "IAU, out"),
    )
    note = (
        "Circular amplitudes are in mas; a negative period is retrograde. The errors hold the "
        "uncertainty of the numbers of the inside only, not the sizes of what the rung leaves out. "
        "Where 150 years are too short to separate a term from a neighbour, all amplitudes "
        "include the neighbour; the column 'neighbour' gives its share in that of IAU 2000A."
    )
    title = f"The largest nutations, rung '{data.rung.values[-1]}'"
    return table_along(data.isel(rung=-1), "term", title, columns, note, first="l l' F D node")


TABLES = [("", ladder), ("beside", beside), ("modes", modes), ("terms", terms)]


# --- figures -------------------------------------------------------------------------------------


def plot_nutation_ladder(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the rms of predicted pole minus IAU 2000A for each model, on a logarithmic axis.

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
        ("rms_dpsi_sineps", "dpsi sin(eps)", drawing.BLUE, "o"),
        ("rms_deps", "deps", drawing.RED, "D"),
    ):
        ax.step(place, answer[name], where="mid", color=colour, lw=1, alpha=0.5)
        ax.plot(place, answer[name], marker, color=colour, ms=6, label=words)
    for at, value in zip(place, answer.rms_dpsi_sineps.values, strict=True):
        note(ax, f"{value:.2g}" if value < 10 else f"{value:.0f}", (at, value), (0, 8), ha="center")
    ax.set(yscale="log", ylabel="left against IAU 2000A, rms (mas)")
    ax.margins(y=0.15)
    drawing.rungs(ax, [str(rung).replace("-", "\n") for rung in answer.rung.values])
    ax.legend(loc="upper right")
    return ax


def plot_transfer(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the transfer function of nutation near the resonance of the core, and the main terms.

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
    for rung, colour, width in (("elastic", "0.6", 1.0), (data.rung.values[-1], drawing.BLUE, 1.4)):
        transfer = data.transfer_real.sel(rung=rung).values
        shown = np.flatnonzero(near & (np.abs(transfer - 1) < BEYOND))
        # no line from pole to pole, nor through rest in space
        steps = (np.diff(shown) > 1) | (np.diff(np.sign(frequency[shown])) > 0)
        for number, piece in enumerate(np.split(shown, np.flatnonzero(steps) + 1)):
            words = str(rung) if number == 0 else None
            ax.plot(frequency[piece], transfer[piece], color=colour, lw=width, label=words)
    ratio = (main.iau_in_phase / main.predicted_in_phase.sel(rung="rigid")).values
    at = 365.25 / main.period.values
    inside = np.abs(at) < SHOWN
    ax.plot(at[inside], ratio[inside], "o", color=drawing.ORANGE, ms=5, label="IAU 2000A / rigid")
    note(ax, "free core nutation", (365.25 / CORE_NUTATION.value, 0.9), (-8, 0), ha="right")
    ax.set(
        ylim=(0.85, 1.45),
        xlabel="frequency in space, negative if retrograde (cycles per year)",
        ylabel="over a rigid body, in phase (ratio)",
    )
    ax.legend(loc="upper right")
    return ax


FIGURES = [
    PageFigure(
        "From a rigid body to half a milliarcsecond",
        "What is left of each model against IAU 2000A. To see: which steps down are large.",
        plot_nutation_ladder,
    ),
    PageFigure(
        "Through the resonance",
        "Nutation of the body over that of a rigid one. Dots: the terms of IAU 2000A over the "
        "rigid ones. The resonance is the free core nutation.",
        plot_transfer,
        section="transfer",
        uses=["terms"],
    ),
]
