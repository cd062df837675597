"""Accuracy on request: the cheapest settings whose measured error is small enough.

What each setting costs in error was measured once on the sky alone (`python -m data_tools
error-models` writes `error_models.json`); what it does to a body follows from `motion.sampling` and
`torque.average`. Where the sky is not in the table (another perturber, another body), nothing is
chosen and the finest settings stand.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.motion.axes import window_count
from earthspin.motion.forces import Figure
from earthspin.motion.sampling import turn_by_mean, turn_by_sampling
from earthspin.torque.average import push_of_tensor

FloatArray = NDArray[np.float64]

#: What was measured.
DATA = Path(__file__).with_name("error_models.json")
#: Days from J2000.0 within which the short series of nutation was measured, and what another phase
#: of the nodes may add to an error.
NUTATION_MEASURED, NUTATION_PHASE = 36525.0, 1.1
#: Orbits whose normals are closer than this are the one that was measured.
SAME_ORBIT = 1e-6


@dataclass(frozen=True)
class Choice:
    """Settings that meet what was asked, and what they cost.

    Attributes
    ----------
    words : str
        For people.
    settings : mapping
        For the function that computes, by argument; nothing where it is to be left out.
    error : float
        Bound on the error of the method, SI: rad, or relative.
    evaluations : int
        How often the sky (or a term of the nutation) will be evaluated.
    """

    words: str
    settings: Mapping[str, Any]
    error: float
    evaluations: int


@dataclass(frozen=True)
class AverageChoice(Choice):
    """A window of an average, with what it may miss.

    Attributes
    ----------
    push_errors, torque_errors : mapping of str to float
        By perturber: of its push, and of its torque along any axis, both per
        C - A, s-2.
    """

    push_errors: Mapping[str, float]
    torque_errors: Mapping[str, float]


AnyChoice = TypeVar("AnyChoice", bound=Choice)


@lru_cache
def models() -> dict[str, Any]:
    """Read what was measured."""
    found: dict[str, Any] = json.loads(DATA.read_text(encoding="utf-8"))
    return found


def cheapest(choices: Iterable[AnyChoice], allowed: float) -> AnyChoice | None:
    """Choose the cheapest within the error allowed; of equally cheap ones the most accurate."""
    good = [choice for choice in choices if choice.error <= allowed]
    return min(good, key=lambda choice: (choice.evaluations, choice.error), default=None)


# --- the pole: windows ---------------------------------------------------------------------------


def window_choices(
    code: int,
    figure: Figure,
    gm: Mapping[int, float],
    span: tuple[float, float],
    *,
    geodesic: float = 0.0,
) -> list[Choice]:
    """Windows of the pole with the error of each.

    Parameters
    ----------
    code : int
        NAIF, of the body.
    figure : Figure
    gm : mapping of int to float
        What pulls, by NAIF code, m3 s-2.
    span : tuple of float
        First and last time, s from the epoch.
    geodesic : float
        GM of the mass whose geodesic precession turns the frame, m3 s-2; 0 if none does.

    Returns
    -------
    list of Choice
        Empty if the sky of this body has not been measured, or if its higher zonal coefficients,
        which were not, exceed J2.
    """
    table = models()["pole"]
    rows = table["tensor"].get(str(code), {})
    if not all(str(puller) in rows for puller in gm):
        return []
    if any(abs(j) * figure.inverse_polar_moment > abs(figure.h) for j in figure.zonal.values()):
        return []
    reach = max(map(abs, span))

    def of_all(name: str) -> FloatArray:
        each = [
            mass * _in_reach(rows[str(puller)][name], table["reach"], reach)
            for puller, mass in gm.items()
        ]
        return np.asarray(np.sum(each, axis=0))

    mean = sum(mass * 10.0 ** rows[str(puller)]["mean"] for puller, mass in gm.items())
    integral, value, derivative = map(of_all, ("integral", "value", "derivative"))
    turned = turn_by_mean(figure, mean, reach)
    error = turn_by_sampling(figure, integral, value, derivative, turned)
    if geodesic:
        error = error + geodesic * _in_reach(table["geodesic"][str(code)], table["reach"], reach)
    return [
        Choice(
            words=f"Gauss windows of {days} d with {nodes} nodes",
            settings={"window": days * DAY, "order": nodes},
            error=float(off),
            evaluations=nodes * window_count(0.0, span, days * DAY),
        )
        for (days, nodes), off in zip(table["settings"], error, strict=True)
    ]


def _in_reach(rows: Any, reaches: list[float], reach: float) -> FloatArray:
    """Errors of all settings within a reach in s; beyond the last one they grow with it."""
    found = 10.0 ** np.asarray(rows)
    if found.ndim == 1:
        return found
    years = reach / JULIAN_YEAR
    place = min(int(np.searchsorted(reaches, years)), len(reaches) - 1)
    return np.asarray(found[:, place] * max(1.0, years / reaches[-1]))


# --- averages over orbits: cycles and step -------------------------------------------------------


@dataclass(frozen=True)
class Pushed:
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


def average_choices(body: Pushed, cycles: float) -> list[AverageChoice]:
    """Windows of an average with the relative error of the rate.

    Parameters
    ----------
    body : Pushed
    cycles : float
        As many as there is room for.

    Returns
    -------
    list of AverageChoice
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
    push = {
        name: pull.gm * push_of_tensor(rows[str(pull.code)]["mean"], 0.0, body.obliquity)
        for name, pull in body.pulls.items()
    }
    swing = sum(pull.slow_swing * push[name] for name, pull in body.pulls.items())
    total = sum(push.values())
    if total == 0:
        return []
    in_plane, out_of_plane = (
        {
            name: pull.gm * 10.0 ** np.asarray(rows[str(pull.code)][plane])
            for name, pull in body.pulls.items()
        }
        for plane in ("in_plane", "out_of_plane")
    )
    found = []
    for i, turns in enumerate(turns for turns in table["cycles"] if turns <= cycles):
        for j, days in enumerate(table["steps"]):
            off = {name: (in_plane[name][i, j], out_of_plane[name][i, j]) for name in body.pulls}
            pushes = {name: push_of_tensor(*pair, body.obliquity) for name, pair in off.items()}
            found.append(
                AverageChoice(
                    words=f"sin4 taper over {turns} cycles, a sample each {days} d",
                    settings={"cycles": turns, "step": days * DAY},
                    error=(sum(pushes.values()) + swing) / total,
                    evaluations=2 * math.floor(turns * body.cycle / DAY / 2 / days) + 1,
                    push_errors=pushes,
                    torque_errors={name: 3 * sum(pair) for name, pair in off.items()},
                )
            )
    return found


# --- the true equator: nutation ------------------------------------------------------------------


def nutation_choices(first: float, last: float, size: int) -> list[Choice]:
    """Ways to the true equator with their errors.

    Parameters
    ----------
    first, last : float
        Days from J2000.0 TDB.
    size : int
        How many epochs lie between them.

    Returns
    -------
    list of Choice
        The first one leaves nutation out.
    """
    found = []
    measured = max(abs(first), abs(last)) <= NUTATION_MEASURED
    for row in models()["nutation"]:
        if row["model"] == "2000B" and not measured:
            continue  # a series for our time
        nodes = math.ceil((last - first) / row["step"]) + 9 if row["step"] else 0
        words = (
            f"IAU {row['model']} nutation, a node each {row['step']:g} d"
            if row["terms"]
            else "no nutation: the mean equator is near enough"
        )
        found.append(
            Choice(
                words=words,
                settings={"model": row["model"], "spacing": row["step"]} if row["terms"] else {},
                error=NUTATION_PHASE * 10.0 ** row["error"],
                evaluations=row["terms"] * min(nodes, size),
            )
        )
    return found
