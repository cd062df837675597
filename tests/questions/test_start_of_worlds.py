"""The pole that a motion starts from: which one it is, how well it is known, what errors say."""

import numpy as np
import pytest
import xarray as xr

import earthspin
from data_tools.coverage.worlds import LA2004_RATE, LA2004_START, la2004, like_la2004, vector
from earthspin import BODIES, EARTH, MARS, BodyError
from earthspin.constants import ARCSEC, NORMAL_95
from earthspin.questions.long_term import LongTerm
from earthspin.questions.pole import Pole
from earthspin.sky.poles import MovingPole

#: Pole of Mars at J2000.0 without nutation: IAU 2009 (Archinal et al. 2011), and of Konopliv et al.
#: 2016 (Icarus 274, 253), right ascension and declination, deg.
OTHER_POLES = {"IAU 2009": (317.68143, 52.88650), "Konopliv 2016": (317.68111502, 52.88635278)}


@pytest.fixture(scope="module")
def mars() -> xr.Dataset:
    return earthspin.long_term(times=["1980-01-01", "0 kyr"], body="mars")


@pytest.mark.parametrize(("name", "bound"), [("IAU 2009", 1.0), ("Konopliv 2016", 0.05)])
def test_the_half_width_of_the_start_of_mars_holds_other_poles(
    mars: xr.Dataset, name: str, bound: float
) -> None:
    """Measured: 0.895 and 0.030 arcsec."""
    now = mars.isel(epoch=1)
    off = float(np.linalg.norm(now.pole.values - vector(OTHER_POLES[name]))) / ARCSEC
    assert off < float(now.pole_error) < 1.5
    assert off < bound


def test_mars_starts_without_nutation(mars: xr.Dataset) -> None:
    """The mean obliquity of 1980 by the Viking landers (Yoder & Standish 1997, JGR 102, 4065)."""
    then = mars.isel(epoch=0)
    # 2 sigma of theirs is 0.0001 deg; measured: 8e-6 deg, beside 1.8e-4 with nutation
    assert float(then.obliquity) == pytest.approx(25.1894, rel=0, abs=1e-4)
    # with which La2004 starts, as if it were that of J2000.0
    assert float(then.obliquity) == pytest.approx(LA2004_START, rel=0, abs=5e-5)
    assert la2004()[0] == pytest.approx(LA2004_START, rel=0, abs=1e-7)


def test_two_constants_are_all_that_separates_la2004_from_ours() -> None:
    theirs = like_la2004(LA2004_START, LA2004_RATE)
    assert np.abs(theirs.obliquity.values - la2004()).max() < 2.5e-3  # 1.2e-3 measured
    # as they stand, the two are apart by more than either says
    assert np.abs(like_la2004().obliquity.values - la2004()).max() > 0.5


def test_a_pole_without_an_uncertainty_has_no_error() -> None:
    body = MARS.replace(pole=MARS.pole)
    assert body.pole_uncertainty is None
    tree = earthspin.run_tree(LongTerm(body=body, span=("-20 kyr", "0 kyr"), step="10 kyr"))
    answer = tree.to_dataset()
    for name in ("obliquity", "pole", "psi_A", "precession_rate"):
        error = answer[f"{name}_error"]
        assert np.isnan(error).all(), name
        assert "pole_uncertainty" in error.attrs["no_error"]
    for name in ("eccentricity", "ecliptic_pole"):
        assert np.isfinite(answer[f"{name}_error"]).all(), name
    assert np.isnan(tree["matrices"].matrix_error).all()
    assert "start" not in tree["budget"].cause.values
    assert earthspin.run(answer).identical(answer)


def test_an_uncertainty_that_is_given_is_that_of_the_start() -> None:
    body = MARS.replace(pole=MARS.pole, pole_uncertainty="2 arcsec")
    found = earthspin.long_term(times=["0 kyr"], body=body)
    both = 2 * NORMAL_95 * np.sqrt(2.0)
    assert float(found.pole_error[0]) == pytest.approx(both, rel=1e-6, abs=0)
    with pytest.raises(BodyError, match="zero or more"):
        MARS.replace(pole_uncertainty=-1e-6)


@pytest.mark.parametrize("angle", [0, 45, 90, 135])
def test_the_share_of_the_start_holds_another_start(angle: float) -> None:
    """Moved by 0.89 arcsec in any direction, as far as the pole of IAU 2009 lies."""
    span = {"body": "mars", "span": ("-1 Myr", "1 Myr"), "step": "20 kyr"}
    tree = earthspin.run_tree(LongTerm(**span), ["budget"])
    tilt, turn = 0.89 * np.cos(np.radians(angle)), 0.89 * np.sin(np.radians(angle))
    turn /= np.sin(np.radians(25.19))
    shifts = {"obliquity_shift": f"{tilt} arcsec", "longitude_shift": f"{turn} arcsec"}
    moved = earthspin.run(LongTerm(**span, **shifts))
    share = tree["budget"].sel(cause="start")
    off = np.linalg.norm(tree.pole.values - moved.pole.values, axis=-1) / ARCSEC
    assert np.mean(off <= 1.001 * share.pole_share.values) > 0.95
    off = 3600 * np.abs(tree.obliquity.values - moved.obliquity.values)
    assert np.mean(off <= 1.001 * share.obliquity_share.values) > 0.95


def test_the_flattening_of_mars_is_as_uncertain_as_published() -> None:
    """H of Baland et al. 2020 (BMAN20): 0.00538017 +- 0.00000148."""
    h, share = MARS.number("dynamical_flattening"), MARS.relative_uncertainty
    assert h == pytest.approx(0.00538017, rel=0, abs=1e-8)
    assert h * share["dynamical_flattening"] == pytest.approx(1.48e-6, rel=0.01, abs=0)


def test_saturns_half_width_holds_another_pole() -> None:
    """Jacobson 2007 (BAAS 39, 317) at J2000.0, its terms included; measured: 2.91 arcsec."""
    off = BODIES["saturn"].pole.mean(np.zeros(1))[0] - vector((40.584857, 83.537661))
    half = NORMAL_95 * BODIES["saturn"].pole_uncertainty
    assert 0.9 * half < np.linalg.norm(off) < half


def test_nutation_leaves_a_pole_that_moves() -> None:
    pole = MARS.pole
    slow = pole.without_nutation()
    assert isinstance(slow, MovingPole)
    assert len(slow.right_ascension_swings) == len(slow.declination_swings) == 1
    assert len(pole.right_ascension_swings) == 5
    assert EARTH.pole.without_nutation() is EARTH.pole
    fixed = BODIES["venus"].pole
    assert fixed.without_nutation() is fixed


def test_errors_of_a_motion_say_that_its_start_is_taken_as_exact() -> None:
    span = {"span": ("2000-01-01T12:00", "2000-01-11T12:00"), "step": "5 d"}
    tree = earthspin.run_tree(Pole(body="mars", **span), ["neglected"])
    assert "0.9 arcsec" in tree.direction_error.attrs["start"]
    half = float(tree["neglected"].neglected_effect.sel(effect="start"))
    assert half == pytest.approx(1000 * NORMAL_95 * 0.46, rel=1e-6, abs=0)
    assert "start" not in earthspin.pole(*span["span"], "5 d").direction_error.attrs
    turned = earthspin.rotation(*span["span"], "5 d", body="jupiter", perturbers=["sun"])
    assert "is not known" in turned.attitude_error.attrs["start"]
