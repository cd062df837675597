"""Daily insolation over millennia, computed from the orbit and the obliquity of a planet."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import BODIES, EARTH, SUN, Body
from earthspin.constants import AU, DAY, SOLAR_CONSTANT
from earthspin.engine import Neglected, key, part, public_call
from earthspin.engine.variables import Variables, labels, measured, si
from earthspin.errors import SceneError, UndefinedError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.progress import progress
from earthspin.questions import long_term
from earthspin.secular.insolation import Season, with_error
from earthspin.units import LONGEST_IN_MEMORY, Number, Numbers, Plain, quantity

_NEEDED = ("obliquity", "eccentricity", "longitude_of_perihelion")
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
        return [_signed(text) if isinstance(text, str) else text for text in value]
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
        """Convert an angle or a list of angles to rad."""
        angle = _in_radians(value, where, self.limit)
        return super().read(angle, replace(where, typed=False))

    def write(self, value: FloatArray) -> Plain:
        """Text of an angle for scene (input) files, in deg, or in rad if degrees are not exact."""
        if value.ndim:
            return [self.write(angle) for angle in value]
        degrees = round(math.degrees(value), 12)
        return f"{degrees!r} deg" if math.radians(degrees) == value else f"{float(value)!r} rad"


def _labelled(angle: Any, name: str, label: Any = None, **attrs: str) -> xr.DataArray:
    """Make a DataArray of angles (rad) along `name`, labelled by default with values in degrees."""
    dims = (name,) if np.ndim(angle) else ()
    # rounded, because radians are not exact
    label = np.degrees(angle).round(12) if label is None else label
    return xr.DataArray(angle, {name: (dims, label, attrs)}, dims)


# --- the question --------------------------------------------------------------------------------


class Insolation(
    long_term.LongTerm,
    word="insolation",
    call="insolation",
    positional=("start", "stop", "step"),
):
    """Insolation at the top of the atmosphere over millennia, daily or longer means (Berger 1978).

    Obliquity, eccentricity and perihelion are those of `long_term`, with all its inputs. Longitudes
    of the Sun are seen from the body along the orbit from the moving equinox: 0 is the March
    equinox, 90 degrees the June solstice. A true longitude is a place on the orbit. A day is one of
    a calendar in which the March equinox is always day 80, 21 March, of 365.2422 days: a mean
    longitude of (day - 80)/365.2422 turns (Huybers & Eisenman 2006). Other seasons then begin on
    days that change with the perihelion. A `window` is counted in the same year of 365.2422 days,
    because longitudes are counted from the moving equinox; for other bodies in the sidereal year.

    The answer is also along `latitude`, and along `longitude` or `day`, if these are lists. The
    label `epoch` is in Julian years from J2000.0 TDB. The error follows from those of obliquity,
    eccentricity and perihelion, which are treated as independent.

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

    exclusive = (*long_term.LongTerm.exclusive, (("longitude",), ("day",)))  # type: ignore[assignment]

    latitude: Annotated[FloatArray, AngleList("rad", "65 deg", (None,), True, np.pi / 2)] = key(
        "65 deg", doc='latitude, or a list; "65N" and "23.5S" are read, plain numbers are radians'
    )
    longitude: Annotated[FloatArray, AngleList("rad", "90 deg", (None,), True)] = key(
        "90 deg", doc="true longitude of the Sun, or a list; 90 degrees is the June solstice"
    )
    day: Annotated[FloatArray, Numbers("", "172", (None,), True)] | None = key(
        None, doc="day of the year, or a list, in place of longitude; 80 is the March equinox"
    )
    window: Annotated[float, Number("s", "30 d", above=0.0)] | None = key(
        None, doc="length of the average, centred on the longitude or day; one day if not given"
    )
    solar_constant: Annotated[float, Number("W/m2", "1361 W/m2", above=0.0)] | None = key(
        None,
        doc="solar constant at the mean distance of the body; if not given, 1361 W/m2 at one "
        "astronomical unit (many tables use 1365 or more)",
    )

    def check(self) -> None:
        """Refuse days outside the Earth's calendar, and a window of more than a year."""
        super().check()
        is_earth = self.body.known_as == EARTH.known_as
        if self.day is not None and not (is_earth and np.all((self.day >= 0) & (self.day < 367))):
            problem = "give days from 0 to 367 of the Earth's calendar, or a longitude"
            raise self.error("day", self.day.tolist(), problem)
        if self.window is not None and self.window > self.body.number("orbital_period"):
            raise self.error("window", f"{self.window / DAY:g} d", "give at most a year")


class InsolationSeries(Variables, along=("epoch",)):
    """Insolation, W/m2, at every epoch, latitude, and solar longitude or day of the year."""

    insolation = measured("W m-2", _SUNLIGHT, references=BERGER)
    epoch = labels()
    latitude = labels()
    longitude = labels(default=None)
    day = labels(default=None)


