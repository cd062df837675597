"""The free wobble, from the formula with the flattening to a deformable body."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from earthspin.views.drawing import BLUE, RED, Drawing, axes, drawn, note, style
from earthspin.views.reading import Result, answer_of, changes_of, needed, of_sections, section
from earthspin.views.table import (
    NUMBERS_ONLY,
    Table,
    along,
    beside_observed,
    measured,
    with_error,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Numbers that an ensemble of answers shows first.
CHIEF = ("period_solar",)
#: Sections that the figures stand on.
DRAWN = ("observed",)


def tables(tree: Result) -> list[Table]:
    """The ladder of models, and the sensitivity of its last rung to the inputs."""
    return [ladder(tree), *of_sections(tree, {"sensitivity": sensitivity})]


def ladder(tree: Result) -> Table:
    """Period of the free wobble by a series of models, the rungs of the ladder."""
    answer, observed = answer_of(tree), section(tree, "observed")
    last, left_out = str(answer.rung.values[-1]), section(tree, "neglected")
    rows = [
        (
            name,
            beside_observed(of.period_solar, of.period_solar_error, left_out)
            if observed is not None and name == last
            else measured(of, "period_solar"),
            f"{float(of.period_sidereal):.3f}",
            f"{float(of.factor):.6f}",
            f"{q:.0f}" if math.isfinite(q := float(of.quality_factor)) else "",
        )
        for name, of in along(answer, "rung")
    ]
    notes = [
        "Each rung is a model that adds one effect to the model before; the factor is the ratio of "
        "their periods. The factors depend on the order of the rungs."
    ]
    if "anelastic" in answer.rung.values:
        notes.append(
            "The exponent of anelasticity is a free choice, so the last rung is a check of "
            "consistency, not a prediction."
        )
    left_out = answer.rung.attrs.get("left_out", "none")
    if left_out != "none":
        notes.append(f"Rungs left out: {left_out}.")
    if observed is not None:
        rows.append(("observed", measured(observed, "observed_period"), "", "", ""))
        source = observed.observed_period.attrs.get("references", "")
        notes.append(f"Source of the observed period: {source}.")
        notes.append(
            "The errors hold the uncertainty of the input numbers; that of the last rung, which "
            "stands beside the observed period, holds the sizes of what it leaves out, too, where "
            "they are known."
        )
    return Table(
        "Free wobble, rung by rung",
        ("rung", "days of 86400 s", "sidereal days", "factor", "Q"),
        rows,
        " ".join(notes),
    )


def sensitivity(tree: Result) -> Table:
    """Sensitivity of the last rung to each input."""
    roots = section(tree, "core_nutation")
    shown = (
        ""
        if roots is None
        else ", ".join(
            f"{float(of.free_core_nutation):.1f} d ({shape} core)"
            for shape, of in along(roots, "core_shape")
        )
    )
    return Table(
        "Sensitivity of the last rung",
        ("input", "value", "days per unit of input", "days from error of input"),
        [
            (
                name.replace("_", " "),
                with_error(of.input_value, of.input_half_width),
                f"{float(of.days_per_unit):.4g}",
                f"{float(of.days_from_input):.2g}",
            )
            for name, of in along(needed(tree, "sensitivity"), "input")
            if float(of.input_value) != 0
        ],
        shown
        and "The other root of the equations is the free core nutation; its period in space: "
        f"{shown}.",
    )


@style()
def drawings(tree: Result) -> list[Drawing]:
    """The ladder."""
    band = "; the band is the observed period" if section(tree, "observed") is not None else ""
    caption = " ".join(
        [
            "Period of the free wobble by a series of models, with 95 % errors from sampled "
            f"inputs ({NUMBERS_ONLY}){band}.",
            *changes_of(answer_of(tree), "body"),
        ]
    )
    return [drawn("From the rigid to the deformable body", caption, plot_ladder(tree))]


def plot_ladder(result: Result, *, ax: Axes | None = None) -> Axes:
    """Period of each rung in days, with the observed period as a band if its section is there.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``wobble``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    answer, observed = answer_of(result), section(result, "observed")
    ax = axes(ax, 7.5, 4)
    if observed is not None:
        seen, half = float(observed.observed_period), float(observed.observed_period_error)
        ax.axhspan(seen - half, seen + half, color=RED, alpha=0.3, lw=0)
        note(ax, f"observed, {seen:.1f} d", (-0.4, seen), (0, 5), color=RED, fontsize=9)
    place, period = np.arange(answer.rung.size), answer.period_solar.values
    ax.step(place, period, where="mid", color=BLUE, lw=1, alpha=0.5)
    error = answer.period_solar_error.values
    ax.errorbar(place, period, error, fmt="o", color=BLUE, ms=6, capsize=3, lw=1.2)
    for at, value, factor in zip(place, period, answer.factor.values, strict=True):
        below = at == place[-1] or factor < 1
        words = f"{value:.1f} d" + (f"\n× {factor:.4f}" if at else "")
        by, side = ((0, -12), "top") if below else ((0, 10), "bottom")
        note(ax, words, (at, value), by, ha="center", va=side)
    ax.set_xticks(place, [str(r) for r in answer.rung.values])
    ax.set_ylabel("period of the free wobble (d)")
    ax.margins(x=0.08, y=0.2)
    ax.grid(axis="x", visible=False)
    return ax
