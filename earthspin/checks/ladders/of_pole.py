"""Compare error and run time of methods for the figure axis under torques of Sun and Moon.

Methods: Picard iteration and step-by-step integrators.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from earthspin.checks.ladders import taylor
from tests.reference.sky import FORCES, GM, SPIN, H, Tide
from tests.reference.attitude import attitude_about, attitude_motion, figure_axis
from tests.reference.momentum_and_figure import axisymmetric_motion
from tests.reference.stepping import integrate
from tests.reference.stored import load
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Result, method
from earthspin.constants import DAY, UAS
from earthspin.motion.axes import axis_path
from earthspin.numerics.double_double import DoubleDouble

#: Span from J2000.0 in a full and in a quick run, d, and the numbers of times.
DAYS, FEW_DAYS = 730.0, 64.0
TIMES, FEW_TIMES = 240, 60
#: Inputs of the stored reference.
INPUTS = {
    "h": H,
    "spin_rate": SPIN,
    "gm": list(GM.values()),
    "kernel": "de421",
    "days": DAYS,
}
#: Numbers of nodes, and a bound on the error with the most nodes (uas), by window length (d).
WINDOWS = {
    4: ((4, 6, 8, 10, 12, 14), 5e-4),
    8: ((4, 6, 8, 10, 12, 14, 16, 20), 5e-4),
    16: ((6, 8, 12, 16, 20, 24, 32), 5e-3),
    32: ((6, 8, 12, 16), 5e3),
}
QUICK_WINDOWS = {8: ((6, 12, 20), 5e-4)}
#: Tolerance of the integrators that resolve each rotation. It hardly matters, because no step is
#: longer than a radian of the rotation.
TOLERANCE = 1e-9
#: Bound on the error of the reference, rad: halving its steps changes it by 1e-21, and the
#: remaining free motion is smaller.
REFERENCE_ERROR = 1e-19


def days() -> FloatArray:
    """Times at which figure axes are compared, d from J2000.0, early ones and later ones.

    They are multiples of 1/4 d.
    """
    generator = np.random.default_rng(7)
    early = generator.choice(np.arange(4, 4 * FEW_DAYS), FEW_TIMES, replace=False)
    late = generator.choice(np.arange(4 * FEW_DAYS, 4 * DAYS), TIMES - FEW_TIMES, replace=False)
    return np.concatenate([np.sort(early), np.sort(late)]) / 4


@dataclass(frozen=True)
class Motion:
    """Initial axis and angular momentum of the test problem, and the times of its solution.

    Attributes
    ----------
    start, momentum : ndarray, shape (3,)
        Figure axis, and angular momentum in units of C Omega, at J2000.0.
    times : ndarray, shape (n,)
        Times of the figure axes, s.
    end : float
        End of the span, s.
    """

    start: FloatArray
    momentum: FloatArray
    times: FloatArray
    end: float


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the motion of the figure axis."""
    true = load("pole", INPUTS)
    wanted = slice(0, FEW_TIMES if quick else TIMES)
    span = FEW_DAYS if quick else DAYS
    figure = true["figure"][wanted]
    words = f"{span:g} days" if quick else f"{span / 365:g} years"
    motion = Motion(
        true["start_axis"].hi, true["start_momentum"].hi, true["days"].hi[wanted] * DAY, span * DAY
    )
    windows = QUICK_WINDOWS if quick else WINDOWS
    integrators = ("LSODA",) if quick else ("RK45", "LSODA", "DOP853")
    loose = (1e-6,) if quick else (1e-6, 1e-8)

    def row(name: str, words: str, run: Callable[..., Result], *rest: Any) -> Method:
        return method(name, words, partial(run, motion), *rest)

    methods = [
        *(
            row(f"Picard, {length} d", "{} nodes", partial(_picard, length), nodes, bound * UAS)
            for length, (nodes, bound) in windows.items()
        ),
        row("momentum and figure axis", "DOP853", _exact, None, 5e-4 * UAS),
        row("full attitude", "DOP853", _attitude, None, 5e-3 * UAS),
        *(
            row(f"{name}, angular momentum only", "rtol {}", partial(_by_scipy, name), loose)
            for name in integrators
        ),
    ]
    if taylor.is_installed():
        methods.append(row("Taylor series by heyoka", "tolerance {}", _peer, (1e-9, 1e-12, 1e-16)))
    return Ladder(
        quantity="pole",
        unit="uas",
        problem=f"{words} of the figure axis of an axisymmetric body under Sun and Moon of "
        f"DE421, without free wobble, at {len(figure.hi)} times; the error is the largest angle",
        subject=f"{words} of the figure axis",
        reference="angular momentum and figure axis in long double by extrapolation of order 20 "
        "in steps of 3 hours",
        reference_error=REFERENCE_ERROR,
        methods=methods,
        error=lambda axes: _error(axes, figure),
        useful=1e6 * UAS,
        skipped="" if taylor.is_installed() else "heyoka, which is not installed",
    )


def _error(axes: FloatArray, figure: DoubleDouble) -> float:
    axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return float(np.max(np.linalg.norm((axes - figure).hi, axis=1)))


def _picard(length: int, motion: Motion, order: int) -> Result:
    """Figure axis by the package's solver, with windows of `length` days and `order` nodes each."""
    span = (0.0, motion.end)
    path = axis_path(FORCES, motion.start, 0.0, span, window=length * DAY, order=order)
    return path.at(motion.times)["figure"], path.windows.times.size


def _exact(motion: Motion) -> Result:
    tide, times = Tide(motion.end), np.concatenate([[0.0], motion.times])
    _, axis = axisymmetric_motion(
        tide, H, SPIN, motion.momentum, motion.start, times, rtol=TOLERANCE
    )
    return axis[1:], tide.calls


def _attitude(motion: Motion) -> Result:
    tide, times = Tide(motion.end), np.concatenate([[0.0], motion.times])
    start = attitude_about(motion.start, 0.0)
    _, attitude = attitude_motion(tide, H, 0.0, SPIN, motion.momentum, start, times, rtol=TOLERANCE)
    return figure_axis(attitude[1:]), tide.calls


def _peer(motion: Motion, tolerance: float) -> Result:
    """Figure axis from a Taylor-series integration with the library heyoka."""
    days = motion.times / DAY
    return taylor.figure_axis(
        motion.momentum, motion.start, days, h=H, spin_rate=SPIN, tolerance=tolerance
    )


def _by_scipy(method: str, motion: Motion, rtol: float) -> Result:
    """Figure axis from an integration of the angular momentum with SciPy.

    The torque is computed as if figure axis and angular momentum were parallel; the angle between
    them, to first order, is added last.
    """
    tide, tau = Tide(motion.end), (1 - H) / SPIN

    def rate(time: float, axis: FloatArray) -> FloatArray:
        return np.asarray(3 * H / SPIN * np.cross(tide(time) @ axis, axis))

    momentum = motion.start + tau * np.cross(motion.start, rate(0.0, motion.start))
    axes, evaluations = integrate(rate, momentum, motion.times, rtol, method, atol=1e-3 * rtol)
    tilts = [tau * np.cross(a, rate(time, a)) for time, a in zip(motion.times, axes, strict=True)]
    return axes - np.stack(tilts), evaluations
