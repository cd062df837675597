"""Stars near the pole of the past, held to ERFA's space motion and long-term precession."""

import erfa
import numpy as np
import pytest

import earthspin
from earthspin.sky.stars import STARS, Star, directions

YEARS = np.array([-10000.0, -3000.0, 1000.0, 2000.0, 6000.0])
J2000 = 2451545.0


def of_erfa(name: str, years: np.ndarray = YEARS) -> np.ndarray:
    """Direction of a star at each year, shape (t, 3)."""
    (star,) = (star for star in STARS if star.name == name)
    ra, dec = np.radians([star.right_ascension, star.declination])
    along, north = np.radians(np.array(star.proper_motion) / 3.6e6)
    # a parallax of a milliarcsecond, and no radial velocity
    given = (ra, dec, along / np.cos(dec), north, 1e-3, 0.0, J2000, 0.0, J2000)
    moved = [erfa.pmsafe(*given, 365.25 * (year - 2000)) for year in years]
    return np.array([erfa.s2c(*place[:2]) for place in moved])


@pytest.mark.parametrize("star", STARS, ids=lambda star: star.name)
def test_stars_move_as_those_of_erfa(star: Star) -> None:
    ours = directions((YEARS - 2000) * 365.25 * 86400)[STARS.index(star)]
    # measured: 2.8e-6 rad for Vega after 12,000 years: ERFA moves it along a line in space, so
    # that an angle of 0.0204 rad becomes its arc tangent
    assert np.allclose(ours, of_erfa(star.name), atol=5e-6, rtol=0)


#: The new reduction of Hipparcos (van Leeuwen 2007, CDS I/311): right ascension and declination at
#: J1991.25, rad, proper motions and their standard errors, mas a year.
NEW_REDUCTION = {
    "Polaris": (0.6622851337, 1.5579531082, 44.48, -11.85, 0.11, 0.13),
    "Dubhe": (2.8960711378, 1.0777603439, -134.11, -34.70, 0.35, 0.39),
    "Alioth": (3.3773308557, 0.9766835090, 111.91, -8.24, 0.23, 0.19),
    "Mizar": (3.5077787053, 0.9586293363, 119.01, -25.97, 1.49, 1.65),
    "Alkaid": (3.6108350538, 0.8606795018, -121.17, -14.91, 0.15, 0.17),
    "Thuban": (3.6843483047, 1.1235698204, -56.34, 17.21, 0.15, 0.15),
    "Kochab": (3.8864406714, 1.2942572177, -32.61, 11.42, 0.11, 0.13),
    "Pherkad": (4.0174388121, 1.2537393443, -17.73, 17.90, 0.13, 0.11),
    "Edasich": (4.0357673053, 1.0291512588, -8.36, 17.08, 0.08, 0.10),
    "Tau Herculis": (4.2749256882, 0.8083190661, -13.33, 38.48, 0.10, 0.10),
    "Eltanin": (4.6975811581, 0.8986517235, -8.48, -22.79, 0.11, 0.10),
    "Vega": (4.8735545728, 0.6768909262, 200.94, 286.23, 0.32, 0.40),
    "Delta Cygni": (5.1704246155, 0.7876791647, 44.07, 48.66, 0.46, 0.49),
    "Deneb": (5.4167684854, 0.7902909202, 2.01, 1.85, 0.34, 0.27),
    "Alderamin": (5.5788418042, 1.0923222563, 150.55, 49.09, 0.09, 0.09),
    "Alfirk": (5.6228381573, 1.2315164467, 12.54, 8.39, 0.37, 0.27),
    "Errai": (6.1930813863, 1.3549334230, -47.96, 126.59, 0.45, 0.40),
}
#: Double stars, whose motion in the orbit the two reductions separate differently.
DOUBLE = {"Dubhe", "Mizar"}


@pytest.mark.parametrize("star", STARS, ids=lambda star: star.name)
def test_stars_are_those_of_the_new_reduction(star: Star) -> None:
    ra, dec, along, north, *errors = NEW_REDUCTION[star.name]
    rates = np.radians(np.array([along / np.cos(dec), north]) / 3.6e6)
    moved = erfa.pmsafe(ra, dec, *rates, 1e-3, 0.0, 2448349.0625, 0.0, J2000, 0.0)
    away = np.array([star.right_ascension, star.declination]) - np.degrees(moved[:2])
    # four decimals of a degree, and 1e-5 from the motion of Polaris
    np.testing.assert_allclose(away, 0, atol=7e-5, rtol=0)
    apart = np.array(star.proper_motion) - (along, north)
    if star.name in DOUBLE:
        assert star.proper_motion_error == pytest.approx(np.max(abs(apart)), rel=1e-9, abs=0)
    else:
        assert np.all(abs(apart) < 3.5 * np.hypot(star.proper_motion_error, errors))
        assert 0.4 < star.proper_motion_error < 0.7


