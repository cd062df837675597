"""Effects on the motion of a body that are switched off, each added to the forces that act."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from earthspin.bodies import BODIES, SUN, Body
from earthspin.bodies import PLANETS as PLANET_NAMES
from earthspin.errors import EarthspinError
from earthspin.motion.effects import EFFECTS, GEODESIC, NONRIGID, PLANETS
from earthspin.motion.forces import Forces
from earthspin.parts.elements import all_by_elements
from earthspin.parts.pulls import forces_of, pulls
from earthspin.parts.satellites import carried, obliquity_of
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

    The planets are omitted if their positions are not known (`drift_by_planets`).
    """
    on = tuple(effects)
    try:
        pulling = pulls(sky, body, perturbers, (*on, *off))
    except EarthspinError:
        off = [name for name in off if name != PLANETS.name]
        pulling = pulls(sky, body, perturbers, on)
    added = {name: forces_of(body, pulling, (*on, name), keep=True) for name in off}
    return forces_of(body, pulling, on, keep=True), added


#: Samples of half a synodic orbit; the mean over it converges exponentially.
_SAMPLES = 1000


def drift_by_planets(body: Body, seconds: float) -> dict[str, float]:
    """Displacement of the axis of a planet by the other planets after some time, rad, by effect.

    It follows from their mean torque on circular orbits in one plane, without their positions:
    within 10 % for the Earth and Mars over ten years. Empty for a body that is not a planet of the
    Sun, or whose obliquity is not known.
    """
    obliquity = obliquity_of(body)
    if body.name not in PLANET_NAMES or body.orbital_period is None or obliquity is None:
        return {}
    phases = math.pi * (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    own, pull = _orbit_radius(body), 0.0
    for name in PLANET_NAMES:
        if name != body.name:
            other = _orbit_radius(BODIES[name])
            square = own**2 + other**2 - 2 * own * other * np.cos(phases)
            pull += BODIES[name].number("gm") * float(np.mean(square**-1.5))
    speed = 0.75 * body.number("dynamical_flattening") / float(body.spin_rate) * pull
    factor = float(carried(body, pull, obliquity).rate)
    return {PLANETS.name: abs(speed * math.sin(2 * obliquity) * factor * seconds)}


def _orbit_radius(planet: Body) -> float:
    """Mean radius of the orbit about the Sun, m, from its period."""
    return math.cbrt(SUN.number("gm") * (planet.number("orbital_period") / (2 * math.pi)) ** 2)
