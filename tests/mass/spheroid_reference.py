"""The textbook's spheroid at 80 digits, where its arctangents can afford to cancel.

Shares nothing with the kernels: confocal coordinate by the quadratic in lambda, attraction by
differencing closed forms (MacMillan 1930, The Theory of the Potential, sections 35 to 39).
"""

from collections.abc import Callable

import mpmath as mp
import numpy as np

DIGITS = 80
FAMILIES = ("oblate", "prolate", "near-sphere", "near-disc", "needle")
PLACES = ("inside", "surface", "near", "far", "axis", "focus")


def textbook(body: tuple[float, ...]) -> list[mp.mpf]:
    """Potential, A1, A3 and torque factor (3/2) (A3 - A1) z for GM = 1 and (a, f, x, y, z)."""
    with mp.workdps(DIGITS):
        a, f, x, y, z = map(mp.mpf, body)
        c = a * (1 - f)
        across, along = x**2 + y**2, z**2
        root = mp.mpf(0)
        if across / a**2 + along / c**2 > 1:
            half = (across + along - a**2 - c**2) / 2
            rest = a**2 * c**2 - across * c**2 - along * a**2
            root = half + mp.sqrt(half**2 - rest)
        u, t, e2 = a**2 + root, c**2 + root, a**2 - c**2
        if e2 == 0:
            i0, a1, a3 = 2 / mp.sqrt(t), 2 / (3 * t**1.5), 2 / (3 * t**1.5)
        else:
            e = mp.sqrt(abs(e2))
            i0 = 2 / e * (mp.atan(e / mp.sqrt(t)) if e2 > 0 else mp.atanh(e / mp.sqrt(t)))
            a1 = (i0 / 2 - mp.sqrt(t) / u) / e2
            a3 = (2 / mp.sqrt(t) - i0) / e2
        potential = -mp.mpf(3) / 4 * (i0 - a1 * across - a3 * along)
        return [potential, a1, a3, mp.mpf(3) / 2 * (a3 - a1) * z]


def one_ulp(body: tuple[float, ...], values: list[mp.mpf]) -> list[float]:
    """How far one unit in the last place of each input, added up, moves each value, relatively."""
    total = [0.0] * len(values)
    for i, number in enumerate(body):
        moved = list(body)
        moved[i] = float(np.nextafter(number, -np.inf))
        for k, (there, here) in enumerate(zip(textbook(tuple(moved)), values, strict=True)):
            total[k] += abs(float((there - here) / here)) if here else 0.0
    return total


def draw(rng: np.random.Generator, family: str, place: str) -> tuple[float, ...]:
    """A random spheroid of a family and a point at a place: a, f, x, y, z."""

    def log_uniform(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    flattenings: dict[str, Callable[[], float]] = {
        "oblate": lambda: rng.uniform(1e-3, 0.95),
        "prolate": lambda: -log_uniform(1e-3, 1e2),
        "near-sphere": lambda: rng.choice([-1, 1]) * log_uniform(1e-13, 1e-3),
        "near-disc": lambda: 1 - log_uniform(2e-16, 0.05),
        "needle": lambda: -log_uniform(1e2, 1e6),
    }
    f = float(flattenings[family]())
    a = log_uniform(1.0, 1e9)
    c = a * (1 - f)
    direction = rng.normal(size=3)
    if place == "axis":
        direction = np.array([[1e-9, 0, 1], [0.6, 0.8, 1e-9]][rng.integers(2)])
    direction /= np.linalg.norm(direction)
    if place == "focus":  # just outside the equator's edge or the needle's tip
        tilt, beyond = rng.choice([-1, 1]) * log_uniform(1e-6, 0.1), 1 + log_uniform(1e-9, 0.1)
        along, across = (np.sin(tilt), np.cos(tilt)) if f > 0 else (np.cos(tilt), np.sin(tilt))
        point = beyond * np.array([a * across, 0.0, c * along])
    elif place == "far":
        point = direction * a * log_uniform(10, 1e6)
    else:
        surface = 1 / np.linalg.norm(direction / [a, a, c])
        factors: dict[str, Callable[[], float]] = {
            "inside": lambda: rng.uniform(0.01, 0.99),
            "surface": lambda: 1 + rng.choice([0, 1e-15, -1e-15, 1e-9, -1e-9]),
            "near": lambda: 1 + log_uniform(1e-6, 10),
            "axis": lambda: 1 + log_uniform(1e-6, 1e6),
        }
        point = direction * surface * factors[place]()
    return (a, f, *map(float, point))


def spheroid_zonals(flattening: float, n_max: int) -> np.ndarray:
    """J_n of a homogeneous spheroid: J_2k = (-1)^(k+1) 3 e^2k/[(2k + 1)(2k + 3)], J0 = -1."""
    e2 = flattening * (2 - flattening)
    zonals = np.zeros(n_max + 1)
    for k in range(n_max // 2 + 1):
        zonals[2 * k] = -3 * (-e2) ** k / ((2 * k + 1) * (2 * k + 3))
    return zonals
