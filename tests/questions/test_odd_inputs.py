"""Inputs that were once taken for something else, or broke: each is right now, or refused."""

from collections.abc import Callable
from typing import Any

import astropy.units as u
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from astropy.time import Time, TimeDelta

import earthspin
from earthspin import (
    EARTH,
    ArgumentError,
    Body,
    BodyError,
    EarthspinError,
    OutputError,
    SceneError,
    UndefinedError,
    UnitsError,
    units,
)
from tests.refusals import refused


@pytest.mark.parametrize("text", ["0.3 furlongs", "0.3 km", "0.3 bananas"])
def test_a_pure_number_has_no_unit(text: str) -> None:
    with pytest.raises(UnitsError, match="dynamical_flattening"):
        earthspin.precession(body={"dynamical_flattening": text})


def test_per_cent_are_hundredths() -> None:
    one, other = (
        earthspin.wobble_ladder(body={"dynamical_flattening": h}) for h in ("0.32 percent", 0.0032)
    )
    assert np.array_equal(one.period_solar, other.period_solar)


def test_components_are_read_by_name() -> None:
    labels = {"component": ["z", "y", "x"]}
    turned = xr.DataArray([0.0, 0.0, 7e6], labels, ("component",))
    plain = earthspin.spheroid_field([7e6, 0.0, 0.0])
    assert earthspin.spheroid_field(turned).equals(plain)
    with pytest.raises(SceneError, match="components x, y and z"):
        earthspin.spheroid_field(turned.assign_coords(component=["a", "b", "c"]))
    with pytest.raises(SceneError, match="bare numbers"):
        earthspin.spheroid_field(pd.DataFrame({"z": [0.0], "y": [0.0], "x": [7e6]}))


def test_several_starts_of_an_answer_start_again() -> None:
    moments, starts = [1.0, 2.0, 3.0], np.random.default_rng(3).normal(size=(3, 3))
    there = earthspin.free_rotor(moments, starts, [0.0, 1.0])
    again = earthspin.free_rotor(moments, there.omega_body.isel(time=1), [0.0])
    # measured: 4e-16
    assert np.allclose(again.energy[:, 0], there.energy[:, 0], rtol=4e-15, atol=0)


def test_fields_of_several_bodies_are_those_of_each() -> None:
    radii, points = [6e6, 6.4e6], [[7e6, 0.0, 0.0], [8e6, 0.0, 0.0]]
    many = {"radius": xr.DataArray(radii, dims="b")}
    together = earthspin.spheroid_field(points, body=many)
    assert together.sizes["b"] == len(radii)
    for i, radius in enumerate(radii):
        alone = earthspin.spheroid_field(points, body={"radius": radius})
        for name in ("potential", "attraction", "torque", "relative_error"):
            assert np.array_equal(together[name].isel(b=i), alone[name])


@pytest.fixture(scope="module")
def chi() -> xr.Dataset:
    return earthspin.excitation(earthspin.polar_motion(span=("2000-01-01", "2002-01-01")))


