r"""Laplace plane of a moon, to which its orbital elements refer if no plane is given.

Its normal lies between the pole of the planet and the normal of the planet's orbit, at the angle
\theta from the pole (Tremaine, Touma & Namouni 2009, AJ 137, 3706, eq. 23):

    tan(2 \theta) = sin(2 \epsilon) / (cos(2 \epsilon) + 2 J GM / (n2 a5)),

with the obliquity \epsilon and the mean motion n of the planet, the semi-major axis a of the moon,
and J = J2 R2 + (1/2) sum (m/M) a_i2 b_i over the moons inside its orbit, where b_i = b_3/2^(1)/(3
\alpha) of \alpha = a_i/a is the Laplace coefficient of two rings.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from earthspin.bodies.orbit import Orbit
from earthspin.errors import BodyError
from earthspin.sky.elements import Plane
from earthspin.sky.poles import angle, fixed_equator

_NORTH = np.array([0.0, 0.0, 1.0])


def reference_plane(orbit: Orbit, gm: float, planet: Any, pole: Any, normal: Any) -> Plane:
    """Plane to which elements refer: the Laplace plane of the moon, or that of the orbit's `plane`.

    `pole` and `normal` are pole and orbit normal of the spinning body; the others are those of
    `laplace_plane`.
    """
    return laplace_plane(orbit, gm, planet) or Plane.of(orbit.plane or "ecliptic", pole, normal)


def laplace_plane(orbit: Orbit, gm: float, planet: Any) -> Plane | None:
    """Laplace plane of a moon with a given GM (m3 s-2); None if it is not the reference plane.

    `planet` is the central `Body`, or None if the centre is no built-in body. The Laplace plane is
    not the reference plane if the orbit has a plane of its own, if the centre is the Earth (the
    elements of the Moon refer to the ecliptic), or if the planet's orbit is not known. Longitudes
    count from the ascending node of the plane on the equator of the ICRF.
    """
    if orbit.plane is not None or planet is None or planet.pole is None or gm > planet.gm:
        return None
    if planet.pole.of_the_iau or planet.orbit_pole is None or planet.orbital_period is None:
        return None
    if hasattr(orbit.a, "dims") or hasattr(orbit.period, "dims"):
        problem = "values along a dimension have planes of their own; set plane = 'ecliptic'"
        raise BodyError(planet.name, "orbit.plane of its moon", None, problem)
    pole = planet.pole.without_nutation().mean(np.zeros(1))[0]
    normal = planet.orbit_pole.vector()
    obliquity, mass = angle(pole, normal), planet.number("gm")
    period: Any = orbit.period
    a: Any = orbit.a if period is None else math.cbrt(mass * (period / math.tau) ** 2)
    bulge = planet.number("j2") * planet.number("radius") ** 2
    for moon in planet.satellites:
        if moon.a < 0.99 * a:
            square = (moon.a / a) ** 2
            ring = 1 + square * (15 / 8 + square * 175 / 64)
            bulge += 0.5 * moon.gm / mass * moon.a**2 * ring
    ratio = 2 * bulge * mass / ((math.tau / planet.orbital_period) ** 2 * a**5)
    tilt = math.atan2(math.sin(2 * obliquity), math.cos(2 * obliquity) + ratio) / 2
    leaning = normal - math.cos(obliquity) * pole
    size = float(np.linalg.norm(leaning))
    if size:
        pole = math.cos(tilt) * pole + math.sin(tilt) / size * leaning
    return Plane(tuple(fixed_equator(pole, -_NORTH).ravel().tolist()))
