"""Times over millennia: what is read, what it comes to, and what is refused in one line."""

import datetime as dt

import astropy.units as u
import numpy as np
import pytest
from astropy.time import Time
from hypothesis import given
from hypothesis import strategies as st

from earthspin import EarthspinError, SceneError
from earthspin.constants import DAY, J2000_JD, JULIAN_YEAR
from earthspin.dates import YearList, YearSpan, grid, seconds
from earthspin.errors import Where
from tests.refusals import refused

AT = Where("times")
KYR = 1000 * JULIAN_YEAR


@pytest.mark.parametrize(
    ("given", "years"),
    [
        ("0 kyr", 0.0),
        ("-65 kyr", -65_000.0),
        ("1 Myr", 1e6),
        ("-0.5 Myr", -5e5),
        ("2 yr", 2.0),
        (-3 * u.kyr, -3000.0),
        (dt.timedelta(days=365.25), 1.0),
        (np.timedelta64(3652500, "D"), 10_000.0),
        (Time(J2000_JD + 36525.0, format="jd", scale="tdb"), 100.0),
        ("2000-01-01T12:00", 0.0),
        (np.datetime64("2000-01-01T12"), 0.0),
        (dt.datetime(2000, 1, 1, 12), 0.0),
    ],
)
def test_durations_and_dates(given: object, years: float) -> None:
    assert seconds(given, AT) / JULIAN_YEAR == pytest.approx(years, rel=1e-15, abs=1e-12)


@pytest.mark.parametrize(
    ("date", "julian"),
    [
        # Meeus, Astronomical Algorithms, chapter 7, those after 1582; and 0h of far dates
        ("2000-01-01", 2451544.5),
        ("1999-01-01", 2451179.5),
        ("1900-01-01", 2415020.5),
        ("1600-12-31", 2305812.5),
        ("1582-10-15", 2299160.5),
        # proleptic Gregorian: the Julian 4713 BC January 1 noon is JD 0
        ("-4713-11-24", -0.5),
        ("0000-01-01", 1721059.5),
        ("-0001-12-31", 1721058.5),
        ("10000-01-01", 5373484.5),
    ],
)
def test_dates_of_the_proleptic_gregorian_calendar(date: str, julian: float) -> None:
    assert seconds(date, AT) == DAY * (julian - J2000_JD)


@given(st.integers(-9999, 99_999), st.integers(1, 12), st.integers(1, 28))
def test_a_cycle_of_four_hundred_years_has_146097_days(year: int, month: int, day: int) -> None:
    first, second = (f"{y:05d}-{month:02d}-{day:02d}" for y in (year, year + 400))
    assert seconds(second, AT) - seconds(first, AT) == 146_097 * DAY


@given(st.dates(dt.date(1, 1, 1), dt.date(9999, 12, 31)))
def test_every_date_is_that_of_the_calendar_of_python(date: dt.date) -> None:
    assert seconds(date.isoformat(), AT) == DAY * (date.toordinal() - 730120 - 0.5)


test_what_is_no_time_is_refused = refused(
    (-65.0, "give it with its unit, like '-65 kyr'"),
    ("-65", "like '-65 kyr', or a date"),
    ("-65 km", "like '-65 kyr', or a date"),
    ("3000 BD", "like '-65 kyr', or a date"),
    ("2 Gyr", "at most 1 Gyr"),
    ("-3000-02-30", "there is no such date"),
    ("2001-13-01", "no such date"),
    ("1900-02-29", "no such date"),
    ("nan kyr", "finite"),
    ([1, 2] * u.kyr, "give one time"),
    (None, "times = None"),
    call=lambda given: seconds(given, AT),
)


def test_a_span_is_two_times_in_order() -> None:
    span = YearSpan.read(["-1 Myr", "2000-01-01T12:00"], AT)
    assert (span.first, span.last) == (-1000 * KYR, 0.0)
    assert YearSpan.read(span.write(), AT) == span
    assert YearSpan.read(span, AT) is span
    assert YearSpan.read([-1, 2] * u.Myr, AT) == YearSpan(-1000 * KYR, 2000 * KYR)


