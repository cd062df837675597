"""Forecast of the pole: what it uses, what it refuses, and what was observed later."""

import json
import warnings
from itertools import pairwise
from pathlib import Path
from typing import Any

import astropy.units as u
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from astropy.coordinates import AltAz, EarthLocation, SkyCoord
from astropy.time import Time
from astropy.utils import iers
from scipy.stats import binomtest

import earthspin
from earthspin import dates
from earthspin.constants import ARCSEC, MAS
from earthspin.sky import eop
from earthspin.views import observed_pole as views
from earthspin.views.drawing import INTERVAL
from earthspin.wobble.forecast import SKILL

ORIGIN = "2018-06-01"


@pytest.fixture(scope="module")
def lines() -> list[str]:
    """Lines of C04."""
    return eop.file_of("c04").read_text(encoding="ascii").splitlines()


@pytest.fixture(scope="module")
def ahead() -> xr.Dataset:
    return earthspin.forecast(365, origin=ORIGIN, file="c04")


def number_of_row(lines: list[str], date: str) -> int:
    year, month, day = map(int, date.split("-"))
    return next(
        k for k, line in enumerate(lines) if line.split()[:3] == [str(year), str(month), str(day)]
    )


def test_a_known_hindcast_against_later_observations(ahead: xr.Dataset) -> None:
    """Errors of 2018-06-01 in mas; 95 % half-widths were measured over 256 origins."""
    seen = earthspin.polar_motion(span=(ORIGIN, "2019-06-02")).sel(time=ahead.time)
    for name in ("x", "y"):
        inside = abs(ahead[name] - seen[name]) <= ahead[f"{name}_error"]
        assert float(inside.mean()) > 0.8
        ten_days = float(abs(ahead[name] - seen[name])[:10].max())
        assert ten_days < 0.009  # the largest move that was seen beyond a forecast of ten days


def test_rows_after_the_origin_change_no_bit(
    ahead: xr.Dataset, lines: list[str], tmp_path: Path
) -> None:
    end = number_of_row(lines, ORIGIN)
    changed = [
        line if k <= end else line[:26] + f"{0.05 + 1e-5 * (k - end):12.6f}" + line[38:]
        for k, line in enumerate(lines[: end + 400])
    ]
    file = tmp_path / "pole.txt"
    file.write_text("\n".join(changed), encoding="ascii")
    assert not np.array_equal(
        eop.read_polar_motion(file).x[-5:], eop.read_polar_motion("c04").x[-5:]
    )
    again = earthspin.forecast(365, origin=ORIGIN, file=str(file))
    for name in ahead.data_vars:
        assert np.array_equal(ahead[name], again[name])


def test_predicted_rows_are_never_used(tmp_path: Path) -> None:
    lines = eop.file_of("finals").read_text(encoding="ascii").splitlines()
    observed = [line for line in lines if line[16:17] == "I"]
    file = tmp_path / "finals.txt"
    file.write_text("\n".join(observed) + "\n", encoding="ascii")
    whole, cut = earthspin.forecast(30), earthspin.forecast(30, file=str(file))
    assert np.array_equal(whole.x, cut.x)
    newest = np.datetime64(whole.x.attrs["origin"])
    mjd = (newest - np.datetime64("1858-11-17")) / np.timedelta64(1, "D")
    assert float(observed[-1][7:15]) == mjd
    assert whole.time.values[0] == newest + np.timedelta64(1, "D")


def test_only_the_newest_row_of_finals_is_corrected(tmp_path: Path) -> None:
    """Without other rows the newest one is y - 0.065 mas; an origin inside the table is not."""
    lines = eop.file_of("finals").read_text(encoding="ascii").splitlines()
    observed = [line for line in lines if line[16:17] == "I"]
    file = tmp_path / "finals.txt"
    file.write_text("\n".join(observed[:-1]) + "\n", encoding="ascii")
    newest = earthspin.forecast(3, file=str(file))
    later = earthspin.forecast(3, origin=newest.x.attrs["origin"], file="finals")
    assert "newest_row_corrected" in newest.x.attrs
    assert "newest_row_corrected" not in later.x.attrs
    change = (newest.y - later.y).values * 1e3
    assert -0.3 < change[0] < -0.05  # mas; the row enters with a weight of one to three
    named = earthspin.forecast(3, origin=newest.x.attrs["origin"], file=str(file))
    assert np.array_equal(named.y, newest.y)
    assert np.all(newest.y_error > later.y_error)


