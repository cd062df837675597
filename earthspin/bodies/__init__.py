"""Bodies as data: the class, and one cited file for each world."""

from earthspin.bodies.body import BODIES, NUMBERS, Body, Numeric, all_of, body
from earthspin.bodies.earth import EARTH
from earthspin.bodies.mars import MARS
from earthspin.bodies.moon import MOON
from earthspin.bodies.planets import PLANETS
from earthspin.bodies.sun import SUN

__all__ = [
    "BODIES", "EARTH", "MARS", "MOON", "NUMBERS", "PLANETS", "SUN", "WITH_ARTICLE", "Body",
    "Numeric", "all_of", "body",
]  # fmt: skip

#: Names that take the article in a sentence: the Moon, but Mars.
WITH_ARTICLE = (EARTH.name, MOON.name, SUN.name)
