"""Forecast of polar motion, and of UT1 and the length of day."""

from __future__ import annotations

import datetime as dt
import json
import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import EARTH, Body, orbit
from earthspin.constants import DAY, MAS, NORMAL_95
from earthspin.dates import SPACING, TABLES, date_text, datetime64, days
from earthspin.engine import Neglected, Question, Run, key, part, public_call
from earthspin.engine.variables import Variables, labels, measured, number, si, words
from earthspin.errors import SceneError, SeriesError, Where
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation import core_nutation
from earthspin.questions.observed_pole import (
    COLUMNS_DOC,
    FILE_DOC,
    Daily,
    DailyPole,
    GivenTable,
    PoleInput,
    refuse_other_excitation,
)
from earthspin.questions.reasons import no_iau_model
from earthspin.questions.rotation_ahead import RotationAhead, no_universal_time, rotation_ahead
from earthspin.sky import eop
from earthspin.sky.eop import MJD, GivenSeries, PoleSeries
from earthspin.sky.universal_time import leap_seconds, read_universal_time, tai_minus_utc
from earthspin.units import Number, Plain, Text
from earthspin.wobble import forecast as model
from earthspin.wobble import ut1_forecast as ut1_model

if TYPE_CHECKING:
    from earthspin.engine.accessor import Answer
    from earthspin.sky.iers_table import PoleTable

#: How far a date may be from midnight, d.
_MIDNIGHT = 1e-6


class Day(orbit.Epoch):
    """Kind of input: a calendar day, which a scene (input) file stores as a date."""

    words, hint = 'a date, or "today"', "Date | float"

    def read(self, value: object, where: Where) -> float:
        """Convert a date to days from J2000.0 to 0h of that date; "today" is the UTC date."""
        day = today() if isinstance(value, str) and value == "today" else super().read(value, where)
        return float(np.floor(day + 0.5 + _MIDNIGHT)) - 0.5

    def write(self, value: float) -> Plain:
        """Convert days from J2000.0 to the text of a date."""
        return date_text(value)


#: Age of a table, d, from which a user is warned that the forecast begins in the past.
OLD = 7.0


def today() -> float:
    """Present day in UTC, days from J2000.0."""
    return float(days(dt.datetime.now(dt.UTC).date(), Where("today"))[0])


class Forecast(
    Question, word="forecast", call="forecast", positional=("days", "step", "origin", "file")
):
    """Forecast of polar motion with its 95 % half-widths.

    Only observed rows up to the origin are used, except for UT1: its first seven days are those of
    Bulletin A if `bulletin_a` is true, the table has them, and the origin is its newest observed
    day. The attributes of `time` name that day.

    The first time of the answer is a step after `start`.

    Raises
    ------
    EarthspinError
        If the table has gaps or less than 15 years before the origin, if the origin is outside
        it, or if the start precedes the origin or the end is more than 730 days after it.

    Examples
    --------
    >>> import earthspin
    >>> ahead = earthspin.forecast(30, origin="2020-01-01", file="c04")
    >>> last = ahead.isel(time=-1)
    >>> print(f"{last.x:.3f} ± {last.x_error:.3f}, {last.y:.3f} ± {last.y_error:.3f} arcsec")
    0.043 ± 0.016, 0.311 ± 0.009 arcsec
    """

    page, headline = "forecast", "x"

    body: Body = key(EARTH, doc="body whose pole is forecast")
    days: Annotated[float, Number("d", "365 d", above=0.0)] = key(
        365.0,
        doc="days after `start`; the last is at most 730 days after the newest observed one",
    )
    step: Annotated[float, replace(SPACING, example="1 d")] = key(
        "1 d", doc="time between two epochs, a whole number of days"
    )
    origin: Annotated[float, orbit.Epoch()] | None = key(
        None, doc="last day whose observation is used; the newest observed day if not given"
    )
    start: Annotated[float, Day()] | None = key(
        None, doc="day after which the forecast begins; the last observed day used if not given"
    )
    file: Annotated[eop.PoleTable, PoleInput()] = key("finals", doc=FILE_DOC)
    columns: Annotated[str, Text()] | None = key(None, doc=COLUMNS_DOC)
    parameters: Literal["shipped", "fitted"] | None = key(
        None,
        doc="parameters of the fast excitation: shipped, or fitted before the origin; "
        "shipped by default, and always fitted with an excitation",
    )
    bulletin_a: bool = key(
        True, doc="true to take the first seven days of UT1 from Bulletin A, if the table has them"
    )
    excitation: Annotated[GivenSeries, GivenTable(("chi1", "chi2"), ("mas",))] | None = key(
        None, doc="excitation by air, water and ground, observed and forecast: daily means"
    )

    def check(self) -> None:
        """Require a step of whole days, and fitted parameters if an excitation is given."""
        if self.excitation is not None and self.parameters == "shipped":
            problem = "with an excitation they are fitted; leave parameters out"
            raise SceneError("parameters", self.parameters, problem)
        step = self.step / DAY
        if step != round(step) or self.days < step:
            raise SceneError("step", f"{step:g} d", "give whole days, at most as many as `days`")


