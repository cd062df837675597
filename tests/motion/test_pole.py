"""The call: what it gives, at exactly the times asked, and what it refuses."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from astropy.time import Time
from jplephem.excerpter import write_excerpt
from jplephem.spk import SPK

import earthspin
from earthspin import BODIES, EARTH, MARS, MOON
from earthspin.bodies.planets import on_its_orbit
from earthspin.constants import ARCSEC
from earthspin.engine.variables import largest_of
from earthspin.sky import iau_models
from earthspin.sky.ephemeris import find_kernel

RIGID = ("planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order")


def direction(result: object, axis: str = "figure") -> np.ndarray:
    of = result.sel(axis=axis)  # type: ignore[attr-defined]
    return np.stack([of.X, of.Y, of.Z], axis=-1)


def test_the_times_asked_in_the_order_asked() -> None:
    times = ["2003-05-05T01:02:03.456", "1999-01-01", "2000-01-01T12:00"]
    result = earthspin.pole(times=times)
    assert [str(t)[: len(s)] for t, s in zip(result.time.values, times, strict=True)] == times
    again = earthspin.pole(times=Time(times, scale="tdb"))
    assert np.array_equal(result.X, again.X)


def test_a_rigid_earth_starts_at_the_pole_of_the_iau() -> None:
    result = earthspin.pole(times=["2000-01-01T12:00"], effects="rigid")
    off = direction(result)[0] - iau_models.true_pole(np.array([0.0]))[0]
    # What is half-daily is added to it: 0.03 mas.
    assert np.linalg.norm(off) < 1e-4 * ARCSEC


def test_the_default_is_the_pole_of_the_sky() -> None:
    """By default the pole is within its error of IAU 2006/2000A; that of a rigid Earth is not."""
    span = "1990-01-01T12:00", "2010-01-01T12:00", "30 d"
    result, rigid = earthspin.pole(*span), earthspin.pole(*span, effects="rigid")
    days = (result.time.values - np.datetime64("2000-01-01T12:00")) / np.timedelta64(1, "D")
    off = np.linalg.norm(direction(result) - iau_models.true_pole(days), axis=1) / ARCSEC
    assert np.mean(off < result.direction_error) >= 0.95
    assert off.max() < 0.7e-3
    off = np.linalg.norm(direction(rigid) - iau_models.true_pole(days), axis=1) / ARCSEC
    assert 20e-3 < off.max() < 120e-3
    # The start, 30 mas, and the nutation, 57.5 mas.
    assert np.max(np.linalg.norm(direction(result) - direction(rigid), axis=1)) / ARCSEC > 60e-3
    name, size, unit = largest_of(rigid.attrs["neglected"])
    assert (name, unit) == ("nonrigid", "mas")
    assert rigid.direction_error.attrs["not_modelled"] == rigid.attrs["neglected"]
    assert off.max() * 1e3 / 3 < size < off.max() * 1e3 * 3


@pytest.mark.parametrize(
    "scene",
    [
        {"body": "mars"},
        {"perturbers": ["sun"]},
        {"body": EARTH.replace(spin_period="23 h")},
        {"perturbers": ["sun", MOON.replace(gm=6e12)]},
        {"body": {"orbit": {"a": "0.5 au", "about": "sun"}}},
    ],
)
def test_a_response_that_is_not_known_is_left_out_by_default(scene: dict[str, object]) -> None:
    result = earthspin.pole(times=["2010-01-01"], **scene)
    assert "nonrigid" not in result.attrs["effects"].split()


def test_the_response_has_no_known_size_on_another_orbit() -> None:
    body = {"orbit": {"a": "0.5 au", "about": "sun"}}
    result = earthspin.pole(times=["2010-01-01"], body=body, perturbers=["sun"])
    assert result.attrs["neglected"].endswith("size: response of the interior of the Earth")
    on = earthspin.pole(times=["2010-01-01"], body=body, perturbers=["sun"], effects=["nonrigid"])
    assert "interior" not in on.attrs["neglected"]


def test_the_error_of_a_slightly_changed_moon_holds_the_change() -> None:
    """Up to 1 % the response of the interior stays on, and the error is not that of the Earth."""
    scene = {"times": ["2020-01-01T12:00"], "perturbers": ["sun", MOON.replace(gm=1.01 * MOON.gm)]}
    changed, usual = earthspin.pole(**scene), earthspin.pole(times=scene["times"])
    assert "nonrigid" in changed.attrs["effects"].split()
    moved = np.linalg.norm(direction(changed) - direction(usual)) / ARCSEC
    assert 1.0 < moved < float(changed.direction_error[0]) < 1.05 * moved


def test_the_word_rigid_fits_bodies_on_given_orbits() -> None:
    """The orbit of Saturn is given by elements, which place no planets."""
    saturn = on_its_orbit(BODIES["saturn"])
    result = earthspin.pole(times=["2010-01-01"], body=saturn, effects="rigid")
    assert result.attrs["effects"].split() == ["triaxiality", "geodesic", "second-order"]
    with pytest.raises(earthspin.SceneError, match="needs a kernel"):
        earthspin.pole(times=["2010-01-01"], body=saturn, effects=["planets"])


def test_a_renamed_planet_does_not_pull_on_itself() -> None:
    mars, renamed = (
        earthspin.pole(times=["2010-01-01"], body=body, perturbers=["sun"])
        for body in (MARS, MARS.replace(name="x"))
    )
    assert np.array_equal(mars.X, renamed.X)


def test_members_have_the_effects_of_the_nominal_body() -> None:
    """A member with another H has the response of the interior, as the others."""
    times, h = ["2010-01-01"], EARTH.number("dynamical_flattening")
    numbers = xr.Dataset(
        {
            "body.dynamical_flattening": ("member", [h, 1.05 * h]),
            "body.j2": ("member", [EARTH.j2, 1.05 * EARTH.j2]),
        }
    )
    scene = earthspin.Scene(compute="pole", times=times)
    members = earthspin.ensemble(scene, numbers)
    other = EARTH.replace(dynamical_flattening=1.05 * h, j2=1.05 * EARTH.j2)
    alone = earthspin.pole(times=times, body=other, effects="all")
    assert np.array_equal(members.X.isel(member=1), alone.X)


def test_a_default_fits_the_kernel(tmp_path: Path) -> None:
    """A kernel of few years, and one without planets, give what they can by default."""
    whole = SPK.open(str(find_kernel("de421")))
    summaries = list(whole.daf.summaries())
    bare = [entry for entry in summaries if int(entry[1][2]) in (3, 10, 301, 399)]
    short_kernel, bare_kernel = tmp_path / "short.bsp", tmp_path / "no-planets.bsp"
    for path, dates, chosen in (
        (short_kernel, (2447892.5, 2455197.5), summaries),
        (bare_kernel, (2415020.5, 2469807.5), bare),
    ):
        with path.open("w+b") as file:
            write_excerpt(whole, file, *dates, chosen)
    whole.close()
    times = ["2001-01-01", "2009-01-01"]
    for path, on, off in (
        (short_kernel, RIGID, "nonrigid"),
        (bare_kernel, (*RIGID[1:], "nonrigid"), "planets"),
    ):
        result = earthspin.pole(times=times, ephemeris=str(path))
        assert tuple(result.attrs["effects"].split()) == on
        assert largest_of(result.attrs["neglected"])[0] == off


def test_one_effect_at_a_time_is_small_and_not_nothing() -> None:
    times = np.datetime64("1995-01-01T00") + np.arange(40) * np.timedelta64(2200, "h")
    bare = direction(earthspin.pole(times=times, effects=["second-order"]))
    sizes = {}
    for effect in RIGID[:-1]:
        one = direction(earthspin.pole(times=times, effects=["second-order", effect]))
        sizes[effect] = np.max(np.linalg.norm(one - bare, axis=1)) / ARCSEC * 1e3
    assert 0.1 < sizes["planets"] < 5
    assert 0.005 < sizes["j3"] < 0.3
    assert 0.001 < sizes["j4"] < 0.2
    assert 0.01 < sizes["triaxiality"] < 0.08
    assert 20 < sizes["geodesic"] < 80
    assert 0.001 < sizes["j2-rate"] < 0.1


def test_extremes_of_the_span() -> None:
    day = earthspin.pole("2010-01-01", "2010-01-02", "1 h")
    assert day.sizes["time"] == 25
    end = earthspin.pole("2053-10-01", "2053-10-09T00:00:00", "12 h")
    assert np.isfinite(end.X).all()
    with pytest.raises(earthspin.CoverageError):
        earthspin.pole("2053-10-01", "2053-10-09T00:00:01", "1 s")


def test_a_sphere() -> None:
    sphere = EARTH.replace(dynamical_flattening=0.0)
    still = earthspin.pole("2000-01-01", "2005-01-01", "100 d", body=sphere, effects=["j3"])
    assert np.ptp(still.X.values) == np.ptp(still.Y.values) == np.ptp(still.Z.values) == 0


@pytest.mark.parametrize("obliquity", [0, 90, 180])
def test_any_obliquity(obliquity: float) -> None:
    """Directions always; the angle psi not where the axis stands on its orbit."""
    tilt = np.radians(obliquity)
    orbit = (0.0, np.pi / 2)
    body = EARTH.replace(pole=(0.0, float(np.pi / 2 - tilt)), orbit_pole=orbit, triaxiality=0.0)
    result = earthspin.pole("2000-01-01", "2010-01-01", "50 d", body=body)
    assert np.isfinite(result.X).all()
    assert ("psi" in result) == (obliquity == 90)
    if obliquity != 90:
        assert "not defined" in result.earthspin.plan.left_out["pole-angles"]


def test_other_bodies() -> None:
    mars = earthspin.pole("2000-01-01", "2010-01-01", "50 d", body="mars", perturbers=["sun"])
    years = 10.0
    rate = float(mars.psi[-1, 2] - mars.psi[0, 2]) / years
    # 7.6 arcsec/yr and a nutation of an arcsecond
    assert abs(rate - 7.6) < 0.4


def test_what_is_refused() -> None:
    with pytest.raises(earthspin.UndefinedError, match="too slow"):
        earthspin.pole(body=EARTH.replace(spin_period=10 * 86400.0))
    with pytest.raises(earthspin.SceneError, match="did you mean 'planets'"):
        earthspin.pole(effects=["planet"])
    with pytest.raises(earthspin.BodyError):
        EARTH.replace(dynamical_flattening=0.51)
    with pytest.raises(earthspin.SceneError, match="do not fit"):
        earthspin.pole("1950-01-01", "2050-01-01", "1 s")
    with pytest.raises(earthspin.SceneError, match="Mars"):
        earthspin.pole(body="mars", effects=["nonrigid"])
    for flattening in ([3e-3, 3.1e-3], [3e-3]):
        body = EARTH.replace(dynamical_flattening=xr.DataArray(flattening, dims="draw"))
        with pytest.raises(earthspin.BodyError, match="one body at a time"):
            earthspin.pole(body=body)
