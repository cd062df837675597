"""The question of millennia to millions of years: its answer, its errors, and what it refuses."""

from pathlib import Path

import erfa
import numpy as np
import pytest
import xarray as xr
from astropy import units as u

import earthspin
from earthspin import EARTH, SUN, CoverageError, EarthspinError, SceneError, UndefinedError
from earthspin.constants import ARCSEC, J2000_JD, PUBLISHED_EFFECTS
from earthspin.questions.long_term import LongTerm
from earthspin.sky.orbit_table import shipped
from tests import shipped as scenes
from tests.refusals import refused

#: Rows of the file of La2004: kyr, obliquity (rad), e sin(perihelion).
LA2004 = {
    -1000: (0.4123891471500025, -0.033760490135305736),
    -200: (0.4037251011418818, -0.03833572638169867),
    -100: (0.4130265591582125, -0.0006501053038830341),
    0: (0.4090928042223415, 0.01627964595166013),
}
ANGLES = ("obliquity", "longitude_of_perihelion", "general_precession", "psi_A", "omega_A")
NUMBERS = ("eccentricity", "climatic_precession", "coprecession")


@pytest.fixture(scope="module")
def million() -> xr.Dataset:
    return scenes.answer("long-term")


def test_both_ends_and_every_step(million: xr.Dataset) -> None:
    assert million.epoch.values.tolist() == [1000.0 * k for k in range(-1000, 1)]
    assert million.epoch.attrs["units"] == "yr"
    for name in (*ANGLES, *NUMBERS):
        assert million[name].dims == ("epoch",)
        assert million[f"{name}_error"].dims == ("epoch",)
    for name in ("pole", "ecliptic_pole"):
        assert million[name].dims == ("epoch", "component")
        assert million[f"{name}_error"].attrs["units"] == "arcsec"
    for name in ("precession_rate", "precession_period"):
        assert million[name].dims == ("perturber", "epoch")
    assert million.perturber.values.tolist() == ["sun", "moon", "total"]
    assert {million[name].attrs["units"] for name in ANGLES} == {"deg"}


def test_an_end_that_the_step_misses_is_left_out() -> None:
    found = earthspin.long_term("-10 kyr", "0 kyr", "3 kyr")
    assert found.epoch.values.tolist() == [-10_000.0, -7000.0, -4000.0, -1000.0]


@pytest.mark.parametrize("kyr", LA2004)
def test_la2004_lies_within_a_few_errors(million: xr.Dataset, kyr: int) -> None:
    at = million.sel(epoch=1000.0 * kyr)
    obliquity, precession = LA2004[kyr]
    # 29 arcsec at a million years, 0.15 today, where La2004 starts from another obliquity
    off = abs(float(np.radians(at.obliquity)) - obliquity) / ARCSEC
    assert off < max(1.5 * 29 * abs(kyr / 1000), 3.0 if kyr else 0.3)
    assert off < 2 * float(at.obliquity_error) * 3600 + 0.3
    assert abs(float(at.climatic_precession) - precession) < 2.5e-4


def test_what_is_told_twice_is_the_same(million: xr.Dataset) -> None:
    e, w = million.eccentricity, np.radians(million.longitude_of_perihelion)
    assert np.allclose(e * np.sin(w), million.climatic_precession, rtol=0, atol=1e-14)
    assert np.allclose(e * np.cos(w), million.coprecession, rtol=0, atol=1e-14)
    cosine = (million.pole * million.ecliptic_pole).sum("component")
    assert np.allclose(cosine, np.cos(np.radians(million.obliquity)), rtol=0, atol=1e-14)
    for name in ("pole", "ecliptic_pole"):
        assert np.allclose((million[name] ** 2).sum("component"), 1, rtol=0, atol=1e-14)
    rate, period = million.precession_rate, million.precession_period
    assert np.allclose(np.abs(rate * period), 1_296_000.0, rtol=1e-12, atol=0)


def test_longitudes_go_on_without_jumps(million: xr.Dataset) -> None:
    """Perihelion moves by 360 degrees in some 21,000 years, precession in 25,700."""
    for name in ("longitude_of_perihelion", "general_precession", "psi_A"):
        assert float(np.abs(np.diff(million[name])).max()) < 60, name
    assert float(million.general_precession.isel(epoch=0)) == pytest.approx(
        -360 * 1e6 / 25_700, rel=0.01, abs=0
    )
    assert 0 <= float(million.longitude_of_perihelion.isel(epoch=-1)) < 360
    assert float(million.psi_A.isel(epoch=-1)) == pytest.approx(0.0, rel=0, abs=1e-9)
    assert float(million.omega_A.isel(epoch=-1)) == pytest.approx(84381.406 / 3600, rel=0, abs=3e-8)


