"""The questions `length_of_day` and `observed_day`: tides, and observations with and without."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin.bodies import EARTH, SUN
from earthspin.errors import ApartError, EarthspinError, SceneError, SeriesError
from earthspin.interior.layers import PREM
from earthspin.sky.universal_time import read_universal_time
from earthspin.torque.zonal_tides import KAPPA, OBSERVED, computed_responses
from tests.torque.test_zonal_tides import TABLE, TERMS, published

#: Two bodies in one, m.
RADII = xr.DataArray([6.37e6, 6.38e6], dims="case")


def test_the_total_is_the_sum_of_sun_and_moon() -> None:
    day = earthspin.length_of_day("2000-01-01", "2001-01-01", "1 d")
    for name in ("length_of_day", "ut1_tides"):
        both = day[name].sel(perturber=["sun", "moon"]).sum("perturber")
        assert np.allclose(both, day[name].sel(perturber="total"), rtol=0, atol=1e-12)
        assert day[name].attrs["units"] == "ms"
    alone = earthspin.length_of_day("2000-01-01", "2001-01-01", "1 d", perturbers=[SUN])
    assert np.array_equal(alone.length_of_day.sel(perturber="total"), alone.length_of_day[:, 0])


@pytest.mark.parametrize("source", ["jplephem", "skyfield"])
def test_it_is_that_of_the_table_of_the_iers_within_its_error(source: str) -> None:
    day = earthspin.length_of_day("1990-01-01", "2010-01-01", "5 d", source=source)
    total = day.sel(perturber="total")
    days = (total.time.values - np.datetime64("2000-01-01T12:00")) / np.timedelta64(1, "D")
    lod, ut1, _ = published(days)
    assert 0.93 < np.mean(abs(total.length_of_day - 1e3 * lod) < total.length_of_day_error) < 0.97
    off = abs(total.ut1_tides - 1e3 * (ut1 - ut1[0]))[1:]
    assert np.mean(off < total.ut1_tides_error[1:]) > 0.9


def test_times_need_not_be_even() -> None:
    """Nodes, a day apart, are others than the times."""
    times = ["2003-01-01", "2003-01-09T07:00", "2003-02-11"]
    some = earthspin.length_of_day(times=times)
    every = earthspin.length_of_day("2003-01-01", "2003-03-01", "1 h").sel(time=some.time)
    assert np.allclose(some.length_of_day, every.length_of_day, rtol=0, atol=5e-4)
    one = earthspin.length_of_day(times=times[1:2]).length_of_day[0]
    assert np.allclose(one, some.length_of_day[1], rtol=0, atol=5e-4)
    assert np.allclose(some.ut1_tides, every.ut1_tides, rtol=0, atol=1e-3)


@pytest.mark.parametrize(
    ("keys", "error"),
    [
        ({"body": "mars"}, SceneError),
        ({"perturbers": ["sun", "venus"]}, EarthspinError),
        ({"body": EARTH.replace(radius=RADII)}, ApartError),
    ],
)
def test_what_has_no_known_response_is_refused(keys: dict[str, object], error: type) -> None:
    with pytest.raises(error):
        earthspin.length_of_day("2000-01-01", "2001-01-01", "1 d", **keys)


def test_response_of_prem_shows_the_liquid_core() -> None:
    """The adopted response lies between those with an ocean, and far from that without."""
    rungs = computed_responses(PREM)
    assert abs(rungs["liquid_core"] - 0.800) < 0.001
    assert abs(rungs["core_turning_along"] - 0.902) < 0.001
    assert rungs["ocean_on_65_percent"] < 0.947 < rungs["ocean_on_70_percent"] < 0.958
    assert abs(rungs["liquid_core"] - KAPPA.value) > 0.1
    answer = earthspin.run_tree("length-of-day", ["response"])["response"].to_dataset()
    assert answer.response.sel(rung="observed_fortnight") == OBSERVED.value


def test_the_fortnightly_response_is_observed_in_c04() -> None:
    """Least squares of the second differences of UT1, in which slow changes are small."""
    table = read_universal_time(span=(50449, 61041))
    *_, circles = published(table.mjd - 51544.5 + 65 / 86400)
    size = np.hypot(TABLE[:, 7], TABLE[:, 8])
    some = np.flatnonzero(size > 0.9)[:-4]  # without those of half a year and more
    columns = np.diff(circles[:, [*some, *some + len(TABLE)]], 2, axis=0)
    fit = np.linalg.lstsq(columns, np.diff(table.ut1_minus_tai, 2), rcond=None)[0]
    mf = TABLE[:, :5].tolist().index([*TERMS["Mf"][0]])
    cos, sin = fit.reshape(2, -1)[:, some.tolist().index(mf)]
    ratio = np.hypot(cos, sin) / (1e-4 * np.hypot(TABLE[mf, 5], TABLE[mf, 6]))
    # the table has 1.0144 times the tide of the adopted response
    assert abs(1.0144 * KAPPA.value * ratio - OBSERVED.value) < 0.01


def test_without_tides_days_change_little() -> None:
    """Of the changes from day to day of ten years, 90 % of the variance are tides."""
    with_tides, without = (
        earthspin.observed_day("2010-01-01", "2020-01-01", tides=tides)
        for tides in ("left in", "taken out")
    )
    ratio = without.length_of_day.diff("time").var() / with_tides.length_of_day.diff("time").var()
    assert ratio < 0.12
    off = with_tides.length_of_day - without.length_of_day - without.length_of_day_tides
    assert np.max(abs(off)) < 1e-12
    off = 1e3 * (with_tides.ut1_tai - without.ut1_tai) - with_tides.ut1_tides
    assert np.max(abs(off)) < 1e-9


def test_observed_day_has_observed_rows_alone() -> None:
    day = earthspin.observed_day(file="finals")
    table = read_universal_time("finals")
    assert day.time.size == np.sum(~table.predicted)
    assert np.isnan(day.length_of_day[-1])
    leap = earthspin.observed_day("2016-12-31", "2017-01-01")
    assert abs(float(leap.ut1_utc.diff("time")[0]) - 1) < 0.003
    assert abs(float(leap.ut1_tai.diff("time")[0])) < 0.003


def test_observed_day_reads_named_columns(tmp_path: Path) -> None:
    table = read_universal_time(span=(58000, 58030))
    file = tmp_path / "ut1.txt"
    rows = zip(table.mjd, 1e3 * table.ut1_minus_utc, strict=True)
    file.write_text("\n".join(f"{mjd:.0f} {ut1:.5f}" for mjd, ut1 in rows))
    day = earthspin.observed_day(file=file, columns="mjd, ut1 (ms)")
    assert "IERS" not in day.ut1_tai.attrs["references"]
    assert np.allclose(day.ut1_tai, table.ut1_minus_tai, rtol=0, atol=1e-8)
    assert np.isnan(day.length_of_day).all()
    with pytest.raises(SeriesError):
        earthspin.observed_day(file=file)
    with pytest.raises(SeriesError):
        earthspin.observed_day("1950-01-01", "1951-01-01")
