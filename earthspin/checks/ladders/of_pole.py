"""The figure axis under Sun and Moon: Picard on Gauss windows against step-by-step solvers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.ladders import taylor
from earthspin.checks.sky import CENTRE, CODES, GM, SPIN, H, Tide, kernel, positions
from earthspin.checks.stored import Values, load
from earthspin.checks.work_precision import Ladder, Method, Setting, plain
from earthspin.constants import ARCSEC, DAY, J2000_JD

FloatArray = NDArray[np.float64]
Run = Callable[[], tuple[Any, int]]

UAS = 1e-6 * ARCSEC
#: d: what is followed, from J2000.0; the figure axis is asked for at so many times.
DAYS, FEW_DAYS = 730.0, 64.0
TIMES, FEW_TIMES = 240, 60
#: What the stored reference hangs on.
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
#: Steps of half the length change the reference by 1e-21, and no more free motion is left, rad.
REFERENCE_ERROR = 1e-19


def days() -> FloatArray:
    """Times of the reference, d from J2000.0: quarters of days, many of them early."""
    generator = np.random.default_rng(7)
    early = generator.choice(np.arange(4, 4 * FEW_DAYS), FEW_TIMES, replace=False)
    late = generator.choice(np.arange(4 * FEW_DAYS, 4 * DAYS), TIMES - FEW_TIMES, replace=False)
    return np.concatenate([np.sort(early), np.sort(late)]) / 4


def ladder(quick: bool) -> Ladder:
    """Make the ladder."""
    true = load("pole", INPUTS)
    wanted = slice(0, FEW_TIMES if quick else TIMES)
    span = FEW_DAYS if quick else DAYS
    figure = true["figure"][wanted]
    words = f"{span:g} days" if quick else f"{span / 365:g} years"
    return Ladder(
        quantity="pole",
        unit="uas",
        problem=f"{words} of the figure axis of an axisymmetric body under Sun and Moon of "
        f"DE421, without free wobble, at {len(figure.hi)} times; the error is the largest angle",
        subject=f"{words} of the figure axis",
        reference="angular momentum and figure axis in long double by extrapolation of order 20 "
        "in steps of 3 hours",
        reference_error=REFERENCE_ERROR,
        methods=_methods(true, true["days"].hi[wanted] * DAY, span * DAY, quick),
        error=lambda found: _error(found, figure),
        useful=1e6 * UAS,
        skipped="" if taylor.is_installed() else "heyoka, which is not installed",
    )


def _error(found: FloatArray, figure: Values) -> float:
    found = found / np.linalg.norm(found, axis=1, keepdims=True)
    return float(np.max(np.linalg.norm(figure.error_of(found), axis=1)))


def _methods(true: dict[str, Values], t: FloatArray, end: float, quick: bool) -> list[Method]:
    start, momentum = true["start_axis"].hi, true["start_momentum"].hi
    picard = [
        Method(
            f"Picard, {length} d",
            True,
            [
                Setting(f"{order} nodes", _picard(start, t, end, length, order))
                for order in (orders[1::3] if quick else orders)
            ],
            bound=PICARD_BOUNDS[length] * UAS,
        )
        for length, orders in WINDOWS.items()
        if not quick or length == 8
    ]
    # Neither step is ever longer than a radian of the daily turn: tolerances hardly matter.
    fine, loose = 1e-9, (1e-6,) if quick else (1e-6, 1e-8)
    return [
        *picard,
        Method(
            "momentum and figure axis",
            True,
            [Setting("DOP853", _exact(start, momentum, t, end, fine))],
            bound=5e-4 * UAS,
        ),
        Method(
            "whole attitude",
            True,
            [Setting("DOP853", _attitude(start, momentum, t, end, fine))],
            bound=5e-3 * UAS,
        ),
        *(
            Method(
                f"{name} on the pole alone",
                False,
                [Setting(f"rtol {plain(r)}", _by_hand(start, t, name, r)) for r in loose],
            )
            for name in (("LSODA",) if quick else ("RK45", "LSODA", "DOP853"))
        ),
        *([_peer(start, momentum, t)] if taylor.is_installed() else []),
    ]


def _peer(start: FloatArray, momentum: FloatArray, t: FloatArray) -> Method:
    """Taylor series of angular momentum and figure axis by heyoka."""

    def setting(tolerance: float) -> Setting:
        return Setting(
            f"tolerance {plain(tolerance)}",
            lambda: taylor.figure_axis(
                momentum, start, t / DAY, h=H, spin_rate=SPIN, tolerance=tolerance
            ),
        )

    return Method("Taylor series by heyoka", False, [setting(v) for v in (1e-9, 1e-12, 1e-16)])


def _picard(start: FloatArray, t: FloatArray, end: float, length: int, order: int) -> Run:
    from earthspin.motion.axes import axis_path
    from earthspin.motion.forces import Figure, Forces

    def run() -> tuple[Any, int]:
        forces = Forces(
            figure=Figure(h=H, spin_rate=SPIN),
            gm=GM,
            positions=lambda times: positions(times / DAY),
        )
        path = axis_path(forces, start, 0.0, (0.0, end), window=length * DAY, order=order)
        return path.at(t)["figure"], path.windows.times.size

    return run


def _exact(start: FloatArray, momentum: FloatArray, t: FloatArray, end: float, rtol: float) -> Run:
    from earthspin.motion.exact import axisymmetric_motion

    times = np.concatenate([[0.0], t])

    def run() -> tuple[Any, int]:
        tide = Tide(end)
        _, axis = axisymmetric_motion(tide, H, SPIN, momentum, start, times, rtol=rtol)
        return axis[1:], tide.calls

    return run


def _attitude(
    start: FloatArray, momentum: FloatArray, t: FloatArray, end: float, rtol: float
) -> Run:
    from earthspin.motion.attitude import (
        attitude_motion,
        quaternion_from_matrix,
        rotation_matrix,
    )
    from earthspin.motion.triaxial import equatorial_basis

    x = equatorial_basis(start)[0]
    turn = quaternion_from_matrix(np.stack([x, np.cross(start, x), start], axis=1))
    times = np.concatenate([[0.0], t])

    def run() -> tuple[Any, int]:
        tide = Tide(end)
        _, turned = attitude_motion(tide, H, 0.0, SPIN, momentum, turn, times, rtol=rtol)
        return rotation_matrix(turned[1:])[:, :, 2], tide.calls

    return run


def _by_hand(start: FloatArray, t: FloatArray, method: str, rtol: float) -> Run:
    """Integrate the angular momentum, torque taken along it; then tilt it to the first order."""
    from scipy.integrate import solve_ivp

    scale = 3 * H / SPIN
    kappa = (1 - H) / SPIN
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

    def run() -> tuple[Any, int]:
        momentum = start + kappa * np.cross(start, rate(0.0, start))
        done = solve_ivp(
            rate, (0.0, t[-1]), momentum, method, t_eval=t, rtol=rtol, atol=1e-3 * rtol
        )
        axes = done.y.T
        tilts = [kappa * np.cross(a, rate(time, a)) for time, a in zip(t, axes, strict=True)]
        return axes - np.stack(tilts), done.nfev

    return run
