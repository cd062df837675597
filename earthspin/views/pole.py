"""Figures and tables of the path of the pole, its comparison with the IAU, and nutation."""

from __future__ import annotations

import numpy as np

from earthspin.bodies import MOON
from earthspin.constants import DAY, DAYS_PER_YEAR
from earthspin.interior.named import CORE_NUTATION
from earthspin.motion.effects import NONRIGID
from earthspin.views import drawing
from earthspin.views.drawing import Axes, Views, axes, note, page_figure
from earthspin.views.result_contents import Result, answer_of, section
from earthspin.views.tables import Column, TextTable, table_along


@page_figure(
    "The path of the pole",
    "Nutation of the figure axis in space; precession, a straight line fitted to its motion, "
    "is removed.",
    applies=lambda tree: "psi" in answer_of(tree),
    phone=5.8,
)
def plot_pole_path(result: Result, *, axis: str = "figure", ax: Axes | None = None) -> Axes:
    """Draw the nutation of an axis: eps over psi sin(eps), each without a straight-line trend.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``pole`` over some years, with psi and eps.
    axis : str
        Which of the three.
    ax : Axes, optional
    """
    ax = axes(ax, 6.4, 6.4)
    answer = answer_of(result).sel(axis=axis)
    days = (answer.time.values - answer.time.values[0]) / np.timedelta64(1, "D")
    angles = np.stack([answer.psi * np.sin(np.radians(answer.eps / 3600)), answer.eps], axis=1)
    turn = 2 * np.pi * days * DAY / MOON.cycle
    design = np.stack([np.ones_like(days), days, np.cos(turn), np.sin(turn)], axis=1)
    line = np.linalg.lstsq(design, angles, rcond=None)[0]
    x, y = (angles - design[:, :2] @ line[:2]).T
    drawing.path_in_time(ax, x, y, days / DAYS_PER_YEAR, "time from the start (years)")
    ax.set_title(f"{axis.replace('_', ' ')} axis")
    ax.set_xlabel("psi sin(eps), straight line removed (arcsec)")
    ax.set_ylabel("eps, straight line removed (arcsec)")
    return ax


# --- comparison with the IAU ---------------------------------------------------------------------


#: Up to here the axis of the budget is linear, mas per century.
LINEAR = 1.0

MODELS = {
    "first-order": "first order, angular-momentum axis",
    "rigid": "all effects that are switched on, figure axis",
    "nonrigid": "the same with the non-rigid response, fitted to IAU 2000A",
    "predicted": "the same with the response predicted from the layers of the body",
    "iau": "IAU 2006/2000A",
}


def budget(tree: Result) -> TextTable:
    """Table of contributions to the precession rate, with the sum and the sum minus IAU 2006."""
    rates = answer_of(tree)

    def rate(name: str, head: str) -> Column:
        return Column(name, lambda row: f"{float(row[name]):+z.3f}" if row[name] else "", head)

    heads = {"psi_rate": "psi_A, mas/cy", "psi_rate_published": "published"}
    columns = [rate(*item) for item in (heads | {"omega_rate": "omega_A, mas/cy"}).items()]
    total, iau, omega = rates.psi_rate_total, rates.psi_rate_iau, rates.omega_rate_total
    closure = f"{float(rates.closure):+z.3f}", "", f"{float(rates.omega_closure):+z.3f}"
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


def _both_angles(name: str) -> Column:
    """Table column that shows a variable's two values: in longitude / in obliquity."""
    return Column(name, lambda row: " / ".join(f"{value:.3f}" for value in row[name].values))


def residuals(tree: Result) -> TextTable:
    """Table of rms and maximum of the computed pole minus the IAU pole, for each set of effects."""
    columns = (
        Column("model", lambda row: MODELS[row.model.item()]),
        *map(_both_angles, ("residual_rms", "residual_maximum", "residual_rms_unfitted")),
    )
    note = (
        "Each cell gives dpsi sin(eps) / deps. A constant and a rate were fitted to each and "
        "removed, except in the last column. The residuals of the first two models are large "
        "because the body is not rigid; no better integration can remove them."
    )
    title = "Computed pole minus that of IAU 2006/2000A"
    return table_along(section(tree, "residual_sizes"), "model", title, columns, note, first="")