@part
def daily_means(
    series: xr.Dataset,
    latitude: FloatArray,
    longitude: FloatArray,
    day: FloatArray | None,
    window: float | None,
    solar_constant: float | None,
    body: Body,
) -> InsolationSeries:
    """Compute the insolation and its error at every epoch, latitude, and longitude or day."""
    place = _labelled(latitude, "latitude", units="deg", long_name="latitude")
    if day is None:
        words = "true longitude of the Sun from the moving equinox"
        season, sun = "longitude", _labelled(longitude, "longitude", units="deg", long_name=words)
    else:
        mean_longitude = _TURN * (day - MARCH_EQUINOX) / CALENDAR_YEAR
        words = f"day of the year, of which {MARCH_EQUINOX:g} is the March equinox"
        season, sun = "day", _labelled(mean_longitude, "day", day, units="d", long_name=words)
    count = series.epoch.size * place.size * sun.size
    if count > LONGEST_IN_MEMORY:
        problem = f"give fewer epochs or places; at most {LONGEST_IN_MEMORY} values fit into memory"
        raise SceneError("insolation", f"{count} values", problem)
    year = body.number("orbital_period")
    constant = _solar_constant(year) if solar_constant is None else solar_constant
    share = None if window is None else window / _year_of_seasons(body.known_as, year)
    coords = {"latitude": place.latitude.variable, season: sun[season].variable}
    single = [f"{name} {c.item():g} {c.attrs['units']}" for name, c in coords.items() if not c.ndim]
    length = "a day" if window is None else f"{window / DAY:g} d"
    attributes = {name: series.obliquity.attrs[name] for name in ("orbit", "orbit_of")}
    attributes["comment"] = ", ".join([f"mean over {length}", *single])
    return InsolationSeries(
        insolation=_with_error(series, place, sun, constant, share, day is None),
        epoch=series.epoch.variable,
        **coords,
    ).with_attributes(
        no_error=series.obliquity_error.attrs.get("no_error", ""),
        insolation={"solar_constant": constant, **attributes},
    )


@part
def neglected() -> Neglected:
    """Effects on the insolation that are neither modelled nor included in the errors."""
    return Neglected(what=f"changes of the Sun's brightness; {long_term.neglected().what}")


insolation = public_call(
    Insolation,
    answer=daily_means,
    sections={"long_term": long_term.series, "budget": long_term.budget, Neglected.PART: neglected},
    **long_term.SHARED,
)

# --- insolation from an answer -------------------------------------------------------------------


@progress("insolation")
def daily_insolation(
    result: xr.Dataset,
    latitude: Any,
    solar_longitude: Any,
    true_longitude: bool = True,
    *,
    days: Any = None,
    solar_constant: Any = None,
) -> xr.DataArray:
    """Insolation at the top of the atmosphere, averaged over one or more days (Berger 1978).

    Longitudes are those of the Sun as seen from the body, along the orbit from the moving equinox:
    0 is the March equinox, 90 degrees the June solstice. (The `longitude_of_perihelion` of an
    answer is that of the body, which differs from that of the Sun by 180 degrees.)

    Parameters
    ----------
    result : Dataset
        An answer of `long_term`, or of `read_solution`, which needs `solar_constant` and has no
        errors, so that those of the insolation are NaN.
    latitude : str, Quantity, DataArray or list of them
        Latitude, like ``"65 deg"`` or ``"65N"``; plain numbers are radians.
    solar_longitude : str, Quantity, DataArray or list of them
        Longitude of the Sun, like ``"90 deg"``.
    true_longitude : bool
        True for true longitudes, False for mean longitudes. Mean longitudes grow linearly with time
        from the March equinox, so that 90 degrees are a quarter of a year after the equinox.
    days : str, Quantity or float, optional
        Length of a time window for the average, like ``"30 d"``, centred on the instant of the
        longitude; by default, one day with the Sun at the longitude. A year of the Earth has
        365.2422 days, because longitudes are counted from the moving equinox.
    solar_constant : str, Quantity or float, optional
        Solar constant in W/m2 at the mean distance of the body; by default 1361 W/m2 at one
        astronomical unit (IAU 2015 Resolution B3). Many published tables use 1365 or more.

    Returns
    -------
    DataArray
        Insolation in W/m2 along `epoch`, and along `latitude` and `solar_longitude` if several are
        given. The coordinate `daily_insolation_error` is the 95 % half-width from those of
        obliquity, eccentricity and perihelion, which are treated as independent.

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
    >>> print(june.round(1).values)
    [476.4 527.3 479.3]
    """
    if not {*_NEEDED} <= {*getattr(result, "data_vars", ())}:
        raise Where("result", _CALL).error(type(result).__name__, "give an answer of long_term")
    if not isinstance(true_longitude, (bool, np.bool_)):
        raise Where("true_longitude", _CALL).error(true_longitude, "give True or False")
    body = str(result["obliquity"].attrs.get("orbit_of", ""))
    year, window = BODIES[body].orbital_period if body in BODIES else None, None
    mean = "mean over a day"
    if year is None and (days is not None or solar_constant is None):
        name, remove = body or "the body of this solution", " and remove days" * (days is not None)
        remedy = f"give solar_constant, like '1361 W/m2' for the Earth{remove}"
        raise UndefinedError(f"{_CALL}: the year of {name} is not known; {remedy}")
    if year is not None and days is not None:
        words = "give one length of time, at most a year"
        kind = Number("d", "30 d", above=0.0, high=year / DAY, limits=words)
        length = kind.read(days, Where("days", _CALL))
        window = length * DAY / _year_of_seasons(body, year)
        mean = f"mean over {length:g} d"
    if year is not None and solar_constant is None:
        constant = _solar_constant(year)
    else:
        flux = Number("W/m2", "1361 W/m2", above=0.0, limits="give one number above zero")
        constant = flux.read(solar_constant, Where("solar_constant", _CALL))
    place = _place(latitude, "latitude", np.pi / 2, result)
    sun = _place(solar_longitude, "solar_longitude", _TURN, result, place)
    value, error = _with_error(result, place, sun, constant, window, bool(true_longitude))
    error.attrs = {"units": "W m-2", "long_name": "95 % half-width of the daily insolation"}
    if f"{_NEEDED[0]}_error" not in result:
        error.attrs["no_error"] = "the solution has no errors"
    longitude = f"{'true' if true_longitude else 'mean'} longitude of the Sun"
    value.attrs = {
        "units": "W m-2",
        "long_name": _SUNLIGHT,
        "solar_constant": constant,
        "comment": f"{mean}; {longitude} from the moving equinox",
        "references": BERGER,
    }
    return value.rename(_CALL).assign_coords(daily_insolation_error=error)


