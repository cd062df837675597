"""Cassini states as a question: the Moon, Mercury, a free spin, and what is refused."""

import numpy as np
import pytest

import earthspin
from earthspin import Body, Orbit
from tests.refusals import refused

MERCURY = Body(
    name="innermost",
    gm=22031.868551e9,
    radius=2439.7e3,
    j2=5.03216e-5,
    dynamical_flattening=5.03216e-5 / 0.346,
    triaxiality=4 * 0.80389e-5,
    spin_period=58.6462 * 86400.0,
    relative_uncertainty={"dynamical_flattening": 0.014 / 0.346},
)
ROUND_THE_SUN = Orbit(period="87.9693 d", e=0.20563, i="8.533 deg", node_period="-325513 yr")


def test_the_shipped_scene_is_the_moon_in_state_2() -> None:
    found = earthspin.run("cassini-states")
    assert found.state.values.tolist() == [2, 3]
    assert float(found.obliquity.sel(state=2)) == pytest.approx(6.688, rel=0.007, abs=0)
    # 1.543 deg to the ecliptic (Williams et al. 2014, not verified): Cassini's second law
    assert float(found.tilt.sel(state=2)) == pytest.approx(1.543, rel=0, abs=0.035)
    assert found.obliquity.attrs["spin"] == "locked, 1 turns in each orbit"


def test_a_table_of_changes_starts_from_the_moon() -> None:
    """It is the default body of this question; elsewhere this is the Earth."""
    table = {"spin_period": "20 d"}
    changed = earthspin.Scene(compute="cassini-states", body=table).body
    assert changed == earthspin.MOON.replace(spin_period="20 d")
    named = earthspin.Scene(compute="cassini-states", body={"name": "Moon", **table}).body
    assert named.replace(name="moon") == changed
    assert earthspin.Scene(compute="wobble", body=table).body.known_as == "earth"
    for other in ("luna", "Earth"):
        with pytest.raises(earthspin.SceneError, match="from = 'nothing'"):
            earthspin.Scene(compute="cassini-states", body={"name": other, **table})


def test_mercury_by_its_name_has_its_mean_orbit() -> None:
    """Its orbit is of another source (Yseboodt & Margot 2006) than that of the test below."""
    found = earthspin.cassini_states("mercury")
    assert float(found.obliquity.sel(state=1)) * 60 == pytest.approx(2.04, rel=0, abs=0.02)


def test_mercury_is_two_arcminutes_from_its_orbit_with_an_error_that_holds_what_is_observed() -> (
    None
):
    """2.04 +- 0.08 arcmin (Margot et al. 2012), from which C/(M R2) comes with its 0.014."""
    found = earthspin.cassini_states(MERCURY, ROUND_THE_SUN)
    first = found.sel(state=1)
    assert float(first.obliquity) * 60 == pytest.approx(2.04, rel=0, abs=0.02)
    assert float(first.obliquity_error) * 60 == pytest.approx(1.96 * 0.08, rel=0.1, abs=0)
    assert not first.towards_pole
    assert found.stable.values.tolist() == [True, True, True, False]
    assert "locked, 1.5" in found.obliquity.attrs["spin"]


def test_half_the_long_axis_gives_the_period() -> None:
    by_period = earthspin.cassini_states(MERCURY, ROUND_THE_SUN)
    by_axis = earthspin.cassini_states(
        MERCURY, Orbit(a="57.909e6 km", e=0.20563, i="8.533 deg", node_period="-325513 yr")
    )
    assert np.allclose(by_axis.obliquity, by_period.obliquity, rtol=1e-4, atol=0)


def test_a_spin_beside_a_lock_is_free() -> None:
    free = earthspin.cassini_states(MERCURY.replace(spin_period="58 d"), ROUND_THE_SUN)
    locked = earthspin.cassini_states(MERCURY, ROUND_THE_SUN)
    assert free.obliquity.attrs["spin"].startswith("free, 1.5167")
    # without the pull on the long axis the torque is less, and the tilt more
    assert float(free.obliquity[0]) > 1.2 * float(locked.obliquity[0])


test_what_has_no_states_is_refused_in_one_line = refused(
    (MERCURY, None, "give the elements of its orbit"),
    (MERCURY, Orbit(period="88 d", i="8 deg"), "period of its node"),
    (MERCURY, Orbit(period="88 d", node_period="-1 Myr"), "an inclination"),
    (Body(name="x", gm=1e12), ROUND_THE_SUN, "spin_period"),
    (MERCURY, {"period": "88 d", "tilt": 3}, "tilt"),
    call=earthspin.cassini_states,
)
