"""A body at an obliquity: the angle, the equinox that stays, and what is refused."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import earthspin
from earthspin import EARTH, MARS, Body, BodyError, Orbit, SceneError
from earthspin.bodies import SATURN, URANUS
from earthspin.errors import Where


@settings(deadline=None, max_examples=40)
@given(
    body=st.sampled_from([EARTH, MARS, SATURN, URANUS]), obliquity=st.floats(0.01, math.pi - 0.01)
)
def test_the_axis_leans_as_told_and_the_equinox_stays(body: Body, obliquity: float) -> None:
    tilted = body.replace(obliquity=obliquity)
    before = body.pole.orbit_axes(body.orbit_pole)
    after = tilted.pole.orbit_axes(tilted.orbit_pole)
    axis = tilted.pole.vector()
    # measured: 3e-16, and 2e-14 near the normal
    assert np.allclose(after, before, atol=1e-13 / math.sin(obliquity), rtol=0)
    assert math.atan2(np.linalg.norm(np.cross(before[2], axis)), before[2] @ axis) == pytest.approx(
        obliquity, abs=1e-14, rel=0
    )


def test_the_earth_at_its_own_obliquity_keeps_its_rate() -> None:
    """The Sun's torque goes with the cosine of the obliquity (I.8.7, averaged)."""
    angle = math.acos(np.array([0, 0, 1]) @ np.array([0, math.sin(0.7), math.cos(0.7)]))
    rate = {
        tilt: earthspin.precession(body=EARTH.replace(obliquity=tilt), perturbers="sun")
        .precession_rate[-1]
        .item()
        for tilt in ("84381.406 arcsec", angle)
    }
    own = earthspin.precession(perturbers="sun").precession_rate[-1].item()
    # measured: 2.4e-8, the difference of fixed and moving equator
    assert rate["84381.406 arcsec"] == pytest.approx(own, rel=1e-7, abs=0)
    ratio = math.cos(0.7) / math.cos(math.radians(84381.406 / 3600))
    assert rate[angle] / own == pytest.approx(ratio, rel=1e-6, abs=0)


def test_a_planet_of_ones_own() -> None:
    star = earthspin.SUN.replace(name="star", mass=0.6 * 1.98841e30, naif=())
    planet = EARTH.replace(
        name="planet",
        spin_period="12 h",
        obliquity="40 deg",
        orbit=Orbit(period="60 d", i="3 deg", about="star"),
    )
    answer = earthspin.precession(body=planet, perturbers=[star])
    assert answer.obliquity.item() == pytest.approx(40.0, abs=1e-9, rel=0)
    # 3/2 n^2 H cos(eps) / omega with n of a circular orbit
    n, omega = 2 * math.pi / (60 * 86400), 2 * math.pi / 43200
    rate = 1.5 * n**2 * EARTH.dynamical_flattening * math.cos(math.radians(40)) / omega
    period = 2 * math.pi / rate / (365.25 * 86400)
    # the planet's own mass is 5e-6 of the star's and part of n
    assert answer.precession_period[-1].item() == pytest.approx(period, rel=1e-5, abs=0)


def test_a_scene_takes_it_and_keeps_the_pole() -> None:
    keys = {"body": {"from": "mars", "obliquity": "40 deg"}, "perturbers": "sun"}
    answer = earthspin.run(earthspin.load_scene("precession", keys))
    assert answer.identical(earthspin.run(answer))
    assert answer.obliquity.item() == pytest.approx(40.0, abs=1e-9, rel=0)


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"obliquity": "40 deg", "pole": (0.0, 0.0)}, "set one of"),
        ({"obliquity": "400 deg"}, "0 to 180"),
        ({"obliquity": "4 km"}, "rad"),
        ({"obliquity": float("nan")}, "finite"),
        ({"obliquity": None}, "number"),
        ({"obliquity": 0.5, "orbit": Orbit(a="1 au", about="sun", plane="equator")}, "plane"),
    ],
)
def test_what_is_no_obliquity_is_refused(changes: dict[str, object], word: str) -> None:
    with pytest.raises(earthspin.EarthspinError, match=word):
        MARS.replace(**changes)


def test_without_an_orbit_there_is_no_obliquity() -> None:
    with pytest.raises(BodyError, match="normal of the orbit"):
        Body(name="bare", gm=1e14, obliquity="40 deg")
    with pytest.raises(BodyError, match="set one of"):
        Body(name="bare", gm=1e14, pole=(0.0, 0.0), obliquity="40 deg")


