"""Dates, durations and spans: every spelling of a time is the same time in every question."""

import datetime as dt
import tomllib
import warnings
from fractions import Fraction
from functools import cache
from typing import Any

import astropy.units as u
import cftime
import numpy as np
import pandas as pd
import pint
import polars as pl
import pytest
import xarray as xr
from astropy.time import Time
from hypothesis import given
from hypothesis import strategies as st
from skyfield.api import load

import earthspin
from earthspin import CoverageError, EarthspinError, SceneError, dates, load_scene, units
from earthspin.constants import DAY, J2000_JD, JULIAN_YEAR
from earthspin.dates import (
    Span,
    TimeGrid,
    TimeList,
    YearList,
    YearSpan,
    datetime64,
    grid,
    seconds,
)
from earthspin.engine.question import scene_text
from earthspin.errors import Where
from earthspin.frames import EquatorOfDate
from tests.processes import printed
from tests.refusals import refused

SCALE = load.timescale(builtin=True)
SPAN, TIMES, STEP = Where("span"), Where("times"), Where("step")
KYR = 1000 * JULIAN_YEAR


def cf(*date: int, calendar: str = "proleptic_gregorian") -> cftime.datetime:
    with warnings.catch_warnings(action="ignore"):  # years before 1 are not those of CF
        return cftime.datetime(*date, calendar=calendar)


def tdb(text: str) -> Time:
    """Make a time of astropy with both parts exact, from an ISO date of any year."""
    count = (np.datetime64(text, "s") - np.datetime64("2000-01-01T12", "s")).astype(int)
    whole, rest = divmod(int(count), 86400)
    return Time(J2000_JD + whole, rest / 86400, format="jd", scale="tdb")


#: Spellings of instants; the key is the instant in TDB.
SPELLINGS: dict[str, list[Any]] = {
    "2000-01-01T12:00": [
        *("2000-01-01T12:00:00", " 2000-01-01 12:00", "2000-01-01T12", "JD 2451545", "MJD 51544.5"),
        *("2000-01-01T12:00:00.000000000", np.datetime64("2000-01-01T12"), cf(2000, 1, 1, 12)),
        *(dt.datetime(2000, 1, 1, 12), pd.Timestamp("2000-01-01T12"), SCALE.tdb_jd(J2000_JD)),
        xr.DataArray(np.datetime64("2000-01-01T12", "ns")),
        xr.DataArray(cf(2000, 1, 1, 12, calendar="gregorian")),
    ],
    "-2559-01-01T00:00": [
        *("-2559-01-01", "-2559-01-01T00:00", "-02559-01-01 00:00:00.0", "2560 BC", "2,560 B.C."),
        *("2 560 bce", "2560 B.C.E.", np.datetime64("-2559-01-01"), np.datetime64("-2559", "Y")),
        *(cf(-2559, 1, 1), cf(-2560, 1, 22, calendar="standard"), "JD 786404.5"),
    ],
    "12025-06-15T12:00": [
        *("+12025-06-15T12:00", "12025-06-15T12:00:00", np.datetime64("12025-06-15T12")),
        *(cf(12025, 6, 15, 12), cf(12025, 6, 15, 12, calendar="standard")),
    ],
    "0000-06-15T12:00": ["0000-06-15T12:00", "0-06-15T12", np.datetime64("0000-06-15T12")],
    "0001-01-01": ["AD 1", "A.D. 1", "1 AD", "1 CE", "1 c.e.", dt.date(1, 1, 1), "0001-01-01"],
    "-9999-01-01": ["10,000 BC", "10,000 B.C.", "10 000 BC", "10000BC", "-9999-01-01"],
    "202023-06-21": ["+202023-06-21", "202023-06-21T00:00", np.datetime64("202023-06-21")],
}
SPELLED = [(day, spelling) for day, spellings in SPELLINGS.items() for spelling in spellings]
PAST = earthspin.long_term("-12 kyr", "0 kyr", "6 kyr")


def pole_and_axes(time: Any) -> np.ndarray:
    """The pole at a time, and the matrix of a frame of that date."""
    matrix = EquatorOfDate(obstime=time, model=PAST).matrix
    return np.append(earthspin.long_term(times=[time]).pole.values, matrix)