def test_coverage_measured_on_releases() -> None:
    """On releases that nothing was chosen on, 95 % lies in the exact interval of each coverage."""
    rows = json.loads(SKILL.read_text(encoding="utf-8"))
    released = [row for row in rows if row["set"] == "releases" and row["horizon"] <= 30]
    shares = []
    for row in released:
        for share in (*row["coverage"], row["ellipse"]):
            interval = binomtest(round(share * row["origins"]), row["origins"]).proportion_ci(0.95)
            assert interval.low <= 0.95 <= interval.high
        shares.append([*row["coverage"], row["ellipse"]])
    assert np.all(abs(np.mean(shares, axis=0) - 0.95) < 0.02)


@pytest.mark.slow
def test_offsets_after_the_origin_change_no_bit(lines: list[str], tmp_path: Path) -> None:
    end = number_of_row(lines, ORIGIN)
    changed = [
        line if k <= end else f"{line[:62]}{2e-4:12.6f}{-2e-4:12.6f}{line[86:]}"
        for k, line in enumerate(lines[: end + 400])
    ]
    file = tmp_path / "pole.txt"
    file.write_text("\n".join(changed), encoding="ascii")
    assert eop.read_pole_offsets(file).x[-1] == 2e-4 * ARCSEC
    scene = {"days": 730, "origin": ORIGIN, "file": "c04"}
    one, other = (
        earthspin.run_tree(earthspin.load_scene("forecast", scene | keys), ["pole_offsets"])
        for keys in ({}, {"file": str(file)})
    )
    assert one["pole_offsets"].to_dataset().equals(other["pole_offsets"].to_dataset())


def test_offsets_against_later_observations() -> None:
    """Measured for the predictor: 97 % of offsets lie inside the half-widths, one origin fewer."""
    scene = earthspin.load_scene("forecast", {"days": 730, "origin": ORIGIN, "file": "c04"})
    ahead = earthspin.run_tree(scene, ["pole_offsets"])["pole_offsets"].to_dataset()
    seen = earthspin.pole_offsets(span=(ORIGIN, "2020-06-01")).sel(time=ahead.time)
    for name in ("dX", "dY"):
        error = abs(ahead[name] - seen[name])
        assert float((error <= ahead[f"{name}_error"]).mean()) > 0.9
        assert float(error[:90].mean()) < 0.12  # mas; 0.08 in the mean over many origins


def test_sections_that_the_table_cannot_give_are_left_out() -> None:
    seen = earthspin.polar_motion(span=("2003-01-01", ORIGIN))
    early, near = ({"origin": f"{year}-06-01", "file": "c04", "days": 10} for year in (1986, 1988))
    scenes = {"days": 730}, near, early, near | {"start": "1989-06-01"}, {"file": seen}
    far, soon, *others = (
        earthspin.run_tree(earthspin.load_scene("forecast", keys)) for keys in scenes
    )
    assert "bulletin_a" not in far.children
    for tree in (far, soon):
        assert "pole_offsets" in tree.children
    for tree in others:
        assert "pole_offsets" not in tree.children


def test_a_dataset_of_polar_motion_and_its_scene(ahead: xr.Dataset) -> None:
    seen = earthspin.polar_motion(span=("2003-01-01", ORIGIN))
    given = earthspin.forecast(365, file=seen)
    assert np.allclose(given.x, ahead.x, rtol=0, atol=1e-12)
    again = earthspin.run(given)
    assert np.array_equal(again.x, given.x)


def test_steps_are_rows_of_the_daily_forecast(ahead: xr.Dataset) -> None:
    weekly = earthspin.forecast(365, "7 d", ORIGIN, "c04")
    assert np.array_equal(weekly.x, ahead.x[6::7])
    assert np.array_equal(weekly.time, ahead.time[6::7])


def test_days_count_from_a_start(ahead: xr.Dataset) -> None:
    later = earthspin.forecast(30, origin=ORIGIN, file="c04", start="2018-07-01T15:00")
    assert later.time.values[0] == np.datetime64("2018-07-02")
    same = ahead.sel(time=later.time)
    for name in ahead.data_vars:
        assert np.array_equal(same[name], later[name])