def _place(
    value: Any, name: str, limit: float, result: xr.Dataset, *others: xr.DataArray
) -> xr.DataArray:
    """Convert latitudes or longitudes to a DataArray in rad; lists get the dimension `name`."""
    where = Where(name, _CALL)
    angle = _in_radians(value, where, limit)
    if not isinstance(angle, xr.DataArray):
        if np.ndim(angle) > 1:
            raise where.error(value, "give one angle, or one list of angles")
        return _labelled(angle, name, units="degree")
    try:
        xr.align(result["obliquity"], *others, angle, join="exact")
    except ValueError as misfit:
        problem = f"give it the labels of the result, like epoch=result.epoch ({misfit})"
        raise where.error("an array", problem) from None
    return angle


# --- the computation of both ---------------------------------------------------------------------


def _solar_constant(year: float) -> float:
    """Solar flux at the mean distance of a planet with a given sidereal year (s), W/m2."""
    distance = (SUN.gm * (year / _TURN) ** 2) ** (1 / 3)
    return float(SOLAR_CONSTANT.value * (AU / distance) ** 2)


def _year_of_seasons(body: str, sidereal: float) -> float:
    """Year of which windows are fractions, s: tropical for the Earth, sidereal for other bodies."""
    tropical = CALENDAR_YEAR * DAY / EARTH.number("orbital_period")
    return sidereal * (tropical if body == EARTH.known_as else 1.0)


def _with_error(
    result: xr.Dataset,
    latitude: xr.DataArray,
    longitude: xr.DataArray,
    solar_constant: float,
    window: float | None,
    is_true: bool,
) -> tuple[xr.DataArray, xr.DataArray]:
    """Compute insolation and its 95 % half-width from the obliquity and orbit in `result`.

    The half-width is NaN if the solution has no errors.
    """
    values = [result[name] for name in _NEEDED]
    errors = [result.get(f"{name}_error", np.nan * result[name]) for name in _NEEDED]
    arrays = [*map(si, values), *map(si, errors), latitude, longitude]
    labels = xr.broadcast(*arrays)[0]
    eps, e, w, *half_widths, phi, sun = (  # they broadcast along all dimensions without copies
        array.transpose(*labels.dims, missing_dims="ignore").values.reshape(
            [array.sizes.get(name, 1) for name in labels.dims] or [1]
        )
        for array in xr.align(*arrays, join="outer", copy=False)
    )
    pair = with_error(Season(eps, e, w), Season(*half_widths), phi, sun, is_true, window)
    value, error = (solar_constant * fraction.reshape(labels.shape) for fraction in pair)
    return labels.copy(data=value), labels.copy(data=error)
