"""Venus as a body that spins: a world with figure, spin and pole, each number with its source."""

from __future__ import annotations

import math

from earthspin.bodies import Body
from earthspin.constants import DAY, DE440, Constant
from earthspin.sky.poles import Direction, FixedPole

_MARGOT = "Margot et al. 2021, Nature Astronomy 5, 676"

J2 = Constant(4.404e-6, "", None, "Konopliv et al. 1999, Icarus 139, 3 (MGNP180U), rounded")
#: C/(M R2).
POLAR_MOMENT = Constant(0.337, "", 0.024, _MARGOT)

NUMBERS = {
    "gm": Constant(324858.592e9, "m3 s-2", None, DE440),
    "radius": Constant(6051e3, "m", None, "reference radius of Konopliv et al. 1999"),
    "j2": J2,
    "dynamical_flattening": Constant(
        J2.value / POLAR_MOMENT.value,
        "",
        J2.value / POLAR_MOMENT.value * POLAR_MOMENT.relative_uncertainty,
        f"J2 over C/(M R2): {J2.source}; {POLAR_MOMENT.source}",
    ),
    # retrograde
    "spin_period": Constant(-243.0226 * DAY, "s", 0.0013 * DAY, _MARGOT),
    "orbital_period": Constant(
        224.70079922 * DAY, "s", None, "Standish & Williams, approximate elements, sidereal"
    ),
    "slow_swing": Constant(1e-3, "", None, "as the other planets: not measured"),
}

VENUS = Body.cited(
    "venus",
    NUMBERS,
    naif=(299, 2),
    # Archinal et al. 2011, Celest. Mech. 109, 101
    pole=FixedPole(math.radians(272.76), math.radians(67.16)),
    # from i = 3.39467605, node = 76.67984255 deg to the ecliptic (Standish & Williams)
    orbit_pole=Direction(math.radians(278.00765), math.radians(65.56701)),
    reference=f"{_MARGOT}; Konopliv et al. 1999; Archinal et al. 2011; DE440",
)
