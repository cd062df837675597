"""Interior of the rotating body: layers, and the nutation response predicted from the layers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from earthspin.bodies import BODIES, Body, all_of, in_a_sentence, kinds
from earthspin.engine import Question, part
from earthspin.errors import nearest
from earthspin.interior import named
from earthspin.interior.layers import LayeredBody
from earthspin.interior.ocean_and_anelasticity import FES2004_SOURCE
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation import interior_models
from earthspin.questions.reasons import no_iau_model
from earthspin.wobble.ladder import Rotator

#: Largest relative difference of mass and mean radius between layers and the body they describe.
FIT = 0.01

#: Reason why numbers from layers have no error.
FROM_LAYERS = "they follow from the layers, whose errors are not known"

#: A layered body in any form that `Layers` reads.
LayeredInterior = Annotated[LayeredBody, kinds.Layers()]


def interior_of(body: Body) -> named.Interior | None:
    """Interior model of a body, from layers or a model name; None if the body is rigid.

    If an unmodified body has custom layers, the other known numbers of its interior still apply.
    """
    value = body.interior
    if isinstance(value, LayeredBody):
        default = BODIES[body.known_as].interior if body.is_as_named else None
        return named.with_layers(value, named.INTERIORS.get(str(default)))
    return named.INTERIORS.get(str(value))


def of_another_body(layers: LayeredBody, body: Body) -> str | None:
    """Return the reason (text) to omit results if the layers do not fit the body, else None.

    The layers must have the mass and the mean radius of the body.
    """
    flattening = 0.0 if body.flattening is None else body.flattening
    mean_radius = body.needed("radius") * (1 - flattening / 3)
    numbers = ("mass", body.mass, layers.mass), ("radius", mean_radius, layers.radius)
    for what, value, model in numbers:
        if not all_of(abs(value / model - 1) < FIT):
            return f"interior '{layers.name}' has another {what}, {model:.4g} in SI units"
    return None


def refuse_unknown(question: Question, body: Body) -> None:
    """Refuse the name of an interior model that is not in the package.

    Raises
    ------
    SceneError
        If the name is unknown; the message suggests the nearest one.
    """
    name = body.interior
    if isinstance(name, str) and name not in ("none", *named.INTERIORS):
        raise question.error("body.interior", name, nearest(name, named.INTERIORS))


def no_interior(body: Body) -> str | None:
    """Return the reason (text) to omit results if no interior of the body is known, else None."""
    none = interior_of(body) is None
    return f"no interior of {in_a_sentence(body.name)} is known" if none else None


def require_layers(question: Question, interior: LayeredBody | None, body: Body) -> None:
    """Raise an error if layers are neither given as input nor known for the body.

    Raises
    ------
    SceneError
        If neither has layers.
    """
    refuse_unknown(question, body)
    known = interior_of(body)
    if interior is not None or (known is not None and known.layers is not None):
        return
    reason = no_interior(body)
    if known is not None:
        reason = f"interior '{known.name}' has published numbers, but no layers"
    raise question.error("body", body.name, f"{reason}; give layers as interior")


@part
def layers(interior: LayeredBody | None, body: Body) -> LayeredBody:
    """Layers that the user gives as input, or by default the known layers of the body."""
    if interior is not None:
        return interior
    known = interior_of(body)
    assert known is not None
    assert known.layers is not None  # `require_layers` has refused other bodies
    return known.layers


# --- predicted response --------------------------------------------------------------------------


#: The rung that is used if a question needs a single predicted response.
CHOSEN = "core-ellipticity"
#: Sources of the numbers that a prediction uses besides the layers.
_SOURCES = (named.CORE_NUTATION.source, named.K_CMB_OUT_OF_PHASE.source, FES2004_SOURCE)
SOURCES = "; ".join([*_SOURCES, named.ANELASTIC_EXPONENT.source])


@dataclass(frozen=True)
class Prediction:
    """Nutation response of a body's interior, predicted by models of increasing detail (rungs).

    Attributes
    ----------
    rungs : dict of str to Rung
        Rungs of the ladder, and additional models.
    setting : InteriorInputs
        Inputs that the models share.
    uncertainty : mapping of str to float
        Relative standard uncertainties of the numbers of the interior, and of e.
    """

    rungs: dict[str, interior_models.Rung]
    setting: interior_models.InteriorInputs
    uncertainty: Mapping[str, float]

    @property
    def ladder(self) -> list[str]:
        """Names of the models in order of detail (rungs), except those used only for comparison."""
        return [name for name in self.rungs if name not in interior_models.COMPARISONS]

    def transfer(self, name: str, frequency: FloatArray) -> ComplexArray:
        """Transfer function (non-rigid over rigid nutation) of one model, at frequencies in rad/s.

        The frequencies are in space.
        """
        sigma = frequency / self.setting.spin_rate - 1
        return self.rungs[name].transfer(sigma, self.setting.e)


def layered(body: Body) -> named.Interior | None:
    """Return the interior of a body if its layers include an inner core; otherwise None."""
    interior = interior_of(body)
    if interior is None or interior.layers is None or not interior.layers.inner_core_radius:
        return None
    return interior


def no_layers(body: Body) -> str | None:
    """Return the reason (text) to omit the predicted response if it is impossible, else None.

    The body needs an IAU model, and layers with an inner core that have its mass and radius.
    """
    if reason := no_iau_model(body):
        return reason
    interior = layered(body)
    if interior is None:
        return f"no layers with an inner core are known for {in_a_sentence(body.name)}"
    assert interior.layers is not None
    return of_another_body(interior.layers, body)


def predict(body: Body, coupling: bool, anelastic_exponent: float) -> Prediction:
    """Build all interior models (rungs) of a body with layers."""
    interior = layered(body)
    assert interior is not None
    assert interior.layers is not None
    h, spin_rate = body.number("dynamical_flattening"), float(body.spin_rate)
    e, ocean = h / (1 - h), 0.0
    if interior.ocean is not None:
        spin = Rotator(body.number("gm"), body.number("radius"), body.number("spin_period"))
        mean = (interior.ocean[0][0] + interior.ocean[1][1]) / 2
        ocean = mean / spin.centrifugal(interior.layers.radius)
    setting = interior_models.InteriorInputs(
        interior.layers, e, spin_rate, ocean, anelastic_exponent
    )
    rungs = interior_models.rungs_of(setting, coupling)
    of_e = body.relative_uncertainty.get("dynamical_flattening", 0.0) / (1 - h)
    return Prediction(rungs, setting, {**interior.relative_uncertainty, "ellipticity": of_e})


@part(unless=no_layers)
def prediction(body: Body) -> Prediction:
    """Predict the response of a body's interior to nutation torques from the body's layers."""
    return predict(body, False, named.ANELASTIC_EXPONENT.value)