@part(unless=no_iau_model)
def record(file: eop.PoleTable, columns: str | None, origin: float | None) -> PoleSeries:
    """Read observed polar motion up to the forecast's origin; refuse a series that is not daily."""
    table = eop.read_polar_motion(file, columns=columns)
    if "bridged" in table.repairs or abs(table.step - 1) > _MIDNIGHT:
        steps = table.repairs if "bridged" in table.repairs else f"steps of {table.step:g} d"
        raise SceneError("file", table.source, f"{steps}; a forecast needs a row for each day")
    if origin is None:
        return table
    first, last = table.mjd[[0, -1]] - MJD
    if not first <= origin < last + 1:
        problem = f"the observed rows cover {date_text(first)} to {date_text(last)}"
        raise SceneError("origin", date_text(origin), f"{problem}; choose a day inside")
    return table.between(table.mjd[0], origin + MJD + _MIDNIGHT)


@part
def output_days(record: PoleSeries, days: float, step: float, start: float | None) -> slice:
    """Slice that selects the requested days of a daily forecast: one day per `step`."""
    newest = float(record.mjd[-1]) - MJD
    gap, every = 0 if start is None else round(start - newest), round(step / DAY)
    if not 0 <= gap <= model.LONGEST - days:
        name, value = ("start", date_text(newest + gap)) if gap else ("days", f"{days:g} d")
        problem = f"the last observed day used is {date_text(newest)}; start then or later, "
        raise SceneError(name, value, f"{problem}and end {model.LONGEST} d after it at the latest")
    return slice(gap + every - 1, gap + int(days), every)


def _times(record: PoleSeries, output_days: slice) -> FloatArray:
    """Times of the forecast values, days from J2000.0."""
    days: FloatArray = np.arange(1.0, output_days.stop + 1)[output_days]
    return days + float(record.mjd[-1]) - MJD


@part(loads=("scipy.linalg",))
def prediction(
    record: PoleSeries, output_days: slice, parameters: str | None, excitation: GivenSeries | None
) -> model.PredictedPole:
    """Predict polar motion and the covariance of its error for each day after the origin."""
    if excitation is not None:
        pole, chi = _from_common_day(record, excitation)
        return model.forecast_with_excitation(pole, chi, output_days.stop, record.newest)
    fast = model.fit(record.pole) if parameters == "fitted" else model.SHIPPED
    return model.forecast(record.pole, output_days.stop, fast, newest=record.newest)


