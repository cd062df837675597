"""Dates and times: what is taken, what is refused, and that no microsecond is lost."""

import datetime as dt

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from astropy.time import Time
from hypothesis import given
from hypothesis import strategies as st
from skyfield.api import load

from earthspin import SceneError, dates
from earthspin.dates import Span, TimeGrid, TimeList
from earthspin.errors import Where

SCALE = load.timescale(builtin=True)
SPAN, TIMES, STEP = Where("span"), Where("times"), Where("step")


@pytest.mark.parametrize(
    "value",
    [
        "2000-01-01T12:00:00",
        "2000-01-01 12:00",
        np.datetime64("2000-01-01T12"),
        dt.datetime(2000, 1, 1, 12),
        Time(2451545.0, format="jd", scale="tdb"),
        Time("2000-01-01T12:00:00", scale="tdb"),
        SCALE.tdb(2000, 1, 1, 12),
    ],
)
def test_dates(value: object) -> None:
    assert dates.microseconds(value, SPAN) == 0


def test_a_time_in_utc_is_converted() -> None:
    # UTC + 32 s + 32.184 s = TT; TDB differs from TT by at most 2 ms
    day = dates.days(Time("2000-01-01T12:00:00", scale="utc"), TIMES)[0]
    assert abs(day * 86400 - 64.184) < 2e-3


def test_a_time_of_skyfield_gives_its_tdb() -> None:
    """And keeps both of its parts: a microsecond in a century."""
    utc = SCALE.utc(2000, 1, 1, 12)
    astropy = Time("2000-01-01T12:00:00", scale="utc")
    day, other = dates.days(utc, TIMES)[0], dates.days(astropy, TIMES)[0]
    assert abs(day - other) * 86400 < 2e-5  # measured: 6e-6 s, by the short series of TDB
    far = SCALE.tdb_jd(2451545.0, 36525.0 + 1e-6 / 86400)
    assert abs((dates.days(far, TIMES)[0] - 36525.0) * 86400 - 1e-6) < 4e-7


def test_a_span_of_skyfield_times() -> None:
    ends = SCALE.tdb_jd(np.array([2451545.0, 2451546.0]))
    assert Span.read(ends, SPAN).days == (0.0, 1.0)
    assert Span.read((ends[0], ends[1]), SPAN) == Span.read(ends, SPAN)
    for wrong in (ends[0], SCALE.tdb_jd(np.arange(3.0) + 2451545.0)):
        with pytest.raises(SceneError, match="two dates"):
            Span.read(wrong, SPAN)
    with pytest.raises(SceneError, match="give one date"):
        dates.microseconds(ends, SPAN)


@pytest.mark.parametrize(
    "value",
    [
        "tomorrow",
        "2000-13-01",
        "2000-02-30",
        "2000-02-30T00:00Z",
        "NaT",
        np.datetime64("NaT", "s"),
        pd.NaT,
        SCALE.tdb_jd(np.nan),
        3.0,
        None,
        True,
        np.datetime64("12000-01-01"),
        np.datetime64("-0001-01-01"),
    ],
)
def test_what_is_no_date(value: object) -> None:
    with pytest.raises(SceneError) as error:
        dates.microseconds(value, SPAN)
    assert error.value.key == "span"


@pytest.mark.parametrize(
    "times",
    [
        ["2000-01-01T12", "2000-01-02T12"],
        np.array(["2000-01-01T12", "2000-01-02T12"], "M8[ns]"),
        xr.DataArray(np.array(["2000-01-01T12", "2000-01-02T12"], "M8[us]"), dims="time"),
        Time([2451545.0, 2451546.0], format="jd", scale="tdb"),
        pd.date_range("2000-01-01T12", periods=2),
        pd.Series(pd.date_range("2000-01-01T12", periods=2)),
        [dt.datetime(2000, 1, 1, 12), Time(2451546.0, format="jd", scale="tdb")],
        SCALE.tdb_jd(np.array([2451545.0, 2451546.0])),
        [SCALE.tdb_jd(2451545.0), SCALE.tdb_jd(2451546.0)],
    ],
    ids=[
        *("text", "datetime64", "DataArray", "Time", "index", "series", "mixed"),
        *("skyfield", "list of skyfield"),
    ],
)
def test_lists_of_times(times: object) -> None:
    assert dates.days(times, TIMES).tolist() == [0.0, 1.0]


