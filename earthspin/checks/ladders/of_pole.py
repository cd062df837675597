"""The figure axis under Sun and Moon: Picard on Gauss windows against step-by-step solvers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from earthspin.checks.ladders import taylor
from earthspin.checks.sky import CENTRE, CODES, GM, SPIN, H, Tide, kernel, positions
from earthspin.checks.solvers.attitude import attitude_about, attitude_motion
from earthspin.checks.solvers.momentum_and_figure import axisymmetric_motion
from earthspin.checks.stored import Values, load
from earthspin.checks.work_precision import Ladder, Method, settings
from earthspin.constants import DAY, J2000_JD, UAS
from earthspin.motion.axes import axis_path
from earthspin.motion.forces import Figure, Forces

FloatArray = NDArray[np.float64]
#: Figure axes, and how often the sky or a slope was asked for.
Found = tuple[FloatArray, int]

#: d: what is followed, from J2000.0; the figure axis is asked for at so many times.
DAYS, FEW_DAYS = 730.0, 64.0
TIMES, FEW_TIMES = 240, 60
#: Numbers that the stored reference was made for.
INPUTS = {
    "h": H,
    "spin_rate": SPIN,
    "gm": list(GM.values()),
    "kernel": "de421",
    "days": DAYS,
}
#: Nodes by length of the window, d, and bounds on the error with the most nodes, uas.
WINDOWS = {
    4: (4, 6, 8, 10, 12, 14),
    8: (4, 6, 8, 10, 12, 14, 16, 20),
    16: (6, 8, 12, 16, 20, 24, 32),
    32: (6, 8, 12, 16),
}
PICARD_BOUNDS = {4: 5e-4, 8: 5e-4, 16: 5e-3, 32: 5e3}
#: Of the solvers that follow each turn: no step is ever longer than a radian of it, so that
#: tolerances hardly matter.
TOLERANCE = 1e-9
#: Steps of half the length change the reference by 1e-21, and no more free motion is left, rad.
REFERENCE_ERROR = 1e-19


def days() -> FloatArray:
    """Times of the reference, d from J2000.0: quarters of days, many of them early."""
    generator = np.random.default_rng(7)
    early = generator.choice(np.arange(4, 4 * FEW_DAYS), FEW_TIMES, replace=False)
    late = generator.choice(np.arange(4 * FEW_DAYS, 4 * DAYS), TIMES - FEW_TIMES, replace=False)
    return np.concatenate([np.sort(early), np.sort(late)]) / 4


@dataclass(frozen=True)
class Motion:
    """What is followed.

    Attributes
    ----------
    start, momentum : ndarray, shape (3,)
        Figure axis, and angular momentum in units of C Omega, at J2000.0.
    times : ndarray, shape (n,)
        At which the figure axis is asked for, s.
    end : float
        Of the span, s.
    """

    start: FloatArray
    momentum: FloatArray
    times: FloatArray
    end: float


def ladder(quick: bool) -> Ladder:
    """Return the methods, their settings and the reference."""
    true = load("pole", INPUTS)
    wanted = slice(0, FEW_TIMES if quick else TIMES)
    span = FEW_DAYS if quick else DAYS
    figure = true["figure"][wanted]
    words = f"{span:g} days" if quick else f"{span / 365:g} years"
    motion = Motion(
        true["start_axis"].hi, true["start_momentum"].hi, true["days"].hi[wanted] * DAY, span * DAY
    )
    windows = {8: WINDOWS[8][1::3]} if quick else WINDOWS
    by_hand = ("LSODA",) if quick else ("RK45", "LSODA", "DOP853")
    loose = (1e-6,) if quick else (1e-6, 1e-8)
    methods = [
        Method(
            f"Picard, {length} d",
            settings("{} nodes", partial(_picard, motion, length), nodes),
            PICARD_BOUNDS[length] * UAS,
        )
        for length, nodes in windows.items()
    ]
    methods += [
        Method("momentum and figure axis", settings("DOP853", partial(_exact, motion)), 5e-4 * UAS),
        Method("whole attitude", settings("DOP853", partial(_attitude, motion)), 5e-3 * UAS),
    ]
    for name in by_hand:
        on_pole = settings("rtol {}", partial(_by_hand, motion, name), loose)
        methods.append(Method(f"{name} on the pole alone", on_pole))
    if taylor.is_installed():
        series = settings("tolerance {}", partial(_peer, motion), (1e-9, 1e-12, 1e-16))
        methods.append(Method("Taylor series by heyoka", series))
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


def _error(axes: FloatArray, figure: Values) -> float:
    axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return float(np.max(np.linalg.norm(figure.error_of(axes), axis=1)))


def _picard(motion: Motion, length: int, order: int) -> Found:
    """What the package does: windows of so many days, with so many nodes."""
    forces = Forces(
        figure=Figure(h=H, spin_rate=SPIN),
        gm=GM,
        positions=lambda times: positions(times / DAY),
    )
    span = (0.0, motion.end)
    path = axis_path(forces, motion.start, 0.0, span, window=length * DAY, order=order)
    return path.at(motion.times)["figure"], path.windows.times.size


def _exact(motion: Motion) -> Found:
    tide, times = Tide(motion.end), np.concatenate([[0.0], motion.times])
    _, axis = axisymmetric_motion(
        tide, H, SPIN, motion.momentum, motion.start, times, rtol=TOLERANCE
    )
    return axis[1:], tide.calls


def _attitude(motion: Motion) -> Found:
    tide, times = Tide(motion.end), np.concatenate([[0.0], motion.times])
    start = attitude_about(motion.start, 0.0)
    _, turned = attitude_motion(tide, H, 0.0, SPIN, motion.momentum, start, times, rtol=TOLERANCE)
    return Rotation.from_quat(turned[1:], scalar_first=True).as_matrix()[:, :, 2], tide.calls


def _peer(motion: Motion, tolerance: float) -> Found:
    """Taylor series of angular momentum and figure axis by heyoka."""
    days = motion.times / DAY
    return taylor.figure_axis(
        motion.momentum, motion.start, days, h=H, spin_rate=SPIN, tolerance=tolerance
    )


def _by_hand(motion: Motion, method: str, rtol: float) -> Found:
    """Integrate the angular momentum, torque taken along it; then tilt it to the first order."""
    start, t = motion.start, motion.times
    scale = 3 * H / SPIN
    tau = (1 - H) / SPIN
    legs = ((0, CODES["sun"]), (0, 3), (3, CENTRE), (3, CODES["moon"]))
    segments = [kernel()._segments[leg] for leg in legs]

    def rate(time: float, axis: FloatArray) -> FloatArray:
        sun, middle, here, moon = (
            segment.compute(J2000_JD, time / DAY)[:3] * 1e3 for segment in segments
        )
        total = np.zeros(3)
        for gm, r in ((GM["sun"], sun - middle - here), (GM["moon"], moon - here)):
            total += gm * (r @ axis) / (r @ r) ** 2.5 * np.cross(r, axis)
        return scale * total

    momentum = start + tau * np.cross(start, rate(0.0, start))
    done = solve_ivp(rate, (0.0, t[-1]), momentum, method, t_eval=t, rtol=rtol, atol=1e-3 * rtol)
    axes = done.y.T
    tilts = [tau * np.cross(a, rate(time, a)) for time, a in zip(t, axes, strict=True)]
    return axes - np.stack(tilts), done.nfev
