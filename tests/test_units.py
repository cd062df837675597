"""The border: what is taken, what is refused, and that nothing is lost on the way."""

import datetime as dt
import math
import warnings
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

import astropy.units as u
import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr
from astropy.table import Column
from hypothesis import given
from hypothesis import strategies as st

import earthspin
from earthspin import EarthspinError, SceneError, UnitsError, units
from earthspin.constants import DAY
from earthspin.errors import Where
from earthspin.units import COMMON, Number, Numbers, Several, Text, Whole, Word, kind_of
from tests.refusals import refused

STEP = Where("step")
SECONDS = Number("s", "6 h")


@pytest.mark.parametrize(
    "value", ["6 h", 6 * u.h, dt.timedelta(hours=6), np.timedelta64(6, "h"), 21600, 21600.0]
)
def test_durations(value: object) -> None:
    assert SECONDS.read(value, STEP) == 21600.0


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        *[(f"6{space}378 km", "m", 6.378e6) for space in " \u00a0\u2009\u202f"],
        *[("6 378.137 km", "m", 6378137.0), ("6 378.137 500 km", "m", 6378137.5)],
        *[("-6 378 km", "m", -6.378e6), ("1 361 W/m2", "W/m2", 1361.0)],
        *[("5 972 200 000 Zg", "kg", 5.9722e27), ("1 000 1/s", "1/s", 1e3), ("10 000", "", 1e4)],
    ],
)
def test_digits_in_groups_of_three_are_one_number(text: str, unit: str, value: float) -> None:
    assert units.quantity(text, unit, Where("it"), "1") == pytest.approx(value, rel=1e-15, abs=0)


test_a_text_with_two_numbers_is_refused = refused(
    *[
        (text, "more than one number")
        for text in ("6 37 km", "6 3788 km", "1234 567 km", "0 500 m")
    ],
    *[
        (text, "more than one number")
        for text in ("6 1 km", "6,378 km", "6 378.1 36 km", "6 (3 km)")
    ],
    ("6  378 km", "more than one number; write one, like '1 m'"),
    call=lambda text: units.quantity(text, "m", Where("it"), "1 m"),
)
test_fractions_of_a_year_are_refused = refused(
    *[(text, "it = '3 m.*' is 0.001 .*; write 'Myr'") for text in ("3 myr", "3 ma")],
    *[(text, "; write 'yr'") for text in ("3 uyr", "3 nyr", "3 ayr", 3 * u.Unit("cyr"))],
    # an old astropy does not know "as"
    *[("1 as", "write"), ("1 fs", "; write 's'"), ("1 md", "write 'd'")],
    ("1 kyr BP", UnitsError, "6 h"),
    call=lambda value: units.quantity(value, "s", Where("it"), "6 h"),
)


class OfMinutes(np.ndarray):
    """An array with a unit, as other libraries have them."""

    unit = "minute"


class Minute(float):
    """A number with a unit."""

    units = "min"


MINUTES = pint.UnitRegistry().Quantity([10.0, 20.0], "minute")


@pytest.mark.parametrize(
    "value",
    [
        *(MINUTES, list(MINUTES), np.array([*MINUTES], dtype=object), pd.Series([*MINUTES])),
        *(xr.DataArray(MINUTES, dims="n"), xr.DataArray(np.array([*MINUTES], object), dims="n")),
        *([10 * u.min, MINUTES[1]], np.array([10 * u.min, 20 * u.min], dtype=object)),
        *(pd.Series([10 * u.min, "20 min"]), np.array(["10 min", "20 minutes"])),
        *(np.array([10.0, 20.0]).view(OfMinutes), [Minute(10), Minute(20)]),
        *(Column([10.0, 20.0], unit="min"), pd.to_timedelta([10, 20], unit="min")),
        xr.DataArray([10.0, 20.0], dims="n", attrs={"units": "minutes"}),
    ],
    ids=lambda value: type(value).__name__,
)
def test_a_unit_is_never_stripped(value: object) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read = units.quantity(value, "s", Where("it"), "6 h")
        assert np.array_equal(read, [600.0, 1200.0])
        assert Numbers("s", "6 h", (None,)).read(value, STEP).tolist() == [600.0, 1200.0]
        with pytest.raises(UnitsError):
            units.quantity(value, "kg", Where("it"), "1 kg")
    assert not hasattr(read, "dims") or read.attrs.get("units", "s") == "s"


