"""The shape at rest, and what it makes of the core."""

import numpy as np

from earthspin import EARTH
from earthspin.interior.equilibrium import equilibrium, hydrostatic_core
from earthspin.interior.layers import PREM, tidal_inertia
from earthspin.interior.love import elastic, solve_love_numbers
from tests.conftest import load_pins
from tests.interior.shells import sphere

PINS = load_pins("wobble")
SPIN = 2 * np.pi / EARTH.spin_period


def test_without_rigidity_the_body_takes_clairauts_shape() -> None:
    soft = sphere((3.5e6, 11000.0, 0.0), (6.4e6, 4500.0, 1e5))
    found = solve_love_numbers(soft)
    assert np.isclose(found.k, equilibrium(soft).k, rtol=1e-5, atol=0)
    assert np.isclose(found.h, 1 + found.k, rtol=1e-5, atol=0)
    assert np.isclose(found.core_k, equilibrium(soft).core_k, rtol=1e-5, atol=0)


def test_a_homogeneous_liquid_has_k_of_three_halves() -> None:
    assert np.isclose(
        equilibrium(sphere((3e6, 5e3, 0.0), (6e6, 5e3, 1e9))).k, 1.5, rtol=2e-12, atol=0
    )


def test_compliances_beside_published_ones() -> None:
    """PREM, published: the model's own moment and no ellipticity leave one per cent."""
    unit = tidal_inertia(PREM, SPIN)
    PINS["gamma"].check(unit * elastic(PREM).core_k / PREM.core_fraction)
    PINS["beta"].check(unit * elastic(PREM).core_k_pressure / PREM.core_fraction)
    PINS["hydrostatic core ellipticity"].check(hydrostatic_core(PREM, SPIN))