@pytest.mark.parametrize(
    ("part", "words"),
    [
        (slice(100, 200), "its start_day"),
        (slice(None, None, -1), "not ascending"),
        (slice(None, None, 2), "means are over 1 d"),
        (slice(0, 1), "two or more"),
    ],
)
def test_a_part_of_an_excitation_is_no_whole_one(chi: xr.Dataset, part: slice, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        earthspin.polar_motion_from(chi.isel(time=part))


def test_a_part_of_an_excitation_with_its_own_start(chi: xr.Dataset) -> None:
    whole = earthspin.polar_motion_from(chi)
    begin = [float(whole[name][100]) * 1e3 for name in ("x", "y")]
    part = earthspin.polar_motion_from(chi.isel(time=slice(100, 200)), start=begin)
    # measured: 6e-16 arcsec
    assert np.allclose(part.x, whole.x[100:201], rtol=0, atol=6e-15)


def test_a_time_that_says_its_unit_twice() -> None:
    times = xr.DataArray(np.array([1, 2], "m8[s]"), dims="t", attrs={"units": "min"})
    assert earthspin.free_rotor([1, 2, 3], [1, 0, 1], times).time.values.tolist() == [1.0, 2.0]


def test_a_set_has_no_order() -> None:
    with pytest.raises(SceneError, match="no order"):
        earthspin.Scene(compute="precession", perturbers={"sun", "moon"})


LABELS = {
    "dates": np.array(["2000-01-01", "2001-01-01"], "M8[ns]"),
    "truth": np.array([True, False]),
    "words": np.array(["p", "q"], dtype=object),
}


@pytest.mark.parametrize("kind", LABELS)
def test_labels_of_every_kind_are_kept(kind: str) -> None:
    h = xr.DataArray([3.1e-3, 3.2e-3], {"b": LABELS[kind], "run": 7}, ("b",))
    answer = earthspin.precession(body=EARTH.replace(dynamical_flattening=h))
    assert earthspin.run(answer).equals(answer)
    assert set(answer.coords) >= {"b", "run"}


@pytest.mark.parametrize(
    "start",
    [
        TimeDelta(3.0, format="jd"),
        Time(["2000-01-01", "2000-01-02"]),
        Time(2415171.5, format="jd", scale="ut1"),
        Time(2415171.5, format="jd", scale="utc"),
        Time("2000-01-01", scale="local"),
        np.timedelta64(1, "M"),
    ],
)
def test_what_is_no_date_that_can_be_known(start: object) -> None:
    with pytest.raises(EarthspinError):
        earthspin.torque_series(start, "2001-01-01", "1 d")


def test_what_is_natural_is_taken() -> None:
    year = earthspin.torque_series("2000-01-01", "2000-01-03", "1 d")
    first, last = year.time[0], year.time[-1]
    for span, step in (
        ((first, last), TimeDelta(1.0, format="jd")),
        (pd.DatetimeIndex([first.values, last.values]), 1 * u.day),
        (Time(["2000-01-01", "2000-01-03"], scale="tdb"), "24 h"),
    ):
        again = earthspin.torque_series(span[0], span[1], step)
        assert np.array_equal(again.torque, year.torque)


def test_a_pole_that_stands_still_has_no_wobble() -> None:
    pole = earthspin.polar_motion(span=("1980-01-01", "2000-01-01"))
    with pytest.raises(UndefinedError, match="stands still"):
        earthspin.fit_chandler(pole.map(lambda a: a * 0 if a.dims == ("time",) else a, True))
    with pytest.raises(SceneError, match="two or more"):
        earthspin.fit_chandler(pole.isel(time=slice(0, 0)))


def test_what_is_no_answer() -> None:
    with pytest.raises(OutputError, match="not an answer"):
        earthspin.write(5, "q.nc")  # type: ignore[arg-type]
    with pytest.raises(SceneError, match="changes"):
        earthspin.load_scene("torque", 5)  # type: ignore[arg-type]
    with pytest.raises(SceneError, match="sections"):
        earthspin.plan("torque", 5)  # type: ignore[arg-type]


def test_a_question_takes_the_words_of_a_scene() -> None:
    rotor = earthspin.load_scene("poinsot")
    few = earthspin.load_scene(rotor, {"rotor.points": 3, "rotor.duration": "1 s"})
    assert few.points == 3  # type: ignore[attr-defined]
    flat = earthspin.load_scene(earthspin.load_scene("sun-only"), {"body.j2": 1.1e-3})
    assert flat.body.j2 == 1.1e-3  # type: ignore[attr-defined]
    assert flat.title == "Precession under the Sun alone"


def test_trees_know_their_scene_too() -> None:
    tree = earthspin.run_tree("wobble", ["observed"])
    assert tree.earthspin.scene.word == "wobble"
    assert "rung" in tree.earthspin.to_frame()


def test_an_answer_without_figures_of_its_own_is_drawn() -> None:
    (figure,) = earthspin.precession(body="saturn").earthspin.plot()
    assert any("arcsec" in axes.get_ylabel() for axes in figure.axes)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: EARTH.replace(moments=5e-324), "give three"),
        (lambda: earthspin.Body.from_layers("prem", spin_period="1 d", moments=1.0), "give three"),
        (lambda: earthspin.read_excitation("x" * 100_000), "name too long|no such file"),
        (lambda: earthspin.ensemble("precession", "x" * 100_000), "no such file"),
        (lambda: units.real_numbers([10**400]), "too large"),
        (lambda: earthspin.read_excitation("aam.txt", components=[]), "no component is named"),
    ],
)
def test_what_the_fuzzer_found_is_refused(call: Callable[[], object], words: str) -> None:
    with pytest.raises((earthspin.EarthspinError, ValueError), match=f"(?i){words}"):
        call()


