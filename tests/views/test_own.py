"""Answers with a trajectory, a torque or a question of the caller are drawn and written as well."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np

import earthspin
from earthspin.engine import Neglected, Question, part, public_call, setting
from earthspin.engine.variables import Variables, labels, measured
from earthspin.units import Number


class Falling(Question, word="falling", call="falling", table="falling", positional=("height",)):
    """Fall from a height."""

    height: Annotated[float, Number("m", "10 m")] = setting(10.0, doc="height")


class Fall(Variables, along=("time",)):
    """Height in time."""

    height_left = measured("m", "height above the ground")
    time = labels("time from the start", "s")


@part
def fall(height: float) -> Fall:
    """Compute the height in time."""
    time = np.linspace(0.0, 1.0, 11)
    return Fall(height_left=(height - 4.905 * time**2, np.full(11, 0.1)), time=time)


@part
def neglected() -> Neglected:
    """Effects that the fall neglects."""
    return Neglected(unknown="air")


falling = public_call(Falling, answer=fall, sections=(neglected,))


def test_a_question_from_outside_is_drawn_and_written(tmp_path: Path) -> None:
    answer = falling(20.0)
    (figure,) = answer.earthspin.plot()
    (ax,) = figure.axes
    assert ax.get_ylabel() == "height left (m)"
    assert ax.get_xlabel() == "time (s)"
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), answer.height_left)
    lines = answer.earthspin.to_csv(tmp_path / "fall.csv").read_text().splitlines()
    assert lines[0] == "time (s),height_left (m),height_left_error (m)"
    assert len(lines) == 12


def test_a_torque_of_the_caller_is_no_obstacle(tmp_path: Path) -> None:
    top = earthspin.Body(
        name="gyroscope",
        gm=6.6743e-11,
        radius=1.0,
        j2=0.1,
        dynamical_flattening=0.25,
        pole=(0.0, 1.2),
        spin_period=2.0,
    )
    answer = earthspin.rotation(
        "2000-01-01",
        "2000-01-01T00:01",
        "5 s",
        body=top,
        perturbers=[],
        torque=lambda t, q, omega: -0.01 * omega,
    )
    spin, _ = answer.earthspin.plot()
    # C dw/dt = -0.01 w with C = 0.4 kg m2: in a minute to exp(-1.5) of the first rate
    drawn = spin.axes[0].lines[2].get_ydata()
    assert abs(drawn[-1] / drawn[0] - np.exp(-1.5)) < 1e-6
    assert answer.earthspin.to_csv(tmp_path / "own.csv").read_text().startswith("time,attitude_w")


@dataclass(frozen=True)
class Passage:
    """A straight line at 20 km/s, at J2000.0 near the Earth and 45 degrees north of its equator."""

    centre: int = 399
    coverage: tuple[float, float] = (-math.inf, math.inf)

    def positions(self, days: np.ndarray) -> np.ndarray:
        return np.array([1.4e8, 0.0, 1.4e8]) + np.outer(86400 * days, [0.0, 2e4, 0.0])


def test_a_trajectory_of_the_caller_is_no_obstacle(tmp_path: Path) -> None:
    body = earthspin.MOON.replace(name="passing", position=Passage())
    answer = earthspin.torque_series("2000-01-01", "2000-01-02", "1 h", perturbers=[body])
    (figure,) = answer.earthspin.plot()
    declination = figure.axes[0].lines[0].get_ydata()
    np.testing.assert_array_equal(declination, answer.declination[:, 0])
    lines = answer.earthspin.to_csv(tmp_path / "own.csv").read_text().splitlines()
    assert "torque_magnitude (N m)" in lines[0]
