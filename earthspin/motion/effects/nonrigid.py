"""Nutation response of a body's non-rigid interior, added to the path of the rigid body.

Its size includes the different initial axes: the rigid path starts at the true pole of IAU
2006/2000A, the path with the response starts 30 mas away, such that the mean poles agree.
"""

from __future__ import annotations

from earthspin.motion.effects.effect import Effect, Growth, Numbers
from earthspin.motion.forces import Forces


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    return forces


NONRIGID = Effect("nonrigid", _switch_on, Growth(84.4, 0.116))
