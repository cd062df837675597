"""Interiors by name: their numbers from other models, and their uncertainties from the papers."""

import numpy as np
import pytest

from earthspin.interior.named import INTERIORS


def test_the_core_of_mars_by_layers_and_by_insight() -> None:
    """Layers have a core of 6100 kg m-3 and divide by the mean moment; InSight 6000, and by A."""
    layers, published = INTERIORS["mars-layers"].layers, INTERIORS["mars-insight"]
    assert layers is not None
    polar, j2 = 0.36367, 1.95661e-3  # C/(M R2) of Baland et al. 2020, J2 of MRO110B
    mean_over_equatorial = (polar - 2 / 3 * j2) / (polar - j2)
    expected = layers.core_fraction * 6000 / 6100 * mean_over_equatorial
    assert published.core_fraction == pytest.approx(expected, rel=1e-5, abs=0)


def test_the_love_number_of_mars_within_its_uncertainty() -> None:
    """0.174 +- 0.008 of Konopliv et al. (2020), +- 0.010 with earlier ones; layers give 0.1705."""
    published, layers = INTERIORS["mars-insight"], INTERIORS["mars-layers"]
    assert published.k2 == 0.174
    for interior in (published, layers):
        assert interior.relative_uncertainty["k2"] == pytest.approx(0.010 / 0.174, rel=1e-12, abs=0)
    assert layers.values()[0] == pytest.approx(0.174, rel=0, abs=0.010)


def test_uncertainties_of_the_core_of_mars() -> None:
    """Radius 1835 +- 55 km (Le Maistre et al. 2023), density 6.0 +- 0.3 (Staehler et al. 2021)."""
    radius, density = 55 / 1835, 0.3 / 6.0
    published = INTERIORS["mars-insight"].relative_uncertainty["core_fraction"]
    assert published == round(np.hypot(5 * radius, density), 2)
    layers = INTERIORS["mars-layers"].relative_uncertainty["core_fraction"]
    assert layers == pytest.approx(3 * radius, rel=1e-12, abs=0)
