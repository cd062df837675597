"""Forecast of polar motion."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import EARTH, Body
from earthspin.bodies.orbit import Epoch
from earthspin.constants import DAY, MAS, NORMAL_95
from earthspin.dates import SPACING, date_text, datetime64
from earthspin.engine.answers import public_call
from earthspin.engine.question import Question, key, part
from earthspin.engine.run import Run
from earthspin.engine.variables import Neglected, Variables, labels, measured, number, words
from earthspin.errors import SceneError, SeriesError, Where
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation.core_nutation import LONGEST as FARTHEST
from earthspin.nutation.core_nutation import predict, too_short
from earthspin.questions.observed_pole import MJD, Daily, TableFile, complex_pole, labelled_series
from earthspin.questions.reasons import no_iau_model
from earthspin.sky.eop import (
    PoleSeries,
    file_of,
    finals_path,
    read_bulletin_a,
    read_polar_motion,
    read_pole_offsets,
)
from earthspin.units import Number, Plain, pack, unpack
from earthspin.wobble import forecast as model
from earthspin.wobble.forecast import COMPONENTS, LONGEST, NEWEST_BIAS, SKILL
from earthspin.wobble.forecast import Forecast as Predicted

if TYPE_CHECKING:
    from earthspin.engine.accessor import Answer
    from earthspin.sky.iers_table import PoleTable

#: How far a date may be from midnight, d.
_MIDNIGHT = 1e-6


@dataclass(frozen=True, eq=False)
class GivenSeries:
    """Polar motion or its excitation, given as a Dataset.

    Attributes
    ----------
    rows : array, shape (3, n)
        Days from J2000.0, and x and y, or chi1 and chi2, in mas.
    """

    rows: FloatArray


class KnownExcitation:
    """Kind of input: the excitation of polar motion in a Dataset, as `read_excitation` returns."""

    words = "a Dataset of read_excitation"
    hint = "xr.Dataset"

    def read(self, value: Any, where: Where) -> Any:
        """Read the series from a Dataset, or restore it from the table that `write` returns."""
        if isinstance(value, GivenSeries):
            return value
        if isinstance(value, dict):
            return GivenSeries(unpack(value, where))
        if not hasattr(value, "data_vars"):
            raise where.error(value, f"it is {self.words}")
        return self.series(value)

    def series(self, dataset: xr.Dataset) -> GivenSeries:
        """Convert the variables of a Dataset to a series in mas."""
        time, chi1, chi2 = labelled_series(dataset, ("chi1", "chi2"), ("mas",))
        return GivenSeries(np.array([time, chi1 / MAS, chi2 / MAS]))

    def write(self, value: GivenSeries) -> Plain:
        """Form stored in scenes: the rows of the series as bytes."""
        return pack(value.rows)


class ObservedPole(KnownExcitation, TableFile):
    """Kind of input: a table of polar motion, or a Dataset that `polar_motion` returned."""

    words = '"c04", "finals", the path of a file or a Dataset of polar_motion'
    hint = "str | PathLike[str] | xr.Dataset"

    def read(self, value: Any, where: Where) -> Any:
        """Read polar motion from a Dataset or its stored form, or the name or path of a table."""
        if isinstance(value, (GivenSeries, dict)) or hasattr(value, "data_vars"):
            return KnownExcitation.read(self, value, where)
        return TableFile.read(self, value, where)

    def series(self, dataset: xr.Dataset) -> GivenSeries:
        """Convert the polar motion in a Dataset to x and y in mas."""
        time, p = complex_pole(dataset)
        return GivenSeries(np.array([time, p.real, -p.imag]))

    def write(self, value: Any) -> Plain:
        """Form stored in scenes: the name or path of a table, or the rows of a Dataset as bytes."""
        return (
            super().write(value) if isinstance(value, GivenSeries) else TableFile.write(self, value)
        )


class Forecast(
    Question, word="forecast", call="forecast", positional=("days", "step", "origin", "file")
):
    """Forecast of polar motion with its 95 % half-widths.

    Only observed rows up to the origin are used.

    Returns
    -------
    Dataset
        Over `time`, from the day after the origin: `x`, `y` (arcsec) with their 95 % half-widths,
        and `correlation_xy`, the correlation of the errors. `earthspin.run_tree` adds `components`
        (Chandler, annual and semiannual wobble, slow pole), the measured `skill` by horizon,
        `bulletin_a`, the prediction of Bulletin A from the same table if it has one, and
        `pole_offsets`, the forecast of the celestial pole offsets from the same table.

    Raises
    ------
    EarthspinError
        If the table has gaps or less than 15 years before the origin, if the origin is outside
        it, or if the horizon is longer than 730 days; in one line.

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
        365.0, doc="horizon, 730 days at most"
    )
    step: Annotated[float, replace(SPACING, example="1 d")] = key(
        "1 d", doc="time between two epochs, a whole number of days"
    )
    origin: Annotated[float, Epoch()] | None = key(
        None, doc="last day whose observation is used; the newest observed day if not given"
    )
    file: Annotated[str | Path | GivenSeries, ObservedPole()] = key(
        "finals", doc="table of the IERS that astropy carries, a local file, or polar motion"
    )
    parameters: Literal["shipped", "fitted"] | None = key(
        None,
        doc="parameters of the fast excitation: shipped, or fitted before the origin; "
        "shipped by default, and always fitted with an excitation",
    )
    excitation: Annotated[GivenSeries, KnownExcitation()] | None = key(
        None, doc="excitation by air, water and ground, observed and forecast: daily means"
    )

    def check(self) -> None:
        """Require whole days, a horizon of measured skill, fitted parameters with excitation."""
        if self.excitation is not None and self.parameters == "shipped":
            problem = "with an excitation they are fitted; leave parameters out"
            raise SceneError("parameters", self.parameters, problem)
        if self.days > LONGEST:
            problem = f"a forecast reaches {LONGEST} d at most; take fewer days"
            raise SceneError("days", f"{self.days:g} d", problem)
        step = self.step / DAY
        if step != round(step) or self.days < step:
            raise SceneError("step", f"{step:g} d", "give whole days, at most as many as `days`")


