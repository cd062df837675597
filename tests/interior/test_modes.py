"""The system of mantle, fluid core and inner core: identities, limits, and motion in time."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from earthspin import EARTH
from earthspin.interior.equilibrium import figure
from earthspin.interior.layers import PREM
from earthspin.interior.love import elastic
from earthspin.interior.modes import Parts, all_fluid, free_modes, system, transfer, wobble_response
from tests.conftest import load_pins

PINS = load_pins("nutation")
SPIN = float(EARTH.spin_rate)
DAYS = EARTH.spin_period / 86400
F = figure(PREM, SPIN)
OBSERVED = EARTH.dynamical_flattening / (1 - EARTH.dynamical_flattening)
WHOLE = Parts(
    F.e, F.e_f, F.e_s, F.fluid, F.inner, F.a1, F.a2, F.a3, F.tidal_inertia * elastic(PREM).response
)


@pytest.mark.parametrize("name", list(WHOLE.compliances))
def test_published_compliances_of_prem(name: str) -> None:
    PINS[name].check(WHOLE.compliances[name])


def test_free_modes_of_a_hydrostatic_body() -> None:
    modes = free_modes(WHOLE)
    PINS["free core nutation"].check(DAYS / (1 + modes["free_core_nutation"].real))
    PINS["inner core nutation"].check(DAYS / (1 + modes["inner_core_nutation"].real))
    PINS["chandler wobble"].check(DAYS / modes["chandler_wobble"].real)
    PINS["inner core wobble"].check(DAYS / modes["inner_core_wobble"].real)


def test_a_part_that_is_missing_has_no_mode() -> None:
    assert list(free_modes(all_fluid(WHOLE, F.e_core))) == ["chandler_wobble", "free_core_nutation"]
    assert list(free_modes(replace(WHOLE, fluid=0.0, inner=0.0))) == ["chandler_wobble"]


@given(st.floats(-2e-3, 2e-3), st.floats(0, 2e-3), st.floats(0.001, 0.01))
def test_at_rest_in_space_the_inside_does_not_matter(real: float, loss: float, e: float) -> None:
    """T(-1) is H over that of the rigid body, whatever is inside (precession is of all)."""
    changed = replace(WHOLE, e=e, e_f=F.e_f + real, k_cmb=1j * loss, k_icb=real - 1j * loss)
    for parts in (changed, all_fluid(changed, F.e_core), replace(changed, fluid=0.0, inner=0.0)):
        found = transfer(parts, np.array(-1.0), OBSERVED)
        expected = (e / (1 + e)) / EARTH.dynamical_flattening
        assert abs(found - expected) < 1e-13 * expected


@given(st.floats(-1.2, -0.8))
def test_a_rigid_body_has_transfer_one(sigma: float) -> None:
    bound = replace(WHOLE, e=OBSERVED, fluid=0.0, inner=0.0, inertia=np.zeros((3, 3)))
    assert abs(transfer(bound, np.array(sigma), OBSERVED) - 1) < 1e-13


def test_the_transfer_function_is_the_sum_of_its_modes() -> None:
    """Partial fractions of the four by four, beside the linear solution."""
    parts = replace(WHOLE, e=OBSERVED, k_cmb=2e-5 - 2e-5j, k_icb=1e-3 - 8e-4j)
    p, q, right, left = system(parts)
    values, vectors = np.linalg.eig(np.linalg.solve(p, -q))
    sigma = -1 + np.concatenate([-np.geomspace(1e-4, 0.1, 40), np.geomspace(1e-4, 0.1, 40)])
    forced = np.linalg.solve(p, np.multiply.outer(right, sigma) + left[:, None])
    amplitudes = np.linalg.solve(vectors, forced) / (sigma - values[:, None])
    assert np.allclose((vectors @ amplitudes)[0], wobble_response(parts, sigma), rtol=2e-10, atol=0)


def test_a_core_in_a_rigid_mantle() -> None:
    """Poincare 1910: 1 + sigma = -e_f A/A_m, and the Eulerian wobble sped up by A/A_m."""
    rigid = all_fluid(replace(WHOLE, inertia=np.zeros((3, 3))), F.e_core)
    modes, mantle = free_modes(rigid), 1 - rigid.fluid
    nutation = 1 + modes["free_core_nutation"].real
    assert np.isclose(nutation, -F.e_core / mantle, rtol=1e-3, atol=0)
    assert np.isclose(modes["chandler_wobble"].real, F.e / mantle, rtol=4e-3, atol=0)


def momenta(w: Parts, x: np.ndarray, phi: complex) -> np.ndarray:
    """H, H_f, H_s over A Omega, in a frame that turns with the mantle."""
    m, m_f, m_s, n = x
    whole, fluid, inner = w.inertia @ np.array([m - phi, m_f, m_s])
    return np.array(
        [
            m + w.fluid * m_f + w.inner * m_s + whole + w.inner * w.a3 * w.e_s * n,
            w.fluid * (m + m_f) + fluid - w.inner * w.a1 * w.e_s * n,
            w.inner * (m + m_s) + inner + w.inner * w.e_s * n,
        ]
    )


def changes(w: Parts, x: np.ndarray, phi: complex) -> np.ndarray:
    """Rates of `momenta`, over A Omega2, by the torques of the module's words."""
    m, m_f, m_s, n = x
    whole, fluid, inner = momenta(w, x, phi)
    axial = np.array([1 + w.e, w.fluid * (1 + w.e_f), w.inner * (1 + w.e_s)])
    gyration = -1j * (np.array([whole, fluid, inner]) - axial * m)
    # torque on the bulge of the whole; of the fluid, w x (I w); of the inner core besides,
    # the pull on its excess
    on_whole = -1j * w.e * phi
    spin_f = m + m_f
    coupling = w.k_icb * w.inner * (m_f - m_s)
    on_fluid = 1j * (fluid - axial[1] * spin_f) - 1j * (w.k_cmb * w.fluid * m_f + coupling)
    own = inner + w.inner * (m_f - m_s)  # I_s times the spin of the fluid around it
    pull = w.inner * w.e_s * (w.a3 * (spin_f - phi) - (1 - w.a2) * n)
    on_inner = 1j * (own - axial[2] * spin_f) + 1j * pull + 1j * coupling
    return gyration + np.array([on_whole, on_fluid, on_inner])