def _from_common_day(
    record: PoleSeries, excitation: GivenSeries
) -> tuple[ComplexArray, ComplexArray]:
    """Cut the series of pole and excitation so that both start on the first common day.

    Raises
    ------
    SceneError
        If the excitation is not a series of daily means from one day of the pole to the next.
    """
    middles, chi1, chi2 = excitation.rows
    before = middles[0] - 0.5 - (record.mjd[0] - MJD)  # days without excitation
    uneven = abs(np.diff(middles) - 1).max(initial=0.0) > _MIDNIGHT
    if uneven or abs(before - round(before)) > _MIDNIGHT:
        means = f"means about {', '.join(map(str, datetime64(middles[:2])))} and so on"
        problem = "give the mean of each day; read_excitation(..., daily=True) makes it, 0h to 0h"
        raise SceneError("excitation", means, problem)
    skipped = round(before)
    start, pole, chi = max(skipped, 0), record.pole, chi1 + 1j * chi2
    pole, chi = pole[start:], chi[max(-skipped, 0) :]
    both = min(pole.size - 1, chi.size)
    refuse_other_excitation(record.mjd[start : start + both + 1], pole[: both + 1], chi[:both])
    return pole, chi


class ForecastPole(DailyPole):
    """Forecast coordinates x and y of the pole, with half-widths and correlation of errors."""

    correlation_xy = number(
        "1", "correlation of the errors of x and y", no_error="it belongs to the errors"
    )


@part
def forecast_pole(
    record: PoleSeries,
    prediction: model.PredictedPole,
    output_days: slice,
    parameters: str | None,
    origin: float | None,
    start: float | None,
    excitation: GivenSeries | None,
) -> ForecastPole:
    """Return the forecast x and y of the pole, with half-widths and correlation of errors."""
    newest = date_text(float(record.mjd[-1]) - MJD)
    fast = ", ".join(f"{name} = {value:.4g}" for name, value in vars(prediction.fast).items())
    kind = parameters or ("shipped" if excitation is None else "fitted")
    p, covariance = prediction.pole[output_days] * MAS, prediction.covariance[output_days] * MAS**2
    sx, sy = np.sqrt(covariance[:, 0, 0]), np.sqrt(covariance[:, 1, 1])
    day = origin if start is None else start
    source = {
        "references": record.source,
        "comment": f"observations up to {newest}",
        "origin": newest if origin is None else date_text(origin),
        "newest_row": newest,
        "parameters": f"{kind}: {fast}",
    }
    if record.newest:
        bias = f"{abs(model.NEWEST_BIAS.imag):.3f} mas, its measured bias"
        source["newest_row_corrected"] = f"{bias}, subtracted from y"
    if excitation is not None:
        first, last = map(date_text, excitation.rows[0, [0, -1]])
        source["excitation"] = f"given from {first} to {last}"
    newer = f"for newer rows: pip install --upgrade {TABLES}, or give a file"
    age = today() + MJD - float(record.mjd[-1])
    if day is None and age > OLD:
        begun = f"days count from the newest row of the table, which is {age:.0f} d old"
        warnings.warn(f"{begun}; start='today' counts from today; {newer}", stacklevel=2)
    time = {"comment": f"0h UTC; {newer}", "newest_row": newest} if origin is None else {}
    if day is not None:  # otherwise the age is that of the day on which an answer is printed
        time["age_of_newest_row"] = f"{day + MJD - record.mjd[-1]:.0f} d on {date_text(day)}"
    return ForecastPole(
        time=datetime64(_times(record, output_days)),
        x=(p.real, NORMAL_95 * sx),
        y=(-p.imag, NORMAL_95 * sy),
        correlation_xy=covariance[:, 0, 1] / (sx * sy),
    ).with_attributes(x=source, y=source, time=time)


_IS_ERROR = "it is an error itself"


class Components(Daily):
    """Components of the forecast: Chandler, annual and semiannual wobble, slowly moving pole."""

    component_x = measured("mas", "part of x", along=("component", "time"))
    component_y = measured("mas", "part of y", along=("component", "time"))
    component = labels(default=list(model.COMPONENTS))


def not_separated(excitation: GivenSeries | None) -> str | None:
    """Return the reason (text) to omit the components if an excitation is given, else None."""
    reason = "the pole that a given excitation drives is not separated into components"
    return None if excitation is None else reason