test_what_is_no_span_is_refused = refused(
    ("-1 Myr", "two times"),
    ({"-1 Myr", "0 kyr"}, "two times"),
    (["-1 Myr"], "two times"),
    (["0 kyr", "-1 Myr"], "ends before it starts"),
    ({"first": 1}, "two times"),
    (5, "two times"),
    call=lambda given: YearSpan.read(given, AT),
)


@given(st.floats(-1e15, 1e15), st.floats(-1e15, 1e15))
def test_a_span_is_written_to_the_last_bit(one: float, other: float) -> None:
    span = YearSpan(min(one, other), max(one, other))
    assert YearSpan.read(span.write(), AT) == span


@pytest.mark.parametrize(
    "given",
    [
        ["-1 kyr", "0 kyr", "0.5 kyr"],
        [-1000, 0, 500] * u.yr,
        np.array([-1.0, 0.0, 0.5]) * u.kyr,
    ],
)
def test_a_list_keeps_its_order(given: object) -> None:
    read = YearList.read(given, AT)
    assert np.allclose(read.listed / JULIAN_YEAR, [-1000, 0, 500], rtol=1e-15, atol=1e-9)
    again = YearList.read(read.write(), AT)
    assert np.array_equal(again.listed, read.listed)
    assert YearList.read(again, AT) is again


def test_one_time_is_a_list_of_one_and_dates_are_a_list() -> None:
    assert YearList.read("-1 kyr", AT).listed.tolist() == [-KYR]
    dates = Time([2451545.0, 2451546.0], format="jd", scale="tdb")
    assert YearList.read(dates, AT).listed.tolist() == [0.0, DAY]


test_what_is_no_list_of_times_is_refused = refused(
    ([], "one or more times"),
    ([[1, 2]] * u.kyr, "in one list"),
    ([2, 3] * u.Gyr, "at most 1 Gyr"),
    ([1.0, 2.0], "give it with its unit"),
    call=lambda given: YearList.read(given, AT),
)


def test_a_grid_includes_the_end_that_the_step_meets() -> None:
    thousand = grid(YearSpan(-KYR, 0.0), 100 * JULIAN_YEAR, AT)
    assert thousand.size == 11
    assert thousand[-1] == 0.0
    short = grid(YearSpan(-KYR, 0.0), 300 * JULIAN_YEAR, AT)
    assert short.size == 4
    assert short[-1] == pytest.approx(-100 * JULIAN_YEAR, rel=1e-12, abs=0)
    with pytest.raises(EarthspinError, match="give a longer step"):
        grid(YearSpan(-1e6 * KYR, 0.0), DAY, AT)


@given(st.integers(1, 5000), st.floats(0.01, 100))
def test_a_whole_number_of_steps_always_meets_the_end(count: int, years: float) -> None:
    step = years * JULIAN_YEAR
    times = grid(YearSpan(-count * step, 0.0), step, AT)
    assert times.size == count + 1
    assert abs(times[-1]) < 1e-9 * step * count


def test_years_before_christ() -> None:
    """Year 1 BC is the astronomical year 0: 3000 BC starts with -2999-01-01."""
    assert seconds("3000 BC", AT) == seconds("-2999-01-01", AT)
    assert seconds("1 BCE", AT) == seconds("0-01-01", AT)
    assert seconds("10,000 BC", AT) == seconds("-9999-01-01", AT)
    for text in ("12000 AD", "12,000 CE", "12000 ce"):
        assert seconds(text, AT) == seconds("12000-01-01", AT)
    for text in ("0 AD", "0,000 BC", "0 CE"):
        with pytest.raises(SceneError, match="there is no year 0"):
            seconds(text, AT)
