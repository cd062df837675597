"""Rotation angle of the Earth from UT1: observed where a table covers the day, else estimated."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from earthspin import tables
from earthspin._lazy import erfa
from earthspin.constants import DAY, DAYS_PER_YEAR, J2000_JD, NORMAL_95
from earthspin.numerics.polynomials import lagrange
from earthspin.sky.eop import file_of
from earthspin.tables import layouts

_MJD_OF_JD0 = 2400000.5
TT_MINUS_TAI = 32.184  # s
#: Ratio of the errors of predicted rows to the stated ones: these hold 71 % at 90 days.
_PREDICTED = 2.0
#: Half-width from the tides with periods of a day and less, which daily tables leave out, s: 95 %
#: of the values of the IERS Conventions (2010), table 8.3, which reach 89 us.
_DIURNAL = 4.9e-5
#: Columns that are read, and in finals2000A where they are, with the flag of UT1.
_COLUMNS = ("mjd", "ut1", "e_ut1")
_EDGES = {
    column.quantity: slice(*edges)
    for column, edges in zip(
        tables.declared(layouts.FINALS2000A.columns), layouts.FINALS2000A.edges, strict=True
    )
}
_MJD, _UT1, _SIGMA = (_EDGES[name] for name in _COLUMNS)
_FLAG = _UT1.start - 1
#: First day of finals2000A.
_BEGIN_OF_FINALS = 41684.0
#: Standard deviations of TT - UT1 before the table: year, s. Morrison & Stephenson 2004, J. Hist.
#: Astron. 35, 327, and Stephenson & Houlden 1986, as listed with the eclipse canon of NASA; before
#: the first year they grow as 0.8 t2 with t in centuries from 1820; the last, from C04.
_PAST = np.array(
    [(-1000, 636.0), (-500, 431.0), (0, 265.0), (500, 139.0), (1000, 54.0), (1200, 31.0),
     (1300, 20.0), (1600, 20.0), (1700, 5.0), (1800, 1.0), (1900, 0.1), (1960, 0.1), (1962, 0.3)]
).T  # fmt: skip
#: Errors of UT1 after the last observed day: years, and half-width that holds 95 % of them over
#: 1.96, s. Measured from each 60th day of C04, 1972 to 2026, with the curve of Skyfield for a table
#: that ends a year earlier, moved to the day. Later they grow with a power of time.
_FUTURE = np.array(
    [(0.1, 0.018), (0.25, 0.041), (0.5, 0.071), (1, 0.15), (2, 0.33), (3, 0.57), (5, 1.1),
     (10, 2.5), (20, 5.6)]
).T  # fmt: skip
_POWER = 1.4


def earth_rotation(day: float) -> tuple[float, float, str]:
    """Angle about the celestial pole from the x axis of the GCRS to the prime meridian.

    The x axis is projected on the true equator of date.

    Parameters
    ----------
    day : float
        Days from J2000.0 TDB.

    Returns
    -------
    tuple of float, float, str
        Angle, and its 95 % half-width from UT1, rad; and the source of UT1 in words.
    """
    late, half, source = tt_minus_ut1(day)
    tdb_minus_tt = float(erfa.dtdb(J2000_JD, day, 0.0, 0.0, 0.0, 0.0))
    era = float(erfa.era00(J2000_JD, day - (tdb_minus_tt + late) / DAY))
    towards_origin, across, pole = erfa.c2i06a(J2000_JD, day)
    x_axis = np.array([1.0, 0.0, 0.0]) - pole[0] * pole
    angle = era - math.atan2(x_axis @ across, x_axis @ towards_origin)
    return angle, 2 * math.pi * half / DAY, source


def tt_minus_ut1(day: float) -> tuple[float, float, str]:
    """TT - UT1 and its 95 % half-width, s, on a day from J2000.0, and its source in words."""
    mjd = J2000_JD - _MJD_OF_JD0 + day
    name, rows = "C04", _c04(mjd)
    if len(rows) < 4:
        name, rows = "finals2000A", _finals(mjd)
    if len(rows) < 4:
        return _estimated(day)
    days, ut1_minus_utc, sigma, predicted = np.array(rows).T
    whole, part = np.floor(days), days % 1.0
    tai1, tai2 = erfa.utctai(_MJD_OF_JD0 + whole, part)
    tai_minus_ut1 = (tai1 - _MJD_OF_JD0 - whole + tai2 - part) * DAY - ut1_minus_utc
    utc = mjd - (tai_minus_ut1[0] + TT_MINUS_TAI) / DAY  # UT1 for UTC: within 1 s
    weights = lagrange(days, np.array([utc]))[:, 0]
    sigma = sigma * np.where(predicted, _PREDICTED, 1.0)
    half = math.hypot(NORMAL_95 * float(sigma.max()), _DIURNAL)
    source = f"UT1 {'predicted by' if predicted.any() else 'observed,'} IERS {name}"
    return float(weights @ tai_minus_ut1) + TT_MINUS_TAI, half, source


def _c04(mjd: float) -> list[list[float]]:
    """Day, UT1 - UTC, standard deviation and 0 in four rows of the C04 table about a day."""
    names = [column.quantity for column in tables.declared(layouts.C04[1].columns)]
    places = [names.index(name) for name in _COLUMNS]
    lines = [line for line in _lines("c04") if not line.startswith("#")]
    rows = _around(lines, mjd, float(lines[0].split()[places[0]]))
    return [[float(row.split()[place]) for place in places] + [0.0] for row in rows]


def _finals(mjd: float) -> list[list[float]]:
    """Day, UT1 - UTC, standard deviation, and 1 if predicted, in four rows of finals2000A."""
    rows = [row for row in _around(_lines("finals"), mjd, _BEGIN_OF_FINALS) if row[_UT1].strip()]
    return [
        [*(float(row[c]) for c in (_MJD, _UT1, _SIGMA)), float(row[_FLAG] == "P")] for row in rows
    ]


def _around(lines: list[str], mjd: float, first: float) -> list[str]:
    """Four daily rows about a day, fewer at the ends of the table."""
    row = math.floor(mjd - first) - 1
    return lines[max(row, 0) : row + 4] if row >= 0 else []


@cache
def _lines(name: str) -> list[str]:
    """Lines of a table that astropy carries."""
    return file_of(name).read_text("ascii").splitlines()


def _estimated(day: float) -> tuple[float, float, str]:
    """TT - UT1 outside the tables: history of eclipses and occultations, and its continuation."""
    from earthspin.sky.skyfield import timescale

    year, scale = 2000.0 + day / DAYS_PER_YEAR, timescale()
    late = float(scale.tdb_jd(J2000_JD + day).delta_t)
    if year > 2000.0:
        rows = [row for row in _lines("finals") if row[_UT1].strip()]
        observed = max(float(row[_MJD]) for row in rows if row[_FLAG] == "I")
        end = _MJD_OF_JD0 + float(rows[-1][_MJD]) - 2 - J2000_JD  # within four rows
        late += tt_minus_ut1(end)[0] - float(scale.tdb_jd(J2000_JD + end).delta_t)
        after = (J2000_JD - _MJD_OF_JD0 + day - observed) / DAYS_PER_YEAR
        longer = max(after / _FUTURE[0, -1], 1.0) ** _POWER
        half = NORMAL_95 * float(np.interp(after, *_FUTURE)) * float(longer)
        return late, half, "UT1 extrapolated"
    before = year < _PAST[0, 0]
    sigma = 0.8 * ((year - 1820) / 100) ** 2 if before else float(np.interp(year, *_PAST))
    return late, NORMAL_95 * sigma, "UT1 from Stephenson, Morrison & Hohenkerk 2016"
