"""Torques of the nearest masses on the zonal harmonics J3 and J4 of the body."""

from __future__ import annotations

from dataclasses import replace

from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.forces import Forces


def _harmonic(degree: int) -> Effect:
    def switch_on(forces: Forces, body: Numbers) -> Forces:
        coefficient = body.number(f"j{degree}")
        if not coefficient:
            return forces
        zonal = {**forces.figure.zonal, degree: coefficient}
        return replace(forces, figure=replace(forces.figure, zonal=zonal))

    return Effect(f"j{degree}", switch_on, coefficient=f"j{degree}")


J3 = _harmonic(3)
J4 = _harmonic(4)
