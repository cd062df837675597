"""A triaxial rotor without torque: Jacobi's closed form against integrators."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.stored import load, rotation_error
from earthspin.checks.work_precision import Ladder, Method, Setting, plain

FloatArray = NDArray[np.float64]

#: kg m2 and rad/s: three different moments, a start that is near no axis.
MOMENTS = (1.0, 1.7, 2.4)
OMEGA = (0.5, 0.2, 0.8)
#: What the stored reference hangs on. Half of its times lie within the first few periods.
INPUTS = {"moments": MOMENTS, "omega": OMEGA}
PERIODS, FEW_PERIODS = 100.0, 5.0
TIMES = 40

ROUNDING = 1e-28


def ladder(quick: bool) -> Ladder:
    """Make the ladder."""
    true = load("free-rotor", INPUTS)
    wanted = slice(0, TIMES // 2 if quick else TIMES)
    t = true["times"].hi[wanted]
    omega, attitude = true["omega"][wanted], true["attitude"][wanted]
    span = f"{FEW_PERIODS if quick else PERIODS:g} periods of a free triaxial rotor"
    return Ladder(
        quantity="free-rotor",
        unit="1",
        problem=f"{span}, moments 1 : 1.7 : 2.4, at {t.size} times; the error is the largest of "
        "the angular velocity, relative to its size, and of the attitude, in rad",
        subject=span,
        reference="the textbook's closed form (Whittaker) with 80 digits, kept to 32",
        reference_error=ROUNDING,
        methods=_methods(t, quick),
        useful=0.1,
        error=lambda found: rotation_error(found, omega, attitude),
    )


def _methods(t: FloatArray, quick: bool) -> list[Method]:
    fine = (1e-4, 1e-8) if quick else (1e-4, 1e-6, 1e-8, 1e-10, 1e-13)
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
    stiff = (1e-3, 1e-4) if quick else (1e-3, 1e-4, 1e-5)
    return [
        Method("closed form", True, [Setting("", _closed_form(t))], bound=1e-13),
        Method(
            "integrate_rotation",
            True,
            [Setting(f"DOP853, rtol {plain(rtol)}", _integrated(t, rtol)) for rtol in fine],
            bound=1e-3 if quick else 1e-9,
        ),
        *(
            Method(
                f"solve_ivp {name}",
                False,
                [Setting(f"rtol {plain(rtol)}", _by_hand(t, name, rtol)) for rtol in steps],
            )
            for name, steps in (("RK45", coarse), ("LSODA", coarse), ("Radau", stiff))
        ),
    ]


def _closed_form(t: FloatArray) -> Callable[[], tuple[Any, int]]:
    from earthspin.rotor.triaxial import free_rotation

    def run() -> tuple[Any, int]:
        motion = free_rotation(MOMENTS, OMEGA, t)
        return (motion.omega_body, motion.attitude), t.size

    return run


def _integrated(t: FloatArray, rtol: float) -> Callable[[], tuple[Any, int]]:
    from earthspin.rotor.euler import integrate_rotation

    def run() -> tuple[Any, int]:
        motion = integrate_rotation(MOMENTS, OMEGA, t, rtol=rtol, atol=1e-2 * rtol)
        return (motion.omega_body, motion.attitude), motion.evaluations

    return run


def _by_hand(t: FloatArray, method: str, rtol: float) -> Callable[[], tuple[Any, int]]:
    """Euler's equations and the quaternion as one would type them."""
    from scipy.integrate import solve_ivp

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

    def run() -> tuple[Any, int]:
        done = solve_ivp(rates, (0.0, t[-1]), start, method, t_eval=t, rtol=rtol, atol=1e-2 * rtol)
        return (done.y[:3].T, done.y[3:].T), done.nfev

    return run
