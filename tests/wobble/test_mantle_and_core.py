"""Mantle and core in closed form, against the eigenvalues of the equations as they stand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.errors import UndefinedError
from earthspin.interior.equilibrium import figure
from earthspin.interior.layers import PREM
from earthspin.interior.love import solve_love_numbers
from earthspin.interior.modes import all_fluid, free_modes, parts_of
from earthspin.wobble.ladder import FluidCore, Mantle, solve


def eigenvalues(mantle: Mantle, core: FluidCore) -> np.ndarray:
    """s of d/dt (M m + X n) = J (D m - X n), d/dt (a m + b n) = -f J n, by numpy, sorted."""
    water = np.zeros((2, 2)) if mantle.ocean is None else mantle.ocean
    deformation = mantle.kappa * np.eye(2) + water
    moments = (
        np.diag([1 - mantle.equatorial_ellipticity, 1 + mantle.equatorial_ellipticity])
        + deformation
    )
    differences = np.diag(
        [
            mantle.ellipticity + mantle.equatorial_ellipticity,
            mantle.ellipticity - mantle.equatorial_ellipticity,
        ]
    )
    quarter, unit = np.array([[0.0, -1.0], [1.0, 0.0]]), np.eye(2)
    x = core.fraction + core.xi
    left = np.block([[moments, x * unit], [(1 + core.gamma) * unit, (1 + core.beta) * unit]])
    right = np.block(
        [
            [quarter @ (differences - deformation), -x * quarter],
            [0 * unit, -(1 + core.ellipticity) * quarter],
        ]
    )
    s = np.linalg.eigvals(np.linalg.solve(left, right)) / 1j
    return np.asarray(s[np.argsort(s.real)])


@given(
    e=st.floats(1e-3, 0.5),
    triaxial=st.floats(0, 0.9),
    kappa=st.floats(0, 0.5),
    loss=st.floats(0, 0.01),
    water=st.tuples(*[st.floats(-0.02, 0.02)] * 3),
    fraction=st.floats(0.01, 0.6),
    core=st.tuples(*[st.floats(0, 5e-3)] * 4),
)
def test_against_eigenvalues(
    e: float,
    triaxial: float,
    kappa: float,
    loss: float,
    water: tuple[float, float, float],
    fraction: float,
    core: tuple[float, float, float, float],
) -> None:
    """Three axes, an ocean across them, loss, a core that yields: measured 1.2e-13 of the spin."""
    first, second, off = (w * e for w in water)
    mantle = Mantle(
        ellipticity=e,
        equatorial_ellipticity=triaxial * 0.4 * e,
        kappa=kappa * e * (1 - 1j * loss),
        ocean=np.array([[first, off], [off, second]]),
    )
    inside = FluidCore(fraction, *core)
    found = solve(mantle, inside)
    low, _, wobble, _ = eigenvalues(mantle, inside)
    # The core's root is the faster one unless a very flat mantle outruns it.
    pair = sorted([abs(low), abs(wobble)])
    # Rounding in the eigenvalues grows as two of them approach: 2e-16 over their distance measured,
    # and at most its root where they meet.
    allowed = 3e-13 + 5e-16 / max(pair[1] - pair[0], 2e-8)
    assert abs(abs(found.wobble) - pair[0]) < allowed
    assert abs(abs(found.core) - pair[1]) < allowed
    assert found.wobble.real > 0 > found.core.real


@pytest.mark.parametrize("mu_change", [0.0, -14 + 3j])
def test_it_is_a_case_of_the_system_of_all_parts(mu_change: complex) -> None:
    """The four by four with its inner core counted with the fluid, of PREM, with loss or not."""
    e, spin = 1 / 304.456, 7.292115e-5
    flat = figure(PREM, spin).e_core
    parts = all_fluid(parts_of(PREM, spin, solve_love_numbers(PREM, mu_change).response, e), flat)
    name = parts.compliances
    found = solve(
        Mantle(e, 0.0, name["kappa"]),
        FluidCore(parts.fluid, flat, gamma=name["gamma"], beta=name["beta"], xi=name["xi"]),
    )
    modes = free_modes(parts)
    assert abs(complex(found.wobble) - modes["chandler_wobble"]) < 1e-14
    assert abs(complex(found.core) - modes["free_core_nutation"]) < 1e-13


def test_without_loss_the_roots_are_real() -> None:
    found = solve(Mantle(3e-3, 1e-5, 1e-3), FluidCore(0.1, 2.5e-3))
    assert found.wobble.dtype == found.core.dtype == np.float64
    assert np.isinf(found.quality_factor)


def test_a_body_that_yields_by_more_than_one_of_its_bulges_is_refused() -> None:
    with pytest.raises(UndefinedError, match="turn over"):
        solve(Mantle(3e-3, 2.5e-3, 1e-3), FluidCore(0.1, 2.5e-3))
