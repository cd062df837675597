"""The Moon."""

from __future__ import annotations

from earthspin.bodies.body import Body
from earthspin.constants import DAY, DAYS_PER_CENTURY, DE440, SIDEREAL_MONTH, Constant

NUMBERS = {
    "gm": Constant(
        4902.800118e9,
        "m3 s-2",
        4.2e4,
        DE440 + "; uncertainty: the difference from DE421's 4902.800076",
    ),
    "orbital_period": SIDEREAL_MONTH,
    # the node goes once round in 1296000"/6962890.5431" centuries = 6798.383 d
    "cycle": Constant(
        1296000.0 / 6962890.5431 * DAYS_PER_CENTURY * DAY,
        "s",
        0.0,
        "Simon et al. 1994, A&A 282, 663, sect. 3.5: rate of the mean longitude of the node",
    ),
}

MOON = Body.cited("moon", NUMBERS, naif=(301,), reference=NUMBERS["gm"].source)