def test_units_of_the_names_of_pint() -> None:
    ask = pint.UnitRegistry().Quantity
    for name, unit in (
        *(("kilometer ** 3 / second ** 2", "m3/s2"), ("newton * meter", "N m")),
        *(("degree", "rad"), ("milliarcsecond", "rad"), ("dimensionless", ""), ("year", "s")),
    ):
        read = units.quantity(ask(2.5, name), unit, Where("it"), "1")
        assert read == pytest.approx(ask(2.5, name).to_base_units().m, rel=1e-14, abs=0)
    earth = earthspin.EARTH.replace(spin_period=ask(8e4, "minute"), radius=ask(6378.0, "km"))
    assert (earth.spin_period, earth.radius) == (4.8e6, 6.378e6)
    assert earthspin.Body(name="x", gm=ask(1.0, "km**3/s**2")).gm == 1e9


test_angles_beyond_a_turn_need_a_unit = refused(
    (lambda: earthspin.EARTH.replace(pole=(266.86, 1.2)), "pole = 266.86 .* '266.86 deg'"),
    (lambda: earthspin.Body(name="x", gm=1e14, pole=(266.86, 1.2)), "'266.86 deg'"),
    (lambda: earthspin.MARS.replace(obliquity=25.19), "'25.19 deg'"),
    (lambda: earthspin.Orbit(a="1 au", mean_anomaly=-135.0), "'-135.0 deg'"),
    (lambda: earthspin.Body(name="x", gm=1e14, long_axis=52.3), "'52.3 deg'"),
    (lambda: Numbers("rad", "3 deg", (None,)).read([1.0, 8.0], STEP), "'8.0 deg'"),
)


def test_an_angle_with_a_unit_may_be_more_than_a_turn() -> None:
    assert units.quantity("8 rad", "rad", STEP, "3 deg") == 8.0
    orbit = earthspin.Orbit(a="1 au", mean_anomaly="540 deg")
    assert replace(orbit, e=0.1).mean_anomaly == pytest.approx(math.pi, rel=1e-15, abs=0)
    assert earthspin.MOON.replace(long_axis="-370 deg").replace(k2=0.0).long_axis < 0


XYZ = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]


@pytest.mark.parametrize(
    "value",
    [
        xr.DataArray(XYZ, dims=("n", "component")),
        xr.DataArray(XYZ, dims=("n", "component"), coords={"component": ["x", "y", "z"]}),
        xr.DataArray(XYZ, dims=("n", "c"), coords={"c": ["x", "y", "z"]})[:, ::-1].T,
        pd.DataFrame(XYZ, columns=["x", "y", "z"]),
        pd.DataFrame(XYZ),
    ],
)
def test_components_are_taken_by_their_labels(value: object) -> None:
    assert Numbers("m", "1 km", (None, 3)).read(value, STEP).tolist() == XYZ
    assert units.vectors(value, "m", STEP, "1 km").tolist() == XYZ