MASKED = Time([2451545.0, 2451546.0], format="jd", scale="tdb")
MASKED[1] = np.ma.masked


@pytest.mark.parametrize(
    "times",
    [
        [],
        ["x"],
        np.array(["NaT"], "M8[us]"),
        pd.DatetimeIndex(["2000-01-01", pd.NaT]),
        pd.DatetimeIndex(["2000-01-01", pd.NaT], tz="UTC"),
        [[["2000-01-01"]]],
        [["2000-01-01"], ["2000-01-01", "2001-01-01"]],
        np.ma.masked_array(np.array(["2000-01-01", "2001-01-01"], "M8[us]"), [True, False]),
        MASKED,
        SCALE.tdb_jd(np.array([2451545.0, np.nan])),
        SCALE.tdb_jd(np.full((2, 2), 2451545.0)),
        [1.0, 2.0],
        7,
    ],
    ids=[
        "none", "a word", "NaT", "NaT in an index", "NaT in UTC", "nested", "ragged", "masked",
        "a masked Time", "NaN of skyfield", "a table of skyfield", "numbers", "a number",
    ],
)  # fmt: skip
def test_what_is_no_list_of_times(times: object) -> None:
    with pytest.raises(SceneError) as error:
        dates.days(times, TIMES)
    assert error.value.key == "times"


# --- one rule for time zones -----------------------------------------------------------------

