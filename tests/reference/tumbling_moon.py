"""A tumbling moon on an ellipse, for which a reference solution is stored."""

import math

import numpy as np

from earthspin.motion.equations import Rigid
from earthspin.motion.march import Masses
from earthspin.motion.solution import AttitudeIntegrator, start_of
from earthspin.numerics.arrays import FloatArray
from tests.reference.sky import eccentric_anomaly

#: (C - (A + B)/2)/C and (B - A)/C of a homogeneous ellipsoid with Hyperion's axes (360 x 266 x
#: 205 km), on an ellipse with mean motion 1 about a mass with GM = 1; spin in the same unit.
H, TRIAXIALITY = 0.29, 0.29
ECCENTRICITY = 0.1
OMEGA = (0.5, 0.3, 1.5)
#: Time span and number of times of the stored reference.
SPAN, TIMES = 16.0, 32
#: Inputs of the stored reference.
INPUTS = {
    "h": H,
    "triaxiality": TRIAXIALITY,
    "eccentricity": ECCENTRICITY,
    "omega": list(OMEGA),
    "span": SPAN,
}


def times() -> FloatArray:
    """Evenly spaced times of the reference solution, multiplied by the orbital mean motion, rad."""
    return np.linspace(0.0, SPAN, TIMES + 1)[1:]


def places(t: FloatArray) -> FloatArray:
    """Positions of the perturber on its ellipse, divided by the semi-major axis, shape (n, 3)."""
    anomaly = eccentric_anomaly(t, ECCENTRICITY, steps=6)
    across = math.sqrt(1 - ECCENTRICITY**2) * np.sin(anomaly)
    return np.stack([np.cos(anomaly) - ECCENTRICITY, across, 0 * anomaly], axis=-1)


def motion(end: float, tolerance: float) -> AttitudeIntegrator:
    """Rotation of the moon from time 0 to the end, by the package's own solver."""
    body = Rigid(
        c_minus_a=np.array([H + TRIAXIALITY / 2]),
        c_minus_b=np.array([H - TRIAXIALITY / 2]),
        tide=np.ones(1),
        unit=1.0,
    )
    masses = Masses(gm={"planet": 1.0}, positions=lambda times: {"planet": places(times)})
    start = start_of(body, np.array([1.0, 0.0, 0.0, 0.0]), np.array(OMEGA))
    return AttitudeIntegrator(body, masses, start, float(end), tolerance=tolerance)
