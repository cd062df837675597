"""The class `Body`, the built-in bodies, and modules with the cited numbers of these bodies."""

from earthspin.bodies.body import BODIES, NUMBERS, Body, NumberName, body, label_of
from earthspin.bodies.checks import all_of
from earthspin.bodies.earth_moon_sun import EARTH, MOON, SUN
from earthspin.bodies.giants import JUPITER, NEPTUNE, SATURN, URANUS
from earthspin.bodies.inner import MARS, MERCURY, VENUS
from earthspin.bodies.moons import IAPETUS, PHOBOS, TITAN, TRITON
from earthspin.bodies.orbit import Orbit, Satellite
from earthspin.bodies.planets import PLANETS
from earthspin.numerics.arrays import Numeric

__all__ = [
    "BODIES", "EARTH", "IAPETUS", "JUPITER", "MARS", "MERCURY", "MOON", "NEPTUNE", "NUMBERS",
    "PHOBOS", "PLANETS", "SATURN", "SUN", "TITAN", "TRITON", "URANUS", "VENUS", "Body",
    "NumberName", "Numeric", "Orbit", "Satellite", "all_of", "body", "in_a_sentence", "label_of",
    "proper",
]  # fmt: skip

_WITH_ARTICLE = (EARTH.name, MOON.name, SUN.name)


def proper(name: str) -> str:
    """Capitalize the name of a built-in body, as in ``"Earth"``; return other names unchanged."""
    return name.capitalize() if name in BODIES else name


def in_a_sentence(name: str) -> str:
    """Return the name of a body as used in a sentence: ``"Mars"``, but ``"the Moon"``."""
    return f"the {proper(name)}" if name in _WITH_ARTICLE else proper(name)