@pytest.mark.parametrize("sigma", [-1.1, -1 - 1 / 460, -1 + 1 / 183.0, -0.5, 0.3, 0.002])
@pytest.mark.parametrize("coupling", [0.0, 0.05 - 0.02j])
def test_one_frequency_balances_momenta_and_torques(sigma: float, coupling: complex) -> None:
    """Four linear equations by unit vectors; large compliances, so that each element counts."""
    inertia = 0.1 * WHOLE.inertia / np.abs(WHOLE.inertia).max() + 0.01 * np.arange(9).reshape(3, 3)
    w = replace(WHOLE, inertia=inertia, k_cmb=coupling, k_icb=1j * coupling, e=0.03, e_f=0.02)

    def balance(x: np.ndarray, phi: float) -> np.ndarray:
        of_axis = x[2] + sigma * x[3]
        return np.array([*(1j * sigma * momenta(w, x, phi) - changes(w, x, phi)), of_axis])

    columns = np.array([balance(unit, 0.0) for unit in np.eye(4)]).T
    expected = np.linalg.solve(columns, -balance(np.zeros(4), 1.0))[0]
    found = wobble_response(w, np.array(sigma))
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=0)


@pytest.mark.slow
def test_motion_in_time_under_a_torque_of_one_frequency() -> None:
    """Angular momenta integrated in time, and the forced wobble read off: the transfer function.

    The matrices of `system` are not used. The free motions are read off together with it.
    """
    w = replace(WHOLE, e=OBSERVED)
    sigma = -1 + 1 / 183.0
    inertia = np.array([momenta(w, unit, 0.0) for unit in np.eye(4)]).T  # without phi
    tide = momenta(w, np.zeros(4), 1.0)

    def slope(t: float, x: np.ndarray) -> np.ndarray:
        phi = np.exp(1j * sigma * t)
        change = changes(w, x, phi) - tide * 1j * sigma * phi
        # four unknowns, three momenta, and dn/dt = i m_s... of the tilt: m_s = -sigma n
        rates = np.linalg.solve(inertia[:, :3], change - inertia[:, 3] * (-1j * x[2]))
        return np.array([*rates, -1j * x[2]])

    t = np.linspace(0.0, 2 * np.pi * 900, 6000)
    run = solve_ivp(slope, (0, t[-1]), np.zeros(4, complex), "DOP853", t, rtol=1e-11, atol=1e-13)
    free = list(free_modes(w).values())
    basis = np.exp(1j * np.multiply.outer(t, [sigma, *free]))
    forced = np.linalg.lstsq(basis, run.y[0], rcond=None)[0][0]
    assert abs(forced / wobble_response(w, np.array(sigma)) - 1) < 1e-6
