"""Numbers of the Sun with sources and uncertainties, and the built-in body made of them."""

from __future__ import annotations

from earthspin.bodies.body import Body
from earthspin.constants import DE440, GM_HORIZONS, IERS_2010, Constant

NUMBERS = {
    "gm": Constant(
        132712440041.279419e9,
        "m3 s-2",
        1e10,
        DE440 + "; uncertainty from " + IERS_2010,
        GM_HORIZONS,
    ),
    "radius": Constant(
        6.957e8,
        "m",
        0.0,
        "IAU 2015 Resolution B3: nominal solar radius",
        "R_sun of astropy.constants",
    ),
}

SUN = Body.cited("sun", NUMBERS, naif=(10,), reference=NUMBERS["gm"].source)