@dataclass(frozen=True)
class Record:
    """Observed polar motion up to the origin, the last day that the forecast uses.

    Attributes
    ----------
    time : array, shape (n,)
        Consecutive days from J2000.0.
    p : complex array, shape (n,)
        x - i y, mas.
    name : str
        Series.
    sha256 : str
        Of the file; empty for a Dataset.
    newest : bool
        Whether the last day is the newest observed row of finals2000A.
    """

    time: FloatArray
    p: ComplexArray
    name: str
    sha256: str = ""
    newest: bool = False

    @property
    def provenance(self) -> dict[str, str]:
        """SHA-256 of the table of polar motion, for the attributes of the forecast."""
        return {"table_sha256": self.sha256} if self.sha256 else {}


@part(unless=no_iau_model)
def record(file: str | Path | GivenSeries, origin: float | None) -> Record:
    """Read the observed polar motion up to the origin; refuse a series that is not daily."""
    if isinstance(file, GivenSeries):
        time, x, y = file.rows
        p: ComplexArray = (x - 1j * y).astype(complex)
        whole = Record(time, p, "polar_motion")
    else:
        table = read_polar_motion(file)
        if "bridged" in table.repairs:
            raise SceneError("file", str(file), f"{table.repairs}; a forecast needs every day")
        p = ((table.x - 1j * table.y) / MAS).astype(complex)
        rapid = table.name == "finals2000A"
        whole = Record(table.mjd - MJD, p, f"IERS {table.name}", table.sha256, rapid)
    steps = np.diff(whole.time)
    if np.any(abs(steps - 1) > _MIDNIGHT):
        wrong = whole.time[:-1][abs(steps - 1) > _MIDNIGHT][0]
        problem = "a forecast needs one row for each day"
        raise SceneError("file", f"a step of {steps.max():g} d after {date_text(wrong)}", problem)
    if origin is None:
        return whole
    first, last = whole.time[[0, -1]]
    if not first <= origin < last + 1:
        problem = (
            f"the observed rows cover {date_text(first)} to {date_text(last)}; choose a day inside"
        )
        raise SceneError("origin", date_text(origin), problem)
    count = int(np.floor(origin - first + _MIDNIGHT)) + 1
    newest = whole.newest and count == whole.time.size
    return replace(whole, time=whole.time[:count], p=whole.p[:count], newest=newest)