@part(unless=not_separated)
def components(
    record: PoleSeries, prediction: model.PredictedPole, output_days: slice
) -> Components:
    """Compute the forecast Chandler, annual and semiannual wobbles and slow pole, with errors."""
    p = np.array([values[output_days] for values in prediction.components.values()]) * MAS
    variance = np.array([values[output_days] for values in prediction.component_variance.values()])
    half_width = NORMAL_95 * np.sqrt(variance) * MAS
    return Components(
        time=datetime64(_times(record, output_days)),
        component_x=(p.real, half_width[..., 0]),
        component_y=(-p.imag, half_width[..., 1]),
    )


@part(unless=no_universal_time, loads=("scipy.interpolate", "scipy.linalg"))
def rotation(
    file: eop.PoleTable,
    columns: str | None,
    record: PoleSeries,
    output_days: slice,
    bulletin_a: bool,
) -> RotationAhead:
    """Predict UT1 and the length of day for each day after the last observed UT1."""
    assert not isinstance(file, GivenSeries)
    table, last = read_universal_time(file, columns), float(record.mjd[-1])
    return rotation_ahead(table, last, last + output_days.stop, bulletin_a)


class ForecastRotation(Daily):
    """Forecast UT1 and length of day, and the error of a direction from UT1 and polar motion."""

    ut1_utc = measured("s", "UT1 - UTC")
    ut1_tai = measured("s", "UT1 - TAI")
    length_of_day = measured("ms", "excess of the length of day over 86400 s")
    ut1_source = words("source of UT1")
    direction_error = number(
        "mas",
        "largest 95 % half-width of a direction between sky and ground, from UT1 and polar motion",
        no_error=_IS_ERROR,
        closing="direction with UT1",
    )
    ground_error = number(
        "m", "the same on the ground at the equator", no_error=_IS_ERROR, closing="at the equator"
    )


@part
def universal_time(
    body: Body,
    record: PoleSeries,
    rotation: RotationAhead,
    output_days: slice,
    forecast_pole: xr.Dataset,
) -> ForecastRotation:
    """Return forecast UT1 and length of day with errors, and the error of a direction."""
    time = _times(record, output_days)
    rows = np.round(time + MJD - rotation.mjd[0]).astype(int)
    ut1, half = rotation.ut1_minus_tai[:, rows]
    pole = np.hypot(si(forecast_pole.x_error).values, si(forecast_pole.y_error).values)
    direction = np.hypot(pole, 2 * np.pi / body.needed("spin_period") * half)
    source = _source(record.source, rotation.observed.mjd)
    source["comment"] += "; with zonal tides, without those of a day or less"
    _, end = leap_seconds()
    announced = {"leap_seconds": f"if none comes after {end}, where their list ends"}
    return ForecastRotation(
        time=datetime64(time),
        ut1_utc=(ut1 + tai_minus_utc(time + MJD), half),
        ut1_tai=(ut1, half),
        length_of_day=tuple(rotation.length_of_day[:, rows]),
        ut1_source=np.where(rotation.from_bulletin_a[rows], "Bulletin A", "forecast"),
        direction_error=direction,
        ground_error=body.needed("radius") * direction,
    ).with_attributes(ut1_utc=source | announced, ut1_tai=source, length_of_day=source)


_COUNTED = "counted over the origins of the table"


class Skill(Variables, along=("case", "coordinate"), no_error="the size of errors themselves"):
    """Measured errors of past forecasts of polar motion, by number of days after the origin."""

    mean_absolute_error = number("mas", "mean absolute error of the forecast", short="MAE")
    root_mean_square = number("mas", "root mean square error of the forecast", short="RMS")
    coverage = number(
        "1", "share of 95 % intervals that contain the observed pole", no_error=_COUNTED
    )
    other_mean_absolute_error = number(
        "mas",
        "mean absolute error of Bulletin A on the same releases, or of least squares with "
        "autoregression on the same origins",
        short="other MAE",
    )
    skill_set = words("table and origins", along=("case",))
    horizon = number("d", "days after the origin", along=("case",), no_error="it is chosen")
    origins = number("1", "number of origins", along=("case",), no_error=_COUNTED)
    case = labels()
    coordinate = labels(default=["x", "y"])


