"""The wobble ladder: rigid rungs, rungs of the interior, and their sensitivity to the inputs.

A rung is a model that adds one effect to the model before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np

from earthspin.bodies import EARTH, Body, Numeric, all_of
from earthspin.bodies.limits import refuse_break_up
from earthspin.constants import DAY
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, with_error, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import Question, key, made_of, setting
from earthspin.interior.named import ANELASTIC_EXPONENT
from earthspin.parts.layered import (
    interior_of,
    layers_of,
    no_interior,
    not_layered,
    of_another_body,
    refuse_unknown,
)
from earthspin.parts.observed_wobble import observed_wobble
from earthspin.units import FloatArray, Number

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.interior.named import Interior
    from earthspin.wobble.ladder import Inputs, Spin

_FIGURE = ("dynamical_flattening", "j2", "triaxiality")
_SPIN = ("gm", "radius", "spin_period")


class Wobble(Question, word="wobble", call="wobble_ladder", table="wobble"):
    """Period of the free wobble, from the formula with the flattening to a deformable body (I.6).

    A ladder of models: each rung adds one effect to the rung before. The `interior` of the body
    determines the last rung.

    Returns
    -------
    Dataset
        Along `rung` (flattening, rigid, triaxial, elastic, fluid-core, ocean, anelastic):
        `period_solar` (d of 86400 s) with its 95 % half-width, `period_sidereal`, `factor`,
        `quality_factor`. `earthspin.run_tree` adds the sections: the observed period, the
        sensitivity of the last rung, the free core nutation, and the Love numbers.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.

    Examples
    --------
    >>> import earthspin
    >>> print(earthspin.wobble_ladder().period_solar.round(1).values)
    [297.4 303.6 303.6 444.4 393.9 423.7 431.6]
    """

    views, page = "wobble", "wobble"

    body: Body = key(EARTH, doc="body that wobbles")
    ocean: Literal["real", "global", "none"] = setting("real", doc="kind of ocean on the body")
    anelastic_exponent: Annotated[float, Number("", "0.09", low=0.0, high=0.2)] = setting(
        ANELASTIC_EXPONENT.value,
        doc="exponent of frequency in the mantle's quality factor; observed decay allows 0.04 to "
        "0.19 (Smith & Dahlen 1981)",
    )

    def check(self) -> None:
        """A body with a mass, and an interior that is known."""
        if not all_of(self.body.gm > 0):
            raise self.error("body", self.body.name, "the mass of a body that spins is not zero")
        self.body.require(("radius", "j2", "dynamical_flattening", "flattening", "spin_period"))
        refuse_break_up(self.body)
        refuse_unknown(self, self.body)


def why_rigid(body: Body) -> str | None:
    """Why the ladder stops at the rigid rungs; None if it goes on."""
    interior = interior_of(body)
    if interior is None:
        return f"{no_interior(body)}; set body.interior"
    if not all_of(body.needed("dynamical_flattening") > 0):
        return "models with an interior are for oblate bodies"
    return None if interior.layers is None else of_another_body(interior.layers, body)


# --- what lies inside ------------------------------------------------------------------------


@dataclass(frozen=True)
class Inside:
    """What the upper rungs need, as arrays of one shape.

    Attributes
    ----------
    inputs, spin, interior
        As `earthspin.wobble.ladder.climb` takes them.
    ocean : str
    dims : tuple of str
        Names of the arrays' dimensions.
    uncertainty : mapping of str to float
        One standard deviation over value, of the body's numbers and the interior's.
    """

    inputs: Inputs
    spin: Spin
    interior: Interior
    ocean: str
    dims: tuple[str, ...]
    uncertainty: Mapping[str, float]

    def label(self, value: FloatArray) -> xr.DataArray:
        """Give back their names to arrays of the body's own dimensions."""
        import xarray as xr

        array = np.asarray(value)
        return xr.DataArray(array, dims=self.dims[len(self.dims) - array.ndim :])


