"""Compare error and run time of methods for the attitude of a tumbling moon.

Methods: Gauss windows and step-by-step integrators.
"""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from earthspin.checks.ladders.rotating_bodies import ladder_of_rotation, scipy_methods
from tests.reference.sky import eccentric_anomaly
from tests.reference.attitude import attitude_motion
from tests.reference.stepping import integrate, quaternion_rate
from tests.reference.stored import load
from earthspin.checks.work_precision import FloatArray, Ladder, Result, method
from earthspin.motion.equations import Rigid
from earthspin.motion.march import Masses
from earthspin.motion.solution import Motion, start_of
from earthspin.numerics.quaternion import conjugate, rotate

#: (C - (A + B)/2)/C and (B - A)/C of a homogeneous ellipsoid with Hyperion's axes (360 x 266 x
#: 205 km), on an ellipse with mean motion 1 about a mass with GM = 1; spin in the same unit.
H, TRIAXIALITY = 0.29, 0.29
ECCENTRICITY = 0.1
OMEGA = (0.5, 0.3, 1.5)
#: Span in a full and in a quick run, and the numbers of times.
SPAN, SHORT = 16.0, 4.0
TIMES, FEW = 32, 8
#: Inputs of the stored reference.
INPUTS = {
    "h": H,
    "triaxiality": TRIAXIALITY,
    "eccentricity": ECCENTRICITY,
    "omega": list(OMEGA),
    "span": SPAN,
}
#: Bound on the error of the reference; halving its steps changes it by 4e-17.
REFERENCE_ERROR = 5e-17


def times() -> FloatArray:
    """Evenly spaced times of the reference solution, multiplied by the orbital mean motion, rad."""
    return np.linspace(0.0, SPAN, TIMES + 1)[1:]


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the attitude of a tumbling moon."""
    t = times()[: FEW if quick else TIMES]
    tolerances = (1e-6, 3e-7) if quick else (1e-6, 1e-8, 1e-10, 1e-12, 1e-13)
    fine = (1e-6, 1e-9) if quick else (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-5, 1e-7, 1e-9)
    windows, attitude = partial(_windows, t), partial(_attitude, t)
    words = "windows in two forms, with the error"
    return ladder_of_rotation(
        "rotation",
        load("rotation", INPUTS),
        t,
        [
            method(words, "tolerance {}", windows, tolerances, 1e-6 if quick else 2e-11),
            method("attitude_motion", "DOP853, rtol {}", attitude, fine, 1e-5 if quick else 1e-9),
            *scipy_methods(
                "solve_ivp {}", _by_scipy, t, {"DOP853": fine, "LSODA": fine, "RK45": coarse}
            ),
        ],
        span=f"{(SHORT if quick else SPAN) / (2 * math.pi):.1f} orbits of a tumbling moon",
        detail=f" with three moments, eccentricity {ECCENTRICITY:g}",
        reference="orbit, angular momentum and quaternion in long double by extrapolation of order "
        "20",
        reference_error=REFERENCE_ERROR,
    )


def _places(t: FloatArray) -> FloatArray:
    """Positions of the perturber on its ellipse, divided by the semi-major axis, shape (n, 3)."""
    anomaly = eccentric_anomaly(t, ECCENTRICITY, steps=6)
    across = math.sqrt(1 - ECCENTRICITY**2) * np.sin(anomaly)
    return np.stack([np.cos(anomaly) - ECCENTRICITY, across, 0 * anomaly], axis=-1)


def _windows(t: FloatArray, tolerance: float) -> Result:
    """Angular velocity and attitude of the tumbling moon by the package's own solver."""
    body = Rigid(
        c_minus_a=np.array([H + TRIAXIALITY / 2]),
        c_minus_b=np.array([H - TRIAXIALITY / 2]),
        tide=np.ones(1),
        unit=1.0,
    )
    masses = Masses(gm={"planet": 1.0}, positions=lambda times: {"planet": _places(times)})
    start = start_of(body, np.array([1.0, 0.0, 0.0, 0.0]), np.array(OMEGA))
    motion = Motion(body, masses, start, float(t[-1]), tolerance=tolerance)
    result = motion.at(t)
    return (result.omega, result.attitude), motion.evaluations


def _attitude(t: FloatArray, rtol: float) -> Result:
    """Angular velocity and attitude of the tumbling moon by the independent solver."""
    calls = 0

    def tide(time: float) -> FloatArray:
        nonlocal calls
        calls += 1
        r = _places(np.array([time]))[0]
        return np.asarray(np.outer(r, r) / (r @ r) ** 2.5)

    moments = np.array([1 - H - TRIAXIALITY / 2, 1 - H + TRIAXIALITY / 2, 1.0])
    start = np.array([1.0, 0.0, 0.0, 0.0])
    momentum, attitude = attitude_motion(
        tide, H, TRIAXIALITY, 1.0, moments * OMEGA, start, np.concatenate([[0.0], t]), rtol=rtol
    )
    omega = rotate(conjugate(attitude), momentum) / moments
    return (omega[1:], attitude[1:]), calls


def _by_scipy(method: str, t: FloatArray, rtol: float) -> Result:
    """Angular velocity and attitude of the tumbling moon, integrated with SciPy."""
    a, b, c = 1 - H - TRIAXIALITY / 2, 1 - H + TRIAXIALITY / 2, 1.0
    shrink = math.sqrt(1 - ECCENTRICITY**2)

    def rates(time: float, state: FloatArray) -> list[float]:
        p, q, r = omega = state[:3]
        w, x, y, z = quaternion = state[3:]
        anomaly = time
        for _ in range(6):
            residual = anomaly - ECCENTRICITY * math.sin(anomaly) - time
            anomaly -= residual / (1 - ECCENTRICITY * math.cos(anomaly))
        u, v = math.cos(anomaly) - ECCENTRICITY, shrink * math.sin(anomaly)
        pull = 3 / (u * u + v * v) ** 2.5
        xb = (w * w + x * x - y * y - z * z) * u + 2 * (x * y + w * z) * v
        yb = 2 * (x * y - w * z) * u + (w * w - x * x + y * y - z * z) * v
        zb = 2 * (x * z + w * y) * u + 2 * (y * z - w * x) * v
        return [
            (b - c) / a * (q * r - pull * yb * zb),
            (c - a) / b * (r * p - pull * zb * xb),
            (a - b) / c * (p * q - pull * xb * yb),
            *quaternion_rate(quaternion, omega),
        ]

    start = [*OMEGA, 1.0, 0.0, 0.0, 0.0]
    states, evaluations = integrate(rates, start, t, rtol, method, atol=1e-2 * rtol)
    return (states[:, :3], states[:, 3:]), evaluations
