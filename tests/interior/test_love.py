"""Love numbers: published ones, closed forms, reciprocity, and how they soften."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from earthspin import UndefinedError
from earthspin.constants import G
from earthspin.interior.equilibrium import equilibrium
from earthspin.interior.layers import PREM, Layer, LayeredBody
from earthspin.interior.love import elastic, softening, solve_love_numbers
from earthspin.interior.mars import MARS
from tests.conftest import load_pins
from tests.interior.another_integration import other_answers
from tests.interior.prem import PREM_WITH_OCEAN
from tests.interior.shells import sphere

PINS = load_pins("wobble")


def test_love_numbers_of_prem() -> None:
    """With a liquid inner core, as in the independent integration; a solid one stiffens by 1e-4."""
    inner, *rest = PREM.layers
    liquid = replace(PREM, layers=(replace(inner, vs=(), shear_q=np.inf), *rest))
    found = solve_love_numbers(liquid)
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
    found = solve_love_numbers(body)
    # A liquid core of a fiftieth of the radius and the finite stiffness leave 3e-4.
    assert np.isclose(found.k, 1.5 / stiffness, rtol=4e-4, atol=0)
    assert np.isclose(found.h, 2.5 / stiffness, rtol=1e-3, atol=0)
    assert np.isclose(found.l, 0.75 / stiffness, rtol=6e-4, atol=0)


@given(st.floats(-36, 0), st.floats(0, 12))
@settings(max_examples=8)
def test_interpolated_softening(real: float, imaginary: float) -> None:
    mu_change = complex(real, imaginary)
    direct = solve_love_numbers(PREM, mu_change)
    for name, ratio in zip(
        ("k", "core_k", "k_pressure", "core_k_pressure"), softening(PREM), strict=True
    ):
        expected = getattr(direct, name) / float(getattr(elastic(PREM), name))
        assert abs(ratio(mu_change) - expected) < 2e-8, name  # measured: 2e-9


def test_a_softer_body_yields_more_and_lags() -> None:
    k = solve_love_numbers(PREM, np.array([0, -5, -10, -10 + 3j])).k
    assert k[0].real < k[1].real < k[2].real
    assert k[3].imag < 0


def test_love_numbers_need_a_solid_surface_and_one_core() -> None:
    with pytest.raises(UndefinedError, match=r"'prem-ocean'.*liquid"):
        solve_love_numbers(PREM_WITH_OCEAN)
    firm, wet = (lambda top: (top, 5e3, 1e11)), (lambda top: (top, 5e3, 0.0))
    with pytest.raises(UndefinedError, match="2 liquids"):
        solve_love_numbers(sphere(wet(1e6), firm(2e6), wet(3e6), firm(4e6)))


def test_what_one_part_answers_to_another() -> None:
    """Betti's theorem: part i answers to a potential in part j as j to one in i."""
    for mu_change in (0.0, -14 + 3j):
        found = solve_love_numbers(PREM, mu_change).response
        sizes = np.sqrt(abs(np.diagonal(found)))
        off = (found - found.T) / np.outer(sizes, sizes)
        assert np.max(abs(off)) < 1e-11  # measured: 5e-13


def test_a_load_answers_as_a_tide_lifts() -> None:
    """Reciprocity of tide and load in degree two: k' = k - h (Molodenskiy 1977)."""
    found = elastic(PREM)
    assert np.isclose(found.k_load, found.k - found.h, rtol=2e-11, atol=0)


def test_shells_within_the_start_of_the_integration_change_nothing() -> None:
    """Tables of samples have them: the first shell of 1 km, with the density that is there."""
    inner, *rest = PREM.layers
    cut = tuple(replace(inner, top=top) for top in (1.0, 1e3, 6e3, 1.2e4))
    found = elastic(replace(PREM, layers=(*cut, inner, *rest)))
    sizes = np.sqrt(abs(np.diagonal(elastic(PREM).response)))
    off = (found.response - elastic(PREM).response) / np.outer(sizes, sizes)
    assert np.max(abs(off)) < 1e-12  # measured: 2.0e-13
    liquid = replace(inner, vs=(), shear_q=np.inf)
    whole, *parts = (
        equilibrium(LayeredBody("l", (*layers, liquid, *rest), ""))
        for layers in ((), tuple(replace(liquid, top=top) for top in (1e3, 6e3)))
    )
    assert np.isclose(parts[0].k, whole.k, rtol=1e-13, atol=0)


