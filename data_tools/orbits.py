"""The orbits of the Earth and of Mars over ten million years either way, from DE440 by REBOUND.

    python -m data_tools orbits [KERNEL]     (needs `pip install rebound==5.2.2`, and AVX512)

Sun and eight planets (a planet with its moons is one mass at their barycentre) start from DE440 at
J2000.0 TDB and go on by the symplectic map of Wisdom and Holman with a corrector of order 17
(WHFast512, Javaheri, Rein & Tamayo 2023, Open J. Astrophys. 6), in steps of 5 d. To Newton's law
two things are added:

- general relativity, by the potential -3 (G M / (c r))^2 about the Sun, which gives each perihelion
  its advance (Nobili & Roxburgh 1986);
- that the Earth and the Moon are two: the mean quadrupole of the pair turns the perihelion of their
  barycentre by 3/4 (a_moon/a)^2 0.8525 m_e m_m/(m_e + m_m)^2 of its mean motion (Quinn, Tremaine &
  Duncan 1991, AJ 101, 2287, sect. 2), which is done by turning its orbit in its plane at each stop.

Left out are asteroids, the flattening of the Sun, its loss of mass, and tides.

Every 40 years the heliocentric orbit is read: unit normal n and eccentricity vector e. Short
periods alias at such stops; a smoothing polynomial over 4,000 years and a least-squares fit of
Legendre polynomials, window by window, leave what varies over more than some two thousand years.
How far steps of half the length lead away, window by window, stands in the tables as their error.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import savgol_filter
from scipy.spatial.transform import Rotation

from earthspin.bodies import BODIES
from earthspin.constants import AU, DAY, J2000_JD, JULIAN_YEAR
from earthspin.numerics.arrays import FloatArray
from earthspin.sky import iau_models, orbit_table
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.sky.orbit_table import OrbitTable, fitted, write

#: Step, time between stops (2922 steps), and reach either way, s.
STEP, STOP, REACH = 5 * DAY, 40 * JULIAN_YEAR, 10.02e6 * JULIAN_YEAR
#: Planets in the order of the simulation, after the Sun; a moon counts with its planet.
PLANETS = ("mercury", "venus", "earth", "mars", "jupiter", "saturn", "uranus", "neptune")
EARTH = 1 + PLANETS.index("earth")
#: Of which tables are made, and how far they reach, s.
WORLDS = ("earth", "mars")
COVERS = 10e6 * JULIAN_YEAR
SOURCE = (
    "REBOUND 5.2.2, WHFast512 with corrector 17, steps of 5 d, from DE440 at J2000.0; relativity "
    "as a potential, quadrupole of Earth and Moon"
)
#: Stops under a smoothing polynomial, and its degree (Savitzky & Golay 1964).
SMOOTHING, SMOOTHING_DEGREE = 101, 7

#: Mean distance of the Moon over that of the Sun, and the share of a circular, coplanar orbit's
#: quadrupole that the Moon's true orbit has (Quinn, Tremaine & Duncan 1991).
MOON_OVER_SUN, SHARE = 0.0025696, 0.8525


def start(kernel: Path) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Masses (G m, m3/s2), places (m) and velocities (m/s) of Sun and planets at J2000.0, ICRF."""
    from jplephem.spk import SPK

    with SPK.open(str(kernel)) as file:
        states = [file[0, code].compute_and_differentiate(J2000_JD) for code in (10, *range(1, 9))]
    gm = [BODIES[name].gm for name in ("sun", *PLANETS)]
    gm[EARTH] += BODIES["moon"].gm
    places, velocities = np.moveaxis(1e3 * np.array(states), 1, 0)
    return np.array(gm), places, velocities / DAY


