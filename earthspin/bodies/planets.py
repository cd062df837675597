"""The other planets, as bodies that pull."""

from __future__ import annotations

from earthspin.bodies.body import Body
from earthspin.constants import DE440, Constant

#: Those that circle the Sun: what the effect ``planets`` adds to the perturbers.
PLANETS = ("mercury", "venus", "earth", "mars", "jupiter", "saturn", "uranus", "neptune")


def _planet(name: str, code: int, gm: float) -> Body:
    """A planet as a perturber: its mean pull swings through centuries by up to 1e-3 of itself."""
    return Body.cited(
        name,
        {"gm": Constant(gm, "m3 s-2", None, DE440)},
        naif=(100 * code + 99, code),
        slow_swing=1e-3,
        reference=DE440,
    )


MERCURY = _planet("mercury", 1, 22031.868551e9)
VENUS = _planet("venus", 2, 324858.592000e9)
JUPITER = _planet("jupiter", 5, 126712764.100000e9)
SATURN = _planet("saturn", 6, 37940584.841800e9)
URANUS = _planet("uranus", 7, 5794556.400000e9)
NEPTUNE = _planet("neptune", 8, 6836527.100580e9)