@part(unless=why_rigid)
def inside(body: Body, ocean: str, anelastic_exponent: float) -> Inside:
    """Inputs of the upper rungs, from the body, its interior and the ocean."""
    import xarray as xr

    from earthspin.wobble import ladder

    interior = interior_of(body)
    assert interior is not None
    numbers = [xr.DataArray(body.needed(name)) for name in (*_FIGURE, *_SPIN)]
    numbers = list(xr.broadcast(*numbers))
    dims = tuple(str(d) for d in numbers[0].dims)
    values = dict(zip((*_FIGURE, *_SPIN), (n.values for n in numbers), strict=True))
    spin = ladder.Spin(*(values.pop(name) for name in _SPIN))
    inputs = ladder.inputs_of(interior, spin, values, ocean, anelastic_exponent)
    uncertainty = {**interior.relative_uncertainty, **body.relative_uncertainty}
    return Inside(inputs, spin, interior, ocean, dims, uncertainty)


# --- the answer ------------------------------------------------------------------------------

_RUNG = ("rung",)
LADDER = without_error(
    "its relative error is that of period_solar; the quality factor follows from published ones",
    {
        **with_error(
            "period_solar",
            Variable(_RUNG, "d", "period of the free wobble in days of 86400 s"),
        ),
        "period_sidereal": Variable(
            _RUNG, "1", "period of the free wobble in turns of the body, its sidereal days"
        ),
        "factor": Variable(_RUNG, "1", "ratio of the period to that of the rung before"),
        "quality_factor": Variable(
            _RUNG,
            "1",
            "quality factor of the free wobble",
            (
                (
                    "comment",
                    "infinite without dissipation; the exponent of anelasticity is a free choice, "
                    "so the anelastic rung is a check of consistency, not a prediction",
                ),
            ),
        ),
        "rung_formula": Variable(
            _RUNG, "", "formula for the turns of the body per wobble, with its source"
        ),
    },
)


@part(gives=LADDER)
def wobble_rungs(body: Body, inside: Inside | None = None) -> xr.Dataset:
    """Free wobble, from the formula with the flattening to a deformable body."""
    import xarray as xr

    from earthspin.wobble import ladder, propagation

    h, j2 = body.needed("dynamical_flattening"), body.needed("j2")
    turns = ladder.rigid_turns(body.needed("flattening"), h, j2, body.triaxiality)
    quality: dict[str, Numeric] = dict.fromkeys(turns, np.inf)
    left_out = dict.fromkeys(ladder.RUNGS[3:], why_rigid(body) or "")
    spread = _rigid_spread(body, turns)
    if inside is not None:
        climbed = ladder.climb(inside.inputs, inside.spin, inside.interior, inside.ocean)
        left_out = climbed.left_out
        label = inside.label
        turns |= {name: label(value) for name, value in climbed.turns.items()}
        quality |= {name: label(value) for name, value in climbed.quality_factor.items()}
        sampled = propagation.sampled_half_widths(
            inside.inputs, inside.uncertainty, inside.spin, inside.interior, inside.ocean
        )
        spread |= {name: label(value) for name, value in sampled.items()}
    period = _along(turns, "rung") * abs(body.needed("spin_period"))
    like = xr.zeros_like(period)
    result = build(
        LADDER,
        {
            "period_solar": period,
            "period_solar_error": _along(spread, "rung") * abs(body.needed("spin_period")) + like,
            "period_sidereal": _along(turns, "rung") + like,
            "factor": period.copy(data=ladder.factors(_along(turns, "rung").values)),
            "quality_factor": _along(quality, "rung") + like,
            "rung_formula": np.array([ladder.FORMULAS[name] for name in turns]),
        },
    )
    if inside is not None:
        result.period_solar_error.attrs["draws"] = propagation.DRAWS
        result.rung.attrs["references"] = "; ".join(
            (inside.interior.reference, ANELASTIC_EXPONENT.source)
        )
    result.rung.attrs["left_out"] = "; ".join(f"{k}: {v}" for k, v in left_out.items()) or "none"
    return result


