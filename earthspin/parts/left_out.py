"""Effects on the motion of a body that are switched off, each added to the forces that act."""

from __future__ import annotations

from collections.abc import Sequence

from earthspin.bodies import BODIES, Body
from earthspin.errors import EarthspinError
from earthspin.motion.effects import EFFECTS, GEODESIC, NONRIGID, PLANETS
from earthspin.motion.forces import Forces
from earthspin.parts.elements import all_by_elements
from earthspin.parts.pulls import forces_of, pulls
from earthspin.parts.sky import Sky


def switched_off(
    body: Body, perturbers: tuple[Body, ...], effects: Sequence[str]
) -> tuple[str, ...]:
    """Names of the effects on the rigid body that are switched off although they would act.

    An effect does not act if its coefficient is zero or its perturbers are not there.
    """
    idle = {
        name
        for name, effect in EFFECTS.items()
        if effect.coefficient and body.number(effect.coefficient) == 0
    }
    if body.name not in BODIES and all_by_elements(body, perturbers):
        idle.add(PLANETS.name)  # the body is not in the solar system
    if "sun" not in {perturber.name for perturber in perturbers}:
        idle.add(GEODESIC.name)
    off = (name for name in EFFECTS if name not in {*effects, *idle, NONRIGID.name})
    return tuple(off) if perturbers else ()


def each_added(
    sky: Sky, body: Body, perturbers: tuple[Body, ...], effects: Sequence[str], off: Sequence[str]
) -> tuple[Forces, dict[str, Forces]]:
    """Forces of the given effects, and the same forces with one more effect each.

    The planets are omitted if their positions are not known.
    """
    on = tuple(effects)
    try:
        pulling = pulls(sky, body, perturbers, (*on, *off))
    except EarthspinError:
        off = [name for name in off if name != PLANETS.name]
        pulling = pulls(sky, body, perturbers, on)
    added = {name: forces_of(body, pulling, (*on, name), keep=True) for name in off}
    return forces_of(body, pulling, on, keep=True), added