def scene_at(word: str, time: Any) -> str:
    return scene_text(load_scene(word, {"span": [time, time]}))


@cache
def expected(day: str) -> tuple[np.ndarray, dict[str, str]]:
    words = ("precession", "rotation", "polar-motion")
    return pole_and_axes(tdb(day)), {word: scene_at(word, tdb(day)) for word in words}


@pytest.mark.parametrize(("day", "spelling"), SPELLED, ids=str)
def test_every_spelling_is_the_same_time_in_every_question(day: str, spelling: Any) -> None:
    """An answer, or a refusal that gives the limit of the question."""
    time = tdb(day)
    for one in (spelling, [spelling]):
        whole, rest = dates.two_parts(one, TIMES)
        off = (whole - time.jd1 + J2000_JD) + (rest - time.jd2)
        assert np.max(np.abs(off)) * 86400 < 1e-9
    there, texts = expected(day)
    assert np.allclose(pole_and_axes(spelling), there, rtol=0, atol=1e-12)
    for word, text in texts.items():
        assert scene_at(word, spelling) == text
        assert scene_at(word, tomllib.loads(text)["span"][0]) == text
    if day.startswith("2000"):
        assert earthspin.torque_series(times=[spelling]).time == np.datetime64(day)
    else:
        with pytest.raises(CoverageError, match=r"kernel 'de421'.*1899.*2053"):
            earthspin.torque_series(times=[spelling])


@pytest.mark.parametrize("year", [1800, 2053])
def test_a_mean_over_a_span_outside_the_kernel_is_refused(year: int) -> None:
    with pytest.raises(CoverageError, match="1899-07-29"):
        earthspin.precession(span=(f"{year}-01-01", f"{year + 1}-01-01"))


@given(
    st.datetimes(dt.datetime(1, 1, 1), dt.datetime(9999, 12, 28)),
    st.integers(-5000, 5000).filter(bool),
    st.sampled_from(["standard", "proleptic_gregorian"]),
)
def test_dates_of_cftime_are_counted_as_cftime_does(
    time: dt.datetime, year: int, calendar: str
) -> None:
    date = cf(year, time.month, min(time.day, 28), *time.timetuple()[3:6], calendar=calendar)
    if (year, time.month) == (1582, 10):
        date = date.replace(day=4)
    with warnings.catch_warnings(action="ignore"):
        count = cftime.date2num(date, "seconds since 2000-01-01 12:00", calendar)
    whole, rest = dates.two_parts(date, TIMES)
    assert abs((whole + rest) * 86400 - count) < 1e-4


def test_the_standard_calendar_is_julian_before_1582() -> None:
    """Meeus, Astronomical Algorithms, chapter 7."""
    for date, julian in (
        ((1582, 10, 15), 2299160.5),
        ((1582, 10, 4), 2299159.5),
        ((837, 4, 10, 7, 12), 2026871.8),
        ((-1001, 7, 12, 12), 1356001.0),  # his year -1000 is 1001 BC
        ((-4713, 1, 1, 12), 0.0),
    ):
        (day,) = dates.days([cf(*date, calendar="standard")], TIMES)
        assert day == pytest.approx(julian - J2000_JD, rel=0, abs=1e-8)


@pytest.mark.parametrize(
    "leap",
    ["2016-12-31T23:59:60.25Z", "2017-01-01T00:59:60.250000+01:00", "2016-12-31 23:59:60.25 UTC"],
)
def test_a_leap_second_is_a_time(leap: str) -> None:
    expected = dates.days(Time("2016-12-31T23:59:60.25", scale="utc"), TIMES)
    for form in (leap, SCALE.utc(2016, 12, 31, 23, 59, 60.25)):
        assert abs(dates.days([form], TIMES) - expected)[0] * 86400 < 2e-5
    (day,) = dates.days(["2016-12-31T23:59:59.25Z"], TIMES)
    assert abs((expected[0] - day) * 86400 - 1) < 1e-6


