"""Lunar standstills: the months in which the Moon's declination swings widest and least.

The orbit is tilted by 5.1 degrees to the ecliptic and its node goes round in 18.6 years. When
the ascending node is at the equinox the tilts add up (major standstill), half a turn
later they oppose (minor). The extreme of a single month differs from 23.44 +- 5.14 degrees
because the Sun's pull swings the tilt between 5.0 and 5.3 degrees.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from earthspin.sky.iau import mean_longitude_of_node

FloatArray = NDArray[np.float64]

SAMPLING = 0.5  # days; the extreme found from such samples is right to 2 minutes
_REACH = 2.0 * 365.25  # days on either side of the node's passage that are searched


@dataclass(frozen=True)
class Standstill:
    """One standstill.

    Attributes
    ----------
    kind : str
        ``"major"`` or ``"minor"``.
    day : float
        Of the extreme, days from J2000.0 TDB.
    declination : float
        At that time, rad; negative if the extreme is southern.
    """

    kind: str
    day: float
    declination: float


def node_passages(start: float, end: float) -> list[tuple[str, float]]:
    """List when the mean node passes the equinox (major) and its opposite (minor).

    Parameters
    ----------
    start, end : float
        Days from J2000.0 TDB; only passages whose search range lies inside are listed.
    """
    days = np.arange(start, end, 10.0)
    if days.size < 2:
        return []
    half_turns = np.unwrap(mean_longitude_of_node(days)) / np.pi  # falls steadily
    passages = []
    for k in range(int(np.ceil(half_turns[-1])), int(np.floor(half_turns[0])) + 1):
        day = float(np.interp(-k, -half_turns, days))
        if start + _REACH < day < end - _REACH:
            passages.append(("minor" if k % 2 else "major", day))
    return sorted(passages, key=lambda passage: passage[1])


def find_standstills(
    declination: Callable[[FloatArray], FloatArray], start: float, end: float
) -> list[Standstill]:
    """Find every standstill that lies wholly inside a span.

    Parameters
    ----------
    declination : callable
        Days from J2000.0 TDB, shape (n,), to declination, rad, shape (n,).
    start, end : float
        The span, days from J2000.0 TDB.

    Returns
    -------
    list of Standstill
        In order of time; empty if the span holds none.
    """
    standstills = []
    for kind, passage in node_passages(start, end):
        days = np.arange(passage - _REACH, passage + _REACH, SAMPLING)
        turning = CubicSpline(days, declination(days)).derivative().roots(extrapolate=False)
        # The spline only says when; at an extreme, an error in time is one of second order.
        extremes = declination(turning)
        swing = np.abs(extremes)
        best = np.argmax(swing) if kind == "major" else np.argmin(swing)
        standstills.append(Standstill(kind, float(turning[best]), float(extremes[best])))
    return standstills
