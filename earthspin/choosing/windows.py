"""Windows of the pole: how long each is, and with how many nodes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.choosing.choice import Choice, models
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.motion.axes import window_count
from earthspin.motion.forces import Figure
from earthspin.motion.sampling import turn_by_mean, turn_by_sampling

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class PoleWindows:
    """Gauss windows of the pole.

    Attributes
    ----------
    window : float
        Length of each, s.
    order : int
        Nodes in each.
    """

    window: float
    order: int


def window_choices(
    code: int,
    figure: Figure,
    gm: Mapping[int, float],
    span: tuple[float, float],
    *,
    geodesic: float = 0.0,
) -> list[Choice[PoleWindows]]:
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
    list of Choice of PoleWindows
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
            settings=PoleWindows(days * DAY, nodes),
            error=float(off),
            evaluations=nodes * window_count(0.0, span, days * DAY),
        )
        for (days, nodes), off in zip(table["settings"], error, strict=True)
    ]


def _in_reach(rows: Any, reaches: list[float], reach: float) -> FloatArray:
    """Errors of all settings within a reach in s; beyond the last one they grow with it."""
    reached = 10.0 ** np.asarray(rows)
    if reached.ndim == 1:
        return reached
    years = reach / JULIAN_YEAR
    place = min(int(np.searchsorted(reaches, years)), len(reaches) - 1)
    return np.asarray(reached[:, place] * max(1.0, years / reaches[-1]))