def _rigid_spread(body: Body, turns: Mapping[str, Numeric]) -> dict[str, Numeric]:
    """95 % half-widths of the rigid rungs: relative errors of f and of H."""
    import xarray as xr

    from earthspin.rotor.axisymmetric import free_wobble_error

    u = body.relative_uncertainty
    fields = {"flattening": "flattening"}
    shares = {n: u.get(fields.get(n, "dynamical_flattening"), 0.0) for n in turns}
    h = {n: 0.0 if n in fields else body.needed("dynamical_flattening") for n in turns}
    return {
        name: free_wobble_error(value, h[name], shares[name])
        if shares[name]
        else xr.zeros_like(xr.DataArray(value))  # labels and all
        for name, value in turns.items()
    }


def _along(
    values: Mapping[str, Numeric],
    dim: str,
    label: Callable[[FloatArray], xr.DataArray] | None = None,
) -> xr.DataArray:
    """Arrays laid side by side along a new dimension, their names its labels."""
    import xarray as xr

    parts = [(label or xr.DataArray)(value) for value in values.values()]
    return xr.concat(
        xr.broadcast(*parts),
        dim=xr.Variable(dim, list(values)),
        coords="minimal",
        compat="override",
    )


# --- sections --------------------------------------------------------------------------------

INTERIOR = without_error(
    "the section sensitivity gives the effect of its uncertainty on the period",
    {
        "love_number": Variable(("love",), "1", "Love number of degree two, elastic, at 1 s"),
        "moment_factor": Variable((), "1", "moment of inertia of the model, divided by M R2"),
        "core_fraction": Variable(
            (), "1", "ratio of the moment of inertia of the core to that of the body"
        ),
        "fluid_love_number": Variable((), "1", "k2 if the body were liquid throughout"),
        "global_ocean_love_number": Variable(
            (), "1", "increase of k2 by an ocean that covers the whole body, in closed form"
        ),
    },
)


@part(gives=INTERIOR, unless=not_layered)
def interior_response(body: Body) -> xr.Dataset:
    """Love numbers and moments of the layered interior, by integration."""
    from earthspin.interior.equilibrium import equilibrium
    from earthspin.interior.love import elastic
    from earthspin.interior.ocean import global_ocean

    layers = layers_of(body)
    love = elastic(layers)
    names = ("k", "h", "l", "k_load", "h_load")
    result = build(
        INTERIOR,
        {
            "love_number": np.array([float(getattr(love, name)) for name in names]),
            "moment_factor": layers.moment_factor,
            "core_fraction": layers.core_fraction,
            "fluid_love_number": equilibrium(layers).k,
            "global_ocean_love_number": global_ocean(layers),
        },
        coords={"love": ("love", ["k2", "h2", "l2", "k2_load", "h2_load"])},
    )
    result.love_number.attrs["references"] = layers.reference
    return result


SENSITIVITY = without_error(
    "a share of an error, or an input of it",
    {
        "days_per_unit": Variable(("input",), "d", "change of the last rung per unit of the input"),
        "input_value": Variable(("input",), "1", "value of the input"),
        "input_half_width": Variable(("input",), "1", "95 % half-width of the input"),
        "days_from_input": Variable(
            ("input",), "d", "95 % half-width of the last rung from the uncertainty of the input"
        ),
    },
)


@part(gives=SENSITIVITY)
def sensitivity(inside: Inside) -> xr.Dataset:
    """Days of the last rung per unit of each input."""
    from earthspin.wobble import ladder, propagation

    settings = (inside.spin, inside.interior, inside.ocean)
    slopes = propagation.sensitivities(inside.inputs, *settings)
    anelastic = "anelastic" in ladder.climb(inside.inputs, *settings).turns
    half = propagation.half_widths(inside.inputs, inside.uncertainty, anelastic)

    def stack(parts: Mapping[str, Numeric]) -> xr.DataArray:
        return _along(parts, "input", inside.label)

    return build(
        SENSITIVITY,
        {
            "days_per_unit": stack(slopes) * DAY,
            "input_value": stack(vars(inside.inputs)),
            "input_half_width": stack(half),
            "days_from_input": abs(stack(slopes) * stack(half)) * DAY,
        },
    )


