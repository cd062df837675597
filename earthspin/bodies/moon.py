"""Numbers of the Moon with sources and uncertainties, and the built-in body made of them."""

from __future__ import annotations

import math

from earthspin.bodies.body import Body
from earthspin.constants import (
    DAY,
    DAYS_PER_CENTURY,
    DE440,
    GM_HORIZONS,
    PCK11,
    SHTOOLS,
    SIDEREAL_MONTH,
    Constant,
    Tabulated,
)  # fmt: skip
from earthspin.sky.moving_pole import MovingPole
from earthspin.sky.poles import Direction

_GRAIL = "Williams et al. 2014, JGR Planets 119, 1546 (GRAIL and laser ranging)"
_GRAIL_READ = SHTOOLS + "Moon.py"
#: Gravity field of DE430, by degree and order.
_DE430_READ = "mockingbirdnest/Principia, astronomy/sol_gravity_model.proto.txt"

#: Observed obliquity of the Moon to its orbit.
OBLIQUITY = Constant(
    6.688,
    "deg",
    None,
    "1.543 to the ecliptic (arXiv:2201.00803) and 5.145 of the orbit",
    "arXiv:2201.00803; page of the Moon of JPL Horizons",
)
#: (C - A)/B and (B - A)/C.
BETA = Constant(6.310213e-4, "", 3.1e-9, _GRAIL, _GRAIL_READ)
GAMMA = Constant(2.277317e-4, "", 4.2e-9, _GRAIL, _GRAIL_READ)
J2 = Constant(2.03216e-4, "", 2e-9, _GRAIL + "; rounded", f"2.03214e-4 of DE430: {_DE430_READ}")

# moments in units of C: A = B - gamma and 1 - A = beta B
_B = (1 + GAMMA.value) / (1 + BETA.value)
_H = 1 - (_B - GAMMA.value / 2)

NUMBERS = {
    "gm": Constant(
        4902.800118e9,
        "m3 s-2",
        4.2e4,
        DE440 + "; uncertainty: the difference from DE421's 4902.800076",
        GM_HORIZONS,
    ),
    "radius": Constant(1738.0e3, "m", None, "reference radius of " + _GRAIL, _DE430_READ),
    "j2": J2,
    "dynamical_flattening": Constant(_H, "", 4e-9, "from beta and gamma: " + _GRAIL, _GRAIL_READ),
    "triaxiality": Constant(
        GAMMA.value * J2.value / _H, "", None, "gamma C/(M R2): " + _GRAIL, _GRAIL_READ
    ),
    # synchronous rotation
    "spin_period": SIDEREAL_MONTH,
    "orbital_period": SIDEREAL_MONTH,
    # period of the node, 1296000"/6962890.5431" centuries = 6798.383 d
    "cycle": Constant(
        1296000.0 / 6962890.5431 * DAYS_PER_CENTURY * DAY,
        "s",
        0.0,
        "Simon et al. 1994, A&A 282, 663, sect. 3.5: rate of the mean longitude of the node",
        "ERFA, eraFaom03",
    ),
}

POLE = Tabulated(
    "pole of the Moon", "Archinal et al. 2011, Celest. Mech. 109, 101 (IAU 2009)", PCK11
)
#: Terms of the IAU pole: phase at J2000.0 (deg) and rate (deg/d) of E1 to E4, E6, E7, E10, E13.
_TERMS = {
    1: (125.045, -0.0529921),
    2: (250.089, -0.1059842),
    3: (260.008, 13.0120009),
    4: (176.625, 13.3407154),
    6: (311.589, 26.4057084),
    7: (134.963, 13.0649930),
    10: (15.134, -0.1589763),
    13: (25.053, 12.9590088),
}


def _terms(sizes: dict[int, float]) -> list[tuple[float, float, float]]:
    """Amplitude (deg), phase (deg), rate (deg/century) of periodic terms of the Moon's pole."""
    return [(s, _TERMS[n][0], _TERMS[n][1] * DAYS_PER_CENTURY) for n, s in sizes.items()]


MOON = Body.cited(
    "moon",
    NUMBERS,
    naif=(301,),
    pole=MovingPole.published(
        (269.9949, 0.0031),
        (66.5392, 0.0130),
        _terms(
            {1: -3.8787, 2: -0.1204, 3: 0.0700, 4: -0.0172, 6: 0.0072, 10: -0.0052, 13: 0.0043}
        ),
        _terms(
            {
                1: 1.5419, 2: 0.0239, 3: -0.0278, 4: 0.0068, 6: -0.0029, 7: 0.0009, 10: 0.0008,
                13: -0.0009,
            }
        ),
    ),
    # the orbit precesses about the normal of the ecliptic of J2000.0
    orbit_pole=Direction(math.radians(270.0), math.radians(66.5607)),
    reference=f"{NUMBERS['gm'].source}; {_GRAIL}",
)  # fmt: skip