def observed(tree: Result) -> TextTable:
    """Table of rms differences from the observed pole, for each computed pole and the IAU pole."""
    sizes = section(tree, "observed")
    columns = (
        Column("model", lambda row: MODELS.get(row.model.item(), row.model.item())),
        *map(_both_angles, ("observed_rms", "observed_rms_without_core", "observed_rms_unfitted")),
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


IAU_TABLES = [("", budget), ("residual_sizes", residuals), ("observed", observed)]


@page_figure(
    "The budget",
    "Contribution of each effect to the rate of psi_A, measured by switching the effect off, "
    "and the published contribution; the axis is logarithmic to both sides of zero. To see: "
    "the two dots of a pair coincide if the computed and the published contribution agree. An "
    "effect without a dot leaves the computed rate as it is, or has no published value; the "
    "first order, thousands of times larger, is in the table. Dashed: the closure, the "
    "unexplained rest.",
)
def plot_budget(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the contribution of each effect to the precession rate, computed and published.

    The axis is linear about zero and logarithmic beyond a milliarcsecond per century, alike to
    both sides.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``iau``.
    ax : Axes, optional
    """
    ax = axes(ax, 7.2, 3.4)
    answer = answer_of(result)
    answer = answer.sel(effect=answer.effect != "first-order")
    place = np.arange(answer.effect.size)
    for by, name, colour, marker, words in (
        (0.14, "psi_rate", drawing.BLUE, "o", "computed"),
        (-0.14, "psi_rate_published", drawing.ORANGE, "D", "published"),
    ):
        # exactly zero if an effect leaves the rate as it is, or has no published value
        drawn = answer[name].values != 0
        sizes, at = answer[name].values[drawn], place[drawn] + by
        ax.hlines(at, 0, sizes, color=colour, lw=0.8, alpha=0.6)
        ax.plot(sizes, at, marker, color=colour, ms=5, label=words)
    closure = float(answer.closure)
    ax.axvline(0, color="0.4", lw=0.8, zorder=0)
    words = drawing.minus(f"closure, {closure:+.1f} mas per century")
    ax.axvline(closure, color=drawing.RED, lw=1, ls="--", label=words)
    ax.set_yticks(place, answer.effect.values)
    ax.invert_yaxis()
    ax.set_xscale("symlog", linthresh=LINEAR)
    reach = 2 * float(abs(answer[["psi_rate", "psi_rate_published"]]).to_array().max())
    ax.set_xlim(-reach, reach)
    words = "contribution to the rate of $\\psi_A$\nbesides the first order (mas per century)"
    ax.set_xlabel(words)
    drawing.legend_above(ax)
    return ax


@page_figure(
    "Residuals in time",
    "X and Y of the computed pole minus those of the IAU; nothing is fitted or removed. "
    "Bands: 95 % intervals.",
    section="residuals",
)
def plot_pole_residuals(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw dX and dY of the computed pole minus the IAU pole over time, without removing a fit.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``iau``; computed again if the section ``residuals`` is missing.
    ax : Axes, optional
        Axes to draw both on; two panels of a new figure by default, of which the first is returned.
    """
    series = section(result, "residuals")
    # the bands of both are almost alike, and would mix in one panel
    panels = [ax, ax] if ax else drawing.stacked(2, 4.8, width=7.5, sharey=True)[1]
    for panel, name, colour in zip(panels, ("dX", "dY"), (drawing.BLUE, drawing.RED), strict=True):
        value, error = series[name], series[f"{name}_error"]
        words = f"{name}, rms {float(np.sqrt(np.mean(value**2))):.2f} mas"
        drawing.band(panel, series.time, value, error, colour, lw=0.6, label=words)
        panel.set_ylabel("dX, dY (mas)" if ax else f"{name} (mas)")
        panel.legend(loc="lower left", ncols=3)
    earth = "" if NONRIGID.name in result.attrs["effects"] else " of a rigid Earth"
    panels[0].set_title(f"computed pole{earth} minus IAU 2006/2000A", loc="left", fontsize=9)
    panels[1].set_xlabel("time (TDB)")
    return panels[0]


@page_figure(
    "Response of the deformable body",
    "Amplitudes of IAU 2000A divided by the rigid amplitudes computed here, and the fitted "
    "resonance formula. The area of a dot grows with the logarithm of its amplitude.",
    section="nutation",
    uses=["core"],
)
def plot_nutation_ratio(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the ratio of IAU 2000A to rigid-body nutation amplitudes, and a fit, over frequency.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``iau``; computed again if its section ``nutation`` or ``core`` is
        missing.
    ax : Axes, optional
    """
    terms, period = section(result, "nutation"), float(section(result, "core").core_nutation_period)
    terms = terms.assign(frequency=DAYS_PER_YEAR / terms.period).sortby("frequency")
    ax = axes(ax, 7.2, 4.2)
    ax.axvline(DAYS_PER_YEAR / period, color="0.6", lw=0.8, ls="--", zorder=0)
    words = drawing.minus(f"free core nutation\n{period:.1f} d")
    note(ax, words, (DAYS_PER_YEAR / period, 1.25), (8, 0), ha="left", color="0.4")
    ax.axhline(1, color="0.8", lw=0.8, zorder=0)
    size = 10 + 25 * np.log10(1 + abs(terms.rigid_in_phase.values))
    words = "IAU 2000A (larger dots: larger terms)"
    ax.scatter(terms.frequency, terms.ratio_in_phase, size, drawing.BLUE, label=words, zorder=3)
    words, fitted = "fitted response", terms.transfer_in_phase
    ax.plot(terms.frequency, fitted, "x", color=drawing.RED, ms=5, label=words, zorder=4)
    ax.set_xscale("symlog", linthresh=0.1)
    ticks = (-27, -2, -0.2, 0, 0.2, 2, 27)
    ax.set_xticks(ticks, [drawing.minus(f"{tick:g}") for tick in ticks])
    words = "frequency in space, negative if retrograde;\nlogarithmic beyond ±0.1 (cycles per year)"
    ax.set_xlabel(words)
    ax.set_ylabel("amplitude over that of a rigid body")
    ax.legend(loc="upper right")
    return ax


# --- nutation of the ladder ----------------------------------------------------------------------


#: Frequencies in space between which the transfer function is shown, cycles per year.
SHOWN = 6.0
#: How far from 1 the transfer function is drawn, on its way to infinity.
BEYOND = 0.6


@page_figure(
    "From a rigid body to half a milliarcsecond",
    "Residuals of each model from IAU 2000A. To see: which effects reduce them most.",
)
def plot_nutation_ladder(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the rms of predicted minus IAU 2000A nutation for each model, on a logarithmic axis.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``nutation``.
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
    ax.set(yscale="log", ylabel="residual from IAU 2000A, rms (mas)")
    ax.margins(y=0.15)
    drawing.rungs(ax, [str(rung).replace("-", "\n") for rung in answer.rung.values])
    ax.legend(loc="upper right")
    return ax


@page_figure(
    "Through the resonance",
    "Ratio of nutation to that of a rigid body. Dots: terms of IAU 2000A divided by rigid "
    "terms. The resonance is the free core nutation.",
    section="transfer",
    uses=["terms"],
)
def plot_transfer(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the nutation transfer function over frequency, and ratios of IAU 2000A to rigid terms.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``nutation``; computed again if its section ``transfer`` or ``terms``
        is missing.
    ax : Axes, optional
    """
    data, main = section(result, "transfer"), section(result, "terms")
    per_year = DAYS_PER_YEAR * 1.00273781191135448
    frequency = data.frequency.values * per_year
    ax = axes(ax, 7.5, 4.2)
    ax.axhline(1, color="0.8", lw=0.8, zorder=0)
    inside = np.abs(frequency) < SHOWN
    for rung, colour, width in (("elastic", "0.6", 1.0), (data.rung.values[-1], drawing.BLUE, 1.4)):
        transfer = data.transfer_real.sel(rung=rung).values
        shown = inside & (np.abs(transfer - 1) < BEYOND)  # no line from pole to pole
        shown[:-1] &= np.diff(np.sign(frequency)) == 0  # nor through rest in space
        drawn = np.ma.masked_where(~shown, transfer)
        ax.plot(frequency, drawn, color=colour, lw=width, label=str(rung))
    ratio = (main.iau_in_phase / main.predicted_in_phase.sel(rung="rigid")).values
    at = DAYS_PER_YEAR / main.period.values
    inside = np.abs(at) < SHOWN
    ax.plot(at[inside], ratio[inside], "o", color=drawing.ORANGE, ms=5, label="IAU 2000A")
    note(ax, "free core nutation", (DAYS_PER_YEAR / CORE_NUTATION.value, 0.9), (-8, 0), ha="right")
    ax.set(ylim=(0.85, 1.45), ylabel="amplitude over that of a rigid body")
    ax.set_xlabel("frequency in space, negative if retrograde (cycles per year)")
    ax.legend(loc="upper right")
    return ax


VIEWS = {
    "pole": Views([plot_pole_path]),
    "iau": Views([plot_pole_residuals, plot_budget, plot_nutation_ratio], tables=IAU_TABLES),
    "nutation": Views([plot_nutation_ladder, plot_transfer]),
}
