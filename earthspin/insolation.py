"""Daily insolation, from an answer of `long_term`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import xarray as xr

from earthspin.bodies import BODIES, SUN
from earthspin.constants import AU, DAY, SOLAR_CONSTANT
from earthspin.engine.variables import si
from earthspin.errors import SceneError, UndefinedError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.progress import progress
from earthspin.secular.budget import Quantiles, draws
from earthspin.secular.insolation import Season, daily, daylight, inverse_square, over_days
from earthspin.secular.insolation import true_longitude as from_mean
from earthspin.units import quantity

_NEEDED = ("obliquity", "eccentricity", "longitude_of_perihelion")
_TURN = 2 * np.pi
_PERIHELION = _NEEDED.index("longitude_of_perihelion")
#: Half-width of the longitude of perihelion, rad, above which its contribution is sampled.
SAMPLED_FROM = 0.1
_CALL = "daily_insolation"


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
    """Insolation at the top of the atmosphere, averaged over a day (Berger 1978).

    Longitudes are those of the Sun as seen from the body, along the orbit from the moving equinox:
    0 is the March equinox, 90 degrees the June solstice. (The `longitude_of_perihelion` of an
    answer is that of the body, which differs from that of the Sun by 180 degrees.)

    Parameters
    ----------
    result : Dataset
        An answer of `long_term`.
    latitude : str, Quantity, DataArray or list of them
        Latitude, like ``"65 deg"``; plain numbers are radians.
    solar_longitude : str, Quantity, DataArray or list of them
        Longitude of the Sun, like ``"90 deg"``.
    true_longitude : bool
        True for true longitudes, False for mean longitudes. Mean longitudes grow linearly with time
        from the March equinox, so that 90 degrees are a quarter of a year after the equinox.
    days : str, Quantity or float, optional
        Length of a time window for the average, like ``"30 d"``, centred on the instant of the
        longitude; by default, one day with the Sun at the longitude.
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
    missing = [name for name in _NEEDED if name not in getattr(result, "data_vars", ())]
    if missing:
        raise SceneError(
            "result", type(result).__name__, "give an answer of long_term", source=_CALL
        )
    for name, angle in (("latitude", latitude), ("solar_longitude", solar_longitude)):
        try:
            xr.align(result["obliquity"], *[angle] * isinstance(angle, xr.DataArray), join="exact")
        except ValueError as misfit:
            problem = f"give it the labels of the result, like epoch=result.epoch ({misfit})"
            raise SceneError(name, "an array", problem, source=_CALL) from None
    if not isinstance(true_longitude, (bool, np.bool_)):
        raise Where("true_longitude", _CALL).error(true_longitude, "give True or False")
    body = str(result["obliquity"].attrs.get("orbit_of", ""))
    angles = [
        _angle(latitude, "latitude", np.pi / 2),
        _angle(solar_longitude, "solar_longitude", _TURN),
    ]
    share = _share(days, body)
    inputs = [si(result[f"{name}{kind}"]) for kind in ("", "_error") for name in _NEEDED]
    labels, arrays = _broadcastable(*inputs, *angles)
    middle, halves, (phi, sun) = arrays[:3], arrays[3:6], arrays[6:]
    if true_longitude and share is None:
        # Obliquity changes only the daylight, eccentricity and perihelion only the distance.
        def strength(eps: FloatArray, e: FloatArray, w: FloatArray) -> FloatArray:
            return inverse_square(Season(eps, e, w), sun)

        def light(eps: FloatArray, e: FloatArray, w: FloatArray) -> FloatArray:
            return daylight(eps, phi, sun)

        mean = strength(*middle) * light(*middle) / np.pi
        by_tilt = _squared_changes(light, middle, halves, (0,))
        by_orbit = _squared_changes(strength, middle, halves, (1, _PERIHELION))
        total = strength(*middle) ** 2 * by_tilt + light(*middle) ** 2 * by_orbit
        squares = total / np.pi**2
    else:

        def insolation(eps: FloatArray, e: FloatArray, w: FloatArray) -> FloatArray:
            season = Season(eps, e, w)
            true = sun if true_longitude else from_mean(season, sun)
            return (
                daily(season, phi, true) if share is None else over_days(season, phi, true, share)
            )

        mean = insolation(*middle)
        squares = _squared_changes(insolation, middle, halves, (0, 1, _PERIHELION))
    constant = _constant(solar_constant, body)
    error = labels.copy(data=(constant * squares**0.5).reshape(labels.shape))
    error.attrs = {"units": "W m-2", "long_name": "95 % half-width of the daily insolation"}
    answer = labels.copy(data=(constant * mean).reshape(labels.shape)).rename("daily_insolation")
    kind = "true" if true_longitude else "mean"
    answer.attrs = {
        "units": "W m-2",
        "long_name": "sunlight at the top of the atmosphere, mean over a day",
        "solar_constant": constant,
        "comment": f"{kind} longitude of the Sun from the moving equinox",
        "references": "Berger 1978, J. Atmos. Sci. 35, 2362",
    }
    return answer.assign_coords(daily_insolation_error=error)


