"""Coverage of the precession of planets with inclined moons: an integration of spin and orbits.

The half-width is that of the inclined orbits alone: orbits of the integration are circular, and
averaged over the revolutions of moons and Sun.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from data_tools.coverage import Row
from earthspin.progress import progress
from tests.reference.gyroscopes import drawn_with_inclined_moons, rates

#: Planets, the seed of their draws, and the largest inclination, deg. The factors of the half-width
#: were chosen on draws of another seed.
PLANETS, SEED, INCLINATION = 60, 777, 8.0


def rows() -> Iterator[Row]:
    """Yield the row of all planets, and those by the number of moons."""
    generator, cases = np.random.default_rng(SEED), []
    with progress("planets", PLANETS) as advance:
        for _ in range(PLANETS):
            planet = drawn_with_inclined_moons(generator, INCLINATION)
            rate, integrated, half = rates(*planet, generator.uniform(0, 2 * math.pi, 3).tolist())
            cases.append((len(planet[0].satellites), rate / integrated - 1, half))
            advance(1)
    count, difference, half = np.transpose(cases)
    for words, chosen in (
        ("one to three moons", count > 0),
        ("one moon", count == 1),
        ("two or three moons", count > 1),
    ):
        yield Row.comparing(
            "rate of precession with inclined moons",
            f"{words}, up to {INCLINATION:.0f}°",
            "integration of spin and orbits",
            difference[chosen],
            half[chosen],
        )
