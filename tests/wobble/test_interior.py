"""Layered bodies: moments, Love numbers, the shape at rest."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from earthspin import UndefinedError
from earthspin.constants import EARTH_SPIN_PERIOD, G
from earthspin.wobble.interior import (
    PREM,
    PREM_WITH_OCEAN,
    Layer,
    LayeredBody,
    equilibrium,
    yielding,
)
from earthspin.wobble.named import (
    elastic,
    global_ocean,
    hydrostatic_core,
    softening,
    tidal_inertia,
)
from tests.conftest import load_pins

PINS = load_pins("wobble")
SPIN = 2 * np.pi / EARTH_SPIN_PERIOD.value


def sphere(*shells: tuple[float, float, float], stiff: float = 1e5) -> LayeredBody:
    """Shells of (top, density, shear modulus), nearly incompressible."""
    layers = []
    for top, density, mu in shells:
        vs = (float(np.sqrt(mu / density)),) if mu else ()
        vp = (float(np.sqrt(stiff * 1e11 / density)),)
        layers.append(Layer(top, (density,), vp, vs, 1.0))
    return LayeredBody("test", tuple(layers), "")


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


def test_moments_of_prem() -> None:
    PINS["prem moment"].check(PREM_WITH_OCEAN.moment_factor)
    PINS["prem core fraction"].check(PREM_WITH_OCEAN.core_fraction)
    PINS["prem moment, ocean filled"].check(PREM.moment_factor)
    PINS["prem core fraction, ocean filled"].check(PREM.core_fraction)


def test_love_numbers_of_prem() -> None:
    """With a liquid inner core, as in the independent integration; a solid one stiffens by 1e-4."""
    inner, *rest = PREM.layers
    liquid = replace(PREM, layers=(replace(inner, vs=(), shear_q=np.inf), *rest))
    found = yielding(liquid)
    for name in ("k", "h", "l"):
        PINS[f"prem {name}2, liquid inner core"].check(getattr(found, name))
    assert 3e-5 < found.k - elastic(PREM).k < 4e-5
    PINS["prem k2 load"].check(elastic(PREM).k_load)
    PINS["prem h2 load"].check(elastic(PREM).h_load)


@given(st.floats(1e10, 5e11))
@settings(max_examples=10)
def test_kelvins_sphere(mu: float) -> None:
    """A homogeneous incompressible sphere: k2 = (3/2)/(1 + 19 mu/(2 rho g R)) (Kelvin 1863)."""
    radius, rho = 6.4e6, 5500.0
    body = sphere((0.02 * radius, rho, 0.0), (radius, rho, mu), stiff=1e4)
    gravity = G.value * body.mass / radius**2
    stiffness = 1 + 9.5 * mu / (rho * gravity * radius)
    found = yielding(body)
    # A liquid core of a fiftieth of the radius and the finite stiffness leave 3e-4.
    assert np.isclose(found.k, 1.5 / stiffness, rtol=4e-4, atol=0)
    assert np.isclose(found.h, 2.5 / stiffness, rtol=1e-3, atol=0)
    assert np.isclose(found.l, 0.75 / stiffness, rtol=6e-4, atol=0)


def test_without_rigidity_the_body_takes_clairauts_shape() -> None:
    soft = sphere((3.5e6, 11000.0, 0.0), (6.4e6, 4500.0, 1e5))
    found = yielding(soft)
    assert np.isclose(found.k, equilibrium(soft).k, rtol=1e-5, atol=0)
    assert np.isclose(found.h, 1 + found.k, rtol=1e-5, atol=0)
    assert np.isclose(found.core_k, equilibrium(soft).core_k, rtol=1e-5, atol=0)


def test_a_homogeneous_liquid_has_k_of_three_halves() -> None:
    assert np.isclose(
        equilibrium(sphere((3e6, 5e3, 0.0), (6e6, 5e3, 1e9))).k, 1.5, rtol=2e-12, atol=0
    )


def test_core_and_surface_answer_alike() -> None:
    """Betti's reciprocity: core pressure moves the surface as the tide moves the core."""
    found = elastic(PREM)
    assert np.isclose(found.k_pressure, found.core_k, rtol=5e-12, atol=0)
    found = yielding(PREM, -14 + 3j)
    assert np.isclose(found.k_pressure, found.core_k, rtol=5e-12, atol=0)


def test_compliances_beside_published_ones() -> None:
    """PREM, published: the model's own moment and no ellipticity leave one per cent."""
    unit = tidal_inertia(PREM, SPIN)
    PINS["gamma"].check(unit * elastic(PREM).core_k / PREM.core_fraction)
    PINS["beta"].check(unit * elastic(PREM).core_k_pressure / PREM.core_fraction)
    PINS["hydrostatic core ellipticity"].check(hydrostatic_core(PREM, SPIN))


def test_global_ocean() -> None:
    PINS["global ocean"].check(global_ocean(PREM))
    assert global_ocean(PREM, density=0.0) == 0


@given(st.floats(-36, 0), st.floats(0, 12))
@settings(max_examples=8)
def test_interpolated_softening(real: float, imaginary: float) -> None:
    strain = complex(real, imaginary)
    direct = yielding(PREM, strain)
    for name, ratio in zip(
        ("k", "core_k", "k_pressure", "core_k_pressure"), softening(PREM), strict=True
    ):
        expected = getattr(direct, name) / float(getattr(elastic(PREM), name))
        assert abs(ratio(strain) - expected) < 2e-8, name  # measured: 2e-9


def test_a_softer_body_yields_more_and_lags() -> None:
    k = yielding(PREM, np.array([0, -5, -10, -10 + 3j])).k
    assert k[0].real < k[1].real < k[2].real
    assert k[3].imag < 0


def test_love_numbers_need_a_core_and_a_solid_surface() -> None:
    with pytest.raises(UndefinedError, match="solid surface"):
        yielding(PREM_WITH_OCEAN)
    with pytest.raises(UndefinedError, match="liquid core"):
        yielding(sphere((6e6, 5e3, 1e11)))
