"""A triaxial rotor without torque: Jacobi's closed form against integrators."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from earthspin.checks.ladders.rotation import Rotation, ladder_of_rotation
from earthspin.checks.work_precision import Ladder
from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.triaxial import free_rotation

FloatArray = NDArray[np.float64]

#: kg m2 and rad/s: three different moments, a start that is near no axis.
MOMENTS = (1.0, 1.7, 2.4)
OMEGA = (0.5, 0.2, 0.8)
#: Numbers that the stored reference was made for.
INPUTS = {"moments": MOMENTS, "omega": OMEGA}


def ladder(quick: bool) -> Ladder:
    """Return the methods, their settings and the reference."""
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
    stiff = (1e-3, 1e-4) if quick else (1e-3, 1e-4, 1e-5)
    return ladder_of_rotation(
        "free-rotor",
        INPUTS,
        quick,
        periods="periods of a free triaxial rotor",
        detail=", moments 1 : 1.7 : 2.4",
        reference="the textbook's closed form (Whittaker)",
        closed_form=(_closed_form, 1e-13),
        integrator=("integrate_rotation", _integrated),
        by_hand={
            f"solve_ivp {name}": (partial(_by_hand, name), steps)
            for name, steps in (("RK45", coarse), ("LSODA", coarse), ("Radau", stiff))
        },
    )


def _closed_form(t: FloatArray) -> Rotation:
    motion = free_rotation(MOMENTS, OMEGA, t)
    return (motion.omega_body, motion.attitude), t.size


def _integrated(t: FloatArray, rtol: float) -> Rotation:
    motion = integrate_rotation(MOMENTS, OMEGA, t, rtol=rtol, atol=1e-2 * rtol)
    return (motion.omega_body, motion.attitude), motion.evaluations


def _by_hand(method: str, t: FloatArray, rtol: float) -> Rotation:
    """Euler's equations and the quaternion as one would type them."""
    a, b, c = MOMENTS

    def rates(_: float, state: FloatArray) -> list[float]:
        p, q, r, w, x, y, z = state
        return [
            (b - c) / a * q * r,
            (c - a) / b * r * p,
            (a - b) / c * p * q,
            (-x * p - y * q - z * r) / 2,
            (w * p + y * r - z * q) / 2,
            (w * q + z * p - x * r) / 2,
            (w * r + x * q - y * p) / 2,
        ]

    start = [*OMEGA, 1.0, 0.0, 0.0, 0.0]
    done = solve_ivp(rates, (0.0, t[-1]), start, method, t_eval=t, rtol=rtol, atol=1e-2 * rtol)
    return (done.y[:3].T, done.y[3:].T), done.nfev
