"""Figure axis under torques of Sun and Moon: Picard iteration beside integrators."""

from functools import partial

import erfa
import numpy as np
import xarray as xr

from earthspin.constants import DAY, J2000_JD, UAS
from earthspin.motion.axes import axis_path
from earthspin.numerics.arrays import FloatArray
from tests.benchmarks.accuracy.ladder import Ladder, public_call, settings
from tests.reference.attitude import attitude_about, attitude_motion, figure_axis
from tests.reference.momentum_and_figure import slopes
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
#: What a user types; the reference has no effect beyond Sun and Moon.
CALL = 'earthspin.pole("2000-01-01T12:00", "2001-12-31T12:00", "0.25 d", effects=["second-order"])'
#: Relative tolerances of SciPy's integrators, which resolve each rotation.
SCIPY = {"RK45": (1e-8,), "LSODA": (1e-8, 1e-11), "DOP853": (1e-6, 1e-9, 1e-12)}


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

    def called(answer: xr.Dataset) -> FloatArray:
        """Figure axis of a public answer at the times of the reference."""
        path = answer.sel(axis="figure").isel(time=np.rint(times / (0.25 * DAY)).astype(int))
        return np.stack([path.X, path.Y, path.Z], axis=-1)

    def momentum_and_figure(method: str, rtol: float) -> tuple[FloatArray, int]:
        tide, begin = Tide(DAYS * DAY), np.concatenate([momentum, start])

        def rate(time: float, state: FloatArray) -> list[float]:
            return slopes(state, tide(time) @ state[3:], H, SPIN)

        states, evaluations = integrate(rate, begin, times, rtol, method, atol=1e-3 * rtol)
        return states[:, 3:], evaluations

    def erfa_pole() -> tuple[FloatArray, int]:
        x, y = erfa.xy06(J2000_JD, times / DAY)
        return np.stack([x, y, np.sqrt(1 - x * x - y * y)], axis=-1), times.size

    def full_attitude() -> tuple[FloatArray, int]:
        tide, turn = Tide(DAYS * DAY), attitude_about(start, 0.0)
        _, attitude = attitude_motion(tide, H, 0.0, SPIN, momentum, turn, stops, rtol=1e-9)
        return figure_axis(attitude[1:]), tide.calls

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
            "pole(), first and later": public_call(CALL, called),
            "SciPy DOP853, full attitude": {"rtol 1e-9": full_attitude},
            "ERFA, IAU 2006/2000A": {"": erfa_pole},
        }
        | {
            f"SciPy {name}": settings("rtol {}", partial(momentum_and_figure, name), tolerances)
            for name, tolerances in SCIPY.items()
        },
        bounds={f"windows of {length} d": bound for length, (_, bound) in WINDOWS.items()}
        | {"pole(), first and later": 5e-3},
    )
