"""Poles that move: against finite differences, a lunar invariant, and the pole at one date."""

import math

import numpy as np
import pytest

import earthspin
from earthspin import MARS, SUN
from earthspin.bodies.kinds import PoleInText
from earthspin.constants import DAYS_PER_CENTURY
from earthspin.errors import EarthspinError, Where
from earthspin.sky.poles import Direction, MovingPole, pole_of

#: Neptune's, with one slow term.
SLOW = MovingPole.published(
    (299.36, 0.0), (43.46, 0.0), [(0.70, 357.85, 52.316)], [(-0.51, 357.85, 52.316)]
)
EVEN = MovingPole.published((40.589, -0.036), (83.537, -0.004))


def test_as_it_stands_in_print() -> None:
    """alpha_0 + alpha_1 T + a sin(phi + phi' T), by hand for a century on."""
    ra, dec = (math.degrees(angle) for angle in SLOW.at(DAYS_PER_CENTURY))
    phase = math.radians(357.85 + 52.316)
    assert ra == pytest.approx(299.36 + 0.70 * math.sin(phase), rel=0, abs=1e-12)
    assert dec == pytest.approx(43.46 - 0.51 * math.cos(phase), rel=0, abs=1e-12)
    ra, dec = (math.degrees(angle) for angle in EVEN.at(-DAYS_PER_CENTURY))
    assert (ra, dec) == pytest.approx((40.589 + 0.036, 83.537 + 0.004), rel=0, abs=1e-12)


@pytest.mark.parametrize("pole", [SLOW, EVEN])
def test_one_direction_in_every_form(pole: MovingPole) -> None:
    days, orbit = np.array([-20000.0, 0.0, 30000.0]), Direction(4.0, 1.1)
    vectors = pole.mean(days)
    for day, vector, axes in zip(days, vectors, pole.equator(orbit, days), strict=True):
        np.testing.assert_allclose(vector, pole.at(day).vector(), rtol=0, atol=1e-15)
        np.testing.assert_allclose(vector, pole.true(day), rtol=0, atol=0)
        np.testing.assert_allclose(axes, pole.at(day).equator(orbit), rtol=0, atol=1e-15)
    np.testing.assert_allclose(
        pole.orbit_axes(orbit), pole.at(0.0).orbit_axes(orbit), rtol=0, atol=0
    )
    assert not pole.is_upright(orbit)
    assert pole_of(pole) is pole


def test_terms_of_ten_thousand_years_and_longer_are_no_nutation() -> None:
    """Of Neptune's 688 years none stays; of those of Mars (Archinal et al. 2018), one does."""
    assert SLOW.without_nutation() == MovingPole.published((299.36, 0.0), (43.46, 0.0))
    ra = [(0.000068, 198.991226, 19139.4819985), (0.419057, 79.398797, 0.5042615)]
    dec = [(0.000051, 122.433576, 19139.9407476), (1.591274, 166.325722, 0.5042615)]
    mars = MovingPole.published((317.269202, -0.10927547), (54.432516, -0.05827105), ra, dec)
    slow = mars.without_nutation()
    assert slow.right_ascension_swings == mars.right_ascension_swings[1:]
    assert slow.declination_swings == mars.declination_swings[1:]
    for centuries, stays in ((99, 0), (101, 1)):
        term = [(0.1, 20.0, 360 / centuries), (0.1, 20.0, -360 / centuries)]
        pole = MovingPole.published((10.0, 0.0), (80.0, 0.0), term, term).without_nutation()
        assert len(pole.right_ascension_swings) == len(pole.declination_swings) == 2 * stays


def test_an_upright_pole_that_moves_has_an_equator_still() -> None:
    days = np.array([0.0, 10.0])
    axes = EVEN.equator(EVEN.at(0.0), days)
    np.testing.assert_allclose(axes[:, 2], EVEN.mean(days), rtol=0, atol=0)
    assert EVEN.is_upright(EVEN.at(0.0))


def test_a_scene_keeps_it() -> None:
    kind = PoleInText(pole_of)
    assert kind.read(kind.write(SLOW), Where("pole")) == SLOW
    body = MARS.replace(pole=SLOW)
    found = earthspin.torque_series(
        "2000-01-01", "2000-02-01", "10 d", body=body, perturbers=["sun"]
    )
    again = earthspin.run(found)
    assert again.identical(found)
    for table, told in (
        ({"declination": "1 deg"}, "right_ascension"),
        ({"right_ascension": "1 deg", "declination": "91 deg"}, "-90 to 90"),
        ({"right_ascension": "1 deg", "declination": "1 deg", "turn": 1}, "allowed"),
        (
            {"right_ascension": 0, "declination": 0, "declination_swings": [["1 deg"]]},
            "size, phase and rate",
        ),
    ):
        with pytest.raises(EarthspinError, match=told):
            kind.read(table, Where("pole"))


def test_declinations_are_of_date() -> None:
    """At each date they are those from a pole that stands where the moving one then is."""
    sun = SUN.replace(orbit={"a": "30 au"})
    for date, day in (("2000-01-01T12:00", 0.0), ("2200-01-01T12:00", 73049.0)):
        moving, fixed = (
            earthspin.torque_series(
                times=[date], body=MARS.replace(pole=pole), perturbers=[sun]
            ).declination.item()
            for pole in (SLOW, SLOW.at(day))
        )
        assert moving == pytest.approx(fixed, rel=0, abs=1e-12)
    # two centuries turn it by three quarters of a degree
    cosine = float(SLOW.true(73049.0) @ SLOW.true(0.0))
    assert 0.5 < math.degrees(math.acos(cosine)) < 1.1