#: The same three noons of UTC, in every form that says its zone.
NOONS = ["1999-12-31T12:00:00", "2000-01-01T12:00:00", "2017-01-02T12:00:00"]
CLOCK = dt.timezone(dt.timedelta(hours=1))
INDEX = pd.DatetimeIndex(NOONS, tz="UTC")
ZONED = {
    "index in UTC": INDEX,
    "index in Berlin": INDEX.tz_convert("Europe/Berlin"),
    "series": pd.Series(INDEX),
    "timestamps": list(INDEX),
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
    expected = dates.days(Time(NOONS, scale="utc"), TIMES)
    found = dates.days(ZONED[form], TIMES)
    assert np.max(np.abs(found - expected)) * 86400e6 <= 1.0  # a microsecond
    # UTC of these days is 64.184 s and, since 2017, 69.184 s behind TT
    plain = dates.days(NOONS, TIMES)
    off = (found - plain) * 86400 - [64.184, 64.184, 69.184]
    assert np.max(np.abs(off)) < 2e-3


@pytest.mark.parametrize("form", ["datetimes", "Z", "+01:00", "timestamps"])
def test_one_date_with_a_zone(form: str) -> None:
    for value, noon in zip(ZONED[form], NOONS, strict=True):
        one = dates.microseconds(value, SPAN)
        assert abs(one - dates.microseconds(Time(noon, scale="utc"), SPAN)) <= 1


def test_a_series_asked_for_in_utc_is_that_of_its_tdb() -> None:
    import earthspin

    index = pd.date_range("2000-01-01", periods=3, tz="UTC")
    by_index = earthspin.torque_series(times=index)
    by_time = earthspin.torque_series(times=Time(["2000-01-01", "2000-01-02", "2000-01-03"]))
    apart = abs(by_index.time.values - by_time.time.values) / np.timedelta64(1, "us")
    assert apart.max() <= 1
    late = by_index.time.values[0] - np.datetime64("2000-01-01")
    assert abs(late / np.timedelta64(1, "s") - 64.184) < 2e-3


@pytest.mark.parametrize(
    "value",
    [
        "1959-12-31T00:00Z",
        "1900-01-01T00:00+01:00",
        "2950-01-01T00:00Z",
        dt.datetime(1950, 1, 1, tzinfo=dt.UTC),
        dt.datetime(9000, 1, 1, tzinfo=dt.UTC),
    ],
    ids=str,
)
def test_where_there_is_no_utc_a_zone_is_refused(value: object) -> None:
    with pytest.raises(SceneError, match="UTC is not known then; give TDB"):
        dates.microseconds(value, SPAN)
    with pytest.raises(SceneError, match="UTC is not known then; give TDB"):
        dates.days([value], TIMES)


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


def test_where_there_is_no_utc_an_index_is_refused() -> None:
    for start in ("1950-01-01", "2200-01-01"):
        with pytest.raises(SceneError, match="UTC is not known then; give TDB"):
            dates.days(pd.date_range(start, periods=2, tz="UTC"), TIMES)


# --- exactness -------------------------------------------------------------------------------


@given(st.integers(-14_000_000_000_000_000, 21_000_000_000_000_000))
def test_no_microsecond_is_lost_between_1550_and_2650(count: int) -> None:
    whole, rest = divmod(count, dates.MICROSECONDS_PER_DAY)
    day = np.array([whole + rest / dates.MICROSECONDS_PER_DAY])
    back = (dates.datetime64(day) - dates.J2000).astype(int)[0]
    assert abs(back - count) <= 3  # float64 days hold 5 us at the ends, 0.3 us in our century


@given(step=st.integers(1, 10**13), size=st.integers(1, 50), start=st.integers(-(10**16), 10**16))
def test_a_grid_is_exact(step: int, size: int, start: int) -> None:
    grid = TimeGrid(start, step, size)
    expected = [(start + k * step) / dates.MICROSECONDS_PER_DAY for k in range(size)]
    # the whole days and the rest are rounded apart: a unit in the last place of the larger, seldom
    unit = np.spacing(np.maximum(np.abs(expected), 1.0))
    assert np.all(np.abs(grid.days() - expected) <= unit)
    assert np.array_equal(grid.days(size // 2, size), grid.days()[size // 2 :])


@given(st.integers(-(10**16), 10**16), st.integers(0, 10**16))
def test_a_span_is_written_and_read_exactly(first: int, length: int) -> None:
    span = Span(first, first + length)
    assert Span.read(span.write(), SPAN) == span


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=50))
def test_a_list_of_times_is_written_and_read_exactly(listed: list[float]) -> None:
    times = TimeList(np.array(listed))
    assert np.array_equal(TimeList.read(times.write(), TIMES).listed, times.listed)


def grid(first: str, last: str, step: object) -> TimeGrid:
    return TimeGrid.over(Span.read((first, last), SPAN), dates.SPACING.read(step, STEP))


def test_the_end_of_a_span_is_included_if_the_step_meets_it() -> None:
    assert grid("2000-01-01", "2000-01-02", "6 h").size == 5
    assert grid("2000-01-01", "2000-01-02", "7 h").size == 4
    assert grid("2000-01-01", "2000-01-01", "7 h").size == 1


@pytest.mark.parametrize("step", [0, -1, "0 h", "-3 h", float("nan"), float("inf"), 1e-9])
def test_steps_that_lead_nowhere(step: object) -> None:
    with pytest.raises(SceneError, match="greater than zero"):
        grid("2000-01-01", "2000-01-02", step)


def test_a_span_that_ends_before_it_starts() -> None:
    with pytest.raises(SceneError, match="ends before it starts"):
        grid("2000-01-02", "2000-01-01", "6 h")


@pytest.mark.parametrize("span", ["2000", ["2000-01-01"], ["2000-01-01"] * 3, None, 7])
def test_what_is_no_span(span: object) -> None:
    with pytest.raises(SceneError, match="two dates"):
        Span.read(span, SPAN)
