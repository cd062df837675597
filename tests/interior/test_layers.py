"""Layered bodies: their moments."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from earthspin.interior.layers import PREM, LayeredBody
from earthspin.interior.mars import MARS
from tests.interior.prem import PREM_WITH_OCEAN


def density(body: LayeredBody, r: float) -> float:
    layer = next(layer for layer in body.layers if r <= layer.top)
    return float(np.polynomial.Polynomial(layer.density)(r / body.radius))


@pytest.mark.parametrize("body", [PREM, PREM_WITH_OCEAN], ids=lambda b: b.name)
def test_moments_against_quadrature(body: LayeredBody) -> None:
    edges = [0.0, *(layer.top for layer in body.layers)]

    def moment(power: int, top: float) -> float:
        parts = itertools.pairwise(edges)
        return sum(
            quad(lambda r: density(body, r) * r**power, a, b)[0] for a, b in parts if b <= top
        )

    assert np.isclose(body.mass, 4 * np.pi * moment(2, body.radius), rtol=4e-15, atol=0)
    whole = 8 * np.pi / 3 * moment(4, body.radius)
    assert np.isclose(body.moment_of_inertia(), whole, rtol=4e-15, atol=0)
    core = 8 * np.pi / 3 * moment(4, body.core_radius)
    assert np.isclose(body.core_fraction, core / whole, rtol=4e-15, atol=0)


def test_layers_of_mars_have_its_mass_and_its_polar_moment() -> None:
    """C = I + 2/3 J2 M a2 with the mean moment I of spherical layers; J2 and a of MRO110B.

    C/(M a2) is that of Baland et al. (2020); the mean radius of the IAU is 6.5 km smaller than a.
    """
    gm, a, j2 = 4.282837e13, 3396e3, 1.95661e-3
    assert [layer.top for layer in MARS.layers] == [1835e3, 2334.5e3, 3341.5e3, 3389.5e3]
    assert MARS.mass == pytest.approx(gm / 6.6743e-11, rel=1e-6, abs=0)
    polar = MARS.moment_of_inertia() / (MARS.mass * a**2) + 2 / 3 * j2
    assert polar == pytest.approx(0.36367, rel=0, abs=1e-7)
