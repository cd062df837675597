"""Elliptic functions against mpmath, from the circle to the separatrix."""

from typing import Any

import mpmath as mp
import numpy as np
import pytest

from earthspin.numerics.double_double import DoubleDouble, as_double_double
from earthspin.numerics.elliptic import (
    complete_third_kind,
    first_kind,
    jacobi,
    jacobi_sncndn,
    landen_descent,
    third_kind_mean,
    third_kind_periodic,
)

#: k', from far beyond any start's last digit to the circle.
MODULI = (1e-60, 1e-16, 1e-8, 1e-3, 0.1, 0.5, 0.9, 1 - 1e-9, 1.0)
#: Arguments in units of K.
PARTS = np.array([-1.0, -0.77, -0.2, 1e-9, 0.5, 0.999, 1.0])
DIGITS = 150


def worst(found: Any, wanted: list[Any]) -> float:
    """Largest difference, relative to the larger of the wanted and 1."""
    return max(
        float(abs(mp.mpf(float(f)) - w) / max(1, abs(w)))
        for f, w in zip(found, wanted, strict=True)
    )


@pytest.mark.parametrize("modulus", MODULI)
def test_sn_cn_dn_and_k(modulus: float) -> None:
    descent = landen_descent(as_double_double(np.array(modulus)))
    quarter = descent.quarter_period
    u = PARTS * float(quarter.hi)
    with mp.workdps(DIGITS):
        m = 1 - mp.mpf(modulus) ** 2
        exact = mp.ellipk(m)
        # measured: 2.5e-32
        assert abs(mp.mpf(float(quarter.hi)) + mp.mpf(float(quarter.lo)) - exact) < 2e-31 * exact
        upper, lower = jacobi(u, descent)
        k1 = (1 - mp.mpf(modulus)) / (1 + mp.mpf(modulus))
        for kind in ("sn", "cn", "dn"):
            wanted = [mp.ellipfun(kind, mp.mpf(x), m=m) for x in u]
            # measured: 4.4e-16, at arguments up to 139 too
            assert worst(getattr(upper, kind), wanted) < 2e-15
            v = [(1 + mp.mpf(modulus)) * mp.mpf(x) / 2 for x in u]
            wanted = [mp.ellipfun(kind, x, m=k1**2) for x in v]
            assert worst(getattr(lower, kind), wanted) < 2e-15


def test_separatrix() -> None:
    descent = landen_descent(as_double_double(np.array(0.0)))
    u = np.array([-np.inf, -800.0, -2.0, 0.0, 1e-3, 30.0, np.inf])
    upper, lower = jacobi(u, descent)
    assert descent.quarter_period.hi == 0
    for x, found in ((u, upper), (u / 2, lower)):
        wanted = [mp.sech(v) if np.isfinite(v) else mp.mpf(0) for v in x.tolist()]
        assert worst(found.sn, [mp.tanh(v) for v in x.tolist()]) < 3e-16
        assert worst(found.cn, wanted) < 3e-16
        assert worst(found.dn, wanted) < 3e-16


def test_small_cn_near_the_separatrix_keeps_its_digits() -> None:
    """The tail of sech, not only its top."""
    descent = landen_descent(as_double_double(np.array(1e-30)))
    u = np.array([1.0, 20.0, 40.0, 60.0])
    with mp.workdps(80):
        wanted = [mp.ellipfun("cn", mp.mpf(x), m=1 - mp.mpf(1e-30) ** 2) for x in u.tolist()]
        off = [float(abs(f / w - 1)) for f, w in zip(jacobi(u, descent)[0].cn, wanted, strict=True)]
    assert max(off) < 5e-14  # measured: 9e-15, a phase of 60 rounded


@pytest.mark.parametrize("modulus", MODULI)
def test_integral_of_the_first_kind(modulus: float) -> None:
    angle = np.array([-np.pi / 2, -1.5, -0.3, 1e-12, 0.7, 1.57])
    sine, cosine = np.sin(angle), np.cos(angle)
    found = first_kind(sine, cosine, np.full(6, modulus**2))
    with mp.workdps(DIGITS):
        m = 1 - mp.mpf(modulus**2)
        # The angle that sine and cosine stand for, not the one that they were made of.
        wanted = [
            mp.ellipf(mp.atan2(mp.mpf(s), mp.mpf(c)), m)
            for s, c in zip(sine.tolist(), cosine.tolist(), strict=True)
        ]
        assert worst(found, wanted) < 2e-15  # measured: 2.9e-16


def test_first_kind_on_the_separatrix() -> None:
    found = first_kind(np.array([-1.0, 0.6, 1.0]), np.array([0.0, 0.8, 0.0]), np.zeros(3))
    np.testing.assert_allclose(found, [-np.inf, np.log(2.0), np.inf], rtol=3e-16)


