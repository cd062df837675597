"""Tables of the observed pole: the key that names one, and the days of its rows."""

from __future__ import annotations

from earthspin.bodies import Body, in_a_sentence
from earthspin.dates import Span
from earthspin.engine.variables import Labels, Variables, labels
from earthspin.parts.reasons import no_iau_model
from earthspin.sky.columns import is_table
from earthspin.sky.eop import CARRIED, PoleSeries
from earthspin.units import FileName

#: Day of the modified Julian date 0 from J2000.0.
MJD = 51544.5
#: Word for the daily table C04 of the IERS that astropy carries.
C04 = "c04"


class TableFile(FileName):
    """Kind of a table of the observed pole: one that astropy carries, or a local file."""

    words = '"c04", "finals" or the path of a file'
    known = tuple(CARRIED)
    content = "a table of polar motion"

    def begins(self, head: bytes) -> bool:
        """Whether it begins as a table does."""
        return is_table(head)


class Daily(Variables, along=("time",)):
    """Variables at the days of a table."""

    time: Labels = labels("time", standard_name="time", comment="0h UTC in daily tables")


def not_observed(body: Body) -> str | None:
    """Leave out a body whose pole no table holds."""
    return f"no polar motion of {in_a_sentence(body.name)} is kept" if no_iau_model(body) else None


def within(series: PoleSeries, span: Span | None) -> PoleSeries:
    """Rows of a table that lie in a span, all without one.

    Raises
    ------
    SeriesError
        If less than two rows do.
    """
    if span is None:
        return series
    first, last = span.days
    return series.between(first + MJD, last + MJD)
