"""The figure of equilibrium: published ellipticities, a homogeneous body, any layers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from earthspin import EARTH
from earthspin.constants import G
from earthspin.interior.equilibrium import figure
from earthspin.interior.layers import PREM, LayeredBody
from tests.conftest import load_pins
from tests.interior.shells import sphere

PINS = load_pins("nutation")
SPIN = float(EARTH.spin_rate)


@pytest.mark.parametrize("name", ["e", "e_f", "e_s", "a1", "a2", "a3"])
def test_published_figure_of_prem(name: str) -> None:
    PINS[name].check(getattr(figure(PREM, SPIN), name))


def test_published_moments_of_prem() -> None:
    PINS["core over body"].check(figure(PREM, SPIN).fluid)
    PINS["inner core over body"].check(figure(PREM, SPIN).inner)


@pytest.mark.parametrize("faster", [1, 6])
def test_mean_moments_of_the_regions_are_those_of_the_layers(faster: int) -> None:
    """With C = A (1 + e), the mean moment (2 A + C)/3 of each region is A (1 + e/3)."""
    f = figure(PREM, faster * SPIN)
    mean = PREM.moment_of_inertia()
    a = mean / (1 + f.e / 3)
    inner = PREM.moment_of_inertia(PREM.inner_core_radius)
    core = PREM.moment_of_inertia(PREM.core_radius)
    assert np.isclose(f.inner * a * (1 + f.e_s / 3), inner, rtol=1e-12, atol=0)
    assert np.isclose(f.fluid * a * (1 + f.e_f / 3), core - inner, rtol=1e-12, atol=0)
    excess = f.e_s * f.inner + f.e_f * f.fluid
    assert np.isclose(excess * a, f.e_core * core / (1 + f.e_core / 3), rtol=1e-12, atol=0)
    unit = (faster * SPIN) ** 2 * PREM.radius**5 / (3 * G.value * a)
    assert np.isclose(f.tidal_inertia, unit, rtol=1e-12, atol=0)


def test_an_even_body_is_as_flat_as_maclaurin_has_it() -> None:
    """Flattening 5 q/4 and as much for all that is inside; no excess in the inner core."""
    even = sphere((1e6, 5e3, 1e11), (3e6, 5e3, 0.0), (6e6, 5e3, 1e11))
    q = SPIN**2 * even.radius**3 / (G.value * even.mass)
    found = figure(even, SPIN)
    assert np.isclose(found.surface, 5 * q / 4, rtol=1e-11, atol=0)
    for e in (found.e, found.e_f, found.e_s):
        # (C - A)/A is the flattening to first order; both are over A
        assert np.isclose(e, found.surface / (1 - found.surface / 3), rtol=1e-10, atol=0)
    assert np.isclose(found.a1, 1.0, rtol=1e-10, atol=0)


def radau(body: LayeredBody, spin_rate: float) -> list[float]:
    """Ellipticity at the top of each layer, by Radau's equation: its own variable, its own solver.

    r eta' = -eta2 + eta + 6 - 6 (rho/mean)(eta + 1), eta = d ln eps/d ln r.
    """

    def mass(r: float) -> float:
        total, below = 0.0, 0.0
        for layer in body.layers:
            top = min(layer.top / body.radius, r)
            if top > below:
                p = np.polynomial.Polynomial((0.0, 0.0, *layer.density)).integ()
                total += p(top) - p(below)
            below = layer.top / body.radius
        return float(total)

    eta, growth, r, found = 0.0, 0.0, 1e-4, []
    for layer in body.layers:
        top = layer.top / body.radius

        def slope(x: float, y: list[float], layer=layer) -> list[float]:  # type: ignore[no-untyped-def]
            rho = np.polyval(layer.density[::-1], x)
            share = rho * x**3 / (3 * mass(x))
            return [(-(y[0] ** 2) + y[0] + 6 - 6 * share * (y[0] + 1)) / x, y[0] / x]

        solution = solve_ivp(slope, (r, top), [eta, growth], "DOP853", rtol=1e-12, atol=1e-14)
        (eta, growth), r = solution.y[:, -1], top
        found.append(growth)
    q = spin_rate**2 * body.radius**3 / (G.value * body.mass)
    surface = 2.5 * q / (eta + 2)
    return [float(surface * np.exp(one - growth)) for one in found]


def test_clairaut_by_radaus_equation() -> None:
    """Excess and pull of the inner core from the ellipticities of another solution."""
    eps, f = radau(PREM, SPIN), figure(PREM, SPIN)
    assert np.isclose(f.surface, eps[-1], rtol=1e-9, atol=0)
    # the integral of rho d(eps r5) through the inner core by parts, on Radau's own solution
    fluid = PREM.layers[1]
    rho = np.polyval(fluid.density[::-1], PREM.inner_core_radius / PREM.radius)
    own = rho * eps[0] * PREM.inner_core_radius**5 * 8 * np.pi / 15
    inner = PREM.moment_of_inertia(PREM.inner_core_radius) / (1 + f.e_s / 3) * f.e_s
    assert np.isclose(f.a1, own / inner, rtol=1e-9, atol=0)


@given(st.floats(0.1, 0.9), st.floats(1.0, 5.0))
def test_a_denser_core_is_rounder(share: float, ratio: float) -> None:
    body = sphere((share * 6e6, 4e3 * ratio, 0.0), (6e6, 4e3, 1e11))
    found = figure(body, SPIN)
    flattest = found.surface / (1 - found.surface / 3) * (1 + 1e-9)  # (C - A)/A if even
    assert 0 < found.e_f <= flattest
    assert 0 < found.e <= flattest