def test_a_step_does_not_change_what_is_between(million: xr.Dataset) -> None:
    """Even a step of many turns is unwrapped alike."""
    coarse = earthspin.long_term("-1 Myr", "0 kyr", "100 kyr")
    for name in (*ANGLES, *NUMBERS):
        fine = million[name].sel(epoch=coarse.epoch)
        assert np.allclose(coarse[name], fine, rtol=0, atol=1e-11), name


def test_errors_grow_away_from_today(million: xr.Dataset) -> None:
    for name in ("pole_error", "obliquity_error", "longitude_of_perihelion_error"):
        late, early = million[name].sel(epoch=[-1000.0, -500_000.0]).values
        assert 0 < late < early, name
        assert early < float(million[name].isel(epoch=slice(0, 100)).max()), name
    assert float(million.pole_error.isel(epoch=-1)) == pytest.approx(1.96e-3, rel=0.01, abs=0)


def test_the_budget_adds_up(million: xr.Dataset) -> None:
    tree = scenes.tree("long-term")
    budget = tree["budget"].to_dataset()
    causes = {"method", "constant", "start", "orbit", "J2 rate", "tides", "ellipticity"}
    assert set(budget.cause.values.tolist()) == causes
    for share, error, unit in (
        ("obliquity_share", "obliquity_error", 3600.0),
        ("longitude_share", "longitude_of_perihelion_error", 1.0),
        ("pole_share", "pole_error", 1.0),
    ):
        total = np.sqrt((budget[share] ** 2).sum("cause"))
        assert np.allclose(total, million[error] * unit, rtol=1e-9, atol=1e-12)
    method = budget.pole_share.sel(cause="method")
    assert float(method.max()) < 0.05  # arcsec over a million years
    early = budget.pole_share.isel(epoch=0)
    assert str(early.cause[int(np.argmax(early.values))].item()) in {"ellipticity", "tides"}


def test_the_rate_at_j2000_is_that_of_precession_with_its_published_additions() -> None:
    short = earthspin.precession()
    added = sum(effect.value for effect in PUBLISHED_EFFECTS.values())
    found = earthspin.long_term(times=["0 kyr"]).precession_rate
    rate = float(found.sel(perturber="total").item())
    # 2.5e-7 found: geodesic precession is computed here, with the eccentricity of the table
    assert rate == pytest.approx(
        float(short.precession_rate.sel(perturber="total")) + added, rel=1e-6, abs=0
    )
    assert float(found.sel(perturber="sun").item()) == pytest.approx(
        float(short.precession_rate.sel(perturber="sun")), rel=1e-6, abs=0
    )


def test_half_widths_contain_iau_2006_over_two_thousand_years() -> None:
    """As returned: angles of ERFA's p06e, and directions of pmat06 and ecm06."""
    years = np.arange(-1000.0, 1001.0, 10.0)
    found = earthspin.long_term(times=years * u.yr)
    iau = {name: [] for name in ("psi_A", "omega_A", "obliquity", "general_precession")}
    directions = {"pole": [], "ecliptic_pole": []}
    for days in years * 365.25:
        angles = erfa.p06e(J2000_JD, days)
        for name, place in zip(iau, (1, 2, 7, 12), strict=True):
            iau[name].append(np.degrees(angles[place]))
        directions["pole"].append(erfa.pmat06(J2000_JD, days)[2])
        directions["ecliptic_pole"].append(erfa.ecm06(J2000_JD, days)[2])
    for name, angles in iau.items():
        inside = np.abs(found[name] - angles) <= found[f"{name}_error"]
        assert float(inside.mean()) >= 0.95, name
    for name, vectors in directions.items():
        off = np.linalg.norm(found[name].values - np.array(vectors), axis=1) / ARCSEC
        assert np.all(off <= found[f"{name}_error"].values), name


def test_the_matrices_join_iau_2006() -> None:
    tree = earthspin.run_tree(LongTerm(times=["-1 kyr", "0 kyr", "1 kyr"]), sections="matrices")
    found = tree["matrices"].to_dataset()
    assert found.matrix.dims == ("epoch", "axis", "component")
    for epoch, matrix in zip(found.epoch.values, found.matrix.values, strict=True):
        assert np.allclose(matrix @ matrix.T, np.eye(3), rtol=0, atol=1e-14)
        off = np.abs(matrix - erfa.pmat06(J2000_JD, epoch * 365.25))
        assert off.max() < 0.3 * ARCSEC  # the equinox feels what the smoothed ecliptic lacks