def _column(table: list[dict[str, Any]], name: str) -> FloatArray:
    """Numbers of one column of a table of skill."""
    return np.array([row[name] for row in table], dtype=float)


class Ut1Skill(Variables, along=("ut1_case",), no_error="the size of errors of UT1 and of the day"):
    """Measured errors of past forecasts of UT1, by number of days after the origin."""

    ut1_mean_absolute_error = number("ms", "mean absolute error of UT1")
    ut1_root_mean_square = number("ms", "root mean square error of UT1")
    ut1_coverage = number(
        "1", "share of 95 % intervals that contain the observed UT1", no_error=_COUNTED
    )
    ut1_other_mean_absolute_error = number(
        "ms", "mean absolute error of UT1 of the other forecast, as in other_mean_absolute_error"
    )
    length_of_day_mean_absolute_error = number("ms", "mean absolute error of the length of day")
    length_of_day_coverage = number(
        "1",
        "share of 95 % intervals that contain the observed length of day",
        no_error=_COUNTED,
    )
    ut1_skill_set = words("table and origins")
    ut1_horizon = number("d", "days after the origin", no_error="it is chosen")
    ut1_origins = number("1", "number of origins", no_error=_COUNTED)
    ut1_case = labels()


@part
def ut1_skill() -> Ut1Skill:
    """Return measured errors of forecasts of UT1 and the length of day."""
    table = json.loads(ut1_model.SKILL.read_text(encoding="utf-8"))
    return Ut1Skill(
        ut1_mean_absolute_error=_column(table, "mae") / 1e3,
        ut1_root_mean_square=_column(table, "rms") / 1e3,
        ut1_coverage=_column(table, "coverage"),
        ut1_other_mean_absolute_error=_column(table, "other_mae") / 1e3,
        length_of_day_mean_absolute_error=_column(table, "day_mae") / 1e3,
        length_of_day_coverage=_column(table, "day_coverage"),
        ut1_skill_set=[row["set"] for row in table],
        ut1_horizon=_column(table, "horizon") * DAY,
        ut1_origins=_column(table, "origins"),
        ut1_case=[f"{row['set']}, {row['horizon']} d" for row in table],
    )


@part
def skill() -> Skill:
    """Return measured errors of forecasts, from hindcasts and from releases of IERS tables."""
    table = json.loads(model.SKILL.read_text(encoding="utf-8"))

    return Skill(
        mean_absolute_error=_column(table, "mae") * MAS,
        root_mean_square=_column(table, "rms") * MAS,
        coverage=_column(table, "coverage"),
        other_mean_absolute_error=_column(table, "other_mae") * MAS,
        skill_set=[row["set"] for row in table],
        horizon=_column(table, "horizon") * DAY,
        origins=_column(table, "origins"),
        case=[f"{row['set']}, {row['horizon']} d" for row in table],
    )


_NO_SUM = "the errors of both are correlated, as both use the same observations"


class BulletinA(Daily):
    """Polar motion x and y as predicted in Bulletin A of the IERS."""

    bulletin_a_x = measured("arcsec", "x predicted by Bulletin A", shown="mas")
    bulletin_a_y = measured("arcsec", "y predicted by Bulletin A", shown="mas")
    x_minus_bulletin_a = number("arcsec", "x minus Bulletin A", shown="mas", no_error=_NO_SUM)
    y_minus_bulletin_a = number("arcsec", "y minus Bulletin A", shown="mas", no_error=_NO_SUM)


