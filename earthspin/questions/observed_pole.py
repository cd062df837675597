"""Observed pole: tables of the IERS, and models beside the observed celestial pole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray

from earthspin._lazy import xr
from earthspin.bodies import EARTH, Body, in_a_sentence
from earthspin.constants import ARCSEC, DAY, DAYS_PER_CENTURY, J2000_JD, MAS
from earthspin.dates import Epochs, Span, days
from earthspin.engine.question import Question, key, part, setting
from earthspin.engine.variables import Variables, labels, number, si
from earthspin.errors import SceneError, Where
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation import core_nutation
from earthspin.nutation.analysis import without_line
from earthspin.questions import reasons, times
from earthspin.sky.columns import is_table
from earthspin.sky.eop import CARRIED, PoleSeries, read_pole_offsets
from earthspin.units import FileName
from earthspin.wobble.excitation import pole_of

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
    """Base class of results given at days of a table of the observed pole, or after them."""

    time = labels("time", standard_name="time", comment="0h UTC in daily tables")


def not_observed(body: Body) -> str | None:
    """Return the reason (text) to omit polar motion if no observed pole is known, else None."""
    unknown = f"no polar motion of {in_a_sentence(body.name)} is known"
    return unknown if reasons.no_iau_model(body) else None


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
    time, x, y = labelled_series(pole, ("x", "y"), ("arcsec", "mas"))
    for name, values in (("x", x), ("y", y)):
        largest = float(abs(values).max()) / ARCSEC
        if largest > 2:
            problem = "polar motion is below 1 arcsec; check the unit"
            raise SceneError(f"largest {name}", f"{largest:.3g} arcsec", problem)
    p = pole_of(x, y) / MAS
    if 0 < (largest := float(np.max(abs(p)))) < SMALLEST:
        problem = f"polar motion is larger than {SMALLEST:g} mas; check the unit"
        raise SceneError("largest distance of the pole", f"{largest:.3g} mas", problem)
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
        problem = "times are not ascending; sort them with ds.sortby('time')"
        problem += " and remove duplicates with ds.drop_duplicates('time')"
        raise SceneError("time", str(series.time.values[1:][backward][0]), problem)
    first, second = (si(series[name]).values for name in names)
    return time, first, second


# --- models beside the observed pole -------------------------------------------------------------


#: First day of comparisons, 1990, in days from J2000.0. The stated errors of earlier offsets are
#: 0.4 to 0.6 mas a day, larger than the error of IAU 2006/2000A.
FIRST_DAY = 47892.0 - MJD
#: Smallest number of dates that are compared.
FEWEST = 10
#: Name of IAU 2006/2000A among the models.
IAU = "iau"


@cache
def observed_series() -> PoleSeries:
    """Observed celestial pole offsets of the IERS series C04."""
    return read_pole_offsets()


def not_observed_then(span: Span, step: float) -> str | None:
    """Return the reason (text) to omit the comparison if too few dates are observed, else None."""
    first, last = span.days
    first, last = max(first, FIRST_DAY), min(last, float(observed_series().mjd[-1]) - MJD)
    if (last - first) * DAY >= FEWEST * step:
        return None
    return f"fewer than {FEWEST} dates lie between 1990 and the last observed offset of C04"


@dataclass(frozen=True)
class ObservedSky:
    """Observed celestial pole offsets, and the free core nutation in them, at given dates.

    Attributes
    ----------
    rows : ndarray, shape (t,), bool
        True for the dates of the series that are compared.
    days : ndarray, shape (n,)
        The compared dates, days from J2000.0.
    offsets : ndarray, shape (n, 2)
        DX and dY, rad: the observed pole minus that of IAU 2006/2000A. To first order in the
        offsets and in the precession since J2000.0 they equal dpsi sin(eps0) and deps.
    core : ndarray, shape (n, 2)
        Free core nutation in the offsets, from sliding windows of three years, rad.
    provenance : dict of str to str
        Checksum of the table.
    """

    rows: NDArray[np.bool_]
    days: FloatArray
    offsets: FloatArray
    core: FloatArray
    provenance: dict[str, str]

    def sizes(self, models: Mapping[str, FloatArray], error: float) -> ObservedSizes:
        """Root mean square differences (sizes) between models and the observed celestial pole.

        Parameters
        ----------
        models : mapping of str to ndarray, shape (t, 2)
            Each model minus IAU 2006/2000A at all dates of the series, as dpsi sin(eps0) and deps.
        error : float
            95 % half-width of a residual of the models.
        """
        series = {IAU: np.zeros((self.rows.size, 2)), **models}
        residual = np.stack([model[self.rows] - self.offsets for model in series.values()], axis=1)
        without_core = residual + self.core[:, np.newaxis]

        def rms(values: FloatArray, line: bool) -> FloatArray:
            if line:
                flat = values.reshape(self.days.size, -1)
                values = without_line(self.days / DAYS_PER_CENTURY, flat).reshape(values.shape)
            return np.asarray(np.sqrt(np.mean(values**2, axis=0)))

        return ObservedSizes(
            observed_rms=rms(residual, True),
            observed_rms_unfitted=rms(residual, False),
            observed_rms_without_core=rms(without_core, True),
            observed_rms_without_core_unfitted=rms(without_core, False),
            observed_size_error=error,
            observed_dates=self.days.size,
            model=list(series),
        ).with_attributes(observed_rms={"references": "IERS C04, from 1990"})


@part(unless=not_observed_then)
def observed_sky(epochs: Epochs) -> ObservedSky:
    """Interpolate the observed celestial pole offsets and their free core nutation to the dates."""
    table = observed_series()
    time = table.mjd - MJD
    days = times.days_of(epochs)
    rows = (days >= FIRST_DAY) & (days <= time[-1])
    days = days[rows]
    offsets = np.stack([np.interp(days, time, axis) for axis in (table.x, table.y)], axis=1)
    core = core_nutation.fit(time, table.offsets).at(days)
    circles = np.stack([core.real, core.imag], axis=1)
    return ObservedSky(rows, days, offsets, circles, table.provenance)


_RMS = "root mean square of the model minus the observed celestial pole"
_LINE = "a constant and a rate removed"
_CORE = "the free core nutation, fitted to the observed offsets, removed"
_AS_RETURNED = "nothing removed"
_OF_FIT = "observed_size_error applies after removal of a constant and a rate"


class ObservedSizes(Variables, along=("model", "direction"), error="observed_size_error"):
    """Root mean square of the differences between models and the observed celestial pole."""

    observed_rms = number("mas", f"{_RMS}, {_LINE}", short="rms")
    observed_rms_without_core = number("mas", f"{_RMS}, {_LINE}, {_CORE}", short="rms without FCN")
    observed_rms_unfitted = number(
        "mas", f"{_RMS}, {_AS_RETURNED}", short="rms as returned", no_error=_OF_FIT
    )
    observed_rms_without_core_unfitted = number(
        "mas", f"{_RMS}, {_CORE}", short="rms as returned, without FCN", no_error=_OF_FIT
    )
    observed_size_error = number(
        "mas",
        "95 % half-width of a residual of the model, from H and integration; the noise of the "
        "observations is in each rms",
        along=(),
    )
    observed_dates = number("1", "dates compared", along=(), no_error="a count")
    model = labels()
    direction = labels(default=["dpsi_sineps", "deps"])
