"""Layered bodies: their moments."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from earthspin.interior.layers import PREM, LayeredBody
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