def not_in_file(
    file: eop.PoleTable,
    columns: str | None,
    origin: float | None,
    start: float | None,
    days: float,
) -> str | None:
    """Return the reason (text) to omit Bulletin A if it lacks the requested forecast, else None."""
    if origin is not None:
        return "Bulletin A predicts from the newest observed day; leave origin out"
    if (table := None if columns else eop.read_bulletin_a(file)) is None:
        return "the table holds no predictions of Bulletin A"
    last = table.mjd[0] - 1 if start is None else start + MJD
    if table.mjd[-1] < last + int(days):
        return f"Bulletin A ends on {date_text(table.mjd[-1] - MJD)}; end the forecast by then"
    return None


@part(unless=not_in_file)
def predicted_by_bulletin_a(
    file: eop.PoleTable, output_days: slice, forecast_pole: xr.Dataset
) -> BulletinA:
    """Read polar motion predicted by Bulletin A, with 95 % half-widths, and compare it."""
    table = eop.read_bulletin_a(file)
    assert table is not None
    return BulletinA(
        time=datetime64(table.mjd[output_days] - MJD),
        bulletin_a_x=(table.x[output_days], NORMAL_95 * table.x_error[output_days]),
        bulletin_a_y=(table.y[output_days], NORMAL_95 * table.y_error[output_days]),
        x_minus_bulletin_a=si(forecast_pole.x).values - table.x[output_days],
        y_minus_bulletin_a=si(forecast_pole.y).values - table.y[output_days],
    )


def _source(table: str, mjd: FloatArray) -> dict[str, str]:
    """Attributes of a forecast from the rows of a table."""
    newest = date_text(mjd[-1] - MJD)
    comment = f"observations up to {newest}"
    return {"references": table, "comment": comment, "newest_row": newest}


class ForecastOffsets(Daily):
    """Forecast of the celestial pole offsets."""

    dX = measured("mas", "X of the celestial pole minus that of IAU 2006/2000A")
    dY = measured("mas", "Y of the celestial pole minus that of IAU 2006/2000A")


def offsets_until(file: eop.PoleTable, columns: str | None, last: float | None) -> PoleSeries:
    """Read the observed celestial pole offsets of a table, up to a last day if one is given."""
    table = eop.read_pole_offsets(file, columns=columns)
    return table if last is None else table.between(table.mjd[0], last + MJD)


