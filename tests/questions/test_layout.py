"""Which number stands under which label: times, upper and lower, days of a table."""

import numpy as np
import pytest

import earthspin
from earthspin.scenes import Scene

RACKET = {"moments": [1.0, 2.0, 2.8], "omega": [0.01, 1.0, 0.2]}


def test_a_motion_has_its_first_and_last_time() -> None:
    scene = Scene(compute="free-rotor", rotor={**RACKET, "duration": "10 s", "points": 5})
    assert earthspin.run(scene).time.values.tolist() == [0.0, 2.5, 5.0, 7.5, 10.0]


def test_the_upper_turning_angle_is_the_smaller() -> None:
    top = earthspin.heavy_top(
        np.linspace(0.0, 30.0, 3001),
        transverse_moment=1,
        axial_moment=1.2,
        weight_moment=1.5,
        theta="40 deg",
        spin=3,
        phi_rate=0.3,
    )
    turning = earthspin.run_tree(top, "turning")["turning"].turning_angle
    assert float(turning.sel(turning="upper")) == pytest.approx(float(top.theta.min()), abs=1e-4)
    assert float(turning.sel(turning="lower")) == pytest.approx(float(top.theta.max()), abs=1e-4)


def test_a_daily_table_is_dated_at_midnight() -> None:
    """C04 begins on 1962-01-01, 0h."""
    time = earthspin.polar_motion(span=("1962-01-01", "1963-01-01")).time.values
    assert time[0] == np.datetime64("1962-01-01T00:00")
    assert np.all(
        time == np.datetime64("1962-01-01T00:00") + np.arange(366) * np.timedelta64(1, "D")
    )
