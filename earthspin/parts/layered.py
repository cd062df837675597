"""What lies inside the body of a question: as the question has it, or the body itself."""

from __future__ import annotations

from typing import Annotated

from earthspin.bodies import BODIES, Body, all_of, in_a_sentence
from earthspin.bodies.layered import Layers
from earthspin.engine.part import part
from earthspin.engine.question import Question
from earthspin.errors import nearest
from earthspin.interior.layers import LayeredBody
from earthspin.interior.named import INTERIORS, Interior, with_layers

#: Layers stand for bodies whose mass and mean radius are within this of their own.
FIT = 0.01

#: Why numbers that follow from layers carry no error.
FROM_LAYERS = "they follow from the layers, whose own errors are not known"

#: A layered body, however given.
LayeredInterior = Annotated[LayeredBody, Layers()]


def interior_of(body: Body) -> Interior | None:
    """What lies inside a body; None if it is rigid.

    Layers of its own keep what is known of the body beside its layers, as long as it is that body.
    """
    own = body.interior
    if isinstance(own, LayeredBody):
        usual = BODIES[body.name].interior if body.is_as_named else None
        return with_layers(own, INTERIORS.get(str(usual)))
    return INTERIORS.get(str(own))


def of_another_body(layers: LayeredBody, body: Body) -> str | None:
    """Leave out what layers tell where mass or mean radius are not those of the body."""
    flattening = 0.0 if body.flattening is None else body.flattening
    mean_radius = body.needed("radius") * (1 - flattening / 3)
    for what, own, models in (
        ("mass", body.mass, layers.mass),
        ("radius", mean_radius, layers.radius),
    ):
        if not all_of(abs(own / models - 1) < FIT):
            return f"interior '{layers.name}' is of another {what}, {models:.4g} in SI"
    return None


def refuse_unknown(question: Question, body: Body) -> None:
    """Refuse the name of an interior that nobody knows.

    Raises
    ------
    SceneError
        It names the nearest one.
    """
    name = body.interior
    if isinstance(name, str) and name not in ("none", *INTERIORS):
        raise question.error("body.interior", name, nearest(name, INTERIORS))


def no_interior(body: Body) -> str | None:
    """Leave out what an interior does where none is known."""
    none = interior_of(body) is None
    return f"no interior of {in_a_sentence(body.name)} is kept" if none else None


def not_layered(body: Body) -> str | None:
    """Leave out what layers tell where none are known."""
    interior = interior_of(body)
    if interior is None or interior.layers is not None:
        return no_interior(body)
    return f"interior '{interior.name}' has published numbers, but no layers"


def require_layers(question: Question, interior: LayeredBody | None, body: Body) -> None:
    """Refuse a question about layers that neither it nor its body has.

    Raises
    ------
    SceneError
        It says which.
    """
    refuse_unknown(question, body)
    if interior is None and (why := not_layered(body)):
        raise question.error("body", body.name, f"{why}; give layers as interior")


def layers_of(body: Body) -> LayeredBody:
    """Layers of a body that has them."""
    within = interior_of(body)
    assert within is not None
    assert within.layers is not None
    return within.layers


@part
def layers(interior: LayeredBody | None, body: Body) -> LayeredBody:
    """Layers that the question gives, or else those of the body."""
    return layers_of(body) if interior is None else interior


def not_prem(interior: LayeredBody | None, body: Body) -> str | None:
    """Leave published numbers out for other layers than they are of."""
    name = (interior or layers_of(body)).name
    return None if name == "prem" else f"none are kept of '{name}'"
