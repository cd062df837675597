"""Possible settings of averages over orbits: length of the time window, and sampling step."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from earthspin.bodies import Body
from earthspin.choosing.choice import Choice, models
from earthspin.constants import DAY
from earthspin.sky.equator import angle
from earthspin.torque.average import best_window, precessing_of_tensor

#: Largest difference of unit orbit normals for which measured errors apply.
SAME_ORBIT = 1e-6


@dataclass(frozen=True)
class Averaging:
    """Window length and sampling step of an average over orbits, with their measured errors.

    Attributes
    ----------
    cycles : float
        Length of the window in slowest cycles.
    step : float
        Time between samples, s.
    precessing_errors, torque_errors : mapping of str to float
        Errors of the precessing torque and of any component of the torque per C - A, s-2, by
        perturber.
    """

    cycles: float
    step: float
    precessing_errors: Mapping[str, float]
    torque_errors: Mapping[str, float]


def average_choices(
    body: Body, perturbers: tuple[Body, ...], first: float, last: float
) -> list[Choice[Averaging]]:
    """Possible windows and steps of an average over orbits, with relative errors of the rate.

    Parameters
    ----------
    body : Body
    perturbers : tuple of Body
    first, last : float
        First and last day of the average, days from J2000.0 TDB.

    Returns
    -------
    list of Choice of Averaging
        Empty if the errors for these bodies were not measured, or the rate is zero.
    """
    if not all(member.naif for member in (body, *perturbers)):
        return []
    table, code = models()["average"], str(body.naif[0])
    cycle, pole = max(p.cycle for p in perturbers), body.needed("pole")
    normal = pole.orbit_normal(body.orbit_pole)
    obliquity = angle(pole.true(0.0), normal)
    all_rows = table["tensor"].get(code, {}).get(f"{cycle / DAY:.2f}", {})
    if not all(str(p.naif[0]) in all_rows for p in perturbers):
        return []
    if math.sin(obliquity) == 0 or pole.of_the_iau != (code in table["moving"]):
        return []
    if np.linalg.norm(normal - table["normal"][code]) > SAME_ORBIT:
        return []
    rows = {p.name: all_rows[str(p.naif[0])] for p in perturbers}
    gm = {p.name: float(p.gm) for p in perturbers}
    mean = {
        name: gm[name] * precessing_of_tensor(row["mean"], 0.0, obliquity)
        for name, row in rows.items()
    }
    swing, total = sum(p.slow_swing * mean[p.name] for p in perturbers), sum(mean.values())
    if total == 0:
        return []
    in_plane, out_of_plane = (
        {name: gm[name] * 10.0 ** np.asarray(row[plane]) for name, row in rows.items()}
        for plane in ("in_plane", "out_of_plane")
    )
    cycles = best_window(first * DAY, last * DAY, cycle).cycles
    choices = []
    for i, turns in enumerate(turns for turns in table["cycles"] if turns <= cycles):
        for j, days in enumerate(table["steps"]):
            errors = {name: (in_plane[name][i, j], out_of_plane[name][i, j]) for name in rows}
            precessing = {
                name: precessing_of_tensor(*pair, obliquity) for name, pair in errors.items()
            }
            choices.append(
                Choice(
                    words=f"sin4 taper over {turns} cycles, a sample each {days} d",
                    settings=Averaging(
                        cycles=turns,
                        step=days * DAY,
                        precessing_errors=precessing,
                        torque_errors={name: 3 * sum(pair) for name, pair in errors.items()},
                    ),
                    error=(sum(precessing.values()) + swing) / total,
                    evaluations=2 * math.floor(turns * cycle / DAY / 2 / days) + 1,
                )
            )
    return choices
