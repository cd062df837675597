"""Free wobble period from models between rigid and deformable, and its sensitivity to inputs.

A rung is a model that adds one effect to the model before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Literal

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import EARTH, Body, NumberName, Numeric, all_of, checks
from earthspin.constants import DAY
from earthspin.engine import Neglected, Question, key, part, public_call, setting
from earthspin.engine.variables import Variables, measured, number, words
from earthspin.interior.named import ANELASTIC_EXPONENT, EXPONENT_RANGE, Interior
from earthspin.questions import interior_response, reasons
from earthspin.rotor.axisymmetric import free_wobble_error
from earthspin.units import Number
from earthspin.wobble import ladder, propagation

_FIGURE: tuple[NumberName, ...] = ("dynamical_flattening", "j2", "triaxiality")
_SPIN: tuple[NumberName, ...] = ("gm", "radius", "spin_period")
#: Keys that describe the interior, and the inputs of the ladder that they set.
_KEYS = ("k2", "core_fraction", "core_ellipticity", "ocean_love_number", "anelastic_exponent")
_INTERIOR = {name: name for name in _KEYS} | {"ocean_love_number": "ocean"}


class Wobble(Question, word="wobble", call="wobble_ladder", table="wobble"):
    """Period of the free wobble, by models from rigid to deformable (source text, I.6).

    Each model (rung) adds one effect to the model before. The `interior` of the body determines the
    last model.

    The rungs are flattening, rigid, triaxial, elastic, fluid-core, ocean and anelastic.

    Examples
    --------
    >>> import earthspin
    >>> print(earthspin.wobble_ladder().period_solar.round(1).values)
    [297.4 303.6 303.6 444.4 393.9 423.7 431.6]
    """

    page, headline = "wobble", "period_solar"

    body: Body = key(EARTH, doc="body that wobbles")
    ocean: Literal["real", "global", "none"] = setting("real", doc="kind of ocean on the body")
    anelastic_exponent: Annotated[float, Number("", "0.09", low=0.0, high=0.2)] = setting(
        ANELASTIC_EXPONENT.value,
        doc="exponent of frequency in the mantle's quality factor; observed decay allows 0.04 to "
        "0.19 (Smith & Dahlen 1981)",
    )
    # a body that is liquid throughout and of even density has k2 = 3/2
    k2: Annotated[float, Number("", "0.298", low=0.0, high=1.5)] | None = setting(
        None, doc="elastic Love number, instead of that of the interior"
    )
    core_fraction: Annotated[float, Number("", "0.11", low=0.0, high=1.0)] | None = setting(
        None, doc="moment of inertia of the core over that of the body, instead of the interior's"
    )
    # (C - A)/A of any body is between that of a needle, -1, and that of a thin disc, 1
    core_ellipticity: Annotated[float, Number("", "0.0026", low=-1.0, high=1.0)] | None = setting(
        None, doc="(C - A)/A of the core, instead of the interior's"
    )
    ocean_love_number: Annotated[float, Number("", "0.047", low=0.0, high=1.5)] | None = setting(
        None, doc="increase of k2 by the ocean, instead of the interior's; the ocean must be on"
    )

    def check(self) -> None:
        """Refuse a body without mass or figure, and inputs that do not fit its interior."""
        if not all_of(self.body.gm > 0):
            raise self.error("body", self.body.name, "the mass of a body that spins is not zero")
        self.body.require(("radius", "j2", "dynamical_flattening", "flattening", "spin_period"))
        checks.refuse_break_up(self.body)
        interior_response.refuse_unknown(self, self.body)
        rigid = why_rigid(self.body)
        interior = None if rigid else interior_response.interior_of(self.body)
        for name, field in _INTERIOR.items():
            value = getattr(self, name)
            if rigid and field != "anelastic_exponent" and value is not None:
                raise self.error(name, value, f"the body is rigid: {rigid}")
        dry = self.ocean == "none" or (interior is not None and interior.ocean is None)
        if self.ocean_love_number is not None and dry:
            raise self.error("ocean_love_number", self.ocean_love_number, "the body has no ocean")

    def published_inputs(self) -> Mapping[str, tuple[str, tuple[float, float]]]:
        """Published distributions of the interior parameters, from which ensembles take samples."""
        if why_rigid(self.body) or self.body.labelled:
            return {}
        ranges: dict[str, tuple[str, tuple[float, float]]] = {}
        state = inputs(**{name: getattr(self, name) for name in ("body", "ocean", *_INTERIOR)})
        for name, field in _INTERIOR.items():
            value = float(getattr(state.numbers, field))
            if field == "anelastic_exponent":
                if state.interior.layers is not None:
                    ranges[name] = ("uniform", EXPONENT_RANGE)
            elif value and field in state.interior.relative_uncertainty:
                u = state.interior.relative_uncertainty[field]
                ranges[name] = ("normal", (value, abs(value) * u))
        return ranges


def why_rigid(body: Body) -> str | None:
    """Return the reason (text) to omit non-rigid models if they do not apply, else None."""
    interior = interior_response.interior_of(body)
    if interior is None:
        return f"{interior_response.no_interior(body)}; set body.interior"
    if not all_of(body.needed("dynamical_flattening") > 0):
        return "models with an interior are for oblate bodies"
    return (
        None
        if interior.layers is None
        else interior_response.of_another_body(interior.layers, body)
    )


# --- inputs of the models ------------------------------------------------------------------------


@dataclass(frozen=True)
class ModelInputs:
    """Inputs of the non-rigid models of the free wobble, as arrays of one shape.

    Attributes
    ----------
    numbers, spin, interior
        As `earthspin.wobble.ladder.non_rigid` takes them.
    ocean : str
    dims : tuple of str
        Names of the arrays' dimensions.
    uncertainty : mapping of str to float
        One standard deviation over value, of the body's numbers and the interior's.
    """

    numbers: ladder.Inputs
    spin: ladder.Rotator
    interior: Interior
    ocean: str
    dims: tuple[str, ...]
    uncertainty: Mapping[str, float]

    @property
    def setting(self) -> tuple[ladder.Rotator, Interior, str]:
        """Return spin, interior and ocean, the arguments that all non-rigid models take."""
        return self.spin, self.interior, self.ocean

    def label(self, value: Numeric) -> xr.DataArray:
        """Convert an array with one value per body to a DataArray with dimensions of the inputs."""
        array = np.asarray(value)
        return xr.DataArray(array, dims=self.dims[len(self.dims) - array.ndim :])

    def stack(self, values: Mapping[str, Numeric], dim: str) -> xr.DataArray:
        """Stack arrays with one value per body along a new dimension, labelled by name."""
        return _stacked({name: self.label(value) for name, value in values.items()}, dim)


@part(unless=why_rigid)
def inputs(
    body: Body,
    ocean: str,
    anelastic_exponent: Numeric,
    k2: Numeric | None = None,
    core_fraction: Numeric | None = None,
    core_ellipticity: Numeric | None = None,
    ocean_love_number: Numeric | None = None,
) -> ModelInputs:
    """Collect the inputs of the non-rigid wobble models: figure, interior and ocean of the body."""
    interior = interior_response.interior_of(body)
    assert interior is not None
    keys = (k2, core_fraction, core_ellipticity, ocean_love_number, anelastic_exponent)
    pairs = zip(_INTERIOR.values(), keys, strict=True)
    changes = {name: value for name, value in pairs if value is not None}
    values = {name: body.needed(name) for name in (*_FIGURE, *_SPIN)} | changes
    arrays = xr.broadcast(*map(xr.DataArray, values.values()))
    values = {name: array.values for name, array in zip(values, arrays, strict=True)}
    spin = ladder.Rotator(*(values.pop(name) for name in _SPIN))
    changes = {name: values.pop(name) for name in changes}
    numbers = replace(ladder.inputs_of(interior, spin, values, ocean), **changes)
    uncertainty = {**interior.relative_uncertainty, **body.relative_uncertainty}
    dims = tuple(map(str, arrays[0].dims))
    return ModelInputs(numbers, spin, interior, ocean, dims, uncertainty)


# --- the answer ------------------------------------------------------------------------------


class Rungs(Variables, along=("rung",)):
    """Period of the free wobble from each model of the ladder, from rigid to deformable."""

    period_solar = measured("d", "period of the free wobble in days of 86400 s")
    period_sidereal = measured(
        "1",
        "period of the free wobble in turns of the body, its sidereal days",
        short="sidereal days",
    )
    factor = number(
        "1",
        "ratio of the period to that of the model before",
        no_error="the errors of both periods are correlated, and were not propagated to the ratio",
    )
    quality_factor = number(
        "1",
        "quality factor of the free wobble",
        comment="infinite without dissipation; the exponent of anelasticity is a free choice, "
        "so the anelastic rung is a check of consistency, not a prediction",
        short="Q",
        no_error="it follows from published quality factors, which have no errors",
    )
    rung_formula = words("formula for the turns of the body per wobble, with its source")


@part
def wobble_rungs(body: Body, inputs: ModelInputs | None = None) -> Rungs:
    """Compute the free wobble period for each model of the ladder, from rigid to deformable."""
    h, j2 = body.needed("dynamical_flattening"), body.needed("j2")
    turns = ladder.rigid_periods(body.needed("flattening"), h, j2, body.triaxiality)
    quality: dict[str, Numeric] = dict.fromkeys(turns, np.inf)
    left_out = dict.fromkeys(ladder.RUNGS[3:], why_rigid(body) or "")
    spread = _rigid_spread(body, turns)
    if inputs is not None:
        numbers, uncertainty, setting = inputs.numbers, inputs.uncertainty, inputs.setting
        models = ladder.non_rigid(numbers, *setting)
        left_out = models.left_out
        sampled = propagation.sampled_half_widths(numbers, uncertainty, *setting)
        pairs = ((turns, models.rotations), (quality, models.quality_factor), (spread, sampled))
        for lower, upper in pairs:
            lower |= {name: inputs.label(value) for name, value in upper.items()}
    sidereal, day = _stacked(turns, "rung"), np.abs(body.needed("spin_period"))
    period, half_width = sidereal * day, _stacked(spread, "rung")
    like = xr.zeros_like(period)
    rungs = Rungs(
        period_solar=(period, half_width * day + like),
        period_sidereal=(sidereal + like, half_width + like),
        factor=period.copy(data=ladder.factors(sidereal.values)),
        quality_factor=_stacked(quality, "rung") + like,
        rung_formula=np.array([ladder.FORMULAS[name] for name in turns]),
    )
    rung = {"left_out": "; ".join(f"{k}: {v}" for k, v in left_out.items()) or "none"}
    if inputs is None:
        return rungs.with_attributes(rung=rung)
    sources = [inputs.interior.reference]
    if "anelastic" in turns:
        sources.append(ANELASTIC_EXPONENT.source)
    return rungs.with_attributes(
        period_solar_error={"draws": propagation.DRAWS},
        rung={"references": "; ".join(sources), **rung},
    )


def _rigid_spread(body: Body, turns: Mapping[str, Numeric]) -> dict[str, Numeric]:
    """95 % half-widths of the rigid wobble periods, from the errors of flattening and of H."""
    spread: dict[str, Numeric] = {}
    for name, value in turns.items():
        field = "flattening" if name == "flattening" else "dynamical_flattening"
        h = 0.0 if name == "flattening" else body.needed("dynamical_flattening")
        u = body.relative_uncertainty.get(field, 0.0)
        spread[name] = free_wobble_error(value, h, u) if u else xr.zeros_like(xr.DataArray(value))
    return spread


def _stacked(values: Mapping[str, Numeric], dim: str) -> xr.DataArray:
    """Stack the arrays of a mapping along a new dimension, labelled by the keys of the mapping."""
    return xr.concat(
        xr.broadcast(*map(xr.DataArray, values.values())),
        dim=xr.Variable(dim, list(values)),
        coords="minimal",
        compat="override",
    )


# --- sections --------------------------------------------------------------------------------


class Sensitivity(Variables, along=("input",)):
    """Derivative of the wobble period with respect to each input, and error of that input.

    The period is that of the most detailed model; errors are 95 % half-widths.
    """

    days_per_unit = number(
        "d", "change of the period of the last model per unit of the input", no_error="a derivative"
    )
    input_value = number("1", "value of the input", error="input_half_width")
    input_half_width = number("1", "95 % half-width of the input", no_error="an error itself")
    days_from_input = number(
        "d",
        "95 % half-width of the period of the last model from the uncertainty of the input",
        no_error="a part of an error",
    )


@part
def sensitivity(inputs: ModelInputs) -> Sensitivity:
    """Derivative of the most detailed model's wobble period by each input, and input errors."""
    slopes = propagation.sensitivities(inputs.numbers, *inputs.setting)
    anelastic = "anelastic" in ladder.non_rigid(inputs.numbers, *inputs.setting).rotations
    half_widths = propagation.half_widths(inputs.numbers, inputs.uncertainty, anelastic)
    slope, half_width = inputs.stack(slopes, "input"), inputs.stack(half_widths, "input")
    return Sensitivity(
        days_per_unit=slope * DAY,
        input_value=inputs.stack(vars(inputs.numbers), "input"),
        input_half_width=half_width,
        days_from_input=abs(slope * half_width) * DAY,
    )