def test_errors_contain_the_pole_and_the_proper_motions() -> None:
    """At -5000 years, 20 times less than with a motion that is not known."""
    past = earthspin.long_term(times=["-5000 yr", "0 yr"])
    stars = earthspin.pole_stars(past, count=len(STARS)).isel(epoch=0)
    by_name = {star.name: star.proper_motion_error for star in STARS}
    of_motion = [1.96 * 5000 * by_name[name] / 3.6e6 for name in stars.star.values.tolist()]
    pole_error = float(past.pole_error[0]) / 3600
    np.testing.assert_allclose(
        stars.separation_error, np.hypot(of_motion, pole_error), rtol=1e-4, atol=0
    )
    assert np.all(stars.separation_error < 1.96 * 5000 * 0.35 / 3600 / 20)


def test_separations_are_those_of_erfa() -> None:
    epochs = [f"{year - 2000:.0f} yr" for year in YEARS]
    stars = earthspin.pole_stars(earthspin.long_term(times=epochs), count=len(STARS))
    for place, year in enumerate(YEARS):
        pole = erfa.ltpequ(year)
        at = stars.isel(epoch=place).set_index(nearest="star")
        for name in ("Vega", "Thuban", "Polaris"):
            star = of_erfa(name)[place]
            away = np.degrees(np.arctan2(np.linalg.norm(np.cross(pole, star)), pole @ star))
            # Vondrak's poles differ by 70 arcsec at -10000, and lack the frame bias of 17 mas
            assert at.separation.sel(nearest=name).item() == pytest.approx(away, abs=0.03, rel=0)


def test_thuban_was_nearest_when_erfa_says() -> None:
    years = np.arange(-2840.0, -2740.0, 5.0)
    past = earthspin.pole_stars(earthspin.long_term(times=[f"{y - 2000} yr" for y in years]))
    assert set(past.star.values.ravel()) == {"Thuban"}
    star = of_erfa("Thuban", years)
    away = [np.linalg.norm(np.cross(erfa.ltpequ(y), s)) for y, s in zip(years, star, strict=True)]
    nearest = past.separation.squeeze().argmin("epoch").item()
    assert abs(nearest - int(np.argmin(away))) <= 1
    # measured: 0.09 and 0.10 degrees
    assert float(past.separation.min()) == pytest.approx(np.degrees(min(away)), abs=0.02, rel=0)


@pytest.mark.parametrize("count", [0, 18, True, 1.5, None, np.timedelta64(1, "s")])
def test_counts_that_are_none(count: object) -> None:
    past = earthspin.long_term("-1 kyr", "0 kyr", "1 kyr")
    with pytest.raises(earthspin.SceneError, match="whole number"):
        earthspin.pole_stars(past, count)


def test_answers_without_stars_near_the_pole() -> None:
    many = earthspin.ensemble("long-term", 2)
    with pytest.raises(earthspin.SceneError, match="several"):
        earthspin.pole_stars(many)
    other = earthspin.EARTH.replace(pole=(4.0, 0.5), orbit_pole=earthspin.MARS.orbit_pole)
    for body in ("mars", other):
        answer = earthspin.long_term(times=["0 kyr"], body=body)
        with pytest.raises(earthspin.SceneError, match="IAU 2006"):
            earthspin.pole_stars(answer)
    with pytest.raises(earthspin.SceneError, match="long_term"):
        earthspin.pole_stars(earthspin.wobble_ladder())


def test_the_pole_is_read_by_its_labels() -> None:
    """Thuban was the pole star of 2787 BC (Wikipedia, from Kaler)."""
    answer = earthspin.long_term(times=["2787 BC", "2000-01-01"])
    turned = answer.isel(component=[2, 1, 0]).transpose("component", ...)
    stars = earthspin.pole_stars(turned)
    assert stars.identical(earthspin.pole_stars(answer))
    assert stars.star.squeeze().values.tolist() == ["Thuban", "Polaris"]
    with pytest.raises(earthspin.SceneError, match="3 labels along 'component', the data have 2"):
        earthspin.pole_stars(answer.isel(component=[0, 1]))
