"""Daily insolation over millennia, computed from the orbit and the obliquity of a planet."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import BODIES, EARTH, SUN, Body
from earthspin.constants import AU, DAY, SOLAR_CONSTANT
from earthspin.engine import Neglected, key, part, public_call
from earthspin.engine.question import keys_of
from earthspin.engine.variables import Variables, labels, measured, number
from earthspin.errors import SceneError, UndefinedError, Where, checked, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.progress import progress
from earthspin.questions import long_term
from earthspin.questions.season_averages import ELEMENTS, OF_BANDS, READS, SEASONS, Average
from earthspin.units import LONGEST_IN_MEMORY, Number, Numbers, Plain, Word, quantity

_TURN = 2 * np.pi
_CALL = "daily_insolation"
#: March equinox, in days of a calendar that counts 1 January as day 1, and length of its year, d:
#: day 80 is 21 March (Huybers & Eisenman 2006, NOAA/NCDC Paleoclimatology 2006-100; climlab).
MARCH_EQUINOX, CALENDAR_YEAR = 80.0, 365.2422
BERGER = "Berger 1978, J. Atmos. Sci. 35, 2362"
_SUNLIGHT = "sunlight at the top of the atmosphere, averaged over day and night"

# --- latitudes and longitudes --------------------------------------------------------------------

_HEMISPHERE = re.compile(r"\s*(\d+\.?\d*|\.\d+)\s*(?:°|deg)?\s*([NS])\s*")


def _signed(value: Any) -> Any:
    """Replace the hemisphere letter of latitudes by a sign: "23.5S" becomes "-23.5 deg"."""
    if isinstance(value, (list, tuple)):
        return [_signed(element) for element in value]
    match = isinstance(value, str) and _HEMISPHERE.fullmatch(value)
    return f"{'-' if match[2] == 'S' else ''}{match[1]} deg" if match else value


def _in_radians(value: Any, where: Where, limit: float) -> Any:
    """Convert latitudes or longitudes to rad; refuse angles above `limit` (rad)."""
    is_latitude = limit < np.pi
    example = "65 deg" if is_latitude else "90 deg"
    angle = quantity(_signed(value) if is_latitude else value, "rad", where, example)
    if np.max(np.abs(np.asarray(angle))) > limit * (1 + 1e-12):
        problem = f"give at most {np.degrees(limit):g} degrees; plain numbers are radians, so write"
        raise where.error(value, f"{problem} '{example}'")
    return angle


@dataclass(frozen=True)
class AngleList(Numbers):
    """Kind of input: an angle, or a list of angles.

    Attributes
    ----------
    limit : float
        Largest size of an angle, rad; angles up to a right angle are latitudes.
    """

    limit: float = _TURN

    def read(self, value: object, where: Where) -> FloatArray:
        """Convert an angle, a list of angles, or a list of pairs of angles to rad."""
        angle = _in_radians(value, where, self.limit)
        if np.ndim(angle) == 2:
            return Numbers(self.unit, self.example, (None, 2)).read(
                angle, replace(where, typed=False)
            )
        return super().read(angle, replace(where, typed=False))

    def write(self, value: FloatArray) -> Plain:
        """Text of an angle for scene (input) files, in deg, or in rad if degrees are not exact."""
        if value.ndim:
            return [self.write(angle) for angle in value]
        degrees = round(math.degrees(value), 12)
        return f"{degrees!r} deg" if math.radians(degrees) == value else f"{float(value)!r} rad"


def _labelled(angle: Any, name: str, label: Any = None, **attrs: str) -> tuple[xr.DataArray, ...]:
    """Make a DataArray of angles (rad) along `name`, or two of the ends of pairs of angles.

    The default labels are values in degrees, or texts of pairs. A DataArray has its own labels.
    """
    if isinstance(angle, xr.DataArray):
        return (angle,)
    degrees = np.degrees(angle).round(12)  # because radians are not exact
    if label is None and name in ("band", "interval"):
        label = np.array([f"{first:g} to {last:g}" for first, last in degrees.reshape(-1, 2)])
        label = label.reshape(degrees.shape[:-1])
    label = degrees if label is None else label
    dims = (name,) if np.ndim(label) else ()
    ends = np.reshape(np.transpose(angle), (-1, *np.shape(label)))
    return tuple(xr.DataArray(end, {name: (dims, label, attrs)}, dims) for end in ends)


# --- the question --------------------------------------------------------------------------------


class Insolation(
    long_term.LongTerm,
    word="insolation",
    call="insolation",
    positional=("start", "stop", "step"),
):
    """Insolation at the top of the atmosphere over millennia: means, half-years and extremes.

    Obliquity, eccentricity and perihelion are those of `long_term`, with all its inputs. Longitudes
    of the Sun are seen from the body along the orbit from the moving equinox: 0 is the March
    equinox, 90 degrees the June solstice. A true longitude is a place on the orbit. A day is one of
    a calendar in which the March equinox is always day 80, 21 March, of 365.2422 days: a mean
    longitude of (day - 80)/365.2422 turns (Huybers & Eisenman 2006). Other seasons then begin on
    days that change with the perihelion. All lengths of time are counted in the same year of
    365.2422 days, because longitudes are counted from the moving equinox; for other bodies in the
    sidereal year.

    `mean` is "day" (default), "interval" (between two longitudes), "window" (of time), "year",
    "caloric" (half-years of Milankovitch: every day of the summer gets more than every day of the
    winter), "above" (time above `threshold`; Huybers 2006), "extremes", "all-extremes" or
    "seasons". Latitudes may be bands, lists of pairs like [["60N", "90N"]], for the first four.

    The answer is also along `latitude` or `band`, and along `longitude`, `interval`,
    `mean_longitude` or `day`, if these are lists. The label `epoch` is in Julian years from J2000.0
    TDB. The error follows from those of obliquity, eccentricity, perihelion and solar constant,
    which are treated as independent.

    Raises
    ------
    CoverageError
        If times lie outside the table of the orbit.

    Examples
    --------
    >>> import earthspin
    >>> june = earthspin.insolation("-20 kyr", "0 kyr", "10 kyr", solar_constant="1365 W/m2")
    >>> print(june.insolation.round(1).values)
    [476.4 527.3 479.3]
    """

    headline = "insolation"

    exclusive = (  # type: ignore[assignment]
        *long_term.LongTerm.exclusive,
        (("longitude",), ("mean_longitude",), ("day",)),
    )

    mean: Annotated[str, Word(tuple(READS))] | None = key(
        None, doc='what is averaged; if not given, "window" with a window, else "day"'
    )
    latitude: Annotated[FloatArray, AngleList("rad", "65 deg", (None,), True, np.pi / 2)] = key(
        "65 deg",
        doc='latitude, or a list of latitudes or of pairs (bands); "65N" and "23.5S" are read, '
        "plain numbers are radians",
    )
    longitude: Annotated[FloatArray, AngleList("rad", "90 deg", (None,), True)] = key(
        "90 deg",
        doc="true longitude of the Sun, or a list; 90 degrees is the June solstice; the first and "
        "last longitude of an interval, or a list of such pairs",
    )
    mean_longitude: Annotated[FloatArray, AngleList("rad", "90 deg", (None,), True)] | None = key(
        None,
        doc="mean longitude, in place of longitude: time from the March equinox, 360 degrees "
        "a year",
    )
    day: Annotated[FloatArray, Numbers("", "172", (None,), True)] | None = key(
        None, doc="day of the year, or a list, in place of longitude; 80 is the March equinox"
    )
    window: Annotated[float, Number("s", "30 d", above=0.0)] | None = key(
        None, doc="length of the average, centred on the longitude or day"
    )
    threshold: Annotated[float, Number("W/m2", "275 W/m2", above=0.0)] | None = key(
        None, doc="level of the daily insolation above which the summer is summed"
    )
    solar_constant: Annotated[float, Number("W/m2", "1361 W/m2", above=0.0)] | None = key(
        None,
        doc="solar constant at the mean distance of the body; if not given, 1361 W/m2 at one "
        "astronomical unit (many tables use 1365 or more)",
    )
    solar_constant_error: Annotated[float, Number("W/m2", "0.5 W/m2", low=0.0)] = key(
        0.0, doc="95 % half-width of the solar constant"
    )

    def check(self) -> None:
        """Refuse inputs that the mean does not read, days off the calendar, and long windows."""
        super().check()
        mean = _mean(self.mean, self.window)
        check_inputs(mean, {name: getattr(self, name) for name in INPUTS}, self.error)
        is_earth = self.body.known_as == EARTH.known_as
        if self.day is not None and not (is_earth and np.all((self.day >= 0) & (self.day < 367))):
            problem = "give days from 0 to 367 of the Earth's calendar, or a longitude"
            raise self.error("day", self.day.tolist(), problem)
        if self.window is not None and self.window > self.body.number("orbital_period"):
            raise self.error("window", f"{self.window / DAY:g} d", "give at most a year")


_FEWER = "NaN if there are fewer extremes"
_SEE = "see longitude_of_largest and longitude_of_smallest"
_optional = functools.partial(measured, default=None)
_angle_of = functools.partial(_optional, "deg", missing_where="NaN if it is not unique")


class InsolationSeries(Variables, along=("epoch",)):
    """Insolation and its means at every epoch, latitude, and solar longitude or day of the year."""

    insolation = _optional("W m-2", _SUNLIGHT, references=BERGER)
    length = _optional("d", "time that is averaged over")
    annual_mean = _optional("W m-2", "mean insolation over the year")
    caloric_summer = _optional("W m-2", "mean over the caloric summer half-year")
    caloric_winter = _optional("W m-2", "mean over the caloric winter half-year")
    caloric_summer_energy = _optional("GJ m-2", "energy of the caloric summer half-year")
    caloric_winter_energy = _optional("GJ m-2", "energy of the caloric winter half-year")
    caloric_level = _optional("W m-2", "insolation between the caloric half-years")
    caloric_start = _angle_of("true longitude at the start of the caloric summer")
    caloric_end = _angle_of("true longitude at the end of the caloric summer")
    integrated_summer = _optional("GJ m-2", "insolation summed over days above the threshold")
    days_above = _optional("d", "time above the threshold in a year")
    excess = _optional("GJ m-2", "insolation beyond the threshold, summed")
    largest = _optional("W m-2", "largest daily insolation of the year")
    longitude_of_largest = _angle_of("true longitude of the largest insolation")
    smallest = _optional("W m-2", "smallest daily insolation of the year")
    longitude_of_smallest = _angle_of("true longitude of the smallest insolation")
    count = number("1", "number of extremes in the year", default=None, no_error="a whole number")
    extreme_insolation = _optional(
        "W m-2", "extremes of the daily insolation", missing_where=_FEWER
    )
    extreme_longitude = number(
        "deg", "true longitude of each extreme", default=None, no_error=_SEE, missing_where=_FEWER
    )
    season_length = _optional("d", "length of the season")
    epoch = labels(default=None)
    latitude = labels(default=None)
    band = labels(default=None)
    longitude = labels(default=None)
    interval = labels(default=None)
    mean_longitude = labels(default=None)
    day = labels(default=None)


#: Inputs that only some of the means read.
INPUTS = sorted({name for names in READS.values() for name in names})


def _mean(mean: str | None, window: float | None) -> str:
    """What is averaged: a day by default, or a window if its length is given."""
    return mean or ("day" if window is None else "window")


def check_inputs(
    mean: str, values: Mapping[str, Any], error: Callable[[str, object, str], SceneError]
) -> None:
    """Refuse inputs that a mean does not read, unless they are the defaults, and those it lacks.

    Parameters
    ----------
    mean : str
    values : mapping of str to object
        Inputs by name; arrays of pairs have two dimensions.
    error : callable
        Makes the error from name, value and problem.
    """
    keys = keys_of(Insolation)
    for name, value in values.items():
        if name not in READS[mean] and not np.array_equal(value, keys[name].default):
            uses = " or ".join(f"'{other}'" for other, names in READS.items() if name in names)
            raise error(name, "...", f"mean = '{mean}' does not read it; it is for mean = {uses}")
        pairs = OF_BANDS if name == "latitude" else ("interval",)
        if np.ndim(value) == 2 and mean not in pairs:
            raise error(name, "pairs", f"pairs are for mean = {' or '.join(map(repr, pairs))}")
        if name in ("window", "threshold") and name in READS[mean] and value is None:
            raise error(name, None, f"mean = '{mean}' needs it")
    if mean == "interval" and np.shape(values["longitude"])[-1:] != (2,):
        problem = "give first and last longitude, like ['0 deg', '180 deg']"
        raise error("longitude", np.asarray(values["longitude"]).tolist(), problem)


def _places(
    mean: str, latitude: Any, longitude: Any, mean_longitude: Any, day: Any
) -> tuple[tuple[xr.DataArray, ...], tuple[xr.DataArray, ...]]:
    """Latitudes or ends of bands, and longitudes of the Sun or ends of intervals, as DataArrays."""
    if mean != "seasons":
        name = "band" if np.ndim(latitude) == 2 else "latitude"
        places = _labelled(latitude, name, units="deg", long_name="latitude")
    else:
        starts = np.array([*SEASONS.values()])
        ends = np.stack([starts, starts + np.pi / 2], axis=-1)
        return (), _labelled(ends, "season", np.array([*SEASONS]))
    words = "{} longitude of the Sun from the moving equinox"
    if mean == "interval":
        first, last = _labelled(longitude, "interval", units="deg", long_name=words.format("true"))
        return places, (first, last + _TURN * (last < first))  # over the equinox
    if "longitude" not in READS[mean]:
        return places, ()
    if day is not None:
        angle = _TURN * (day - MARCH_EQUINOX) / CALENDAR_YEAR
        words = f"day of the year, of which {MARCH_EQUINOX:g} is the March equinox"
        return places, _labelled(angle, "day", day, units="d", long_name=words)
    angles = {"longitude": longitude, "mean_longitude": mean_longitude}
    name = "longitude" if mean_longitude is None else "mean_longitude"
    words = words.format("true" if mean_longitude is None else "mean")
    return places, _labelled(angles[name], name, units="deg", long_name=words)


def _text(label: xr.DataArray) -> str:
    return f"{label.item():g}" if label.dtype.kind == "f" else str(label.item())


def _answer(choice: Average, series: xr.Dataset, **attributes: Any) -> InsolationSeries:
    """Means of a solution, with the attributes of `insolation`."""
    coordinates = [c for array in (*choice.places, *choice.sun) for c in array.coords.values()]
    words = {
        "day": "mean over a day",
        "window": f"mean over {(choice.window or 0.0) / DAY:g} d",
        "above": f"threshold {choice.threshold} W/m2",
    }
    places = [f"{c.name} {_text(c)} {c.attrs.get('units', '')}" for c in coordinates if not c.ndim]
    comment = ", ".join([words.get(choice.mean, f"mean: {choice.mean}"), *dict.fromkeys(places)])
    attributes |= {"solar_constant": choice.constant, "comment": comment}
    values, schema = choice.of(series), InsolationSeries.schema
    pairs = {n: pair if f"{n}_error" in schema else pair[0] for n, pair in values.items()}
    no_error = "the solution has no errors"
    if f"{ELEMENTS[0]}_error" in series:
        no_error = series[f"{ELEMENTS[0]}_error"].attrs.get("no_error", "")
    marked = dict.fromkeys(values, attributes)
    coords = {str(c.name): c.variable for c in coordinates if c.name in InsolationSeries.fields}
    return InsolationSeries(**pairs, **coords).with_attributes(no_error=no_error, **marked)


@part
def averages(
    series: xr.Dataset,
    mean: str | None,
    latitude: FloatArray,
    longitude: FloatArray,
    mean_longitude: FloatArray | None,
    day: FloatArray | None,
    window: float | None,
    threshold: float | None,
    solar_constant: float | None,
    solar_constant_error: float,
    body: Body,
) -> InsolationSeries:
    """Compute the means and their errors at every epoch, latitude, and longitude or day."""
    average = _mean(mean, window)
    places, sun = _places(average, latitude, longitude, mean_longitude, day)
    count = series.epoch.size * math.prod(arrays[0].size for arrays in (places, sun) if arrays)
    if count > LONGEST_IN_MEMORY:
        problem = f"give fewer epochs or places; at most {LONGEST_IN_MEMORY} values fit into memory"
        raise SceneError("insolation", f"{count} values", problem)
    year = body.number("orbital_period")
    constant = _solar_constant(year) if solar_constant is None else solar_constant
    year = _year_of_seasons(body.known_as, year)
    is_true, numbers = mean_longitude is None and day is None, (year, window, threshold)
    choice = Average(average, places, sun, is_true, constant, solar_constant_error, *numbers)
    orbit = {name: series.obliquity.attrs[name] for name in ("orbit", "orbit_of")}
    return _answer(choice, series, **orbit)


@part
def neglected(body: Body, j2_rate: float | None) -> Neglected:
    """Effects on the insolation that are neither modelled nor included in the errors."""
    of_axis = long_term.neglected(body, j2_rate).what
    return Neglected(what=f"changes of the Sun's brightness; {of_axis}")


insolation = public_call(
    Insolation,
    answer=averages,
    sections={"long_term": long_term.series, "budget": long_term.budget, Neglected.PART: neglected},
    **long_term.SHARED,
)

# --- insolation from an answer -------------------------------------------------------------------


#: Arguments of earlier versions, each with what to give instead.
_RENAMED = {
    "solar_longitude": "give longitude",
    "true_longitude": "give mean_longitude in place of longitude for mean longitudes",
    "days": "give window",
}


@functools.partial(checked, hint=lambda name, allowed: _RENAMED.get(name) or nearest(name, allowed))
@progress("insolation")
def daily_insolation(
    result: xr.Dataset,
    latitude: Any = None,
    longitude: Any = None,
    *,
    mean: str | None = None,
    mean_longitude: Any = None,
    day: Any = None,
    window: Any = None,
    threshold: Any = None,
    solar_constant: Any = None,
    solar_constant_error: Any = 0.0,
) -> xr.Dataset:
    """Insolation of any solution of obliquity and orbit, with the inputs of `insolation`.

    Longitudes are those of the Sun as seen from the body, along the orbit from the moving equinox:
    0 is the March equinox, 90 degrees the June solstice. (The `longitude_of_perihelion` of an
    answer is that of the body, which differs from that of the Sun by 180 degrees.)

    Parameters
    ----------
    result : Dataset
        An answer of `long_term`, or of `read_solution`, which needs `solar_constant` and has no
        errors, so that those of the insolation are NaN.
    latitude : str, Quantity, DataArray or list of them
        Latitude, like ``"65 deg"`` or ``"65N"``, or a list of pairs (bands); plain numbers are
        radians. Default: 65 deg.
    longitude : str, Quantity, DataArray or list of them
        True longitude of the Sun, like ``"90 deg"`` (the default), or first and last longitude of
        an interval.
    mean : str, optional
        What is averaged, one of the words of `insolation`.
    mean_longitude : str, Quantity, DataArray or list of them, optional
        Mean longitude of the Sun, in place of `longitude`. It grows linearly with time from the
        March equinox, so that 90 degrees are a quarter of a year after the equinox.
    day : float or list of float, optional
        Day of the Earth's calendar, in place of `longitude`; 80 is the March equinox.
    window : str, Quantity or float, optional
        Length of a time window for the average, like ``"30 d"``, centred on the instant of the
        longitude or day. Lengths of time are counted in years of the seasons: 365.2422 days for the
        Earth and for solutions that do not name their body.
    threshold : str, Quantity or float, optional
        Level of the daily insolation above which the summer is summed, like ``"275 W/m2"``.
    solar_constant : str, Quantity or float, optional
        Solar constant in W/m2 at the mean distance of the body; by default 1361 W/m2 at one
        astronomical unit (IAU 2015 Resolution B3). Many published tables use 1365 or more.
    solar_constant_error : str, Quantity or float, optional
        95 % half-width of the solar constant.

    Returns
    -------
    Dataset
        The variables of `insolation` along `epoch`, and along latitude and longitude if several are
        given, each with its 95 % half-width.

    Raises
    ------
    SceneError, UnitsError, UndefinedError
        If the result is of another question, a latitude is beyond a pole, or the solar constant of
        the body is not known.

    Examples
    --------
    >>> import earthspin
    >>> past = earthspin.long_term("-20 kyr", "0 kyr", "10 kyr")
    >>> june = earthspin.daily_insolation(past, "65 deg", "90 deg", solar_constant="1365 W/m2")
    >>> print(june.insolation.round(1).values)
    [476.4 527.3 479.3]
    """
    if not {*ELEMENTS} <= {*getattr(result, "data_vars", ())}:
        raise Where("result", _CALL).error(type(result).__name__, "give an answer of long_term")
    keys = keys_of(Insolation)

    def error(name: str, value: object, problem: str) -> SceneError:
        return Where(name, _CALL).error(value, problem)

    def read(name: str, value: Any) -> Any:
        if value is None:
            return keys[name].default if name in ("latitude", "longitude") else None
        if name in ("latitude", "longitude", "mean_longitude"):
            return _angle(value, name, result, values.get("latitude"))
        return keys[name].kind.read(value, Where(name, _CALL))

    seasons = {"longitude": longitude, "mean_longitude": mean_longitude, "day": day}
    several = [name for name, value in seasons.items() if value is not None]
    if len(several) > 1:
        raise error(several[1], "...", f"give it without {several[0]}")
    given = {"latitude": latitude, **seasons, "window": window, "threshold": threshold}
    values: dict[str, Any] = {}
    for name, value in given.items():
        values[name] = read(name, value)
    average = _mean(read("mean", mean), values["window"])
    check_inputs(average, values, error)
    constant, year = _scales(result, read("solar_constant", solar_constant), average)
    window, threshold = values.pop("window"), values.pop("threshold")
    if window is not None and window > year:
        raise error("window", f"{window / DAY:g} d", "give at most a year")
    places, sun = _places(average, **values)
    uncertain = read("solar_constant_error", solar_constant_error)
    is_true, numbers = several in ([], ["longitude"]), (year, window, threshold)
    choice = Average(average, places, sun, is_true, constant, uncertain, *numbers)
    if "epoch" in result[ELEMENTS[0]].dims:
        return _answer(choice, result).dataset()
    return _answer(choice, result.expand_dims("epoch")).dataset().isel(epoch=0)


def _scales(result: xr.Dataset, solar_constant: float | None, mean: str) -> tuple[float, float]:
    """Solar constant, W/m2, and year of the seasons, s, of the body of a solution."""
    body = str(result["obliquity"].attrs.get("orbit_of", ""))
    sidereal = BODIES[body].orbital_period if body in BODIES else None
    timed = mean not in ("day", "year", "extremes", "all-extremes")
    if sidereal is None and (solar_constant is None or (body and timed)):
        remedy = "solar_constant, like '1361 W/m2' for the Earth"
        if solar_constant is not None:
            remedy = "mean = 'day', 'year' or 'extremes'"
        name = body or "the body of this solution"
        raise UndefinedError(f"{_CALL}: the year of {name} is not known; give {remedy}")
    year = CALENDAR_YEAR * DAY if sidereal is None else _year_of_seasons(body, sidereal)
    return solar_constant or _solar_constant(sidereal or year), year


def _angle(value: Any, name: str, result: xr.Dataset, latitude: Any) -> Any:
    """Convert latitudes or longitudes to rad; labels fit those of the result and the latitude."""
    where = Where(name, _CALL)
    angle = _in_radians(value, where, np.pi / 2 if name == "latitude" else _TURN)
    if not isinstance(angle, xr.DataArray):
        if np.ndim(angle) > 2 or (np.ndim(angle) == 2 and np.shape(angle)[1] != 2):
            raise where.error(value, "give one angle, one list of angles, or one list of pairs")
        return angle
    try:
        others = [latitude] if isinstance(latitude, xr.DataArray) else []
        xr.align(result["obliquity"], *others, angle, join="exact")
    except ValueError as misfit:
        problem = f"give it the labels of the result, like epoch=result.epoch ({misfit})"
        raise where.error("an array", problem) from None
    return angle


# --- scales of both ------------------------------------------------------------------------------


def _solar_constant(year: float) -> float:
    """Solar flux at the mean distance of a planet with a given sidereal year (s), W/m2."""
    distance = (SUN.gm * (year / _TURN) ** 2) ** (1 / 3)
    return float(SOLAR_CONSTANT.value * (AU / distance) ** 2)


def _year_of_seasons(body: str, sidereal: float) -> float:
    """Year of which windows are fractions, s: tropical for the Earth, sidereal for other bodies."""
    tropical = CALENDAR_YEAR * DAY / EARTH.number("orbital_period")
    return sidereal * (tropical if body == EARTH.known_as else 1.0)
