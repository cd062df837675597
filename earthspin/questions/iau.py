"""Comparison of the computed pole with that of IAU 2006/2000A."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body
from earthspin.constants import DAY, DAYS_PER_CENTURY, NORMAL_95, PUBLISHED_EFFECTS
from earthspin.dates import Span, Step, TimeGrid, TimeList, datetime64
from earthspin.engine.asking import ask
from earthspin.engine.labels import Schema, Variable, build, with_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import key, made_of
from earthspin.motion.effects import EFFECTS, NONRIGID
from earthspin.parts.path import (
    Analysed,
    Apart,
    Shift,
    core_response,
    nonrigid_shift,
    path_over,
    pole_analysis,
    predicted_shift,
    response_apart,
    rigid,
)
from earthspin.parts.predicted import prediction
from earthspin.parts.pulls import Moved, Pulls, pulls, start_of
from earthspin.parts.sky import places, sky, unmeasured
from earthspin.parts.times import DATES, epochs, refuse_what_does_not_fit
from earthspin.progress import progress

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.nutation.budget import Budget
    from earthspin.nutation.response import Response

#: The terms of the nutation table.
LARGEST = 30


class IAU(Moved, word="iau", call="compare_iau", positional=("start", "stop", "step")):
    """Computed pole compared with IAU 2006/2000A: budget, residuals, nutations, angles.

    Returns
    -------
    Dataset
        Over `effect`: `psi_rate`, `psi_rate_published`, `omega_rate` (arcsec/yr, at J2000.0), and
        `closure` (arcsec/yr), after the published non-linear term. `earthspin.run_tree` adds the
        sections: residuals in time, the largest nutations, the free core nutation, the
        angles of precession, and H and C as the IAU's rate implies them.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.

    Examples
    --------
    >>> import earthspin
    >>> budget = earthspin.compare_iau()
    >>> print((budget.closure * 1e5).round(1).values, "mas per century")
    -3.5 mas per century
    """

    span: Span = key(
        ("1980-01-01T12:00:00", "2020-01-01T12:00:00"),
        doc="first and last date of the residuals, TDB",
    )
    step: Step = key("5 d", doc="interval between residuals")

    def check(self) -> None:
        """What is compared to the microarcsecond stands on positions whose error is known."""
        super().check()
        for one in (self.body, *self.perturbers):
            if unmeasured(one) or one.orbit is not None:
                raise self.error(
                    "perturbers",
                    one.name,
                    "how far off its positions are was never measured, and the comparison with "
                    "the IAU gives errors; use pole() for them",
                )


# --- the answer: rates effect by effect ----------------------------------------------------------


@part
def rates_by_effect(
    pole_analysis: Analysed, pulls: Pulls, body: Body, effects: tuple[str, ...]
) -> Budget:
    """Rates at J2000.0 effect by effect, each measured by switching it off."""
    from earthspin.nutation.budget import budget_of
    from earthspin.sky.iau import precession_rates

    done, on = pole_analysis, rigid(effects)
    without = {}
    with progress("budget", len(on)) as advance:
        for effect in on:
            rest = [e for e in on if e != effect]
            path = path_over(body, pulls, rest, done.start, done.days)
            without[effect] = done.analysis.secular(done.pole(path, done.days))
            advance(1)
    # What is off has no share, nor has a transfer function: T = 1 at rest in space.
    off = [effect for effect in EFFECTS if effect not in on]
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    return budget_of(done.ours, done.theirs, without, off, precession_rates(0.0).psi_a, u_h)


_EFFECT = ("effect",)
_PUBLISHED = "the table that it stands in gives none"
_MODEL = "a model that was adopted, exact by definition"
BUDGET = {
    **with_error(
        "psi_rate",
        Variable(
            _EFFECT, "arcsec/yr", "contribution to the rate of psi_A at J2000.0, by switching off"
        ),
    ),
    "psi_rate_published": Variable(
        _EFFECT,
        "arcsec/yr",
        "published contribution; 0 where the table has none",
        no_error=_PUBLISHED,
    ),
    **with_error(
        "omega_rate", Variable(_EFFECT, "arcsec/yr", "contribution to the rate of omega_A")
    ),
    **with_error("psi_rate_total", Variable((), "arcsec/yr", "computed rate of psi_A at J2000.0")),
    **with_error(
        "omega_rate_total", Variable((), "arcsec/yr", "computed rate of omega_A at J2000.0")
    ),
    "psi_rate_iau": Variable(
        (), "arcsec/yr", "rate of psi_A at J2000.0, IAU 2006", no_error=_MODEL
    ),
    "omega_rate_iau": Variable(
        (), "arcsec/yr", "rate of omega_A at J2000.0, IAU 2006", no_error=_MODEL
    ),
    "closure": Variable(
        (),
        "arcsec/yr",
        "computed rate plus the published non-linear term minus the IAU's rate",
        error="psi_rate_total_error",
    ),
    "omega_closure": Variable(
        (), "arcsec/yr", "computed rate of omega_A minus the IAU's", error="omega_rate_total_error"
    ),
    "omega_closure_with_tides": Variable(
        (),
        "arcsec/yr",
        "the same with the published effect of tides in obliquity",
        error="omega_rate_total_error",
    ),
    "closure_over_flattening": Variable(
        (),
        "1",
        "closure over what one standard deviation of H makes of the rate",
        no_error="a measure of error itself",
    ),
    "closure_over_uncertainty": Variable(
        (),
        "1",
        "closure over one standard deviation of H and the error of the analysis together",
        no_error="a measure of error itself",
    ),
    "psi_rate_analysis_error": Variable(
        (), "arcsec/yr", "error of the analysis, found from the rate of the IAU's own pole"
    ),
    "omega_rate_analysis_error": Variable(
        (), "arcsec/yr", "error of the analysis, found from the IAU's rate of omega_A"
    ),
}


@part(gives=BUDGET)
def budget(rates_by_effect: Budget) -> xr.Dataset:
    """Rates effect by effect, the published ones, and the closure."""
    of = rates_by_effect
    return build(
        BUDGET,
        {
            "psi_rate": list(of.psi.values()),
            "psi_rate_error": list(of.psi_error.values()),
            "psi_rate_published": list(of.psi_published.values()),
            "omega_rate": list(of.omega.values()),
            "omega_rate_error": list(of.omega_error.values()),
            "psi_rate_total": of.psi_total,
            "psi_rate_total_error": of.psi_total_error,
            "omega_rate_total": of.omega_total,
            "omega_rate_total_error": of.omega_total_error,
            "psi_rate_iau": of.psi_iau,
            "omega_rate_iau": of.omega_iau,
            "closure": of.closure,
            "omega_closure": of.omega_closure,
            "omega_closure_with_tides": of.omega_closure_with_tides,
            "closure_over_flattening": _over(of.closure, of.psi_from_h),
            "closure_over_uncertainty": _over(
                of.closure, math.hypot(of.psi_from_h, of.psi_analysis_error)
            ),
            "psi_rate_analysis_error": of.psi_analysis_error,
            "omega_rate_analysis_error": of.omega_analysis_error,
        },
        coords={"effect": list(of.psi)},
    )


def _over(closure: float, uncertainty: float) -> float:
    """Ratio; infinite where no uncertainty is known, as of an H of one's own."""
    return closure / uncertainty if uncertainty else math.copysign(math.inf, closure)


