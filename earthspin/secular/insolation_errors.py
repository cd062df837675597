"""95 % half-widths of insolation from those of orbit, obliquity and solar constant.

Inputs are treated as independent. Where a mean is a product of the light, which depends on the
obliquity, and of a factor of the orbit, only the part that an input changes is computed again.
Extremes and half-years change abruptly where two extremes swap or touch a level; there, and where
the perihelion is hardly known, all inputs are sampled together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from earthspin.numerics.arrays import Array, FloatArray
from earthspin.numerics.varied_inputs import Quantiles, draws
from earthspin.secular.insolation import Season

#: Half-width of the longitude of perihelion, rad, above which its contribution is sampled.
SAMPLED_FROM = 0.1
#: Sample all inputs if the changes by both signs of an input differ in size by more than this share
#: of the error, or if the half-width of the perihelion is larger than this, rad.
ASYMMETRY, WIDEST_PERIHELION = 0.5, 0.5

Mean = Callable[[Season], FloatArray]
Pair = tuple[FloatArray, FloatArray]


def of_product(
    light: Callable[[FloatArray], FloatArray], factor: Mean, season: Season, half_widths: Season
) -> Pair:
    """Mean insolation and half-width from light (by obliquity) and a factor of the orbit, over pi.

    Parameters
    ----------
    light : callable
        Depends on the obliquity.
    factor : callable
        Depends on eccentricity and perihelion of a `Season`.
    season, half_widths : Season
    """

    def of_obliquity(season: Season) -> FloatArray:
        return light(season.obliquity)

    by_tilt = _squared_changes(of_obliquity, season, half_widths, "obliquity")
    by_orbit = _squared_changes(factor, season, half_widths, "eccentricity", "perihelion")
    nearness, value = factor(season), of_obliquity(season)
    total = nearness**2 * by_tilt + value**2 * by_orbit
    return nearness * value / np.pi, np.sqrt(total / np.pi**2)


def of_mean(mean: Mean, season: Season, half_widths: Season) -> Pair:
    """Any mean that changes smoothly, and its half-width."""
    value = mean(season)
    squared = _squared_changes(mean, season, half_widths, *Season._fields)
    return value, np.broadcast_to(np.sqrt(squared), value.shape)


def _squared_changes(
    function: Mean, season: Season, half_widths: Season, *names: str
) -> FloatArray:
    """Sum of the squared changes of a function if each named element varies by its half-width."""

    def varied(name: str, multiple: float) -> FloatArray:
        value = getattr(season, name) + multiple * getattr(half_widths, name)
        return function(season._replace(**{name: value}))

    total: FloatArray = np.zeros(1)
    for name in names:
        half_width = getattr(half_widths, name)
        if np.isnan(half_width).all():
            return np.full(1, np.nan)
        change = (varied(name, 1) - varied(name, -1)) / 2
        if name == "perihelion" and np.any(half_width > SAMPLED_FROM):
            value, quantiles = function(season), Quantiles()
            for (multiple,) in draws(1):
                quantiles.add({name: varied(name, float(multiple)) - value})
            change = np.where(half_width <= SAMPLED_FROM, change, quantiles.at_probability()[name])
        total = total + change**2
    return total


# --- extremes and half-years ---------------------------------------------------------------------

Inputs = Mapping[str, FloatArray]


def of_abrupt(
    function: Callable[[Inputs], Mapping[str, FloatArray]],
    inputs: Inputs,
    half_widths: Inputs,
    angles: tuple[str, ...] = (),
) -> dict[str, Pair]:
    """Several quantities that may change abruptly, and their half-widths.

    Parameters
    ----------
    function : callable
        Quantities by name, from inputs by name.
    inputs, half_widths : mapping of str to ndarray, shape (n,)
        One row per epoch and place.
    angles : tuple of str
        Quantities that are angles, whose changes are at most half a turn.
    """
    nominal = function(inputs)
    if any(np.isnan(half_width).all() for half_width in half_widths.values()):
        return {name: (value, np.full_like(value, np.nan)) for name, value in nominal.items()}

    def changes(multiples: Inputs, rows: slice | Array = slice(None)) -> dict[str, FloatArray]:
        """Changes of all quantities if inputs vary by multiples of their half-widths."""
        varied = {
            name: (value + multiples.get(name, 0.0) * half_widths[name])[rows]
            for name, value in inputs.items()
        }
        change = {name: new - nominal[name][rows] for name, new in function(varied).items()}
        for name in angles:
            change[name] = (change[name] + np.pi) % (2 * np.pi) - np.pi
        return change

    square = {name: np.zeros_like(value) for name, value in nominal.items()}
    bend = {name: np.zeros_like(value) for name, value in nominal.items()}
    for cause, half_width in half_widths.items():
        if half_width.any():
            up, down = (changes({cause: np.array(side)}) for side in (1.0, -1.0))
            for name in nominal:
                square[name] += (up[name] - down[name]) ** 2 / 4
                bend[name] += (up[name] + down[name]) ** 2 / 4
    error = {name: np.sqrt(total) for name, total in square.items()}
    sampled = half_widths["perihelion"] > WIDEST_PERIHELION
    for name in nominal:
        sampled = sampled | (bend[name] > ASYMMETRY**2 * (square[name] + bend[name]))
    rows = np.flatnonzero(sampled)
    if rows.size:
        quantiles = Quantiles()
        for multiples in draws(len(inputs)):
            quantiles.add(changes(dict(zip(inputs, multiples, strict=True)), rows))
        for name, half_width in quantiles.at_probability().items():
            error[name][rows] = half_width
    return {name: (value, error[name]) for name, value in nominal.items()}
