"""Possible window lengths and node numbers of the axis solver, with their errors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.choosing.choice import Choice, models
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.motion.axes import window_count
from earthspin.motion.forces import Figure
from earthspin.motion.sampling import angle_from_sampling, longest_path
from earthspin.units import FloatArray


@dataclass(frozen=True)
class PoleWindows:
    """Length of the time windows of the axis solver, and number of Gauss nodes in each.

    Attributes
    ----------
    window : float
        Length of a window, s.
    order : int
        Number of nodes in a window.
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
    """Possible window lengths and node numbers of the axis solver, each with its error.

    Parameters
    ----------
    code : int
        NAIF code of the body.
    figure : Figure
    gm : mapping of int to float
        GM of the perturbers by NAIF code, m3 s-2.
    span : tuple of float
        First and last time, s from the epoch.
    geodesic : float
        GM of the mass that causes geodesic precession, m3 s-2; 0 without it.

    Returns
    -------
    list of Choice of PoleWindows
        Empty if the errors for these bodies were not measured, or if higher zonal coefficients,
        which were not included in the measurement, exceed J2.
    """
    table = models()["pole"]
    rows = table["tensor"].get(str(code), {})
    if not all(str(puller) in rows for puller in gm):
        return []
    if any(abs(j) * figure.inverse_polar_moment > abs(figure.h) for j in figure.zonal.values()):
        return []
    reach = max(map(abs, span))

    def total(name: str) -> FloatArray:
        errors = [
            mass * _in_reach(rows[str(puller)][name], table["reach"], reach)
            for puller, mass in gm.items()
        ]
        return np.asarray(np.sum(errors, axis=0))

    mean = sum(mass * 10.0 ** rows[str(puller)]["mean"] for puller, mass in gm.items())
    integral, value, derivative = map(total, ("integral", "value", "derivative"))
    rotation = longest_path(figure, mean, reach)
    error = angle_from_sampling(figure, integral, value, derivative, rotation)
    if geodesic:
        error = error + geodesic * _in_reach(table["geodesic"][str(code)], table["reach"], reach)
    return [
        Choice(
            words=f"Gauss windows of {days} d with {nodes} nodes",
            settings=PoleWindows(days * DAY, nodes),
            error=float(bound),
            evaluations=nodes * window_count(0.0, span, days * DAY),
        )
        for (days, nodes), bound in zip(table["settings"], error, strict=True)
    ]


def _in_reach(rows: Any, reaches: list[float], reach: float) -> FloatArray:
    """Look up the tabulated errors of the axis solver's settings for a time span (s).

    Beyond the longest tabulated span, errors grow linearly with the span.
    """
    errors = 10.0 ** np.asarray(rows)
    if errors.ndim == 1:
        return errors
    years = reach / JULIAN_YEAR
    column = min(int(np.searchsorted(reaches, years)), len(reaches) - 1)
    return np.asarray(errors[:, column] * max(1.0, years / reaches[-1]))
