"""Cassini state of the Moon on its real orbit: what `cassini_states` leaves out, measured.

The energy of the Moon's figure in the pull of the Earth, and of the Sun, is averaged over four
turns of the node with positions of a kernel, for a rigid body that turns evenly with the mean
longitude and whose axis leans from the ecliptic's pole, opposite to the normal of the orbit. A
steadily precessing rigid body has the angular momentum C (n + nu), n the mean motion and nu the
rate at which the node regresses: its turns count from the node.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from earthspin.bodies import EARTH, MOON, SUN
from earthspin.bodies.planets import MEAN_MOON, MOON_NODE
from earthspin.constants import DAY
from earthspin.numerics.arrays import FloatArray
from earthspin.sky import iau_models
from earthspin.sky.ephemeris import open_ephemeris

#: Turns of the node before and after J2000.0, and the time between two samples, d.
TURNS, STEP = 2, 0.5
#: Bracket of the tilt to the ecliptic, and step of the derivative, rad.
BRACKET, SLOPE = (0.005, 0.06), 1e-4


@dataclass(frozen=True)
class Sky:
    """Positions of Earth and Sun from the Moon on ecliptic axes, with weights of a mean.

    Attributes
    ----------
    days, weights : ndarray, shape (n,)
    earth, sun : ndarray, shape (n, 3)
        m.
    longitude : ndarray, shape (n,)
        Mean longitude of the Moon, rad: a straight line through the true one.
    """

    days: FloatArray
    weights: FloatArray
    earth: FloatArray
    sun: FloatArray
    longitude: FloatArray


ORBIT = MEAN_MOON.orbit
assert ORBIT is not None
assert ORBIT.node_period is not None
assert ORBIT.period is not None
NODE_RATE = -2 * math.pi / ORBIT.node_period  # rad/s, positive where the node regresses
MOTION = 2 * math.pi / ORBIT.period


def sky(kernel: str = "de421") -> Sky:
    """Sample the sky of the Moon."""
    span = TURNS * MOON.cycle / DAY
    days = np.arange(-span, span, STEP)
    weights = np.hanning(days.size)
    seen = open_ephemeris(kernel).positions({"earth": 399, "sun": 10}, 301, days)
    earth, sun = (seen[name] @ iau_models.fixed_ecliptic().T for name in ("earth", "sun"))
    true = np.unwrap(np.arctan2(-earth[:, 1], -earth[:, 0]))
    mean = np.polyval(np.polyfit(days, true, 1, w=np.sqrt(weights)), days)
    return Sky(days, weights / weights.sum(), earth, sun, mean)


def energy(sky: Sky, position: FloatArray, gm: float, tilt: float) -> float:
    """Mean energy of the Moon's figure per M R2, s-2, at a tilt to the ecliptic, rad."""
    polar = MOON.number("j2") / MOON.number("dynamical_flattening")
    half = MOON.number("triaxiality") / 2
    moments = polar - MOON.number("j2") + np.array([-half, half])
    node = math.radians(MOON_NODE.value) - NODE_RATE * DAY * sky.days
    sine, cosine, zero = np.sin(node), np.cos(node), np.zeros_like(node)
    up, across = math.cos(tilt), math.sin(tilt)
    axis = np.stack([-across * sine, across * cosine, zero + up], axis=-1)
    line = np.stack([cosine, sine, zero], axis=-1)
    turned = (sky.longitude - node)[:, np.newaxis]
    long = np.cos(turned) * line + np.sin(turned) * np.cross(axis, line)
    far = np.linalg.norm(position, axis=1)
    cosines = [np.sum(a * position, axis=1) / far for a in (long, np.cross(axis, long), axis)]
    figure = sum(m * c**2 for m, c in zip((*moments, polar), cosines, strict=True))
    return float(1.5 * gm * np.sum(sky.weights * figure / far**3))


def obliquity(sky: Sky, *, with_sun: bool, from_node: bool) -> float:
    """Obliquity to the mean orbit in the upright Cassini state, deg.

    Parameters
    ----------
    sky : Sky
    with_sun : bool
        Whether the Sun pulls on the figure, too.
    from_node : bool
        Whether the spin counts from the node.
    """
    assert ORBIT is not None
    pulls = [(sky.earth, float(EARTH.gm)), *([(sky.sun, float(SUN.gm))] if with_sun else [])]
    polar = MOON.number("j2") / MOON.number("dynamical_flattening")
    momentum = polar * (MOTION + NODE_RATE * from_node)

    def slope(tilt: float) -> float:
        more, less = (
            sum(energy(sky, position, gm, tilt + way * SLOPE) for position, gm in pulls)
            for way in (1, -1)
        )
        return NODE_RATE * math.sin(tilt) - (more - less) / (2 * SLOPE * momentum)

    return math.degrees(brentq(slope, *BRACKET) + ORBIT.i)