def test_a_nanosecond_is_kept() -> None:
    for form in (
        "2000-01-01T12:00:00.000000001",
        np.datetime64("2000-01-01T12:00:00.000000001"),
        pd.Timestamp("2000-01-01T12:00:00.000000001"),
        Time(J2000_JD, 1e-9 / DAY, format="jd", scale="tdb"),
    ):
        assert dates.days([form], TIMES)[0] * DAY == pytest.approx(1e-9, rel=1e-2, abs=0)
    (early,) = dates.days([pd.Timestamp.min], TIMES)
    assert early == pytest.approx(-117709.4911673, rel=0, abs=1e-7)


def test_a_time_in_utc_is_converted() -> None:
    # UTC + 32 s + 32.184 s = TT; TDB differs from TT by at most 2 ms
    day = dates.days(Time("2000-01-01T12:00:00", scale="utc"), TIMES)[0]
    assert abs(day * 86400 - 64.184) < 2e-3
    skyfield = dates.days(SCALE.utc(2000, 1, 1, 12), TIMES)[0]
    assert abs(day - skyfield) * 86400 < 2e-5  # measured: 6e-6 s, by the short series of TDB
    far = SCALE.tdb_jd(J2000_JD, 36525.0 + 1e-6 / 86400)  # keeps both of its parts
    assert abs((dates.days(far, TIMES)[0] - 36525.0) * 86400 - 1e-6) < 4e-7


MASKED = Time([2451545.0, 2451546.0], format="jd", scale="tdb")
MASKED[1] = np.ma.masked
ENDLESS: list[Any] = []
ENDLESS.append(ENDLESS)
#: What is no date, by a word of the message.
WRONG: dict[str, list[Any]] = {
    "write a date": [
        "JD " + "9" * 400,
        *("tomorrow", "", "1.5 BC", "10,00 BC", "BC", "AD 5 BC", "1 PM"),
        *(3.0, None, True, ["x"], [1.0], b"2000-01-01", 1.0 * u.yr),
    ],
    "no year 0": ["0 AD", "0,000 BC", "AD 0", "0 CE"],
    "no such date": [
        *("2000-13-01", "1900-02-29", "2000-02-30T00:00Z", "2000-01-01T24:00"),
        *("2016-12-31T23:59:60", "2016-06-30T23:59:60Z", "2016-12-31T12:30:60Z"),
        "2000-01-01T00:00+24:00",
    ],
    "no date": [
        *(np.datetime64("NaT", "s"), pd.NaT, SCALE.tdb_jd(np.nan), np.array(["NaT"], "M8[s]")),
        pd.DatetimeIndex(["2000-01-01", pd.NaT], tz="UTC"),
    ],
    "one list": [
        *([], ENDLESS),
        *([[["2000-01-01"]]], [["2000-01-01"], ["2000-01-01", "2001-01-01"]]),
        SCALE.tdb_jd(np.full((2, 2), 2451545.0)),
    ],
    "all known": [MASKED, np.ma.masked_array(np.zeros(2, "M8[us]"), [True, False])],
    "UTC is not known at this date; give TDB": [
        *("1959-12-31T00:00Z", "1900-01-01T00:00+01:00", "2950-01-01T00:00Z"),
        *("-2559-01-01T00:00Z", "+12025-01-01T00:00Z", dt.datetime(1, 1, 1, tzinfo=dt.UTC)),
        *(dt.datetime(9000, 1, 1, tzinfo=dt.UTC), pd.date_range("1950", periods=2, tz="UTC")),
    ],
    "1 Gyr": [np.datetime64(2**62, "Y")],
} | {name: [cf(2000, 1, 1, calendar=name)] for name in ("julian", "noleap", "360_day")}
test_what_is_no_date_is_refused = refused(
    *[(value, words) for words, values in WRONG.items() for value in values],
    call=lambda wrong: TimeList.read(wrong, TIMES),
)


class OfPendulum(dt.datetime):
    """A datetime with the property `tz`, as the library pendulum has it."""

    tz = dt.UTC


def test_zones_of_other_libraries_are_converted() -> None:
    date = dt.datetime(2000, 1, 1, tzinfo=dt.UTC)
    expected = dates.days(date, TIMES)
    assert dates.days(OfPendulum(2000, 1, 1, tzinfo=dt.UTC), TIMES) == expected
    assert dates.days(pl.Series([date]), TIMES) == expected


def test_no_times_are_read() -> None:
    assert dates.days(Time([], format="jd"), TIMES).size == 0


