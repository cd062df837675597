"""Compare error and run time of methods for a free triaxial rotor.

Methods: Jacobi's closed form and numerical integrators.
"""

from __future__ import annotations

from functools import partial

from earthspin.checks.ladders.rotating_bodies import ladder_of_rotation, periods, scipy_methods
from tests.reference.stepping import integrate, quaternion_rate
from tests.reference.stored import load
from earthspin.checks.work_precision import FloatArray, Ladder, Result, method
from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.triaxial import free_rotation

#: Three different moments (kg m2), and an angular velocity that is near no principal axis (rad/s).
MOMENTS = (1.0, 1.7, 2.4)
OMEGA = (0.5, 0.2, 0.8)
#: Inputs of the stored reference.
INPUTS = {"moments": MOMENTS, "omega": OMEGA}


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for a free triaxial rotor."""
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
    stiff = (1e-3, 1e-4) if quick else (1e-3, 1e-4, 1e-5)
    true = load("free-rotor", INPUTS)
    t, count, fine, bound = periods(true, quick)
    tolerances = {"RK45": coarse, "LSODA": coarse, "Radau": stiff}
    return ladder_of_rotation(
        "free-rotor",
        true,
        t,
        [
            method("closed form", "", partial(_closed_form, t), bound=1e-13),
            method("integrate_rotation", "DOP853, rtol {}", partial(_integrated, t), fine, bound),
            *scipy_methods("solve_ivp {}", _by_scipy, t, tolerances),
        ],
        span=f"{count} periods of a free triaxial rotor",
        detail=", moments 1 : 1.7 : 2.4",
        reference="the textbook's closed form (Whittaker) with 80 digits, stored with 32",
    )


def _closed_form(t: FloatArray) -> Result:
    motion = free_rotation(MOMENTS, OMEGA, t)
    return (motion.omega_body, motion.attitude), t.size


def _integrated(t: FloatArray, rtol: float) -> Result:
    motion = integrate_rotation(MOMENTS, OMEGA, t, rtol=rtol, atol=1e-2 * rtol)
    return (motion.omega_body, motion.attitude), motion.evaluations


def _by_scipy(method: str, t: FloatArray, rtol: float) -> Result:
    """Integrate Euler's equations and the attitude quaternion of a free rotor with SciPy."""
    a, b, c = MOMENTS

    def rates(_: float, state: FloatArray) -> list[float]:
        p, q, r = omega = state[:3]
        return [
            (b - c) / a * q * r,
            (c - a) / b * r * p,
            (a - b) / c * p * q,
            *quaternion_rate(state[3:], omega),
        ]

    start = [*OMEGA, 1.0, 0.0, 0.0, 0.0]
    states, evaluations = integrate(rates, start, t, rtol, method, atol=1e-2 * rtol)
    return (states[:, :3], states[:, 3:]), evaluations
