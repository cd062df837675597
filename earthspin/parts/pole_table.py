"""Tables of the observed pole: select a file, read its rows, and label its polar motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from earthspin.bodies import EARTH, Body, in_a_sentence
from earthspin.constants import ARCSEC, J2000_JD, MAS
from earthspin.dates import Span, days
from earthspin.engine.labels import si
from earthspin.engine.question import Question, key, setting
from earthspin.engine.variables import Labels, Variables, labels
from earthspin.errors import SceneError, Where
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.parts.reasons import no_iau_model
from earthspin.sky.columns import is_table
from earthspin.sky.eop import CARRIED, PoleSeries
from earthspin.units import FileName

if TYPE_CHECKING:
    import xarray as xr


#: Modified Julian date of J2000.0.
MJD = J2000_JD - 2400000.5
#: Smallest plausible value of the largest distance from the conventional pole, mas.
SMALLEST = 0.1
#: Name of the daily table C04 of the IERS, which astropy includes.
C04 = "c04"


class TableFile(FileName):
    """Kind of input: a table of the observed pole, included in astropy or in a local file."""

    words = '"c04", "finals" or the path of a file'
    known = tuple(CARRIED)
    content = "a table of polar motion"

    def begins(self, head: bytes) -> bool:
        """Return True if a file with the first bytes `head` may be a table of the pole."""
        return is_table(head)


class OfTable(Question):
    """Base class of questions about a table of the observed pole."""

    body: Body = key(EARTH, doc="body whose pole was observed")
    span: Span | None = key(None, doc="first and last date; the whole table if not given")
    file: Annotated[str, TableFile()] = setting(
        C04, doc="a daily table of the IERS that astropy carries, or a local file"
    )
    kind: Literal["c04", "c01", "finals2000A"] | None = setting(
        None, doc="layout of the table; recognised from the file if not given"
    )


class Daily(Variables, along=("time",)):
    """Base class of results given at the days of a table of the observed pole."""

    time: Labels = labels("time", standard_name="time", comment="0h UTC in daily tables")


def not_observed(body: Body) -> str | None:
    """Return the reason (text) to omit polar motion if no observed pole is known, else None."""
    return f"no polar motion of {in_a_sentence(body.name)} is known" if no_iau_model(body) else None


def within(series: PoleSeries, span: Span | None) -> PoleSeries:
    """Select the rows of a table of the observed pole within a span, or all if no span is given.

    Raises
    ------
    SeriesError
        If fewer than two rows lie within the span.
    """
    if span is None:
        return series
    first, last = span.days
    return series.between(first + MJD, last + MJD)


def complex_pole(pole: xr.Dataset) -> tuple[FloatArray, ComplexArray]:
    """Convert polar motion in a Dataset to days from J2000.0 and complex numbers x - i y, mas.

    Raises
    ------
    SceneError
        If there are no x and y with units along time, or the days are not ascending.
    """
    from earthspin.wobble.excitation import pole_of

    time, x, y = labelled_series(pole, ("x", "y"), ("arcsec", "mas"))
    for name, values in (("x", x), ("y", y)):
        largest = float(abs(values).max())
        if largest > 2 * ARCSEC:
            raise SceneError(
                f"largest {name}",
                f"{largest / ARCSEC:.3g} arcsec",
                "polar motion is below 1 arcsec; check the unit",
            )
    p = pole_of(x, y) / MAS
    if 0 < np.max(abs(p)) < SMALLEST:
        raise SceneError(
            "largest distance of the pole",
            f"{np.max(abs(p)):.3g} mas",
            f"polar motion is larger than {SMALLEST:g} mas; check the unit",
        )
    return time, p


def labelled_series(
    series: Any, names: tuple[str, str], units: tuple[str, ...]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Days from J2000.0, and values in SI units, of two variables of a Dataset along `time`.

    Raises
    ------
    SceneError
        If a variable or its unit is missing, there are fewer than two days, or the days are not
        ascending.
    """
    if not hasattr(series, "data_vars"):
        problem = f"give a Dataset with {' and '.join(names)}"
        raise SceneError("series", type(series).__name__, problem)
    for name in names:
        if name not in series or series[name].dims != ("time",):
            names_given = list(map(str, series.data_vars))
            raise SceneError("series", names_given, f"'{name}' along 'time' is needed")
        unit, kind = series[name].attrs.get("units"), series[name].dtype
        if kind.kind != "f" or series["time"].dtype.kind != "M":
            raise SceneError(name, str(kind), "give numbers along dates without a zone")
        if unit not in units:
            allowed = " or ".join(f"'{u}'" for u in units)
            raise SceneError(f"units of {name}", unit, f"set attrs['units'] to {allowed}")
    if series.time.size < 2:
        raise SceneError("time", f"{series.time.size} days", "give two or more")
    time = days(series.time, Where("time"))
    backward = np.diff(time) <= 0
    if np.any(backward):
        raise SceneError(
            "time",
            str(series.time.values[1:][backward][0]),
            "times are not ascending; sort them with ds.sortby('time') and remove "
            "duplicates with ds.drop_duplicates('time')",
        )
    first, second = (si(series[name]).values for name in names)
    return time, first, second
