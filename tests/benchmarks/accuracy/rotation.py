"""Attitude of a tumbling moon: Gauss windows beside step-by-step integrators."""

import math
from functools import partial

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.quaternion import conjugate, rotate
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.attitude import attitude_motion
from tests.reference.stepping import integrate, quaternion_rate
from tests.reference.stored import load, rotation_error
from tests.reference.tumbling_moon import (
    ECCENTRICITY,
    INPUTS,
    OMEGA,
    SPAN,
    TIMES,
    TRIAXIALITY,
    H,
    motion,
    places,
    times,
)

#: Principal moments divided by C.
MOMENTS = np.array([1 - H - TRIAXIALITY / 2, 1 - H + TRIAXIALITY / 2, 1.0])
UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])
TOLERANCES = (1e-6, 1e-8, 1e-10, 1e-12, 1e-13)


def ladder() -> Ladder:
    """Methods for the attitude of a tumbling moon."""
    true, fine = load("rotation", INPUTS), (1e-4, *TOLERANCES)
    scipy = {"DOP853": fine, "LSODA": fine, "RK45": (1e-3, 1e-5, 1e-7, 1e-9)}
    return Ladder(
        title="Attitude of a tumbling moon, 2.5 orbits",
        problem=f"{SPAN / (2 * math.pi):.1f} orbits of a tumbling moon with three moments, "
        f"eccentricity {ECCENTRICITY:g}, at {TIMES} times; the error is the largest of the angular "
        "velocity, relative to its size, and of the attitude, in rad",
        reference="orbit, angular momentum and quaternion in long double by extrapolation of order "
        "20",
        unit="1",
        floor=5e-17,  # halving the steps of the reference changes it by 4e-17
        error=lambda values: rotation_error(values, true["omega"], true["attitude"]),
        runs={
            "windows, two forms": settings("tolerance {}", windows, TOLERANCES),
            "attitude_motion": settings("DOP853, rtol {}", _attitude, fine),
            **{
                f"solve_ivp {name}": settings("rtol {}", partial(_by_scipy, name), tolerances)
                for name, tolerances in scipy.items()
            },
        },
        bounds={"windows, two forms": 2e-11, "attitude_motion": 1e-9},
    )


def windows(tolerance: float) -> tuple[tuple[FloatArray, FloatArray], int]:
    """Angular velocity and attitude by the package's own solver."""
    solved = motion(SPAN, tolerance)
    result = solved.at(times())
    return (result.omega, result.attitude), solved.evaluations


def _attitude(rtol: float) -> tuple[object, int]:
    """Angular velocity and attitude by the independent solver of the tests."""
    calls = 0

    def tide(time: float) -> FloatArray:
        nonlocal calls
        calls += 1
        r = places(np.array([time]))[0]
        return np.asarray(np.outer(r, r) / (r @ r) ** 2.5)

    t = np.concatenate([[0.0], times()])
    momentum, attitude = attitude_motion(
        tide, H, TRIAXIALITY, 1.0, MOMENTS * OMEGA, UPRIGHT, t, rtol=rtol
    )
    omega = rotate(conjugate(attitude), momentum) / MOMENTS
    return (omega[1:], attitude[1:]), calls


def _by_scipy(method: str, rtol: float) -> tuple[object, int]:
    """Angular velocity and attitude, integrated with SciPy."""
    a, b, c = MOMENTS.tolist()
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

    start = [*OMEGA, *UPRIGHT]
    states, evaluations = integrate(rates, start, times(), rtol, method, atol=1e-2 * rtol)
    return (states[:, :3], states[:, 3:]), evaluations
