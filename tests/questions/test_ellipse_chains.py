"""Questions whose bodies are placed by elements: no kernel, exact means, clear refusals."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, MOON, SUN, Body, BodyError, Orbit, Scene, SceneError, UndefinedError
from earthspin.bodies.planets import MEAN_MOON, MEAN_SUN
from earthspin.constants import ARCSEC_PER_YEAR, DAY
from tests.refusals import refused

BOTH = [MEAN_SUN, MEAN_MOON]
#: A star and a planet that leans by 30 degrees, on the axes of the ICRF.
STAR = Body(name="star", gm=1.2e20)
PLANET = Body(
    name="planet",
    gm=4e15,
    radius=1e7,
    j2=1e-3,
    dynamical_flattening=3e-3,
    spin_period=20 * 3600.0,
    pole=(0.0, math.radians(60)),
    orbit={"period": "40 d", "e": 0.2, "plane": "icrf"},
)


@pytest.fixture
def no_kernel(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing opens a kernel."""

    def refuse(kernel: object) -> None:
        raise AssertionError(f"{kernel} was opened")

    monkeypatch.setattr("earthspin.sky.ephemeris.open_ephemeris", refuse)


@pytest.mark.usefixtures("no_kernel")
@pytest.mark.parametrize(
    "scene",
    [
        {"compute": "precession"},
        {"compute": "torque", "step": "30 d"},
        {"compute": "pole", "span": ["2000-01-01", "2000-03-01"], "step": "10 d"},
        {"compute": "long-term", "span": ["-10 kyr", "0 kyr"]},
    ],
    ids=lambda scene: " ".join(map(str, scene.values()))[:20],
)
def test_every_question_goes_without_a_kernel(scene: dict) -> None:
    question = Scene(perturbers=BOTH, **scene)
    assert "de421" not in str(earthspin.plan(question, "all"))
    tree = earthspin.run_tree(question, "all")
    found = tree.to_dataset()
    assert all(np.isfinite(of).all() for of in found.data_vars.values() if of.dtype.kind == "f")
    assert "ephemeris_sha256" not in found.attrs
    again = earthspin.run(found)
    xr.testing.assert_identical(again, found)


def test_the_lunar_rate_but_for_what_an_ellipse_leaves_out() -> None:
    """Beside the kernel: the Sun -2.0e-6, the Moon -2.8e-3 (evection, variation)."""
    kernel = earthspin.precession().precession_rate
    found = earthspin.precession(perturbers=BOTH).precession_rate
    sun, moon, _ = (found / kernel - 1).values
    assert sun == pytest.approx(-1.96e-6, rel=0, abs=1e-7)
    assert moon == pytest.approx(-2.776e-3, rel=0, abs=2e-6)


def test_mean_places_are_those_of_the_kernel() -> None:
    """On average 0.003 and -0.004 deg apart in right ascension; the Moon 2.6 at most (evection)."""
    span = ("2000-01-01", "2019-01-01", "10 d")
    ours = earthspin.torque_series(*span, perturbers=BOTH).right_ascension
    apart = (ours - earthspin.torque_series(*span).right_ascension + 180) % 360 - 180
    np.testing.assert_allclose(apart.mean("time"), 0, rtol=0, atol=0.1)
    assert abs(apart).max() < 3


def test_exact_means_are_those_of_windows() -> None:
    """With the Sun from the kernel the Moon's ellipse is sampled; measured apart: 5.6e-9.

    Windows are whole turns of the node from the equinox, which comes after it; the node among the
    stars is five days faster, and windows of such turns would leave 5.6e-7.
    """
    exact = earthspin.precession(perturbers=BOTH).precession_rate.sel(perturber="moon")
    sampled = earthspin.precession(perturbers=["sun", MEAN_MOON])
    np.testing.assert_allclose(
        sampled.precession_rate.sel(perturber="moon"), exact, rtol=2e-8, atol=0
    )
    assert np.isnan(sampled.precession_rate_error.sel(perturber="moon"))
    assert "not measured" in str(sampled.precession_rate_error.attrs)


def defining(body: Body) -> Body:
    """The same elements, taken as the definition of the orbit."""
    mean = body.needed("orbit")
    names = "direction_error", "direction_drift", "distance_error", "distance_drift", "rate_error"
    return body.replace(orbit=replace(mean, **dict.fromkeys(names)))


