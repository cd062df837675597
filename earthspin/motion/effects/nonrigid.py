"""Nutation response of a body's non-rigid interior, added to the path of the rigid body.

Its size includes the different initial axes: the rigid path starts at the true pole of IAU
2006/2000A, the path with the response starts 30 mas away, such that the mean poles agree.
"""

from __future__ import annotations

from typing import NamedTuple

from earthspin.constants import DAYS_PER_YEAR, MAS, UAS
from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.forces import Forces


class Growth(NamedTuple):
    """Bound on an angle that grows in time: a + b |t|, t in years from J2000.0, in mas."""

    swing: float
    rate: float

    def at(self, day: float) -> float:
        """Bound at a time in days from J2000.0, rad."""
        return MAS * (self.swing + self.rate * abs(day) / DAYS_PER_YEAR)


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    return forces


NONRIGID = Effect("nonrigid", _switch_on)

#: Bound on the displacement of the figure axis of the Earth by the response of its interior,
#: measured on DE421 from 1950 to 2050 with `python -m data_tools neglected`.
RESPONSE = Growth(84.4, 0.116)
#: Largest amplitude of the free core nutation in windows of three years from 1984 to 2026, rad, in
#: the section `core_nutation` of `earthspin.pole_offsets`; no model predicts it.
LARGEST_CORE_NUTATION = 290 * UAS
