"""The figure axis in long double: angular momentum l and tilt d = l - F by extrapolation.

    l' = 3 H/Omega (Q F) x F,     d' = l' + l x d/tau

(exact for an axisymmetric body), by the modified midpoint rule and Richardson's extrapolation
(Gragg 1965; Hairer, Norsett & Wanner 1993, sect. II.9), in steps that end where records
of the kernel do, whose Chebyshev series are summed in long double, too. Only increments are
extrapolated, so that rounding does not grow. It shares with the solvers of
`earthspin.motion` the equations and the kernel, and neither method nor code.

The start has no free wobble: its amplitude is found by demodulating d through a long taper
and taken from l, again and again until none is left.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from data_tools.rotation_reference import extrapolated, states
from earthspin.checks.ladders import of_pole
from tests.reference.sky import CENTRE, CODES, GM, SPIN, H, kernel
from earthspin.constants import DAY, J2000_JD
from earthspin.sky import iau

LongArray = NDArray[np.longdouble]
LONG = np.longdouble

STEP = 0.25  # d: records of the kernel end half a day from J2000.0
COLUMNS = 10  # of the extrapolation: order 20
TAPER_DAYS, TAPER_POWER = 60.0, 12


def figure_axis() -> tuple[LongArray, LongArray]:
    """Angular momentum at the start, and the figure axis at the times of `of_pole`."""
    axis = iau.true_pole(np.array([0.0]))[0].astype(LONG)
    momentum = slow_start(axis, STEP)
    path = integrate(momentum, axis, of_pole.DAYS, STEP)
    finer = integrate(momentum, axis, of_pole.DAYS, STEP / 2)[::2]
    places = np.rint(of_pole.days() / STEP).astype(int)
    figure, again = (ends[places, :3] - ends[places, 3:] for ends in (finer, path))
    change = np.sqrt(np.max(np.sum((figure - again) ** 2, axis=1)))
    print(f"pole: steps of half the length change the figure axis by {float(change):.1g} rad")
    return momentum, figure


def slow_start(axis: LongArray, step: float) -> LongArray:
    """Angular momentum that belongs to a figure axis without free motion."""
    tau = _tau()
    first = np.cross(axis, np.array([1, 0, 0], dtype=LONG))
    first /= np.sqrt(first @ first)
    second = np.cross(axis, first)
    momentum = axis.copy()
    for _ in range(8):
        path = integrate(momentum, axis, TAPER_DAYS, step)
        tilt = path[:, 3:]
        turning = tilt @ first + LONG(1) * 1j * (tilt @ second)
        time = step * DAY * np.arange(len(path)).astype(LONG)
        x = time / time[-1] - LONG(0.5)
        weight = np.cos(np.pi * x) ** TAPER_POWER
        free = np.sum(weight * turning * np.exp(-1j * time / tau)) / np.sum(weight)
        momentum = momentum - free.real * first - free.imag * second
        print(f"pole: free motion of {float(abs(free)):.1g} rad taken from the start")
        if abs(free) < 1e-19:
            break
    return np.asarray(momentum)


def integrate(momentum: LongArray, axis: LongArray, days: float, step: float) -> LongArray:
    """States l, d at the ends of the steps, the start included, shape (n + 1, 6)."""
    start = np.concatenate([momentum, momentum - axis])
    return np.stack(list(states(start, _increments(round(days / step), step))))


def _increments(count: int, step: float) -> Iterator[Callable[[LongArray], LongArray]]:
    """Yield what each step adds to a state; the tensors of many steps are computed at once."""
    block = round(16 / step)
    for first in range(0, count, block):
        size = min(block, count - first)
        tides = tides_of_steps(np.asarray(step * np.arange(first, first + size)), step)
        for number in range(size):
            rules = [[partial(_slope, tide) for tide in rows[number]] for rows in tides]
            yield partial(extrapolated, length=LONG(step) * DAY, rules=rules)


def _slope(tide: LongArray, state: LongArray) -> LongArray:
    (lx, ly, lz), (dx, dy, dz) = state[:3], state[3:]
    fx, fy, fz = state[:3] - state[3:]
    qx, qy, qz = tide @ (state[:3] - state[3:])
    torque = _torque_scale() * np.array([qy * fz - qz * fy, qz * fx - qx * fz, qx * fy - qy * fx])
    turn = np.array([ly * dz - lz * dy, lz * dx - lx * dz, lx * dy - ly * dx])
    return np.concatenate([torque, torque + turn / _tau()])


def _tau() -> Any:
    return (1 - LONG(H)) / LONG(SPIN)


def _torque_scale() -> Any:
    return 3 * LONG(H) / LONG(SPIN)


# --- the sky -----------------------------------------------------------------------------------


def tides_of_steps(begin: NDArray[np.float64], step: float) -> list[LongArray]:
    """Tidal tensors at the nodes of each rule in each step: by rule, (step, node, 3, 3)."""
    tides = []
    for column in range(1, COLUMNS + 1):
        parts = 2 * column
        inside = LONG(step) * np.arange(parts + 1).astype(LONG) / parts
        days = begin.astype(LONG)[:, np.newaxis] + inside
        # Records end where steps do: the last node still belongs to the step's own record.
        tides.append(tidal_tensor(days, begin[:, np.newaxis] + step / 2 + 0 * days))
    return tides


def tidal_tensor(days: LongArray, record_at: LongArray) -> LongArray:
    """Sum of GM r r^T / r^5 over Sun and Moon, shape (..., 3, 3)."""
    total = np.zeros((*days.shape, 3, 3), dtype=LONG)
    here = leg((3, CENTRE), days, record_at)
    to_sun = leg((0, CODES["sun"]), days, record_at) - leg((0, 3), days, record_at) - here
    to_moon = leg((3, CODES["moon"]), days, record_at) - here
    for name, r in (("sun", to_sun), ("moon", to_moon)):
        square = np.sum(r * r, axis=-1)
        scale = LONG(GM[name]) / (square * square * np.sqrt(square))
        total += scale[..., np.newaxis, np.newaxis] * r[..., :, np.newaxis] * r[..., np.newaxis, :]
    return total


def leg(segment: tuple[int, int], days: LongArray, record_at: LongArray) -> LongArray:
    """Position along a segment of the kernel, m, by Clenshaw's rule, shape (..., 3).

    Parameters
    ----------
    segment : tuple of int
        Centre and target.
    days : ndarray
        From J2000.0 TDB.
    record_at : ndarray
        Days inside the record that is to be taken.
    """
    start, length, series = kernel()._segments[segment].load_array()
    start = start - J2000_JD
    number = np.floor((record_at.astype(float) - start) / length).astype(int)
    x = 2 * (days - start - LONG(length) * number) / LONG(length) - 1
    coefficients = series[:, number, :].astype(LONG)  # highest degree last or first
    b1 = b2 = np.zeros((3, *days.shape), dtype=LONG)
    for k in range(coefficients.shape[-1] - 1, 0, -1):
        b1, b2 = 2 * x * b1 - b2 + coefficients[..., k], b1
    return np.moveaxis((x * b1 - b2 + coefficients[..., 0]) * 1000, 0, -1)
