"""The whole attitude of a tumbling moon: windows with their error against step-by-step solvers."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from earthspin.checks.ladders.rotation import Rotation
from earthspin.checks.solvers.attitude import attitude_motion
from earthspin.checks.stored import load, rotation_error
from earthspin.checks.work_precision import Ladder, Method, settings
from earthspin.motion.equations import Rigid
from earthspin.motion.march import Above
from earthspin.motion.rotation import Motion, start_of
from earthspin.numerics.quaternion import conjugate, rotate

FloatArray = NDArray[np.float64]

#: A homogeneous ellipsoid of Hyperion's axes (360 x 266 x 205 km), (C - (A + B)/2)/C and (B - A)/C,
#: on an ellipse about a mass of GM 1 with mean motion 1, its spin in that unit.
H, TRIAXIALITY = 0.29, 0.29
ECCENTRICITY = 0.1
OMEGA = (0.5, 0.3, 1.5)
#: Time that is followed, of which the first part in a quick run; asked for at so many times.
SPAN, SHORT = 16.0, 4.0
TIMES, FEW = 32, 8
#: Numbers that the stored reference was made for.
INPUTS = {
    "h": H,
    "triaxiality": TRIAXIALITY,
    "eccentricity": ECCENTRICITY,
    "omega": list(OMEGA),
    "span": SPAN,
}
#: Steps of half the length change the reference by 4e-17.
REFERENCE_ERROR = 5e-17


def times() -> FloatArray:
    """Times of the reference, in units of 1/n, evenly spaced."""
    return np.linspace(0.0, SPAN, TIMES + 1)[1:]


def ladder(quick: bool) -> Ladder:
    """Return the methods, their settings and the reference."""
    true = load("rotation", INPUTS)
    wanted = slice(0, FEW if quick else TIMES)
    t = times()[wanted]
    omega, attitude = true["omega"][wanted], true["attitude"][wanted]
    span = f"{(SHORT if quick else SPAN) / (2 * math.pi):.1f} orbits of a tumbling moon"
    windows = (1e-6, 3e-7) if quick else (1e-6, 1e-8, 1e-10, 1e-12, 1e-13)
    fine = (1e-6, 1e-9) if quick else (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-5, 1e-7, 1e-9)
    return Ladder(
        quantity="rotation",
        unit="1",
        problem=f"{span} with three moments, eccentricity {ECCENTRICITY:g}, at {t.size} times; the "
        "error is the largest of the angular velocity, relative to its size, and of the attitude, "
        "in rad",
        subject=span,
        reference="orbit, angular momentum and quaternion in long double by extrapolation of order "
        "20",
        reference_error=REFERENCE_ERROR,
        methods=[
            Method(
                "windows in two forms, with the error",
                settings("tolerance {}", partial(_windows, t), windows),
                1e-6 if quick else 2e-11,
            ),
            Method(
                "attitude_motion",
                settings("DOP853, rtol {}", partial(_attitude, t), fine),
                1e-5 if quick else 1e-9,
            ),
            *(
                Method(f"solve_ivp {name}", settings("rtol {}", partial(_by_hand, t, name), steps))
                for name, steps in (("DOP853", fine), ("LSODA", fine), ("RK45", coarse))
            ),
        ],
        useful=0.1,
        error=lambda rotation: rotation_error(rotation, omega, attitude),
    )


def _places(t: FloatArray) -> FloatArray:
    """Positions on the ellipse, shape (n, 3)."""
    anomaly = t
    for _ in range(6):
        rest = anomaly - ECCENTRICITY * np.sin(anomaly) - t
        anomaly = anomaly - rest / (1 - ECCENTRICITY * np.cos(anomaly))
    across = math.sqrt(1 - ECCENTRICITY**2) * np.sin(anomaly)
    return np.stack([np.cos(anomaly) - ECCENTRICITY, across, 0 * anomaly], axis=-1)


def _windows(t: FloatArray, tolerance: float) -> Rotation:
    """What the package does."""
    body = Rigid(
        c_minus_a=np.array([H + TRIAXIALITY / 2]),
        c_minus_b=np.array([H - TRIAXIALITY / 2]),
        tide=np.ones(1),
        unit=1.0,
    )
    above = Above(gm={"planet": 1.0}, positions=lambda times: {"planet": _places(times)})
    start = start_of(body, np.array([1.0, 0.0, 0.0, 0.0]), np.array(OMEGA))
    motion = Motion(body, above, start, float(t[-1]), tolerance=tolerance)
    result = motion.at(t)
    return (result.omega, result.attitude), motion.evaluations


def _attitude(t: FloatArray, rtol: float) -> Rotation:
    """The solver that checks the others."""
    calls = 0

    def tide(time: float) -> FloatArray:
        nonlocal calls
        calls += 1
        r = _places(np.array([time]))[0]
        return np.asarray(np.outer(r, r) / (r @ r) ** 2.5)

    moments = np.array([1 - H - TRIAXIALITY / 2, 1 - H + TRIAXIALITY / 2, 1.0])
    start = np.array([1.0, 0.0, 0.0, 0.0])
    momentum, turned = attitude_motion(
        tide, H, TRIAXIALITY, 1.0, moments * OMEGA, start, np.concatenate([[0.0], t]), rtol=rtol
    )
    omega = rotate(conjugate(turned), momentum) / moments
    return (omega[1:], turned[1:]), calls


def _by_hand(t: FloatArray, method: str, rtol: float) -> Rotation:
    """Euler's equations, the quaternion and Kepler's equation as one would type them."""
    a, b, c = 1 - H - TRIAXIALITY / 2, 1 - H + TRIAXIALITY / 2, 1.0
    shrink = math.sqrt(1 - ECCENTRICITY**2)

    def rates(time: float, state: FloatArray) -> list[float]:
        p, q, r, w, x, y, z = state
        anomaly = time
        for _ in range(6):
            rest = anomaly - ECCENTRICITY * math.sin(anomaly) - time
            anomaly -= rest / (1 - ECCENTRICITY * math.cos(anomaly))
        u, v = math.cos(anomaly) - ECCENTRICITY, shrink * math.sin(anomaly)
        pull = 3 / (u * u + v * v) ** 2.5
        xb = (w * w + x * x - y * y - z * z) * u + 2 * (x * y + w * z) * v
        yb = 2 * (x * y - w * z) * u + (w * w - x * x + y * y - z * z) * v
        zb = 2 * (x * z + w * y) * u + 2 * (y * z - w * x) * v
        return [
            (b - c) / a * (q * r - pull * yb * zb),
            (c - a) / b * (r * p - pull * zb * xb),
            (a - b) / c * (p * q - pull * xb * yb),
            (-x * p - y * q - z * r) / 2,
            (w * p + y * r - z * q) / 2,
            (w * q + z * p - x * r) / 2,
            (w * r + x * q - y * p) / 2,
        ]

    start = [*OMEGA, 1.0, 0.0, 0.0, 0.0]
    done = solve_ivp(rates, (0.0, t[-1]), start, method, t_eval=t, rtol=rtol, atol=1e-2 * rtol)
    return (done.y[:3].T, done.y[3:].T), done.nfev