def test_the_time_axis_of_a_series_holds_the_years_1_to_9999() -> None:
    assert dates.datetime64(np.array([dates.FIRST_DAY])) == np.datetime64("0001-01-01")
    assert dates.datetime64(np.array([dates.END_DAY - 1])) == np.datetime64("9999-12-31")
    for day in (dates.FIRST_DAY - 1, dates.END_DAY):
        with pytest.raises(SceneError, match="1 to 9999"):
            dates.datetime64(np.array([0.0, day]))
    with pytest.raises(SceneError, match="250,000 years"):
        Span.read(["2000-01-01", "+900000-01-01"], SPAN)


@pytest.mark.parametrize(
    "times",
    [
        ["2000-01-01T12", "2000-01-02T12"],
        np.array(["2000-01-01T12", "2000-01-02T12"], "M8[ns]"),
        xr.DataArray(np.array(["2000-01-01T12", "2000-01-02T12"], "M8[us]"), dims="time"),
        xr.DataArray([cf(2000, 1, 1, 12), cf(2000, 1, 2, 12)], dims="time"),
        xr.date_range("2000-01-01T12", periods=2, use_cftime=True),
        Time([2451545.0, 2451546.0], format="jd", scale="tdb"),
        pd.date_range("2000-01-01T12", periods=2),
        pd.Series(pd.date_range("2000-01-01T12", periods=2)),
        [dt.datetime(2000, 1, 1, 12), Time(2451546.0, format="jd", scale="tdb")],
        SCALE.tdb_jd(np.array([2451545.0, 2451546.0])),
        [SCALE.tdb_jd(2451545.0), SCALE.tdb_jd(2451546.0)],
    ],
    ids=lambda times: type(times).__name__,
)
def test_lists_of_times(times: object) -> None:
    assert dates.days(times, TIMES).tolist() == [0.0, 1.0]
    assert YearList.read(times, TIMES).listed.tolist() == [0.0, DAY]
    assert Span.read(times, SPAN).days == (0.0, 1.0)


# --- one rule for time zones -----------------------------------------------------------------

#: The same three noons of UTC, in every form that says its zone.
NOONS = ["1999-12-31T12:00:00", "2000-01-01T12:00:00", "2017-01-02T12:00:00"]
CLOCK = dt.timezone(dt.timedelta(hours=1))
INDEX = pd.DatetimeIndex(NOONS, tz="UTC")
ZONED = {
    "index in UTC": INDEX,
    "index in Berlin": INDEX.tz_convert("Europe/Berlin"),
    "series": pd.Series(INDEX),
    "timestamps": list(INDEX.tz_convert("Europe/Berlin")),
    "datetimes": [dt.datetime.fromisoformat(f"{noon}+00:00") for noon in NOONS],
    "datetimes an hour east": [
        dt.datetime.fromisoformat(f"{noon}+00:00").astimezone(CLOCK) for noon in NOONS
    ],
    "Z": [f"{noon}Z" for noon in NOONS],
    "+01:00": [noon.replace("T12", "T13") + "+01:00" for noon in NOONS],
    "-0130": [noon.replace("T12:00:00", "T10:30") + "-0130" for noon in NOONS],
}


@pytest.mark.parametrize("form", ZONED)
def test_whatever_says_its_zone_is_the_same_time(form: str) -> None:
    utc = Time(NOONS, scale="utc")
    found = dates.days(ZONED[form], TIMES)
    assert np.max(np.abs(found - dates.days(utc, TIMES))) * 86400e6 <= 1.0  # a microsecond
    # UTC of these days is 64.184 s and, since 2017, 69.184 s behind TT
    off = (found - dates.days(NOONS, TIMES)) * 86400 - [64.184, 64.184, 69.184]
    assert np.max(np.abs(off)) < 2e-3
    for value, noon in zip(ZONED[form], utc, strict=True):
        assert abs(dates.microseconds(value, SPAN) - dates.microseconds(noon, SPAN)) <= 1