CORE_NUTATION = without_error(
    "the uncertainty of the core was not propagated to it",
    {
        "free_core_nutation": Variable(
            ("core_shape",), "d", "period of the free core nutation in space"
        ),
        "free_core_nutation_sidereal": Variable(
            ("core_shape",), "1", "period of the free core nutation in turns of the body"
        ),
    },
)


@part(gives=CORE_NUTATION)
def core_nutation(inside: Inside, body: Body) -> xr.Dataset:
    """Free core nutation, the other root of the equations, by the shape of the core."""
    from earthspin.wobble import ladder

    shapes = {"hydrostatic": inside.inputs}
    observed = inside.interior.observed_core_ellipticity
    # observed in the body itself, not in one that has been changed
    if observed is not None and body.observed_wobble is not None:
        shapes["observed"] = replace(inside.inputs, core_ellipticity=observed.value)
    settings = (inside.spin, inside.interior, inside.ocean)
    turns = {
        name: inside.label(ladder.climb(i, *settings).core_turns["fluid-core"])
        for name, i in shapes.items()
    }
    nutation = _along(turns, "core_shape") * body.needed("spin_period")
    result = build(
        CORE_NUTATION,
        {
            "free_core_nutation": nutation,
            "free_core_nutation_sidereal": nutation / abs(body.needed("spin_period")),
        },
    )
    if observed is not None and "observed" in shapes:
        result.free_core_nutation.attrs["references"] = observed.source
    return result


INNER_CORE = without_error(
    "the section interior has the numbers that it follows from, which have none",
    {
        "chandler_by_core": Variable(
            ("core_model",),
            "d",
            "period of the free wobble of the elastic body without an ocean, by the inner core",
        ),
    },
)


def no_inner_core(body: Body) -> str | None:
    """Leave out what the inner core does where none is known."""
    if not_layered(body):
        return not_layered(body)
    if body.labelled:
        return "it is computed for one body at a time"
    return None if layers_of(body).inner_core_radius else "it has no inner core"


@part(gives=INNER_CORE, unless=(why_rigid, no_inner_core))
def inner_core(body: Body) -> xr.Dataset:
    """What a solid inner core does to the free wobble: the same system with all of its parts."""
    from earthspin.interior.rotation import chandler_by_core
    from earthspin.mass.inertia import ellipticity_from_h

    e = float(ellipticity_from_h(body.number("dynamical_flattening")))
    found = chandler_by_core(layers_of(body), e, abs(float(body.spin_rate)))
    turn = abs(body.number("spin_period"))
    return build(
        INNER_CORE,
        {"chandler_by_core": [turn * turns for turns in found.values()]},
        coords={"core_model": list(found)},
    )


@part
def neglected(body: Body, inside: Inside | None = None) -> Neglected:
    """What the last rung leaves out."""
    if inside is None:
        return Neglected(what=f"all deformation: {why_rigid(body)}")
    left_out = inside.interior.neglected
    if not left_out or not body.is_as_named:
        return Neglected(
            what="an inner core, and rotation and ellipticity in the Love number: their sizes "
            f"were not found for this {body.name}"
        )
    return Neglected.cited(
        left_out, "change of the last rung; winds and currents drive the wobble, and not its period"
    )


made_of(
    Wobble,
    answer=wobble_rungs,
    sections={
        "observed": observed_wobble,
        "sensitivity": sensitivity,
        "core_nutation": core_nutation,
        "inner_core": inner_core,
        "interior": interior_response,
        "neglected": neglected,
    },
    parts=(inside,),
    together=("body",),
    widest=1024,
)

wobble_ladder = ask(Wobble)