def test_an_error_at_rounding() -> None:
    found = earthspin.precession(perturbers=[defining(body) for body in BOTH])
    share = found.precession_rate_error_method / found.precession_rate
    assert float(share.max()) < 2e-14
    # H and GM are what is left
    assert float((found.precession_rate_error / found.precession_rate).max()) > 1e-7


def test_mean_orbits_of_sun_and_moon_contain_the_rates_by_a_kernel() -> None:
    """The ellipse of the Moon lacks evection and variation: 2.78e-3 of its rate."""
    by_elements = earthspin.precession(perturbers=BOTH)
    by_kernel = earthspin.precession()
    apart = abs(by_elements.precession_rate - by_kernel.precession_rate)
    share = (apart / by_elements.precession_rate_error).sel(perturber=["moon", "total"])
    assert float(share.max()) < 1
    assert float(share.min()) > 0.9


@pytest.mark.usefixtures("no_kernel")
def test_a_made_up_world() -> None:
    """Closed form of a planet about its star, from its own orbit; the plane gives the obliquity."""
    found = earthspin.precession(body=PLANET, perturbers=[STAR])
    assert float(found.obliquity) == pytest.approx(30, rel=1e-14, abs=0)
    a = math.cbrt((1.2e20 + 4e15) * (40 * DAY / (2 * math.pi)) ** 2)
    torque = 1.5 * 1.2e20 / a**3 * math.cos(math.radians(30)) * (1 - 0.04) ** -1.5
    rate = 3e-3 * 20 * 3600 / (2 * math.pi) * torque / ARCSEC_PER_YEAR
    assert float(found.precession_rate[0]) == pytest.approx(rate, rel=1e-13, abs=0)
    # the star on its apparent orbit is the same
    apparent = STAR.replace(orbit=Orbit(period="40 d", e=0.2, pericentre="180 deg", plane="icrf"))
    flat = PLANET.replace(orbit=None)
    other = earthspin.precession(body=flat, perturbers=[apparent])
    np.testing.assert_allclose(other.precession_rate, found.precession_rate, rtol=1e-13, atol=0)
    # and so is the place of the star: half a turn from where the star sees the planet
    span = ("2000-01-01", "2000-03-01", "1 d")
    seen = earthspin.torque_series(*span, body=PLANET, perturbers=[STAR])
    given = earthspin.torque_series(*span, body=flat, perturbers=[apparent])
    np.testing.assert_allclose(given.distance, seen.distance, rtol=1e-12, atol=0)
    np.testing.assert_allclose(given.right_ascension, seen.right_ascension, rtol=0, atol=1e-10)


def test_a_moon_of_a_moon_is_averaged_over_windows() -> None:
    """Two ellipses after one another have no closed mean: the plan shows windows."""
    far = Body(name="giant", gm=1e17, orbit={"a": "0.5 au", "about": "star"})
    question = Scene(compute="precession", body=PLANET, perturbers=[STAR, far])
    assert "window-means" in [one.title for one in earthspin.plan(question).parts]
    rates = earthspin.run(question).precession_rate
    alone = earthspin.precession(body=PLANET, perturbers=[STAR]).precession_rate
    assert float(rates.sel(perturber="star")) == pytest.approx(float(alone[0]), rel=1e-6, abs=0)
    # GM/b^3 of a ring at 0.5 au that is seen from 0.21 au
    assert 0 < float(rates.sel(perturber="giant") / rates.sel(perturber="star")) < 1e-3


def test_a_scene_file(tmp_path: Path) -> None:
    file = tmp_path / "moon.toml"
    file.write_text(
        """
        compute = "precession"
        perturbers = [
          { from = "sun", orbit = { a = "1 au", e = 0.0167 } },
          { from = "moon", gm = "4902.8 km3/s2", orbit = { a = "384399 km", e = 0.0549, \
i = "5.145 deg", node_period = "-6793.5 d", epoch = "2000-01-01T12:00" } },
        ]
        """,
        encoding="utf-8",
    )
    scene = earthspin.load_scene(file)
    moon = scene.perturbers[1].orbit
    assert moon == Orbit(a=384399e3, e=0.0549, i=math.radians(5.145), node_period=-6793.5 * DAY)
    written = tomllib.loads(earthspin.run(scene).attrs["scene"])
    assert Orbit(**written["perturbers"][1]["orbit"]) == moon