def test_tides_ellipticity_and_j2_are_what_was_measured() -> None:
    """Arcsec in obliquity after a million years, and degrees in perihelion.

    A prototype with another orbit found at most 139 and 3.3, and 653 and 14; the J2 rate turns the
    axis by 0.0070 T^2 arcsec in longitude, T in centuries (Capitaine et al. 2003, sect. 4.1).
    """
    times = ["-1 Myr"]
    own = earthspin.long_term(times=times)

    def off(**changed: float) -> tuple[float, float]:
        other = earthspin.long_term(times=times, **changed)
        tilt = abs(float((other.obliquity - own.obliquity).item()) * 3600)
        return tilt, abs(
            float((other.longitude_of_perihelion - own.longitude_of_perihelion).item())
        )

    tilt, turn = off(tides=0.0)
    assert 50 < tilt < 140
    assert turn == pytest.approx(3.3, rel=0.03, abs=0)
    tilt, turn = off(ellipticity=1.001)
    assert 300 < tilt < 660
    assert turn == pytest.approx(14.0, rel=0.03, abs=0)
    near, still = (earthspin.long_term(times=["-2 kyr"], j2_rate=rate) for rate in (None, 0.0))
    by_j2 = float((near.psi_A - still.psi_A).item()) * 3600
    assert by_j2 == pytest.approx(-0.0070 * 20**2, rel=0.01, abs=0)  # -2.8075 found


def test_mars_turns_in_some_170_thousand_years() -> None:
    """7.6 arcsec a year, and obliquities between some 10 and 50 degrees (Laskar et al. 2004)."""
    found = earthspin.long_term("-10 Myr", "0 kyr", "10 kyr", body="mars")
    assert found.perturber.values.tolist() == ["sun", "total"]
    assert float(found.precession_rate.sel(perturber="total")[-1]) == pytest.approx(
        7.6, rel=0.02, abs=0
    )
    assert float(found.obliquity[-1]) == pytest.approx(25.19, rel=0, abs=0.02)
    assert 10 < float(found.obliquity.min()) < 20
    assert 38 < float(found.obliquity.max()) < 52
    tree = earthspin.run_tree(LongTerm(body="mars", times=["-1 Myr"]), sections="budget")
    assert "tides" not in tree["budget"].to_dataset().cause.values


# --- again, and elsewhere ------------------------------------------------------------------------


def test_an_orbit_by_its_path_is_that_orbit(tmp_path: Path) -> None:
    orbit = shipped("earth")
    assert orbit is not None
    orbit.to_file(tmp_path / "orbit.npz")
    by_path = earthspin.long_term(times=["-50 kyr"], orbit=tmp_path / "orbit.npz")
    own = earthspin.long_term(times=["-50 kyr"])
    assert by_path.drop_attrs(deep=False).identical(own.drop_attrs(deep=False))


def test_dates_and_durations_are_the_same_question() -> None:
    one = earthspin.long_term(times=["-3000-01-01"])
    other = earthspin.long_term(times=[float(one.epoch[0])] * u.yr)
    assert np.allclose(one.pole, other.pole, rtol=0, atol=1e-13)


# --- refusals ------------------------------------------------------------------------------------


def upright(angle: float) -> earthspin.Body:
    """An Earth with its pole at an angle from the normal of its orbit at J2000.0."""
    ra, dec = EARTH_ORBIT
    return EARTH.replace(pole=(ra, dec + angle), orbit_pole=EARTH_ORBIT)


_N = shipped("earth").at(np.zeros(1))[0][:, 0]  # type: ignore[union-attr]
EARTH_ORBIT = (float(np.arctan2(_N[1], _N[0])), float(np.arcsin(_N[2])))


test_what_cannot_be_answered_is_refused = refused(
    ({"span": ("-11 Myr", "0 kyr"), "step": "1 Myr"}, CoverageError, "-10000 kyr to 10000 kyr"),
    ({"times": ["10.1 Myr"]}, CoverageError, "orbit of earth"),
    ({"span": ("0 kyr", "-1 kyr")}, SceneError, "ends before it starts"),
    ({"span": ("-1 kyr", "0 kyr"), "step": 100.0}, SceneError, "unit"),
    ({"perturbers": ["sun", "mars"]}, SceneError, "another star"),
    ({"perturbers": ["moon"]}, SceneError, "another star"),
    ({"times": ["-1 kyr"], "step": "1 kyr"}, SceneError, "times"),
    ({"body": "venus", "times": ["-1 kyr"]}, EarthspinError, "venus"),
    ({"tides": 100.0}, SceneError, "between -10 and 10"),
    ({"ellipticity": 0.0}, SceneError, "at least 1e-09"),
    ({"times": ["-1 kyr"], "orbit": "nowhere.npz"}, EarthspinError, "cannot be read"),
    ({"times": ["-1 kyr"], "orbit": 5}, SceneError, "path of a table"),
    ({"times": ["-1 kyr"], "orbit": {"name": "x"}}, SceneError, "needs axes, coefficients"),
    call=lambda asked: earthspin.run(LongTerm(**asked)),
)


