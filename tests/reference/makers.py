"""Compute the stored references again: closed forms with 80 digits, integrations in long double."""

from collections.abc import Callable, Mapping
from functools import partial
from itertools import repeat
from typing import Any

import mpmath as mp
import numpy as np

from earthspin.interior.layers import PREM
from earthspin.sky import iau_models
from tests.benchmarks.accuracy import (
    compliances,
    elements,
    free_rotor,
    long_term,
    mean_orbit,
    pole,
    rotation,
    spheroid,
    top,
)
from tests.interior.another_integration import START, Slope, other_answers
from tests.mass import spheroid_reference
from tests.reference import figure_axis
from tests.reference.extrapolation import LONG, LongArray, increment, states
from tests.reference.sky import BODY
from tests.reference.spin_axis import spin_axis
from tests.rotor import textbook as rotor_textbook
from tests.sky import textbook as sky_textbook
from tests.top import textbook as top_textbook

#: Inputs on which values depend, and the values.
Made = tuple[Mapping[str, Any], dict[str, Any]]


def make_free_rotor() -> Made:
    """Angular velocity and attitude of the triaxial rotor."""
    with mp.workdps(rotor_textbook.DIGITS):
        book = rotor_textbook.Textbook(free_rotor.MOMENTS, free_rotor.OMEGA)
        times = _times(float(book.period))
        motion = [book.at(time) for time in times]
        return free_rotor.INPUTS, {
            "times": times,
            "omega": [state.omega for state in motion],
            "attitude": [_quaternion(state.attitude) for state in motion],
        }


def make_top() -> Made:
    """Angular velocity and attitude of the heavy top."""
    with mp.workdps(top_textbook.DIGITS):
        book, spin = top_textbook.Textbook(top.TOP), mp.mpf(top.TOP["spin"])
        times = _times(float(book.period))
        motion = [book.at(time) for time in times]
        return top.TOP, {
            "times": times,
            "omega": [[s.transverse.real, s.transverse.imag, spin] for s in motion],
            "attitude": [_quaternion(state.attitude) for state in motion],
        }


def make_spheroid() -> Made:
    """Attraction and torque of the spheroid for GM = 1, a unit mass, in units of the radius."""
    with mp.workdps(spheroid_reference.DIGITS):
        attraction, torque = [], []
        for point in spheroid.points().tolist():
            _, a1, a3, across = spheroid_reference.textbook((1.0, spheroid.FLATTENING, *point))
            x, y, z = map(mp.mpf, point)
            attraction.append([-mp.mpf(3) / 2 * a * v for a, v in ((a1, x), (a1, y), (a3, z))])
            torque.append([across * y, -across * x, mp.mpf(0)])
        return spheroid.inputs(), {"attraction": attraction, "torque": torque}


def make_elements() -> Made:
    """Positions on precessing ellipses."""
    days = elements.days().tolist()
    with mp.workdps(sky_textbook.DIGITS):
        places = [[sky_textbook.place(orbit, day) for day in days] for orbit in elements.ORBITS]
        return elements.INPUTS, {"places": places}


def make_mean_orbit() -> Made:
    """Mean precessing torque of an orbit whose node precesses."""
    with mp.workdps(sky_textbook.DIGITS):
        mean = sky_textbook.mean_precessing_torque(elements.ORBIT, mean_orbit.GM, mean_orbit.TILT)
        return mean_orbit.INPUTS, {"mean": mean}


def make_pole() -> Made:
    """Figure axis under Sun and Moon."""
    momentum, figure = figure_axis.axis_in_time()
    return pole.INPUTS, {
        "days": figure_axis.days(),
        "start_axis": iau_models.true_pole(np.array([0.0]))[0],
        "start_momentum": momentum,
        "figure": figure,
    }


