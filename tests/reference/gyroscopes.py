"""Spin of a planet and orbit normals of its satellites as gyroscopes, integrated in time.

Energies after averaging over orbits: -k (p.q)2 for each two axes p and q, with k from the
quadrupoles of bulge and orbits; each axis turns by the torque divided by its angular momentum.
"""

import math
from itertools import combinations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipe, ellipk

from earthspin.bodies import EARTH, Body
from earthspin.bodies.orbit import Satellite
from earthspin.constants import JULIAN_YEAR
from earthspin.questions.satellites import node_nutations, satellite_factors
from earthspin.torque.laplace import Planet, Satellites, laplace_tilts, shares, uneven


def laplace_coefficient(ratio: float) -> float:
    """Laplace coefficient b_3/2^(1) by complete elliptic integrals."""
    square = 4 * ratio / (1 + ratio) ** 2
    first, second = ellipk(square), ellipe(square)
    scale = 2 / (np.pi * ratio * (1 + ratio))
    return scale * ((1 + ratio**2) / (1 - ratio) ** 2 * second - first)


def path(
    body: Body, pull: float, axes: np.ndarray, normal: np.ndarray, years: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Spin axis and total angular momentum in time, unit vectors of shape (t, 3).

    Parameters
    ----------
    body : Body
    pull : float
        GM/(a3 (1 - e2)^1.5) of the Sun, s-2.
    axes : ndarray, shape (axis, 3)
        At the first time: the spin, then the normals of the orbits.
    normal : ndarray, shape (3,)
        Normal of the planet's orbit.
    years : ndarray, shape (t,)
    """
    gm = np.array([moon.gm for moon in body.satellites])
    a = np.array([moon.a for moon in body.satellites])
    bulge = body.gm * body.j2 * body.radius**2
    polar = body.j2 / body.dynamical_flattening
    momentum = np.append(
        polar * body.gm * body.radius**2 * body.spin_rate, gm * np.sqrt((body.gm + gm) * a)
    )
    sun = np.append(0.75 * pull * bulge, 0.375 * pull * gm * a**2)
    pairs = np.zeros((gm.size + 1, gm.size + 1))
    pairs[0, 1:] = pairs[1:, 0] = 0.75 * bulge * gm / a**3
    for i in range(gm.size):
        for j in range(i):
            inner, outer = sorted((a[i], a[j]))
            size = gm[i] * gm[j] * inner / outer**2 * laplace_coefficient(inner / outer) / 8
            pairs[i + 1, j + 1] = pairs[j + 1, i + 1] = size

    scale = 2 * JULIAN_YEAR / momentum

    def rate(_: float, flat: np.ndarray) -> np.ndarray:
        x, y, z = own = flat.reshape(-1, 3).T
        px, py, pz = own @ (pairs * (own.T @ own)) + np.outer(normal, sun * (normal @ own))
        turned = scale * np.array([y * pz - z * py, z * px - x * pz, x * py - y * px])
        return turned.T.ravel()

    found = solve_ivp(
        rate, (years[0], years[-1]), axes.ravel(), "DOP853", years, rtol=1e-9, atol=1e-12
    )
    moved = found.y.T.reshape(years.size, -1, 3)
    total = np.einsum("j,tjk->tk", momentum, moved)
    return moved[:, 0], total / np.linalg.norm(total, axis=1)[:, np.newaxis]


YEAR_RATE2 = (2 * math.pi / JULIAN_YEAR) ** 2


def planet_with(moons: list[tuple[float, float, float]], like: Body = EARTH, **keys: float) -> Body:
    """A planet with moons of given mass ratio, distance in radii, and inclination in deg."""
    satellites = [
        Satellite(name=f"moon {k}", gm=mass * like.gm, a=a * like.radius, i=math.radians(i))
        for k, (mass, a, i) in enumerate(moons)
    ]
    return like.replace(satellites=satellites, **keys)


def drawn(rng: np.random.Generator, inclination: float) -> tuple[Body, float, float]:
    """A planet, the pull of the Sun (s-2) and the obliquity (rad)."""
    count = int(rng.integers(1, 4))
    a = np.array([0.0, 0.0])
    while np.min(a[1:] / np.maximum(a[:-1], 1e-9), initial=9.0) < 1.4:
        a = np.sort(rng.uniform(5, 60, count))
    j2, moment = 10 ** rng.uniform(-3.5, -2), rng.uniform(0.2, 0.4)
    body = planet_with(
        [(10 ** rng.uniform(-5, -1.8), x, rng.uniform(0, inclination)) for x in a.tolist()],
        j2=j2,
        dynamical_flattening=j2 / moment,
        spin_period=rng.uniform(6, 40) * 3600,
    )
    return body, YEAR_RATE2 / rng.uniform(0.5, 5) ** 2, math.radians(rng.uniform(10, 63))


def direction(polar: float, off: float = 0.0, azimuth: float = 0.0) -> np.ndarray:
    """Unit vector at a polar angle in the x-z plane, then `off` it at an azimuth."""
    sine, cosine = math.sin(polar), math.cos(polar)
    mean, along = np.array([sine, 0, cosine]), np.array([cosine, 0, -sine])
    aside = math.cos(azimuth) * along + math.sin(azimuth) * np.array([0, 1.0, 0])
    return math.cos(off) * mean + math.sin(off) * aside


def rates(
    body: Body, pull: float, obliquity: float, azimuths: list[float]
) -> tuple[float, float, float]:
    """Rate of precession, the same integrated, rad/s, and relative half-width for inclined orbits.

    Orbits of the integration are circular, so that the half-width has no part for eccentricities.
    """
    factors = satellite_factors(body, pull, obliquity)
    alone = 1.5 * pull * math.cos(obliquity) * body.dynamical_flattening / body.spin_rate
    rate = alone * factors.rate
    numbers = [body.gm, body.radius, body.j2, body.j2 / body.dynamical_flattening, body.spin_rate]
    planet = Planet(*(np.full((1, 1), float(x)) for x in (*numbers, pull)), obliquity)
    arrays = np.array([(moon.gm, moon.a, moon.i) for moon in body.satellites]).T
    satellites = Satellites(*arrays)
    tilts = laplace_tilts(planet, satellites)[0]
    half = float(uneven(planet, satellites, *shares(planet, satellites))[0])
    nodes = node_nutations(body, pull, obliquity)
    axes = [direction(obliquity)]
    for moon, tilt, azimuth in zip(body.satellites, tilts, azimuths, strict=False):
        axes.append(direction(obliquity - tilt, moon.i, azimuth))
        if moon.i:
            off = -nodes[f"node of {moon.name}"].angle
            axes[0] = axes[0] + direction(obliquity, off, azimuth) - direction(obliquity)
    years = np.linspace(0, duration(body, pull, obliquity) / JULIAN_YEAR, 2001)
    spin, _ = path(body, pull, np.array(axes), np.array([0, 0, 1.0]), years)
    longitude = -np.unwrap(np.arctan2(spin[:, 1], spin[:, 0]))
    slope = np.gradient(longitude, years)[1:-1] / JULIAN_YEAR
    # a window that suppresses all that turns seven times or more within it
    mean = float(np.average(slope, weights=np.kaiser(slope.size, 20)))
    return rate, mean, half


def duration(body: Body, pull: float, obliquity: float) -> float:
    """Time over which nodes and their differences average out, s.

    It is 16 revolutions of each node and 8 beats of each two; without nodes, a year.
    """
    nodes = node_nutations(body, pull, obliquity).values()
    rates = [node.node_rate for node in nodes]
    slow = [rate / 2 for rate in rates] + [abs(p - q) for p, q in combinations(rates, 2)]
    return 16 * math.pi / min(slow) if slow else JULIAN_YEAR


#: Most revolutions of the fastest node in an integration, and how much faster than the precession
#: the nodes and their differences are: the planes are stationary over a revolution.
REVOLUTIONS, FASTER = 300, 5


def drawn_with_inclined_moons(
    rng: np.random.Generator, inclination: float
) -> tuple[Body, float, float]:
    """A planet as `drawn`, with nodes that average out within an integration of some seconds."""
    while True:
        body, pull, obliquity = drawn(rng, inclination)
        rate = 1.5 * pull * math.cos(obliquity) * body.dynamical_flattening / body.spin_rate
        rate *= float(satellite_factors(body, pull, obliquity).rate)
        time = duration(body, pull, obliquity)
        fastest = max(node.node_rate for node in node_nutations(body, pull, obliquity).values())
        if fastest * time < 2 * math.pi * REVOLUTIONS and 16 * math.pi > FASTER * rate * time:
            return body, pull, obliquity
