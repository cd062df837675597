"""Figure axis under Sun and Moon in long double: angular momentum l and tilt d = l - F.

    l' = 3 H/Omega (Q F) x F,     d' = l' + l x d/tau

(exact for an axisymmetric body), by extrapolation in steps that end where records of the kernel
do. The Chebyshev series of the records are summed in long double too. It shares with the solvers
of `earthspin.motion` the equations and the kernel, and neither method nor code.

The start has no free wobble: its amplitude is determined by demodulation of d with a long taper,
and subtracted from l until none is left.
"""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from earthspin.constants import DAY, J2000_JD
from earthspin.numerics.arrays import FloatArray
from earthspin.sky import iau_models
from tests.benchmarks.accuracy.pole import DAYS
from tests.reference.extrapolation import COLUMNS, LONG, LongArray, extrapolated, states
from tests.reference.sky import CENTRE, CODES, GM, SPIN, H, kernel

STEP = 0.25  # d: records of the kernel end half a day from J2000.0
TAPER_DAYS, TAPER_POWER = 60.0, 12
TAU, TORQUE_SCALE = (1 - LONG(H)) / LONG(SPIN), 3 * LONG(H) / LONG(SPIN)


def days() -> FloatArray:
    """Times of the reference, d from J2000.0, early and later ones, multiples of 1/4 d."""
    generator = np.random.default_rng(7)
    early = generator.choice(np.arange(4, 4 * 64.0), 60, replace=False)
    late = generator.choice(np.arange(4 * 64.0, 4 * DAYS), 180, replace=False)
    return np.concatenate([np.sort(early), np.sort(late)]) / 4


def axis_in_time() -> tuple[LongArray, LongArray]:
    """Angular momentum at the start, and the figure axis at the times of `days`."""
    axis = iau_models.true_pole(np.array([0.0]))[0].astype(LONG)
    momentum = slow_start(axis, STEP)
    path = integrate(momentum, axis, DAYS, STEP / 2)[::2]
    return momentum, (path[:, :3] - path[:, 3:])[np.rint(days() / STEP).astype(int)]


def slow_start(axis: LongArray, step: float) -> LongArray:
    """Angular momentum that belongs to a figure axis without free motion."""
    first = np.cross(axis, np.array([1, 0, 0], dtype=LONG))
    first /= np.sqrt(first @ first)
    second = np.cross(axis, first)
    momentum = axis.copy()
    for _ in range(8):
        path = integrate(momentum, axis, TAPER_DAYS, step)
        turning = path[:, 3:] @ first + LONG(1) * 1j * (path[:, 3:] @ second)
        time = step * DAY * np.arange(len(path)).astype(LONG)
        weight = np.cos(np.pi * (time / time[-1] - LONG(0.5))) ** TAPER_POWER
        free = np.sum(weight * turning * np.exp(-1j * time / TAU)) / np.sum(weight)
        momentum = momentum - free.real * first - free.imag * second
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
        begin = step * np.arange(first, min(first + block, count))
        rules = [_tides(begin, step, 2 * column) for column in range(1, COLUMNS + 1)]
        for number in range(begin.size):
            slopes = [[partial(_slope, tide) for tide in rule[number]] for rule in rules]
            yield partial(extrapolated, length=LONG(step) * DAY, rules=slopes)


def _slope(tide: LongArray, state: LongArray) -> LongArray:
    (lx, ly, lz), (dx, dy, dz) = state[:3], state[3:]
    fx, fy, fz = state[:3] - state[3:]
    qx, qy, qz = tide @ (state[:3] - state[3:])
    torque = TORQUE_SCALE * np.array([qy * fz - qz * fy, qz * fx - qx * fz, qx * fy - qy * fx])
    turn = np.array([ly * dz - lz * dy, lz * dx - lx * dz, lx * dy - ly * dx])
    return np.concatenate([torque, torque + turn / TAU])


def _tides(begin: FloatArray, step: float, parts: int) -> LongArray:
    """Sum of GM r r^T / r^5 over Sun and Moon at the nodes of steps, shape (n, parts + 1, 3, 3)."""
    days = begin.astype(LONG)[:, np.newaxis] + LONG(step) * np.arange(parts + 1) / parts
    # Records end where steps do: the last node still belongs to the record of its step.
    records = begin[:, np.newaxis] + step / 2 + np.zeros(parts + 1)
    here = _leg((3, CENTRE), days, records)
    sun = _leg((0, CODES["sun"]), days, records) - _leg((0, 3), days, records) - here
    total = np.zeros((*days.shape, 3, 3), dtype=LONG)
    for name, r in (("sun", sun), ("moon", _leg((3, CODES["moon"]), days, records) - here)):
        square = np.sum(r * r, axis=-1)
        scale = LONG(GM[name]) / (square * square * np.sqrt(square))
        total += scale[..., np.newaxis, np.newaxis] * r[..., :, np.newaxis] * r[..., np.newaxis, :]
    return total


def _leg(segment: tuple[int, int], days: LongArray, records: FloatArray) -> LongArray:
    """Position along a segment of the kernel, m, by Clenshaw's rule, shape (..., 3).

    Parameters
    ----------
    segment : tuple of int
        Centre and target.
    days, records : ndarray
        Times, and times inside the records to be used, d from J2000.0 TDB.
    """
    start, length, series = kernel()._segments[segment[1]][0].load_array()
    start = start - J2000_JD
    number = np.floor((records - start) / length).astype(int)
    x = 2 * (days - start - LONG(length) * number) / LONG(length) - 1
    coefficients = series[:, number, :].astype(LONG)
    b1 = b2 = np.zeros((3, *days.shape), dtype=LONG)
    for k in range(coefficients.shape[-1] - 1, 0, -1):
        b1, b2 = 2 * x * b1 - b2 + coefficients[..., k], b1
    return np.moveaxis((x * b1 - b2 + coefficients[..., 0]) * 1000, 0, -1)
