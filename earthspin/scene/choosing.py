r"""Accuracy on request: the cheapest settings whose measured error is small enough.

What each setting costs in error was measured once on the sky alone (`python -m data_tools
error-models` writes `error_models.json`): the tidal tensor Q = GM r r^T/r5 does not depend on
the body, and an error dQ turns the axis of any body by no more than 3 (H/Omega) s(dQ), where s
is half the difference of the largest and the smallest eigenvalue. So one table serves bodies of
any shape, spin and pole. Where the sky is not in the table (another perturber, another body),
nothing is chosen and the finest settings stand.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY, JULIAN_YEAR

FloatArray = NDArray[np.float64]

#: What was measured.
DATA = Path(__file__).with_name("error_models.json")
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
        For the function that computes, by argument.
    error : float
        Bound on the error of the method, SI: rad, or relative.
    evaluations : int
        How often the sky (or a term of the nutation) will be evaluated.
    errors : mapping
        By NAIF code of the perturber, where it is an average: of its push, and of its torque along
        any axis, both per C - A, s-2.
    """

    words: str
    settings: Mapping[str, Any]
    error: float
    evaluations: int
    errors: Mapping[int, tuple[float, float]]


@lru_cache
def models() -> dict[str, Any]:
    """Read what was measured."""
    found: dict[str, Any] = json.loads(DATA.read_text(encoding="utf-8"))
    return found


def cheapest(choices: Iterable[Choice], allowed: float) -> Choice | None:
    """Choose the cheapest within the error allowed; of equally cheap ones the most accurate."""
    good = [choice for choice in choices if choice.error <= allowed]
    return min(good, key=lambda choice: (choice.evaluations, choice.error), default=None)


# --- the pole: windows ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Turning:
    """What of a body decides how far an error of the tidal tensor turns its axis.

    Attributes
    ----------
    code : int
        NAIF.
    h, triaxiality : float
        (C - A)/C and (B - A)/C.
    spin_rate : float
        rad/s.
    gm : mapping of int to float
        What pulls, by NAIF code, m3 s-2.
    geodesic : bool
        Whether the frame turns, too.
    """

    code: int
    h: float
    triaxiality: float
    spin_rate: float
    gm: Mapping[int, float]
    geodesic: bool


def window_choices(body: Turning, first: float, last: float) -> list[Choice]:
    """Windows of the pole with the error of each, from t = 0 to a span, s.

    Returns
    -------
    list of Choice
        Empty if the sky of this body has not been measured.
    """
    table = models()["pole"]
    rows = table["tensor"].get(str(body.code), {})
    if not all(str(code) in rows for code in body.gm):
        return []
    reach = max(abs(first), abs(last))

    def of_all(name: str) -> FloatArray:
        each = [
            gm * _in_reach(rows[str(code)][name], table["reach"], reach)
            for code, gm in body.gm.items()
        ]
        return np.asarray(np.sum(each, axis=0))

    integral, value, derivative = map(of_all, ("integral", "value", "derivative"))
    kappa = (1 - body.h) / abs(body.spin_rate)
    per_h = 3 * abs(body.h) / abs(body.spin_rate)
    error = per_h * (integral + kappa * value + kappa**2 * derivative)
    error = error + 3 * abs(body.triaxiality) / body.spin_rate**2 * value
    if body.geodesic:
        error = error + _in_reach(table["geodesic"][str(body.code)], table["reach"], reach)
    return [
        Choice(
            words=f"Gauss windows of {days} d with {nodes} nodes",
            settings={"window": days * DAY, "order": nodes},
            error=float(off),
            evaluations=nodes * _windows(first, last, days * DAY),
            errors={},
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


def _windows(first: float, last: float, window: float) -> int:
    forward, backward = max(0.0, last), max(0.0, -first)
    return math.ceil(forward / window) + math.ceil(backward / window) or 1


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
    gm, slow_swing : mapping of int to float
        Of what pulls, by NAIF code: m3 s-2, and relative.
    cycle : float
        The slowest, s.
    """

    code: int
    obliquity: float
    normal: FloatArray
    gm: Mapping[int, float]
    slow_swing: Mapping[int, float]
    cycle: float


def average_choices(body: Pushed, cycles: float) -> list[Choice]:
    """Windows of an average with the relative error of the rate, up to so many cycles.

    With z along the orbit's normal the push of a mean tensor is

        3 ((Qxx - Qzz) cos(eps) + Qxz cos(2 eps)/sin(eps)).

    Returns
    -------
    list of Choice
        Empty if the sky has not been measured, or the rate vanishes.
    """
    table = models()["average"]
    rows = table["tensor"].get(str(body.code), {}).get(f"{body.cycle / DAY:.2f}", {})
    cosine, sine = math.cos(body.obliquity), math.sin(body.obliquity)
    if not all(str(code) in rows for code in body.gm) or sine == 0:
        return []
    if np.linalg.norm(body.normal - table["normal"][str(body.code)]) > SAME_ORBIT:
        return []
    push = {code: 3 * gm * rows[str(code)]["mean"] * cosine for code, gm in body.gm.items()}
    swing = sum(body.slow_swing[code] * abs(push[code]) for code in body.gm)
    total = abs(sum(push.values()))
    if total == 0:
        return []
    in_plane, out_of_plane = (
        {code: 3 * gm * 10.0 ** np.asarray(rows[str(code)][name]) for code, gm in body.gm.items()}
        for name in ("in_plane", "out_of_plane")
    )
    tilting = abs(math.cos(2 * body.obliquity)) / sine
    found = []
    for i, turns in enumerate(turns for turns in table["cycles"] if turns <= cycles):
        for j, days in enumerate(table["steps"]):
            off = {code: (in_plane[code][i, j], out_of_plane[code][i, j]) for code in body.gm}
            errors = {code: (a * abs(cosine) + b * tilting, a + b) for code, (a, b) in off.items()}
            found.append(
                Choice(
                    words=f"sin4 taper over {turns} cycles, a sample each {days} d",
                    settings={"cycles": turns, "step": days * DAY},
                    error=(sum(push for push, _ in errors.values()) + swing) / total,
                    evaluations=2 * math.floor(turns * body.cycle / DAY / 2 / days) + 1,
                    errors=errors,
                )
            )
    return found


# --- the true equator: nutation ------------------------------------------------------------------


def nutation_choices(first: float, last: float, size: int) -> list[Choice]:
    """Ways to the true equator with their errors, for so many epochs between two days.

    Returns
    -------
    list of Choice
        The first one leaves nutation out.
    """
    found = []
    for row in models()["nutation"]:
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
                error=10.0 ** row["error"],
                evaluations=row["terms"] * min(nodes, size),
                errors={},
            )
        )
    return found