PLANET: dict[str, Any] = {
    "name": "planet", "gm": 4e14, "radius": 6.4e6, "spin_period": "20 h", "obliquity": "33 deg",
    "j2": 1e-3, "dynamical_flattening": 3e-3,
}  # fmt: skip


def test_an_obliquity_that_was_given_stays_on_another_orbit() -> None:
    flat, steep = (Orbit(a="1 au", i=i, about="star") for i in ("5 deg", "60 deg"))
    moved = Body(**PLANET, orbit=flat).replace(orbit=steep)
    assert moved == Body(**PLANET, orbit=steep)
    normal, axis = moved.orbit_pole.vector(), moved.pole.vector()
    assert math.degrees(math.acos(normal @ axis)) == pytest.approx(33.0, abs=1e-12, rel=0)
    stored = Body.read(Body(**PLANET, orbit=flat).write(), Where("body"))
    assert stored.replace(orbit=steep) == moved


def test_a_normal_that_was_given_stays_and_a_derived_one_follows() -> None:
    normal = (1.0, 1.2)
    orbits = [Orbit(a="1 au", i=i, about="star") for i in ("5 deg", "60 deg")]
    given = Body(**PLANET, orbit=orbits[0], orbit_pole=normal)
    assert given.replace(orbit=orbits[1]).orbit_pole == normal
    derived = EARTH.replace(pole=(0.1, 1.0), orbit=orbits[0])
    ecliptic = EARTH.pole.orbit_normal(None)
    for body, angle in ((derived, 5.0), (derived.replace(orbit=orbits[1]), 60.0)):
        lean = math.degrees(math.acos(body.orbit_pole.vector() @ ecliptic))
        assert lean == pytest.approx(angle, abs=1e-9, rel=0)


def test_moments_and_mass_make_a_body() -> None:
    """Of a brick of 1 x 2 x 3 m and 6 kg: M (b2 + c2)/12 and so on."""
    moments, mass = (2.5, 5.0, 6.5), 6.0
    brick: dict[str, Any] = {"name": "brick", "mass": mass, "radius": 1.5}
    body = Body(**brick, moments=moments)
    assert np.allclose(body.moments, moments, rtol=1e-14, atol=0)
    assert body.mass == pytest.approx(mass, rel=1e-15, abs=0)
    assert body == Body(name="brick", mass=mass, radius=1.5).replace(moments=moments)
    assert Body.read(body.write(), Where("body")) == body
    larger = dataclasses.replace(body, radius=3.0)
    assert (larger.j2, larger.triaxiality) == (body.j2, body.triaxiality)
    with pytest.raises(BodyError, match="already gives j2"):
        Body(**brick, moments=moments, j2=1e-3)
    with pytest.raises(BodyError, match="radius"):
        Body(name="brick", mass=mass, moments=moments)


def test_the_number_of_one_satellite_is_a_key_of_a_scene() -> None:
    """GM of Titan in km3/s2: 8978.1 of JPL; twice the mass doubles the torque of Titan alone."""
    heavy = earthspin.load_scene(
        "precession", {"body": "saturn", "body.satellites.titan.gm": "2e4 km3/s2"}
    )
    gm = {moon.name: moon.gm for moon in heavy.body.satellites}  # type: ignore[attr-defined]
    assert gm == {moon.name: moon.gm for moon in SATURN.satellites} | {"Titan": 2e13}
    table = {"from": "saturn", "satellites": {"Titan": {"a": "1.2e6 km"}, "rhea": {"i": "1 deg"}}}
    again = Body.read(table, Where("body"))
    assert (again.satellites[3].a, again.satellites[2].i) == (1.2e9, math.radians(1))
    for moons, words in (
        ({"titan": {"mass": 1}}, "titan.mass"),
        ({"titania": {"gm": "1 km3/s2"}}, "satellites.titan"),
        ({"titan": 3}, "give a table"),
    ):
        with pytest.raises(SceneError, match=words):
            Body.read({"from": "saturn", "satellites": moons}, Where("body"))


def test_an_unknown_element_of_an_orbit_is_refused() -> None:
    for keyword, words in (("EC", "allowed: .*e, epoch, i"), ("nod", "did you mean 'node'")):
        with pytest.raises(earthspin.ArgumentError, match=words):
            Orbit(a="1 au", **{keyword: 0.1})


def test_whole_turns_are_no_inclination() -> None:
    with pytest.raises(earthspin.SceneError, match="0 to 180 deg"):
        Orbit(a="1 au", i="400 deg")