def _broadcastable(*arrays: xr.DataArray) -> tuple[xr.DataArray, list[FloatArray]]:
    """Labels of all dimensions, and arrays that broadcast along them without copies."""
    labels = xr.broadcast(*arrays)[0]
    aligned = xr.align(*arrays, join="outer", copy=False)
    return labels, [
        array.transpose(*labels.dims, missing_dims="ignore").values.reshape(
            [array.sizes.get(name, 1) for name in labels.dims] or [1]
        )
        for array in aligned
    ]


def _squared_changes(
    function: Callable[..., FloatArray],
    middle: Sequence[FloatArray],
    halves: Sequence[FloatArray],
    places: Sequence[int],
) -> FloatArray:
    """Sum of the squared changes of a function due to half-widths of some of its arguments."""
    total: FloatArray = np.zeros(1)
    for place in places:
        half = halves[place]

        def moved(by: float, place: int = place, half: FloatArray = half) -> FloatArray:
            changed = list(middle)
            changed[place] = changed[place] + by * half
            return function(*changed)

        share = (moved(1) - moved(-1)) / 2
        if place == _PERIHELION and np.any(half > SAMPLED_FROM):
            value, quantiles = function(*middle), Quantiles()
            for (by,) in draws(1):
                quantiles.add({_CALL: moved(float(by)) - value})
            share = np.where(half <= SAMPLED_FROM, share, quantiles.at_probability()[_CALL])
        total = total + share**2
    return total


def _angle(value: Any, name: str, most: float) -> xr.DataArray:
    """Convert an input angle to rad; a list becomes an array labelled in degrees along `name`."""
    where = Where(name, _CALL)
    angle = quantity(value, "rad", where, "65 deg")
    if np.max(np.abs(np.asarray(angle))) > most * (1 + 1e-12):
        raise where.error(value, f"give at most {np.degrees(most):g} degrees, like '65 deg'")
    if isinstance(angle, xr.DataArray):
        return angle
    if np.ndim(angle) > 1:
        raise where.error(value, "give one angle, or one list of angles")
    dims = (name,) if np.ndim(angle) else ()
    label = (dims, np.degrees(angle), {"units": "degree"})
    return xr.DataArray(angle, dims=dims, coords={name: label})


def _share(days: Any, body: str) -> float | None:
    """Convert the length of an averaging window from days to a fraction of the year."""
    if days is None:
        return None
    where = Where("days", _CALL)
    length, year = quantity(days, "d", where, "30 d"), _year(body)
    if np.ndim(length) or not 0 < length * DAY <= year:
        raise where.error(days, "give one length of time, at most a year")
    return float(length * DAY / year)


def _year(body: str) -> float:
    """Length of a body's sidereal year, s."""
    year = BODIES[body].orbital_period if body in BODIES else None
    if year is None:
        raise UndefinedError(
            f"{_CALL}: the year of {body or 'this body'} is not known; give solar_constant, and "
            "remove days"
        )
    return year


def _constant(value: Any, body: str) -> float:
    """Solar constant at the body's mean distance from the Sun, W/m2."""
    if value is None:
        distance = (SUN.gm * (_year(body) / _TURN) ** 2) ** (1 / 3)
        return float(SOLAR_CONSTANT.value * (AU / distance) ** 2)
    where = Where("solar_constant", _CALL)
    constant = quantity(value, "W/m2", where, "1361 W/m2")
    if np.ndim(constant) or not constant > 0:
        raise where.error(value, "give one number above zero")
    return float(constant)
