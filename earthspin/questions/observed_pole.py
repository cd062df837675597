"""Observed pole: tables of the IERS, and comparison of models with the observed celestial pole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from os import PathLike
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray

from earthspin._lazy import xr
from earthspin.bodies import EARTH, Body, in_a_sentence
from earthspin.constants import DAY, DAYS_PER_CENTURY, J2000_JD, MAS
from earthspin.dates import Epochs, Span, datetime64, days
from earthspin.engine import Question, Variables, key, labels, measured, number, part, setting, si
from earthspin.engine.variables import IN_ANSWERS
from earthspin.errors import SceneError, Where
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation import core_nutation
from earthspin.nutation.analysis import without_line
from earthspin.questions import reasons, time_axes
from earthspin.sky import eop
from earthspin.sky.eop import GivenSeries, PoleSeries
from earthspin.sky.pole_tables import NAMES
from earthspin.tables import DATES, FRAME, column_of, is_frame, is_table, places, series_of
from earthspin.units import FileName, Plain, Text, pack, unpack
from earthspin.wobble import excitation
from earthspin.wobble.excitation import pole_of

#: Smallest and largest plausible value of the largest distance from the conventional pole, mas.
SMALLEST, LARGEST = 0.1, 2000.0
#: Why errors of a table may be NaN.
NO_ERRORS = "the table gives no errors"
#: Description of the key `file`.
FILE_DOC = (
    "table that astropy carries, a file of the IERS, CelesTrak or JPL, or a Dataset or pandas table"
)
#: Description of the key `columns`.
COLUMNS_DOC = (
    "names and units of all columns of a file, like 'mjd, x (mas), y (mas), ...'; by its header or "
    "layout if not given"
)
#: Name of the daily table C04 of the IERS, which astropy includes.
C04 = "c04"


@dataclass(frozen=True)
class GivenTable:
    """Kind of input: two time series, such as x and y, in a Dataset or a pandas table.

    Attributes
    ----------
    names : tuple of str
        Names of the numbers.
    units : tuple of str
        Allowed units.
    """

    names: tuple[str, str] = ("x", "y")
    units: tuple[str, ...] = ("arcsec", "mas")

    words = "a Dataset, as polar_motion or read_excitation returns, or a pandas table"
    hint = "xr.Dataset | pd.DataFrame"

    def read(self, value: Any, where: Where) -> Any:
        """Extract two time series (and errors) from a table, or restore them from an input file."""
        if isinstance(value, GivenSeries):
            return value
        if isinstance(value, dict):
            return GivenSeries(unpack(value, where))
        if not hasattr(value, "data_vars") and not is_frame(value):
            raise where.error(value, f"it is {self.words}")
        table, (x, y) = _labelled(value), self.names
        rows = [*labelled_series(table, self.names, self.units)]
        if f"{x}_error" in table and f"{y}_error" in table:
            rows += labelled_series(table, (f"{x}_error", f"{y}_error"), self.units)[1:]
        known = np.array(rows)[:, np.isfinite(rows[1:3]).all(axis=0)]
        time, *values = known if np.isfinite(known).all() else known[:3]
        return GivenSeries(np.array([time, *np.divide(values, MAS)]))

    def write(self, value: Any) -> Plain:
        """Value stored in scene (input) files: rows as bytes, or the name or path of a table."""
        return pack(value.rows) if isinstance(value, GivenSeries) else value


class PoleInput(GivenTable, FileName):
    """Kind of input: a table of the pole, by name, by path, or as a Dataset or pandas table."""

    words = '"c04", "finals", the path of a file, or a Dataset or pandas table'
    hint = "str | PathLike[str] | xr.Dataset | pd.DataFrame"
    known = tuple(eop.CARRIED)
    content = "a table of polar motion"

    def read(self, value: Any, where: Where) -> Any:
        """Check the name or path of a table of the pole, or convert a table given in Python."""
        by_name = isinstance(value, (str, PathLike))
        return FileName.read(self, value, where) if by_name else super().read(value, where)

    def begins(self, head: bytes) -> bool:
        """Return True if a file with the first bytes `head` may be a table of the pole."""
        return is_table(head)


class OfTable(Question, positional=("start", "stop")):
    """Base class of computations that use a table of the observed pole."""

    body: Body = key(EARTH, doc="body whose pole was observed")
    span: Span | None = key(None, doc="first and last date; the whole table if not given")
    file: Annotated[eop.PoleTable, PoleInput()] = setting(C04, doc=FILE_DOC)
    kind: Literal["c04", "c01", "finals2000A"] | None = setting(
        None, doc="layout of the table; recognised from the file if not given"
    )
    columns: Annotated[str, Text()] | None = setting(None, doc=COLUMNS_DOC)


class Daily(Variables, along=("time",)):
    """Base class of time series from a table of the observed pole, and of forecast time series."""

    time = labels("time", standard_name="time", comment="0h UTC in daily tables")


class DailyPole(Daily):
    """Base class of coordinates x and y of the pole, observed or forecast."""

    x = measured("arcsec", "coordinate of the pole towards the prime meridian", shown="mas")
    y = measured("arcsec", "coordinate of the pole towards 90 degrees west", shown="mas")


def no_observed_pole(body: Body) -> str | None:
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
    return series.between(*mjd_span(span)) if span else series


def mjd_span(span: Span | None) -> tuple[float, float]:
    """First and last modified Julian date of a span; infinite if none is given."""
    return (span.days[0] + eop.MJD, span.days[1] + eop.MJD) if span else eop.ALL


def complex_pole(pole: xr.Dataset) -> tuple[FloatArray, ComplexArray]:
    """Convert polar motion in a Dataset to days from J2000.0 and complex numbers x - i y, mas.

    Raises
    ------
    SceneError
        If there are no x and y with units along time, or the days are not ascending.
    """
    time, x, y = labelled_series(pole, ("x", "y"), ("arcsec", "mas"))
    p = pole_of(x, y) / MAS
    largest = float(np.max(abs(p)))
    if largest > LARGEST or 0 < largest < SMALLEST:
        problem = f"polar motion is {SMALLEST:g} to {LARGEST:g} mas at its largest; check the unit"
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
    series = _labelled(series)
    variables = [*map(str, getattr(series, "data_vars", ()))]
    for name in names:
        if name not in variables or series[name].dims != ("time",):
            problem = f"give a Dataset with '{name}' along 'time', or a table with that column"
            raise SceneError("series", variables or type(series).__name__, problem)
        unit, kind = str(series[name].attrs.get("units")), series[name].dtype
        if kind.kind != "f" or series["time"].dtype.kind != "M":
            raise SceneError(name, str(kind), "give numbers along dates without a zone")
        if IN_ANSWERS.get(unit, unit) not in units:
            allowed = " or ".join(f"'{u}'" for u in units)
            problem = f"set attrs['units'] to {allowed}, or name the column '{name} ({units[0]})'"
            raise SceneError(f"units of {name}", unit, problem)
    if series.time.size < 2:
        raise SceneError("time", f"{series.time.size} days", "give two or more")
    time = days(series.time, Where("time"))
    backward = np.diff(time) <= 0
    if np.any(backward):
        problem = "times are not ascending: use ds.sortby('time') and ds.drop_duplicates('time')"
        raise SceneError("time", str(series.time.values[1:][backward][0]), problem)
    first, second = (si(series[name]).values for name in names)
    return time, first, second


def refuse_other_excitation(time: FloatArray, p: ComplexArray, chi: ComplexArray) -> None:
    """Refuse an excitation that agrees with the pole only if chi1 and chi2 mean something else.

    Raises
    ------
    SceneError
        It gives the other meaning.
    """
    if other := excitation.other_meaning(time, p, chi):
        words, ratio = other
        problem = f"they agree with the pole as '{words['chi1']}' and '{words['chi2']}'"
        size = f"they are {ratio:.1g} times what moves the pole; are they in mas?"
        same = words == {"chi1": "chi1", "chi2": "chi2"}
        raise SceneError("excitation", "its chi1 and chi2", size if same else problem)


#: Names of variables in a Dataset for those of columns.
_VARIABLES = {"dx": "dX", "dy": "dY", "e_x": "x_error", "e_y": "y_error"}
_VARIABLES |= {"e_dx": "dX_error", "e_dy": "dY_error"}
_COLUMNS = NAMES | {name: (name,) for name in ("chi1", "chi2")}


def _labelled(table: Any) -> Any:
    """Convert a table of pandas or polars to a Dataset along `time`; return all else unchanged.

    Raises
    ------
    SceneError
        If it has no dates.
    """
    if not is_frame(table):
        return table
    frame = table.reset_index() if hasattr(table, "iloc") else table
    names = [str(name) for name in frame.columns]
    time = _times_of(frame, names)
    attributes = getattr(table, "attrs", {})
    quantities = {place: quantity for quantity, place in places(FRAME, names, _COLUMNS).items()}
    columns = {}
    for place, name in enumerate(names):
        column, values = column_of(name), series_of(frame, place).to_numpy()
        if place in quantities:
            name = _VARIABLES.get(quantities[place], quantities[place])
        if values.dtype.kind == "f":
            units = {"units": column.unit or attributes.get("units")}
            columns[name] = ("time", column.sign * values, units)
    return xr.Dataset(columns, {"time": time.astype("datetime64[us]")}, attributes)


def _times_of(frame: Any, names: list[str]) -> NDArray[np.datetime64]:
    """Times of the rows of a table: dates of any kind, or modified Julian dates.

    Raises
    ------
    SceneError
        If there are none.
    """
    known = places(FRAME, names, DATES)
    for place, name in enumerate(names):
        column = series_of(frame, place)
        if str(column.dtype).startswith("period"):
            column = column.dt.to_timestamp()
        elif getattr(column.dtype, "tz", None) is not None:
            column = column.dt.tz_convert(None)
        values = column.to_numpy()
        if values.dtype.kind == "M":
            return np.asarray(values)
        text = place == known.get("date") and values.dtype.kind in "OUT"
        if text or hasattr(values.flat[0] if values.size else None, "calendar"):
            return datetime64(days([*values], Where(name)))
    for word, first in (("mjd", eop.MJD), ("jd", J2000_JD)):
        if word in known:
            return datetime64(series_of(frame, known[word]).to_numpy().astype(float) - first)
    problem = "give dates as its index, or in a column 'time', or a column 'MJD'"
    raise SceneError("columns", names, problem)


# --- models beside the observed pole -------------------------------------------------------------


#: First day of comparisons, 1990, in days from J2000.0. The stated errors of earlier offsets are
#: 0.4 to 0.6 mas a day, larger than the error of IAU 2006/2000A.
FIRST_DAY = 47892.0 - eop.MJD
#: Smallest number of dates that are compared.
FEWEST = 10
#: Name of IAU 2006/2000A among the models.
IAU = "iau"


@cache
def observed_series() -> PoleSeries:
    """Observed celestial pole offsets of the IERS series C04."""
    return eop.read_pole_offsets()


def not_observed_then(span: Span, step: float) -> str | None:
    """Return the reason (text) to omit the comparison if too few dates are observed, else None."""
    first, last = span.days
    first, last = max(first, FIRST_DAY), min(last, float(observed_series().mjd[-1]) - eop.MJD)
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
    """Observed celestial pole offsets, and free core nutation fitted to them, at given dates."""
    table = observed_series()
    time = table.mjd - eop.MJD
    days = time_axes.days_of(epochs)
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
