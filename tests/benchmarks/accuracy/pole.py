"""Figure axis under torques of Sun and Moon: Picard iteration beside integrators."""

from functools import partial

import numpy as np

from earthspin.constants import DAY, UAS
from earthspin.motion.axes import axis_path
from earthspin.numerics.arrays import FloatArray
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.attitude import attitude_about, attitude_motion, figure_axis
from tests.reference.momentum_and_figure import axisymmetric_motion
from tests.reference.sky import FORCES, GM, SPIN, H, Tide
from tests.reference.stepping import integrate
from tests.reference.stored import load

#: Span from J2000.0, d.
DAYS = 730.0
#: Inputs of the stored reference.
INPUTS = {"h": H, "spin_rate": SPIN, "gm": list(GM.values()), "kernel": "de421", "days": DAYS}
#: Numbers of nodes, and a bound on the error with the most nodes (uas), by window length (d).
WINDOWS = {
    4: ((4, 6, 8, 10, 12, 14), 5e-4),
    8: ((4, 6, 8, 10, 12, 14, 16, 20), 5e-4),
    16: ((6, 8, 12, 16, 20, 24, 32), 5e-3),
    32: ((6, 8, 12, 16), 5e3),
}
#: Tolerance of the integrators that resolve each rotation. It hardly matters, because no step is
#: longer than a radian of the rotation.
TOLERANCE = 1e-9
SCIPY = ("RK45", "LSODA", "DOP853")


def ladder() -> Ladder:
    """Methods for two years of the figure axis."""
    true = load("pole", INPUTS)
    start, momentum, times = (true[name].hi for name in ("start_axis", "start_momentum", "days"))
    times = times * DAY
    stops = np.concatenate([[0.0], times])

    def error(axes: FloatArray) -> float:
        axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
        return np.max(np.linalg.norm((axes - true["figure"]).hi, axis=1)) / UAS

    def picard(length: int, order: float) -> tuple[FloatArray, int]:
        span = (0.0, DAYS * DAY)
        path = axis_path(FORCES, start, 0.0, span, window=length * DAY, order=int(order))
        return path.at(times)["figure"], path.windows.times.size

    def momentum_and_figure() -> tuple[FloatArray, int]:
        tide = Tide(DAYS * DAY)
        _, axis = axisymmetric_motion(tide, H, SPIN, momentum, start, stops, rtol=TOLERANCE)
        return axis[1:], tide.calls

    def full_attitude() -> tuple[FloatArray, int]:
        tide, turn = Tide(DAYS * DAY), attitude_about(start, 0.0)
        _, attitude = attitude_motion(tide, H, 0.0, SPIN, momentum, turn, stops, rtol=TOLERANCE)
        return figure_axis(attitude[1:]), tide.calls

    def momentum_only(method: str, rtol: float) -> tuple[FloatArray, int]:
        """Integrate the angular momentum, and add the tilt of the figure to first order."""
        tide, tau = Tide(DAYS * DAY), (1 - H) / SPIN

        def rate(time: float, axis: FloatArray) -> FloatArray:
            return np.asarray(3 * H / SPIN * np.cross(tide(time) @ axis, axis))

        begin = start + tau * np.cross(start, rate(0.0, start))
        axes, evaluations = integrate(rate, begin, times, rtol, method, atol=1e-3 * rtol)
        tilts = [tau * np.cross(a, rate(time, a)) for time, a in zip(times, axes, strict=True)]
        return axes - np.stack(tilts), evaluations

    return Ladder(
        title="Pole: figure axis under Sun and Moon, 2 years",
        problem=f"{DAYS / 365:g} years of the figure axis of an axisymmetric body under Sun and "
        f"Moon of DE421, without free wobble, at {times.size} times; the error is the largest "
        "angle",
        reference="angular momentum and figure axis in long double by extrapolation of order 20 "
        "in steps of 3 hours",
        unit="µas",
        # halving the steps of the reference changes it by 1e-21 rad; its free motion is smaller
        floor=1e-19 / UAS,
        error=error,
        runs={
            f"windows of {length} d": settings("{} nodes", partial(picard, length), nodes)
            for length, (nodes, _) in WINDOWS.items()
        }
        | {
            "momentum and figure axis": {"DOP853": momentum_and_figure},
            "full attitude": {"DOP853": full_attitude},
        }
        | {
            f"SciPy {name}, momentum alone": settings(
                "rtol {}", partial(momentum_only, name), (1e-6, 1e-8)
            )
            for name in SCIPY
        },
        bounds={f"windows of {length} d": bound for length, (_, bound) in WINDOWS.items()}
        | {"momentum and figure axis": 5e-4, "full attitude": 5e-3},
    )