@part(loads=("scipy.linalg",))
def predicted(
    record: Record, days: float, parameters: str | None, excitation: GivenSeries | None
) -> Predicted:
    """Predict polar motion and the covariance of its error for each day after the origin."""
    if excitation is not None:
        pole, chi = _from_common_day(record, excitation)
        return model.forecast_with_excitation(pole, chi, int(days), record.newest)
    fast = model.fit(record.p) if parameters == "fitted" else model.SHIPPED
    return model.forecast(record.p, int(days), fast, newest=record.newest)


def _from_common_day(record: Record, excitation: GivenSeries) -> tuple[ComplexArray, ComplexArray]:
    """Return pole and excitation from the first day that both cover, each to its own end.

    Raises
    ------
    SceneError
        If the excitation is not a series of daily means from one day of the pole to the next.
    """
    middles, chi1, chi2 = excitation.rows
    before = middles[0] - 0.5 - record.time[0]  # days without excitation
    uneven = abs(np.diff(middles) - 1).max(initial=0.0) > _MIDNIGHT
    if uneven or abs(before - round(before)) > _MIDNIGHT:
        raise SceneError(
            "excitation",
            f"means about {datetime64(middles[:1])[0]}, {datetime64(middles[1:2])[0]} and so on",
            "give the mean of each day; read_excitation(..., daily=True) makes it, 0h to 0h",
        )
    skipped = round(before)
    return record.p[max(skipped, 0) :], (chi1 + 1j * chi2)[max(-skipped, 0) :]


class ForecastPole(Daily):
    """Forecast of polar motion."""

    x = measured("arcsec", "coordinate of the pole towards the prime meridian")
    y = measured("arcsec", "coordinate of the pole towards 90 degrees west")
    correlation_xy = number(
        "1", "correlation of the errors of x and y", no_error="it belongs to the errors"
    )


def _days_returned(days: float, step: float) -> Any:
    """Return the slice that selects the requested days from a daily forecast."""
    every = round(step / DAY)
    return slice(every - 1, int(days), every)


def _days_ahead(record: Record, days: float, step: float) -> FloatArray:
    """Days from J2000.0 that a forecast returns: every `step` up to `days` after the origin."""
    ahead: FloatArray = np.arange(1.0, int(days) + 1)[_days_returned(days, step)]
    return ahead + float(record.time[-1])


@part
def ahead(
    record: Record,
    predicted: Predicted,
    days: float,
    step: float,
    parameters: str | None,
    origin: float | None,
    excitation: GivenSeries | None,
) -> ForecastPole:
    """Return the forecast x and y of the pole, with half-widths and correlation of errors."""
    newest = float(record.time[-1])
    fast = ", ".join(f"{name} = {value:.4g}" for name, value in vars(predicted.fast).items())
    kind = parameters or ("shipped" if excitation is None else "fitted")
    shown = _days_returned(days, step)
    p, covariance = predicted.pole[shown] * MAS, predicted.covariance[shown] * MAS**2
    sx, sy = np.sqrt(covariance[:, 0, 0]), np.sqrt(covariance[:, 1, 1])
    source = {
        "references": record.name,
        "comment": f"observations up to {date_text(newest)}",
        "origin": date_text(newest if origin is None else origin),
        "newest_row": date_text(newest),
        "age_of_newest_row": f"{0.0 if origin is None else origin - newest:g} d at the origin",
        "parameters": f"{kind}: {fast}",
    }
    if record.newest:
        source["newest_row_corrected"] = (
            f"{abs(NEWEST_BIAS.imag):.3f} mas, its measured bias, subtracted from y"
        )
    if excitation is not None:
        source["excitation"] = (
            f"given from {date_text(excitation.rows[0, 0])} to {date_text(excitation.rows[0, -1])}"
        )
    return ForecastPole(
        time=datetime64(_days_ahead(record, days, step)),
        x=(p.real, NORMAL_95 * sx),
        y=(-p.imag, NORMAL_95 * sy),
        correlation_xy=covariance[:, 0, 1] / (sx * sy),
    ).with_attributes(x=source, y=source)


class Components(Daily):
    """Parts of the forecast polar motion: Chandler, annual and semiannual wobble, and slow pole."""

    component_x = measured("mas", "part of x", along=("component", "time"))
    component_y = measured("mas", "part of y", along=("component", "time"))
    component = labels(default=list(COMPONENTS))


def not_separated(excitation: GivenSeries | None) -> str | None:
    """Return the reason (text) to omit the components if an excitation is given, else None."""
    if excitation is None:
        return None
    return "the pole that a given excitation drives is not separated into components"


