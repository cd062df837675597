"""Torque on Stokes coefficients, by turns of the potential."""

import math

import numpy as np
import pytest
from numpy.random import default_rng
from scipy.spatial.transform import Rotation
from scipy.special import lpmv

from earthspin.numerics.arrays import FloatArray
from earthspin.torque.harmonics import HarmonicsTorque


def energy(coefficients: dict[str, float], position: FloatArray) -> float:
    """Energy of a mass in units of G M m / a, by the associated Legendre functions of SciPy."""
    x, y, z = position
    r = float(np.linalg.norm(position))
    total = 0.0
    for name, value in coefficients.items():
        n, m = int(name[1]), int(name[2])
        legendre = (-1) ** m * lpmv(m, n, z / r)  # without the sign of Condon and Shortley
        phase = m * math.atan2(y, x)
        wave = math.cos(phase) if name[0] == "c" else math.sin(phase)
        total -= value * float(legendre) * wave / r ** (n + 1)
    return total


@pytest.mark.parametrize("degree", [3, 4, 5])
def test_the_torque_is_the_change_of_the_energy_in_a_turn(degree: int) -> None:
    random = default_rng(degree)
    names = [f"c{degree}{m}" for m in range(degree + 1)]
    names += [f"s{degree}{m}" for m in range(1, degree + 1)]
    field = {name: float(random.normal()) for name in names}
    position = random.normal(size=3)
    position *= 2.5 / np.linalg.norm(position)
    torque = HarmonicsTorque(field).at(position[:, np.newaxis])[:, 0]
    step = 1e-4
    for axis in range(3):
        # a turn of the body by +angle is a turn of the mass by -angle, in the body's axes
        turns = [Rotation.from_rotvec(-angle * np.eye(3)[axis]) for angle in (step, -step)]
        ahead, behind = (energy(field, turn.apply(position)) for turn in turns)
        assert torque[axis] == pytest.approx(-(ahead - behind) / (2 * step), rel=1e-6, abs=1e-9)
