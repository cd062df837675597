"""Torques of the planets on the equatorial bulge of a body."""

from __future__ import annotations

from dataclasses import replace

from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.forces import Forces


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    return replace(forces, gm={**forces.gm, **forces.far})


PLANETS = Effect("planets", _switch_on)
