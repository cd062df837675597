"""Overlaps, spins above break-up and averages over fast axes are refused in one line."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import minimize_scalar

import earthspin
from earthspin import EARTH, MOON, SUN, Body, EarthspinError, Scene
from earthspin.bodies import checks
from earthspin.bodies.planets import PRECESSING_ORBITS
from earthspin.constants import ARCSEC_PER_YEAR, DAY, G
from earthspin.dates import datetime64
from earthspin.interior.equilibrium import FASTEST

SHORT = {"span": ("2000-01-01", "2000-01-03"), "step": "1 d"}
FAST, SLOW_SPIN = "12 s", "1e5 h"
#: An orbit of the Moon that does not say about what.
LUNAR = {"a": "384399 km", "e": 0.0549, "i": "5.145 deg", "node_period": "-6793.5 d"}


def asked(word: str, **keys: Any) -> Callable[[], object]:
    """A question to be asked."""
    return lambda: earthspin.run(Scene(compute=word, **keys))


def several(first: str, second: str) -> Body:
    """Two Earths in one body."""
    periods = [EARTH.replace(spin_period=period).spin_period for period in (first, second)]
    return EARTH.replace(spin_period=xr.DataArray(periods, dims="case"))


def refused(question: Callable[[], object], words: str) -> None:
    """Check that a question is refused in one line."""
    with pytest.raises(EarthspinError, match=words):
        question()


@pytest.mark.parametrize(
    "word", ["precession", "pole", "rotation", "iau", "nutation", "long-term", "wobble"]
)
def test_a_spin_above_break_up(word: str) -> None:
    refused(asked(word, body=EARTH.replace(spin_period=FAST)), "spin_period")


@pytest.mark.parametrize("word", ["precession", "long-term", "wobble"])
def test_a_spin_above_break_up_among_others(word: str) -> None:
    refused(asked(word, body=several("24 h", FAST)), "spin_period")


def test_a_spin_above_break_up_in_an_ensemble() -> None:
    """Refused with its number, or left out."""
    members = {"body.spin_period": {"grid": ["24 h", FAST]}}

    def ensemble() -> object:
        return earthspin.ensemble("precession", members)

    left = earthspin.ensemble("precession", members, impossible="drop")
    assert left.member.values.tolist() == [0]

    refused(ensemble, "spin_period")


def test_break_up_by_a_start() -> None:
    refused(asked("rotation", start_omega=[0.0, 0.0, 0.5], **SHORT), "spin_period")


def test_what_is_held_together_by_itself_may_spin_faster() -> None:
    """2008 HJ turns once in 42.7 s, far above what its gravity holds; a flywheel is faster."""
    body = Body(
        name="rock", gm=1e-4, radius=12.0, j2=0.05, dynamical_flattening=0.15, spin_period=42.7,
        pole=(0.0, 1.0),
    )  # fmt: skip
    turned = earthspin.rotation("2000-01-01", "2000-01-03", "1 d", body=body, perturbers=[])
    assert float(turned.attitude_error[-1]) < 1e-6


@pytest.mark.parametrize("word", ["precession", "long-term"])
@pytest.mark.parametrize("body", [EARTH.replace(spin_period=SLOW_SPIN), several("24 h", SLOW_SPIN)])
def test_an_axis_too_fast_for_an_average(word: str, body: Body) -> None:
    refused(asked(word, body=body), "slow")


def test_slow_cassini_states_are_refused_too() -> None:
    orbit = {"a": "1 au", "e": 0.01, "i": "1 deg", "node_period": "-25000 yr"}
    body = EARTH.replace(spin_period=SLOW_SPIN)
    refused(asked("cassini-states", body=body, orbit=orbit), "slow")


def test_the_average_is_off_by_about_the_limit_where_it_is_refused() -> None:
    """Against the rotation under the same Sun, averaged over 32 years.

    Measured: 0.39, 2.7 and 3.0 times 1e-3 at 1, 3 and 10 kh, where the share is 0.5 to 5.9e-3.
    """
    sun = SUN.replace(orbit={"a": "1 au", "e": 0.0167, "plane": "icrf"})
    slow = EARTH.replace(
        spin_period="1e4 h", triaxiality=0.0, pole=(0.0, 1.16), orbit_pole=(0.0, np.pi / 2)
    )
    scene = Scene(compute="precession", body=slow, perturbers=[sun])
    tree = earthspin.run_tree(scene, "neglected")
    average = tree.precession_rate[-1]
    days = np.arange(40 * 24 + 1) * 365.2568 / 24
    turned = earthspin.rotation(
        times=datetime64(days), body=slow, perturbers=[sun], effects=["triaxiality"]
    )
    x, y, _ = turned.angular_momentum.values.T
    node = np.unwrap(np.arctan2(y, x))
    taper = np.sin(np.pi * np.arange(193) / 192) ** 4
    first, last = (np.sum(taper * part) / taper.sum() for part in (node[:193], node[-193:]))
    rate = -(last - first) / ((days[-193] - days[0]) * DAY)
    off = abs(rate / (float(average) * ARCSEC_PER_YEAR) - 1)
    assert checks.FASTEST / 10 < off < checks.FASTEST
    # the answer says so, beside an error of rounding
    assert tree.precession_rate_error_method[-1] < 1e-9 * average
    left_out = float(tree["neglected"].neglected_effect.sum() / average)
    assert off < left_out < 10 * off


@pytest.mark.parametrize("word", ["precession", "pole", "rotation", "torque"])
def test_a_perturber_whose_horizon_holds_the_body(word: str) -> None:
    refused(asked(word, perturbers=[SUN, MOON.replace(gm=1e30)]), "lies inside")


@pytest.mark.parametrize("word", ["precession", "rotation", "torque", "pole"])
def test_a_moon_that_overlaps_the_earth(word: str) -> None:
    """The centre is outside the Earth, the surface is not."""
    near = MOON.replace(orbit={"a": "8000 km", "e": 0.0})
    refused(asked(word, perturbers=[near]), "lies inside")


@pytest.mark.parametrize(
    ("orbit", "words"),
    [
        (LUNAR, "about = 'earth'"),
        (LUNAR | {"a": "1000 km", "about": "earth"}, "lies inside"),
        (LUNAR | {"node_period": "-1 h", "about": "earth"}, "slow"),
        (LUNAR | {"about": "erth"}, "'earth'"),
        (LUNAR | {"about": "moon"}, "about"),
    ],
)
def test_cassini_states_of_orbits_that_cannot_be(orbit: dict[str, Any], words: str) -> None:
    refused(asked("cassini-states", orbit=orbit), words)


def test_cassini_states_of_the_moon_about_the_earth() -> None:
    found = earthspin.cassini_states(orbit=LUNAR | {"about": "earth"})
    # 6.69 observed; the ellipse of that size has another month than the Moon
    assert 6 < float(found.obliquity[0]) < 7


@pytest.mark.parametrize("name", list(PRECESSING_ORBITS))
def test_known_locked_bodies_are_not_refused(name: str) -> None:
    if earthspin.BODIES[name].j2 is None:
        pytest.skip("its J2 was never measured")
    assert earthspin.cassini_states(name).sizes["state"] >= 2


@pytest.mark.parametrize("question", ["love-numbers", "body"])
def test_no_equilibrium_at_such_a_spin(question: str) -> None:
    def ask() -> object:
        if question == "body":
            return Body.from_layers("prem", spin_period="1.6 h")
        fast = earthspin.Scene(compute="love-numbers", body=EARTH.replace(spin_period="1.6 h"))
        return earthspin.run_tree(fast, "compliances")

    refused(ask, "equilibrium")
    # above the limit of a homogeneous body there is one
    assert Body.from_layers("prem", spin_period="2.5 h").flattening < 0.5


def test_the_fastest_equilibrium_is_that_of_maclaurin() -> None:
    def slowness(e: float) -> float:
        root = np.sqrt(1 - e * e)
        return float(6 * (1 - e * e) / e**2 - 2 * root / e**3 * (3 - 2 * e * e) * np.arcsin(e))

    fastest = -minimize_scalar(slowness, bounds=(0.5, 0.99), method="bounded").fun
    assert FASTEST.value == pytest.approx(fastest, rel=1e-6, abs=0)


CORNERS = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


def test_coincident_shells() -> None:
    twice = CORNERS + CORNERS, FACES + [[c + 4 for c in (b, a, d)] for d, b, a in FACES]
    turned = CORNERS + CORNERS, FACES + [[c + 4 for c in (b, d, a)] for a, b, d in FACES]
    for mesh in (twice, turned):
        refused(lambda mesh=mesh: Body.from_mesh(mesh, density=1e3), "triangle")
    # two solids that share a wall, each closed by itself, are no such shells
    mirrored = [[x, y, -z] for x, y, z in CORNERS], [face[::-1] for face in FACES]
    both = CORNERS + mirrored[0], FACES + [[c + 4 for c in face] for face in mirrored[1]]
    body = Body.from_mesh(both, density=1e3)
    assert float(body.gm) == pytest.approx(G.value * 1e3 / 3, rel=1e-12, abs=0)


def test_questions_about_one_body_refuse_several() -> None:
    refused(asked("nutation", body=several("24 h", "25 h")), "array")


def test_a_body_itself_may_be_extreme() -> None:
    for period in (FAST, SLOW_SPIN):
        assert EARTH.replace(spin_period=period).spin_rate > 0
    assert MOON.replace(gm=1e30).gm == 1e30
