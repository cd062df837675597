"""Tables of Earth orientation for astropy, with the observed pole followed by a forecast."""

from __future__ import annotations

from collections.abc import Sequence
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


#: Columns of polar motion, celestial pole offsets and UT1, with their flags, and the units of
#: `with_orientation`. Errors and the columns of each bulletin in finals2000A are left out.
_COLUMNS = (
    (("PM_x", "PM_y"), "PolPMFlag", u.rad),
    (("dX_2000A", "dY_2000A"), "NutFlag", u.rad),
    (("UT1_UTC",), "UT1Flag", u.s),
)


def last_ut1(finals: Path) -> float:
    """Last modified Julian date for which a finals2000A file has UT1 - UTC."""
    return float(PoleTable.read(finals)["MJD"][-1].value)


def with_orientation(
    finals: Path, replaced: Sequence[FloatArray], observed: Sequence[float]
) -> PoleTable:
    """Build a table from finals2000A, with polar motion, pole offsets and UT1 - UTC replaced.

    Parameters
    ----------
    finals : Path
        File of that layout.
    replaced : sequence of array, shapes (3, n), (3, m) and (2, k)
        Daily modified Julian dates with x and y, with dX and dY, rad, and with UT1 - UTC, s;
        without the last, UT1 - UTC is that of the file, observed or predicted. The table ends where
        the shorter of the first two ends; rows before a series begins are unchanged.
    observed : sequence of float
        Modified Julian dates of the last observed row of each.
    """
    table: PoleTable = PoleTable.read(finals)
    table.keep_columns(["MJD", *(c for names, flag, _ in _COLUMNS for c in (*names, flag))])
    first, last = table["MJD"][0].value, min(series[0, -1] for series in replaced[:2])
    rows = np.arange(int(last - first) + 1)
    table = table[np.minimum(rows, len(table) - 1)]
    table["MJD"] = (mjd := first + rows) * u.d
    for (names, flag, unit), series, end in zip(_COLUMNS, replaced, observed, strict=False):
        new = mjd >= series[0, 0]
        places = np.searchsorted(series[0], mjd[new])
        for name, values in zip(names, series[1:], strict=True):
            table[name][new] = values[places] * unit
        table[flag][new] = np.where(mjd[new] <= end, "I", "P")
    return table
