"""Sky and bodies for the tests of the whole attitude: an ellipse about a mass, in simple units."""

from dataclasses import dataclass

import numpy as np

from earthspin.motion.equations import CustomTorque, Rigid
from earthspin.motion.march import Masses
from earthspin.motion.solution import AttitudeIntegrator, State, start_of
from earthspin.numerics.arrays import FloatArray

AS_SKY = np.array([1.0, 0.0, 0.0, 0.0])


@dataclass(frozen=True)
class Ellipse:
    """Orbit of a mass of GM 1 with mean motion 1, from pericentre on x."""

    eccentricity: float = 0.0

    def at(self, times: FloatArray) -> FloatArray:
        """Positions, shape (t, 3)."""
        e = self.eccentricity
        anomaly = times + e * np.sin(times)
        for _ in range(60):
            step = (anomaly - e * np.sin(anomaly) - times) / (1 - e * np.cos(anomaly))
            anomaly = anomaly - step
            if np.all(abs(step) < 1e-9):  # the next one is its square
                break
        across = np.sqrt(1 - e * e) * np.sin(anomaly)
        return np.stack([np.cos(anomaly) - e, across, 0 * times], axis=-1)

    def tide(self, time: float) -> FloatArray:
        """GM r r^T / r^5 at a time, shape (3, 3)."""
        r = self.at(np.array([time]))[0]
        return np.asarray(np.outer(r, r) / np.linalg.norm(r) ** 5)

    def masses(self) -> Masses:
        """As the solver asks for it."""
        return Masses(gm={"mass": 1.0}, positions=lambda times: {"mass": self.at(times)})


ALONE = Masses(gm={}, positions=lambda times: {})


def rigid(
    h: float, triaxiality: float, unit: float = 1.0, custom_torque: CustomTorque | None = None
) -> Rigid:
    """One body."""
    return Rigid(
        c_minus_a=np.array([h + triaxiality / 2]),
        c_minus_b=np.array([h - triaxiality / 2]),
        tide=np.ones(1),
        unit=unit,
        custom_torque=custom_torque,
    )


def of_moments(a: float, b: float, c: float, custom_torque: CustomTorque | None = None) -> Rigid:
    """One body of three moments."""
    return rigid((c - (a + b) / 2) / c, (b - a) / c, custom_torque=custom_torque)


def start(body: Rigid, omega: tuple[float, ...], attitude: FloatArray = AS_SKY) -> State:
    """A start by its spin along the body's axes."""
    return start_of(body, attitude, np.array(omega))


def followed(
    body: Rigid, masses: Masses, omega: tuple[float, ...], end: float, **settings: float
) -> AttitudeIntegrator:
    """A motion from time 0."""
    return AttitudeIntegrator(body, masses, start(body, omega), end, **settings)


def angle(p: FloatArray, q: FloatArray) -> FloatArray:
    """Angle between attitudes, shape (t, 4) each, from the chord, which keeps its digits."""
    chord = np.minimum(np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1))
    return np.asarray(4 * np.arcsin(chord / 2))
