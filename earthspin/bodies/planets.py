"""The planets, and what pulls on each unless others are named."""

from __future__ import annotations

from earthspin.bodies.body import BODIES, Body
from earthspin.bodies.giants import JUPITER, NEPTUNE, ORBITS, SATURN, URANUS
from earthspin.bodies.inner import MERCURY, VENUS
from earthspin.bodies.moons import ORBITS as OF_MOONS

__all__ = [
    "JUPITER", "MERCURY", "NEPTUNE", "PLANETS", "SATURN", "URANUS", "VENUS",
    "on_its_orbit", "pulled_by",
]  # fmt: skip

#: Those that circle the Sun: what the effect ``planets`` adds to the perturbers.
PLANETS = ("mercury", "venus", "earth", "mars", "jupiter", "saturn", "uranus", "neptune")

_SUN_AND_MOON = ("sun", "moon")
_OTHERS = (
    {name: ("sun",) for name in PLANETS if name != "earth"}
    | {"moon": ("earth", "sun")}
    | {name: (orbit.about, "sun") for name, orbit in OF_MOONS.items()}
)


def pulled_by(body: Body) -> tuple[Body, ...]:
    """What pulls on a body unless others are named: Sun and Moon, or the Sun and its planet."""
    return tuple(BODIES[name] for name in _OTHERS.get(body.name, _SUN_AND_MOON))


def on_its_orbit(body: Body) -> Body:
    """A giant on its mean orbit, where nothing else places it; any other body as it is."""
    placed = body.orbit is not None or body.position is not None
    if placed or body.name not in ORBITS:
        return body
    return body.replace(orbit=ORBITS[body.name], orbit_pole=body.orbit_pole)
