"""Legendre functions and completeness (I.9.3, I.9.4)."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike
from scipy.special import lpmv

from earthspin.errors import UndefinedError
from earthspin.mass import multipoles
from tests.mass.closeness import close
from tests.refusals import refused

#: Random functions; 600 in the full run.
CASES = 60

NODE, WEIGHT = np.polynomial.legendre.leggauss(32)


@pytest.mark.parametrize("m", [0, 1, 4])
def test_orthogonality_and_norm(m: int) -> None:
    """Gauss quadrature, exact for these polynomials (measured: 9e-15, the rule's own)."""
    values = multipoles.orthonormal_functions(29, NODE, m)
    assert close((values * WEIGHT) @ values.T, np.eye(30 - m), abs=5e-14)
    degrees = np.arange(m, 30)
    roots = np.sqrt([multipoles.legendre_norm(int(n), m) for n in degrees])
    assert close(values, lpmv(m, degrees[:, None], NODE) / roots[:, None], abs=3e-13)


def test_the_factor_f_and_its_inverse() -> None:
    assert multipoles.factorial_ratio(4, 2) == 360.0
    assert multipoles.factorial_ratio(4, -2) == 1 / 360
    assert multipoles.factorial_ratio(7, 0) == 1.0
    for n, m in ((30, 30), (80, 80), (60, 41)):
        exact = mp.fac(n + m) / mp.fac(n - m)
        assert close(multipoles.factorial_ratio(n, m), float(exact), rel=2e-15)


def _kernel(n_max: int, z: ArrayLike, other: np.ndarray, m: int = 0) -> np.ndarray:
    """Sum over n of P_nm(z) P_nm(z')/K_nm, which tends to delta(z - z')."""
    one, two = (
        multipoles.orthonormal_functions(n_max, np.broadcast_to(x, other.shape), m)
        for x in (z, other)
    )
    return np.asarray(np.sum(one * two, axis=0))


@given(st.integers(0, 3), st.integers(0, 6), st.floats(-0.99, 0.99))
def test_the_kernel_gives_a_function_back(m: int, extra: int, z: float) -> None:
    """Completeness: its integral against P_nm of any degree within its own is P_nm itself.

    Measured: 1.2e-14.
    """
    n = m + extra
    back = np.sum(WEIGHT * _kernel(m + 6, z, NODE, m) * lpmv(m, n, NODE))
    scale = np.sqrt(multipoles.legendre_norm(n, m))
    assert close(back, float(lpmv(m, n, z)), abs=1e-13 * scale)


def test_the_kernel_gathers_at_its_point() -> None:
    """(I.9.4) by Christoffel and Darboux, and it grows there as the degree."""
    n, z = 40, np.array([-0.7, 0.1, 0.62])
    other = 0.3
    p = lpmv(0, np.array([n, n + 1])[:, None], np.append(z, other))
    closed = (n + 1) / 2 * (p[1, :3] * p[0, 3] - p[0, :3] * p[1, 3]) / (z - other)
    assert close(_kernel(n, z, np.full(3, other)), closed, abs=1.5e-14)
    peak = _kernel(n, np.array(other), np.array(other))
    assert close(peak, (n + 1) / (np.pi * np.sqrt(1 - other**2)), rel=0.05)


def _fifty_digits(n: int, m: int, z: float) -> mp.mpf:
    """P_nm by the recurrence in the degree, unnormalised."""
    p = mp.mpf(1)
    for k in range(1, m + 1):
        p *= -(2 * k - 1) * mp.sqrt(1 - mp.mpf(z) ** 2)
    before = mp.mpf(0)
    for k in range(m + 1, n + 1):
        before, p = p, ((2 * k - 1) * mp.mpf(z) * p - (k + m - 1) * before) / (k - m)
    return p


def test_functions_against_fifty_digits() -> None:
    """Degrees to 60, orders to 12, z up to 1e-9 from the ends, as far as z itself determines it.

    Measured over 600: 0.4 of the bound, two units of z plus 2e-14.
    """
    rng = np.random.default_rng(2)
    for _ in range(CASES):
        m, extra = int(rng.integers(0, 12)), int(rng.integers(0, 50))
        z = float(rng.choice([-1, 1]) * (1 - 10 ** rng.uniform(-9, 0)))
        root = mp.sqrt(mp.mpf(multipoles.legendre_norm(m + extra, m)))
        with mp.workdps(50):
            exact = _fifty_digits(m + extra, m, z) / root
            moved = _fifty_digits(m + extra, m, float(np.nextafter(z, 0))) / root
        found = mp.mpf(float(multipoles.orthonormal_functions(m + extra, z, m)[-1]))
        assert abs(found - exact) <= 2 * abs(moved - exact) + 2e-14


test_what_has_no_value = refused(
    (lambda: multipoles.legendre_norm(2, 3), "order m = 3 exceeds the degree n = 2"),
    (lambda: multipoles.legendre_norm(-1), "degree n = -1"),
    (lambda: multipoles.orthonormal_functions(1, 1.5), r"z = 1\.5 is outside -1 to 1"),
    (lambda: multipoles.orthonormal_functions(0, np.nan), "z = nan"),
    (lambda: multipoles.factorial_ratio(150, 150), "exceeds 1e308"),
    (lambda: multipoles.orthonormal_functions(2.5, 0.1), r"degree n = 2\.5"),
    kind=UndefinedError,
)
