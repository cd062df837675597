"""Figures: labelled axes, units, and no global state."""

import sys

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import earthspin
from earthspin.views import torque
from earthspin.views.star_chart import STARS, project, star_vectors


@pytest.fixture(scope="module")
def year() -> xr.Dataset:
    return earthspin.run("torque")


def test_pyplot_is_not_needed(year: xr.Dataset) -> None:
    torque.plot_torque(year)
    assert "matplotlib.pyplot" not in sys.modules


def test_given_axes_are_used(year: xr.Dataset) -> None:
    ax = Figure().subplots()
    assert torque.plot_declination(year, ax=ax) is ax


def test_the_pole_passes_the_stars_that_it_should(precession_tree: xr.DataTree) -> None:
    """Thuban was the pole star of 2800 BC (within 10 arcmin), Polaris is at 0.7 degrees now."""
    obliquity = np.radians(float(precession_tree.obliquity))
    radius = np.degrees(obliquity)
    rate = float(precession_tree.precession_rate[-1]) / 3600

    def pole(year: float) -> np.ndarray:
        back = np.radians(rate * (year - 2000))
        return radius * np.array([-np.sin(back), np.cos(back)])

    places = project(star_vectors(), obliquity)
    stars = {name: place for (name, *_), place in zip(STARS, places, strict=True)}
    assert abs(np.linalg.norm(pole(2000) - stars["Polaris"]) - 0.74) < 0.05
    years = np.arange(-4000, 14001, 10)

    def nearest_year(star: str) -> tuple[float, float]:
        away = [np.linalg.norm(pole(y) - stars[star]) for y in years]
        return float(years[np.argmin(away)]), float(np.min(away))

    year, away = nearest_year("Thuban")
    assert -2900 < year < -2600
    assert away < 0.4
    year, _ = nearest_year("Vega")
    assert 13000 < year < 14000