CIRCLE: dict[str, object] = {}
CIRCLE["body"] = CIRCLE
PAST = earthspin.long_term(times=["-2000-01-01", "0001-01-01", "2000-01-01"])
ROCK: dict[str, Any] = {"name": "rock", "gm": 1e14, "radius": 1e6}
FAR = EARTH.replace(orbit={"a": "1 au", "about": "star"})
MOMENTS = ["1e30 kg m2", "1.1e30 kg m2", "1.2e30 kg m2"]

test_what_broke_is_refused_in_one_line = refused(
    (lambda: earthspin.load_scene("precession", CIRCLE), SceneError, "contains itself"),
    (lambda: earthspin.ensemble("precession", CIRCLE), SceneError, "contains itself"),
    (lambda: EARTH.replace(obliquity=np.array([0.1, 0.2])), BodyError, "one angle"),
    (lambda: EARTH.replace(obliquity=["1 deg", "2 deg"]), BodyError, "one angle"),
    (lambda: Body(**ROCK, moments=MOMENTS[:2]), SceneError, "give three"),
    (lambda: Body(**ROCK, mass="1 kg"), BodyError, "already gives gm"),
    (lambda: Body(name="rock", radius=1.0), ArgumentError, "gm = .*spin_period"),
    (lambda: EARTH.replace(polar_moment_factor=0.33), BodyError, "dynamical_flattening = j2/"),
    (lambda: earthspin.precession(body=FAR, perturbers="moon"), SceneError, "to the perturbers"),
    (lambda: Body(**ROCK, spin="5 h"), BodyError, "spin_period"),
)


@pytest.mark.parametrize(
    "latitude",
    [
        xr.DataArray([0.1, 0.2], dims="epoch"),
        xr.DataArray([0.1, 0.2, 0.3], {"epoch": [1, 2, 3]}, ("epoch",)),
    ],
)
def test_latitudes_along_other_epochs(latitude: xr.DataArray) -> None:
    with pytest.raises(SceneError, match=r"latitude.*epoch"):
        earthspin.daily_insolation(PAST, latitude, "90 deg")
    with pytest.raises(SceneError, match=r"longitude.*epoch"):
        earthspin.daily_insolation(PAST, "65 deg", latitude)
    fitting = xr.DataArray([0.1, 0.2, 0.3], dims="epoch")
    along = earthspin.daily_insolation(PAST, fitting, "90 deg").insolation
    alone = earthspin.daily_insolation(PAST, [0.1, 0.2, 0.3], "90 deg").insolation
    diagonal = [float(alone[i, i]) for i in range(3)]
    assert along.values == pytest.approx(diagonal, rel=1e-14, abs=0)


def test_moments_of_a_body_from_nothing() -> None:
    table = {"from": "nothing", "moments": MOMENTS, **ROCK}
    body = earthspin.load_scene(
        "wobble", {"body": {**table, "flattening": 0.01, "spin_period": "9 h"}}
    )
    assert body.body.moments == pytest.approx([1e30, 1.1e30, 1.2e30], rel=1e-12, abs=0)


@pytest.mark.parametrize("given", [[1.0, 2.0] * u.m, np.empty((0, 3)), None, "x"], ids=range(4))
def test_satellites_that_are_none(given: Any) -> None:
    with pytest.raises(SceneError, match="satellites"):
        Body(name="x", gm=1e14, satellites=given)


@pytest.mark.parametrize("given", [EARTH, 3, None], ids=range(3))
def test_stars_near_the_pole_of_what_is_no_answer(given: Any) -> None:
    with pytest.raises(SceneError, match="long_term"):
        earthspin.pole_stars(given)