@part(unless=not_separated)
def components(record: Record, predicted: Predicted, days: float, step: float) -> Components:
    """Compute the forecast Chandler, annual and semiannual wobbles and slow pole, with errors."""
    shown = _days_returned(days, step)
    p = np.array([values[shown] for values in predicted.components.values()]) * MAS
    variance = np.array([values[shown] for values in predicted.component_variance.values()])
    half_width = NORMAL_95 * np.sqrt(variance) * MAS
    return Components(
        time=datetime64(_days_ahead(record, days, step)),
        component_x=(p.real, half_width[..., 0]),
        component_y=(-p.imag, half_width[..., 1]),
    )


_COUNTED = "counted over the origins of the table"


class Skill(Variables, along=("case", "coordinate"), no_error=_COUNTED):
    """Measured errors of past forecasts of polar motion, by number of days after the origin."""

    mean_absolute_error = number("mas", "mean absolute error of the forecast", short="MAE")
    root_mean_square = number("mas", "root mean square error of the forecast", short="RMS")
    coverage = number("1", "share of 95 % intervals that contain the observed pole")
    other_mean_absolute_error = number(
        "mas",
        "mean absolute error of Bulletin A on the same releases, or of least squares with "
        "autoregression on the same origins",
        short="other MAE",
    )
    skill_set = words("table and origins", along=("case",))
    horizon = number("d", "days after the origin", along=("case",))
    origins = number("1", "number of origins", along=("case",))
    case = labels()
    coordinate = labels(default=["x", "y"])


@part
def skill() -> Skill:
    """Return measured errors of forecasts, from hindcasts and from releases of IERS tables."""
    table = json.loads(SKILL.read_text(encoding="utf-8"))

    def of(name: str) -> FloatArray:
        return np.array([row[name] for row in table], dtype=float)

    return Skill(
        mean_absolute_error=of("mae") * MAS,
        root_mean_square=of("rms") * MAS,
        coverage=of("coverage"),
        other_mean_absolute_error=of("other_mae") * MAS,
        skill_set=[row["set"] for row in table],
        horizon=of("horizon") * DAY,
        origins=of("origins"),
        case=[f"{row['set']}, {row['horizon']} d" for row in table],
    )


class BulletinA(Daily):
    """Polar motion x and y as predicted in Bulletin A of the IERS."""

    bulletin_a_x = measured("arcsec", "x predicted by Bulletin A")
    bulletin_a_y = measured("arcsec", "y predicted by Bulletin A")


def not_in_file(file: str | Path | GivenSeries, origin: float | None, days: float) -> str | None:
    """Return the reason (text) to omit Bulletin A if it lacks days of the forecast, else None."""
    if origin is not None:
        return "Bulletin A predicts from the newest observed day; leave origin out"
    if isinstance(file, GivenSeries) or (table := read_bulletin_a(file)) is None:
        return "the table holds no predictions of Bulletin A"
    if table.mjd.size < days:
        return f"Bulletin A predicts {table.mjd.size} d ahead; take at most as many days"
    return None


@part(unless=not_in_file)
def bulletin_a(
    file: str | Path | GivenSeries, record: Record, days: float, step: float
) -> BulletinA:
    """Read the polar motion predicted by Bulletin A, with 95 % half-widths, from the table."""
    table = None if isinstance(file, GivenSeries) else read_bulletin_a(file)
    assert table is not None
    rows = _days_returned(days, step)
    return BulletinA(
        time=datetime64(table.mjd[rows] - MJD),
        bulletin_a_x=(table.x[rows], NORMAL_95 * table.x_error[rows]),
        bulletin_a_y=(table.y[rows], NORMAL_95 * table.y_error[rows]),
    )


class AheadOffsets(Daily):
    """Forecast of the celestial pole offsets."""

    dX = measured("mas", "X of the celestial pole minus that of IAU 2006/2000A")
    dY = measured("mas", "Y of the celestial pole minus that of IAU 2006/2000A")


def offsets_until(file: str | Path, last: float | None) -> PoleSeries:
    """Read the observed celestial pole offsets of a table, up to a last day if one is given."""
    table = read_pole_offsets(file)
    return table if last is None else table.between(table.mjd[0], last + MJD)


