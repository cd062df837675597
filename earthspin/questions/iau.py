"""Our pole beside that of IAU 2006/2000A."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body
from earthspin.constants import NORMAL_95, PREM_MEAN_MOMENT, PREM_RADIUS, PUBLISHED_EFFECTS
from earthspin.dates import Span, Step, TimeGrid, TimeList, datetime64
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import key, made_of
from earthspin.parts.path import (
    Analysed,
    Shift,
    core_response,
    nonrigid_shift,
    path_over,
    pole_analysis,
    rigid,
)
from earthspin.parts.pulls import ALL_BUT_NONRIGID, NONRIGID, Moved, Pulls, pulls
from earthspin.parts.sky import places, sky
from earthspin.parts.times import DATES, epochs, refuse_what_does_not_fit
from earthspin.progress import progress

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.nutation.response import Response

#: The terms of the nutation table.
LARGEST = 30


class IAU(Moved, word="iau", call="compare_iau", positional=("start", "stop", "step")):
    """Our pole beside that of IAU 2006/2000A: budget, residuals, nutations, angles.

    Returns
    -------
    Dataset
        Over `effect`: `psi_rate`, `psi_rate_published`, `omega_rate` (arcsec/yr, at J2000.0), and
        `closure` (arcsec/yr), after the published non-linear term. `earthspin.run_tree` gives
        sections beside it: residuals in time, the largest nutations, the free core nutation, the
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
    step: Step = key("5 d", doc="time between two residuals")


# --- the answer: rates effect by effect ----------------------------------------------------------


@dataclass(frozen=True)
class Budget:
    """Rates at J2000.0, rad/s, by effect; the first order is the first.

    Attributes
    ----------
    psi, psi_published, omega : dict of str to float
        Contributions.
    psi_total, omega_total : float
        Ours.
    closure : float
        Of psi, after the published non-linear term.
    psi_analysis_error, omega_analysis_error : float
        By what the analysis misses the rates of the IAU's own pole.
    """

    psi: dict[str, float]
    psi_published: dict[str, float]
    omega: dict[str, float]
    psi_total: float
    omega_total: float
    closure: float
    psi_analysis_error: float
    omega_analysis_error: float


@part
def rates_by_effect(
    pole_analysis: Analysed, pulls: Pulls, body: Body, effects: tuple[str, ...]
) -> Budget:
    """Rates at J2000.0 effect by effect, each measured by switching it off."""
    from earthspin.nutation import budget as book
    from earthspin.sky.iau import precession_rates

    done, on = pole_analysis, rigid(effects)
    psi: dict[str, float] = {}
    omega: dict[str, float] = {}
    with progress("budget", len(on)) as advance:
        for effect in on:
            rest = [e for e in on if e != effect]
            path = path_over(body, pulls, rest, done.start, done.days)
            without = done.analysis.secular(done.pole(path, done.days))
            psi[effect], omega[effect] = without.psi_rate, without.omega_rate
            advance(1)
    # What is off has no share, nor has a transfer function: T = 1 at rest in space.
    none = {e: 0.0 for e in (*ALL_BUT_NONRIGID, NONRIGID) if e not in on}
    psi_by_effect = book.contributions(done.ours.psi_rate, psi) | none
    iau_rate = precession_rates(0.0).psi_a
    return Budget(
        psi=psi_by_effect,
        psi_published=book.published_contributions(list(psi_by_effect)),
        omega=book.contributions(done.ours.omega_rate, omega) | none,
        psi_total=done.ours.psi_rate,
        omega_total=done.ours.omega_rate,
        closure=book.full_closure(done.ours.psi_rate, iau_rate),
        psi_analysis_error=abs(done.theirs.psi_rate - iau_rate),
        omega_analysis_error=abs(done.theirs.omega_rate - book.iau_omega_rate()),
    )


