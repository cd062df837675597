"""Mean precessing torque of a mass on a circular orbit in the reference plane, in closed form."""

import math


def circular_orbit_torque(gm: float, distance: float, obliquity: float) -> float:
    """In s-2, for a mass of GM `gm` (m3 s-2) at `distance` (m)."""
    return 1.5 * gm / distance**3 * math.cos(obliquity)
