"""Second-order effects: torques computed for the nutating axis instead of the mean pole."""

from __future__ import annotations

from dataclasses import replace

from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.forces import Forces


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    return replace(forces, mean_pole=None)


SECOND_ORDER = Effect("second-order", _switch_on)
