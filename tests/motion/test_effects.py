"""Each effect against something that does not know its formula."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import eval_legendre

import earthspin
from earthspin import MARS, SUN
from earthspin.bodies import EARTH
from earthspin.constants import DAY
from earthspin.errors import Where
from earthspin.motion.axes import axis_path
from earthspin.motion.effects import geodesic_rate, geodesic_torque
from earthspin.numerics.polynomials import Windows
from earthspin.sky.ephemeris import Ephemeris
from earthspin.torque.gravity import (
    quadrupole_torque,
    tidal_tensor,
    torque_from_position,
    zonal_law,
)
from tests.motion.sky import CODES, GM, NORTH, UAS, figure, forces

directions = st.tuples(st.floats(-1, 1), st.floats(0, 2 * math.pi)).map(
    lambda p: np.array(
        [math.sqrt(1 - p[0] ** 2) * math.cos(p[1]), math.sqrt(1 - p[0] ** 2) * math.sin(p[1]), p[0]]
    )
)


@pytest.mark.parametrize("degree", [2, 3, 4])
@given(place=directions, axis=directions, turn=directions)
def test_zonal_law_is_the_slope_of_the_energy(
    degree: int, place: np.ndarray, axis: np.ndarray, turn: np.ndarray
) -> None:
    """Turn the body a little about any direction: the energy falls by the torque's work."""
    gm, radius, distance = 5e12, 6.4e6, 4e8

    def energy(angle: float) -> float:
        geodesic_torque = axis * math.cos(angle) + np.cross(turn, axis) * math.sin(angle)
        geodesic_torque = geodesic_torque + turn * (turn @ axis) * (1 - math.cos(angle))
        return (
            gm
            / distance**3
            * (radius / distance) ** (degree - 2)
            * eval_legendre(degree, place @ geodesic_torque)
        )

    step = 1e-4
    slope = -(energy(step) - energy(-step)) / (2 * step)
    torque = zonal_law({degree: 1.0}, radius, gm, distance * place[:, None])(axis[:, None])[:, 0]
    scale = gm / distance**3 * (radius / distance) ** (degree - 2)
    assert abs(torque @ turn - slope) < 1e-6 * scale


@given(place=directions, axis=directions)
def test_tensor_form_is_the_vector_form(place: np.ndarray, axis: np.ndarray) -> None:
    position = 4e8 * place
    tensor = tidal_tensor([(5e12, position[:, None]), (2e12, 3 * position[:, None])])
    expected = sum(
        torque_from_position(gm, 1.0, r[None], axis)[0]
        for gm, r in ((5e12, position), (2e12, 3 * position))
    )
    assert np.allclose(quadrupole_torque(tensor, axis[:, None])[:, 0], expected, rtol=0, atol=1e-27)


def test_second_harmonic_is_the_bulge() -> None:
    place, axis = np.array([[3e8], [1e8], [2e8]]), np.array([[0.0], [0.6], [0.8]])
    bulge = quadrupole_torque(tidal_tensor([(5e12, place)]), axis)
    assert np.allclose(zonal_law({2: 1.0}, 6.4e6, 5e12, place)(axis), bulge, rtol=1e-14, atol=0)


def test_geodesic_precession_on_a_kepler_ellipse() -> None:
    """(3/2) GM n / (c2 a (1 - e2)), de Sitter's closed form: 1.9194 arcsec a century."""
    a, e = 1.49598e11, 0.0167
    n = math.sqrt(SUN.gm / a**3)
    anomaly = np.linspace(0, 2 * np.pi, 2001)[:-1]  # eccentric
    x, y = a * (np.cos(anomaly) - e), a * math.sqrt(1 - e * e) * np.sin(anomaly)
    weight = 1 - e * np.cos(anomaly)  # dt/dE times n
    vx = -a * n * np.sin(anomaly) / weight
    vy = a * n * math.sqrt(1 - e * e) * np.cos(anomaly) / weight
    place = {"sun": -np.stack([x, y, 0 * x])}
    rate = geodesic_rate({"sun": SUN.gm}, place, {"sun": -np.stack([vx, vy, 0 * x])}, "sun")
    mean = np.mean(rate[2] * weight)
    closed = 1.5 * SUN.gm * n / (299792458.0**2 * a * (1 - e * e))
    assert abs(mean / closed - 1) < 2e-15
    assert abs(math.degrees(mean) * 3600 * 36525 * DAY - 1.9194) < 2e-4


