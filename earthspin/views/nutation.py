"""Figures of the nutation predicted from the layers of the body."""

from __future__ import annotations

import numpy as np

from earthspin.constants import DAYS_PER_YEAR
from earthspin.interior.published import CORE_NUTATION
from earthspin.views import drawing
from earthspin.views.drawing import Axes, PageFigure, axes, note
from earthspin.views.reading import Result, answer_of, needed

#: Frequencies in space between which the transfer function is shown, cycles per year.
SHOWN = 6.0
#: How far from 1 the transfer function is drawn, on its way to infinity.
BEYOND = 0.6


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
    per_year = DAYS_PER_YEAR * 1.00273781191135448
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
    at = DAYS_PER_YEAR / main.period.values
    inside = np.abs(at) < SHOWN
    ax.plot(at[inside], ratio[inside], "o", color=drawing.ORANGE, ms=5, label="IAU 2000A / rigid")
    note(ax, "free core nutation", (DAYS_PER_YEAR / CORE_NUTATION.value, 0.9), (-8, 0), ha="right")
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