def test_uniform_scales_are_known_at_all_times() -> None:
    """Where UTC is not known, TDB - TT is below 2 ms, and TT - TAI is 32.184 s."""
    for year in (-9999.0, 9999.0):
        tt = Time(year, format="jyear", scale="tt")
        expected = (tt.jd1 - 2451545.0) + tt.jd2
        for time in (tt, tt.tai, tt.tcg):
            (found,) = dates.days(time, TIMES)
            assert abs(found - expected) * 86400 < 2e-3
    for scale in ("tt", "tai", "tcg"):  # with those of astropy in our time
        times = Time(["1975-03-04T05:06:07.123", "2003-04-05"], scale=scale)
        expected = (times.tdb.jd1 - 2451545.0) + times.tdb.jd2
        assert np.array_equal(dates.days(times, TIMES), expected)


# --- exactness -------------------------------------------------------------------------------


@given(st.integers(-14_000_000_000_000_000, 21_000_000_000_000_000))
def test_no_microsecond_is_lost_between_1550_and_2650(count: int) -> None:
    whole, rest = divmod(count, dates.MICROSECONDS_PER_DAY)
    stamps = dates.datetime64(np.array([whole + rest / dates.MICROSECONDS_PER_DAY]))
    back = (stamps - dates.J2000).astype(int)[0]
    assert abs(back - count) <= 3  # float64 days hold 5 us at the ends, 0.3 us in our century
    assert dates.microseconds(dates.J2000 + np.timedelta64(count, "us"), SPAN) == count


@given(step=st.integers(1, 10**13), size=st.integers(1, 50), start=st.integers(-(10**16), 10**16))
def test_a_grid_is_exact(step: int, size: int, start: int) -> None:
    times = TimeGrid(start, step, size)
    expected = [(start + k * step) / dates.MICROSECONDS_PER_DAY for k in range(size)]
    # the whole days and the rest are rounded apart: a unit in the last place of the larger, seldom
    unit = np.spacing(np.maximum(np.abs(expected), 1.0))
    assert np.all(np.abs(times.days() - expected) <= unit)
    assert np.array_equal(times.days(size // 2, size), times.days()[size // 2 :])


@given(st.integers(-(5 * 10**18), 5 * 10**18), st.integers(0, 10**18))
def test_a_span_is_written_and_read_exactly(first: int, length: int) -> None:
    span = Span(first, first + length)
    assert Span.read(span.write(), SPAN) == span
    years = YearSpan(first * 1e-3, (first + length) * 1e-3)
    assert YearSpan.read(years.write(), SPAN) == years


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=50))
def test_a_list_of_times_is_written_and_read_exactly(listed: list[float]) -> None:
    times = TimeList(np.array(listed))
    assert np.array_equal(TimeList.read(times.write(), TIMES).listed, times.listed)


@pytest.mark.parametrize(("step", "size"), [("6 h", 5), ("7 hours", 4), ("1 week", 1)])
def test_the_end_of_a_span_is_included_if_the_step_meets_it(step: str, size: int) -> None:
    span = Span.read(("2000-01-01", "2000-01-02"), SPAN)
    assert TimeGrid.over(span, dates.SPACING.read(step, STEP)).size == size


test_steps_that_lead_nowhere = refused(
    *[
        (step, "finite|1 microsecond")
        for step in (0, -1, "0 h", "-3 h", np.nan, np.inf, 1e-9, "2e4 yr")
    ],
    call=lambda step: dates.SPACING.read(step, STEP),
)
test_what_is_no_span_is_refused = refused(
    *[(Span, wrong, "two dates") for wrong in ("2000", ["2000-01-01"], ["2000-01-01"] * 3, None)],
    *[(Span, wrong, "two dates") for wrong in (7, SCALE.tdb_jd(0.0), SCALE.tdb_jd(np.arange(3.0)))],
    *[(YearSpan, wrong, "two times") for wrong in ("-1 Myr", {"-1 Myr", "0 kyr"}, {"a": 1}, 5)],
    (Span, ["2000-01-02", "2000-01-01"], "ends before it starts"),
    (YearSpan, ["0 kyr", "-1 Myr"], "ends before it starts"),
    (Span, [["2000-01-01"], "2000-01-01"], "one date"),
    call=lambda kind, wrong: kind.read(wrong, SPAN),
)


