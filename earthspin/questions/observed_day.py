"""Observed UT1 and length of day, with the zonal tides left in or taken out."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.dates import Span, datetime64
from earthspin.engine import Neglected, Question, key, part, public_call, setting
from earthspin.engine.variables import measured
from earthspin.questions import observed_pole as tables
from earthspin.questions.zonal_tides import days_tdb, without_kernel
from earthspin.sky.eop import CARRIED, MJD
from earthspin.sky.universal_time import UniversalTime, read_universal_time, tai_minus_utc
from earthspin.tables import is_table
from earthspin.torque.zonal_tides import KAPPA
from earthspin.units import FileName, Text


class DayTable(FileName):
    """Kind of input: a table of UT1, by name or by path."""

    words = '"c04", "finals", or the path of a file'
    known = tuple(CARRIED)
    content = "a table of UT1"

    def begins(self, head: bytes) -> bool:
        """Return True if a file with the first bytes `head` may be a table."""
        return is_table(head)


class ObservedDay(
    Question,
    word="observed-day",
    call="observed_day",
    table="observed_day",
    positional=("start", "stop"),
):
    """Observed length of day and UT1.

    The length of day is its excess over 86400 s. Rows that a table marks as predicted are left out,
    and the lengths of day that it lacks are NaN. The zonal tides of Sun and Moon stand beside them;
    those of UT1 are counted from the first date.

    Raises
    ------
    SeriesError
        If the file holds no UT1, or has gaps or jumps, or does not cover the span.

    Examples
    --------
    >>> import earthspin
    >>> day = earthspin.observed_day("2016-12-30", "2017-01-02")
    >>> print(day.ut1_utc.round(3).values, day.ut1_tai.round(3).values)
    [-0.407 -0.408  0.591  0.59 ] [-36.407 -36.408 -36.409 -36.41 ]
    """

    page, headline = "length_of_day", "length_of_day"

    span: Span | None = key(None, doc="first and last date; the whole table if not given")
    file: Annotated[str, DayTable()] = setting(
        tables.C04, doc="table that astropy carries, or a file of the IERS or CelesTrak"
    )
    columns: Annotated[str, Text()] | None = setting(
        None,
        doc="names and units of all columns of a file, like 'mjd, ut1 (s), lod (ms), ...'; by its "
        "header or layout if not given",
    )
    tides: Literal["left in", "taken out"] = setting(
        "left in", doc="zonal tides of Sun and Moon, in length of day and UT1"
    )


class ObservedUniversalTime(tables.Daily):
    """Observed length of day and UT1, and the zonal tides on the same days."""

    length_of_day = measured(
        "ms",
        "excess of the length of day over 86400 s",
        missing_where="the table gives no length of day",
    )
    ut1_tai = measured("s", "UT1 - TAI")
    ut1_utc = measured("s", "UT1 - UTC")
    length_of_day_tides = measured("ms", "change of the length of day by zonal tides")
    ut1_tides = measured("ms", "change of UT1 by zonal tides since the first date")


@part
def day_table(file: str, columns: str | None, span: Span | None) -> UniversalTime:
    """Read the observed UT1 and length of day of a table, within the requested span."""
    table = read_universal_time(file, columns, tables.mjd_span(span))
    return table.only(~table.predicted)


@part(loads=("scipy.interpolate",))
def observed_universal_time(day_table: UniversalTime, tides: str) -> ObservedUniversalTime:
    """Return the observed length of day and UT1, with or without the zonal tides, and these."""
    lod, late = day_table.length_of_day, day_table.ut1_minus_tai
    errors = NORMAL_95 * day_table.length_of_day_error, NORMAL_95 * day_table.ut1_error
    days = days_tdb(day_table.mjd)
    zonal = without_kernel(days[0], days[-1])
    both = zonal.length_of_day(days), zonal.ut1(days)
    of_lod, of_ut1 = (np.array(pair)[..., 0] for pair in both)
    if tides == "taken out":
        lod, late = lod - of_lod[0], late - of_ut1[0]
        errors = np.hypot(errors[0], of_lod[1]), np.hypot(errors[1], of_ut1[1])
    source = {"references": day_table.source, "repairs": day_table.repairs or "none"}
    source |= {"zonal_tides": tides}
    theory = {"references": KAPPA.source}
    return ObservedUniversalTime(
        time=datetime64(day_table.mjd - MJD),
        length_of_day=(lod, errors[0]),
        ut1_tai=(late, errors[1]),
        ut1_utc=(late + tai_minus_utc(day_table.mjd), errors[1]),
        length_of_day_tides=of_lod,
        ut1_tides=of_ut1,
    ).with_attributes(
        no_error=tables.NO_ERRORS,
        **dict.fromkeys(("length_of_day", "ut1_tai", "ut1_utc"), source),
        **dict.fromkeys(("length_of_day_tides", "ut1_tides"), theory),
    )


@part
def neglected() -> Neglected:
    """Effects that the tables leave out by convention."""
    return Neglected(
        sizes={"tides of a day and of half a day": 8.9e-5},
        unit="ms",
        what="largest in UT1, which tables leave out by convention",
        source="IERS Conventions (2010), table 8.3",
    )


observed_day = public_call(
    ObservedDay, answer=observed_universal_time, sections=(neglected,), parts=(day_table,)
)