@pytest.mark.parametrize("columns", ["xyz", "zxy"])
def test_masses_and_meshes_are_placed_by_labels(columns: str) -> None:
    """Three moments of two masses of 1 kg on the x axis: 0, 2 and 2 kg m2."""
    labels = {"axis": list("xyz")}
    places = xr.DataArray([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], labels, ("n", "axis"))
    places = places.sel(axis=[*columns])
    masses = earthspin.Body.from_masses([1.0, 1.0], places)
    assert masses.moments == pytest.approx([0.0, 2.0, 2.0], abs=1e-15)
    corners = xr.DataArray([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2.0]], labels, ("n", "axis"))
    mesh = corners.sel(axis=[*columns]), [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    body = earthspin.Body.from_mesh(mesh, density=1.0)
    assert body.gm == pytest.approx(earthspin.constants.G.value / 3, rel=1e-14, abs=0)


test_other_labels_are_refused = refused(
    (xr.DataArray(XYZ, dims=("n", "c"), coords={"c": ["x", "y", "w"]}), "components x, y and z"),
    (pd.DataFrame(XYZ, columns=["z", "x", "y"]), "or bare numbers"),
    (pd.DataFrame(XYZ, columns=["A", "B", "C"]), r"\['A', 'B', 'C'\]"),
    call=lambda value: Numbers("m", "1 km", (None, 3)).read(value, STEP),
)


def test_arcsec_per_century_is_not_arcsec_per_cycle() -> None:
    rate = units.quantity(
        5040.4 * u.arcsec / (100 * u.yr), "arcsec/yr", Where("rate"), "50 arcsec/yr"
    )
    assert np.isclose(rate, 50.404, rtol=1e-14, atol=0)
    with pytest.raises(UnitsError):
        units.quantity("5040.4 arcsec/cy", "arcsec/yr", Where("rate"), "50 arcsec/yr")


@pytest.mark.parametrize(
    ("words", "symbols"),
    [
        *[("12 hours", "12 h"), ("1 hour", "1 h"), ("12hours", "12 h"), ("30 minutes", "30 min")],
        *[("1 second", "1 s"), ("3 Days", "3 d"), ("2 weeks", "14 d"), ("2 Julian years", "2 yr")],
        *[("3 centuries", "300 yr"), ("1 century", "100 yr"), ("1 decade", "10 yr")],
        *[("2 millennia", "2 kyr"), ("1 millennium", "1 kyr")],
    ],
)
def test_units_of_time_are_read_as_words(words: str, symbols: str) -> None:
    for unit in ("s", "d"):
        found = [units.quantity(text, unit, Where("it"), "6 h") for text in (words, symbols)]
        assert found[0] == found[1]
    labelled = xr.DataArray([1.0], dims="n", attrs={"units": words.split(maxsplit=1)[-1]})
    if words[1] == " ":
        size = units.quantity(labelled, "s", Where("it"), "6 h").item()
        assert size * int(words[0]) == found[0] * DAY
    with pytest.raises(UnitsError):
        units.quantity("5 lightyears", "s", Where("it"), "6 h")


@pytest.mark.parametrize(
    ("words", "scale"),
    [
        *[(words, (1e3, 0.0)) for words in ("kyr", "ky", "Kyr", "KYR", "thousand years")],
        *[(words, (-1e3, 0.0)) for words in ("ka", "Ka", "kya", "kyr ago", "kyr b2k", "ka ago")],
        *[(words, (-1e3, -50.0)) for words in ("kyr BP", "ka_BP", "ky bp", "kyr before present")],
        *[(words, (1e6, 0.0)) for words in ("Myr", "MYR", "My", "Million years", "Myr from 2000")],
        *[(words, (-1e6, 0.0)) for words in ("Ma", "MA", "mya", "Mya", "million years ago")],
        *[("Ma BP", (-1e6, -50.0)), ("Gyr ago", (-1e9, 0.0)), ("Ga", (-1e9, 0.0))],
        *[("Gyr", (1e9, 0.0)), ("kyr from 1950", (1e3, -50.0)), ("years after 1950", (1.0, -50.0))],
        *[("yr before 2000", (-1.0, 0.0)), ("days", (1 / 365.25, 0.0)), (" a ", (1.0, 0.0))],
        *[("century", (100.0, 0.0)), ("yr  BP", (-1.0, -50.0))],
        # thousandths of a year, ages of the future, and what is no time
        *[(words, None) for words in ("myr", "ma", "my", "mYr", "myr BP", "ma ago", "uyr", "ayr")],
        *[(words, None) for words in ("ka from 2000", "kyr AD", "mas", "km", "", "BP", "ago", "m")],
    ],
)
def test_words_of_time(words: str, scale: tuple[float, float] | None) -> None:
    assert units.time_scale(words) == scale


@given(st.decimals(-(10**6), 10**6, places=4), st.sampled_from([1e3, 60.0, 1 / 24, 1 / 365.25]))
def test_numbers_are_converted_as_they_are_written(number: Decimal, factor: float) -> None:
    ratio = Fraction(factor).limit_denominator(1461)
    assert units.as_written(float(number), factor) == float(Fraction(number) * ratio)
    assert units.as_written([float(number)], factor, -50.0)[0] == float(
        Fraction(number) * ratio - 50
    )


def test_numbers_without_a_short_decimal_are_multiplied() -> None:
    numbers = np.array([1e300, 1 / 3, 2**-1000, np.nan, np.inf, -17.4])
    products = units.as_written(numbers, 1e3)
    assert np.array_equal(products[:-1], 1e3 * numbers[:-1], equal_nan=True)
    assert products[-1] == -17400.0
    assert units.as_written(0.3, np.pi) == 0.3 * np.pi


@pytest.mark.parametrize("unit", COMMON)
@given(number=st.floats(-1e12, 1e12))
def test_common_units_are_astropys_bit_for_bit(unit: str, number: float) -> None:
    measures, size = COMMON[unit]
    astropys = u.Quantity(f"{number!r} {unit}").to_value(u.Unit(measures))
    assert float(number) * size == astropys
    read = units.quantity(f"{number!r} {unit}", measures, Where("it"), f"1 {unit}")
    exact = measures == "s" and size != 1  # as the decimal number that is written
    assert read == (units.as_written(number, size) if exact else astropys)
    assert read == pytest.approx(astropys, rel=1e-15, abs=0)
    assert math.copysign(1.0, read) == math.copysign(1.0, astropys)


@pytest.mark.parametrize(
    "value",
    [
        *(math.nan, math.inf, -math.inf, "nan s", "inf h", math.nan * u.s, np.float64("nan")),
        *([1.0, math.nan], np.array([1.0, math.inf]), [1.0, math.inf] * u.s, 10**400),
        *(np.timedelta64("NaT", "s"), np.array([1, "NaT"], "m8[s]"), np.ma.masked),
        *(
            np.ma.masked_array([1.0, 2.0], [False, True]),
            xr.DataArray([1.0, math.nan], dims="draw"),
        ),
        *("many", "1 s 2", ["1 s", "2 kg"], [[1.0], [1.0, 2.0]], [["1 s"], ["1 s", "2 s"]]),
        *(None, ..., {"a": 1}, 1j, np.array(["1", "2"]), b"1 s", [True, False]),
        *(xr.DataArray([1.0], dims="draw", attrs={"units": unit}) for unit in ("kg", "parsnips")),
        *([1.0, 2.0] * u.kg, [1 * u.s, 2 * u.m]),
    ],
    ids=repr,
)
def test_what_is_no_number_of_seconds(value: object) -> None:
    with pytest.raises(EarthspinError) as error:
        units.quantity(value, "s", Where("times"), "1 s")
    assert "times" in str(error.value)


def test_a_masked_array_that_hides_nothing_is_an_array() -> None:
    assert units.quantity(np.ma.masked_array([1.0, 2.0]), "s", Where("it"), "1 s").tolist() == [
        1.0,
        2.0,
    ]


def test_units_with_several_slashes_are_read_from_left_to_right_without_a_warning(
    capfd: pytest.CaptureFixture[str],
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert units.quantity("2 km/s/s", "m/s2", Where("it"), "1 m/s2") == 2000.0
        array = xr.DataArray([2.0], dims="draw", attrs={"units": "km/s/s"})
        assert units.quantity(array, "m/s2", Where("it"), "1 m/s2").values == [2000.0]
    assert capfd.readouterr() == ("", "")


def test_a_labelled_array_that_says_its_units_is_converted() -> None:
    hours = xr.DataArray([1.0, 2.0], {"draw": [7, 8]}, ("draw",), attrs={"units": "h"})
    found = units.quantity(hours, "s", Where("it"), "1 s")
    assert found.values.tolist() == [3600.0, 7200.0]
    assert found.draw.values.tolist() == [7, 8]


# --- kinds -----------------------------------------------------------------------------------


def test_a_range_is_kept_and_named() -> None:
    share = Number("", "0.1", low=0.0, high=0.2)
    assert share.read(0.2, STEP) == 0.2
    for wrong in (-1e-9, 0.21):
        with pytest.raises(SceneError, match=r"between 0 and 0\.2"):
            share.read(wrong, STEP)
    with pytest.raises(SceneError, match="greater than zero"):
        Number("d", "433 d", above=0.0).read("0 d", STEP)
    with pytest.raises(SceneError, match="one number"):
        share.read([0.1, 0.1], STEP)


def test_a_number_may_want_its_unit() -> None:
    with pytest.raises(SceneError, match="with its unit"):
        Number("rad", "1 mas", plain=False).read(1e-6, STEP)


@pytest.mark.parametrize(
    ("shape", "given", "found"),
    [
        ((None,), [1, 2, 3], (3,)),
        ((None,), 5.0, (1,)),
        ((3,), ["1 m", "2 km", 0], (3,)),
        ((None, 3), [1, 2, 3], (1, 3)),
        ((None, 3), [[1, 2, 3], [4, 5, 6]], (2, 3)),
        ((None, 3), [[1 * u.m, 2 * u.km, 3 * u.m]], (1, 3)),
    ],
)
def test_arrays_have_the_shape_that_is_wanted(
    shape: tuple[int | None, ...], given: object, found: tuple[int, ...]
) -> None:
    values = Numbers("m", "1 m", shape).read(given, STEP)
    assert values.shape == found
    assert not values.flags.writeable


@pytest.mark.parametrize(
    "given",
    [
        ["1 km", 5],
        [[1 * u.km, 5, 2 * u.km]],
        np.array(["1 km", 5.0, "2 km"], dtype=object),
        [["1 km", "2 km", "3 km"], [5, 5, 5]],
    ],
)
def test_numbers_beside_quantities_need_a_unit(given: object) -> None:
    """Whether 5 is a metre or a kilometre is not guessed."""
    with pytest.raises(SceneError, match=r"with and without a unit; .* like '1 km'"):
        Numbers("m", "1 km", (None, 3)).read(given, STEP)


@pytest.mark.parametrize(
    ("shape", "given"),
    [
        ((None,), []),
        ((None,), [[1.0]] * 2),
        ((3,), [1, 2]),
        ((3,), [1, 2, 3, 4]),
        ((None, 3), [1, 2]),
        ((None, 3), [[1, 2]]),
        ((None, 3), [[[1, 2, 3]]]),
        ((None, 3), np.zeros((0, 3))),
        ((None, 3), 7.0),
    ],
)
def test_sizes_that_do_not_fit(shape: tuple[int | None, ...], given: object) -> None:
    with pytest.raises(SceneError, match="shape"):
        Numbers("m", "1 m", shape).read(given, STEP)


def test_an_array_does_not_change_with_what_was_given() -> None:
    given = np.array([1.0, 2.0])
    read = Numbers("s", "1 s", (None,)).read(given, STEP)
    given[0] = 9.0
    assert read.tolist() == [1.0, 2.0]


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=70))
def test_arrays_are_written_and_read_exactly(listed: list[float]) -> None:
    for unit in ("s", ""):
        kind = Numbers(unit, f"1 {unit}", (None,))
        back = kind.read(kind.write(np.array(listed)), STEP)
        assert np.array_equal(back, listed)
        assert np.array_equal(np.signbit(back), np.signbit(listed))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_are_written_and_read_exactly(number: float) -> None:
    for unit in ("s", "rad", "kg m2", "N m", "rad/s", "d", ""):
        kind = Number(unit, f"1 {unit}")
        back = kind.read(kind.write(number), STEP)
        assert back == number
        assert math.copysign(1, back) == math.copysign(1, number)


