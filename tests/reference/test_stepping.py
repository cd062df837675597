"""Step-by-step integration as the solvers of the checks share it."""

import numpy as np
import pytest

from earthspin.errors import UndefinedError
from earthspin.numerics import quaternion
from tests.reference.stepping import integrate, quaternion_rate


@pytest.mark.parametrize("times", [[0.5, 2.0], [2.0]])
def test_an_integration_that_does_not_reach_the_end_is_refused(times: list[float]) -> None:
    # y' = y^2 from 1 is 1/(1 - t)
    with pytest.raises(UndefinedError, match="the integration stopped"), np.errstate(all="ignore"):
        integrate(lambda _, y: y * y, [1.0], np.array(times), 1e-8)


def test_states_along_the_first_dimension_from_a_start_before_the_times() -> None:
    states, evaluations = integrate(
        lambda t, y: [y[1], -y[0]], [1.0, 0.0], np.array([2.0, 3.0]), 1e-12, begin=1.0
    )
    assert np.allclose(states, [[np.cos(t), -np.sin(t)] for t in (1.0, 2.0)], rtol=0, atol=1e-10)
    assert evaluations > 0


def test_the_rate_of_an_attitude_is_half_its_product_with_the_spin() -> None:
    q, omega = np.array([0.1, 0.7, -0.5, 0.5]), np.array([0.3, -1.1, 2.0])
    expected = quaternion.multiply(q, np.array([0.0, *omega])) / 2
    assert np.allclose(quaternion_rate(q, omega), expected, rtol=0, atol=1e-15)
