"""Accuracy on request: kept, affordable, and refused only where it cannot be had."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import earthspin
from earthspin import AccuracyError, Scene, load_scene
from earthspin.choosing.choice import Choice, cheapest
from earthspin.choosing.nutation import NutationNodes, nutation_choices
from earthspin.choosing.windows import PoleWindows, window_choices
from earthspin.constants import ARCSEC, DAY, JULIAN_YEAR
from earthspin.motion.forces import Figure
from earthspin.questions.pole import Pole
from earthspin.scenes import chosen
from earthspin.sky.iau import ecliptic_pole
from tests.choosing.accuracy import KINDS, outcomes, summary, true_axes

#: Scenes of each kind, 360 in all.
SCENES = 120


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_random_scenes_get_what_they_ask_for_at_a_fair_price(kind: str) -> None:
    found = list(outcomes(kind, SCENES))
    told = summary(found)
    assert told["refused"] == 0, [o for o in found if o.cheapest is None]
    for outcome in found:
        assert outcome.claimed <= outcome.asked * (1 + 1e-9), outcome
    # Measured over 120 scenes a kind: all within; at most 0.87 of what was asked.
    assert told["within"] >= 0.99
    assert told["worst"] <= 3
    assert told["median cost"] <= 2
    assert told["95 % cost"] <= 4
    asked = np.log10([outcome.asked for outcome in found])
    assert np.ptp(asked) > {"pole": 8.5, "precession": 5, "torque": 4}[kind]


def _pole(accuracy: str | None, **changes: Any) -> Pole:
    settings: dict[str, Any] = {"span": ("1995-01-01", "2010-01-01"), "step": "30 d"}
    return Pole(accuracy=accuracy, **(settings | changes))


@pytest.mark.parametrize("body", ["earth", "mars"])
def test_the_floor_of_the_pole_is_the_error_without_a_request(body: str) -> None:
    pulls = ("sun", "moon") if body == "earth" else ("sun",)
    plain = earthspin.run(_pole(None, body=body, perturbers=pulls))
    assert "method_chosen" not in plain
    floor = float(plain.direction_error.max())  # that of H
    just = earthspin.run(_pole(f"{1.01 * floor} arcsec", body=body, perturbers=pulls))
    assert float(just.direction_error.max()) <= 1.01 * floor
    assert float(just.error_asked) == pytest.approx(1.01 * floor, rel=1e-12, abs=0)
    assert float(just.error_estimated) == float(just.direction_error.max())
    with pytest.raises(AccuracyError, match="best there is") as refused:
        earthspin.run(_pole(f"{0.9 * floor} arcsec", body=body, perturbers=pulls))
    assert refused.value.best == pytest.approx(floor * 1e3, rel=1e-3, abs=0)
    assert refused.value.unit == "mas"


def test_a_body_known_exactly_has_the_floor_of_its_sky() -> None:
    exact = earthspin.EARTH.replace(j2=1.08e-3, dynamical_flattening=3.27e-3)
    with pytest.raises(AccuracyError) as refused:
        earthspin.run(_pole("1e-9 mas", body=exact))
    floor = refused.value.best
    plain = earthspin.run(_pole(None, body=exact))
    assert floor == pytest.approx(float(plain.direction_error_kernel.max()) * 1e3, rel=1e-3, abs=0)
    assert floor < float(plain.direction_error.max()) * 1e3
    just = earthspin.run(_pole(f"{1.02 * floor} mas", body=exact))
    assert float(just.direction_error.max()) * 1e3 == pytest.approx(floor, rel=1e-12, abs=0)


def test_a_rate_just_above_the_floor_is_given() -> None:
    plain = earthspin.run(Scene(compute="precession"))
    total = plain.isel(perturber=-1)
    floor = float(total.precession_rate_error / total.precession_rate)
    just = earthspin.run(Scene(compute="precession", accuracy=1.01 * floor))
    assert float(just.error_estimated) <= 1.01 * floor
    with pytest.raises(AccuracyError):
        earthspin.run(Scene(compute="precession", accuracy=0.9 * floor))


def test_less_is_asked_more_cheaply() -> None:
    costs = [
        int(earthspin.run(_pole(a)).evaluations)
        for a in ("1 mas", "30 mas", "1 arcsec", "30 arcsec")
    ]
    assert costs == sorted(costs, reverse=True)
    assert costs[0] > 20 * costs[-1]


def test_a_loose_request_leaves_nutation_out() -> None:
    settings: dict[str, Any] = {"compute": "torque", "equator": "true"}
    loose = earthspin.run(Scene(**settings, accuracy="25 arcsec"))
    mean = earthspin.run(Scene(compute="torque", equator="mean"))
    assert "mean equator" in str(loose.method_chosen.values)
    assert np.array_equal(loose.declination, mean.declination)
    # and says so in its errors
    assert float(loose.direction_error.min()) > 17


def test_a_series_finer_than_the_kernel_is_refused() -> None:
    with pytest.raises(AccuracyError, match="kernel") as refused:
        earthspin.torque_series("2000-01-01", "2000-02-01", "1 d", equator="true", accuracy="1 mas")
    assert refused.value.best == pytest.approx(7.2, rel=1e-12, abs=0)


def test_where_the_sky_was_not_measured_the_finest_settings_stand() -> None:
    with_neptune = _pole("1 arcsec", body="mars", perturbers=["sun"])
    assert "16 nodes" not in chosen(with_neptune)[0]
    other = earthspin.MOON.replace(name="other", naif=(301,), gm=4.9e12)
    scene = _pole("1 arcsec", body="mars", perturbers=["sun", other], effects=[])
    assert chosen(scene) == ["the finest settings"]
    assert "14 nodes" in str(earthspin.run(scene).method_chosen.values)


def test_the_plan_names_the_choice() -> None:
    assert chosen(_pole(None)) == []
    assert "Gauss windows" in chosen(_pole("1 mas"))[0]


def test_a_slow_spin_falls_back_to_windows_that_carry_its_slow_manifold() -> None:
    known = {"j2": 2e-3, "dynamical_flattening": 5e-3}
    slow = earthspin.MARS.replace(spin_period=1.9 * 86400, **known)
    result = earthspin.run(_pole("1 mas", body=slow, perturbers=["sun"], effects=[]))
    assert float(result.direction_error.max()) <= 1e-3


def test_errors_of_windows_fall_to_the_floor_and_grow_with_the_span() -> None:
    earth = earthspin.EARTH
    figure = Figure(h=earth.dynamical_flattening, spin_rate=earth.spin_rate)
    pulls = {10: earthspin.SUN.gm, 301: earthspin.MOON.gm}
    near, far, beyond = (
        {
            choice.words: choice.error
            for choice in window_choices(earth.naif[0], figure, pulls, (0.0, years * JULIAN_YEAR))
        }
        for years in (1, 30, 300)
    )
    assert all(near[words] <= far[words] <= beyond[words] for words in near)
    assert min(far.values()) < 0.01e-6 * ARCSEC < 1 * ARCSEC < max(far.values())


@pytest.mark.parametrize("scene", ["free-rotor", "top-cusp", "spheroid"])
def test_a_closed_form_keeps_what_it_states_and_refuses_less(scene: str) -> None:
    floor = float(earthspin.run(load_scene(scene, {"accuracy": 1e-3})).error_estimated)
    assert 1e-14 < floor < 1e-11
    just = earthspin.run(load_scene(scene, {"accuracy": floor}))
    assert float(just.error_asked) == pytest.approx(floor, rel=1e-13, abs=0)
    assert int(just.evaluations) > 1
    with pytest.raises(AccuracyError) as refused:
        earthspin.run(load_scene(scene, {"accuracy": 0.9 * floor}))
    assert refused.value.best == floor


def test_many_bodies_at_once_are_refused_in_one_line() -> None:
    import xarray as xr

    many = xr.DataArray([3.2e-3, 3.3e-3], dims="trial")
    body = earthspin.EARTH.replace(j2=many * 0.33, dynamical_flattening=many)
    with pytest.raises(earthspin.BodyError, match="one body at a time"):
        earthspin.run(_pole("1 mas", body=body))


def test_the_cheapest_of_the_good_is_chosen() -> None:
    menu = [
        Choice("dear", PoleWindows(8 * DAY, 14), 1e-9, 900),
        Choice("cheap", PoleWindows(32 * DAY, 8), 1e-6, 30),
        Choice("cheap and better", PoleWindows(16 * DAY, 4), 1e-7, 30),
        Choice("bad", PoleWindows(64 * DAY, 2), 1e-3, 3),
    ]
    assert cheapest(menu, 1e-5) is menu[2]
    assert cheapest(menu, 1e-8) is menu[0]
    assert cheapest(menu, 1e-10) is None


def test_nutation_at_few_epochs_costs_no_more_than_those_epochs() -> None:
    costs = {choice.evaluations for choice in nutation_choices(0.0, 36525.0, 2)}
    assert costs == {0, 2 * 77, 2 * 1365}


# --- scenes that once broke the promise ----------------------------------------------------------


def _kept(scene: Pole) -> None:
    """Hold a scene's pole against windows of 4 d with 16 nodes."""
    result = earthspin.run(scene)
    asked = float(result.error_asked)
    assert asked == pytest.approx(scene.accuracy / ARCSEC, rel=1e-13, abs=0)
    found = np.stack([result[c].transpose("time", "axis").values for c in "XYZ"], axis=-1)
    off = np.linalg.norm(found - true_axes(scene, 4 * DAY, 16), axis=-1).max() / ARCSEC
    assert off <= float(result.error_estimated) <= asked


