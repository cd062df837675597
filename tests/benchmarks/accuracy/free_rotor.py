"""Free triaxial rotor: Jacobi's closed form beside integrators, over a hundred periods."""

from functools import partial

from earthspin.numerics.arrays import FloatArray
from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.triaxial import free_rotation
from tests.benchmarks.accuracy.ladder import COARSE, FINE, Ladder, settings
from tests.reference.stepping import integrate, quaternion_rate
from tests.reference.stored import load, rotation_error

#: Three different moments (kg m2), and an angular velocity that is near no principal axis (rad/s).
MOMENTS = (1.0, 1.7, 2.4)
OMEGA = (0.5, 0.2, 0.8)
#: Inputs of the stored reference.
INPUTS = {"moments": MOMENTS, "omega": OMEGA}


def ladder() -> Ladder:
    """Methods for a free triaxial rotor."""
    true = load("free-rotor", INPUTS)
    t = true["times"].hi

    def closed() -> tuple[object, int]:
        motion = free_rotation(MOMENTS, OMEGA, t)
        return (motion.omega_body, motion.attitude), t.size

    def integrated(rtol: float) -> tuple[object, int]:
        motion = integrate_rotation(MOMENTS, OMEGA, t, rtol=rtol, atol=1e-2 * rtol)
        return (motion.omega_body, motion.attitude), motion.evaluations

    scipy = {"RK45": COARSE[:5], "LSODA": COARSE[:5], "Radau": COARSE[:3]}
    return Ladder(
        title="Free triaxial rotor, 100 periods",
        problem=f"100 periods of a free rotor with moments 1 : 1.7 : 2.4, at {t.size} times; the "
        "error is the largest of the angular velocity, relative to its size, and of the attitude, "
        "in rad",
        reference="the textbook's closed form (Whittaker) with 80 digits, stored with 32",
        unit="1",
        floor=1e-28,
        error=lambda values: rotation_error(values, true["omega"], true["attitude"]),
        runs={
            "closed form": {"": closed},
            "integrate_rotation": settings("DOP853, rtol {}", integrated, FINE),
            **{
                f"solve_ivp {name}": settings("rtol {}", partial(_by_scipy, t, name), tolerances)
                for name, tolerances in scipy.items()
            },
        },
        bounds={"closed form": 1e-13, "integrate_rotation": 1e-9},
    )


def _by_scipy(t: FloatArray, method: str, rtol: float) -> tuple[object, int]:
    """Integrate Euler's equations and the attitude quaternion with SciPy."""
    a, b, c = MOMENTS

    def rates(_: float, state: FloatArray) -> list[float]:
        p, q, r = omega = state[:3]
        torque_free = [(b - c) / a * q * r, (c - a) / b * r * p, (a - b) / c * p * q]
        return torque_free + quaternion_rate(state[3:], omega)

    start = [*OMEGA, 1.0, 0.0, 0.0, 0.0]
    states, evaluations = integrate(rates, start, t, rtol, method, atol=1e-2 * rtol)
    return (states[:, :3], states[:, 3:]), evaluations
