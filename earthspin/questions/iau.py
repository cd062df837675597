"""Comparison of the computed pole with the pole of IAU 2006/2000A."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from earthspin.bodies import Body
from earthspin.constants import DAY, DAYS_PER_CENTURY, NORMAL_95
from earthspin.dates import Epochs, datetime64
from earthspin.engine import Neglected, part, public_call
from earthspin.engine.variables import Variables, amplitude, labels, measured, number
from earthspin.motion.axes import error_of_input
from earthspin.motion.effects import EFFECTS, NONRIGID
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation import analysis, rate_budget
from earthspin.nutation.rate_budget import RateBudget, budget_of
from earthspin.progress import progress
from earthspin.questions.effects_and_torques import ATTRACTORS, Attractors
from earthspin.questions.iau_comparison import (
    ARGUMENTS,
    INTERIOR,
    Comparison,
    IAUTerms,
    PoleComparison,
    ResponseFit,
    Shift,
    core_response,
    iau_nutation,
    largest_terms,
    path_over,
    residual_error,
    rigid,
    same_paths,
    steady_figure,
)
from earthspin.questions.observed_pole import ObservedSizes, ObservedSky, observed_sky
from earthspin.questions.reasons import neglected_rates
from earthspin.questions.time_axes import Dated
from earthspin.sky import iau_models
from earthspin.sky.sources import is_measured

if TYPE_CHECKING:
    from earthspin.nutation.response import Response

#: The terms of the nutation table.
LARGEST = 30


class IAU(Comparison, word="iau", call="compare_iau", positional=("start", "stop", "step")):
    """Computed pole compared with IAU 2006/2000A: rates, residuals in time, nutation terms.

    ``earthspin.compare_iau().earthspin.plot()[0]`` draws `dX` and `dY` of the section `residuals`.
    They contain the response of the interior, which is fitted to IAU 2000A; ``effects="rigid"``
    leaves it out.

    Examples
    --------
    >>> import earthspin
    >>> budget = earthspin.compare_iau()
    >>> print((budget.closure * 1e5).round(1).values, "mas per century")
    -3.5 mas per century
    >>> residuals = earthspin.run_tree(budget, sections=["residuals"])["residuals"]
    >>> print(residuals.dX.attrs["long_name"])
    computed X of the celestial pole minus that of IAU 2006/2000A
    >>> print(residuals.dX.attrs["units"], residuals.dX.size, residuals.dX_error.size)
    mas 2923 2923
    """

    page, headline = "pole", "closure"

    def check(self) -> None:
        """Refuse bodies whose position errors are unknown, as the comparison needs these errors."""
        super().check()
        problem = "the error of its positions is not known, and errors are needed; use pole()"
        for member in (self.body, *self.perturbers):
            placed = member.position is None or is_measured(member.position)
            if not placed or member.orbit is not None:
                raise self.error("perturbers", member.name, problem)


# --- the answer: rates effect by effect ----------------------------------------------------------


@part(same_for=same_paths)
def rates_by_effect(
    comparison: PoleComparison, attractors: Attractors, effects: tuple[str, ...]
) -> RateBudget:
    """Compute the contribution of each effect to the precession rates at J2000.0.

    Each effect is switched off in turn.
    """
    on, without = rigid(effects), {}
    with progress("budget", len(on)) as advance:
        for effect in on:
            others = [e for e in on if e != effect]
            path = path_over(attractors, others, comparison.start, comparison.days)
            without[effect] = comparison.analysis.secular(steady_figure(path, comparison.days))
            advance(1)
    # What is off has no share, nor has a transfer function: T = 1 at rest in space.
    off = [effect for effect in EFFECTS if effect not in on]
    u_h = attractors.body.relative_uncertainty.get("dynamical_flattening", 0.0)
    psi_rate = iau_models.precession_rates(0.0).psi_a
    return budget_of(comparison.computed, comparison.iau, without, off, psi_rate, u_h)


_PUBLISHED = "the published table gives no errors"
_ADOPTED = "a model that was adopted, exact by definition"


_rate = partial(number, "arcsec/yr", shown="mas/cy")
_measured_rate = partial(measured, "arcsec/yr", shown="mas/cy")


class EffectRates(Variables, no_error="a measure of error itself"):
    """Contribution of each effect to the rates of psi_A and omega_A; differences from IAU 2006."""

    psi_rate = _measured_rate(
        "contribution to the rate of psi_A at J2000.0: the rate minus that without the effect",
        along=("effect",),
    )
    psi_rate_published = _rate(
        "published contribution; 0 where the table has none",
        along=("effect",),
        no_error=_PUBLISHED,
    )
    omega_rate = _measured_rate("contribution to the rate of omega_A", along=("effect",))
    psi_rate_total = _measured_rate("computed rate of psi_A at J2000.0")
    omega_rate_total = _measured_rate("computed rate of omega_A at J2000.0")
    psi_rate_iau = _rate("rate of psi_A at J2000.0, IAU 2006", no_error=_ADOPTED)
    omega_rate_iau = _rate("rate of omega_A at J2000.0, IAU 2006", no_error=_ADOPTED)
    closure = _rate(
        "computed rate plus the published non-linear term minus the IAU's rate",
        error="psi_rate_total_error",
    )
    omega_closure = _rate(
        "computed rate of omega_A minus the IAU's", error="omega_rate_total_error"
    )
    omega_closure_with_tides = _rate(
        "omega_closure with the published effect of tides in obliquity",
        error="omega_rate_total_error",
    )
    closure_over_flattening = number(
        "1", "closure divided by the change of the rate for one standard deviation of H"
    )
    closure_over_uncertainty = number(
        "1", "closure divided by the combined uncertainty from H and from the analysis"
    )
    psi_rate_analysis_error = _rate(
        "error of the analysis, found from the rate of the IAU's own pole"
    )
    omega_rate_analysis_error = _rate("error of the analysis, found from the IAU's rate of omega_A")
    effect = labels()


@part
def budget(rates_by_effect: RateBudget) -> EffectRates:
    """Collect contributions of effects to the precession rates, and differences from IAU 2006."""
    rates = rates_by_effect
    uncertainty = math.hypot(rates.psi_from_h, rates.psi_rate_analysis_error)
    return EffectRates(
        psi_rate=(list(rates.psi.values()), list(rates.psi_error.values())),
        psi_rate_published=list(rates.psi_published.values()),
        omega_rate=(list(rates.omega.values()), list(rates.omega_error.values())),
        psi_rate_total=(rates.psi_total, rates.psi_error[rate_budget.FIRST_ORDER]),
        omega_rate_total=(rates.omega_total, rates.omega_error[rate_budget.FIRST_ORDER]),
        closure_over_flattening=_ratio(rates.closure, rates.psi_from_h),
        closure_over_uncertainty=_ratio(rates.closure, uncertainty),
        effect=list(rates.psi),
        **{name: getattr(rates, name) for name in EffectRates.fields if hasattr(rates, name)},
    )


def _ratio(closure: float, uncertainty: float) -> float:
    """Ratio of an unexplained rate to its uncertainty; infinite if that uncertainty is zero."""
    return closure / uncertainty if uncertainty else math.copysign(math.inf, closure)


# --- sections ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Differences:
    """Time series of computed pole minus IAU pole in two angles, for different sets of effects.

    The angles are dpsi sin(eps0) in longitude and deps in obliquity.

    Attributes
    ----------
    days : ndarray, shape (t,)
    models : tuple of str
    plain, fitted : ndarray, shape (t, model, 2)
        Without a fit, and after a constant and a rate are removed.
    chosen : int
        Index of the model with the effects that are switched on.
    offsets : ndarray, shape (t, 2)
        X and Y of that model minus those of the IAU, without a fit.
    offset_error : ndarray, shape (t,)
        95 % half-width of either of them: `unfitted_error`, and the response of the interior.
    error : float
        95 % half-width of either angle after the fit: the integration, and H in the nutation.
    fitted_error : float
        The same with the response of the interior, if that is switched on.
    unfitted_error : ndarray, shape (t,)
        The same without a fit, at each time: the precession depends on H, too.
    """

    days: FloatArray
    models: tuple[str, ...]
    plain: FloatArray
    fitted: FloatArray
    chosen: int
    offsets: FloatArray
    offset_error: FloatArray
    error: float
    fitted_error: float
    unfitted_error: FloatArray


@part
def differences(
    comparison: PoleComparison,
    fitted_shift: Shift,
    attractors: Attractors,
    epochs: Epochs,
    effects: tuple[str, ...],
    predicted_shift: Shift | None = None,
) -> Differences:
    """Compute time series of computed pole minus IAU pole, for different sets of effects."""
    days, ends, iau_pole, iau_eta = iau_nutation(attractors, epochs)
    body = attractors.body

    def axes_of(on: list[str], start: FloatArray) -> dict[str, FloatArray]:
        return path_over(attractors, on, start, ends).at(days * DAY, semidiurnal=False)

    def eta_of(pole: FloatArray) -> ComplexArray:
        return analysis.complex_nutation(iau_models.nutation_of(pole, days))

    # Each model as `pole` returns it, start included, but without the semidiurnal motion, which
    # the celestial pole excludes by definition.
    models = {
        "first-order": axes_of([], attractors.start)["angular_momentum"],
        "rigid": axes_of(rigid(effects), attractors.start)["figure"],
    }
    path = path_over(attractors, rigid(effects), comparison.start, ends)
    from_mean_pole = path.at(days * DAY, semidiurnal=False)
    for name, shift in (("nonrigid", fitted_shift), ("predicted", predicted_shift)):
        if shift is not None:
            shifted = dict(from_mean_pole)
            shift.apply(shifted, days)
            models[name] = shifted["figure"]
    chosen = 2 if NONRIGID.name in effects else 1
    residual = np.stack([eta_of(pole) - iau_eta for pole in models.values()], axis=1)
    plain = np.stack([residual.real, residual.imag], axis=-1)
    centuries = days / DAYS_PER_CENTURY
    error = residual_error(comparison, body, iau_eta, days)
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    precession = error_of_input(path, from_mean_pole["figure"], u_h)
    unfitted_error = np.hypot(error, precession)
    response_error = fitted_shift.half_width(days) if chosen == 2 else 0.0
    return Differences(
        days=days,
        models=tuple(models),
        plain=plain,
        fitted=analysis.without_line(centuries, plain.reshape(days.size, -1)).reshape(plain.shape),
        chosen=chosen,
        offsets=([*models.values()][chosen] - iau_pole)[:, :2],
        offset_error=np.hypot(unfitted_error, response_error),
        error=error,
        fitted_error=math.hypot(error, fitted_shift.fitted_residual if chosen == 2 else 0.0),
        unfitted_error=unfitted_error,
    )


_OFFSET = "computed {} of the celestial pole minus that of IAU 2006/2000A"
_NO_SEMIDIURNAL = (
    "without the semidiurnal motion due to triaxiality, which is polar motion by the definition of "
    "the celestial pole"
)
_LINE_REMOVED = "straight line removed"
_LONGITUDE = f"computed pole minus the IAU's in longitude times sin(eps), {_LINE_REMOVED}"
_OBLIQUITY = f"computed pole minus the IAU's in obliquity, {_LINE_REMOVED}"
_HALF_WIDTH = "95 % half-width of a residual, from H and integration"
_UNFITTED_HALF_WIDTH = "95 % half-width of a residual without a fit, from H and integration"


class Residuals(Dated, error="residual_error"):
    """Time series of computed pole minus IAU pole, with and without a fitted trend removed."""

    dX = measured("mas", _OFFSET.format("X"), comment=_NO_SEMIDIURNAL)
    dY = measured("mas", _OFFSET.format("Y"), comment=_NO_SEMIDIURNAL)
    dpsi_sineps = number("mas", _LONGITUDE)
    deps = number("mas", _OBLIQUITY)
    residual_error = number("mas", f"{_HALF_WIDTH}, and the response of the interior", along=())


@part
def residuals(differences: Differences) -> Residuals:
    """Return the time series of computed pole minus IAU pole, for the requested effects."""
    fitted, offsets = differences.fitted[:, differences.chosen], differences.offsets
    return Residuals(
        time=datetime64(differences.days),
        dX=(offsets[:, 0], differences.offset_error),
        dY=(offsets[:, 1], differences.offset_error),
        dpsi_sineps=fitted[:, 0],
        deps=fitted[:, 1],
        residual_error=differences.fitted_error,
    )


class ResidualSizes(Variables, along=("model", "direction"), error="residual_size_error"):
    """Root mean square and maximum of computed minus IAU pole, for different sets of effects."""

    residual_rms = number(
        "mas", "rms of the residuals after removal of a constant and a rate", short="rms"
    )
    residual_maximum = number(
        "mas", "largest residual after removal of a constant and a rate", short="largest"
    )
    residual_rms_unfitted = number(
        "mas",
        "rms of the residuals of the poles as `pole` returns them, without a fit",
        short="rms without a fit",
    )
    residual_size_error = number("mas", _HALF_WIDTH, along=())
    residual_rms_unfitted_error = number("mas", _UNFITTED_HALF_WIDTH, along=())
    model = labels()
    direction = labels(default=["dpsi_sineps", "deps"])


@part
def residual_sizes(differences: Differences) -> ResidualSizes:
    """Compute root mean square and maximum of computed minus IAU pole, for each set of effects."""
    plain, fitted = differences.plain, differences.fitted
    return ResidualSizes(
        residual_rms=np.sqrt(np.mean(fitted**2, axis=0)),
        residual_maximum=np.max(np.abs(fitted), axis=0),
        residual_rms_unfitted=np.sqrt(np.mean(plain**2, axis=0)),
        residual_size_error=differences.error,
        residual_rms_unfitted_error=np.sqrt(np.mean(differences.unfitted_error**2)),
        model=list(differences.models),
    )


@part
def observed(differences: Differences, observed_sky: ObservedSky) -> ObservedSizes:
    """Compute the root mean square of computed minus observed pole, for each set of effects."""
    plain = dict(zip(differences.models, differences.plain.swapaxes(0, 1), strict=True))
    return observed_sky.sizes(plain, differences.error)


_FIT = "part of a fit; left_in_phase and left_out_of_phase are its residuals"


class NutationTerms(IAUTerms):
    """Largest circular nutation terms of the computed pole and of the IAU pole."""

    rigid = amplitude("mas", "computed rigid amplitude", error="amplitude_error")
    ratio = amplitude(
        "1", "ratio of IAU 2000A to the computed rigid amplitude", error="ratio_error"
    )
    ratio_error = number("1", "95 % half-width of the ratio")
    transfer = amplitude(
        "1",
        "fitted resonance formula",
        no_error=_FIT,
        comment="the prograde annual term is not fitted: IAU 2000A includes an atmospheric tide of "
        "0.11 mas there",
    )
    left = amplitude(
        "uas",
        "IAU 2000A minus response times rigid amplitude",
        no_error="a measure of error itself; errors common to both analyses cancel",
    )


@part
def nutation(comparison: PoleComparison, core_response: Response) -> NutationTerms:
    """Compare the thirty largest circular nutation terms of the computed pole and the IAU pole."""
    order, terms = largest_terms(comparison, LARGEST)
    computed, iau = comparison.computed_circles, comparison.iau_circles
    rigid_amplitude, amplitude = computed.amplitude[order], iau.amplitude[order]
    transfer = core_response.transfer(computed.frequency[order])
    ratio = amplitude / rigid_amplitude
    return NutationTerms(
        **terms,
        rigid=analysis.phases(rigid_amplitude),
        ratio=(ratio.real, ratio.imag),
        ratio_error=np.hypot(1, np.abs(ratio)) * terms["amplitude_error"] / np.abs(rigid_amplitude),
        transfer=(transfer.real, transfer.imag),
        left=analysis.phases(amplitude - transfer * rigid_amplitude),
    )


_RESIDUAL = "the size of residuals, a measure of error itself"
_ABSORBING = "the fit to IAU 2000A with its additive terms"


class FittedCore(Variables, no_error="part of a fit; its residuals measure it"):
    """Parameters of the free core nutation from a fit of the resonance formula to IAU 2000A."""

    core_nutation_period = measured(
        "d",
        "period of the free core nutation in space",
        comment="IAU 2000A is the product of a response and a rigid series, so that the fit only "
        "recovers what was built into it; it is no new measurement",
    )
    core_nutation_quality = measured("1", "quality factor of the free core nutation")
    strength_real = number("1", "fitted strength, real part", along=("mode",))
    strength_imaginary = number("1", "fitted strength, imaginary part", along=("mode",))
    core_nutation_period_absorbing = number(
        "d",
        f"period of the free core nutation from {_ABSORBING}",
        no_error="its difference from core_nutation_period shows the effect of these terms",
    )
    response_rms = number(
        "uas", f"root mean square of the residuals of {_ABSORBING}", no_error=_RESIDUAL
    )
    response_maximum = number("uas", f"largest residual of {_ABSORBING}", no_error=_RESIDUAL)
    apart_rms = number(
        "uas",
        "root mean square of the residuals of the fit to IAU 2000A without its additive terms; "
        "the prograde annual term is excluded",
        no_error=_RESIDUAL,
    )
    added_period = number(
        "d",
        "period of the circle in space, negative if retrograde",
        along=("added_to",),
        no_error=ARGUMENTS,
    )
    added = amplitude(
        "uas", "IAU 2000A minus the fitted response", along=("added_to",), error="added_error"
    )
    added_error = number(
        "uas",
        "95 % half-width of an additive term, from the period of the core nutation",
        along=("added_to",),
    )
    added_published = amplitude(
        "uas", "published additive term of IAU 2000A", along=("added_to",), no_error=_PUBLISHED
    )
    mode = labels(default=["constant", "chandler", "core", "inner-core"])
    added_to = labels()


@part
def core(
    comparison: PoleComparison, core_response: Response, response_fit: ResponseFit
) -> FittedCore:
    """Return the parameters of the free core nutation fitted to IAU 2000A, and fit residuals."""
    from earthspin.nutation.response import added_half_width

    residual, added = response_fit.residual, response_fit.added
    response, rows = response_fit.response, np.argsort(-np.abs(added))[: np.count_nonzero(added)]
    computed, iau = comparison.computed_circles, comparison.iau_circles
    without_added = (residual - added)[response_fit.used]
    absorbed = core_response.transfer(computed.frequency) * computed.amplitude
    absorbing = np.abs(iau.amplitude - absorbed)
    return FittedCore(
        core_nutation_period=(response.period, response.period_error),
        core_nutation_quality=(response.quality, response.quality_error),
        strength_real=response.strengths.real,
        strength_imaginary=response.strengths.imag,
        core_nutation_period_absorbing=core_response.period,
        response_rms=float(np.sqrt(np.mean(absorbing**2))),
        response_maximum=float(np.max(absorbing)),
        apart_rms=float(np.sqrt(np.mean(np.abs(without_added) ** 2))),
        added_period=2 * np.pi / computed.frequency[rows],
        added=analysis.phases(residual[rows]),
        added_error=added_half_width(response, computed.frequency[rows], computed.amplitude[rows]),
        added_published=analysis.phases(added[rows]),
        added_to=analysis.term_names(computed.multiples[rows]),
    )


class PrecessionAngles(Variables, along=("angle", "degree")):
    """Polynomial coefficients of the precession angles: computed values and those of IAU 2006."""

    angle_coefficient = number(
        "arcsec",
        "coefficient of (t/century)^degree, computed pole, ecliptic of IAU 2006",
        comment="eps_A, chi_A and p_A need the ecliptic of date, which torques do not give",
    )
    angle_coefficient_iau = number(
        "arcsec",
        "coefficient of (t/century)^degree, IAU 2006, fitted in the same way",
        no_error=_ADOPTED,
    )
    angle_coefficient_error = number(
        "arcsec", "95 % half-width of the computed coefficients, from the analysis and H"
    )
    angle = labels()
    degree = labels("power of time")


@part
def angles(comparison: PoleComparison, body: Body, effects: tuple[str, ...]) -> PrecessionAngles:
    """Fit polynomials to the precession angles of the computed pole and the IAU pole."""
    t, degree = comparison.days / DAYS_PER_CENTURY, analysis.SLOW_DEGREE
    psi, omega = comparison.computed.at(t)
    if NONRIGID.name in effects:  # as in the residuals
        elapsed = t * analysis.CENTURY - comparison.epoch
        psi = psi + rate_budget.published_effects()[NONRIGID.name] * elapsed
    ecliptic = iau_models.ecliptic_of_date(comparison.days)
    # what the analysis makes of the pole of IAU 2006 shows what it misses
    computed, reanalysed = (
        analysis.polynomials(t, analysis.precession_angles(*mean_pole, ecliptic), degree)
        for mean_pole in ((psi, omega), comparison.iau.at(t))
    )
    iau = analysis.polynomials(t, iau_models.precession_angles(comparison.days), degree)
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    of_h = NORMAL_95 * u_h * np.abs(computed) * (np.arange(degree + 1) > 0)
    return PrecessionAngles(
        angle_coefficient=computed,
        angle_coefficient_iau=iau,
        angle_coefficient_error=np.hypot(reanalysed - iau, of_h),
        angle=list(analysis.ANGLES),
        degree=np.arange(degree + 1.0),
    )


class InferredFlattening(Variables, along=("origin",)):
    """Dynamical flattening H and C/(M a2) of the Earth, according to three sources."""

    flattening = measured(
        "1",
        "dynamical flattening H",
        short="H = (C-A)/C",
        comment="PREM gives C from densities, and its H is J2 divided by that C/(M a2); the "
        "observed moment was among its data",
    )
    polar_moment = measured("1", "C/(M a2)", short="C/(M a2)")
    origin = labels()


@part
def inferred_flattening(rates_by_effect: RateBudget, body: Body) -> InferredFlattening:
    """Collect H and C/(M a2) from three sources: the IAU precession rate, literature, and PREM."""
    h, j2, radius = (body.number(name) for name in ("dynamical_flattening", "j2", "radius"))
    u_h, u_j2 = (
        body.relative_uncertainty.get(name, 0.0) for name in ("dynamical_flattening", "j2")
    )
    by_origin = rate_budget.compared_flattenings(rates_by_effect, h, j2, radius, u_h=u_h, u_j2=u_j2)
    values = by_origin.values()
    return InferredFlattening(
        flattening=([v.h for v in values], [NORMAL_95 * v.h_uncertainty for v in values]),
        polar_moment=(
            [v.moment for v in values],
            [NORMAL_95 * v.moment_uncertainty for v in values],
        ),
        origin=list(by_origin),
    )


@part
def neglected(effects: tuple[str, ...]) -> Neglected:
    """Published effects on the rate of psi_A that are switched off or not modelled."""
    # The fitted response acts on nutation; the published non-linear term in the rate has no model.
    return neglected_rates(rigid(effects))


compare_iau = public_call(
    IAU,
    answer=budget,
    sections=(
        residuals,
        residual_sizes,
        observed,
        nutation,
        core,
        angles,
        inferred_flattening,
        neglected,
    ),
    parts=(*ATTRACTORS, rates_by_effect, core_response, *INTERIOR, differences, observed_sky),
)
