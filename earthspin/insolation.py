"""Daily insolation, from an answer of `long_term`."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from earthspin.bodies import BODIES, SUN, Numeric
from earthspin.constants import AU, DAY, SOLAR_CONSTANT
from earthspin.engine.variables import si
from earthspin.errors import SceneError, UndefinedError, Where
from earthspin.progress import progress
from earthspin.secular.budget import Quantiles, draws
from earthspin.secular.insolation import Season, daily, over_days, true_longitude
from earthspin.units import quantity

_NEEDED = ("obliquity", "eccentricity", "longitude_of_perihelion")
_TURN = 2 * np.pi
_TURNING = "longitude_of_perihelion"
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
    if not isinstance(true_longitude, (bool, np.bool_)):
        raise Where("true_longitude", _CALL).error(true_longitude, "give True or False")
    body = str(result["obliquity"].attrs.get("orbit_of", ""))
    phi = _angle(latitude, "latitude", np.pi / 2)
    sun = _angle(solar_longitude, "solar_longitude", _TURN)
    insolation = partial(
        _insolation, latitude=phi, longitude=sun, true=true_longitude, share=_share(days, body)
    )
    middle = [si(result[name]) for name in _NEEDED]
    value = insolation(*middle)
    squares = xr.zeros_like(value)
    for place, name in enumerate(_NEEDED):
        half = si(result[f"{name}_error"])

        def moved(by: Numeric, place: int = place, half: xr.DataArray = half) -> xr.DataArray:
            changed = list(middle)
            changed[place] = changed[place] + by * half
            return insolation(*changed)

        share = (moved(1) - moved(-1)) / 2
        if name == _TURNING and bool((half > SAMPLED_FROM).any()):
            share = share.where(half <= SAMPLED_FROM, _quantile(moved, value))
        squares = squares + share**2
    constant = _constant(solar_constant, body)
    error: xr.DataArray = constant * squares**0.5
    error.attrs = {"units": "W m-2", "long_name": "95 % half-width of the daily insolation"}
    answer = (constant * value).rename("daily_insolation")
    kind = "true" if true_longitude else "mean"
    answer.attrs = {
        "units": "W m-2",
        "long_name": "sunlight at the top of the atmosphere, mean over a day",
        "solar_constant": constant,
        "comment": f"{kind} longitude of the Sun from the moving equinox",
        "references": "Berger 1978, J. Atmos. Sci. 35, 2362",
    }
    return answer.assign_coords(daily_insolation_error=error)


def _quantile(moved: Callable[[float], xr.DataArray], value: xr.DataArray) -> xr.DataArray:
    """95 % half-width of insolation due to random errors of the longitude of perihelion."""
    quantiles = Quantiles()
    for (by,) in draws(1):
        quantiles.add({_CALL: (moved(float(by)) - value).values})
    return value.copy(data=quantiles.at_probability()[_CALL])


def _insolation(
    obliquity: xr.DataArray,
    eccentricity: xr.DataArray,
    perihelion: xr.DataArray,
    *,
    latitude: xr.DataArray,
    longitude: xr.DataArray,
    true: bool,
    share: float | None,
) -> xr.DataArray:
    """Insolation divided by the solar constant, averaged over a day or over a part of the year."""
    arrays = xr.broadcast(obliquity, eccentricity, perihelion, latitude, longitude)
    eps, e, w, phi, sun = (array.values for array in arrays)
    season = Season(eps, e, w)
    sun = sun if true else true_longitude(season, sun)
    mean = daily(season, phi, sun) if share is None else over_days(season, phi, sun, share)
    return arrays[0].copy(data=mean)


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