# --- sections ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Differences:
    """Our pole less the IAU's in time, for each model, as dpsi sin(eps0) and deps, rad.

    Attributes
    ----------
    days : ndarray, shape (t,)
    models : tuple of str
    plain, fitted : ndarray, shape (t, model, 2)
        As they are, and after a constant and a rate.
    chosen : int
        The model that the effects which are switched on stand for.
    error : float
        95 % half-width of either angle after the fit: the integration, and H in the nutation.
    error_unfitted : float
        The same without a fit, root mean square over the times: the precession depends on H, too.
    """

    days: NDArray[np.float64]
    models: tuple[str, ...]
    plain: NDArray[np.float64]
    fitted: NDArray[np.float64]
    chosen: int
    error: float
    error_unfitted: float


@part
def differences(
    pole_analysis: Analysed,
    nonrigid_shift: Shift,
    pulls: Pulls,
    epochs: TimeGrid | TimeList,
    body: Body,
    effects: tuple[str, ...],
    predicted_shift: Shift | None = None,
) -> Differences:
    """Computed pole minus the IAU's in time, for each model."""
    from earthspin.motion.axes import error_of_input
    from earthspin.nutation.nutation import complex_nutation, without_line
    from earthspin.sky import iau

    refuse_what_does_not_fit(epochs, "choose a longer step or a shorter span")
    done = pole_analysis
    days = epochs.days(0, epochs.size)
    first, last = epochs.span()
    ends = np.array([min(first, 0.0), max(last, 0.0)])
    pulls.sky.check_times(ends, pulls.targets)
    iau_angles = iau.at_days(lambda at: iau.nutation_of(iau.true_pole(at), at), days)
    iau_eta = complex_nutation(iau_angles)

    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)

    own_start, _ = start_of(body, pulls)

    def axes_of(on: list[str], start: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        return path_over(body, pulls, on, start, ends).at(days * DAY, semidiurnal=False)

    def eta_of(pole: NDArray[np.float64]) -> NDArray[np.complex128]:
        return complex_nutation(iau.nutation_of(pole, days))

    # Each model as `pole` returns it, start included.
    models = {
        "first-order": eta_of(axes_of([], own_start)["angular_momentum"]),
        "rigid": eta_of(axes_of(rigid(effects), own_start)["figure"]),
    }
    from_mean_pole = axes_of(rigid(effects), done.start)
    for name, shift in (("nonrigid", nonrigid_shift), ("predicted", predicted_shift)):
        if shift is not None:
            shifted = dict(from_mean_pole)
            shift.apply(shifted, days)
            models[name] = eta_of(shifted["figure"])
    left = np.stack([model - iau_eta for model in models.values()], axis=1)
    plain = np.stack([left.real, left.imag], axis=-1)
    centuries = days / DAYS_PER_CENTURY
    error = math.hypot(done.path.error, NORMAL_95 * u_h * float(np.max(np.abs(iau_eta))))
    precession = error_of_input(done.path, done.path.at(days * DAY)["figure"], u_h)
    return Differences(
        days=days,
        models=tuple(models),
        plain=plain,
        fitted=without_line(centuries, plain.reshape(days.size, -1)).reshape(plain.shape),
        chosen=2 if NONRIGID.name in effects else 1,
        error=error,
        error_unfitted=math.hypot(error, float(np.sqrt(np.mean(precession**2)))),
    )


_HALF_WIDTH = Variable((), "mas", "95 % half-width of a residual, from H and integration")
RESIDUALS = {
    "dpsi_sineps": Variable(
        ("time",),
        "mas",
        "computed pole minus the IAU's in longitude times sin(eps), straight line removed",
        error="residual_error",
    ),
    "deps": Variable(
        ("time",),
        "mas",
        "computed pole minus the IAU's in obliquity, straight line removed",
        error="residual_error",
    ),
    "residual_error": _HALF_WIDTH,
}


@part(gives=RESIDUALS)
def residuals(differences: Differences) -> xr.Dataset:
    """Computed pole minus the IAU's in time, with the effects that are switched on."""
    chosen = differences.fitted[:, differences.chosen]
    return build(
        RESIDUALS,
        {
            "dpsi_sineps": chosen[:, 0],
            "deps": chosen[:, 1],
            "residual_error": differences.error,
        },
        coords=_dates(differences),
    )


_BY_MODEL = {
    "dpsi_sineps_by_model": Variable(
        ("time", "model"),
        "mas",
        "computed pole minus the IAU's in longitude times sin(eps), straight line removed",
        error="error_by_model",
    ),
    "deps_by_model": Variable(
        ("time", "model"),
        "mas",
        "computed pole minus the IAU's in obliquity, straight line removed",
        error="error_by_model",
    ),
    "error_by_model": _HALF_WIDTH,
}


@part(gives=_BY_MODEL)
def residuals_by_model(differences: Differences) -> xr.Dataset:
    """Computed pole minus the IAU's in time, model by model."""
    fitted = differences.fitted
    return build(
        _BY_MODEL,
        {
            "dpsi_sineps_by_model": fitted[..., 0],
            "deps_by_model": fitted[..., 1],
            "error_by_model": differences.error,
        },
        coords=_dates(differences) | {"model": list(differences.models)},
    )


_SIZE = ("model", "direction")
RESIDUAL_SIZES = {
    "residual_rms": Variable(
        _SIZE,
        "mas",
        "root mean square after removal of a constant and a rate",
        error="residual_size_error",
    ),
    "residual_maximum": Variable(
        _SIZE, "mas", "largest after removal of a constant and a rate", error="residual_size_error"
    ),
    "residual_rms_unfitted": Variable(
        _SIZE,
        "mas",
        "root mean square of the poles as `pole` returns them, without a fit",
        error="residual_rms_unfitted_error",
    ),
    "residual_size_error": _HALF_WIDTH,
    "residual_rms_unfitted_error": Variable(
        (), "mas", "95 % half-width of a residual without a fit, from H and integration"
    ),
}


@part(gives=RESIDUAL_SIZES)
def residual_sizes(differences: Differences) -> xr.Dataset:
    """How large the residuals are, model by model."""
    plain, fitted = differences.plain, differences.fitted
    return build(
        RESIDUAL_SIZES,
        {
            "residual_rms": np.sqrt(np.mean(fitted**2, axis=0)),
            "residual_maximum": np.max(np.abs(fitted), axis=0),
            "residual_rms_unfitted": np.sqrt(np.mean(plain**2, axis=0)),
            "residual_size_error": differences.error,
            "residual_rms_unfitted_error": differences.error_unfitted,
        },
        coords={"model": list(differences.models), "direction": ["dpsi_sineps", "deps"]},
    )


def _dates(
    differences: Differences,
) -> dict[str, tuple[str, NDArray[np.datetime64], dict[str, str]]]:

    return {"time": ("time", datetime64(differences.days), dict(DATES))}


_TERM = ("term",)


def _phases(name: str, unit: str, words: str, error: str = "", no_error: str = "") -> Schema:
    """An amplitude as the IERS tabulates it: in phase and out of phase."""
    return {
        f"{name}_{phase}": Variable(
            _TERM, unit, f"{words}, {phase.replace('_', ' ')}", error=error, no_error=no_error
        )
        for phase in ("in_phase", "out_of_phase")
    }


_FIT = "part of a fit; left_in_phase and left_out_of_phase are its residuals"
NUTATION = {
    "period": Variable(
        _TERM,
        "d",
        "period of the circle in space, negative if retrograde",
        no_error="it follows from the adopted arguments of IERS 2003",
    ),
    **_phases("rigid", "mas", "computed rigid amplitude", "amplitude_error"),
    **_phases("iau", "mas", "amplitude of IAU 2000A", "amplitude_error"),
    "amplitude_error": Variable(
        _TERM, "mas", "95 % half-width of an amplitude, without the neighbour's share"
    ),
    "neighbour": Variable(
        _TERM, "", "term that 150 years cannot separate from this one; empty if there is none"
    ),
    **_phases(
        "neighbour",
        "mas",
        "share of the neighbour in the amplitude of IAU 2000A",
        no_error="coefficients of the adopted series",
    ),
    **_phases("ratio", "1", "ratio of IAU 2000A to the computed rigid amplitude", "ratio_error"),
    "ratio_error": Variable(_TERM, "1", "95 % half-width of the ratio"),
    **_phases("transfer", "1", "fitted resonance formula", no_error=_FIT),
    **_phases(
        "left",
        "uas",
        "IAU 2000A minus response times rigid amplitude",
        no_error="a measure of error itself; errors common to both analyses cancel",
    ),
}


@part(gives=NUTATION)
def nutation(pole_analysis: Analysed, core_response: Response) -> xr.Dataset:
    """The thirty largest circular terms of both poles, their ratio, residuals of the response."""
    from earthspin.nutation.neighbours import amplitude_error, neighbours_of
    from earthspin.nutation.nutation import phases
    from earthspin.sky import iau

    ours, theirs = pole_analysis.our_circles, pole_analysis.their_circles
    order = np.argsort(-np.abs(ours.amplitude))[:LARGEST]
    frequency = ours.frequency[order]
    rigid, real = ours.amplitude[order], theirs.amplitude[order]
    transfer = core_response.transfer(frequency)
    at_epoch = iau.delaunay_arguments(np.zeros(1))[:, 0]
    near = neighbours_of(ours.multiples, ours.frequency, iau.delaunay_rates(), at_epoch)
    error, ratio = amplitude_error(frequency), real / rigid
    values: dict[str, NDArray[np.generic] | list[str]] = {
        "period": 2 * np.pi / frequency,
        "amplitude_error": error,
        "neighbour": [near.names[row] for row in order],
        "ratio_in_phase": ratio.real,
        "ratio_out_of_phase": ratio.imag,
        "ratio_error": np.hypot(1, np.abs(ratio)) * error / np.abs(rigid),
        "transfer_in_phase": transfer.real,
        "transfer_out_of_phase": transfer.imag,
    }
    amplitudes = {
        "rigid": rigid,
        "iau": real,
        "neighbour": near.amplitude[order],
        "left": real - transfer * rigid,
    }
    for name, amplitude in amplitudes.items():
        values[f"{name}_in_phase"], values[f"{name}_out_of_phase"] = phases(amplitude)
    return build(NUTATION, values, coords={"term": _labels(ours.multiples[order])})


def _labels(multiples: NDArray[np.int64]) -> list[str]:
    """Multiples of the Delaunay arguments as text."""
    return [" ".join(f"{m:+d}" for m in multiple) for multiple in multiples]


_LEFT = "part of a fit; its residuals measure it"
_ADDED = ("added_to",)
CORE = {
    **with_error(
        "core_nutation_period", Variable((), "d", "period of the free core nutation in space")
    ),
    **with_error(
        "core_nutation_quality", Variable((), "1", "quality factor of the free core nutation")
    ),
    "strength_real": Variable(("mode",), "1", "fitted strength, real part", no_error=_LEFT),
    "strength_imaginary": Variable(
        ("mode",), "1", "fitted strength, imaginary part", no_error=_LEFT
    ),
    "core_nutation_period_absorbing": Variable(
        (),
        "d",
        "the same by the response that absorbs what it can",
        no_error="short of core_nutation_period by what the response absorbs",
    ),
    "response_rms": Variable(
        (),
        "uas",
        "root mean square of the residuals of the response that absorbs what it can",
        no_error=_LEFT,
    ),
    "response_maximum": Variable(
        (), "uas", "largest residual of the response that absorbs what it can", no_error=_LEFT
    ),
    "apart_rms": Variable(
        (),
        "uas",
        "root mean square of the residuals of the response that may not absorb additive terms, "
        "these taken away, the prograde year left out",
        no_error=_LEFT,
    ),
    "added_period": Variable(
        _ADDED,
        "d",
        "period of the circle in space, negative if retrograde",
        no_error="it follows from the adopted arguments of IERS 2003",
    ),
    "added_in_phase": Variable(
        _ADDED, "uas", "IAU 2000A less that response, in phase", error="added_error"
    ),
    "added_out_of_phase": Variable(
        _ADDED, "uas", "IAU 2000A less that response, out of phase", error="added_error"
    ),
    "added_error": Variable(
        _ADDED, "uas", "95 % half-width of what is added, from the period of the core nutation"
    ),
    "added_published_in_phase": Variable(
        _ADDED, "uas", "what its authors add to a response, in phase", no_error=_PUBLISHED
    ),
    "added_published_out_of_phase": Variable(
        _ADDED, "uas", "what its authors add to a response, out of phase", no_error=_PUBLISHED
    ),
}


@part(gives=CORE)
def core(pole_analysis: Analysed, core_response: Response, response_apart: Apart) -> xr.Dataset:
    """Period and quality of the free core nutation recovered from IAU 2000A."""
    from earthspin.nutation.nutation import phases
    from earthspin.nutation.response import added_half_width

    apart, alone = response_apart, response_apart.response
    rows = np.argsort(-np.abs(apart.added))[: np.count_nonzero(apart.added)]
    added_in, added_out = phases(apart.left[rows])
    published_in, published_out = phases(apart.added[rows])
    ours, theirs = pole_analysis.our_circles, pole_analysis.their_circles
    beside = (apart.left - apart.added)[apart.used]
    left = np.abs(theirs.amplitude - core_response.transfer(ours.frequency) * ours.amplitude)
    return build(
        CORE,
        {
            "core_nutation_period": alone.period,
            "core_nutation_period_error": alone.period_error,
            "core_nutation_quality": alone.quality,
            "core_nutation_quality_error": alone.quality_error,
            "strength_real": alone.strengths.real,
            "strength_imaginary": alone.strengths.imag,
            "core_nutation_period_absorbing": core_response.period,
            "response_rms": float(np.sqrt(np.mean(left**2))),
            "response_maximum": float(np.max(left)),
            "apart_rms": float(np.sqrt(np.mean(np.abs(beside) ** 2))),
            "added_period": 2 * np.pi / ours.frequency[rows],
            "added_in_phase": added_in,
            "added_out_of_phase": added_out,
            "added_error": added_half_width(alone, ours.frequency[rows], ours.amplitude[rows]),
            "added_published_in_phase": published_in,
            "added_published_out_of_phase": published_out,
        },
        coords={
            "mode": ["constant", "chandler", "core", "inner-core"],
            "added_to": _labels(ours.multiples[rows]),
        },
    )


_COEFFICIENT = ("angle", "degree")
ANGLES = {
    "angle_coefficient": Variable(
        _COEFFICIENT,
        "arcsec",
        "coefficient of (t/century)^degree, computed pole, ecliptic of IAU 2006",
        error="angle_coefficient_error",
    ),
    "angle_coefficient_iau": Variable(
        _COEFFICIENT,
        "arcsec",
        "coefficient of (t/century)^degree, IAU 2006, fitted in the same way",
        no_error="a model that was adopted, exact by definition",
    ),
    "angle_coefficient_error": Variable(
        _COEFFICIENT,
        "arcsec",
        "95 % half-width of the computed coefficients, from the analysis and H",
    ),
}


@part(gives=ANGLES)
def angles(pole_analysis: Analysed, body: Body) -> xr.Dataset:
    """Polynomials of psi_A, omega_A, eps_A, chi_A and p_A, with the ecliptic of IAU 2006."""
    from earthspin.nutation.angles import ANGLES as NAMES
    from earthspin.nutation.angles import polynomials, precession_angles
    from earthspin.nutation.nutation import SLOW_DEGREE
    from earthspin.sky import iau

    t = pole_analysis.days / DAYS_PER_CENTURY
    ecliptic = iau.ecliptic_of_date(pole_analysis.days)
    # what the analysis makes of the pole of IAU 2006 shows what it misses
    ours, again = (
        polynomials(t, precession_angles(*path.at(t), ecliptic), SLOW_DEGREE)
        for path in (pole_analysis.ours, pole_analysis.theirs)
    )
    theirs = polynomials(t, iau.precession_angles(pole_analysis.days), SLOW_DEGREE)
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    of_h = NORMAL_95 * u_h * np.abs(ours) * (np.arange(SLOW_DEGREE + 1) > 0)
    return build(
        ANGLES,
        {
            "angle_coefficient": ours,
            "angle_coefficient_iau": theirs,
            "angle_coefficient_error": np.hypot(again - theirs, of_h),
        },
        coords={
            "angle": list(NAMES),
            "degree": ("degree", np.arange(SLOW_DEGREE + 1.0), {"long_name": "power of time"}),
        },
    )


INFERRED = {
    **with_error("flattening", Variable(("origin",), "1", "dynamical flattening H")),
    **with_error("polar_moment", Variable(("origin",), "1", "C/(M a2)")),
}


@part(gives=INFERRED)
def inferred_flattening(rates_by_effect: Budget, body: Body) -> xr.Dataset:
    """H and C/(M a2) that the IAU's rate implies, beside the published ones and PREM."""
    from earthspin.nutation import flattening as flat

    h, j2 = body.number("dynamical_flattening"), body.number("j2")
    u = body.relative_uncertainty
    found = flat.compared_flattenings(
        rates_by_effect,
        h,
        j2,
        body.number("radius"),
        u_h=u.get("dynamical_flattening", 0.0),
        u_j2=u.get("j2", 0.0),
    )
    return build(
        INFERRED,
        {
            "flattening": [one.h for one in found.values()],
            "flattening_error": [NORMAL_95 * one.h_uncertainty for one in found.values()],
            "polar_moment": [one.moment for one in found.values()],
            "polar_moment_error": [NORMAL_95 * one.moment_uncertainty for one in found.values()],
        },
        coords={"origin": list(found)},
    )


@part
def neglected(effects: tuple[str, ...]) -> Neglected:
    """Published size of each effect on the rate of psi_A that is off or has no model here."""
    from earthspin.nutation.budget import published_effects

    # The fitted response acts on nutation; the published non-linear term in the rate has no model.
    off = {n: size for n, size in published_effects().items() if n not in rigid(effects)}
    return Neglected(
        off,
        "arcsec/yr",
        "published contribution to the rate that the model leaves out",
        next(iter(PUBLISHED_EFFECTS.values())).source,
    )


made_of(
    IAU,
    answer=budget,
    sections={
        "residuals": residuals,
        "residuals_by_model": residuals_by_model,
        "residual_sizes": residual_sizes,
        "nutation": nutation,
        "core": core,
        "angles": angles,
        "inferred_flattening": inferred_flattening,
        "neglected": neglected,
    },
    parts=(
        places, sky, pulls, epochs, pole_analysis, rates_by_effect, core_response, response_apart,
        nonrigid_shift, prediction, predicted_shift, differences,
    ),
)  # fmt: skip

compare_iau = ask(IAU)