def test_bodies_and_pulls_that_are_labelled_stand_side_by_side() -> None:
    """Errors by cause and matrices too; sums over masses are added up in another order."""
    ask = {"span": ("-30 kyr", "0 kyr"), "step": "10 kyr"}
    flattenings, masses = [0.00327, 0.00328], [SUN.gm, 1.01 * SUN.gm]
    body = EARTH.replace(dynamical_flattening=xr.DataArray(flattenings, dims="draw"))
    sun = SUN.replace(gm=xr.DataArray(masses, dims="mass"))
    many = earthspin.run_tree(LongTerm(body=body, perturbers=[sun, "moon"], **ask))
    for draw, flattening in enumerate(flattenings):
        for mass, gm in enumerate(masses):
            one = earthspin.run_tree(
                LongTerm(
                    body=EARTH.replace(dynamical_flattening=flattening),
                    perturbers=[SUN.replace(gm=gm), "moon"],
                    **ask,
                )
            )
            for section in ("/", "budget", "matrices"):
                for name, of in one[section].to_dataset(inherit=False).data_vars.items():
                    found = many[section][name].isel(draw=draw, mass=mass)
                    worst = np.max(np.abs(found - of) / np.maximum(np.abs(of), 1))
                    assert worst < 2e-9, (section, name)  # 2e-10 arcsec measured


@pytest.mark.slow
@pytest.mark.parametrize("span", [("-10 Myr", "-9 Myr"), ("9 Myr", "10 Myr")])
def test_climatic_precession_is_inside_for_phases_of_the_longitudes_own_error(
    span: tuple[str, str],
) -> None:
    """Of one changed solution for each cause it was 54 % before the present, 38 % after."""
    found = earthspin.long_term(*span, "10 kyr")
    draws = np.random.default_rng(11).standard_normal((500, 1)) / 1.959964
    moved = draws * found.longitude_of_perihelion_error.values
    phases = np.radians(found.longitude_of_perihelion.values + moved)
    apart = found.eccentricity.values * np.sin(phases) - found.climatic_precession.values
    inside = np.abs(apart) <= found.climatic_precession_error.values
    assert 0.92 < inside.mean() < 0.99


@pytest.mark.slow
def test_members_have_the_same_bits_alone_where_half_widths_are_sampled() -> None:
    """Each reaches a phase error of 0.1 rad at an epoch of its own."""
    factors = [0.97, 1.0]
    body = EARTH.replace(
        dynamical_flattening=xr.DataArray(
            [factor * EARTH.dynamical_flattening for factor in factors], dims="draw"
        )
    )
    ask = {"span": ("-1.2 Myr", "100 kyr"), "step": "10 kyr"}
    many = earthspin.run(LongTerm(body=body, **ask))
    for draw in range(len(factors)):
        flattening = float(body.dynamical_flattening[draw])
        one = earthspin.run(LongTerm(body=EARTH.replace(dynamical_flattening=flattening), **ask))
        for name, of in one.data_vars.items():
            if "epoch" in of.dims:
                assert np.array_equal(many[name].isel(draw=draw), of), name


def test_an_upright_axis_has_no_longitudes() -> None:
    with pytest.raises(UndefinedError, match="is normal to the orbit"):
        earthspin.long_term(times=["0 kyr"], body=upright(0.0), perturbers=["sun"])


@pytest.mark.parametrize("years", [1e3, 1e4, 1e5, 1e6])
def test_method_and_start_are_below_what_the_page_prints(years: float) -> None:
    shares = scenes.tree("long-term")["budget"].longitude_share.sel(epoch=-years)
    assert float(shares.sel(cause="method")) < 1e-5
    assert float(shares.sel(cause="start")) < (1e-5 if years < 1e6 else 6.5e-5)


@pytest.mark.parametrize(
    ("scene", "unknown"),
    [({}, False), ({"body": "mars"}, True), ({"body": "mars", "j2_rate": "0 1/s"}, False)],
)
def test_a_rate_of_j2_that_is_not_known_is_named(scene: dict[str, str], unknown: bool) -> None:
    answer = earthspin.long_term("-2 kyr", "0 kyr", "1 kyr", **scene)
    assert ("J2" in answer.attrs["neglected"]) == unknown
