"""Slow change of J2 due to post-glacial rebound of the mantle."""

from __future__ import annotations

from dataclasses import replace

from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.forces import Forces


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    j2 = body.number("j2")
    if not j2:
        return forces
    trend = body.number("j2_rate") / j2
    return replace(forces, figure=replace(forces.figure, j2_trend=trend))


J2_RATE = Effect("j2-rate", _switch_on, coefficient="j2_rate")