_EFFECT = ("effect",)
BUDGET = {
    "psi_rate": Variable(
        _EFFECT, "arcsec/yr", "contribution to the rate of psi_A at J2000.0, by switching"
    ),
    "psi_rate_published": Variable(
        _EFFECT, "arcsec/yr", "published contribution; 0 where the table has none"
    ),
    "omega_rate": Variable(_EFFECT, "arcsec/yr", "contribution to the rate of omega_A"),
    "psi_rate_total": Variable((), "arcsec/yr", "our rate of psi_A at J2000.0"),
    "omega_rate_total": Variable((), "arcsec/yr", "our rate of omega_A at J2000.0"),
    "psi_rate_iau": Variable((), "arcsec/yr", "rate of psi_A at J2000.0, IAU 2006"),
    "omega_rate_iau": Variable((), "arcsec/yr", "rate of omega_A at J2000.0, IAU 2006"),
    "closure": Variable(
        (), "arcsec/yr", "our rate plus the published non-linear term less the IAU's"
    ),
    "omega_closure": Variable((), "arcsec/yr", "our rate of omega_A less the IAU's"),
    "psi_rate_analysis_error": Variable(
        (), "arcsec/yr", "by what the analysis misses the rate of the IAU's own pole"
    ),
    "omega_rate_analysis_error": Variable(
        (), "arcsec/yr", "by what the analysis misses the IAU's rate of omega_A"
    ),
}


@part(gives=BUDGET)
def budget(rates_by_effect: Budget) -> xr.Dataset:
    """Rates effect by effect, beside the published ones; the closure."""
    from earthspin.nutation.budget import iau_omega_rate
    from earthspin.sky.iau import precession_rates

    of = rates_by_effect
    return build(
        BUDGET,
        {
            "psi_rate": list(of.psi.values()),
            "psi_rate_published": list(of.psi_published.values()),
            "omega_rate": list(of.omega.values()),
            "psi_rate_total": of.psi_total,
            "omega_rate_total": of.omega_total,
            "psi_rate_iau": precession_rates(0.0).psi_a,
            "omega_rate_iau": iau_omega_rate(),
            "closure": of.closure,
            "omega_closure": of.omega_total - iau_omega_rate(),
            "psi_rate_analysis_error": of.psi_analysis_error,
            "omega_rate_analysis_error": of.omega_analysis_error,
        },
        coords={"effect": list(of.psi)},
    )


# --- sections ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Differences:
    """Our pole less the IAU's in time, for three models, as dpsi sin(eps0) and deps, rad.

    Attributes
    ----------
    days : ndarray, shape (t,)
    models : tuple of str
    plain, fitted : ndarray, shape (t, model, 2)
        As they are, and after a constant and a rate.
    chosen : int
        The model that the effects which are switched on stand for.
    """

    days: NDArray[np.float64]
    models: tuple[str, ...]
    plain: NDArray[np.float64]
    fitted: NDArray[np.float64]
    chosen: int


@part
def differences(
    pole_analysis: Analysed,
    nonrigid_shift: Shift,
    pulls: Pulls,
    epochs: TimeGrid | TimeList,
    body: Body,
    effects: tuple[str, ...],
) -> Differences:
    """Our pole less the IAU's in time, for three models."""
    from earthspin.nutation.nutation import complex_nutation, without_line
    from earthspin.sky import iau

    refuse_what_does_not_fit(epochs, "choose a longer step or a shorter span")
    done, sky = pole_analysis, pulls.sky
    days = epochs.days(0, epochs.size)
    first, last = epochs.span()
    ends = np.array([min(first, 0.0), max(last, 0.0)])
    sky.ephemeris.check_times(ends[[0, 1]], {*pulls.targets.values(), sky.centre})
    iau_eta = complex_nutation(iau.nutation_of(iau.true_pole(days), days))

    def eta_of(on: list[str], axis: str) -> NDArray[np.complex128]:
        path = path_over(body, pulls, on, done.start, ends)
        return complex_nutation(iau.nutation_of(done.pole(path, days, axis), days))

    ours = eta_of(rigid(effects), "figure")
    models = {
        "first-order": eta_of([], "angular_momentum"),
        "rigid": ours,
        "nonrigid": ours + nonrigid_shift.eta(days),
    }
    left = np.stack([model - iau_eta for model in models.values()], axis=1)
    plain = np.stack([left.real, left.imag], axis=-1)
    return Differences(
        days=days,
        models=tuple(models),
        plain=plain,
        fitted=without_line(days / 36525.0, plain.reshape(days.size, -1)).reshape(plain.shape),
        chosen=2 if NONRIGID in effects else 1,
    )


RESIDUALS = {
    "dpsi_sineps": Variable(
        ("time",), "mas", "our pole less the IAU's in longitude times sin(eps), line removed"
    ),
    "deps": Variable(("time",), "mas", "our pole less the IAU's in obliquity, line removed"),
}


