"""Random bodies and starts, by the kind of trouble that they make."""

import math
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from itertools import product
from typing import Any, NamedTuple

import numpy as np

UAS = math.pi / 648000e6


class Case(NamedTuple):
    """A body, as moments or as mapping, and a start."""

    moments: Any
    omega: list[float]


def generic(rng: np.random.Generator) -> Case:
    """Any body that can exist, its moments in any order."""
    while True:
        moments = rng.uniform(0.05, 1, 3)
        if 2 * moments.max() < moments.sum():
            return Case(moments.tolist(), rng.normal(size=3).tolist())


def earth_like(rng: np.random.Generator) -> Case:
    """Differences of 1e-3 to 1e-9 of the moments, cones of 1 uas to 89 degrees."""
    a = 8.0101e37
    oblateness = 10 ** rng.uniform(-9, -3)
    moments = {"A": a, "B-A": a * oblateness * rng.uniform(0, 1) ** 3, "C-A": a * oblateness}
    cone = math.exp(rng.uniform(math.log(UAS), math.log(math.radians(89))))
    return Case(moments, _cone(7.292115e-5, cone, rng.uniform(0, 2 * math.pi)))


def near_separatrix(rng: np.random.Generator) -> Case:
    """Relative distance of 1e-3 to 1e-14 from it, the middle axis near or far."""
    moments = generic(rng).moments
    low, mid, high = sorted(range(3), key=lambda axis: moments[axis])
    a, b, c = moments[low], moments[mid], moments[high]
    omega = [0.0] * 3
    omega[mid] = rng.normal()
    omega[low] = rng.choice([-1, 1]) * 10 ** rng.uniform(-8, 0)
    distance = rng.choice([-1, 1]) * 10 ** rng.uniform(-14, -3)
    omega[high] = omega[low] * math.sqrt(a * (b - a) / (c * (c - b))) * (1 + distance)
    return Case(moments, omega)


def on_separatrix(rng: np.random.Generator) -> Case:
    """Exactly on it: G2 = 2T B in whole numbers."""
    bodies = _separatrix_bodies()
    a, b, c, across, up = bodies[rng.integers(len(bodies))]
    scale, middle = 2.0 ** rng.integers(-20, 20), rng.normal()
    order = rng.permutation(3)
    moments, omega = np.zeros(3), np.zeros(3)
    moments[order], omega[order] = (a, b, c), (across, middle, up * rng.choice([-1, 1]))
    return Case(moments.tolist(), (scale * omega).tolist())


def near_sphere(rng: np.random.Generator) -> Case:
    """Differences of 1e-4 to 1e-15 of the moments, of either sign."""
    sizes = 10 ** rng.uniform(-15, -4) * rng.uniform(-1, 1, 2)
    return Case({"A": 1.0, "B-A": sizes[0], "C-A": sizes[1]}, rng.normal(size=3).tolist())


def axisymmetric(rng: np.random.Generator) -> Case:
    """Two moments equal to the last digit; oblate or prolate, about any axis."""
    axis, own = rng.integers(3), rng.uniform(0.01, 1.99)
    moments = np.ones(3)
    moments[axis] = own
    return Case((rng.uniform(0.1, 10) * moments).tolist(), rng.normal(size=3).tolist())


def nearly_axisymmetric(rng: np.random.Generator) -> Case:
    """Two moments that differ by 1e-6 to 1e-16."""
    moments = {
        "A": 1.0,
        "B-A": rng.choice([-1, 1]) * 10 ** rng.uniform(-16, -6),
        "C-A": rng.uniform(-0.99, 0.99),
    }
    return Case(moments, rng.normal(size=3).tolist())


def needle_or_leaf(rng: np.random.Generator) -> Case:
    """One moment 1e-2 to 1e-6 of the others, or two that add up to the third but for that."""
    small, mid = 10 ** rng.uniform(-6, -2), rng.uniform(0.3, 1)
    if rng.random() < 0.5:
        moments = [small, mid, mid + small * rng.uniform(-0.99, 0.99)]
    else:
        moments = [1.0, mid, (1 + mid) * (1 - small)]
    return Case(rng.permutation(moments).tolist(), rng.normal(size=3).tolist())


FAMILIES: dict[str, Callable[[np.random.Generator], Case]] = {
    "generic": generic,
    "earth-like": earth_like,
    "near the separatrix": near_separatrix,
    "on the separatrix": on_separatrix,
    "near the sphere": near_sphere,
    "axisymmetric": axisymmetric,
    "nearly axisymmetric": nearly_axisymmetric,
    "needle or leaf": needle_or_leaf,
}


def cases(family: str, count: int) -> Iterator[Case]:
    """The first `count` cases of a family, always the same."""
    rng = np.random.default_rng([20240229, list(FAMILIES).index(family)])
    for _ in range(count):
        yield FAMILIES[family](rng)


def _cone(speed: float, cone: float, longitude: float) -> list[float]:
    across = speed * math.sin(cone)
    return [across * math.cos(longitude), across * math.sin(longitude), speed * math.cos(cone)]


@cache
def _separatrix_bodies() -> list[tuple[int, int, int, int, int]]:
    """A, B, C and w1, w3 in whole numbers with C (C - B) w3^2 = A (B - A) w1^2."""
    found = []
    for a, b, c in product(range(1, 60), repeat=3):
        if a < b < c <= a + b:
            ratio = Fraction(c * (c - b), a * (b - a))
            p, q = math.isqrt(ratio.numerator), math.isqrt(ratio.denominator)
            if p * p == ratio.numerator and q * q == ratio.denominator:
                found.append((a, b, c, p, q))
    return found
