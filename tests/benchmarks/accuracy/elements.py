r"""Positions from orbital elements: the package, textbook methods and Skyfield.

The other methods compute the position in the plane of the orbit and rotate it as in a textbook.
With M the mean anomaly and J the Bessel functions,

    cos E = -e/2 + sum (2/k) J_k'(k e) cos kM,    sin E = (2/e) sum J_k(k e)/k sin kM.
"""

import math
from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.special import jv, jvp

from earthspin.constants import DAY
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.elements import Ellipse, Plane
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.sky import eccentric_anomaly
from tests.reference.stored import load

#: Coordinates in the plane of an orbit, x to the pericentre, m, and the number of evaluations of
#: the costly function.
Planar = tuple[FloatArray, FloatArray, int]

#: Eccentricities of the three ellipses: that of the Earth, and two for which iterations are slower.
ECCENTRICITIES = (0.0167, 0.5, 0.99)
#: Elements with a period of a month and a node period of nineteen years; m, rad, rad/s.
ELEMENTS = {
    "a": 4e8,
    "e": 0.5,
    "i": 0.2,
    "node": 1.0,
    "pericentre": 2.0,
    "mean_anomaly": 0.5,
    "epoch": 0.0,
    "motion": 2.5e-6,
    "node_rate": -1.05e-8,
    "pericentre_rate": 3.3e-8,
}
PLANE = Plane(tuple(np.eye(3).ravel().tolist()))
ORBIT = Ellipse(**ELEMENTS, plane=PLANE)
ORBITS = tuple(Ellipse(**ELEMENTS | {"e": e}, plane=PLANE) for e in ECCENTRICITIES)
#: Number of revolutions, and of positions on each ellipse.
TURNS, TIMES = 30, 100
#: Inputs of the stored reference.
INPUTS = ELEMENTS | {"turns": TURNS, "times": TIMES, "eccentricities": list(ECCENTRICITIES)}


def days() -> FloatArray:
    """Times of the positions, d, rounded to 1/16 d so that they are equal on every machine."""
    period = 2 * math.pi / ORBIT.motion / DAY
    return np.asarray(np.rint(16 * np.linspace(0, TURNS * period, TIMES)) / 16)


def ladder() -> Ladder:
    """Methods for positions from orbital elements."""
    true, t = load("elements", INPUTS)["places"], days()

    def by_elements() -> tuple[FloatArray, int]:
        return np.stack([orbit.positions(t) for orbit in ORBITS]), t.size * len(ORBITS)

    def in_plane(run: Callable[..., Planar], setting: float = 0.0) -> tuple[FloatArray, int]:
        """Positions on all test orbits by a method for the plane of the orbit."""
        positions, calls = [], 0
        for orbit in ORBITS:
            x, y, more = run(orbit, orbit.mean_anomaly + orbit.motion * DAY * t, setting)
            positions.append(_in_space(orbit, t, x, y))
            calls += more
        return np.stack(positions), calls

    others = {
        "fixed-point iteration": ("{} steps", _fixed_point, (5, 20, 80, 320)),
        "Newton's method from M": ("{} steps", _newton, (2, 4, 8, 16)),
        "Newton's method, Danby's start": ("{} steps", _danby, (2, 3, 4, 6, 8)),
        "series in the eccentricity": ("{} terms", _series, (3, 10, 30, 100, 300)),
    }
    return Ladder(
        title="Positions from orbital elements",
        problem="positions on ellipses of eccentricity 0.0167, 0.5 and 0.99 whose nodes and "
        f"pericentres precess, at {t.size} times in {TURNS} revolutions; the error is the "
        "largest, relative to the semi-major axis",
        reference="Kepler's equation with 50 digits, stored with 32",
        unit="1",
        floor=1e-28,
        error=lambda places: np.max(np.linalg.norm((places - true).hi, axis=-1)) / ORBIT.a,
        runs={
            "Orbit (start above the root)": {"": by_elements},
            **{
                name: settings(words, partial(in_plane, run), values)
                for name, (words, run, values) in others.items()
            },
            "universal variables by Skyfield": {"": partial(in_plane, _skyfield)},
        },
        bounds={"Orbit (start above the root)": 1e-13},
    )


def _in_space(orbit: Ellipse, t: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Rotate positions from the plane of the orbit to inertial axes."""
    along = orbit.pericentre + orbit.pericentre_rate * DAY * t
    node = orbit.node + orbit.node_rate * DAY * t
    u, v = x * np.cos(along) - y * np.sin(along), x * np.sin(along) + y * np.cos(along)
    flat, up = v * math.cos(orbit.i), v * math.sin(orbit.i)
    across = u * np.cos(node) - flat * np.sin(node), u * np.sin(node) + flat * np.cos(node)
    return np.stack([*across, up], axis=-1)


def _on_ellipse(orbit: Ellipse, cosine: FloatArray, sine: FloatArray, calls: float) -> Planar:
    """Coordinates in the orbital plane from cosine and sine of the eccentric anomaly."""
    return orbit.a * (cosine - orbit.e), orbit.a * math.sqrt(1 - orbit.e**2) * sine, int(calls)


def _fixed_point(orbit: Ellipse, mean: FloatArray, steps: float) -> Planar:
    anomaly = mean
    for _ in range(int(steps)):
        anomaly = mean + orbit.e * np.sin(anomaly)
    return _on_ellipse(orbit, np.cos(anomaly), np.sin(anomaly), mean.size * steps)


def _newton(
    orbit: Ellipse, mean: FloatArray, steps: float, start: FloatArray | None = None
) -> Planar:
    anomaly = eccentric_anomaly(mean, orbit.e, int(steps), start)
    return _on_ellipse(orbit, np.cos(anomaly), np.sin(anomaly), mean.size * steps)


def _danby(orbit: Ellipse, mean: FloatArray, steps: float) -> Planar:
    """Solve Kepler's equation by Newton's method from Danby's first estimate (Danby 1988)."""
    return _newton(orbit, mean, steps, mean + 0.85 * orbit.e * np.sign(np.sin(mean)))


def _series(orbit: Ellipse, mean: FloatArray, terms: float) -> Planar:
    k = np.arange(1, int(terms) + 1)
    angle = np.outer(mean, k)
    cosine = -orbit.e / 2 + np.cos(angle) @ (2 / k * jvp(k, k * orbit.e))
    sine = np.sin(angle) @ (2 / orbit.e / k * jv(k, k * orbit.e))
    return _on_ellipse(orbit, cosine, sine, mean.size * terms)


def _start(orbit: Ellipse) -> tuple[FloatArray, FloatArray, float]:
    """Position (m) and velocity (m/s) at the pericentre in the orbital plane, and GM (m3 s-2)."""
    speed = orbit.motion * orbit.a * math.sqrt((1 + orbit.e) / (1 - orbit.e))
    position = np.array([orbit.a * (1 - orbit.e), 0.0, 0.0])
    return position, np.array([0.0, speed, 0.0]), orbit.motion**2 * orbit.a**3


def _skyfield(orbit: Ellipse, mean: FloatArray, _: float) -> Planar:
    """Coordinates in the orbital plane by Skyfield's two-body propagator for comets."""
    from skyfield.keplerlib import propagate

    position, velocity, gm = _start(orbit)
    (x, y, _), _ = propagate(position, velocity, 0.0, mean / orbit.motion, gm)
    return x, y, mean.size
