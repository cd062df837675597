"""Interior of the rotating body: layers given by the user, or those known for the body."""

from __future__ import annotations

from typing import Annotated

from earthspin.bodies import BODIES, Body, all_of, in_a_sentence
from earthspin.bodies.kinds import Layers
from earthspin.engine.part import part
from earthspin.engine.question import Question
from earthspin.errors import nearest
from earthspin.interior.layers import LayeredBody
from earthspin.interior.named import INTERIORS, Interior, with_layers

#: Largest relative difference of mass and mean radius between layers and the body they describe.
FIT = 0.01

#: Reason why numbers from layers have no error.
FROM_LAYERS = "they follow from the layers, whose errors are not known"

#: A layered body in any form that `Layers` reads.
LayeredInterior = Annotated[LayeredBody, Layers()]


def interior_of(body: Body) -> Interior | None:
    """Interior model of a body, from its layers or its name; None if the body is rigid.

    If an unmodified body has custom layers, the other known numbers of its interior still apply.
    """
    own = body.interior
    if isinstance(own, LayeredBody):
        usual = BODIES[body.name].interior if body.is_as_named else None
        return with_layers(own, INTERIORS.get(str(usual)))
    return INTERIORS.get(str(own))


def of_another_body(layers: LayeredBody, body: Body) -> str | None:
    """Return the reason (text) to omit results if the layers do not fit the body, else None.

    The layers must have the mass and the mean radius of the body.
    """
    flattening = 0.0 if body.flattening is None else body.flattening
    mean_radius = body.needed("radius") * (1 - flattening / 3)
    for what, own, model in (
        ("mass", body.mass, layers.mass),
        ("radius", mean_radius, layers.radius),
    ):
        if not all_of(abs(own / model - 1) < FIT):
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
    if isinstance(name, str) and name not in ("none", *INTERIORS):
        raise question.error("body.interior", name, nearest(name, INTERIORS))


def no_interior(body: Body) -> str | None:
    """Return the reason (text) to omit results if no interior of the body is known, else None."""
    none = interior_of(body) is None
    return f"no interior of {in_a_sentence(body.name)} is known" if none else None


def not_layered(body: Body) -> str | None:
    """Return the reason (text) to omit results if no layers of the body are known, else None."""
    interior = interior_of(body)
    if interior is None or interior.layers is not None:
        return no_interior(body)
    return f"interior '{interior.name}' has published numbers, but no layers"


def require_layers(question: Question, interior: LayeredBody | None, body: Body) -> None:
    """Raise an error if neither the question nor its body has a layered interior.

    Raises
    ------
    SceneError
        If neither has layers.
    """
    refuse_unknown(question, body)
    if interior is None and (why := not_layered(body)):
        raise question.error("body", body.name, f"{why}; give layers as interior")


def layers_of(body: Body) -> LayeredBody:
    """Layers of the body's interior, which the caller knows to exist."""
    within = interior_of(body)
    assert within is not None
    assert within.layers is not None
    return within.layers


@part
def layers(interior: LayeredBody | None, body: Body) -> LayeredBody:
    """Layers that the user gives as input, or by default those of the body."""
    return layers_of(body) if interior is None else interior
