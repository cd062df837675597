"""Daily insolation, as a question and from an answer: labels, conventions, errors, refusals."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from astropy import units as u

import earthspin
from earthspin import EARTH, EarthspinError, daily_insolation, insolation
from tests import shipped
from tests.refusals import refused

KYR, DEG = 1000.0, np.pi / 180
LA2004 = Path(__file__).parents[1] / "data" / "la2004-excerpt.txt"
FEW = {"times": ["-125 kyr", "0 kyr"]}
PLACES = {"latitude": ["65N", "0N", "40S"], "solar_constant": "1365 W/m2"}


CALORIC = {"mean": "caloric"}
#: Both kinds of longitude of the Sun.
KINDS = ("longitude", "mean_longitude")


def mean_of(*arguments: Any, **keys: Any) -> xr.DataArray:
    """Insolation of a solution, with its half-width as a coordinate."""
    answer = daily_insolation(*arguments, **keys)
    return answer.insolation.assign_coords(insolation_error=answer.insolation_error)


@pytest.fixture(scope="module")
def past() -> xr.Dataset:
    return shipped.answer("long-term")


def test_65_north_at_the_june_solstice(past: xr.Dataset) -> None:
    """The closed form at 90 degrees from the rows of La2004, with 1365 W/m2: 479.3 today."""
    found = mean_of(past, "65 deg", "90 deg", solar_constant=1365.0)
    assert found.dims == ("epoch",)
    assert found.attrs["units"] == "W m-2"
    for kyr, eps, cp in (
        (0, 0.4090928042223415, 0.01627964595166013),
        (-100, 0.4130265591582125, -0.0006501053038830341),
        (-200, 0.4037251011418818, -0.03833572638169867),
    ):
        at = past.sel(epoch=kyr * KYR)
        e = float(at.eccentricity)
        half = np.arccos(-np.tan(np.radians(65)) * np.tan(eps))
        day = half * np.sin(np.radians(65)) * np.sin(eps)
        day += np.cos(np.radians(65)) * np.cos(eps) * np.sin(half)
        # a/r at 90 degrees: cos v = cos(90 - w - 180) = -sin w
        true = 1365 / np.pi * day * ((1 - cp) / (1 - e * e)) ** 2
        assert float(found.sel(epoch=kyr * KYR)) == pytest.approx(true, rel=5e-4, abs=0)
    assert float(found.sel(epoch=0)) == pytest.approx(479.3, rel=0, abs=0.1)


@pytest.mark.parametrize("latitude", [65.0, 0.0, -40.0])
@pytest.mark.parametrize("longitude", [90.0, 180.0])
def test_half_widths_hold_the_differences_from_la2004(latitude: float, longitude: float) -> None:
    """Over 200,000 years, as returned (measured: 97.0 to 98.5 % are inside, at most 0.07 W/m2)."""
    theirs = earthspin.read_solution(LA2004)
    ours = insolation(times=theirs.epoch, latitude=latitude * u.deg, longitude=longitude * u.deg)
    place = (latitude * u.deg, longitude * u.deg)
    value = mean_of(theirs, *place, solar_constant=1361 * u.W / u.m**2)
    assert np.isnan(value.insolation_error).all()  # that of La2004 is not known
    with pytest.raises(earthspin.EarthspinError, match="give solar_constant"):
        mean_of(theirs, *place)
    difference = np.abs(ours.insolation.values - value.values)
    assert (difference <= ours.insolation_error.values).mean() > 0.95
    assert difference.max() < 0.08


def test_several_latitudes_and_longitudes(past: xr.Dataset) -> None:
    few = past.isel(epoch=slice(-3, None))
    found = mean_of(few, [-65, 0, 65] * u.deg, ["0 deg", "90 deg"])
    assert found.dims == ("epoch", "latitude", "longitude")
    assert found.latitude.values.tolist() == pytest.approx([-65, 0, 65], rel=1e-14, abs=0)
    one = mean_of(few, "65 deg", "90 deg")
    assert np.allclose(found.isel(latitude=2, longitude=1), one, rtol=1e-14, atol=0)
    assert found.insolation_error.dims == found.dims
    labelled = xr.DataArray([0.1, 0.2], dims="place")
    assert mean_of(few, labelled, "90 deg").dims == ("epoch", "place")


def test_mean_longitudes_count_days_from_the_equinox(past: xr.Dataset) -> None:
    """Today spring and summer last 186.4 days, so that 180 degrees of time fall short of it."""
    today = past.isel(epoch=[-1])
    at_equinox = [mean_of(today, "40 deg", **{kind: "0 deg"}).item() for kind in KINDS]
    assert at_equinox[0] == pytest.approx(at_equinox[1], rel=1e-12, abs=0)
    mean = mean_of(today, "40 deg", mean_longitude="180 deg").item()
    # 186.4 - 182.6 days before the September equinox, when it falls by 2.8 W/m2 a day
    true = mean_of(today, "40 deg", "180 deg").item()
    assert 3.0 < (mean - true) / 2.8 < 4.5


def test_a_window_of_days_is_a_mean_of_days(past: xr.Dataset) -> None:
    today = past.isel(epoch=[-1])
    answer = mean_of(today, "65 deg", "90 deg", window="30 d")
    assert answer.attrs["comment"].startswith("mean over 30 d, latitude 65 deg")
    window = answer.item()
    share = 360 * 30 / 365.2422
    e, w = float(today.eccentricity[0]), np.radians(float(today.longitude_of_perihelion[0]))

    def area(true: float) -> float:
        half = np.arctan(np.sqrt((1 - e) / (1 + e)) * np.tan((true - w - np.pi) / 2))
        return float(2 * half - e * np.sin(2 * half))

    middle = np.degrees(area(np.pi / 2) - area(0.0)) % 360
    ends = middle + share * (np.arange(400) + 0.5 - 200) / 400
    by_days = mean_of(today, "65 deg", mean_longitude=ends * u.deg).mean().item()
    assert window == pytest.approx(by_days, rel=1e-5, abs=0)
    year = mean_of(today, "0 deg", "0 deg", window="365.2422 d").item()
    assert year == pytest.approx(416.93 * 1361 / 1365, rel=0, abs=0.2)  # of the PMIP


@pytest.mark.parametrize("latitude", ["90N", "85N", "75N", "45N"])
def test_a_window_of_a_year_is_the_year_at_any_longitude(latitude: str) -> None:
    """At the pole S sin(eps)/(pi sqrt(1 - e^2)); before, the difference was 430 half-widths."""
    keys = {"times": ["0 kyr"], "window": "365.2422 d", "solar_constant": "1361 W/m2"}
    found = insolation(**keys, latitude=latitude, longitude=["0 deg", "77 deg", "213 deg"])
    assert (
        np.ptp(found.insolation.values) < 1e-9
    )  # 3e-5 of a day more or less is 0.007 W/m2 at 45 N
    if latitude == "90N":
        past = earthspin.long_term(times=["0 kyr"])
        at_pole = 1361 / np.pi * np.sin(np.radians(past.obliquity.item()))
        at_pole /= np.sqrt(1 - past.eccentricity.item() ** 2)
        assert np.abs(found.insolation - at_pole).max() < 1e-9


def test_the_error_is_that_of_the_answer(past: xr.Dataset) -> None:
    found = mean_of(past, "65 deg", "90 deg")
    error = found.insolation_error
    assert error.attrs["units"] == "W m-2"
    assert 0 < float(error[-1]) < 0.05 < float(error[0]) < 20
    still = past.copy()
    for name in ("obliquity", "eccentricity", "longitude_of_perihelion"):
        still[f"{name}_error"] = 0 * still[f"{name}_error"]
    assert float(mean_of(still, "65 deg", "90 deg").insolation_error.max()) == 0
    one = still.assign(obliquity_error=past.obliquity_error)
    by_tilt = mean_of(one, "65 deg", "90 deg").insolation_error
    higher = (past.obliquity + past.obliquity_error).assign_attrs(past.obliquity.attrs)
    up = past.assign(obliquity=higher)
    moved = np.abs(mean_of(up, "65 deg", "90 deg") - found)
    assert np.allclose(by_tilt, moved, rtol=0.02, atol=1e-9)


@pytest.mark.parametrize("half", [0.01, 200.0])
def test_both_longitudes_have_the_same_error_at_the_equinox(past: xr.Dataset, half: float) -> None:
    """There both longitudes are zero for any perihelion.

    Only the true longitude is computed for all latitudes in one step.
    """
    lost = past.copy()
    name = "longitude_of_perihelion_error"
    lost[name] = (0 * past[name] + half).assign_attrs(past[name].attrs)
    errors = [
        mean_of(lost, ["-40 deg", "65 deg"], **{kind: "0 deg"}).insolation_error for kind in KINDS
    ]
    assert np.allclose(*errors, rtol=1e-7, atol=0)  # 6e-9 measured


@pytest.mark.slow
def test_the_error_holds_where_the_season_of_perihelion_is_lost() -> None:
    """The half-width of the perihelion is more than a turn there; draws of it are the truth."""
    past = earthspin.long_term("-10 Myr", "-9.5 Myr", "10 kyr")
    found = mean_of(past, "65 deg", "90 deg")
    random, inside = np.random.default_rng(3), []
    for _ in range(200):
        member = past.copy()
        for name in ("obliquity", "eccentricity", "longitude_of_perihelion"):
            half = past[f"{name}_error"]
            member[name] = past[name] + random.standard_normal() / 1.959964 * half
            member[name].attrs = past[name].attrs
            member[f"{name}_error"] = 0 * half
            member[f"{name}_error"].attrs = half.attrs
        one = mean_of(member, "65 deg", "90 deg")
        inside.append((np.abs(one - found) <= found.insolation_error).mean())
    # each share has its 95 %, and the root of their squares a little more
    assert 0.93 < float(np.mean(inside)) < 0.995


def test_mars_gets_less_by_the_square_of_its_distance() -> None:
    mars = earthspin.long_term(times=["0 kyr"], body="mars")
    own = mean_of(mars, "0 deg", "90 deg")
    assert own.attrs["solar_constant"] == pytest.approx(1361 / 1.5237**2, rel=1e-3, abs=0)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("91 deg", "0 deg"), "latitude = '91 deg': give at most 90 degrees"),
        (("65E", "0 deg"), "latitude"),
        (("65 deg", "400 deg"), "at most 360 degrees"),
        (("65 km", "0 deg"), "not a value in units of rad"),
        (([[1, 2, 3]] * u.deg, "0 deg"), "one list"),
    ],
)
def test_wrong_angles_are_refused(
    past: xr.Dataset, arguments: tuple[object, object], words: str
) -> None:
    with pytest.raises(EarthspinError, match=words) as told:
        mean_of(past, *arguments)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize(
    ("named", "words"),
    [
        ({"window": "0 d"}, "greater than zero"),
        ({"solar_constant": -1.0}, "greater than zero"),
        ({"solar_constant": "1361 W"}, "W/m2"),
    ],
)
def test_wrong_settings_are_refused(past: xr.Dataset, named: dict[str, object], words: str) -> None:
    with pytest.raises(EarthspinError, match=words):
        mean_of(past, "65 deg", "90 deg", **named)


def test_another_result_is_refused(past: xr.Dataset) -> None:
    with pytest.raises(EarthspinError, match="long_term"):
        mean_of(past.drop_vars("obliquity"), "65 deg", "90 deg")
    with pytest.raises(EarthspinError, match="long_term"):
        mean_of(3, "65 deg", "90 deg")  # type: ignore[arg-type]
    unknown = past.copy()
    unknown["obliquity"] = past.obliquity.assign_attrs(orbit_of="vulcan")
    with pytest.raises(EarthspinError, match="vulcan"):
        mean_of(unknown, "65 deg", "90 deg")


@pytest.mark.parametrize(
    ("old", "words"),
    [
        ({"true_longitude": False}, "give mean_longitude in place of longitude"),
        ({"solar_longitude": "90 deg"}, "'solar_longitude'; give longitude"),
        ({"days": "30 d"}, "'days'; give window"),
    ],
)
def test_old_arguments_are_refused_with_the_new_one(
    past: xr.Dataset, old: dict[str, object], words: str
) -> None:
    with pytest.raises(EarthspinError, match=words):
        daily_insolation(past, "65 deg", **old)


@pytest.mark.parametrize("keys", [{}, {"window": "90 d"}, CALORIC], ids=str)
@pytest.mark.parametrize("half", [0.01, 30.0])
def test_one_epoch_is_that_of_the_whole(past: xr.Dataset, half: float, keys: Any) -> None:
    """Also where the perihelion is sampled, for an error above 0.1 rad."""
    lost = past.isel(epoch=[0, 500, -1])
    name = "longitude_of_perihelion_error"
    lost[name] = (0 * lost[name] + half).assign_attrs(past[name].attrs)
    whole = daily_insolation(lost, "65 deg", **keys).isel(epoch=1)
    one = daily_insolation(lost.isel(epoch=1), "65 deg", **keys)
    xr.testing.assert_identical(one, whole)


# --- the question --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "arguments", "named"),
    [
        ({}, ("65 deg", "90 deg"), {}),
        (PLACES, (["65 deg", "0 deg", "-40 deg"], "90 deg"), {"solar_constant": 1365}),
        (
            {"latitude": 0.1, "longitude": ["0 deg", "50 deg"], "window": "30 d"},
            (0.1, ["0 deg", "50 deg"]),
            {"window": "30 d"},
        ),
        ({"day": 172}, ("65 deg",), {"mean_longitude": 2 * np.pi * (172 - 80) / 365.2422}),
    ],
    ids=["defaults", "latitudes", "window", "day"],
)
def test_the_question_is_daily_insolation(keys: Any, arguments: Any, named: Any) -> None:
    """Bit for bit, and so is the answer to its scene."""
    found = insolation(**FEW, **keys)
    other = mean_of(earthspin.long_term(**FEW), *arguments, **named)
    assert np.array_equal(found.insolation, other)
    assert np.array_equal(found.insolation_error, other.insolation_error)
    xr.testing.assert_identical(earthspin.run(found), found)


def test_calendar_days_of_climlab() -> None:
    """Of climlab 0.9.2 with our elements of today, in a calendar with the equinox on day 80."""
    found = insolation(times=["0 kyr"], day=[15, 80, 172, 200, 300], **PLACES).insolation
    assert found.dims == ("epoch", "latitude", "day")
    of_climlab = [
        [11.473170, 185.103498, 479.350129, 440.275894, 66.250529],
        [418.611153, 437.992140, 386.020606, 392.882125, 429.227705],
        [502.059489, 335.521430, 146.532388, 164.745212, 431.285670],
    ]
    assert np.allclose(found[0], of_climlab, rtol=0, atol=3e-5)  # its series; 2.1e-5 measured


@pytest.mark.parametrize(
    ("latitude", "degrees"),
    [
        ("65N", 65.0),
        ("65 N", 65.0),
        ("23.5S", -23.5),
        ("65\N{DEGREE SIGN}N", 65.0),
        (65 * u.deg, 65.0),
        (np.radians(65), 65.0),
        (["65N", "23.5S"], [65.0, -23.5]),
        (xr.DataArray([65.0, 10.0], dims="y", attrs={"units": "degrees_north"}), [65.0, 10.0]),
    ],
    ids=str,
)
def test_latitudes_as_people_write_them(past: xr.Dataset, latitude: Any, degrees: Any) -> None:
    found = insolation(**FEW, latitude=latitude)
    assert found.latitude.values.tolist() == degrees
    same = mean_of(past, latitude, "90 deg")[[-1]]
    assert np.array_equal(same, mean_of(past, np.radians(degrees), "90 deg")[[-1]])


test_wrong_keys_are_refused = refused(
    ({"latitude": 65}, "write '65.0 deg'"),
    ({"latitude": "95N"}, "latitude.*at most 90"),
    ({"longitude": 90}, "write '90.0 deg'"),
    ({"longitude": "90 deg", "day": 172}, "either longitude, or mean_longitude, or day"),
    ({"day": 400}, "day = 400.*367"),
    ({"day": 100, "body": "mars"}, "Earth's calendar"),
    ({"window": "2 yr"}, "at most a year"),
    ({"members": {"latitude": {"grid": ["65 deg", "66 deg"]}}}, "labels along 'latitude'"),
    ({"latitude": np.full(3_000_000, 0.1)}, "fit into memory"),
    call=lambda keys: insolation(**FEW, **keys),
)


def test_an_unknown_start_leaves_no_error() -> None:
    found = insolation(**FEW, body=EARTH.replace(pole_uncertainty=None))
    assert np.isnan(found.insolation_error).all()
    assert "pole_uncertainty" in found.insolation_error.attrs["no_error"]


def test_a_day_takes_the_place_of_the_longitude_of_a_scene() -> None:
    scene = earthspin.load_scene("insolation", {**FEW, "day": 80})
    found = earthspin.run(scene)
    assert "longitude" not in found.coords
    assert np.allclose(
        found.insolation, insolation(**FEW, longitude=0).insolation, rtol=1e-12, atol=0
    )


def test_angles_whose_labels_differ_are_refused() -> None:
    """They gave three rows, two of them NaN."""
    past = earthspin.long_term("-1 kyr", "0 kyr", "1 kyr")
    latitude = xr.DataArray([1.0, 1.1], {"place": [1, 2]})
    with pytest.raises(EarthspinError, match=r"longitude.*labels"):
        daily_insolation(past, latitude, latitude.assign_coords(place=[2, 3]))
    assert daily_insolation(past, latitude, latitude).sizes == {"epoch": 2, "place": 2}


# --- averages over longer times ------------------------------------------------------------------

#: Each mean with the inputs that it needs.
MEANS: dict[str, dict[str, Any]] = {
    "day": {},
    "interval": {"longitude": ["270 deg", "90 deg"]},
    "window": {"window": "90 d"},
    "year": {},
    "caloric": {},
    "above": {"threshold": "275 W/m2"},
    "extremes": {},
    "all-extremes": {},
    "seasons": {},
}
LATITUDES = ["90N", "66.5607N", "65N", "30N", "0N", "23.5S", "80S"]


@pytest.mark.parametrize("mean", MEANS)
def test_each_mean_is_the_same_of_a_solution(past: xr.Dataset, mean: str) -> None:
    """It is drawn, computed again from its scene, and has a half-width for every variable."""
    places = {} if mean == "seasons" else {"latitude": ["65N", "0N"]}
    found = insolation(**FEW, mean=mean, **MEANS[mean], **places)
    few = earthspin.long_term(**FEW)
    other = daily_insolation(few, mean=mean, **MEANS[mean], **places)
    assert {*found.data_vars} == {*other.data_vars}
    for name, values in other.data_vars.items():
        assert np.array_equal(found[name], values.transpose(*found[name].dims), equal_nan=True)
        assert found[name].attrs["units"] == values.attrs["units"]
        assert "_error" in name or "no_error" in values.attrs or f"{name}_error" in other
    xr.testing.assert_identical(earthspin.run(found), found)
    assert found.earthspin.plot()


def test_means_agree_with_one_another() -> None:
    keys: dict[str, Any] = {**FEW, "latitude": LATITUDES}
    year = insolation(**keys, mean="year").annual_mean
    caloric = insolation(**keys, mean="caloric")
    halves = (caloric.caloric_summer + caloric.caloric_winter) / 2
    assert np.allclose(halves, year, rtol=1e-14, atol=0)
    energy = 365.2422 * 43200 / 1e9 * caloric.caloric_summer
    assert np.allclose(caloric.caloric_summer_energy, energy, rtol=1e-14, atol=0)
    whole = insolation(**keys, window="365.2422 d").insolation
    assert np.allclose(whole, year, rtol=1e-13, atol=0)
    parts = insolation(
        **keys, mean="interval", longitude=[["10 deg", "200 deg"], ["200 deg", "10 deg"]]
    )
    assert np.allclose(parts.length.sum("interval"), 365.2422, rtol=1e-14, atol=0)
    mean = (parts.insolation * parts.length).sum("interval") / 365.2422
    assert np.allclose(mean.transpose(*year.dims), year, rtol=1e-13, atol=0)
    above = insolation(**keys, mean="above", threshold="275 W/m2")
    excess = above.integrated_summer - 275 * above.days_above * 86400 / 1e9
    assert np.allclose(above.excess, excess, rtol=0, atol=1e-12)
    ends, every = insolation(**keys, mean="extremes"), insolation(**keys, mean="all-extremes")
    assert np.allclose(every.extreme_insolation.max("extreme"), ends.largest, rtol=1e-14, atol=0)
    night = (every.extreme_insolation < 1e-9).any("extreme") * 1
    assert np.array_equal(every.extreme_insolation.count("extreme") - night, ends["count"])
    assert insolation(**FEW, mean="seasons").season_length.sum("season").values == pytest.approx(
        [365.2422] * 2, rel=1e-14, abs=0
    )


@pytest.mark.parametrize("mean", ["day", "interval", "window", "year"])
def test_bands_are_means_by_area(mean: str) -> None:
    nodes, weights = np.polynomial.legendre.leggauss(400)
    sines = 0.5 + 0.25 * (1 + nodes)  # 30 to 90 degrees
    keys = {**FEW, "mean": mean, **MEANS[mean]}
    band = insolation(**keys, latitude=[["30N", "90N"], ["90S", "90N"]])
    name = next(iter(band.data_vars))
    places = insolation(**keys, latitude=np.arcsin(sines))[name]
    by_area = places.values @ weights / 2
    assert band.band.values.tolist() == ["30 to 90", "-90 to 90"]
    assert band[name][:, 0].values == pytest.approx(by_area, rel=1e-6, abs=0)  # 3e-7 measured


def test_a_half_width_of_the_solar_constant() -> None:
    """A scale of all means but those above a threshold, whose days depend on it."""
    keys: dict[str, Any] = {**FEW, "solar_constant_error": "1.361 W/m2"}
    for mean, name in (("year", "annual_mean"), ("caloric", "caloric_summer")):
        found = insolation(**keys, mean=mean)
        alone = insolation(**FEW, mean=mean)[f"{name}_error"]
        constant = found[name].attrs["solar_constant"]
        expected = np.hypot(alone, found[name] * 1.361 / constant)
        assert np.allclose(found[f"{name}_error"], expected, rtol=1e-9, atol=0)
    days = [
        insolation(**FEW, mean="above", threshold="275 W/m2", solar_constant=s).days_above
        for s in (1361 * 1.001, 1361 / 1.001, 1361)
    ]
    found = insolation(**keys, mean="above", threshold="275 W/m2").days_above_error
    assert np.allclose(found, np.abs(days[0] - days[1]) / 2, rtol=0.1, atol=0)


@pytest.mark.parametrize("mean", ["interval", "window", "year", "caloric", "above", "extremes"])
def test_half_widths_hold_fresh_draws(past: xr.Dataset, mean: str) -> None:
    """93 to 97 % of 60 draws at each of 21 epochs and 7 latitudes, of every variable."""
    solution, random = past.isel(epoch=slice(None, None, 50)), np.random.default_rng(6)
    drawn = xr.Dataset()
    for name in ("obliquity", "eccentricity", "longitude_of_perihelion"):
        half = solution[f"{name}_error"]
        normal = random.standard_normal((60, solution.sizes["epoch"])) / 1.959964
        drawn[name] = solution[name] + half * xr.DataArray(normal, dims=("draw", "epoch"))
        drawn[name].attrs = solution[name].attrs
    keys: dict[str, Any] = {"mean": mean, "latitude": LATITUDES, **MEANS[mean]}
    keys["solar_constant"] = "1361 W/m2"
    found, other = daily_insolation(solution, **keys), daily_insolation(drawn, **keys)
    names = [name for name in found if f"{name}_error" in found and name != "length"]
    for name in names:
        inside = np.abs(other[name] - found[name]) <= found[f"{name}_error"] + 1e-12
        known = np.isfinite(found[f"{name}_error"]) & (found[f"{name}_error"] > 1e-9)
        share = inside.where(known & np.isfinite(other[name])).mean().item()
        assert 0.93 < share < 0.97, (name, share)


test_inputs_that_a_mean_does_not_read_are_refused = refused(
    ({"mean": "summer"}, "allowed: above, all-extremes"),
    ({"mean": "year", "day": 172}, "'year' does not read it; it is for mean = 'day' or"),
    ({"mean": "day", "window": "30 d"}, "window.*'day' does not read it"),
    ({"threshold": "275 W/m2"}, "it is for mean = 'above'"),
    ({"mean": "above"}, "threshold.*'above' needs it"),
    ({"mean": "window"}, "window.*needs it"),
    ({"mean": "interval"}, "longitude.*first and last"),
    ({"mean": "caloric", "latitude": [["0N", "10N"]]}, "pairs are for mean = 'day' or"),
    ({"longitude": [["0 deg", "10 deg"]]}, "pairs are for mean = 'interval'"),
    ({"mean": "above", "threshold": "275 W"}, "W/m2"),
    call=lambda keys: insolation(**FEW, **keys),
)


def test_a_solution_without_a_body_has_the_year_of_the_earth() -> None:
    laskar = earthspin.read_solution(LA2004).isel(epoch=slice(-2, None))
    found = daily_insolation(laskar, mean="caloric", solar_constant="1361 W/m2")
    assert np.isnan(found.caloric_summer_error).all()
    energy = found.caloric_summer * 365.2422 * 43200 / 1e9
    assert np.allclose(found.caloric_summer_energy, energy, rtol=1e-14, atol=0)
    unknown = laskar.assign(obliquity=laskar.obliquity.assign_attrs(orbit_of="vulcan"))
    with pytest.raises(EarthspinError, match="the year of vulcan is not known"):
        daily_insolation(unknown, mean="caloric", solar_constant="1361 W/m2")
