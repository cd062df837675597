"""Tables and figures of the comparison with IAU 2006/2000A."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.constants import DAYS_PER_YEAR
from earthspin.views import drawing, table
from earthspin.views.drawing import Axes, PageFigure, axes, note
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.table import Column, Table, table_along

#: Up to here the axis of the budget is linear, mas per century.
LINEAR = 1.0

MODELS = {
    "first-order": "first order, angular-momentum axis",
    "rigid": "all effects that are switched on, figure axis",
    "nonrigid": "the same with the non-rigid response, fitted to IAU 2000A",
    "predicted": "the same with the response predicted from the layers of the body",
    "iau": "IAU 2006/2000A",
}


# --- tables --------------------------------------------------------------------------------------


def budget(tree: Result) -> Table:
    """Table of the contributions to the precession rate, their sum, and the difference from IAU."""
    rates = answer_of(tree).map(lambda rate: rate * table.MAS_PER_CENTURY)

    def published(row: xr.Dataset) -> str:
        return f"{float(row.psi_rate_published):+.3f}" if row.psi_rate_published else ""

    columns = (
        Column("psi_rate", "+.3f", "psi_A, mas/cy"),
        Column("psi_rate_published", published, "published"),
        Column("omega_rate", "+.3f", "omega_A, mas/cy"),
    )
    total, iau, omega = rates.psi_rate_total, rates.psi_rate_iau, rates.omega_rate_total
    closure = f"{float(rates.closure):+.3f}", "", f"{float(rates.omega_closure):+.3f}"
    more = [
        ("sum", f"{float(total):.3f}", f"{float(iau):.3f}", f"{float(omega):+.3f}"),
        ("closure (sum + non-linear term - IAU)", *closure),
    ]
    note = (
        "The contribution of each effect is measured by switching it off; the first order is "
        "what remains with all of them off. Published values are from Capitaine, Wallace & "
        "Chapront 2003, table 3; in the row of the sum, from IAU 2006. The closure is the computed "
        "sum plus the published non-linear term minus the IAU rate. H is fixed, not fitted; it "
        "comes from observed precession, so the closure tests consistency, not the theory. The "
        "same analysis of the IAU's own pole differs from its published rate by "
        f"{float(rates.psi_rate_analysis_error):.2f} mas/cy."
    )
    title = "Rates at J2000.0, effect by effect"
    return table_along(rates, "effect", title, columns, note, more=more)


def residuals(tree: Result) -> Table:
    """Table of the rms and maximum of computed minus IAU pole, for different sets of effects."""

    def both(name: str) -> Column:
        return Column(name, lambda row: " / ".join(f"{v:.3f}" for v in row[name].values))

    columns = (
        Column("model", lambda row: MODELS[row.model.item()]),
        *map(both, ("residual_rms", "residual_maximum", "residual_rms_unfitted")),
    )
    note = (
        "Each cell gives dpsi sin(eps) / deps. A constant and a rate were fitted to each and "
        "removed, except in the last column. The residuals of the first two models are large "
        "because the body is not rigid; no better integration can remove them."
    )
    title = "Computed pole minus that of IAU 2006/2000A"
    return table_along(needed(tree, "residual_sizes"), "model", title, columns, note, first="")


def observed(tree: Result) -> Table:
    """Table of the root mean square of computed minus observed pole, for each set of effects."""

    def both(name: str) -> Column:
        return Column(name, lambda row: " / ".join(f"{v:.3f}" for v in row[name].values))

    sizes = needed(tree, "observed")
    columns = (
        Column("model", lambda row: MODELS.get(row.model.item(), row.model.item())),
        *map(both, ("observed_rms", "observed_rms_without_core", "observed_rms_unfitted")),
    )
    note = (
        f"Each cell gives dpsi sin(eps) / deps, root mean square over {int(sizes.observed_dates)} "
        "dates from 1990 on, against the daily offsets of C04. A constant and a rate were fitted "
        "and removed, except in the last column. 'Without FCN' is without the free core nutation "
        "that was fitted to the observed offsets in windows of three years. The noise of the "
        "observations is in every number."
    )
    title = "Models minus the observed celestial pole"
    return table_along(sizes, "model", title, columns, note, first="")


TABLES = [
    ("", budget),
    ("residual_sizes", residuals),
    ("observed", observed),
]


# --- figures -------------------------------------------------------------------------------------


def plot_budget(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the contribution of each effect to the precession rate, computed and published.

    The axis is linear about zero and logarithmic beyond a milliarcsecond per century, alike to
    both sides.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``iau``.
    ax : Axes, optional
    """
    ax = axes(ax, 7.2, 3.4)
    answer = answer_of(result)
    answer = answer.sel(effect=answer.effect != "first-order")
    place = np.arange(answer.effect.size)
    for by, name, colour, marker, words in (
        (0.14, "psi_rate", drawing.BLUE, "o", "measured by switching"),
        (-0.14, "psi_rate_published", drawing.ORANGE, "D", "published"),
    ):
        sizes = answer[name].values * table.MAS_PER_CENTURY
        ax.hlines(place + by, 0, sizes, color=colour, lw=0.8, alpha=0.6)
        ax.plot(sizes, place + by, marker, color=colour, ms=5, label=words)
    closure = float(answer.closure) * table.MAS_PER_CENTURY
    ax.axvline(0, color="0.4", lw=0.8, zorder=0)
    ax.axvline(closure, color=drawing.RED, lw=1, ls="--", label=f"closure, {closure:+.1f}")
    ax.set_yticks(place, answer.effect.values)
    ax.invert_yaxis()
    ax.set_xscale("symlog", linthresh=LINEAR)
    reach = 2 * float(abs(answer[["psi_rate", "psi_rate_published"]]).to_array().max())
    ax.set_xlim(-reach * table.MAS_PER_CENTURY, reach * table.MAS_PER_CENTURY)
    ax.set_xlabel("contribution to the rate of psi_A (mas per century)")
    drawing.legend_above(ax)
    return ax


