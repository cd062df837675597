"""Lunar standstills: dates when the range of the Moon's declination is largest or smallest.

The orbit is inclined by 5.1 degrees to the ecliptic and its node has a period of 18.6 years. When
the ascending node is at the equinox, inclination and obliquity add (major standstill); half a
period later they subtract (minor). The extreme of a single month differs from 23.44 +- 5.14 degrees
because solar perturbations vary the inclination between 5.0 and 5.3 degrees.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from earthspin.constants import DAYS_PER_YEAR
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.iau import mean_longitude_of_node

#: Spacing of the samples among which extremes are looked for, d.
_SAMPLING = 2.0
#: Spacings of three samples about each extreme, by which its time is refined to 0.5 s, d.
_CLOSER = (2.0, 0.2, 0.02)
_REACH = 2.0 * DAYS_PER_YEAR  # days searched before and after the passage of the node


@dataclass(frozen=True)
class Standstill:
    """Date and declination of the northern or southern extreme of a lunar standstill.

    Attributes
    ----------
    kind : str
        ``"major"`` or ``"minor"``.
    day : float
        Time of the extreme, days from J2000.0 TDB.
    declination : float
        Declination at that time, rad; negative for a southern extreme.
    """

    kind: str
    day: float
    declination: float


def node_passages(start: float, end: float) -> list[tuple[str, float]]:
    """Times when the Moon's mean node passes the equinox (major) or the opposite point (minor).

    Parameters
    ----------
    start, end : float
        Days from J2000.0 TDB; only passages whose search range is inside are listed.
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
    """Find the northern and southern extreme of each lunar standstill within a time span.

    Parameters
    ----------
    declination : callable
        Function of days from J2000.0 TDB, shape (n,), that returns declination, rad, shape (n,).
    start, end : float
        The span, days from J2000.0 TDB.

    Returns
    -------
    list of Standstill
        In order of time, two for each passage of the node; empty if there are none in the span.
    """
    passages = node_passages(start, end)
    if not passages:
        return []
    centres = [day for _, day in passages]
    days = np.add.outer(centres, np.arange(-_REACH, _REACH, _SAMPLING))
    rising = np.diff(declination(days.ravel()).reshape(days.shape), axis=1) > 0
    owner, place = np.nonzero(rising[:, 1:] != rising[:, :-1])
    turning = days[owner, place + 1]
    for spacing in _CLOSER:
        turning = _vertices(declination, turning, spacing)
    extremes = declination(turning)
    standstills = []
    for number, (kind, _) in enumerate(passages):
        for side in (extremes > 0, extremes < 0):
            places = np.flatnonzero(side & (owner == number))
            if places.size:
                swing = np.abs(extremes[places])
                best = places[np.argmax(swing) if kind == "major" else np.argmin(swing)]
                standstills.append(Standstill(kind, float(turning[best]), float(extremes[best])))
    return sorted(standstills, key=lambda standstill: standstill.day)


def _vertices(
    declination: Callable[[FloatArray], FloatArray], days: FloatArray, spacing: float
) -> FloatArray:
    """Days of extreme declination near given days, from a parabola through three values each."""
    before, middle, after = np.split(
        declination(np.concatenate([days - spacing, days, days + spacing])), 3
    )
    return days + spacing / 2 * (before - after) / (before - 2 * middle + after)