@part(gives=RESIDUALS)
def residuals(differences: Differences) -> xr.Dataset:
    """Our pole less the IAU's in time, with the effects that are switched on."""
    chosen = differences.fitted[:, differences.chosen]
    return build(
        RESIDUALS,
        {"dpsi_sineps": chosen[:, 0], "deps": chosen[:, 1]},
        coords=_dates(differences),
    )


_BY_MODEL = {
    "dpsi_sineps_by_model": Variable(
        ("time", "model"), "mas", "the same in longitude, for three models"
    ),
    "deps_by_model": Variable(("time", "model"), "mas", "the same in obliquity, for three models"),
}


@part(gives=_BY_MODEL)
def residuals_by_model(differences: Differences) -> xr.Dataset:
    """Our pole less the IAU's in time, model by model."""
    fitted = differences.fitted
    return build(
        _BY_MODEL,
        {"dpsi_sineps_by_model": fitted[..., 0], "deps_by_model": fitted[..., 1]},
        coords=_dates(differences) | {"model": list(differences.models)},
    )


_SIZE = ("model", "direction")
RESIDUAL_SIZES = {
    "residual_rms": Variable(_SIZE, "mas", "root mean square after constant and rate"),
    "residual_maximum": Variable(_SIZE, "mas", "largest after constant and rate"),
    "residual_rms_unfitted": Variable(_SIZE, "mas", "root mean square with nothing fitted"),
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
        },
        coords={"model": list(differences.models), "direction": ["dpsi_sineps", "deps"]},
    )


def _dates(
    differences: Differences,
) -> dict[str, tuple[str, NDArray[np.datetime64], dict[str, str]]]:

    return {"time": ("time", datetime64(differences.days), dict(DATES))}


_TERM = ("term",)
NUTATION = {
    "period": Variable(_TERM, "d", "period of the circle in space, negative if retrograde"),
    "rigid_in_phase": Variable(_TERM, "mas", "our rigid amplitude, in phase"),
    "rigid_out_of_phase": Variable(_TERM, "mas", "our rigid amplitude, out of phase"),
    "iau_in_phase": Variable(_TERM, "mas", "amplitude of IAU 2000A, in phase"),
    "iau_out_of_phase": Variable(_TERM, "mas", "amplitude of IAU 2000A, out of phase"),
    "ratio_in_phase": Variable(_TERM, "1", "IAU 2000A over ours, real part"),
    "ratio_out_of_phase": Variable(_TERM, "1", "IAU 2000A over ours, imaginary part"),
    "transfer_in_phase": Variable(_TERM, "1", "fitted resonance form, real part"),
    "transfer_out_of_phase": Variable(_TERM, "1", "fitted resonance form, imaginary part"),
    "left_in_phase": Variable(_TERM, "uas", "IAU less response times ours, in phase"),
    "left_out_of_phase": Variable(_TERM, "uas", "IAU less response times ours, out of phase"),
}


@part(gives=NUTATION)
def nutation(pole_analysis: Analysed, core_response: Response) -> xr.Dataset:
    """The thirty largest circular terms of both poles, their ratio, what the response leaves."""
    from earthspin.nutation.nutation import phases

    ours, theirs = pole_analysis.our_circles, pole_analysis.their_circles
    order = np.argsort(-np.abs(ours.amplitude))[:LARGEST]
    rigid, real = ours.amplitude[order], theirs.amplitude[order]
    transfer = core_response.transfer(ours.frequency[order])
    ratio = real / rigid
    values: dict[str, NDArray[np.float64]] = {
        "period": 2 * np.pi / ours.frequency[order],
        "ratio_in_phase": ratio.real,
        "ratio_out_of_phase": ratio.imag,
        "transfer_in_phase": transfer.real,
        "transfer_out_of_phase": transfer.imag,
    }
    for name, amplitude in (("rigid", rigid), ("iau", real), ("left", real - transfer * rigid)):
        values[f"{name}_in_phase"], values[f"{name}_out_of_phase"] = phases(amplitude)
    labels = [" ".join(f"{m:+d}" for m in multiple) for multiple in ours.multiples[order]]
    return build(NUTATION, values, coords={"term": labels})


CORE = {
    "core_nutation_period": Variable((), "d", "period of the free core nutation in space"),
    "core_nutation_quality": Variable((), "1", "quality factor of the free core nutation"),
    "strength_real": Variable(("mode",), "1", "fitted strength, real part"),
    "strength_imaginary": Variable(("mode",), "1", "fitted strength, imaginary part"),
    "response_rms": Variable((), "uas", "root mean square of what the response leaves"),
    "response_maximum": Variable((), "uas", "largest that the response leaves"),
}


