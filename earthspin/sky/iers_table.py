"""Tables of Earth orientation for astropy, with the observed pole followed by a forecast."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import astropy.units as u
import numpy as np
from astropy.utils import iers

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.pole_rows import day_of


class PoleTable(iers.IERS_A):  # type: ignore[misc]
    """Table of Earth orientation for astropy; it refuses dates outside its range.

    In some transformations the tables of astropy only warn, and use the mean pole or zero. Each of
    their interpolations calls `mjd_utc`.
    """

    iers_table = None

    def mjd_utc(self, jd1: Any, jd2: Any = 0.0) -> Any:
        """Modified Julian dates of times, as in astropy; refuse dates outside the table."""
        days = super().mjd_utc(jd1, jd2)
        mjd = np.ravel(np.sum(days, axis=0))
        first, last = self["MJD"][[0, -1]].value
        uncovered = mjd[(mjd < first) | (mjd >= last)]  # as astropy interpolates
        if uncovered.size:
            raise UndefinedError(
                f"{day_of(uncovered[0])} is outside the table of orientation, which begins on "
                f"{day_of(first)} and ends before {day_of(last)} (UTC); choose dates inside it, or "
                "forecast more days"
            )
        return days


def last_ut1(finals: Path) -> float:
    """Last modified Julian date for which a finals2000A file has UT1 - UTC."""
    return float(PoleTable.read(finals)["MJD"][-1].value)


def with_pole(
    finals: Path, pole: FloatArray, offsets: FloatArray, observed: tuple[float, float]
) -> PoleTable:
    """Build a table from finals2000A, with polar motion and celestial pole offsets replaced.

    Parameters
    ----------
    finals : Path
        File of that layout; UT1 - UTC is taken from it, observed or predicted.
    pole, offsets : array, shape (3, n)
        Daily modified Julian dates, and x and y or dX and dY, rad. The table ends where the shorter
        series ends; rows before a series begins are unchanged.
    observed : tuple of float
        Modified Julian dates of the last observed row of each.
    """
    finals_table = PoleTable.read(finals)
    table: PoleTable = finals_table[finals_table["MJD"].value <= min(pole[0, -1], offsets[0, -1])]
    mjd = table["MJD"].value
    columns = (("PM_x", "PM_y", "PolPMFlag"), ("dX_2000A", "dY_2000A", "NutFlag"))
    for (x, y, flag), series, last in zip(columns, (pole, offsets), observed, strict=True):
        rows = mjd >= series[0, 0]
        places = np.searchsorted(series[0], mjd[rows])
        table[x][rows], table[y][rows] = series[1:, places] * u.rad
        table[flag][rows] = np.where(mjd[rows] <= last, "I", "P")
    return table
