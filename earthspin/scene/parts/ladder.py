"""The wobble ladder: rigid rungs, what the interior adds, and what it depends on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.bodies import all_of
from earthspin.dataset import Variable, with_error
from earthspin.errors import SceneError, nearest
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.bodies import Body
    from earthspin.scene.spec import Scene
    from earthspin.wobble.ladder import Inputs, Spin
    from earthspin.wobble.named import Interior

OCEANS = ("real", "global", "none")
#: A layered model stands for bodies whose mass and radius are within this of its own.
FIT = 0.01
DRAWS = 1000
#: Draws times bodies are kept below this, for memory.
MOST_DRAWS = 100_000

_FIGURE = ("dynamical_flattening", "j2", "triaxiality")
_SPIN = ("gm", "radius", "spin_period")


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
    """

    inputs: Inputs
    spin: Spin
    interior: Interior
    ocean: str
    dims: tuple[str, ...]


def wobble_ladder(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Period of the free wobble, rung by rung."""
    import numpy as np
    import xarray as xr

    from earthspin.dataset import build
    from earthspin.wobble import ladder

    body = scene.body
    h, j2 = body.needed("dynamical_flattening"), body.needed("j2")
    turns = {
        "flattening": ladder.turns_from_flattening(body.needed("flattening")),
        "rigid": ladder.turns_rigid(h),
        "triaxial": ladder.turns_triaxial(h, j2, body.triaxiality),
    }
    quality = dict.fromkeys(turns, np.inf)
    left_out = dict.fromkeys(ladder.RUNGS[3:], _why_rigid(scene))
    spread = _rigid_spread(body, turns)
    if not _why_rigid(scene):
        inside = look_inside(scene)
        climbed = ladder.climb(inside.inputs, inside.spin, inside.interior, inside.ocean)
        left_out = climbed.left_out
        label = _labeller(body, inside)
        turns |= {name: label(value) for name, value in climbed.turns.items()}
        quality |= {name: label(value) for name, value in climbed.quality_factor.items()}
        spread |= {name: label(value) for name, value in _sampled(scene, inside).items()}
    period = _along_rungs(turns) * abs(body.needed("spin_period"))
    like = xr.zeros_like(period)
    result = build(
        "wobble-ladder",
        WOBBLE_LADDER.gives,
        {
            "period_solar": period,
            "period_solar_error": _along_rungs(spread) * abs(body.needed("spin_period")) + like,
            "period_sidereal": _along_rungs(turns) + like,
            "factor": period.copy(data=ladder.factors(_along_rungs(turns).values)),
            "quality_factor": _along_rungs(quality) + like,
            "rung_formula": np.array([ladder.FORMULAS[name] for name in turns]),
        },
    )
    result.rung.attrs["left_out"] = "; ".join(f"{k}: {v}" for k, v in left_out.items()) or "none"
    return result


def interior_response(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Love numbers and moments of the layered model."""
    import numpy as np

    from earthspin.dataset import build
    from earthspin.wobble.interior import equilibrium
    from earthspin.wobble.named import elastic, global_ocean

    layers = _interior(scene).layers
    assert layers is not None
    love = elastic(layers)
    names = ("k", "h", "l", "k_load", "h_load")
    result = build(
        "interior-response",
        INTERIOR_RESPONSE.gives,
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


def wobble_sensitivity(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """What the last rung depends on, and the free core nutation."""
    from dataclasses import fields, replace

    import numpy as np

    from earthspin.constants import DAY
    from earthspin.dataset import build
    from earthspin.wobble import ladder

    inside, body = look_inside(scene), scene.body
    label = _labeller(body, inside)
    settings = (inside.spin, inside.interior, inside.ocean)
    slopes = ladder.sensitivities(inside.inputs, *settings)
    names = [f.name for f in fields(ladder.Inputs)]
    values = {name: getattr(inside.inputs, name) for name in names}
    uncertainty = _uncertainty(body, inside.interior)
    low, high = ladder.EXPONENT_RANGE
    half = {n: 1.96 * uncertainty.get(n, 0.0) * abs(np.asarray(values[n])) for n in names}
    if "anelastic" in ladder.climb(inside.inputs, *settings).turns:
        half["anelastic_exponent"] = np.asarray((high - low) / 2)
    shapes = {"hydrostatic": inside.inputs}
    observed = inside.interior.observed_core_ellipticity
    if observed is not None:
        shapes["observed"] = replace(inside.inputs, core_ellipticity=observed.value)
    core = {
        name: label(ladder.climb(i, *settings).core_turns["fluid-core"])
        for name, i in shapes.items()
    }

    def stack(parts: dict[str, Any]) -> xr.DataArray:
        return _along(parts, "input", label)

    nutation = _along(core, "core_shape") * body.needed("spin_period")
    return build(
        "wobble-sensitivity",
        WOBBLE_SENSITIVITY.gives,
        {
            "days_per_unit": stack(slopes) * DAY,
            "input_value": stack(values),
            "input_half_width": stack(half),
            "days_from_input": abs(stack(slopes) * stack(half)) * DAY,
            "free_core_nutation": nutation,
            "free_core_nutation_sidereal": nutation / abs(body.needed("spin_period")),
        },
    )


# --- what lies inside ------------------------------------------------------------------------


def look_inside(scene: Scene) -> Inside:
    """Inputs of the upper rungs, read from the body, its interior and the scene's table."""
    import xarray as xr

    from earthspin.wobble import ladder

    body, interior = scene.body, _interior(scene)
    ocean, exponent = _settings(scene)
    numbers = [xr.DataArray(body.needed(name)) for name in (*_FIGURE, *_SPIN)]
    numbers = list(xr.broadcast(*numbers))
    dims = tuple(str(d) for d in numbers[0].dims)
    values = dict(zip((*_FIGURE, *_SPIN), (n.values for n in numbers), strict=True))
    spin = ladder.Spin(*(values.pop(name) for name in _SPIN))
    inputs = ladder.inputs_of(interior, spin, values, ocean, exponent)
    return Inside(inputs, spin, interior, ocean, dims)


def _interior(scene: Scene) -> Interior:
    from earthspin.wobble.named import INTERIORS

    name = scene.body.interior
    if name not in INTERIORS:
        raise SceneError("body.interior", name, nearest(name, INTERIORS), source=scene.source)
    return INTERIORS[name]


def _settings(scene: Scene) -> tuple[str, float]:
    """The table [wobble]: which ocean, and the exponent of the mantle's loss."""
    from earthspin.wobble.named import ANELASTIC_EXPONENT

    known = {"ocean": "real", "anelastic_exponent": ANELASTIC_EXPONENT.value}
    table = dict((scene.tables or {}).get("wobble", {}))
    for key, value in table.items():
        if key not in known:
            raise SceneError(f"wobble.{key}", value, nearest(key, known), source=scene.source)
    settings = known | table
    ocean, exponent = settings["ocean"], settings["anelastic_exponent"]
    if ocean not in OCEANS:
        raise SceneError("wobble.ocean", ocean, nearest(ocean, OCEANS), source=scene.source)
    if isinstance(exponent, bool) or not isinstance(exponent, (int, float)):
        raise SceneError(
            "wobble.anelastic_exponent", exponent, "it is a pure number", source=scene.source
        )
    if not 0 <= exponent <= 0.2:
        raise SceneError(
            "wobble.anelastic_exponent",
            exponent,
            "it lies between 0 and 0.2; observed decay leaves 0.04 to 0.19",
            source=scene.source,
        )
    return str(ocean), float(exponent)


def _why_rigid(scene: Scene) -> str:
    """Why the ladder stops at the rigid rungs; empty if it goes on."""
    body = scene.body
    if body.interior in (None, "none"):
        return f"no interior of {body.name} is kept; set body.interior"
    if not all_of(body.needed("dynamical_flattening") > 0):
        return "only an oblate body is climbed further"
    interior = _interior(scene)
    if interior.layers is not None:
        for what, own, models in (
            ("mass", body.mass, interior.layers.mass),
            ("radius", body.needed("radius"), interior.layers.radius),
        ):
            if not all_of(abs(own / models - 1) < FIT):
                return f"interior '{interior.name}' is of another {what}, {models:.4g} in SI"
    return ""


def _not_climbed(scene: Scene) -> str | None:
    return _why_rigid(scene) or None


def _no_layers(scene: Scene) -> str | None:
    name = scene.body.interior
    if name in (None, "none"):
        return f"no interior of {scene.body.name} is kept"
    layered = _interior(scene).layers is not None
    return None if layered else f"interior '{name}' is published numbers, not layers"


# --- uncertainty -----------------------------------------------------------------------------


def _uncertainty(body: Body, interior: Interior) -> dict[str, float]:
    return {**interior.relative_uncertainty, **body.relative_uncertainty}


def _sampled(scene: Scene, inside: Inside) -> dict[str, Any]:
    """95 % half-widths of the upper rungs, by sampling the inputs."""
    import numpy as np

    from earthspin.wobble import ladder

    bodies = np.asarray(inside.spin.gm).size
    draws = max(100, min(DRAWS, MOST_DRAWS // bodies))
    drawn = ladder.draw(inside.inputs, _uncertainty(scene.body, inside.interior), draws)
    sampled = ladder.climb(drawn, inside.spin, inside.interior, inside.ocean)
    ends = {n: np.percentile(v, [2.5, 97.5], axis=0) for n, v in sampled.turns.items()}
    return {name: (high - low) / 2 for name, (low, high) in ends.items()}


def _rigid_spread(body: Body, turns: Mapping[str, Any]) -> dict[str, Any]:
    """95 % half-widths of the rigid rungs: relative errors of f and of H."""
    from earthspin.rotor.axisymmetric import free_wobble_error

    u = body.relative_uncertainty
    fields = {"flattening": "flattening"}
    shares = {n: u.get(fields.get(n, "dynamical_flattening"), 0.0) for n in turns}
    h = {n: 0.0 if n in fields else body.needed("dynamical_flattening") for n in turns}
    return {
        name: free_wobble_error(value, h[name], shares[name])
        if shares[name]
        else 0.0 * _finite(value)
        for name, value in turns.items()
    }


def _finite(value: Any) -> Any:
    """Zeros of the same shape, for an infinite period has no error."""
    import numpy as np

    return np.where(np.isinf(value), 0.0, value)


# --- labels ----------------------------------------------------------------------------------


def _labeller(body: Body, inside: Inside) -> Any:
    """Give back their names to arrays of the body's own dimensions."""
    import numpy as np
    import xarray as xr

    def label(value: Any) -> xr.DataArray:
        array = np.asarray(value)
        return xr.DataArray(array, dims=inside.dims[len(inside.dims) - array.ndim :])

    return label


def _along_rungs(values: Mapping[str, Any]) -> xr.DataArray:
    return _along(values, "rung")


def _along(values: Mapping[str, Any], dim: str, label: Any = None) -> xr.DataArray:
    import xarray as xr

    parts = [(label or xr.DataArray)(value) for value in values.values()]
    return xr.concat(
        xr.broadcast(*parts),
        dim=xr.Variable(dim, list(values)),
        coords="minimal",
        compat="override",
    )


_RUNG = ("rung",)

WOBBLE_LADDER = Part(
    name="wobble-ladder",
    does="free wobble, from a formula of flattening to a body that yields",
    function="earthspin.scene.parts.ladder:wobble_ladder",
    keys=("body", "tables"),
    gives={
        **with_error(
            "period_solar",
            Variable(_RUNG, "d", "period of the free wobble in days of 86400 s"),
        ),
        "period_sidereal": Variable(
            _RUNG, "1", "period of the free wobble in turns of the body, its sidereal days"
        ),
        "factor": Variable(_RUNG, "1", "period over that of the rung before"),
        "quality_factor": Variable(
            _RUNG,
            "1",
            "quality factor of the free wobble",
            (
                (
                    "comment",
                    "infinite where nothing is lost; the exponent of the loss is a free choice, "
                    "so the anelastic rung is a check of consistency, not a prediction",
                ),
            ),
        ),
        "rung_formula": Variable(_RUNG, "", "turns per wobble, and where the formula stands"),
    },
)

INTERIOR_RESPONSE = Part(
    name="interior-response",
    does="Love numbers and moments of the layered interior, by integration",
    function="earthspin.scene.parts.ladder:interior_response",
    keys=("body",),
    left_out=_no_layers,
    gives={
        "love_number": Variable(("love",), "1", "Love number of degree two, elastic, at 1 s"),
        "moment_factor": Variable((), "1", "moment of inertia of the model over M R2"),
        "core_fraction": Variable((), "1", "moment of the core over that of the body"),
        "fluid_love_number": Variable((), "1", "k2 if the body were liquid throughout"),
        "global_ocean_love_number": Variable(
            (), "1", "what an ocean all over would add to k2, in closed form"
        ),
    },
)

WOBBLE_SENSITIVITY = Part(
    name="wobble-sensitivity",
    does="days of the last rung per unit of each input; free core nutation",
    function="earthspin.scene.parts.ladder:wobble_sensitivity",
    keys=("body", "tables"),
    left_out=_not_climbed,
    gives={
        "days_per_unit": Variable(("input",), "d", "change of the last rung per unit of the input"),
        "input_value": Variable(("input",), "1", "value of the input"),
        "input_half_width": Variable(("input",), "1", "95 % half-width of the input"),
        "days_from_input": Variable(
            ("input",), "d", "95 % half-width of the last rung from the input"
        ),
        "free_core_nutation": Variable(
            ("core_shape",), "d", "period of the free core nutation among the stars"
        ),
        "free_core_nutation_sidereal": Variable(
            ("core_shape",), "1", "period of the free core nutation in turns of the body"
        ),
    },
)