def integrate(
    kernel: Path,
    direction: int,
    reach: float = REACH,
    step: float = STEP,
) -> FloatArray:
    """Normals and eccentricity vectors at the stops, shape (n, 2, 2, 3): body, vector, axis.

    Parameters
    ----------
    kernel : Path
    direction : int
        1 forward; -1 backward, with all velocities turned round.
    reach, step : float
        How far, and in steps of what, s.
    """
    import rebound

    gm, places, velocities = start(kernel)
    time = math.sqrt(AU**3 / gm[0])  # so that G = 1, and c is the one that is built in
    simulation = rebound.Simulation()
    simulation.integrator = "whfast512"
    simulation.integrator.corrector = 17
    simulation.integrator.gr_potential = 1
    simulation.exact_finish_time = 0
    for m, place, velocity in zip(gm / gm[0], places / AU, velocities * time / AU, strict=True):
        simulation.add(m=m)
        simulation.particles[-1].xyz = list(place)
        simulation.particles[-1].vxyz = list(direction * velocity)
    simulation.move_to_com()
    simulation.dt = step / time
    simulation.integrator.concatenate_steps = a_stop = round(STOP / step)
    stops = math.ceil(reach / STOP)
    angle = moons_turn(gm) * a_stop * step
    samples = np.empty((stops + 1, len(WORLDS), 2, 3))
    for stop in range(stops + 1):
        if stop:
            simulation.steps(1)
            turn_in_plane(simulation.particles, EARTH, angle)
        for world, name in enumerate(WORLDS):
            place = 1 + PLANETS.index(name)
            samples[stop, world] = orbit(simulation.particles, place, direction)
    return samples


def relative(particles: Any, planet: int) -> tuple[FloatArray, FloatArray]:
    """Place and velocity of a planet as seen from the Sun, in the units of the simulation."""
    sun, body = particles[0], particles[planet]
    return np.subtract(body.xyz, sun.xyz), np.subtract(body.vxyz, sun.vxyz)


def orbit(particles: Any, planet: int, direction: int) -> FloatArray:
    """Unit normal and eccentricity vector of a planet's orbit about the Sun, shape (2, 3)."""
    r, v = relative(particles, planet)
    momentum = np.cross(r, v)
    mu = particles[0].m + particles[planet].m
    eccentricity = np.cross(v, momentum) / mu - r / np.linalg.norm(r)
    return np.stack([direction * momentum / np.linalg.norm(momentum), eccentricity])


def moons_turn(gm: FloatArray) -> float:
    """How fast the quadrupole of Earth and Moon turns the orbit of their barycentre, rad/s."""
    motion = math.sqrt((gm[0] + gm[EARTH]) / AU**3)
    share = BODIES["moon"].gm * BODIES["earth"].gm / gm[EARTH] ** 2
    return float(0.75 * MOON_OVER_SUN**2 * SHARE * share * motion)


def turn_in_plane(particles: Any, planet: int, angle: float) -> None:
    """Turn the orbit of a planet about its own normal, in the sense in which it goes."""
    r, v = relative(particles, planet)
    normal = np.cross(r, v)
    rotation = Rotation.from_rotvec(angle * normal / np.linalg.norm(normal))
    sun = particles[0]
    particles[planet].xyz = list(rotation.apply(r) + sun.xyz)
    particles[planet].vxyz = list(rotation.apply(v) + sun.vxyz)


def table_of(world: int, samples: FloatArray, halved: FloatArray) -> OrbitTable:
    """The table of a world, from samples of both directions, shape (n, world, vector, axis).

    Parameters
    ----------
    world : int
        Place in `WORLDS`.
    samples, halved : ndarray
        With steps as they are taken, and of half their length.
    """
    times = STOP * (np.arange(len(samples)) - len(samples) // 2)
    first, half = (smoothed(of[:, world]) for of in (samples, halved))
    inside = np.abs(times) <= COVERS * (1 + 1e-12)
    normals, eccentricities = first[inside, 0], first[inside, 1]
    axes = iau_models.fixed_ecliptic()
    table = fitted(WORLDS[world], times[inside], normals, eccentricities, axes, SOURCE)
    moved = np.linalg.norm(first - half, axis=2)
    starts = np.searchsorted(times, table.edges[:-1])
    by_steps = np.maximum.reduceat(moved, starts, axis=0).T
    return replace(table, errors=np.hypot(table.errors, by_steps))


def smoothed(samples: FloatArray) -> FloatArray:
    """Normals and eccentricity vectors without short periods, shape (n, 2, 3)."""
    slow = savgol_filter(samples, SMOOTHING, SMOOTHING_DEGREE, axis=0)
    slow[:, 0] /= np.linalg.norm(slow[:, 0], axis=1, keepdims=True)
    return np.asarray(slow)


def main(kernel: str = "de440") -> int:
    """Make the tables; more than an hour on one core."""
    path = open_ephemeris(kernel).path
    runs = []
    for step in (STEP, STEP / 2):
        past, future = (integrate(path, direction, step=step) for direction in (-1, 1))
        runs.append(np.concatenate([past[:0:-1], future]))
    for world, name in enumerate(WORLDS):
        write(Path(orbit_table.__file__).parent / "orbits" / f"{name}.npz", table_of(world, *runs))
    return 0
