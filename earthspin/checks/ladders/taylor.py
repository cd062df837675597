"""Integrate the figure axis by Taylor series with the library heyoka, if it is installed.

The equations are those of `tests.reference.momentum_and_figure`. The positions of Sun and
Moon are polynomials over pieces of four days, as in the kernel. Their coefficients are parameters,
so that the equations are compiled once.
"""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np

from tests.reference.sky import GM, chebyshev_pieces, positions
from tests.reference.momentum_and_figure import slopes
from tests.reference.stepping import FloatArray
from earthspin.constants import DAY

PIECE, DEGREE = 4.0, 12  # d
FIRST_EDGE = 0.5 - PIECE  # d: records end half a day from J2000.0
_OF_BODY = 3 * (DEGREE + 1)


def is_installed() -> bool:
    """Return True if heyoka can be imported."""
    return find_spec("heyoka") is not None


def figure_axis(
    momentum: FloatArray,
    start: FloatArray,
    days: FloatArray,
    *,
    h: float,
    spin_rate: float,
    tolerance: float,
) -> tuple[FloatArray, int]:
    """Integrate the figure axis with heyoka; return axes, shape (n, 3), and number of steps.

    Parameters
    ----------
    momentum, start : ndarray, shape (3,)
        Angular momentum in units of C Omega and figure axis at J2000.0.
    days : ndarray, shape (n,)
    h, spin_rate : float
        Dynamical flattening and spin rate (rad/s) of the body.
    tolerance : float
        Tolerance of a step.
    """
    integrator = _compiled(h, spin_rate, tolerance)
    integrator.time = 0.0
    integrator.state[:] = np.concatenate([momentum, start])
    pieces = _pieces(float(days[-1]))
    result, steps, asked = np.empty((days.size, 3)), 0, 0
    for number, coefficients in enumerate(pieces):
        edge = FIRST_EDGE + PIECE * number
        integrator.pars[:-1] = coefficients
        integrator.pars[-1] = (edge + PIECE / 2) * DAY
        while asked < days.size and days[asked] <= edge + PIECE:
            steps += integrator.propagate_until(days[asked] * DAY)[3]
            result[asked] = integrator.state[3:]
            asked += 1
        if asked < days.size:
            steps += integrator.propagate_until((edge + PIECE) * DAY)[3]
    return result, steps


def _pieces(end: float) -> FloatArray:
    """Polynomial coefficients of the positions of Sun and Moon in each time interval, m.

    The variable is the time, scaled to [-1, 1] in each interval.
    """

    def sun_and_moon(days: FloatArray) -> FloatArray:
        result = positions(days)
        return np.stack([result[name] for name in GM], axis=1)

    count = int((end - FIRST_EDGE) / PIECE) + 1
    series = chebyshev_pieces(sun_and_moon, FIRST_EDGE, PIECE, count, DEGREE + 1)
    to_powers = np.zeros((DEGREE + 1, DEGREE + 1))
    for n in range(DEGREE + 1):
        to_powers[: n + 1, n] = np.polynomial.chebyshev.cheb2poly(np.eye(DEGREE + 1)[n])[: n + 1]
    return np.ascontiguousarray(np.swapaxes(to_powers @ series, 1, 2)).reshape(count, -1)


@cache
def _compiled(h: float, spin_rate: float, tolerance: float) -> Any:
    """Compile the equations of figure axis and angular momentum into a heyoka integrator.

    Its parameters are the coefficients of the positions and the middle of the time interval.
    """
    import heyoka as hy

    state = *_, fx, fy, fz = hy.make_vars("lx", "ly", "lz", "fx", "fy", "fz")
    x = (hy.time - hy.par[2 * _OF_BODY]) / (PIECE / 2 * DAY)
    pull = [hy.expression(0.0)] * 3
    for body, gm in enumerate(GM.values()):
        r = [_polynomial(hy, x, body * _OF_BODY + k * (DEGREE + 1)) for k in range(3)]
        square = hy.sum([v * v for v in r])
        along = gm * (r[0] * fx + r[1] * fy + r[2] * fz) * square**-2.5
        pull = [total + along * v for total, v in zip(pull, r, strict=True)]
    return hy.taylor_adaptive(
        list(zip(state, slopes(state, pull, h, spin_rate), strict=True)),
        [0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        pars=[1.0] * (2 * _OF_BODY) + [0.0],
        tol=tolerance,
        compact_mode=True,
    )


def _polynomial(hy: Any, x: Any, first: int) -> Any:
    """Symbolic polynomial in x, whose coefficients are heyoka parameters from index `first` on."""
    value = hy.par[first + DEGREE]
    for n in range(DEGREE - 1, -1, -1):
        value = value * x + hy.par[first + n]
    return value