def predicted_offsets(table: PoleSeries, mjd: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Predict celestial pole offsets and their half-widths at given dates, shape (n, 2) each."""
    return predict(table.mjd, table.x, table.y, table.x_error, table.y_error, mjd)


def no_offsets(file: str | Path | GivenSeries, origin: float | None, days: float) -> str | None:
    """Return the reason (text) to omit celestial pole offsets without a forecast, else None."""
    if isinstance(file, GivenSeries):
        return "polar motion has no celestial pole offsets; name a table"
    try:
        table = offsets_until(file, origin)
        newest = read_polar_motion(file).mjd[-1] if origin is None else np.floor(origin + MJD)
    except SeriesError as error:
        return str(error)
    if "bridged" in table.repairs:
        return "the table lacks days of celestial pole offsets"
    longest = newest + int(days) - table.mjd[-1]
    if longest > FARTHEST:
        return f"the last offset is {newest - table.mjd[-1]:.0f} d older than the origin"
    return too_short(table.mjd.size, longest)


@part(unless=no_offsets, loads=("scipy.signal",))
def pole_offsets(
    file: str | Path | GivenSeries, record: Record, days: float, step: float
) -> AheadOffsets:
    """Forecast the celestial pole offsets from those observed up to the origin of the forecast."""
    assert not isinstance(file, GivenSeries)
    table = offsets_until(file, float(record.time[-1]))
    time = _days_ahead(record, days, step)
    value, error = (pair.T for pair in predicted_offsets(table, time + MJD))
    newest = date_text(table.mjd[-1] - MJD)
    source = {
        "references": f"IERS {table.name}",
        "comment": f"observations up to {newest}",
        "newest_row": newest,
    }
    return AheadOffsets(
        time=datetime64(time), dX=(value[0], error[0]), dY=(value[1], error[1])
    ).with_attributes(dX=source, dY=source)


@part
def neglected(excitation: GivenSeries | None) -> Neglected:
    """Effects that the forecast neglects."""
    momentum = (
        "forecasts of the angular momentum of air, water and ground"
        if excitation is None
        else "errors of a forecast of the excitation beyond those of its values up to the origin"
    )
    return Neglected(
        unknown=f"{momentum}; tides of a day and of half a day, which tables of the pole leave out "
        "by convention"
    )


forecast = public_call(
    Forecast,
    answer=ahead,
    sections=(components, skill, bulletin_a, pole_offsets, neglected),
    parts=(record, predicted),
)


def to_iers_table(answer: Answer) -> PoleTable:
    """Convert a forecast to an astropy table of Earth orientation parameters.

    Polar motion and celestial pole offsets are observed up to the origin and forecast after
    it, day by day and without errors. UT1 - UTC is that of finals2000A. Dates outside the table
    are refused, even if astropy would only warn.

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
        if it reaches farther than the UT1 - UTC of finals2000A.

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
    from earthspin.sky.iers_table import last_ut1, with_pole

    file = question.file
    if isinstance(file, GivenSeries):
        raise SceneError("file", "polar motion", "name a table, which has celestial pole offsets")
    run = Run(question)
    seen: Record = run["record"]
    mjd, horizon = seen.time + MJD, int(question.days)
    offsets = offsets_until(file, float(seen.time[-1]))
    rapid = file_of(file) if offsets.name == "finals2000A" else finals_path()
    if (reach := last_ut1(rapid) - mjd[-1]) < horizon:
        problem = f"{rapid.name} has UT1-UTC for {reach:.0f} d after the origin; take no more days"
        raise SceneError("days", f"{question.days:g} d", problem)
    p = np.concatenate([seen.p, run["predicted"].pole]) * MAS
    pole = np.array([_continued(mjd, mjd[-1] + horizon), p.real, -p.imag])
    days = _continued(offsets.mjd, mjd[-1] + horizon)
    later, _ = predicted_offsets(offsets, days[offsets.mjd.size :])
    observed = np.stack([offsets.x, offsets.y], axis=1)
    last = (float(mjd[-1]), float(offsets.mjd[-1]))
    return with_pole(rapid, pole, np.array([days, *np.concatenate([observed, later]).T]), last)


def _continued(mjd: FloatArray, last: float) -> FloatArray:
    """Return modified Julian dates with daily dates added up to a last date."""
    return np.concatenate([mjd, np.arange(mjd[-1] + 1, last + 0.5)])
