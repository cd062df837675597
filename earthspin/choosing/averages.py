"""Windows of an average over orbits: how many turns, and how far apart the samples."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.choosing.choice import Choice, models
from earthspin.constants import DAY
from earthspin.torque.average import precessing_of_tensor

FloatArray = NDArray[np.float64]

#: Orbits whose normals are closer than this are the one that was measured.
SAME_ORBIT = 1e-6


@dataclass(frozen=True)
class Averaging:
    """A window of an average, with what it may miss.

    Attributes
    ----------
    cycles : float
        Its length in turns of the slowest cycle.
    step : float
        Between two samples, s.
    precessing_errors, torque_errors : mapping of str to float
        By perturber: of its precessing torque, and of its torque along any axis, both per
        C - A, s-2.
    """

    cycles: float
    step: float
    precessing_errors: Mapping[str, float]
    torque_errors: Mapping[str, float]


@dataclass(frozen=True)
class Turned:
    """What decides how far an error of the mean tensor is one of the rate of precession.

    Attributes
    ----------
    code : int
        NAIF, of the body.
    obliquity : float
        rad.
    normal : ndarray, shape (3,)
        Of the orbit, ICRF.
    moving : bool
        Whether its equinox is the moving one of date.
    pulls : mapping of str to Pull
        What pulls, by name.
    cycle : float
        The slowest, s.
    """

    code: int
    obliquity: float
    normal: FloatArray
    moving: bool
    pulls: Mapping[str, Pull]
    cycle: float


class Pull(NamedTuple):
    """A perturber: NAIF code, GM (m3 s-2), and its slow swing, relative."""

    code: int
    gm: float
    slow_swing: float


def average_choices(body: Turned, cycles: float) -> list[Choice[Averaging]]:
    """Windows of an average with the relative error of the rate.

    Parameters
    ----------
    body : Turned
    cycles : float
        As many as there is room for.

    Returns
    -------
    list of Choice of Averaging
        Empty if the sky has not been measured, or the rate vanishes.
    """
    table = models()["average"]
    rows = table["tensor"].get(str(body.code), {}).get(f"{body.cycle / DAY:.2f}", {})
    if not all(str(pull.code) in rows for pull in body.pulls.values()):
        return []
    if math.sin(body.obliquity) == 0 or body.moving != (str(body.code) in table["moving"]):
        return []
    if np.linalg.norm(body.normal - table["normal"][str(body.code)]) > SAME_ORBIT:
        return []
    precessing = {
        name: pull.gm * precessing_of_tensor(rows[str(pull.code)]["mean"], 0.0, body.obliquity)
        for name, pull in body.pulls.items()
    }
    swing = sum(pull.slow_swing * precessing[name] for name, pull in body.pulls.items())
    total = sum(precessing.values())
    if total == 0:
        return []
    in_plane, out_of_plane = (
        {
            name: pull.gm * 10.0 ** np.asarray(rows[str(pull.code)][plane])
            for name, pull in body.pulls.items()
        }
        for plane in ("in_plane", "out_of_plane")
    )
    choices = []
    for i, turns in enumerate(turns for turns in table["cycles"] if turns <= cycles):
        for j, days in enumerate(table["steps"]):
            off = {name: (in_plane[name][i, j], out_of_plane[name][i, j]) for name in body.pulls}
            precessing = {
                name: precessing_of_tensor(*pair, body.obliquity) for name, pair in off.items()
            }
            choices.append(
                Choice(
                    words=f"sin4 taper over {turns} cycles, a sample each {days} d",
                    settings=Averaging(
                        cycles=turns,
                        step=days * DAY,
                        precessing_errors=precessing,
                        torque_errors={name: 3 * sum(pair) for name, pair in off.items()},
                    ),
                    error=(sum(precessing.values()) + swing) / total,
                    evaluations=2 * math.floor(turns * body.cycle / DAY / 2 / days) + 1,
                )
            )
    return choices
