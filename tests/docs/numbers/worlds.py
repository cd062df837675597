"""Numbers of the page on other worlds; its table is held by tests/test_worlds.py."""

from __future__ import annotations

from earthspin.bodies import JUPITER, NUMBERS, SATURN
from earthspin.bodies.giants import OF_JUPITER, OF_SATURN
from earthspin.bodies.satellites import added_by
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/worlds.md"


def shares() -> list[float]:
    """J2 with satellites over that of the planet alone."""
    found = []
    for planet, moons in ((JUPITER, OF_JUPITER), (SATURN, OF_SATURN)):
        q, _ = added_by(moons, planet.gm, planet.radius, planet.spin_period)
        found.append(planet.j2 / (NUMBERS[planet.name]["j2"].value - q))
    return found


MEASURED = [Sentence(PAGE, "with theirs, {} times and {} times the $J_2$", shares)]
TOLD = [Told(PAGE, "Half-widths are for {} %", "what an error is, by definition")]
