"""Stiff and extreme cases of the mathematics below the physics."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from earthspin.checks.case import Distances, holds
from earthspin.numerics import quaternion
from earthspin.numerics.double_double import DoubleDouble, as_double_double, two_product, two_sum
from earthspin.numerics.elliptic import jacobi, landen_descent
from earthspin.numerics.kepler import eccentric_anomaly


@holds(bound=5e-15)
def _modulus_one() -> Distances:
    """elliptic functions as k tends to 1

    Hard because: 1 - k2 is 1e-300: k itself is the float 1
    Held against: tanh and sech, over what the last place of u does to them, and K = ln(4/k')
    """
    descent = landen_descent(as_double_double(np.array([1e-150])))
    u = np.array([[-30.0, -1.0, 0.0, 0.5, 7.0, 300.0]])
    (sn, cn, dn), _ = jacobi(u, descent)
    sech = 1 / np.cosh(u)
    yield sn - np.tanh(u)
    yield (cn / sech - 1) / (1 + np.abs(u))
    yield (dn / sech - 1) / (1 + np.abs(u))
    yield descent.quarter_period.hi[0] / math.log(4e150) - 1


@holds(bound=0.0)
def _exact_pairs() -> Distances:
    """double-double sums and products

    Hard because: the separatrix and late phases hang on what rounding takes away
    Held against: exact fractions: nothing may be lost of a sum or a product of two floats
    """
    rng = np.random.default_rng(2)
    a, b = rng.normal(size=200) * 10.0 ** rng.integers(-30, 30, 200), rng.normal(size=200)
    for x, y, *pairs in zip(a, b, *two_sum(a, b), *two_product(a, b), strict=True):
        sum_hi, sum_lo, product_hi, product_lo = (Fraction(p) for p in pairs)
        yield float(Fraction(x) + Fraction(y) - sum_hi - sum_lo)
        yield float(Fraction(x) * Fraction(y) - product_hi - product_lo)


@holds(bound=2e-31)
def _quotients() -> Distances:
    """double-double division and root

    Hard because: 32 digits must come out of operations that have 16
    Held against: exact fractions: (1/3) times 3 and the root of 2 squared, relative
    """
    third = as_double_double(1.0) / as_double_double(3.0)
    root = as_double_double(np.array(2.0)).sqrt()
    yield float(3 * _exact(third) - 1)
    yield float(_exact(root) ** 2 / 2 - 1)


def _exact(number: DoubleDouble) -> Fraction:
    return Fraction(float(number.hi)) + Fraction(float(number.lo))


@holds(bound=2e-11, slow=True)
def _products() -> Distances:
    """quaternion after 10^5 products

    Hard because: each product rounds, and nothing brings the length back
    Held against: the turn by 10^5 times the angle
    """
    step = 2 * np.pi * 12345.25 / 1e5
    one = quaternion.turn_about_z(np.array(step / 2))
    turn = np.array([1.0, 0.0, 0.0, 0.0])
    for _ in range(100_000):
        turn = quaternion.multiply(one, turn)
    exact = float(Fraction(step / 2) * 100_000)
    yield np.hypot(turn[0] - math.cos(exact), turn[3] - math.sin(exact))


@holds(bound=2e-15)
def _next_to_a_parabola() -> Distances:
    """Kepler's equation next to a parabola

    Hard because: e is 1 - 1e-12: near the pericentre M is a difference of nearly equal angles
    Held against: the angle whose mean anomaly was summed in exact fractions
    """
    e, eccentric = 1 - 1e-12, np.concatenate([10.0 ** np.arange(-12.0, 0.0), [1.5, 3.0]])
    mean = np.array([float(_mean_anomaly(angle, e)) for angle in eccentric])
    yield eccentric_anomaly(mean, np.array(e)) / eccentric - 1


def _mean_anomaly(angle: float, e: float) -> Fraction:
    """E - e sin(E), the sine by its series; the last term is below 1e-27 up to E = 3."""
    x = Fraction(angle)
    terms = [Fraction(x ** (2 * k + 1)) / math.factorial(2 * k + 1) for k in range(18)]
    sine = sum(terms[::2], Fraction()) - sum(terms[1::2], Fraction())
    return x - Fraction(e) * sine