def predicted_offsets(table: PoleSeries, mjd: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Predict celestial pole offsets and their half-widths at given dates, shape (n, 2) each."""
    return core_nutation.predict(table.mjd, table.x, table.y, table.x_error, table.y_error, mjd)


def no_offsets(
    file: eop.PoleTable,
    columns: str | None,
    origin: float | None,
    start: float | None,
    days: float,
) -> str | None:
    """Return the reason (text) to omit pole offsets if they cannot be forecast, else None."""
    if isinstance(file, GivenSeries):
        return "polar motion has no celestial pole offsets; name a table"
    try:
        table = offsets_until(file, columns, origin)
        pole = eop.read_polar_motion(file, columns=columns)
        newest = pole.mjd[-1] if origin is None else np.floor(origin + MJD)
    except SeriesError as error:
        return str(error)
    if "bridged" in table.repairs or np.isnan(table.x_error).any():
        return "the table lacks days or errors of celestial pole offsets"
    longest = (newest if start is None else start + MJD) + int(days) - table.mjd[-1]
    if longest > core_nutation.LONGEST:
        return f"the last offset is {newest - table.mjd[-1]:.0f} d older than the origin"
    return core_nutation.too_short(table.mjd.size, longest)


@part(unless=no_offsets, loads=("scipy.signal",))
def pole_offsets(
    file: eop.PoleTable, columns: str | None, record: PoleSeries, output_days: slice
) -> ForecastOffsets:
    """Forecast celestial pole offsets from offsets observed up to the origin of the forecast."""
    table = offsets_until(file, columns, float(record.mjd[-1]) - MJD)
    time = _times(record, output_days)
    value, error = (pair.T for pair in predicted_offsets(table, time + MJD))
    source = _source(table.source, table.mjd)
    return ForecastOffsets(
        time=datetime64(time), dX=(value[0], error[0]), dY=(value[1], error[1])
    ).with_attributes(dX=source, dY=source)


@part
def neglected(excitation: GivenSeries | None) -> Neglected:
    """Effects that the forecast neglects."""
    momentum = "forecasts of the angular momentum of air, water and ground, but for those in the "
    momentum += "first seven days of UT1 of Bulletin A"
    if excitation is not None:
        momentum = (
            "errors of a forecast of the excitation beyond those of its values up to the origin"
        )
    tides = "tides of a day and of half a day, which tables leave out by convention"
    return Neglected(unknown=f"{momentum}; {tides}")


forecast = public_call(
    Forecast,
    answer=forecast_pole,
    sections={
        "components": components,
        "skill": (skill, ut1_skill),
        "bulletin_a": predicted_by_bulletin_a,
        "pole_offsets": pole_offsets,
        "universal_time": universal_time,
        Neglected.PART: neglected,
    },
    parts=(record, output_days, prediction, rotation),
)


def to_iers_table(answer: Answer) -> PoleTable:
    """Convert a forecast to an astropy table of Earth orientation parameters.

    Polar motion, celestial pole offsets and UT1 - UTC are observed up to the origin and forecast
    after it, day by day and without errors. UT1 - UTC is that of finals2000A, which may have been
    observed later, if the table has none to forecast. Dates outside the table are refused, even
    if astropy would only warn.

    Parameters
    ----------
    answer : Answer
        Accessor of the forecast, of which this is a method.

    Returns
    -------
    astropy.utils.iers.IERS_A

    Raises
    ------
    SceneError
        If the answer is not a forecast, if the forecast used polar motion without a table, or
        if it reaches farther than UT1 - UTC.

    Examples
    --------
    >>> import earthspin
    >>> from astropy.utils import iers
    >>> table = earthspin.forecast(90).earthspin.to_iers_table()
    >>> with iers.earth_orientation_table.set(table):
    ...     pass  # transformations of astropy.coordinates
    >>> print(table["PM_x"].unit)
    arcsec
    """
    question = answer.scene
    if not isinstance(question, Forecast):
        problem = f"an answer of '{question.word}' has no table; give one of 'forecast'"
        raise SceneError("to_iers_table", question.word, problem)
    from earthspin.sky.iers_table import last_ut1, with_orientation

    file = question.file
    if isinstance(file, GivenSeries):
        raise SceneError("file", "polar motion", "name a table, which has celestial pole offsets")
    run = Run(question)
    observed: PoleSeries = run["record"]
    last = observed.mjd[-1] + run["output_days"].stop
    offsets = offsets_until(file, question.columns, float(observed.mjd[-1]) - MJD)
    rapid = eop.file_of(file) if offsets.name == "finals2000A" else eop.file_of("finals")
    rotation: RotationAhead | None = None if run.why_not("rotation") else run["rotation"]
    if rotation is None and (reach := last_ut1(rapid)) < last:
        problem = f"{rapid.name} has UT1-UTC for {reach - observed.mjd[-1]:.0f} d after the origin"
        raise SceneError("days", f"{question.days:g} d", f"{problem}; take no more days")
    p = np.concatenate([observed.pole, run["prediction"].pole]) * MAS
    pole = np.array([_continued(observed.mjd, last), p.real, -p.imag])
    days = _continued(offsets.mjd, last)
    later, _ = predicted_offsets(offsets, days[offsets.mjd.size :])
    known = np.stack([offsets.x, offsets.y], axis=1)
    replaced = [pole, np.array([days, *np.concatenate([known, later]).T])]
    ends = [float(observed.mjd[-1]), float(offsets.mjd[-1])]
    if rotation is not None:
        replaced.append(rotation.ut1_minus_utc)
        ends.append(float(rotation.observed.mjd[-1]))
    return with_orientation(rapid, replaced, ends)


def _continued(mjd: FloatArray, last: float) -> FloatArray:
    """Extend an array of modified Julian dates day by day up to a last date."""
    return np.concatenate([mjd, np.arange(mjd[-1] + 1, last + 0.5)])
