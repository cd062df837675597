"""The planets, and the default perturbers of each body."""

from __future__ import annotations

import math
from dataclasses import replace

from earthspin.bodies.body import BODIES, Body
from earthspin.bodies.giants import JUPITER, NEPTUNE, ORBITS, SATURN, URANUS
from earthspin.bodies.inner import MERCURY, VENUS
from earthspin.bodies.moons import ORBITS as OF_MOONS
from earthspin.bodies.sun import SUN
from earthspin.constants import COMPUTED, Constant

__all__ = [
    "JUPITER", "LEFT_OUT_OF_RATES", "MERCURY", "NEPTUNE", "PLANETS", "SATURN", "URANUS", "VENUS",
    "on_its_orbit", "pulled_by",
]  # fmt: skip

#: The planets; the effect ``planets`` adds them to the perturbers.
PLANETS = ("mercury", "venus", "earth", "mars", "jupiter", "saturn", "uranus", "neptune")

#: Contributions to the precession rate other than torques on the bulge, by planet and effect.
LEFT_OUT_OF_RATES: dict[str, dict[str, Constant]] = {
    "mars": {
        "geodesic": Constant(
            -6.754e-3,
            "arcsec/yr",
            None,
            "Baland et al. 2023, A&A 670, A29",
            "abstract of arXiv:2211.04937",
        ),
    },
    "saturn": {
        "C from pole data": Constant(
            -0.07,
            "arcsec/yr",
            None,
            "C/(M R2) = 0.2405 agrees with the pole of Jacobson 2007, BAAS 39, 317: 0.672",
            COMPUTED,
        ),
    },
}

_SUN_AND_MOON = ("sun", "moon")
_OTHERS = (
    {name: ("sun",) for name in PLANETS if name != "earth"}
    | {"moon": ("earth", "sun")}
    | {name: (orbit.about, "sun") for name, orbit in OF_MOONS.items()}
)


def pulled_by(body: Body) -> tuple[Body, ...]:
    """Default perturbers of a body: the Sun and the Moon, or the Sun and the body's planet."""
    return tuple(BODIES[name] for name in _OTHERS.get(body.name, _SUN_AND_MOON))


def on_its_orbit(body: Body) -> Body:
    """Set the mean orbit of a giant planet that has neither an orbit nor a position source."""
    placed = body.orbit is not None or body.position is not None
    if placed or body.name not in ORBITS:
        return body
    orbit = ORBITS[body.name]
    assert orbit.a is not None
    # with its period, the orbit stays the same if an ensemble varies the mass
    nominal = BODIES[body.name] if hasattr(body.gm, "dims") else body
    period = 2 * math.pi * math.sqrt(orbit.a**3 / (SUN.gm + nominal.gm_on(SUN)))
    orbit = replace(orbit, period=period)
    return body.replace(orbit=orbit, orbit_pole=body.orbit_pole)