def test_sections_count_from_a_start() -> None:
    newest = eop.read_polar_motion("finals").mjd[-1] - eop.MJD
    sections = ["components", "bulletin_a", "pole_offsets"]
    whole, later = (
        earthspin.run_tree(earthspin.load_scene("forecast", keys), sections)
        for keys in ({"days": 40}, {"days": 10, "start": dates.date_text(newest + 30)})
    )
    for name in ("/", *sections):
        assert later[name].to_dataset().equals(whole[name].to_dataset().isel(time=slice(30, 40)))
    late = {"days": 300, "start": dates.date_text(newest + 100)}
    with pytest.raises(earthspin.SceneError, match="Bulletin A ends on"):
        earthspin.run_tree(earthspin.load_scene("forecast", late), ["bulletin_a"])


def test_the_age_of_a_table_and_a_stored_today(monkeypatch: pytest.MonkeyPatch) -> None:
    newest = eop.read_polar_motion("finals").mjd[-1] - eop.MJD
    monkeypatch.setattr("earthspin.questions.forecast.today", lambda: newest + 40)
    answer = earthspin.forecast(5, start="today")
    assert answer.time.values[0] == dates.datetime64(newest + 41)
    assert "pip install --upgrade astropy-iers-data" in answer.time.attrs["comment"]
    assert answer.time.attrs["age_of_newest_row"].startswith("40 d")
    assert f'start = "{dates.date_text(newest + 40)}"' in answer.attrs["scene"]
    later = earthspin.load_scene("forecast", {"days": "365 d", "start": "today"})
    left_out = earthspin.plan(later, "all").left_out
    assert "end the forecast by then" in left_out["predicted-by-bulletin-a"]
    monkeypatch.setattr("earthspin.questions.forecast.today", lambda: newest + 50)
    xr.testing.assert_identical(earthspin.run(answer), answer)
    with pytest.warns(UserWarning, match="50 d old.*start='today'.*pip install"):
        earthspin.forecast(5)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        earthspin.forecast(5, origin=ORIGIN)


def test_a_forecast_from_the_csv_of_the_iers(tmp_path: Path) -> None:
    tables = {"final": eop.read_polar_motion("finals"), "prediction": eop.read_bulletin_a()}
    rows = [
        pd.DataFrame({"MJD": t.mjd, "Type": word, "x_pole": t.x, "y_pole": t.y}).assign(
            sigma_x_pole=t.x_error, sigma_y_pole=t.y_error
        )
        for word, t in tables.items()
    ]
    table = pd.concat(rows).set_index(["MJD", "Type"]) / ARCSEC
    table.round(6).to_csv(tmp_path / "finals2000A.all.csv", sep=";")
    sections = ["bulletin_a"]
    scene = earthspin.load_scene("forecast", {"days": 30})
    plain = earthspin.run_tree(scene, sections)
    tree = earthspin.run_tree(scene.replace(file=tmp_path / "finals2000A.all.csv"), sections)
    assert np.allclose(tree.x, plain.x, rtol=0, atol=1e-12)
    assert np.allclose(tree.y_error, plain.y_error, rtol=0, atol=1e-12)
    other = tree["bulletin_a"].bulletin_a_y
    assert np.allclose(other, plain["bulletin_a"].bulletin_a_y, rtol=0, atol=1e-12)


def test_components_add_up_to_the_pole() -> None:
    """After the innovations' extrapolation the parts differ from the pole by rounding."""
    tree = earthspin.run_tree(earthspin.load_scene("forecast", {"origin": ORIGIN, "file": "c04"}))
    parts = tree["components"].to_dataset()
    late = slice(60, None)
    for name in ("x", "y"):
        total = parts[f"component_{name}"].sum("component").values[late] * MAS
        whole = tree.to_dataset()[name].values[late] * 1e3 * MAS
        assert np.allclose(total, whole, rtol=0, atol=1e-9 * MAS)