def plot_pole_residuals(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the computed pole minus the IAU pole over time, in longitude and in obliquity.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``iau``; without its section ``residuals`` it is run again.
    ax : Axes, optional
    """
    series = needed(result, "residuals")
    ax = axes(ax, 7.5, 3)
    offset = series.dpsi_sineps, series.deps
    sizes = (float(np.sqrt(np.mean(part**2))) for part in offset)
    title = f"computed pole minus IAU 2006/2000A; rms {' and '.join(f'{s:.2f}' for s in sizes)} mas"
    drawing.plot_both_angles(ax, series.time, *offset, title, "residual (mas)")
    ax.set_xlabel("time (TDB); constant and rate removed")
    ax.legend(loc="best", ncols=2)
    return ax


def plot_nutation_ratio(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the ratio of IAU 2000A to rigid nutation amplitudes over frequency, and its fit.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``iau``; without its sections ``nutation`` and ``core`` it is run again.
    ax : Axes, optional
    """
    terms, period = needed(result, "nutation"), float(needed(result, "core").core_nutation_period)
    terms = terms.assign(frequency=DAYS_PER_YEAR / terms.period).sortby("frequency")
    ax = axes(ax, 7.2, 4.2)
    ax.axvline(DAYS_PER_YEAR / period, color="0.6", lw=0.8, ls="--", zorder=0)
    words = f"free core nutation\n{period:.1f} d"
    note(ax, words, (DAYS_PER_YEAR / period, 1.25), (8, 0), ha="left", color="0.4")
    ax.axhline(1, color="0.8", lw=0.8, zorder=0)
    size = 10 + 25 * np.log10(1 + abs(terms.rigid_in_phase.values))
    words = "IAU 2000A / rigid"
    ax.scatter(terms.frequency, terms.ratio_in_phase, size, drawing.BLUE, label=words, zorder=3)
    words, fitted = "fitted response", terms.transfer_in_phase
    ax.plot(terms.frequency, fitted, "x", color=drawing.RED, ms=5, label=words, zorder=4)
    ax.set_xscale("symlog", linthresh=0.1)
    ticks = (-27, -2, -0.2, 0, 0.2, 2, 27)
    ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.set_xlabel("frequency in space, negative if retrograde (cycles per year)")
    ax.set_ylabel("IAU 2000A over ours, in phase (ratio)")
    ax.legend(loc="upper right")
    return ax


FIGURES = [
    PageFigure(
        "The budget",
        "Contribution of each effect to the rate of psi_A, measured by switching the effect off, "
        "and the published contribution; the axis is logarithmic to both sides of zero. To see: "
        "where the dots of a pair lie at one place, what is computed agrees with what is "
        "published. Dashed: the closure, what remains of the sum.",
        plot_budget,
    ),
    PageFigure(
        "Residuals in time",
        "The computed pole minus the IAU's; a fitted constant and rate are removed.",
        plot_pole_residuals,
        section="residuals",
    ),
    PageFigure(
        "Response of the deformable body",
        "Amplitudes of IAU 2000A divided by the rigid amplitudes computed here, and the fitted "
        "resonance formula.",
        plot_nutation_ratio,
        section="nutation",
        uses=["core"],
    ),
]