def test_arrays_that_are_damaged_are_refused() -> None:
    kind = Numbers("s", "1 s", (None,))
    good = kind.write(np.arange(40.0))
    for wrong in ({"shape": [39]}, {"float64": "%%"}, {"float64": 3}, {"shape": "x"}):
        with pytest.raises(SceneError, match="list of numbers"):
            kind.read(good | wrong, STEP)


@pytest.mark.parametrize("given", [0, -3, 1.0, "7", True, None, np.float64(3)])
def test_what_is_no_whole_number(given: object) -> None:
    with pytest.raises(SceneError, match="whole number, 1 or more"):
        Whole().read(given, STEP)
    assert Whole().read(np.int64(7), STEP) == 7


def test_words_lists_and_text() -> None:
    word = Word(("mean", "true"))
    assert word.read("mean", STEP) == "mean"
    assert word.read(True, STEP) == "true"  # TOML's own, and a shell that takes the quotes away
    for wrong in ("men", 3, None, ["mean"]):
        with pytest.raises(SceneError, match="allowed: mean, true"):
            word.read(wrong, STEP)
    several = Several(word)
    assert several.read("true", STEP) == ("true",)
    assert several.read(["mean", "true"], STEP) == ("mean", "true")
    assert several.write(("mean",)) == ["mean"]
    with pytest.raises(SceneError, match="line of text"):
        Text().read(5, STEP)


def test_true_and_false() -> None:
    for word, value in {True: True, False: False, "true": True, "False": False}.items():
        assert kind_of(bool).read(word, STEP) is value
    for wrong in (1, 0.0, None, "yes", []):
        with pytest.raises(SceneError, match="give true or false"):
            kind_of(bool).read(wrong, STEP)


def test_kinds_follow_from_types() -> None:
    from typing import Literal

    assert kind_of(Literal["a", "b"]) == Word(("a", "b"))
    assert kind_of(tuple[Literal["a"], ...]) == Several(Word(("a",)))
    assert kind_of(units.Days | None).unit == "d"
    assert kind_of(str) == Text()
    assert kind_of(int) == Whole()