def test_bulletin_a_is_that_of_astropys_reader() -> None:
    from astropy.utils.iers import IERS_A

    tree = earthspin.run_tree(earthspin.load_scene("forecast", {"days": "60 d"}))
    bulletin = tree["bulletin_a"].to_dataset()
    table = IERS_A.open(str(eop.file_of("finals")))
    mjd = (bulletin.time.values - np.datetime64("1858-11-17")) / np.timedelta64(1, "D")
    rows = np.searchsorted(table["MJD"].value, mjd)
    assert set(table["PolPMFlag_A"][rows]) == {"P"}
    assert np.allclose(bulletin.bulletin_a_x, table["PM_x_A"][rows].value, rtol=0, atol=1e-12)
    assert np.allclose(bulletin.bulletin_a_y, table["PM_y_A"][rows].value, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"origin": "1970-01-01"}, "15 years"),
        ({"origin": "1950-01-01"}, "1962-01-01"),
        ({"origin": "2100-01-01"}, "choose a day inside"),
        ({"days": 731}, "730"),
        ({"origin": ORIGIN, "start": "2018-05-31"}, "start then or later"),
        ({"origin": ORIGIN, "start": "2020-05-01", "days": 60}, "730 d after"),
        ({"days": 0}, "0"),
        ({"step": "6 h"}, "whole days"),
        ({"step": "40 d", "days": 30}, "whole days"),
        ({"body": "mars"}, "mars"),
    ],
)
def test_refusals(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(earthspin.EarthspinError, match="(?i)" + words) as error:
        earthspin.forecast(**({"file": "c04"} | keys))
    assert "\n" not in str(error.value)


def test_gaps_are_refused(lines: list[str], tmp_path: Path) -> None:
    end = number_of_row(lines, ORIGIN)
    file = tmp_path / "pole.txt"
    file.write_text("\n".join([*lines[: end - 90], *lines[end - 88 : end]]), encoding="ascii")
    with pytest.raises(earthspin.EarthspinError, match="each day"):
        earthspin.forecast(30, file=str(file))
    seen = earthspin.polar_motion(span=("2000-01-01", ORIGIN))
    with pytest.raises(earthspin.EarthspinError, match="each day"):
        earthspin.forecast(30, file=seen.drop_isel(time=[100]))


def test_the_ellipse_holds_as_many_draws_as_it_claims(ahead: xr.Dataset) -> None:
    from matplotlib.patches import Ellipse

    ax = views.plot_path(ahead)
    assert ax.texts[-1].get_text() == str(ahead.time.values[-1].astype("M8[D]"))
    ellipse = [patch for patch in ax.patches if isinstance(patch, Ellipse)][1]
    row = ahead.isel(time=90)
    sx, sy = (1e3 * float(row[f"{name}_error"]) / 1.959964 for name in ("x", "y"))
    across = float(row.correlation_xy) * sx * sy
    draws = np.random.default_rng(0).multivariate_normal(
        [1e3 * float(row.y), 1e3 * float(row.x)], [[sy**2, across], [across, sx**2]], 20000
    )
    turn, centre = np.radians(ellipse.angle), np.array(ellipse.center)
    along = (draws - centre) @ [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
    inside = (2 * along / [ellipse.width, ellipse.height]) ** 2
    assert abs(np.mean(inside.sum(axis=1) <= 1) - 0.95) < 0.006


def test_figures_of_a_hindcast_and_skill_as_measured(ahead: xr.Dataset) -> None:
    assert len(ahead.earthspin.plot()) == 4
    figure = views.plot_coordinates(ahead.isel(time=slice(0, 30)))
    figure.draw_without_rendering()
    assert INTERVAL in [text.get_text() for text in figure.axes[0].get_legend().texts]
    boxes = [label.get_window_extent() for label in figure.axes[-1].get_xticklabels()]
    assert not any(left.overlaps(right) for left, right in pairwise(boxes))
    table = json.loads(SKILL.read_text(encoding="utf-8"))
    released = [row for row in table if row["set"] == "releases"]
    errors, shares = views.plot_skill(ahead).axes
    drawn = {line.get_label(): line for line in errors.lines}["Bulletin A, releases"]
    assert list(drawn.get_xdata()) == [row["horizon"] for row in released]
    other = [np.mean(row["other_mae"]) for row in released]
    assert np.allclose(np.asarray(drawn.get_ydata()), other, rtol=0, atol=1e-12)
    lowest = min(np.mean(row["coverage"]) for row in table)
    assert shares.get_ylim()[0] < 100 * lowest


def test_days_that_repeat_are_refused() -> None:
    seen = earthspin.polar_motion(span=("2000-01-01", ORIGIN))
    twice = seen.isel(time=[*range(10), *range(9, seen.time.size)])
    with pytest.raises(earthspin.EarthspinError, match="ascending"):
        earthspin.forecast(30, file=twice)


@pytest.fixture(scope="module")
def rapid() -> xr.Dataset:
    """Forecast from the newest row of finals2000A."""
    return earthspin.forecast(90)


def test_a_telescope_with_the_forecast_pole(rapid: xr.Dataset) -> None:
    """Directions turn by the angle between the poles; stars all around show nearly all of it.

    They are compared with the table of finals2000A that has the forecast UT1.
    """
    table = rapid.earthspin.to_iers_table()
    plain = iers.IERS_A.read(str(eop.file_of("finals")))
    stars = SkyCoord(np.arange(0, 360, 20) * u.deg, 20 * u.deg)
    site = EarthLocation(lon=-70 * u.deg, lat=-24 * u.deg)
    later = Time(rapid.time.values[60].astype(str))
    rows = np.searchsorted(plain["MJD"].value, table["MJD"].value)
    plain["UT1_UTC"][rows] = table["UT1_UTC"]
    seen = []
    for each in (table, plain):
        with iers.earth_orientation_table.set(each):
            seen.append(stars.transform_to(AltAz(obstime=later, location=site)))
    (x, y), (other_x, other_y) = table.pm_xy(later), plain.pm_xy(later)
    assert table.ut1_utc(later) == plain.ut1_utc(later)
    between = np.hypot(x - other_x, y - other_y).to_value(u.mas)
    largest = seen[0].separation(seen[1]).to_value(u.mas).max()
    assert between > 0.1
    assert 0.95 * between < largest < between + 1e-3


def test_a_table_for_astropy_holds_the_forecast_and_what_was_observed(rapid: xr.Dataset) -> None:
    table = rapid.earthspin.to_iers_table()
    mjd = table["MJD"].value
    ahead = np.isin(mjd, (rapid.time.values - np.datetime64("1858-11-17")) / np.timedelta64(1, "D"))
    assert ahead[-90:].all()
    assert ahead.sum() == 90
    assert np.allclose(table["PM_x"][ahead].value, rapid.x, rtol=0, atol=1e-12)
    assert np.allclose(table["PM_y"][ahead].value, rapid.y, rtol=0, atol=1e-12)
    assert set(table["PolPMFlag"][ahead]) == {"P"}
    tree = earthspin.run_tree(rapid, ["pole_offsets"])["pole_offsets"]
    assert np.allclose(table["dX_2000A"][ahead].value, tree.dX, rtol=0, atol=1e-9)
    assert np.allclose(table["dY_2000A"][ahead].value, tree.dY, rtol=0, atol=1e-9)
    seen = earthspin.polar_motion(file="finals")
    assert np.allclose(table["PM_x"][~ahead].value, seen.x, rtol=0, atol=1e-12)
    offsets = earthspin.pole_offsets(file="finals")
    first = int(np.flatnonzero(table["NutFlag"] == "I")[0])
    rows = slice(first, first + offsets.time.size)
    assert np.allclose(table["dY_2000A"][rows].value, offsets.dY, rtol=0, atol=1e-9)


@pytest.mark.parametrize("date", ["1960-01-01", "2028-01-01"])
def test_dates_outside_a_table_are_refused(rapid: xr.Dataset, date: str) -> None:
    site = EarthLocation(lon=-70 * u.deg, lat=-24 * u.deg)
    frame = AltAz(obstime=Time(date), location=site)
    with (
        iers.earth_orientation_table.set(rapid.earthspin.to_iers_table()),
        pytest.raises(earthspin.EarthspinError, match=f"{date} is outside") as error,
    ):
        SkyCoord(0 * u.deg, 0 * u.deg).transform_to(frame)
    assert "\n" not in str(error.value)


def test_the_last_epoch_of_a_table_is_refused(rapid: xr.Dataset) -> None:
    """Astropy interpolates between a row and the next, and has the mean pole from the last on."""
    table = rapid.earthspin.to_iers_table()
    last = Time(rapid.time.values[-1].astype(str))
    table.pm_xy(last - 1 * u.s, return_status=True)
    with pytest.raises(earthspin.EarthspinError, match="ends before"):
        table.pm_xy(last, return_status=True)


def test_answers_without_a_table_are_refused() -> None:
    seen = earthspin.polar_motion(span=("2003-01-01", ORIGIN))
    with pytest.raises(earthspin.EarthspinError, match="name a table"):
        earthspin.forecast(30, file=seen).earthspin.to_iers_table()
    with pytest.raises(earthspin.EarthspinError, match="'forecast'"):
        seen.earthspin.to_iers_table()
