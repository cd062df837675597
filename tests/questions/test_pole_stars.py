"""Stars near the pole of the past, held to ERFA's space motion and long-term precession."""

import erfa
import numpy as np
import pytest

import earthspin
from earthspin.sky.stars import STARS, directions

YEARS = np.array([-10000.0, -3000.0, 1000.0, 2000.0, 6000.0])
J2000 = 2451545.0


def of_erfa(name: str, years: np.ndarray = YEARS) -> np.ndarray:
    """Direction of a star at each year, shape (t, 3)."""
    (star,) = (star for star in STARS if star.name == name)
    ra, dec = np.radians([star.right_ascension, star.declination])
    along, north = np.radians(np.array(star.proper_motion) / 3.6e6)
    # a parallax of a milliarcsecond, and no radial velocity
    given = (ra, dec, along / np.cos(dec), north, 1e-3, 0.0, J2000, 0.0, J2000)
    moved = [erfa.starpm(*given, 365.25 * (year - 2000)) for year in years]
    return np.array([erfa.s2c(*place[:2]) for place in moved])


@pytest.mark.parametrize("name", ["Vega", "Thuban", "Polaris", "Alderamin"])
def test_stars_move_as_those_of_erfa(name: str) -> None:
    ours = directions((YEARS - 2000) * 365.25 * 86400)[[star.name for star in STARS].index(name)]
    # measured: 2.8e-6 rad for Vega after 12,000 years: starpm moves it along a line in space, so
    # that an angle of 0.0204 rad becomes its arc tangent
    assert np.allclose(ours, of_erfa(name), atol=5e-6, rtol=0)


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
