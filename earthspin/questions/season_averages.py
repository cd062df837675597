"""Averages of insolation from a solution of obliquity and orbit, as labelled arrays with errors."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin._lazy import xr
from earthspin.engine.variables import si
from earthspin.numerics.arrays import FloatArray
from earthspin.secular.caloric import (
    caloric_half_years,
    crossings,
    integral_above,
    share_above,
)
from earthspin.secular.insolation import (
    Band,
    Place,
    Season,
    daily,
    daylight,
    inverse_square,
    true_longitude,
)
from earthspin.secular.insolation_errors import Inputs, Pair, of_abrupt, of_mean, of_product
from earthspin.secular.insolation_extremes import extremes, yearly_range
from earthspin.secular.season_means import light, over_window, pace, rate, yearly_light

#: Variables of a solution that insolation is computed from.
ELEMENTS = ("obliquity", "eccentricity", "longitude_of_perihelion")
#: Inputs that each average reads beside the solution and the solar constant.
READS: Mapping[str, tuple[str, ...]] = {
    "day": ("latitude", "longitude", "mean_longitude", "day"),
    "interval": ("latitude", "longitude"),
    "window": ("latitude", "longitude", "mean_longitude", "day", "window"),
    "year": ("latitude",),
    "caloric": ("latitude",),
    "above": ("latitude", "threshold"),
    "extremes": ("latitude",),
    "all-extremes": ("latitude",),
    "seasons": (),
}
#: Averages that are also computed for bands of latitude, between two latitudes.
OF_BANDS = ("day", "interval", "window", "year")
#: True longitude of the Sun, rad, at the beginning of each season.
SEASONS = {
    "March equinox to June solstice": 0.0,
    "June solstice to September equinox": np.pi / 2,
    "September equinox to December solstice": np.pi,
    "December solstice to March equinox": 1.5 * np.pi,
}
#: Rows computed together; with fewer, the calls for the last roots of each block take longer.
ROWS = 30_000
#: Most extremes in a year, with both edges of the polar night.
MOST_EXTREMES = 10

Pairs = dict[str, tuple[Any, Any]]
Rows = Callable[..., Mapping[str, Pair]]


@dataclass(frozen=True)
class Average:
    """Kind of average, its places and times, and the solar constant.

    Attributes
    ----------
    mean : str
        One of `READS`.
    places : tuple of DataArray
        Latitude, or southern and northern latitude of a band; empty for lengths of seasons.
    sun : tuple of DataArray
        Longitude of the Sun, or the first and last longitude of an interval, rad.
    is_true : bool
        Whether they are true longitudes; mean longitudes if False.
    constant, constant_error : float
        Solar constant and its 95 % half-width, W/m2.
    year : float
        s.
    window : float or None
        s.
    threshold : float or None
        W/m2.
    """

    mean: str
    places: tuple[xr.DataArray, ...]
    sun: tuple[xr.DataArray, ...]
    is_true: bool
    constant: float
    constant_error: float
    year: float
    window: float | None = None
    threshold: float | None = None

    def of(self, solution: xr.Dataset) -> Pairs:
        """Variables of the answer by name, each with its half-width, in SI units."""
        places = (*self.places, *self.sun)
        if self.mean == "day":
            return _computed(solution, places, self._smooth)
        compute: dict[str, Rows] = {"seasons": self._length, "all-extremes": self._all_extremes}
        other: Rows = self._smooth if self.mean in OF_BANDS else self._abrupt
        pairs = _by_row(solution, places, compute.get(self.mean, other))
        if self.mean == "interval":
            pairs |= _by_row(solution, self.sun, self._length)
        if self.mean == "window":
            length = xr.full_like(solution[ELEMENTS[0]], self.window)
            pairs["length"] = (length, 0 * length)
        if self.mean == "caloric":
            for name in ("caloric_summer", "caloric_winter"):
                value, error = pairs[name]
                pairs[f"{name}_energy"] = (value * self.year / 2, error * self.year / 2)
        return pairs

    # --- means that change smoothly --------------------------------------------------------------

    def _smooth(self, season: Season, errors: Season, *arrays: FloatArray) -> dict[str, Pair]:
        place: Place = Band(*arrays[:2]) if len(self.places) == 2 else arrays[0]
        value, error = self._fraction(season, errors, place, *arrays[len(self.places) :])
        scaled = self.constant * error
        if self.constant_error:
            scaled = np.hypot(scaled, self.constant_error * value)
        name = "annual_mean" if self.mean == "year" else "insolation"
        return {name: (self.constant * value, scaled)}

    def _fraction(self, season: Season, errors: Season, place: Place, *sun: FloatArray) -> Pair:
        """Mean insolation as a fraction of the solar constant, and its half-width."""
        products: dict[str, tuple[Any, Any]] = {
            "day": (
                lambda tilt: daylight(tilt, place, *sun),
                lambda orbit: inverse_square(orbit, *sun),
            ),
            "interval": (lambda tilt: light(tilt, place, *sun), lambda orbit: rate(orbit, *sun)),
            "year": (
                lambda tilt: yearly_light(tilt, place),
                lambda orbit: 1 / np.sqrt(1 - orbit.eccentricity**2),
            ),
        }
        if self.is_true and self.mean in products:
            return of_product(*products[self.mean], season, errors)

        def mean(orbit: Season) -> FloatArray:
            true = sun[0] if self.is_true else true_longitude(orbit, sun[0])
            if self.window is None:
                return daily(orbit, place, true)
            return over_window(orbit, place, true, self.window / self.year)

        return of_mean(mean, season, errors)

    def _length(
        self, season: Season, errors: Season, first: FloatArray, last: FloatArray
    ) -> dict[str, Pair]:
        """Time between two true longitudes, s."""
        pair = of_product(
            lambda obliquity: np.full_like(obliquity, self.year / 2),
            lambda orbit: pace(orbit, first, last) * (last - first),
            season,
            errors,
        )
        return {"season_length" if self.mean == "seasons" else "length": pair}

    # --- extremes and half-years -----------------------------------------------------------------

    def _abrupt(self, season: Season, errors: Season, latitude: FloatArray) -> dict[str, Pair]:
        constant = np.full_like(latitude, self.constant)
        inputs = {**season._asdict(), "constant": constant, "latitude": latitude}
        error = np.full_like(latitude, self.constant_error)
        half_widths = {**errors._asdict(), "constant": error, "latitude": 0 * latitude}
        function, angles = {
            "caloric": (self._caloric, ("caloric_start", "caloric_end")),
            "above": (self._above, ()),
            "extremes": (self._range, ("longitude_of_largest", "longitude_of_smallest")),
        }[self.mean]
        return of_abrupt(function, inputs, half_widths, angles)

    def _caloric(self, inputs: Inputs) -> dict[str, FloatArray]:
        halves = caloric_half_years(_season(inputs), inputs["latitude"])._asdict()
        scaled = {name: inputs["constant"] * halves[name] for name in ("summer", "winter", "level")}
        return {f"caloric_{name}": value for name, value in (halves | scaled).items()}

    def _above(self, inputs: Inputs) -> dict[str, FloatArray]:
        assert self.threshold is not None  # `mean = "above"` requires it
        season, latitude, constant = _season(inputs), inputs["latitude"], inputs["constant"]
        at = crossings(season, latitude, self.threshold / constant, extremes(season, latitude))
        days = self.year * share_above(season, at)
        integral = self.year * constant * integral_above(season, latitude, at)
        excess = integral - self.threshold * days
        return {"integrated_summer": integral, "days_above": days, "excess": excess}

    def _range(self, inputs: Inputs) -> dict[str, FloatArray]:
        values = yearly_range(_season(inputs), inputs["latitude"])._asdict()
        for name in ("largest", "smallest"):
            values[name] = inputs["constant"] * values[name]
        return values

    def _all_extremes(
        self, season: Season, errors: Season, latitude: FloatArray
    ) -> dict[str, Pair]:
        """All extremes; to first order their errors are those of the days on which they are."""
        at = np.full((latitude.size, MOST_EXTREMES), np.nan)
        every = extremes(season, latitude)
        at[:, : every.shape[1]] = every
        season, errors = (Season(*(q[:, np.newaxis] for q in s)) for s in (season, errors))
        value, error = of_product(
            lambda obliquity: daylight(obliquity, latitude[:, np.newaxis], at),
            lambda orbit: inverse_square(orbit, at),
            season,
            errors,
        )
        error = np.hypot(self.constant * error, self.constant_error * value)
        return {"extreme_insolation": (self.constant * value, error), "extreme_longitude": (at, at)}


def _season(inputs: Inputs) -> Season:
    """Elements of the orbit; a negative eccentricity is half a turn of the perihelion."""
    e = inputs["eccentricity"]
    perihelion = inputs["perihelion"] + np.where(e < 0, np.pi, 0.0)
    return Season(inputs["obliquity"], np.abs(e), perihelion)


# --- labelled arrays -----------------------------------------------------------------------------


def _broadcast(
    solution: xr.Dataset, places: tuple[xr.DataArray, ...]
) -> tuple[xr.DataArray, list[FloatArray]]:
    """Labels of the answer, and elements, half-widths and places that broadcast along them.

    Half-widths are NaN if the solution has no errors.
    """
    values = [solution[name] for name in ELEMENTS]
    errors = [solution.get(f"{name}_error", np.nan * solution[name]) for name in ELEMENTS]
    arrays = [*map(si, values), *map(si, errors), *places]
    labels = xr.broadcast(*arrays)[0]
    broadcast = [  # without copies
        array.transpose(*labels.dims, missing_dims="ignore").values.reshape(
            [array.sizes.get(name, 1) for name in labels.dims] or [1]
        )
        for array in xr.align(*arrays, join="outer", copy=False)
    ]
    return labels, broadcast


def _computed(solution: xr.Dataset, places: tuple[xr.DataArray, ...], compute: Rows) -> Pairs:
    """Apply a function to the arrays of all labels in one call."""
    labels, arrays = _broadcast(solution, places)
    pairs = compute(Season(*arrays[:3]), Season(*arrays[3:6]), *arrays[6:])
    return {
        name: tuple(labels.copy(data=part.reshape(labels.shape)) for part in pair)  # type: ignore[misc]
        for name, pair in pairs.items()
    }


def _by_row(solution: xr.Dataset, places: tuple[xr.DataArray, ...], compute: Rows) -> Pairs:
    """Apply a function to flat arrays, in blocks of rows.

    A second axis of its values becomes the dimension `extreme`.
    """
    labels, arrays = _broadcast(solution, places)
    whole = [np.broadcast_to(array, labels.shape or (1,)) for array in arrays]
    blocks: dict[str, list[Pair]] = {}
    for start in range(0, max(labels.size, 1), ROWS):
        rows = [array.flat[start : start + ROWS] for array in whole]
        pairs = compute(Season(*rows[:3]), Season(*rows[3:6]), *rows[6:])
        for name, pair in pairs.items():
            blocks.setdefault(name, []).append(pair)
    result: Pairs = {}
    for name, several in blocks.items():
        parts = (np.concatenate(part) for part in zip(*several, strict=True))
        result[name] = tuple(  # type: ignore[assignment]
            labels.copy(data=part.reshape(labels.shape))
            if part.ndim == 1
            else xr.concat(
                [labels.copy(data=column.reshape(labels.shape)) for column in part.T], "extreme"
            )
            for part in parts
        )
    return result
