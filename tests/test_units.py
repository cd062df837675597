"""The border: what is taken, what is refused, and that nothing is lost on the way."""

import datetime as dt

import astropy.units as u
import numpy as np
import pytest
import xarray as xr
from astropy.time import Time
from hypothesis import given
from hypothesis import strategies as st

from earthspin import SceneError, UnitsError, units


@pytest.mark.parametrize(
    "value", ["6 h", 6 * u.h, dt.timedelta(hours=6), np.timedelta64(6, "h"), 21600, 21600.0]
)
def test_durations(value: object) -> None:
    assert units.seconds(value) == 21600.0


@pytest.mark.parametrize("value", ["6", "6 kg", "6 houres", "", "h", 6 * u.m, True])
def test_what_is_no_duration(value: object) -> None:
    with pytest.raises(UnitsError) as error:
        units.seconds(value, "step")
    assert "step" in str(error.value)
    assert "\n" not in str(error.value)


def test_arcsec_per_century_is_not_arcsec_per_cycle() -> None:
    rate = units.quantity(5040.4 * u.arcsec / (100 * u.yr), "arcsec/yr", "rate", "50 arcsec/yr")
    assert np.isclose(rate, 50.404, rtol=1e-14, atol=0)
    with pytest.raises(UnitsError):
        units.quantity("5040.4 arcsec/cy", "arcsec/yr", "rate", "50 arcsec/yr")


@pytest.mark.parametrize(
    "value",
    [
        "2000-01-01T12:00:00",
        "2000-01-01 12:00",
        np.datetime64("2000-01-01T12"),
        dt.datetime(2000, 1, 1, 12),
        Time(2451545.0, format="jd", scale="tdb"),
        Time("2000-01-01T12:00:00", scale="tdb"),
    ],
)
def test_dates(value: object) -> None:
    assert units.microseconds(value) == 0


def test_a_time_in_utc_is_converted() -> None:
    # UTC + 32 s + 32.184 s = TT; TDB differs from TT by at most 2 ms
    day = units.days(Time("2000-01-01T12:00:00", scale="utc"))[0]
    assert abs(day * 86400 - 64.184) < 2e-3


@pytest.mark.parametrize(
    "value",
    [
        "tomorrow",
        "2000-13-01",
        "2000-02-30",
        "NaT",
        np.datetime64("NaT"),
        3.0,
        None,
        dt.datetime(2000, 1, 1, tzinfo=dt.UTC),
    ],
)
def test_what_is_no_date(value: object) -> None:
    with pytest.raises(SceneError) as error:
        units.microseconds(value, "span")
    assert error.value.key == "span"


@pytest.mark.parametrize(
    "times",
    [
        ["2000-01-01T12", "2000-01-02T12"],
        np.array(["2000-01-01T12", "2000-01-02T12"], "M8[ns]"),
        xr.DataArray(np.array(["2000-01-01T12", "2000-01-02T12"], "M8[us]"), dims="time"),
        Time([2451545.0, 2451546.0], format="jd", scale="tdb"),
    ],
)
def test_lists_of_times(times: object) -> None:
    assert units.days(times).tolist() == [0.0, 1.0]


@pytest.mark.parametrize("times", [[], ["x"], np.array(["NaT"], "M8[us]"), [[["2000-01-01"]]]])
def test_what_is_no_list_of_times(times: object) -> None:
    with pytest.raises(SceneError):
        units.days(times)


@given(st.integers(-14_000_000_000_000_000, 21_000_000_000_000_000))
def test_no_microsecond_is_lost_between_1550_and_2650(count: int) -> None:
    whole, rest = divmod(count, units.MICROSECONDS_PER_DAY)
    day = np.array([whole + rest / units.MICROSECONDS_PER_DAY])
    back = (units.datetime64(day) - units.J2000).astype(int)[0]
    assert abs(back - count) <= 3  # float64 days hold 5 us at the ends, 0.3 us in our century


@given(step=st.integers(1, 10**13), size=st.integers(1, 50), start=st.integers(-(10**16), 10**16))
def test_a_grid_is_exact(step: int, size: int, start: int) -> None:
    grid = units.TimeGrid(start, step, size)
    expected = [(start + k * step) / units.MICROSECONDS_PER_DAY for k in range(size)]
    assert np.allclose(grid.days(), expected, rtol=0, atol=2e-14)
    assert np.array_equal(grid.days(size // 2, size), grid.days()[size // 2 :])


def test_the_end_of_a_span_is_included_if_the_step_meets_it() -> None:
    assert units.time_grid("2000-01-01", "2000-01-02", "6 h").size == 5
    assert units.time_grid("2000-01-01", "2000-01-02", "7 h").size == 4
    assert units.time_grid("2000-01-01", "2000-01-01", "7 h").size == 1


@pytest.mark.parametrize("step", [0, -1, "0 h", "-3 h", float("nan"), float("inf"), 1e-9])
def test_steps_that_lead_nowhere(step: object) -> None:
    with pytest.raises(SceneError, match="greater than zero"):
        units.time_grid("2000-01-01", "2000-01-02", step)


def test_a_span_that_ends_before_it_starts() -> None:
    with pytest.raises(SceneError, match="ends before it starts"):
        units.time_grid("2000-01-02", "2000-01-01", "6 h")