def _light(h: float, **changes: Any) -> earthspin.Body:
    return earthspin.EARTH.replace(j2=0.33 * h, dynamical_flattening=h, **changes)


def test_two_perturbers_that_a_kernel_knows_as_one() -> None:
    heavy = replace(earthspin.MOON, name="heavy", gm=1000 * earthspin.MOON.gm)
    settings: dict[str, Any] = {"body": _light(3e-3), "effects": ["second-order"]}
    _kept(_pole("1e6 uarcsec", perturbers=[heavy, "moon"], **settings))


@pytest.mark.parametrize("asked", [2.0, 20.0])
def test_a_triaxial_body_that_spins_slowly(asked: float) -> None:
    body = _light(1e-4, spin_period=1.9 * 86400, triaxiality=3.3e-3)
    _kept(
        _pole(
            f"{asked} uarcsec",
            body=body,
            effects=["triaxiality", "second-order"],
            span=("1999-01-01", "2001-01-01"),
        )
    )


def test_zonal_coefficients_beyond_j2() -> None:
    body = replace(_light(1e-9), j3=earthspin.EARTH.j3, j4=earthspin.EARTH.j4)
    _kept(_pole("300 uarcsec", body=body, effects=["j3", "j4", "second-order"]))


def test_geodesic_precession_about_a_heavy_sun() -> None:
    sun = replace(earthspin.SUN, gm=1000 * earthspin.SUN.gm)
    settings: dict[str, Any] = {"perturbers": [sun], "effects": ["geodesic", "second-order"]}
    _kept(_pole("10 uarcsec", body=_light(1e-6), **settings))


