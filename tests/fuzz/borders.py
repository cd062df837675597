"""Dates, quantities, vectors, names with markup, attributes and whole numbers, all executed."""

import datetime as dt
import random
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import cftime
import numpy as np
import pandas as pd
import pint
import xarray as xr
from astropy import units as u
from astropy.time import Time

import earthspin
from earthspin.errors import Where
from earthspin.scenes import Scene
from earthspin.units import Numbers
from earthspin.views.rendering import scene_page

Random = random.Random
PINT = pint.UnitRegistry()


def julian_day(year: int, month: int, day: int) -> int:
    """Julian day number at noon, proleptic Gregorian (Fliegel and Van Flandern)."""
    a = (14 - month) // 12
    y, m = year + 4800 - a, month + 12 * a - 3
    return day + (153 * m + 2) // 5 + 365 * y + y // 4 - y // 100 + y // 400 - 32045


def spellings(year: int, month: int, day: int) -> list[Any]:
    """One instant, 0h TDB of a day, as a user may write it."""
    sign = "-" if year < 0 else "+" if year > 9999 else ""
    date = f"{sign}{abs(year):04d}-{month:02d}-{day:02d}"
    words: list[Any] = [date, f"{date}T00:00", f"{date}T00:00:00.000000000"]
    words += [np.datetime64(date.removeprefix("+"), unit) for unit in ("D", "h", "m", "s", "ms")]
    words += [cftime.datetime(year, month, day, calendar="proleptic_gregorian", has_year_zero=True)]
    if 1 <= year <= 9999:
        words += [dt.datetime(year, month, day), np.datetime64(date, "us")]
    if 1700 <= year <= 2200:
        words += [pd.Timestamp(date), np.datetime64(date, "ns"), Time(date, scale="tdb")]
    return words


def date(rng: Random) -> tuple[str, Callable[[], None]]:
    """Two spellings of one instant, which must agree with each other and with the Julian day."""
    year = rng.choice((0, rng.randrange(1, 3000), rng.randrange(-9999, 20000)))
    day = (year, rng.randrange(1, 13), rng.randrange(1, 29))
    chosen = rng.sample(spellings(*day), 2)

    def ask() -> None:
        years = (julian_day(*day) - 0.5 - 2451545.0) / 365.25
        try:
            epochs = [float(earthspin.long_term(times=[one]).epoch[0]) for one in chosen]
        except earthspin.EarthspinError as error:
            raise AssertionError(f"refused: {error}") from None
        if max(abs(epoch - years) for epoch in epochs) > 1e-11:  # 0.3 ms
            raise AssertionError(f"epochs {epochs}, by the Julian day {years}")

    return f"{chosen!r}", ask


def _grouped(number: float, space: str) -> str:
    return f"{number:,}".replace(",", space)


def quantity(rng: Random) -> tuple[str, Callable[[], None]]:
    """Two spellings of one length of the day, which must be the decimal number times its unit."""
    number = rng.choice((rng.randrange(1000, 10**7), rng.randrange(1, 10**6) / 100))
    ours, theirs, seconds = rng.choice(
        (("s", "second", 1), ("min", "minute", 60), ("h", "hour", 3600))
    )
    pints = PINT.Quantity(float(number), theirs)
    words = [f"{number} {ours}", *(f"{_grouped(number, s)} {theirs}s" for s in " \u00a0\u202f")]
    objects = [number * u.Unit(ours), pints, *words]
    arrays = [pd.Series([value]) for value in objects] + [np.array([v], object) for v in objects]
    arrays += [xr.DataArray(array, dims="n") for array in arrays]
    value, array = rng.choice(objects), rng.choice(arrays)
    exact = float(Fraction(str(number)) * seconds)

    def ask() -> None:
        period = earthspin.EARTH.replace(spin_period=value).spin_period
        listed = Numbers("s", "6 h", (None,)).read(array, Where("times"))
        if [period, *listed] != [exact, exact]:
            raise AssertionError(f"read as {period!r} and {listed}, which is {exact!r}")

    return f"{value!r}, {array!r}", ask


def components(rng: Random) -> tuple[str, Callable[[], None]]:
    """A vector with its labels in any order and along any axis: the same as in order."""
    rows = np.array([[rng.random() for _ in "xyz"] for _ in range(rng.randrange(1, 4))])
    name, order = rng.choice(("component", "axis", "c")), rng.sample("xyz", 3)
    array = xr.DataArray(rows, dims=("n", name), coords={name: list("xyz")}).sel({name: order})
    value = rng.choice((array, array.T, pd.DataFrame(rows, columns=list("xyz"))))

    def ask() -> None:
        if not np.array_equal(Numbers("m", "1 m", (None, 3)).read(value, Where("position")), rows):
            raise AssertionError(f"not {rows}")

    return f"{value!r}", ask


#: Dates with a meaning or a limit of their own: an answer or one line.
WORDS = (
    "10,000 BC", "AD 1", "10 000 BC", "10,000 B.C.", "0 BC", "2016-12-31T23:59:60Z", "12 hours",
    "2015-12-31T23:59:60Z", "0000-06-15T12:00", "JD 2451545.0", "1 year",
    "2000-01-01T00:00:00.1234567891",
    *(cftime.datetime(2000, 1, 30, calendar=name) for name in ("360_day", "julian", "noleap")),
)  # fmt: skip
NAMES = ("$\\frac{a}{$", "_moon", "<b>x</b>", "[red]", "a'b", 'a"b', "a\nb", "{x}", "^_$", "a%b")
ATTRIBUTES = (np.arange(3), np.eye(2), 3 * u.m, xr.DataArray([1.0]), {"a": 1}, None, 1 + 2j, "\0")
WHOLE = (np.int64(2), np.uint8(2), np.bool_(True), np.timedelta64(2, "s"), np.float64(2.0))


def odd(rng: Random) -> tuple[str, Callable[[], None]]:
    """A date, a name, an attribute or a whole number from the classes above."""
    word, name, value, whole = (rng.choice(one) for one in (WORDS, NAMES, ATTRIBUTES, WHOLE))
    key = rng.choice(("scene", "x", "compute", "step"))
    result = xr.Dataset({"x": 3.0}, attrs={key: value})
    calls: dict[str, Callable[[], Any]] = {
        f"long_term({word!r})": lambda: earthspin.long_term(times=[word]),
        f"torque_series({word!r})": lambda: earthspin.torque_series(times=[word]),
        f"page of {name!r}": lambda: page(name),
        f"write {key}={value!r}": lambda: earthspin.write(
            result, f"x.{rng.choice(('nc', 'zarr'))}"
        ),
        f"n={whole!r}": lambda: earthspin.ensemble("precession", 3, block=whole, seed=whole),
        f"members={whole!r}": lambda: earthspin.ensemble("precession", whole, rng=whole),
    }
    return rng.choice(list(calls.items()))


def page(name: str) -> None:
    """Draw the page of an answer with a perturber of a name."""
    bodies, span = ["sun", earthspin.MOON.replace(name=name)], ["2000-01-01", "2000-01-03"]
    scene = Scene(compute="torque", perturbers=bodies, span=span, step="6 h")
    scene_page(earthspin.run_tree(scene, ()))
