"""Random rigid bodies about a mass on exact Kepler orbits, and their rotation in long double.

The reference integrates Euler's equations and the quaternion by the modified midpoint rule and
Richardson's extrapolation (Gragg 1965; Hairer, Norsett & Wanner 1993, sect. II.9). It shares with
`earthspin.motion` the equations, and neither method nor code.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin import Body, Orbit
from earthspin.constants import DAY, G
from earthspin.dates import datetime64
from earthspin.numerics.arrays import FloatArray
from tests.reference.extrapolation import increment

LongArray = NDArray[np.longdouble]
LONG = np.longdouble

#: Radians of the fastest angle in a step.
STEP = 0.7
#: Rounds of Newton's method for Kepler's equation, from E = M + e sin M.
ROUNDS = 12


@dataclass(frozen=True)
class Case:
    """A body, the mass it is pulled by, its start, and the last time.

    Attributes
    ----------
    body, primary : Body
    attitude, omega : ndarray
        At J2000.0.
    days : float
        To the last date.
    """

    body: Body
    primary: Body
    attitude: FloatArray
    omega: FloatArray
    days: float

    @property
    def scene(self) -> dict[str, Any]:
        """Keys of the question `rotation`."""
        return {
            "body": self.body,
            "perturbers": [self.primary],
            "start_attitude": self.attitude,
            "start_omega": self.omega,
            "effects": ["triaxiality"],
            "times": datetime64(np.array([0.0, self.days])),
        }


def random_case(seed: int, orbits: float = 5.0) -> Case:
    """Draw a body of three moments that tumbles or turns evenly, on an ellipse about a mass.

    Parameters
    ----------
    seed : int
    orbits : float
        Length of its motion.
    """
    random = np.random.default_rng(seed)
    eccentricity, inclination = random.uniform(0, 0.5), random.uniform(0, np.pi)
    node, pericentre, anomaly = random.uniform(0, 2 * np.pi, 3)
    period = DAY * 10 ** random.uniform(-0.5, 1.5)
    gm = 10 ** random.uniform(13, 17)
    a = float(np.cbrt(gm * (period / (2 * np.pi)) ** 2))
    polar = random.uniform(0.3, 0.4)
    # C - A and C - B over C of a body anywhere between a sphere and the longest one
    small, large = np.sort(random.uniform(0.0, 0.45, 2))
    moments = polar * np.array([1 - large, 1 - small, 1.0])
    j2 = float(polar - moments[:2].mean())
    body = Body(
        name="rock",
        gm=1e-9 * gm,
        radius=float(np.cbrt(1e-9 * gm / (4 / 3 * np.pi * G.value * 3000))),  # of rock
        j2=j2,
        dynamical_flattening=j2 / polar,
        triaxiality=float(moments[1] - moments[0]),
    )
    orbit = Orbit(
        a=a,
        e=eccentricity,
        i=inclination,
        node=node,
        pericentre=pericentre,
        mean_anomaly=anomaly,
        plane="icrf",
    )
    attitude = random.normal(size=4)
    omega = random.normal(size=3)
    omega *= 2 * np.pi / period * 10 ** random.uniform(-0.3, 0.8) / np.linalg.norm(omega)
    days = float(np.round(orbits * period / DAY, 3))
    primary = Body(name="primary", gm=gm, orbit=orbit)
    return Case(body, primary, attitude / np.linalg.norm(attitude), omega, days)


def reference(cases: list[Case]) -> tuple[FloatArray, FloatArray]:
    """Quaternions and angular velocities (rad/s) at the ends of some cases, shapes (n, 4), (n, 3).

    Parameters
    ----------
    cases : list of Case
    """
    rotors = _Rotors(cases)
    fastest = max(float(np.max(rotors.fastest * rotors.end)), 1.0)
    steps = int(np.ceil(fastest / STEP))
    state = np.concatenate([rotors.start, np.zeros_like(rotors.start[:1])])
    for _ in range(steps):
        state = state + increment(state, LONG(1) / steps, rotors.rates)
    q = state[3:7] / np.sqrt(np.sum(state[3:7] ** 2, axis=0))
    return np.asarray(q.T, dtype=float), np.asarray(state[:3].T, dtype=float)


class _Rotors:
    """Cases side by side; the time of each runs from 0 to 1."""

    def __init__(self, cases: list[Case]) -> None:
        orbits = [case.primary.orbit for case in cases]

        def column(values: list[Any]) -> LongArray:
            return np.array([LONG(value) for value in values])

        elements = ("a", "e", "i", "node", "pericentre", "mean_anomaly")
        self.a, self.e, i, node, pericentre, self.anomaly = (
            column([getattr(orbit, name) for orbit in orbits]) for name in elements
        )
        own = column([case.body.gm for case in cases])
        self.gm = column([case.primary.gm for case in cases])
        self.motion = np.sqrt((self.gm + own) / self.a**3)
        j2, h, triaxiality = (
            column([getattr(case.body, name) for case in cases])
            for name in ("j2", "dynamical_flattening", "triaxiality")
        )
        b_minus_a = triaxiality * h / j2
        self.moments = np.array([1 - h - b_minus_a / 2, 1 - h + b_minus_a / 2, np.ones_like(h)])
        self.end = column([case.days for case in cases]) * LONG(DAY)
        cos, sin = np.cos, np.sin
        self.ahead = np.array([
            cos(node) * cos(pericentre) - sin(node) * sin(pericentre) * cos(i),
            sin(node) * cos(pericentre) + cos(node) * sin(pericentre) * cos(i),
            sin(pericentre) * sin(i),
        ])  # fmt: skip
        self.across = np.array([
            -cos(node) * sin(pericentre) - sin(node) * cos(pericentre) * cos(i),
            -sin(node) * sin(pericentre) + cos(node) * cos(pericentre) * cos(i),
            cos(pericentre) * sin(i),
        ])  # fmt: skip
        omega = np.array([case.omega for case in cases], dtype=LONG).T
        attitude = np.array([case.attitude for case in cases], dtype=LONG).T
        self.start = np.concatenate([omega, attitude])
        spin = np.sqrt(np.sum(omega**2, axis=0))
        self.fastest = 1.5 * spin + 2 * self.motion / (1 - self.e) ** 1.5

    def rates(self, state: LongArray) -> LongArray:
        """Rates of angular velocity, quaternion and time over the whole time."""
        wx, wy, wz, w, x, y, z, time = state
        place, distance = self._place(time * self.end)
        a, b, c = self.moments
        square = w * w + x * x + y * y + z * z
        rows = (
            (w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)),
            (2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)),
            (2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z),
        )
        u, v, s = (sum(t * p for t, p in zip(row, place, strict=True)) / square for row in rows)
        tide = 3 * self.gm / distance**5
        rates = np.array([
            (b - c) / a * (wy * wz - tide * v * s),
            (c - a) / b * (wz * wx - tide * s * u),
            (a - b) / c * (wx * wy - tide * u * v),
            (-x * wx - y * wy - z * wz) / 2,
            (w * wx + y * wz - z * wy) / 2,
            (w * wy + z * wx - x * wz) / 2,
            (w * wz + x * wy - y * wx) / 2,
            1 / self.end,
        ])  # fmt: skip
        return np.asarray(rates * self.end)

    def _place(self, time: LongArray) -> tuple[LongArray, LongArray]:
        """Position of the mass and its distance, m."""
        mean = self.anomaly + self.motion * time
        anomaly = mean + self.e * np.sin(mean)
        for _ in range(ROUNDS):
            anomaly -= (anomaly - self.e * np.sin(anomaly) - mean) / (1 - self.e * np.cos(anomaly))
        x = self.a * (np.cos(anomaly) - self.e)
        y = self.a * np.sqrt((1 - self.e) * (1 + self.e)) * np.sin(anomaly)
        distance = self.a * (1 - self.e * np.cos(anomaly))
        return x * self.ahead + y * self.across, distance
