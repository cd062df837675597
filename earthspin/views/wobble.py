"""Table and figure of the free wobble period from models of increasing detail."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.views import table
from earthspin.views.drawing import BLUE, RED, Axes, PageFigure, axes, note, rungs
from earthspin.views.reading import Result, answer_of, changes_of, section
from earthspin.views.table import Column, Table, table_along


def ladder(tree: Result) -> Table:
    """Table of the free wobble period for each model of the ladder, from rigid to deformable."""
    answer, observed = answer_of(tree), section(tree, "observed")

    def period(row: xr.Dataset) -> str:
        if observed is None or row.rung != answer.rung[-1]:
            return table.measured(row, "period_solar")
        left_out = section(tree, "neglected")
        return table.beside_observed(row.period_solar, row.period_solar_error, left_out)

    notes = [
        "Each rung is a model that adds one effect to the model before; the factor is the ratio of "
        "their periods. The factors depend on the order of the rungs."
    ]
    if "anelastic" in answer.rung.values:
        notes.append(
            "The exponent of anelasticity is a free choice, so the last rung is a check of "
            "consistency, not a prediction."
        )
    if answer.rung.attrs.get("left_out", "none") != "none":
        notes.append(f"Rungs left out: {answer.rung.attrs['left_out']}.")
    more = []
    if observed is not None:
        more.append(("observed", table.measured(observed, "observed_period"), "", "", ""))
        source = observed.observed_period.attrs.get("references", "")
        notes.append(
            f"Source of the observed period: {source}. "
            "The errors hold the uncertainty of the input numbers; that of the last rung, which "
            "stands beside the observed period, holds the sizes of what it leaves out, too, where "
            "they are known."
        )
    columns = (
        Column("period_solar", period, "days of 86400 s"),
        *("period_sidereal:.3f", "factor:.6f"),
        Column("quality_factor", table.quality),
    )
    title = "Free wobble, rung by rung"
    return table_along(answer, "rung", title, columns, " ".join(notes), more=more)


TABLES = [("", ladder)]


def _caption(tree: Result) -> str:
    band = "; the band is the observed period" if section(tree, "observed") is not None else ""
    words = (
        "Period of the free wobble by a series of models, with 95 % errors from sampled inputs "
        f"({table.NUMBERS_ONLY}){band}."
    )
    return " ".join([words, *changes_of(answer_of(tree), "body")])


def plot_ladder(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the wobble period of each model in days, and the observed period as a band.

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
        period, error = float(observed.observed_period), float(observed.observed_period_error)
        ax.axhspan(period - error, period + error, color=RED, alpha=0.3, lw=0)
        note(ax, f"observed, {period:.1f} d", (-0.4, period), (0, 5), color=RED, fontsize=9)
    place, periods = np.arange(answer.rung.size), answer.period_solar.values
    ax.step(place, periods, where="mid", color=BLUE, lw=1, alpha=0.5)
    errors = answer.period_solar_error.values
    ax.errorbar(place, periods, errors, fmt="o", color=BLUE, ms=6, capsize=3, lw=1.2)
    for at, value, factor in zip(place, periods, answer.factor.values, strict=True):
        below = at == place[-1] or factor < 1
        words = f"{value:.1f} d" + (f"\n× {factor:.4f}" if at else "")
        by, side = ((0, -12), "top") if below else ((0, 10), "bottom")
        note(ax, words, (at, value), by, ha="center", va=side)
    ax.set_ylabel("period of the free wobble (d)")
    ax.margins(y=0.2)
    rungs(ax, answer.rung.values)
    return ax


FIGURES = [
    PageFigure("From the rigid to the deformable body", _caption, plot_ladder, uses=["observed"])
]