# --- millennia -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "years"),
    [
        *[("0 kyr", 0.0), ("-65 kyr", -65_000.0), ("1 Myr", 1e6), ("-0.5 Myr", -5e5)],
        *[("2 yr", 2.0), ("-3 centuries", -300.0), ("1 millennium", 1000.0), (-3 * u.kyr, -3000.0)],
        *[(dt.timedelta(days=365.25), 1.0), (np.timedelta64(3652500, "D"), 10_000.0)],
        (Time(J2000_JD + 36525.0, format="jd", scale="tdb"), 100.0),
    ],
)
def test_durations_from_j2000(given: object, years: float) -> None:
    assert seconds(given, TIMES) / JULIAN_YEAR == pytest.approx(years, rel=1e-15, abs=1e-12)


@pytest.mark.parametrize(
    ("text", "years"),
    [
        *[("0 Kyr", 0.0), ("20 kya", -2e4), ("3 Mya", -3e6), ("20 ka", -2e4), ("3 Ma", -3e6)],
        *[("2 kyr BP", -2050.0), ("0.1 Ma BP", -100_050.0), ("-2 kyr BP", None), ("0 BP", None)],
        *[("11.7 kyr b2k", -11_700.0), ("0.1 Gyr ago", -1e8), ("2 ka ago", -2000.0)],
        *[("-1 kyr from 1950", -1050.0), ("50 years after 1950", 0.0), ("12 000 yr", 12_000.0)],
        *[("-3 myr", None), ("3 uyr", None), ("-20 ka", None), ("20 ka from 2000", None)],
    ],
)
def test_ages_have_a_sign_and_an_origin(text: str, years: float | None) -> None:
    if years is None:
        with pytest.raises(earthspin.SceneError):
            seconds(text, TIMES)
    else:
        assert seconds(text, TIMES) == years * JULIAN_YEAR
        number, _, unit = text.partition(" ")
        labelled = xr.DataArray([float(number)], dims="n", attrs={"units": unit})
        assert text == "12 000 yr" or YearList.read(labelled, TIMES).listed == years * JULIAN_YEAR


KYR_BEFORE = np.round(np.arange(-20, 0.05, 0.1), 1)


@pytest.mark.parametrize(
    "times",
    [
        *(KYR_BEFORE * u.kyr, pint.UnitRegistry().Quantity(KYR_BEFORE, "kiloyear")),
        *([f"{k} kyr" for k in KYR_BEFORE], [f"{-k:g} ka" for k in KYR_BEFORE]),
        *([f"{1000 * k:.0f} yr" for k in KYR_BEFORE], pd.Series([k * u.kyr for k in KYR_BEFORE])),
        xr.DataArray(-KYR_BEFORE, dims="n", attrs={"units": "kyr ago"}),
    ],
    ids=["astropy", "pint", "kyr", "ka", "yr", "series", "labelled"],
)
def test_equal_epochs_are_equal_however_they_are_written(times: object) -> None:
    even = grid(YearSpan.read(["-20 kyr", "0 kyr"], TIMES), 100 * JULIAN_YEAR, TIMES)
    assert np.array_equal(YearList.read(times, TIMES).listed, even)
    assert np.array_equal(even, np.arange(-200, 1) * 100 * 31_557_600)


@given(st.integers(-(10**5), 10**5), st.integers(1, 10**6), st.sampled_from(["d", "yr", "kyr"]))
def test_even_steps_are_the_decimal_numbers(first: int, step: int, unit: str) -> None:
    start = Fraction(first, 1000) * {"d": 86_400, "yr": 31_557_600, "kyr": 31_557_600_000}[unit]
    spacing = 86_400 + Fraction(step, 100)
    begin = seconds(f"{first / 1000} {unit}", TIMES)
    times = grid(YearSpan(begin, begin + 20 * float(spacing)), float(spacing), TIMES)
    assert times.tolist() == [float(start + k * spacing) for k in range(times.size)]


@pytest.mark.parametrize("step", ["7 h", "0.1 d", "1.5 h", "100 s", "0.7 s"])
def test_dates_in_steps_are_those_of_a_list(step: str) -> None:
    for first in ("0500-01-01", "2000-02-28T12:00", "9000-03-01"):
        start = np.datetime64(first, "us")
        length = np.timedelta64(round(units.quantity(step, "s", TIMES, "6 h") * 1e6), "us")
        dates = start + length * np.arange(100)
        even = TimeGrid.over(
            Span.read((dates[0], dates[-1]), SPAN), length / np.timedelta64(1, "s")
        )
        for times in (even, TimeList.read(dates, TIMES), TimeList.read([*map(str, dates)], TIMES)):
            assert np.array_equal(datetime64(times.days()), dates)


