"""Products of quaternions."""

import math
from fractions import Fraction

import numpy as np
import pytest

from earthspin.numerics import quaternion
from tests.extreme import Distances, holds


@pytest.mark.slow
@holds(bound=2e-11)
def test_products() -> Distances:
    """norm of a quaternion after 10^5 products

    Hard because: each product is rounded, and the quaternion is never normalized
    Compared with: rotation by 10^5 times the angle
    """
    step = 2 * np.pi * 12345.25 / 1e5
    factor = quaternion.rotation_about_z(np.array(step / 2))
    product = np.array([1.0, 0.0, 0.0, 0.0])
    for _ in range(100_000):
        product = quaternion.multiply(factor, product)
    exact = float(Fraction(step / 2) * 100_000)
    yield np.hypot(product[0] - math.cos(exact), product[3] - math.sin(exact))
