"""Make the references of `earthspin.checks` again: closed forms at 80 digits, kept to 32.

Pole, rotation and compliances are made in long double, by `data_tools.pole_reference`,
`rotation_reference` and `compliances_reference`; the long term is made in double precision, by
`long_term_reference`.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from earthspin.checks import stored
from earthspin.checks.ladders import (
    of_compliances,
    of_elements,
    of_free_rotor,
    of_long_term,
    of_mean_orbit,
    of_pole,
    of_rotation,
    of_spheroid,
    of_top,
    rotating_bodies,
)
from tests.reference.sky import BODY
from earthspin.sky import iau

Numbers = Sequence[Any]
Made = tuple[Mapping[str, Any], dict[str, Any]]


def free_rotor() -> Made:
    """Angular velocity and attitude of the triaxial rotor."""
    import mpmath as mp

    from tests.rotor.textbook import DIGITS, Textbook

    with mp.workdps(DIGITS):
        book = Textbook(of_free_rotor.MOMENTS, of_free_rotor.OMEGA)
        times = _times(float(book.period))
        states = [book.at(time) for time in times]
        return of_free_rotor.INPUTS, {
            "times": _pairs(times),
            "omega": _pairs([state.omega for state in states]),
            "attitude": _pairs([_quaternion(state.attitude) for state in states]),
        }


def top() -> Made:
    """Angular velocity and attitude of the heavy top."""
    import mpmath as mp

    from tests.top.textbook import DIGITS, Textbook

    with mp.workdps(DIGITS):
        book = Textbook(of_top.TOP)
        times = _times(float(book.period))
        states = [book.at(time) for time in times]
        spin = mp.mpf(of_top.TOP["spin"])
        return of_top.TOP, {
            "times": _pairs(times),
            "omega": _pairs([[s.transverse.real, s.transverse.imag, spin] for s in states]),
            "attitude": _pairs([_quaternion(state.attitude) for state in states]),
        }


def spheroid() -> Made:
    """Attraction and torque of the spheroid for GM = 1, a unit mass, in units of the radius."""
    import mpmath as mp

    from tests.mass.spheroid_reference import DIGITS, textbook

    flattening, points = of_spheroid.FLATTENING, of_spheroid.points()
    with mp.workdps(DIGITS):
        attraction, torque = [], []
        for point in points.tolist():
            _, a1, a3, across = textbook((1.0, flattening, *point))
            x, y, z = map(mp.mpf, point)
            attraction.append([-mp.mpf(3) / 2 * a * v for a, v in ((a1, x), (a1, y), (a3, z))])
            torque.append([across * y, -across * x, mp.mpf(0)])
        return {"flattening": flattening, "points": points.tolist()}, {
            "attraction": _pairs(attraction),
            "torque": _pairs(torque),
        }


def elements() -> Made:
    """Places on ellipses that turn."""
    import mpmath as mp

    from tests.sky.textbook import DIGITS, place

    days = of_elements.days().tolist()
    with mp.workdps(DIGITS):
        return of_elements.INPUTS, {
            "places": _pairs([[place(orbit, day) for day in days] for orbit in of_elements.ORBITS])
        }


def mean_orbit() -> Made:
    """Mean precessing torque of an orbit whose node turns."""
    import mpmath as mp

    from tests.sky.textbook import DIGITS, mean_precessing_torque

    with mp.workdps(DIGITS):
        mean = mean_precessing_torque(of_elements.ORBIT, of_mean_orbit.GM, of_mean_orbit.TILT)
        return of_mean_orbit.INPUTS, {"mean": _pairs(mean)}


def pole() -> Made:
    """Figure axis under Sun and Moon."""
    from data_tools.pole_reference import figure_axis

    momentum, figure = figure_axis()
    start = iau.true_pole(np.array([0.0]))[0]
    return of_pole.INPUTS, {
        "days": _pairs(of_pole.days().tolist()),
        "start_axis": _pairs(start.tolist()),
        "start_momentum": _pairs(list(momentum)),
        "figure": _pairs([list(row) for row in figure]),
    }


def long_term() -> Made:
    """Spin axis over a million years, and at more times over the last part of it."""
    from data_tools.long_term_reference import reference

    start = np.asarray(BODY.needed("pole").mean(np.zeros(1))[0])
    axes, quick = (
        reference(start, of_long_term.times(span)).tolist()
        for span in (of_long_term.SPAN, of_long_term.FEW)
    )
    return of_long_term.inputs(), {"axes": _pairs(axes), "quick": _pairs(quick)}


def tumbling() -> Made:
    """Angular velocity and attitude of a tumbling moon."""
    from data_tools.rotation_reference import tumbling as followed

    omega, attitude = followed()
    return of_rotation.INPUTS, {
        "omega": _pairs([list(row) for row in omega]),
        "attitude": _pairs([list(row) for row in attitude]),
    }


def compliances() -> Made:
    """Answers of the parts of PREM to potentials in one another."""
    from data_tools.compliances_reference import answers

    return of_compliances.INPUTS, {"answers": _pairs([list(row) for row in answers()])}


MAKERS: dict[str, Callable[[], Made]] = {
    "free-rotor": free_rotor,
    "top": top,
    "spheroid": spheroid,
    "elements": elements,
    "mean-orbit": mean_orbit,
    "pole": pole,
    "long-term": long_term,
    "rotation": tumbling,
    "compliances": compliances,
}


def _times(period: float) -> list[float]:
    """Half of the times within a few periods, the other half up to the last."""
    half = rotating_bodies.TIMES // 2
    early = np.linspace(0, rotating_bodies.FEW_PERIODS, half + 1)[1:]
    late = np.linspace(rotating_bodies.FEW_PERIODS, rotating_bodies.PERIODS, half + 1)[1:]
    return [float(time) for time in np.concatenate([early, late]) * period]


def _quaternion(matrix: Any) -> list[Any]:
    """Unit quaternion w, x, y, z of a rotation matrix, from its largest element."""
    import mpmath as mp

    trace = [matrix[i, i] for i in range(3)]
    signs = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    squares = [1 + sum(s * d for s, d in zip(sign, trace, strict=True)) for sign in signs]
    place = max(range(4), key=lambda n: squares[n])
    root = mp.sqrt(squares[place])
    cross = [matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]]
    if place == 0:
        return [root / 2, *(c / (2 * root) for c in cross)]
    axis = place - 1
    found = [cross[axis] / (2 * root)]
    found += [
        root / 2 if k == axis else (matrix[axis, k] + matrix[k, axis]) / (2 * root)
        for k in range(3)
    ]
    return found


def _pairs(values: Any) -> dict[str, Any]:
    """Numbers, or nested lists of them, as sums of two floats."""
    if isinstance(values, (list, tuple)):
        pairs = [_pairs(value) for value in values]
        return {key: [pair[key] for pair in pairs] for key in ("hi", "lo")}
    return {"hi": float(values), "lo": float(values - float(values))}


def main(arguments: argparse.Namespace) -> int:
    """Write the files."""
    for name in [arguments.only] if arguments.only else MAKERS:
        inputs, values = MAKERS[name]()
        text = json.dumps({"inputs": inputs, "values": values}, indent=None)
        path = stored.FOLDER / f"{name}.json"
        path.write_text(text.replace('"values"', '\n"values"') + "\n", encoding="utf-8")
        print(f"wrote {path.name}, {len(text) / 1024:.0f} kB")
    return 0
