"""Orbits, poles, obliquities and satellites that are arrays, or differ from member to member."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import MARS, ApartError, Body, Orbit, Scene
from earthspin.errors import Where

STAR = Body(name="star", gm="1.2e20 m3/s2")
PLANET = Body(
    name="planet",
    gm="4e14 m3/s2",
    radius="6400 km",
    j2=1e-3,
    dynamical_flattening=3e-3,
    spin_period="20 h",
    obliquity="33 deg",
    orbit=Orbit(a="0.9 au", e=0.1, i="5 deg", about="star"),
    satellites=[{"name": "luna", "gm": "9 km3/s2", "a": "30000 km"}],
)
VALUES = {
    "gm": [4e14, 4.1e14, 3.9e14],
    "j2": [1e-3, 1.01e-3, 0.99e-3],
    "orbit.a": [1.3e11, 1.4e11, 1.5e11],
    "orbit.e": [0.0, 0.2, 0.1],
    "orbit.i": [0.1, 0.3, 1.0],
    "obliquity": [0.2, 0.7, 2.0],
    "satellites.luna.gm": [8e9, 9e9, 1e10],
    "satellites.luna.a": [3e7, 3.1e7, 3.2e7],
}
ARRAYS = {name: xr.DataArray(values, dims="case") for name, values in VALUES.items()}


def precession(body: Body, **keys: Any) -> xr.Dataset:
    return earthspin.precession(body=body, **({"perturbers": [STAR]} | keys))


def one(case: int) -> Body:
    return PLANET.replace(**{name: values[case] for name, values in VALUES.items()})


def test_arrays_give_what_a_loop_gives() -> None:
    many = precession(PLANET.replace(**ARRAYS))
    for case in range(3):
        xr.testing.assert_equal(many.isel(case=case), precession(one(case)))


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in VALUES if name not in ("gm", "j2")])
def test_members_of_each_element_are_those_of_a_loop(name: str) -> None:
    inputs = xr.Dataset({f"body.{name}": ("member", VALUES[name])})
    scene = Scene(compute="precession", body=PLANET, perturbers=[STAR])
    many = earthspin.ensemble(scene, inputs)
    for member, value in enumerate(VALUES[name]):
        alone = precession(PLANET.replace(**{name: value}))
        assert np.array_equal(many.precession_rate.isel(member=member), alone.precession_rate)
    assert earthspin.run(many).identical(many)


def test_the_rate_goes_with_the_inverse_cube_of_the_axis() -> None:
    """3/2 GM/a^3 H cos(eps)/omega, source text I.8.7, for circles."""
    planet = PLANET.replace(satellites=[], **{"orbit.e": 0.0})
    a = xr.DataArray([1e11, 2e11], dims="case")
    rate = precession(planet.replace(**{"orbit.a": a})).precession_rate.sel(perturber="total")
    expected = 1.5 * 1.2e20 / a**3 * 3e-3 * np.cos(np.radians(33)) / (2 * np.pi / 72000)
    expected *= 365.25 * 86400 * 180 * 3600 / np.pi
    assert np.allclose(rate, expected, rtol=1e-13, atol=0)


def test_arrays_of_j2_leave_a_flattening_that_was_given() -> None:
    figure = {"j2": ARRAYS["j2"], "dynamical_flattening": 3e-3}
    many = precession(PLANET.replace(**figure, **{"orbit.a": ARRAYS["orbit.a"]}))
    for case, (j2, a) in enumerate(zip(VALUES["j2"], VALUES["orbit.a"], strict=True)):
        body = PLANET.replace(**{"j2": j2, "dynamical_flattening": 3e-3, "orbit.a": a})
        xr.testing.assert_equal(many.isel(case=case), precession(body))


def test_masses_as_arrays_need_no_period() -> None:
    heavy = STAR.replace(gm=xr.DataArray([1.2e20, 1.5e20], dims="case"))
    many = precession(PLANET, perturbers=[heavy])
    for case, gm in enumerate([1.2e20, 1.5e20]):
        alone = precession(PLANET, perturbers=[STAR.replace(gm=gm)])
        xr.testing.assert_equal(many.isel(case=case), alone)


def test_a_kernel_takes_members_of_the_pole_and_the_obliquity() -> None:
    """The obliquity of an axis that was given by declination is the angle of two directions."""
    scene = Scene(compute="precession", body="mars", perturbers="sun", source="jplephem")
    tilted = earthspin.ensemble(scene, {"body.obliquity": {"grid": ["20 deg", "30 deg"]}})
    assert np.allclose(tilted.obliquity, [20.0, 30.0], rtol=0, atol=1e-9)
    members = {"body.pole.declination": {"grid": ["50 deg", "54 deg"]}}
    answer = earthspin.ensemble(scene, members)
    normal = MARS.orbit_pole.vector()
    for dec, obliquity in zip(np.radians([50, 54]), answer.obliquity.values, strict=True):
        axis = replace(MARS.pole, declination=dec).true(0.0)
        assert obliquity == pytest.approx(np.degrees(np.arccos(normal @ axis)), rel=1e-3, abs=0)


def test_a_question_of_single_orbits_refuses_arrays_and_takes_members() -> None:
    keys: dict[str, Any] = {"times": ["2000-01-01", "2001-01-01"], "perturbers": [STAR]}
    body = PLANET.replace(**{"orbit.a": ARRAYS["orbit.a"]})
    with pytest.raises(ApartError, match=r"one orbit, pole and set of satellites.*ensemble"):
        earthspin.torque_series(body=body, **keys)
    scene = Scene(compute="torque", body=PLANET, **keys)
    many = earthspin.ensemble(scene, {"body.orbit.a": {"grid": VALUES["orbit.a"]}})
    alone = earthspin.torque_series(body=PLANET.replace(**{"orbit.a": 1.4e11}), **keys)
    assert np.array_equal(many.torque.isel(member=1), alone.torque)


def test_a_body_of_arrays_is_stored_with_its_arrays() -> None:
    body = PLANET.replace(**ARRAYS)
    assert Body.read(body.write(), Where("body")) == body
    assert set(body.arrays) == {*VALUES, "dynamical_flattening"}
    assert body != PLANET


def test_an_unknown_element_is_refused() -> None:
    with pytest.raises(earthspin.BodyError, match=r"did you mean 'orbit\.e'"):
        PLANET.replace(**{"orbit.ee": 0.1})
    scene = Scene(compute="precession", body=PLANET, perturbers=[STAR])
    with pytest.raises(earthspin.SceneError, match=r"did you mean 'body\.orbit\.e'"):
        earthspin.ensemble(scene, {"body.orbit.ee": {"grid": [0.1]}})