test_elements_that_cannot_be = refused(
    ({"a": "384399 km", "period": "29 d"}, "contradict each other"),
    ({"a": "384399 km", "e": 1.0}, "must be an ellipse"),
    ({"a": "384399 km", "e": math.nan}, "finite"),
    ({"a": "384399 km", "e": -0.1}, "must be an ellipse"),
    ({"a": "7000 km", "e": 0.5}, "lies inside 'earth'"),
    ({"a": "-1 km"}, "greater than zero"),
    ({"period": "1e31 s"}, "at most"),
    ({"e": 0.1}, "give a or period"),
    ({"a": "384399 km", "node_period": "0 d"}, "not zero"),
    ({"a": "384399 km", "about": "vulcan"}, "allowed: earth, sun"),
    ({"a": "384399 km", "about": "moon"}, "allowed: earth, sun"),
    ({"a": "384399 km", "plane": "galaxy"}, "allowed: ecliptic, equator, icrf, orbit"),
    ({"a": "384399 km", "nodes": 1.0}, "did you mean 'node'"),
    ({"a": "384399 km", "i": "190 deg"}, "0 to 180 deg"),
    ({"a": [1.0, 2.0]}, "one number"),
    call=lambda elements: earthspin.precession(perturbers=[MEAN_SUN, MOON.replace(orbit=elements)]),
)


def test_orbits_that_do_not_fit_together() -> None:
    with pytest.raises(SceneError, match="orbit one another"):
        earthspin.precession(
            perturbers=[
                SUN.replace(orbit={"a": "1 au", "about": "moon"}),
                MOON.replace(orbit={"a": "1 au", "about": "sun"}),
            ]
        )
    with pytest.raises(SceneError, match="give one of"):
        earthspin.precession(body=EARTH.replace(orbit={"a": "1 au"}))
    with pytest.raises(BodyError, match="position places it"):
        MOON.replace(
            orbit={"a": "1 au"}, position=[{"kernel": "de421", "centre": 3, "target": 301}]
        )
    with pytest.raises(BodyError, match="its reference plane"):
        PLANET.replace(orbit={"period": "40 d", "plane": "orbit"})
    with pytest.raises(SceneError, match="planets"):
        earthspin.pole("2000-01-01", "2000-02-01", "1 d", perturbers=BOTH, effects=["planets"])
    with pytest.raises(SceneError, match="error of its positions"):
        earthspin.compare_iau(perturbers=BOTH)


@pytest.mark.parametrize("turns", [1.0, 1.5, 2.0])
def test_a_locked_spin_is_refused(turns: float) -> None:
    locked = PLANET.replace(spin_period=40 * DAY / turns)
    with pytest.raises(UndefinedError, match=f"{turns:g} rotation"):
        earthspin.precession(body=locked, perturbers=[STAR])
    # turning the other way it is not
    back = PLANET.replace(spin_period=-40 * DAY / turns)
    assert float(earthspin.precession(body=back, perturbers=[STAR]).precession_rate[0]) < 0


def test_a_new_orbit_brings_its_plane() -> None:
    leaning = PLANET.replace(orbit={"period": "40 d", "plane": "icrf", "i": "20 deg"})
    assert leaning.orbit_pole != PLANET.orbit_pole
    kept = PLANET.replace(orbit={"period": "40 d"}, orbit_pole=PLANET.orbit_pole)
    assert kept.orbit_pole == PLANET.orbit_pole


def test_many_worlds_about_one_star() -> None:
    """Labelled arrays go through exact means: the rate is in proportion to the spin period."""
    spins = xr.DataArray([0.5 * DAY, 1.0 * DAY, 2.0 * DAY], dims="day")
    many = earthspin.precession(body=PLANET.replace(spin_period=spins), perturbers=[STAR])
    rate = many.precession_rate.isel(perturber=0)
    np.testing.assert_allclose(rate / rate[0], spins / spins[0], rtol=1e-15, atol=0)