def test_a_sphere_turns_with_the_geodesic_frame_alone(de421: Ephemeris) -> None:
    span = 365.25 * DAY
    path = axis_path(
        forces(de421, figure(h=0.0), torques=(geodesic_torque,)), NORTH, 0.0, (0.0, span)
    )
    moved = path.at(np.array([span]))["figure"][0] - NORTH
    # 19.19 mas a year about the ecliptic's pole, 23.4 degrees away: towards -x
    assert abs(-moved[0] / UAS - 19194 * math.sin(math.radians(23.44))) < 9


def test_torque_at_a_mean_pole_does_not_hear_of_the_axis(de421: Ephemeris) -> None:
    fixed = forces(
        de421,
        mean_pole=lambda t: np.broadcast_to(NORTH, (t.size, 3)),
        torques=(geodesic_torque,),  # which the angular momentum alone hears of
    )
    windows = Windows(np.array([0.0, 8 * DAY]), 14)
    law, _ = fixed.over(windows)
    here = np.broadcast_to(NORTH[:, None, None], (3, *windows.times.shape))
    there = np.roll(here, 1, axis=0)
    assert np.all(law(here, here).copy() == law(there, here))


def test_rate_of_j2_scales_the_torque(de421: Ephemeris) -> None:
    trend = 1e-12
    windows = Windows(np.array([1e8, 1e8 + 8 * DAY]), 14)
    here = np.broadcast_to(NORTH[:, None, None], (3, *windows.times.shape))
    with_trend, _ = forces(de421, figure(j2_trend=trend)).over(windows)
    without, _ = forces(de421).over(windows)
    grown = with_trend(here, here) / without(here, here) - 1
    assert np.allclose(grown, trend * windows.times, rtol=0, atol=2e-15)  # measured: 3e-16
    assert set(GM) == set(CODES)


def test_an_effect_whose_number_is_not_known_is_left_out_with_its_reason() -> None:
    """No J4 of Mars, Love number of the Earth or core of Mars is among their numbers."""
    span = "2000-01-02", "2000-01-03", "12 h"
    mars = earthspin.pole(*span, body="mars")
    left_out = mars.direction_error.effects_left_out
    assert left_out.startswith("j3 (j3 of Mars is not known), j4 (j4 of Mars is not known)")
    assert "j4" not in mars.attrs["effects"]
    earth = earthspin.rotation(*span).attitude_error.effects_left_out
    assert "tides (k2, tidal_delay of the Earth is not known)" in earth
    for call, keys, words in (
        (earthspin.pole, {"body": "mars", "effects": ["j4"]}, "effects = 'j4': j4 of Mars"),
        (earthspin.rotation, {"effects": ["tides"]}, "'tides': k2 and tidal_delay of the Earth"),
        (earthspin.rotation, {"effects": ["harmonics"]}, "'harmonics': harmonics of the Earth"),
        (
            earthspin.rotation,
            {"body": MARS.replace(core_moment=0.1), "effects": ["fluid-core"]},
            "core_flattening and core_friction of Mars",
        ),
    ):
        with pytest.raises(earthspin.SceneError, match=words):
            call(*span, **keys)  # type: ignore[arg-type]
    # a table of an earlier version holds zeros, which are numbers
    earlier = earthspin.Body.read(MARS.write() | {"k2": 0.0, "j3": 0.0}, Where("body"))
    assert (earlier.k2, earlier.j3, earlier.j4) == (0.0, 0.0, None)


@pytest.mark.parametrize("call", [earthspin.pole, earthspin.rotation])
def test_an_effect_without_its_coefficient_says_that_it_does_nothing(call: Any) -> None:
    def note(**keys: Any) -> str:
        answer = call("2000-01-02", "2000-01-03", "12 h", **keys)
        errors = [v for name, v in answer.variables.items() if str(name).endswith("_error")]
        return " ".join(str(v.attrs.get("effects_that_do_nothing", "")) for v in errors).strip()

    assert note(body=MARS.replace(j3=0.0), effects=["j3"]) == "j3 (j3 of Mars is 0)"
    assert note(body=MARS.replace(j3=3e-5), effects=["j3"]) == ""
    assert note(effects=["j3", "j4", "triaxiality", "j2-rate"]) == ""
    assert note(body=EARTH.replace(triaxiality=0), effects=["triaxiality", "j3"]) == (
        "triaxiality (triaxiality of the Earth is 0)"
    )