class CoreNutationPeriod(Variables, along=("core_shape",)):
    """Period of the free core nutation, for different shapes of the core."""

    free_core_nutation = measured("d", "period of the free core nutation in space")
    free_core_nutation_sidereal = measured(
        "1", "period of the free core nutation in turns of the body"
    )


@part
def core_nutation(inputs: ModelInputs, body: Body) -> CoreNutationPeriod:
    """Compute the period of the free core nutation, for different shapes of the core."""
    shapes = {"hydrostatic": (inputs.numbers, inputs.uncertainty)}
    attributes = {}
    observed = inputs.interior.observed_core_ellipticity
    # observed in the body itself, not in one that has been changed
    if observed is not None and body.observed_wobble is not None:
        u = observed.relative_uncertainty
        numbers = replace(inputs.numbers, core_ellipticity=observed.value)
        shapes["observed"] = (numbers, {**inputs.uncertainty, "core_ellipticity": u})
        attributes["references"] = observed.source
    turns: dict[str, Numeric] = {}
    half_widths: dict[str, Numeric] = {}
    for name, (numbers, spread) in shapes.items():
        turns[name] = ladder.non_rigid(numbers, *inputs.setting).core_rotations["fluid-core"]
        half_widths[name] = propagation.core_nutation_half_width(numbers, spread, *inputs.setting)
    nutation = inputs.stack(turns, "core_shape") * body.needed("spin_period")
    turns_error, day = inputs.stack(half_widths, "core_shape"), np.abs(body.needed("spin_period"))
    return CoreNutationPeriod(
        free_core_nutation=(nutation, turns_error * day),
        free_core_nutation_sidereal=(nutation / day, turns_error),
    ).with_attributes(free_core_nutation=attributes)


@part
def neglected(body: Body, inputs: ModelInputs | None = None) -> Neglected:
    """Effects on the free wobble that the last, most detailed model neglects."""
    if inputs is None:
        return Neglected(what=f"all deformation: {why_rigid(body)}")
    left_out = inputs.interior.neglected
    if not left_out or not body.is_as_named:
        effects = "an inner core, and rotation and ellipticity in the Love number"
        return Neglected(what=f"{effects}: their sizes were not found for this {body.name}")
    what = "change of the last period; winds and currents drive the wobble, and not its period"
    return Neglected.cited(left_out, what)


wobble_ladder = public_call(
    Wobble,
    answer=wobble_rungs,
    sections={
        "observed": reasons.observed_wobble,
        "sensitivity": sensitivity,
        "core_nutation": core_nutation,
        "neglected": neglected,
    },
    parts=(inputs,),
    together=("body", *_INTERIOR),
    widest=1024,
)
