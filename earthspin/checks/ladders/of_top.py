"""Compare error and run time of the closed form of a heavy top and of integrators."""

from __future__ import annotations

from functools import partial

import numpy as np

from earthspin.checks.ladders.rotating_bodies import ladder_of_rotation, periods, scipy_methods
from tests.reference.heavy_top import integrate_heavy_top, state_of_angles
from tests.reference.stepping import integrate
from tests.reference.stored import load
from earthspin.checks.work_precision import FloatArray, Ladder, Result, method
from earthspin.top.motion import heavy_top_motion
from earthspin.top.start import HeavyTop

#: A top whose axis draws loops; kg m2, N m, rad, rad/s.
TOP = {
    "transverse_moment": 1.0,
    "axial_moment": 0.6,
    "weight_moment": 2.0,
    "theta": 0.7,
    "spin": 6.0,
    "phi_rate": 1.5,
    "theta_rate": 0.3,
    "psi": 0.2,
}


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the motion of a heavy top."""
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
    true = load("top", TOP)
    t, count, fine, bound = periods(true, quick)
    tolerances = {"RK45": coarse, "LSODA": coarse, "DOP853": fine}
    return ladder_of_rotation(
        "top",
        true,
        t,
        [
            method("closed form", "", partial(_closed_form, t), bound=5e-13),
            method("integrate_heavy_top", "DOP853, rtol {}", partial(_integrated, t), fine, bound),
            *scipy_methods("Euler angles, {}", _by_scipy, t, tolerances),
        ],
        span=f"{count} nutations of a heavy top",
        detail=" with loops",
        reference="the textbook's closed form (I.7.9 to I.7.17) with 80 digits, stored with 32",
    )


def _closed_form(t: FloatArray) -> Result:
    motion = heavy_top_motion(HeavyTop(**TOP), t)
    return (motion.omega_body, motion.attitude), t.size


def _integrated(t: FloatArray, rtol: float) -> Result:
    motion = integrate_heavy_top(HeavyTop(**TOP), t, relative_tolerance=rtol)
    return (motion.omega_body, motion.attitude), motion.evaluations


def _by_scipy(method: str, t: FloatArray, rtol: float) -> Result:
    """Integrate the textbook equations of the Euler angles (I.7.5 to I.7.8) with SciPy."""
    i1, i3, weight = TOP["transverse_moment"], TOP["axial_moment"], TOP["weight_moment"]
    spin = TOP["spin"]
    a = i3 * spin / i1
    sine, cosine = np.sin(TOP["theta"]), np.cos(TOP["theta"])
    b = TOP["phi_rate"] * sine**2 + a * cosine

    def rates(_: float, state: FloatArray) -> list[float]:
        theta, theta_rate, _, _ = state
        s, c = np.sin(theta), np.cos(theta)
        phi_rate = (b - a * c) / s**2
        push = weight / i1 * s + phi_rate * s * (phi_rate * c - a)
        return [theta_rate, push, phi_rate, spin - phi_rate * c]

    start = [TOP["theta"], TOP["theta_rate"], 0.0, TOP["psi"]]
    states, evaluations = integrate(rates, start, t, rtol, method, atol=1e-2 * rtol)
    theta, theta_rate, phi, psi = states.T
    across = (b - a * np.cos(theta)) / np.sin(theta)
    return state_of_angles(theta, phi, psi, across, theta_rate, spin), evaluations
