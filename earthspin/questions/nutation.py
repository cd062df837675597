"""Nutation of increasingly detailed models of the Earth's interior, compared with IAU 2000A."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np

from earthspin.bodies import Body
from earthspin.constants import DAYS_PER_CENTURY
from earthspin.dates import Epochs
from earthspin.engine import Neglected, part, public_call, setting
from earthspin.engine.variables import Variables, amplitude, labels, measured, number, words
from earthspin.interior.modes import mode_period
from earthspin.interior.named import ANELASTIC_EXPONENT
from earthspin.numerics.arrays import FloatArray
from earthspin.nutation import interior_models
from earthspin.nutation.analysis import complex_nutation, phases, responses, without_line
from earthspin.nutation.interior_models import Spread, spread_of
from earthspin.progress import progress
from earthspin.questions import iau_comparison
from earthspin.questions.effects_and_torques import ATTRACTORS, Attractors
from earthspin.questions.interior_response import SOURCES, Prediction, no_layers, predict
from earthspin.sky import iau_models
from earthspin.units import Number

#: Terms of the table: the largest circles.
LARGEST = 12
#: Days of the series, at least, from which the error of a root mean square is computed.
DAYS_OF_ERRORS = 2000


class NutationLadder(
    iau_comparison.Comparison,
    word="nutation",
    call="nutation_ladder",
    table="nutation",
    positional=("start", "stop", "step"),
):
    """Nutation from a ladder of increasingly detailed models of the Earth's interior.

    Each model (rung) adds one effect to the model before, from a rigid Earth to the layers of the
    `interior` of the body. All models use the observed dynamical flattening H. Only rungs that say
    so contain numbers fitted to nutation.

    Raises
    ------
    SceneError
        If the layers of the body are not known.

    Examples
    --------
    >>> import earthspin
    >>> ladder = earthspin.nutation_ladder()
    >>> print(ladder.rms_deps.round(1).values)
    [21.7 22.5  2.8  2.7  2.   1.9  0.4]
    """

    page, headline = "nutation", "rms_dpsi_sineps"

    coupling: Literal["none", "inferred"] = setting(
        "none",
        doc="coupling at the boundaries of the core, as one more model; its numbers are inferred "
        "from nutation",
    )
    anelastic_exponent: Annotated[float, Number("", "0.09", low=0.0, high=0.2)] = setting(
        ANELASTIC_EXPONENT.value, doc="exponent of frequency in the mantle's quality factor"
    )

    def check(self) -> None:
        """Refuse bodies other than the Earth, and an Earth without known layers."""
        super().check()
        if self.body.labelled:
            raise self.error("body", self.body.name, "give single numbers here, no labelled arrays")
        if why := no_layers(self.body):
            raise self.error("body", self.body.name, f"{why}; leave it out")


@part
def models(body: Body, coupling: str, anelastic_exponent: float) -> Prediction:
    """Build the interior models of the Earth that predict the response to nutation torques."""
    return predict(body, coupling == "inferred", anelastic_exponent)


@part(loads=("scipy.special",))
def interior_spread(models: Prediction) -> Spread:
    """Compute interior models, each with one input changed, and weights for random inputs."""
    return spread_of(models.setting, models.rungs, models.uncertainty)


@part
def residuals(
    comparison: iau_comparison.PoleComparison,
    models: Prediction,
    interior_spread: Spread,
    attractors: Attractors,
    epochs: Epochs,
    effects: tuple[str, ...],
) -> dict[str, FloatArray]:
    """Compute the root mean square of predicted pole minus IAU pole, with errors, for each model.

    The angles are dpsi sin(eps0) and deps after removal of a linear trend; the error is the
    half-width of either from the inputs of the interior, H and integration. All are in rad.
    """
    days, ends, _, iau_eta = iau_comparison.iau_nutation(attractors, epochs)
    figure = iau_comparison.steady_figure(
        iau_comparison.path_over(attractors, effects, comparison.start, ends), days
    )
    computed_eta = complex_nutation(iau_models.nutation_of(figure, days))
    circles, frequency = comparison.computed_circles, comparison.computed_circles.frequency
    factors = {name: models.transfer(name, frequency) - 1 for name in models.rungs}

    def shifts(at: FloatArray) -> FloatArray:
        added = np.array([*responses(circles, iau_models.delaunay_arguments(at), factors).values()])
        return np.stack([added.real, added.imag], axis=-1).swapaxes(0, 1)

    error = iau_comparison.residual_error(comparison, attractors.body, iau_eta, days)
    sampled = slice(None, None, max(1, days.size // DAYS_OF_ERRORS))
    phases = circles.multiples @ iau_models.delaunay_arguments(days[sampled])
    terms = (circles.amplitude[:, np.newaxis] * np.exp(1j * phases)).T
    waves = without_line(days[sampled] / DAYS_PER_CENTURY, np.hstack([terms.real, terms.imag])).T
    products = np.einsum("it,jt->ij", waves, waves)
    residuals = {}
    with progress("residuals", len(factors)) as advance:
        for name, shift in zip(
            factors, iau_models.at_days(shifts, days).swapaxes(0, 1), strict=True
        ):
            eta = computed_eta + shift[:, 0] + 1j * shift[:, 1] - iau_eta
            plain = np.stack([eta.real, eta.imag], axis=1)
            residual = without_line(days / DAYS_PER_CENTURY, plain)
            rms = np.sqrt(np.mean(residual**2, axis=0))
            eta = residual[sampled, 0] + 1j * residual[sampled, 1]
            interior_error = interior_spread.rms_half_width(name, frequency, waves, products, eta)
            residuals[name] = np.array([*rms, math.hypot(error, interior_error)])
            advance(1)
    return residuals


_RMS = "root mean square of computed minus IAU 2000A in"
_LONGITUDE = "longitude times sin(eps), straight line removed"
_OBLIQUITY = "obliquity, straight line removed"
_RMS_ERROR = (
    "95 % half-width of a root mean square, from the inputs of the interior, H and integration"
)
_ADDS = "what the model adds to the one before, or its description"


class RungSizes(Variables, along=("rung",), error="rms_error"):
    """Root mean square of predicted pole minus IAU 2000A, for each interior model (rung)."""

    rms_dpsi_sineps = number(
        "mas",
        f"{_RMS} {_LONGITUDE}",
        references=SOURCES,
        short="dpsi sin(eps)",
        comment="all models use the observed H; those up to 'anelastic' use no other number from "
        "the motion of the pole",
    )
    rms_deps = number("mas", f"{_RMS} {_OBLIQUITY}", short="deps")
    rms_error = number("mas", _RMS_ERROR)
    adds = words(_ADDS, short="what it adds")
    rung = labels()


@part
def rung_sizes(residuals: dict[str, FloatArray], models: Prediction) -> RungSizes:
    """Compute the root mean square of predicted pole minus IAU 2000A, for each interior model."""
    names = models.ladder
    longitude, obliquity, error = np.array([residuals[name] for name in names]).T
    return RungSizes(
        rms_dpsi_sineps=longitude,
        rms_deps=obliquity,
        rms_error=error,
        adds=np.array([interior_models.RUNGS[name] for name in names]),
        rung=names,
    )


class ModelSizes(Variables, along=("model",), error="model_rms_error"):
    """Root mean square of predicted pole minus IAU 2000A, for two further interior models."""

    model_rms_dpsi_sineps = number(
        "mas", f"{_RMS} {_LONGITUDE}", references=SOURCES, short="dpsi sin(eps)"
    )
    model_rms_deps = number("mas", f"{_RMS} {_OBLIQUITY}", short="deps")
    model_rms_error = number("mas", _RMS_ERROR)
    model_adds = words(
        _ADDS,
        short="what it adds",
        comment="the free core nutation of a core in a rigid mantle has a far shorter period; H "
        "in hydrostatic equilibrium is one per cent too small",
    )
    model = labels()


@part
def beside(residuals: dict[str, FloatArray]) -> ModelSizes:
    """Compute the root mean square of predicted pole minus IAU 2000A for two more models.

    They are a fluid core in a rigid mantle, and a body with the H of hydrostatic equilibrium.
    """
    longitude, obliquity, error = np.array([residuals[n] for n in interior_models.COMPARISONS]).T
    return ModelSizes(
        model_rms_dpsi_sineps=longitude,
        model_rms_deps=obliquity,
        model_rms_error=error,
        model_adds=np.array(list(interior_models.COMPARISONS.values())),
        model=list(interior_models.COMPARISONS),
    )


# --- sections ------------------------------------------------------------------------------------


class Terms(iau_comparison.IAUTerms):
    """Amplitudes of the largest circular nutation terms, from each model and from IAU 2000A."""

    predicted = amplitude(
        "mas",
        "predicted amplitude",
        along=("rung", "term"),
        error="predicted_error",
        comment="the half-widths exclude the effects that a model neglects",
    )
    predicted_error = number(
        "mas",
        "95 % half-width of a predicted amplitude, from the parameters of the interior",
        along=("rung", "term"),
    )
    rung = labels()


@part
def terms(
    comparison: iau_comparison.PoleComparison, models: Prediction, interior_spread: Spread
) -> Terms:
    """Compute the largest circular nutation terms of each model, in phase and out of phase."""
    order, columns = iau_comparison.largest_terms(comparison, LARGEST)
    circles, names = comparison.computed_circles, models.ladder
    frequency, rigid = circles.frequency[order], circles.amplitude[order]
    predicted = np.array([models.transfer(name, frequency) * rigid for name in names])
    spread = np.array([interior_spread.transfer_half_width(name, frequency) for name in names])
    spread = spread * np.abs(rigid)
    return Terms(
        **columns,
        predicted=phases(predicted),
        predicted_error=np.hypot(spread, columns["amplitude_error"]),
        rung=names,
    ).with_attributes(predicted_in_phase={"references": SOURCES})


class RungModes(Variables, along=("mode",)):
    """Periods and quality factors of the free modes (wobbles and nutations) of each model."""

    mode_rung = words("model (rung) that has the mode", short="rung")
    mode_name = words("name of the mode", short="mode")
    mode_period = measured(
        "d",
        "period, of a nutation in space (negative if retrograde), of a wobble in the body",
        short="period",
        comment="modes of a region exist only in models with this region; half-widths from the "
        "Love numbers, cores, ocean, anelasticity and numbers inferred from nutation",
    )
    mode_quality = number(
        "1",
        "quality factor of the mode; infinite without dissipation",
        no_error="it follows from published quality factors, which have no errors",
        short="Q",
    )
    mode = labels()


@part
def modes(models: Prediction, interior_spread: Spread) -> RungModes:
    """Compute periods and quality factors of the free modes (wobbles, nutations) of each model."""
    rows = []
    for name in models.ladder:
        half_widths = interior_spread.period_half_widths(name)
        for mode, s in models.rungs[name].modes().items():
            period = mode_period(mode, s, models.setting.spin_rate)
            rows.append((name, mode, period, half_widths[mode], interior_models.quality(s)))
    rungs, names, periods, errors, qualities = zip(*rows, strict=True)
    return RungModes(
        mode_rung=np.array(rungs),
        mode_name=np.array(names),
        mode_period=(np.array(periods), np.array(errors)),
        mode_quality=np.array(qualities),
        mode=[f"{rung} {name}" for rung, name in zip(rungs, names, strict=True)],
    )


#: Frequencies of the transfer function in the body, cycles per rotation: dense about -1.
_IN_SPACE = np.concatenate([-np.geomspace(0.1, 2e-4, 240), np.geomspace(2e-4, 0.1, 240)])


class Transfer(
    Variables,
    along=("rung", "frequency"),
    no_error="the section terms gives errors at the frequencies of nutation",
):
    """Transfer function from rigid to non-rigid nutation, for each model of the ladder."""

    transfer_real = number("1", "ratio of nutation to that of a rigid body, real part")
    transfer_imaginary = number("1", "ratio of nutation to that of a rigid body, imaginary part")
    rung = labels()
    frequency = labels(
        "frequency in space, cycles per rotation of the body", "1", default=_IN_SPACE
    )


@part
def transfer(models: Prediction) -> Transfer:
    """Compute the transfer function of each model, at frequencies that include the resonances."""
    names, e = models.ladder, models.setting.e
    response = np.array([models.rungs[name].transfer(_IN_SPACE - 1, e) for name in names])
    return Transfer(transfer_real=response.real, transfer_imaginary=response.imag, rung=names)


@part
def neglected() -> Neglected:
    """Effects on nutation that even the most detailed model neglects."""
    return Neglected.cited(interior_models.LEFT_OUT, "change of the largest term that is concerned")


nutation_ladder = public_call(
    NutationLadder,
    answer=rung_sizes,
    sections=(beside, terms, modes, transfer, neglected),
    parts=(
        *ATTRACTORS,
        iau_comparison.iau_pole,
        iau_comparison.comparison,
        models,
        interior_spread,
        residuals,
    ),
)