def make_long_term(step: float = 2 * long_term.KYR) -> Made:
    """Spin axis over a million years."""
    start = np.asarray(BODY.needed("pole").mean(np.zeros(1))[0])
    path = spin_axis(long_term.STRENGTH, long_term.orbit(), start, -long_term.SPAN, step)
    return long_term.inputs(), {"axes": path[:, :: -(path.shape[1] // (long_term.TIMES - 1))]}


def make_rotation(steps: int = 64) -> Made:
    """Angular velocity and attitude of a tumbling moon, in long double by extrapolation.

    r'' = -r/r3,    l' = R n,    q' = (1/2) q omega,    n = 3/r5 r x I r along the body's axes

    The orbit is integrated too, so that no Kepler equation is solved. The number of steps is that
    in each unit of time.
    """
    h, triaxiality, e = LONG(rotation.H), LONG(rotation.TRIAXIALITY), LONG(rotation.ECCENTRICITY)
    moments = a, b, c = np.array([1 - h - triaxiality / 2, 1 - h + triaxiality / 2, LONG(1)])

    def spin_and_rotation(momentum: LongArray, q: LongArray) -> tuple[LongArray, LongArray]:
        w, x, y, z = q
        matrix = np.array(
            [
                [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
            ]
        )
        return momentum @ matrix / moments, matrix

    def slope(state: LongArray) -> LongArray:
        r, velocity, momentum, q = state[:3], state[3:6], state[6:9], state[9:]
        square = r @ r
        (p, s, t), matrix = spin_and_rotation(momentum, q)
        x, y, z = r @ matrix
        cube = square * np.sqrt(square)
        torque = 3 / (square * cube) * np.array([(c - b) * y * z, (a - c) * x * z, (b - a) * x * y])
        w, i, j, k = q
        turning = [-i * p - j * s - k * t, w * p + j * t - k * s, w * s + k * p - i * t]
        turning.append(w * t + i * s - j * p)
        return np.concatenate([velocity, -r / cube, matrix @ torque, np.array(turning) / 2])

    place = [1 - e, 0, 0, 0, np.sqrt((1 + e) / (1 - e)), 0]
    omega = np.array(rotation.OMEGA, dtype=LONG)
    start = np.array([*place, *(moments * omega), 1, 0, 0, 0], dtype=LONG)
    step = partial(increment, length=LONG(1) / steps, slope=slope)
    path = np.stack(list(states(start, repeat(step, round(rotation.SPAN * steps)))))
    state = path[np.rint(rotation.times() * steps).astype(int)]
    q = state[:, 9:] / np.sqrt(np.sum(state[:, 9:] ** 2, axis=1))[:, np.newaxis]
    omega = [spin_and_rotation(row[6:9], turn)[0] for row, turn in zip(state, q, strict=True)]
    return rotation.INPUTS, {"omega": omega, "attitude": q}


def make_compliances(longest: float = 0.05) -> Made:
    """Compliances of PREM, in long double by extrapolation in the logarithm of the radius.

    It starts at a tenth of the radius at which `earthspin.interior` starts, and shares neither
    equations nor method nor code with it. `longest` is the longest step of the logarithm.
    """

    def carry(slope: Slope, y: LongArray, start: Any, stop: Any) -> LongArray:
        length = np.log(stop / start)
        count = int(np.ceil(float(length) / longest))
        state = np.concatenate([y, np.full((1, y.shape[1]), np.log(start), dtype=LONG)])

        def log_slope(now: LongArray) -> LongArray:
            r = np.exp(now[-1, 0])
            return np.concatenate([r * slope(r, now[:-1]), np.ones_like(now[-1:])])

        step = partial(increment, length=length / count, slope=log_slope)
        *_, end = states(state, repeat(step, count))
        return end[:-1]

    return compliances.INPUTS, {"answers": other_answers(PREM, carry, LONG, START / 10)}


MAKERS: dict[str, Callable[[], Made]] = {
    "free-rotor": make_free_rotor,
    "top": make_top,
    "spheroid": make_spheroid,
    "elements": make_elements,
    "mean-orbit": make_mean_orbit,
    "pole": make_pole,
    "long-term": make_long_term,
    "rotation": make_rotation,
    "compliances": make_compliances,
}


def _times(period: float) -> list[float]:
    """Twenty times within five periods, and twenty more up to a hundred periods."""
    count = np.concatenate([np.linspace(0, 5, 21)[1:], np.linspace(5, 100, 21)[1:]])
    return [float(time) for time in count * period]


def _quaternion(matrix: Any) -> list[Any]:
    """Unit quaternion w, x, y, z of a rotation matrix, from the largest row of 4 q q^T."""
    (a, b, c), (d, e, f), (g, h, i) = matrix.tolist()
    rows = [
        [1 + a + e + i, h - f, c - g, d - b],
        [h - f, 1 + a - e - i, b + d, c + g],
        [c - g, b + d, 1 - a + e - i, f + h],
        [d - b, c + g, f + h, 1 - a - e + i],
    ]
    place = max(range(4), key=lambda n: rows[n][n])
    return [value / (2 * mp.sqrt(rows[place][place])) for value in rows[place]]


def pairs(values: Any) -> dict[str, Any]:
    """Numbers, or nested lists of numbers, as sums of two floats."""
    if isinstance(values, (list, tuple, np.ndarray)):
        parts = [pairs(value) for value in values]
        return {key: [part[key] for part in parts] for key in ("hi", "lo")}
    return {"hi": float(values), "lo": float(values - float(values))}