@pytest.mark.parametrize("size", [0.1, 0.02, 0.01])
def test_a_small_inner_core_by_another_integration(size: float) -> None:
    """One that starts at a three hundredth of it; only what it answers to itself is as small."""
    inner, outer, *rest = PREM.layers
    layers = (replace(inner, top=size * PREM.radius, density=outer.density), outer, *rest)
    body = replace(PREM, layers=layers)
    other = other_answers(body, start=size / 300)
    # measured: 7e-11, 5e-7, 1.6e-5
    assert abs(elastic(body).response[2, 2] / other[2, 2] - 1) < 3e-5 * (0.01 / size) ** 5


def test_a_core_that_cannot_be_told_from_none_is_refused() -> None:
    inner, *rest = PREM.layers
    small = replace(inner, top=6e4)
    liquid = replace(inner, vs=(), shear_q=np.inf)
    with pytest.raises(UndefinedError, match="inner core of 60 km"):
        solve_love_numbers(replace(PREM, layers=(small, liquid, *rest)))
    with pytest.raises(UndefinedError, match="core of 6 km"):
        solve_love_numbers(replace(PREM, layers=(replace(liquid, top=6e3), PREM.layers[-1])))


#: Rock, an ocean in two layers, and ice.
ICY = LayeredBody(
    "icy moon",
    (
        Layer(1.4e6, (3300.0, 0.0, -200.0), (7000.0,), (4000.0,), 300.0),
        Layer(1.46e6, (1100.0,), (1600.0,)),
        Layer(1.5e6, (1000.0,), (1500.0,)),
        Layer(1.56e6, (930.0,), (3800.0,), (1900.0,), 100.0),
    ),
    "",
)


@pytest.mark.parametrize(("body", "within"), [(PREM, 3e-12), (MARS, 6e-11), (ICY, 3e-12)])
def test_bodies_by_another_integration(body: LayeredBody, within: float) -> None:
    """Stress and strain in place of Takeuchi and Saito's matrix, Poisson's equation in the liquid.

    By an adaptive Runge-Kutta method in the logarithm of the radius.
    """
    other, found = other_answers(body), elastic(body).response
    sizes = np.sqrt(abs(np.diagonal(found)))
    sizes[sizes == 0] = 1.0  # of a part that is missing
    off = (found - other) / np.outer(sizes, sizes)
    assert np.max(abs(off)) < within  # measured: 6.0e-13, 1.3e-11, 4.8e-13


@pytest.mark.parametrize("radius", [6.4e6, 1e6, 1e5, 1e4])
def test_small_and_stiff(radius: float) -> None:
    """Kelvin's sphere, its rigidity up to three million times its weight."""
    body = sphere((radius, 3300.0, 1e11), stiff=1e7)
    gravity = G.value * body.mass / radius**2
    stiffness = 1 + 9.5 * 1e11 / (3300.0 * gravity * radius)
    found = solve_love_numbers(body)
    # measured: 1.3e-9 and 9e-9, of which most is the compressibility
    assert np.isclose(found.k, 1.5 / stiffness, rtol=1e-8, atol=0)
    assert np.isclose(found.h, 2.5 / stiffness, rtol=5e-8, atol=0)
    assert np.isclose(found.l, 0.75 / stiffness, rtol=1e-6, atol=0)
    assert np.isclose(found.k_load, found.k - found.h, rtol=1e-8, atol=0)  # measured: 4e-10
    assert not np.any(found.response[1:])  # no core answers