@given(st.integers(-9999, 99_999), st.integers(1, 12), st.integers(1, 28))
def test_a_cycle_of_four_hundred_years_has_146097_days(year: int, month: int, day: int) -> None:
    first, second = (f"{y:05d}-{month:02d}-{day:02d}" for y in (year, year + 400))
    assert seconds(second, TIMES) - seconds(first, TIMES) == 146_097 * DAY


@given(st.dates(dt.date(1, 1, 1), dt.date(9999, 12, 31)))
def test_every_date_is_that_of_the_calendar_of_python(date: dt.date) -> None:
    assert seconds(date.isoformat(), TIMES) == DAY * (date.toordinal() - 730120 - 0.5)


test_what_is_no_time_is_refused = refused(
    (-65.0, "give it with its unit, like '-65 kyr'"),
    *[(wrong, "like '-65 kyr', or a date") for wrong in ("-65", "-65 km", "3000 BD")],
    ("2 Gyr", "at most 1 Gyr"),
    ("-3000-02-30", "no such date"),
    ("nan kyr", "finite"),
    ([1, 2] * u.kyr, "give one time"),
    (None, "times = None"),
    call=lambda given: seconds(given, TIMES),
)


@pytest.mark.parametrize(
    "given",
    [["-1 kyr", "0 kyr", "0.5 kyr"], [-1000, 0, 500] * u.yr, np.array([-1.0, 0.0, 0.5]) * u.kyr],
)
def test_a_list_keeps_its_order(given: object) -> None:
    read = YearList.read(given, TIMES)
    assert np.allclose(read.listed / JULIAN_YEAR, [-1000, 0, 500], rtol=1e-15, atol=1e-9)
    assert np.array_equal(YearList.read(read.write(), TIMES).listed, read.listed)
    assert YearList.read(read, TIMES) is read
    assert YearList.read("-1 kyr", TIMES).listed.tolist() == [-KYR]


test_what_is_no_list_of_times_is_refused = refused(
    ([], "one or more times"),
    ([[1, 2]] * u.kyr, "in one list"),
    ([2, 3] * u.Gyr, "at most 1 Gyr"),
    ([1.0, 2.0], "give it with its unit"),
    call=lambda given: YearList.read(given, TIMES),
)


def test_a_grid_includes_the_end_that_the_step_meets() -> None:
    thousand = grid(YearSpan(-KYR, 0.0), 100 * JULIAN_YEAR, TIMES)
    assert thousand.size == 11
    assert thousand[-1] == 0.0
    short = grid(YearSpan(-KYR, 0.0), 300 * JULIAN_YEAR, TIMES)
    assert short.size == 4
    assert short[-1] == pytest.approx(-100 * JULIAN_YEAR, rel=1e-12, abs=0)
    with pytest.raises(EarthspinError, match="give a longer step"):
        grid(YearSpan(-1e6 * KYR, 0.0), DAY, TIMES)
    for ends in (["-1 Myr", "2000-01-01T12:00"], [-1, 0] * u.Myr):
        assert YearSpan.read(ends, SPAN) == YearSpan(-1000 * KYR, 0.0)


@given(st.integers(1, 5000), st.floats(0.01, 100))
def test_a_whole_number_of_steps_always_meets_the_end(count: int, years: float) -> None:
    step = years * JULIAN_YEAR
    times = grid(YearSpan(-count * step, 0.0), step, TIMES)
    assert times.size == count + 1
    assert abs(times[-1]) < 1e-9 * step * count


@pytest.mark.slow
def test_a_missing_cache_folder_is_no_reason_to_refuse_utc() -> None:
    """37 leap seconds and 32.184 s, and TDB - TT of -0.08 ms (Fairhead & Bretagnon 1990)."""
    program = """
import os
os.environ["XDG_CACHE_HOME"] = "/no/such/folder"
import earthspin
print(earthspin.torque_series(times=["2026-01-01T00:00Z"]).time.values[0])
"""
    assert printed(program).strip().startswith("2026-01-01T00:01:09.18")
