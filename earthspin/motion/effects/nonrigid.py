"""The response of the inside to nutation, which is added to the path of the rigid body."""

from __future__ import annotations

from earthspin.motion.effects.effect import Effect, Growth, Numbers
from earthspin.motion.forces import Forces


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    return forces


NONRIGID = Effect("nonrigid", _switch_on, Growth(57.5))
