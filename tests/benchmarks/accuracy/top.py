"""Heavy top: the closed form beside integrators, over a hundred nutations."""

from functools import partial

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.start import HeavyTop
from tests.benchmarks.accuracy.ladder import COARSE, FINE, Ladder, settings
from tests.reference.heavy_top import integrate_heavy_top, state_of_angles
from tests.reference.stepping import integrate
from tests.reference.stored import load, rotation_error

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


def ladder() -> Ladder:
    """Methods for a heavy top whose axis draws loops."""
    true, top = load("top", TOP), HeavyTop(**TOP)
    t = true["times"].hi

    def closed() -> tuple[object, int]:
        motion = heavy_top_motion(top, t)
        return (motion.omega_body, motion.attitude), t.size

    def integrated(rtol: float) -> tuple[object, int]:
        motion = integrate_heavy_top(top, t, relative_tolerance=rtol)
        return (motion.omega_body, motion.attitude), motion.evaluations

    scipy = {"RK45": COARSE, "LSODA": COARSE, "DOP853": FINE}
    return Ladder(
        title="Heavy top, 100 nutations",
        problem=f"100 nutations of a heavy top with loops, at {t.size} times; the error is the "
        "largest of the angular velocity, relative to its size, and of the attitude, in rad",
        reference="the textbook's closed form (I.7.9 to I.7.17) with 80 digits, stored with 32",
        unit="1",
        floor=1e-28,
        error=lambda values: rotation_error(values, true["omega"], true["attitude"]),
        runs={
            "closed form": {"": closed},
            "integrate_heavy_top": settings("DOP853, rtol {}", integrated, FINE),
            **{
                f"Euler angles, {name}": settings(
                    "rtol {}", partial(_by_scipy, t, name), tolerances
                )
                for name, tolerances in scipy.items()
            },
        },
        bounds={"closed form": 5e-13, "integrate_heavy_top": 1e-9},
    )


def _by_scipy(t: FloatArray, method: str, rtol: float) -> tuple[object, int]:
    """Integrate the textbook equations of the Euler angles (I.7.5 to I.7.8) with SciPy."""
    i1, i3, weight = TOP["transverse_moment"], TOP["axial_moment"], TOP["weight_moment"]
    spin, a = TOP["spin"], i3 * TOP["spin"] / i1
    b = TOP["phi_rate"] * np.sin(TOP["theta"]) ** 2 + a * np.cos(TOP["theta"])

    def rates(_: float, state: FloatArray) -> list[float]:
        s, c = np.sin(state[0]), np.cos(state[0])
        phi_rate = (b - a * c) / s**2
        push = weight / i1 * s + phi_rate * s * (phi_rate * c - a)
        return [state[1], push, phi_rate, spin - phi_rate * c]

    start = [TOP["theta"], TOP["theta_rate"], 0.0, TOP["psi"]]
    states, evaluations = integrate(rates, start, t, rtol, method, atol=1e-2 * rtol)
    theta, theta_rate, phi, psi = states.T
    across = (b - a * np.cos(theta)) / np.sin(theta)
    return state_of_angles(theta, phi, psi, across, theta_rate, spin), evaluations
