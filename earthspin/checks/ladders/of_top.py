"""A heavy symmetric top: the closed form against integrators."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from earthspin.checks.ladders.rotation import FEW_FINE, FINE, Rotation, ladder_of_rotation
from earthspin.checks.solvers.heavy_top import integrate_heavy_top, state_of_angles
from earthspin.checks.work_precision import Ladder
from earthspin.top.motion import heavy_top_motion
from earthspin.top.start import HeavyTop

FloatArray = NDArray[np.float64]

#: A top that nods in loops; kg m2, N m, rad, rad/s.
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
    """Return the methods, their settings and the reference."""
    fine = FEW_FINE if quick else FINE
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
    return ladder_of_rotation(
        "top",
        TOP,
        quick,
        periods="nutations of a heavy top",
        detail=" that goes in loops",
        reference="the textbook's closed form (I.7.9 to I.7.17)",
        closed_form=(_closed_form, 5e-13),
        integrator=("integrate_heavy_top", _integrated),
        by_hand={
            f"Euler angles, {name}": (partial(_by_hand, name), steps)
            for name, steps in (("RK45", coarse), ("LSODA", coarse), ("DOP853", fine))
        },
    )


def _closed_form(t: FloatArray) -> Rotation:
    motion = heavy_top_motion(HeavyTop(**TOP), t)
    return (motion.omega_body, motion.attitude), t.size


def _integrated(t: FloatArray, rtol: float) -> Rotation:
    motion = integrate_heavy_top(HeavyTop(**TOP), t, relative_tolerance=rtol)
    return (motion.omega_body, motion.attitude), motion.evaluations


def _by_hand(method: str, t: FloatArray, rtol: float) -> Rotation:
    """The textbook's equations in the Euler angles (I.7.5 to I.7.8)."""
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
    done = solve_ivp(rates, (0.0, t[-1]), start, method, t_eval=t, rtol=rtol, atol=1e-2 * rtol)
    theta, theta_rate, phi, psi = done.y
    across = (b - a * np.cos(theta)) / np.sin(theta)
    return state_of_angles(theta, phi, psi, across, theta_rate, spin), done.nfev
