"""Stiff and extreme cases of the mathematics below the physics."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from earthspin.checks.case import Distances, holds
from earthspin.numerics import quaternion


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