@pytest.mark.parametrize("n", [0.0, 1e-6, 0.3, 1.0])
@pytest.mark.parametrize("modulus", [1e-60, 1e-8, 0.1, 0.9, 1.0])
def test_integral_of_the_third_kind(modulus: float, n: float) -> None:
    descent = landen_descent(as_double_double(np.array(modulus)))
    mean = third_kind_mean(as_double_double(np.array(n)), descent)
    u = PARTS * float(descent.quarter_period.hi)
    _, lower = jacobi(u, descent)
    found = third_kind_periodic(u, lower, np.array(n), np.asarray(mean.hi), descent)
    with mp.workdps(DIGITS):
        m1 = ((1 - mp.mpf(modulus)) / (1 + mp.mpf(modulus))) ** 2
        quarter, scale = mp.ellipk(m1), (1 + mp.mpf(modulus)) / 2

        def integral(angle: Any) -> Any:
            """Of sn^2/(1 + n sn^2), by (F - Pi)/n or (F - E)/m."""
            if n == 0 and m1 == 0:
                return angle / 2 - mp.sin(2 * angle) / 4
            if n == 0:
                return (mp.ellipf(angle, m1) - mp.ellipe(angle, m1)) / m1
            return (mp.ellipf(angle, m1) - mp.ellippi(-mp.mpf(n), angle, m1)) / n

        whole = integral(mp.pi / 2) / quarter
        assert (
            abs(mp.mpf(float(mean.hi)) + mp.mpf(float(mean.lo)) - whole) < 2e-31 * whole
        )  # 2.6e-32
        v = [scale * mp.mpf(x) for x in u.tolist()]
        wanted = [
            integral(mp.asin(min(mp.mpf(1), max(mp.mpf(-1), mp.ellipfun("sn", x, m=m1)))))
            - whole * x
            for x in v
        ]
        off = max(abs(float(f - w)) for f, w in zip(found, wanted, strict=True))
        # measured: 4.2e-16 K, as of a difference of numbers of the size of K
        assert off < 2e-15 * float(quarter)


def test_third_kind_on_the_separatrix() -> None:
    """There the integral is u less a bounded part, (u - atan(sqrt(n) tanh u)/sqrt(n))/(1 + n)."""
    descent = landen_descent(as_double_double(np.array(0.0)))
    n, u = 0.3, np.array([-np.inf, -4.0, 0.0, 1.0, np.inf])
    _, lower = jacobi(u, descent)
    mean = third_kind_mean(as_double_double(np.array(n)), descent)
    found = third_kind_periodic(u, lower, np.array(n), np.asarray(mean.hi), descent)
    assert mean.hi == pytest.approx(1 / 1.3, rel=2e-16, abs=0)
    wanted = -np.arctan(np.sqrt(n) * np.tanh(u / 2)) / np.sqrt(n) / (1 + n)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=3e-16)


def test_moduli_of_all_sizes_together() -> None:
    moduli = np.array([0.0, 1e-12, 0.3, 1.0])
    many = landen_descent(as_double_double(moduli))
    u = np.array([[0.4, 1.3]] * 4)
    upper, _ = jacobi(u, many)
    for row, modulus in enumerate(moduli):
        alone, _ = jacobi(u[row], landen_descent(as_double_double(np.array(modulus))))
        np.testing.assert_allclose(upper.cn[row], alone.cn, rtol=1e-15)


def test_a_modulus_with_a_tail_counts_the_tail() -> None:
    """K of k' = 0.5 + 2^-80: the second part of the number is seen."""
    tail = landen_descent(DoubleDouble(np.array(0.5), np.array(2.0**-80))).quarter_period
    plain = landen_descent(as_double_double(np.array(0.5))).quarter_period
    with mp.workdps(50):
        kp = mp.mpf("0.5") + mp.mpf(2) ** -80
        step = mp.ellipk(1 - kp**2) - mp.ellipk(mp.mpf("0.75"))
        assert float((tail - plain).hi) == pytest.approx(float(step), rel=1e-6, abs=0)


# --- of plain floats -----------------------------------------------------------------------------


def test_functions_keep_their_digits_from_circle_to_separatrix() -> None:
    rng = np.random.default_rng(1)
    near_separatrix, near_circle = 10 ** rng.uniform(-30, 0, 60), 1 - 10 ** rng.uniform(-16, 0, 60)
    complement = np.concatenate([near_separatrix, near_circle])
    with mp.workdps(90):
        quarter = np.array([float(mp.ellipk(1 - mp.mpf(c))) for c in complement])
        argument = quarter / 2 * rng.uniform(-1, 1, 120)
        found = jacobi_sncndn(argument, complement)
        for kind, values in zip(("sn", "cn", "dn"), found, strict=True):
            exact = [
                mp.ellipfun(kind, mp.mpf(z), m=1 - mp.mpf(c))
                for z, c in zip(argument, complement, strict=True)
            ]
            off = [abs(float(v / e - 1)) for v, e in zip(values, exact, strict=True)]
            # measured 2.1e-15 near the separatrix, where a unit of the argument does as much
            assert max(off) < 6e-15, kind


def test_on_the_separatrix_the_functions_are_hyperbolic() -> None:
    argument = np.array([0.0, 0.7, -3.0, 900.0])
    sn, cn, dn = jacobi_sncndn(argument, np.array(0.0))
    np.testing.assert_allclose(sn, np.tanh(argument), rtol=2e-16)
    np.testing.assert_allclose(cn[:3], 1 / np.cosh(argument[:3]), rtol=2e-16)
    assert np.array_equal(cn, dn)


def test_the_complete_third_kind_holds_where_scipy_loses_three_digits() -> None:
    rng = np.random.default_rng(2)
    complement, shape = 10 ** rng.uniform(-20, 0, 200), 10 ** rng.uniform(-8, 6, 200)
    found = complete_third_kind(complement, shape)
    with mp.workdps(40):
        exact = [
            mp.elliprj(0, mp.mpf(c), 1, mp.mpf(s)) / 3
            for c, s in zip(complement, shape, strict=True)
        ]
        off = [abs(float(f / e - 1)) for f, e in zip(found, exact, strict=True)]
    assert max(off) < 3e-15  # measured 9e-16
