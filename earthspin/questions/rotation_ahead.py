"""UT1 and the length of day of a table up to an origin, and their forecast, with zonal tides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from earthspin.errors import SeriesError
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.questions.zonal_tides import days_tdb, without_kernel
from earthspin.sky import eop
from earthspin.sky.eop import GivenSeries, PoleTable
from earthspin.sky.universal_time import UniversalTime, read_universal_time, tai_minus_utc
from earthspin.wobble import ut1_forecast as model
from earthspin.wobble.forecast import RECORD

#: Largest difference of a step from one day, d, and largest number of days by which UT1 may end
#: before polar motion.
_MIDNIGHT, _OLDEST = 1e-6, 30.0


@dataclass(frozen=True)
class RotationAhead:
    """Observed rows of UT1 that a forecast uses, and the forecast for each day after them.

    Attributes
    ----------
    observed : UniversalTime
    mjd : array, shape (n,)
        Modified Julian dates after the last observed row.
    ut1_minus_tai, length_of_day : array, shape (2, n)
        With zonal tides, and their 95 % half-widths, s.
    from_bulletin_a : bool array, shape (n,)
        Whether UT1 is the prediction of Bulletin A.
    """

    observed: UniversalTime
    mjd: FloatArray
    ut1_minus_tai: FloatArray
    length_of_day: FloatArray
    from_bulletin_a: BoolArray

    @property
    def ut1_minus_utc(self) -> FloatArray:
        """Modified Julian dates and UT1 - UTC, s, observed and forecast, shape (2, n)."""
        mjd = np.concatenate([self.observed.mjd, self.mjd])
        ut1 = np.concatenate([self.observed.ut1_minus_tai, self.ut1_minus_tai[0]])
        return np.array([mjd, ut1 + tai_minus_utc(mjd)])


def _until(table: UniversalTime, last: float) -> BoolArray:
    """Select the observed rows of a table up to a modified Julian date."""
    return np.asarray(~table.predicted & (table.mjd < last + _MIDNIGHT))


def rotation_ahead(
    table: UniversalTime, last: float, until: float, bulletin_a: bool
) -> RotationAhead:
    """Forecast UT1 and the length of day from the rows of a table that were observed.

    Parameters
    ----------
    table : UniversalTime
        Daily, with 15 years of observed rows.
    last, until : float
        Modified Julian dates of the last row that may be used, and of the last day of the forecast.
    bulletin_a : bool
        Whether the next seven days are those of Bulletin A, if the table has them and its newest
        observed row is used.
    """
    observed = table.only(rows := _until(table, last))
    later = model.NEWEST.size  # rows of other tables are as accurate as those before
    if table.name.startswith("finals2000A"):
        later = int(np.count_nonzero(~rows & ~table.predicted))
    ahead = observed.mjd[-1] + np.arange(1.0, max(until - observed.mjd[-1], model.DAYS) + 0.5)
    days = days_tdb(np.concatenate([observed.mjd[-RECORD:], ahead]))
    tides = without_kernel(days[0], days[-1])
    ut1_tide, day_tide = tides.ut1(days)[0][:, 0], tides.length_of_day(days)[0][:, 0]
    given = table.ut1_minus_tai[table.predicted & (table.mjd > observed.mjd[-1])][: model.DAYS]
    known = later == 0 and bulletin_a and given.size == model.DAYS
    predicted = model.forecast(
        1e3 * (observed.ut1_minus_tai[-RECORD:] - ut1_tide[:RECORD]),
        1e3 * observed.ut1_error[-RECORD:],
        ahead.size,
        later,
        1e3 * (given - ut1_tide[RECORD:][: model.DAYS]) if known else None,
    )
    return RotationAhead(
        observed,
        ahead,
        predicted.ut1 / 1e3 + np.outer([1, 0], ut1_tide[RECORD:]),
        predicted.length_of_day / 1e3 + np.outer([1, 0], day_tide[RECORD:]),
        known & (np.arange(ahead.size) < model.DAYS),
    )


def no_universal_time(file: PoleTable, columns: str | None, origin: float | None) -> str | None:
    """Return the reason (text) to omit UT1 if it cannot be forecast from a table, else None."""
    if isinstance(file, GivenSeries):
        return "polar motion has no UT1; name a table"
    try:
        table = read_universal_time(file, columns)
        newest = eop.read_polar_motion(file, columns=columns).mjd[-1]
    except SeriesError as error:
        return str(error)
    last = newest if origin is None else np.floor(origin + eop.MJD)
    mjd = table.mjd[_until(table, last)]
    if mjd.size < RECORD or abs(mjd[-1] - mjd[0] - mjd.size + 1) > _MIDNIGHT:
        return f"the table has UT1 of {mjd.size} days up to the origin; give {RECORD} in a row"
    if last - mjd[-1] > _OLDEST:
        return f"the last UT1 is {last - mjd[-1]:.0f} d older than the origin"
    return None