def test_the_frame_of_a_fixed_pole_does_not_follow_the_equinox() -> None:
    normal = ecliptic_pole()
    orbit = float(np.arctan2(normal[1], normal[0])) % (2 * np.pi), float(np.arcsin(normal[2]))
    body = earthspin.EARTH.replace(pole=(0.3, 1.2), orbit_pole=orbit)
    scene = Scene(compute="precession", body=body, perturbers=["moon"], accuracy=1e-3)
    assert chosen(scene) == ["the finest settings"]


def test_the_short_series_of_nutation_is_for_our_time() -> None:
    settings = [choice.settings for choice in nutation_choices(230_000.0, 231_000.0, 999)]
    assert settings[0] is None
    assert {s.model for s in settings if isinstance(s, NutationNodes)} == {"2000A"}


@pytest.mark.parametrize("year", [2001, 2004, 2007, 2016])
def test_the_best_that_a_refusal_names_can_be_had(year: int) -> None:
    with pytest.raises(AccuracyError) as refused:
        earthspin.pole("1990-01-01", f"{year}-01-01", "30 d", accuracy="0.001 uarcsec")
    best = str(refused.value).split("best there is here is ")[1].split(";")[0]
    result = earthspin.pole("1990-01-01", f"{year}-01-01", "30 d", accuracy=best)
    assert float(result.error_estimated) / 1e3 <= float(best.split()[0])


def test_a_rate_of_nothing_has_no_relative_error() -> None:
    body = earthspin.EARTH.replace(j2=0.0, dynamical_flattening=0.0)
    with pytest.raises(earthspin.UndefinedError, match="no relative error"):
        earthspin.precession(body=body, accuracy=1e-3)


def test_calls_of_closed_forms_take_an_accuracy() -> None:
    rotor = earthspin.free_rotor([1, 2, 3], [0.1, 1, 0.1], [0, 1], accuracy=1e-9)
    top = earthspin.heavy_top(
        [0.0, 1.0],
        transverse_moment="2e-4 kg m2",
        axial_moment="3e-4 kg m2",
        weight_moment="0.04 N m",
        theta="30 deg",
        spin="200 rad/s",
        accuracy=1e-9,
    )
    field = earthspin.spheroid_field([[7e6, 0, 0]], accuracy=1e-9)
    assert [float(ds.error_asked) for ds in (rotor, top, field)] == [1e-9] * 3