@part(gives=CORE)
def core(pole_analysis: Analysed, core_response: Response) -> xr.Dataset:
    """Period and quality of the free core nutation recovered from IAU 2000A."""
    ours, theirs = pole_analysis.our_circles, pole_analysis.their_circles
    left = theirs.amplitude - core_response.transfer(ours.frequency) * ours.amplitude
    return build(
        CORE,
        {
            "core_nutation_period": core_response.period,
            "core_nutation_quality": core_response.quality,
            "strength_real": core_response.strengths.real,
            "strength_imaginary": core_response.strengths.imag,
            "response_rms": float(np.sqrt(np.mean(np.abs(left) ** 2))),
            "response_maximum": float(np.max(np.abs(left))),
        },
        coords={"mode": ["constant", "chandler", "core", "inner-core"]},
    )


ANGLES = {
    name: Variable(("angle", "degree"), "arcsec", f"coefficient of (t/century)^degree, {whose}")
    for name, whose in (
        ("angle_coefficient", "our pole on the ecliptic of IAU 2006"),
        ("angle_coefficient_iau", "IAU 2006, fitted alike"),
    )
}


@part(gives=ANGLES)
def angles(pole_analysis: Analysed) -> xr.Dataset:
    """Polynomials of psi_A, omega_A, eps_A, chi_A and p_A, with the ecliptic of IAU 2006."""
    from earthspin.nutation.angles import ANGLES as NAMES
    from earthspin.nutation.angles import polynomials, precession_angles
    from earthspin.nutation.nutation import SLOW_DEGREE
    from earthspin.sky import iau

    t = pole_analysis.days / 36525.0
    psi, omega = pole_analysis.ours.at(t)
    ours = precession_angles(psi, omega, iau.ecliptic_of_date(pole_analysis.days))
    theirs = iau.precession_angles(pole_analysis.days)
    return build(
        ANGLES,
        {
            "angle_coefficient": polynomials(t, ours, SLOW_DEGREE),
            "angle_coefficient_iau": polynomials(t, theirs, SLOW_DEGREE),
        },
        coords={
            "angle": list(NAMES),
            "degree": ("degree", np.arange(SLOW_DEGREE + 1.0), {"long_name": "power of time"}),
        },
    )


INFERRED = {
    "flattening": Variable(("origin",), "1", "dynamical flattening H"),
    "flattening_error": Variable(
        ("origin",), "1", "95 % half-width of the dynamical flattening H, where it is known"
    ),
    "polar_moment": Variable(("origin",), "1", "C/(M a2)"),
}


@part(gives=INFERRED)
def inferred_flattening(rates_by_effect: Budget, body: Body) -> xr.Dataset:
    """H and C/(M a2) that the IAU's rate implies, beside the published ones and PREM."""
    from earthspin.nutation import flattening as flat

    of = rates_by_effect
    h, j2 = body.number("dynamical_flattening"), body.number("j2")
    compared = [e for e in of.psi if e in flat.COMPARED]
    spread = float(np.sqrt(sum((of.psi[e] - of.psi_published[e]) ** 2 for e in compared)))
    # Geodesic precession alone does not grow with H.
    grows = sum(rate for effect, rate in of.psi.items() if effect != "geodesic")
    new = flat.inferred_h(h, grows, of.closure)
    u = flat.inferred_h_uncertainty(h, grows, spread, of.psi_analysis_error)
    u_h = h * body.relative_uncertainty.get("dynamical_flattening", 0.0)
    prem = flat.polar_moment_from_mean(
        PREM_MEAN_MOMENT.value, PREM_RADIUS.value, body.number("radius"), j2
    )
    moments = [flat.polar_moment_from_h(j2, h), flat.polar_moment_from_h(j2, new), prem]
    return build(
        INFERRED,
        {
            "flattening": [h, new, j2 / prem],
            "flattening_error": [NORMAL_95 * u_h, NORMAL_95 * u, 0.0],
            "polar_moment": moments,
        },
        coords={"origin": ["published", "from the IAU's rate", "PREM"]},
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
        places, sky, pulls, epochs, pole_analysis, rates_by_effect, core_response, nonrigid_shift,
        differences,
    ),
)  # fmt: skip

compare_iau = ask(IAU)
