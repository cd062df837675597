"""Accuracy of the closed form.

Errors are against the textbook's form at eighty digits: of theta relative to itself, of phi
and psi relative to how far they have gone, of the transverse angular velocity relative to its
largest value, and of the elements of the attitude matrix. Where an error is beyond 1e-13 it is
set against what one unit in the last place of each input does to the same number.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import mpmath as mp
import numpy as np

from earthspin.top.closed_form import HeavyTopMotion, heavy_top_motion
from earthspin.top.start import HeavyTop
from tests.rotor.accuracy import matrix
from tests.top.families import Start
from tests.top.textbook import DIGITS, State, Textbook

#: Times in nutation periods: within a few, and after ten thousand.
FRACTIONS = (-0.83, 0.31, 3.17)
LATE = 9999.37
#: Errors up to this are as good as asked for.
GOOD = 1e-13
#: Where a unit in the last place does more than this, the start does not tell the motion.
UNDETERMINED = 1e-3


class Errors(NamedTuple):
    """Worst of a motion: error, and error over the effect of a unit in the last place.

    The second is 0 where the error itself is good.
    """

    error: float
    ulps: float


def errors(start: Start, fractions: tuple[float, ...]) -> Errors:
    """Worst error of a motion at times given in its nutation periods."""
    with mp.workdps(DIGITS):
        book = Textbook(start)
        times = np.array(fractions) * float(book.period)
        exact = [book.at(moment) for moment in times]
        found = heavy_top_motion(HeavyTop(**start), times)
        scales = _scales(start, float(book.period), exact)
        worst, ulps = 0.0, 0.0
        for index, state in enumerate(exact):
            off = np.abs(_differences(_found(found, index), _numbers(state), scales))
            if off.max() > GOOD:
                effect = _ulp_effect(start, float(times[index]), state, scales)
                if effect.max() > UNDETERMINED:
                    continue
                bad = off > GOOD
                ulps = max(ulps, float((off[bad] / np.maximum(effect[bad], 1e-300)).max()))
            worst = max(worst, float(off.max()))
    return Errors(worst, ulps)


def _numbers(state: State) -> list[Any]:
    """All that is compared, as one list."""
    return [state.theta, state.phi, state.psi, state.transverse, *state.attitude]


def _found(motion: HeavyTopMotion, index: int) -> list[Any]:
    omega = motion.omega_body[index]
    return [
        mp.mpf(motion.theta[index]),
        mp.mpf(motion.phi[index]),
        mp.mpf(motion.psi[index]),
        mp.mpc(*map(float, omega[:2])),
        *matrix(motion.attitude[index]).flat,
    ]


def _scales(start: Start, period: float, exact: list[State]) -> list[Any]:
    """What each difference is relative to: the largest in a few periods for signed numbers."""
    grid = heavy_top_motion(HeavyTop(**start), np.linspace(-1, 1, 200) * period)
    phi, psi = (
        max(*(abs(getattr(state, name)) for state in exact), np.abs(getattr(grid, name)).max())
        for name in ("phi", "psi")
    )
    transverse = np.abs(grid.omega_body[:, 0] + 1j * grid.omega_body[:, 1]).max()
    return [None, phi, psi, transverse] + [mp.mpf(1)] * 9


def _differences(found: list[Any], exact: list[Any], scales: list[Any]) -> Any:
    """Relative differences; None scales by the number itself."""
    return np.array(
        [
            float(abs(x - y) / (abs(y) if scale is None else scale))
            for x, y, scale in zip(found, exact, scales, strict=True)
        ]
    )


def _ulp_effect(start: Start, moment: float, state: State, scales: list[Any]) -> Any:
    """Sum over the inputs of what one unit in the last place of each does."""
    total = np.zeros(13)
    for name, value in [*start.items(), ("time", moment)]:
        if value == 0 or (name == "theta" and value == np.pi):
            continue
        step = mp.mpf(value) + mp.mpf(float(np.spacing(value)))
        if name == "time":
            moved = Textbook(start).at(step)
        else:
            moved = Textbook(start | {name: step}).at(moment)
        total += _differences(_numbers(moved), _numbers(state), scales)
    return total
