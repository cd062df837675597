"""Free wobble and its excitation."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import UAS
from earthspin.rotor.axisymmetric import free_wobble_period
from earthspin.wobble import excitation as equation
from earthspin.wobble.ladder import rigid_period
from tests.extreme import Distances, holds, relative_error

PERIOD = 433.0
DAYS = 64 * 365 + 16


def _round_trip(
    quality_factor: float, step: float = 1.0, size: int = DAYS
) -> Iterator[NDArray[np.complex128]]:
    """Compute polar motion from excitation and back, and yield the errors of both, mas.

    The original excitation is white noise of 30 mas.
    """
    s = equation.chandler_frequency(PERIOD, quality_factor)
    both = 30 * np.random.default_rng(1).standard_normal((2, size))
    chi = both[0] + 1j * both[1]
    p = equation.polar_motion_from(chi, step, s, 100 - 40j)
    again = equation.excitation(p, step, s)
    yield again - chi
    yield equation.polar_motion_from(again, step, s, p[0]) - p


@holds(bound=2e-11, unit="mas")
def test_no_loss() -> Distances:
    """free wobble without damping (infinite quality factor)

    Hard because: errors of the start never decay
    Compared with: excitation that produced the polar motion, and that polar motion, over 64 years
    """
    yield from _round_trip(np.inf)


@holds(bound=1e-11, unit="mas")
def test_all_loss() -> Distances:
    """free wobble with a quality factor of one half

    Hard because: the wobble decays within a period; the start decays to 1e-60
    Compared with: excitation that produced the polar motion, and that polar motion, over 64 years
    """
    yield from _round_trip(0.5)


@holds(bound=5e-12, unit="mas")
def test_resonant_step() -> Distances:
    """excitation of polar motion with time steps of exactly one free period

    Hard because: the pole returns to its position except for damping of 3 per cent, which
        determines the excitation
    Compared with: excitation that produced the polar motion, and that polar motion, over 400 steps
    """
    yield from _round_trip(100.0, step=PERIOD, size=400)


@holds(bound=1e-6, unit="mas")
def test_tiny_steps() -> Distances:
    """excitation of polar motion with time steps of one second

    Hard because: the pole moves by only 1e-7 of its distance in each step
    Compared with: excitation that produced the polar motion; the bound is rounding of the pole
        times 6e6
    """
    yield from _round_trip(100.0, step=1 / 86400, size=5000)


@holds(bound=0.0)
def test_sphere() -> Distances:
    """free wobble period of a sphere

    Hard because: (C - A)/A is zero and appears in a denominator
    Compared with: infinite period, and no NaN
    """
    yield free_wobble_period(0.0, 86164.0) != np.inf
    yield rigid_period(0.0) != np.inf


@holds(bound=5e-15)
def test_prolate() -> Distances:
    """free wobble periods of prolate and oblate bodies

    Hard because: the wobble of a prolate body is retrograde, but its period is positive
    Compared with: A/(C - A) rotations, relative, down to H = 1e-15
    """
    h = np.array([0.3, 3e-3, 1e-9, 1e-15])
    for sign in (1, -1):
        yield rigid_period(sign * h) * h / (1 - sign * h) - 1


@holds(bound=2e-14)
def test_microarcsecond() -> Distances:
    """excitation from a free wobble with an amplitude of one microarcsecond

    Hard because: it is the smallest amplitude that is ever resolved, in a pole given in arcseconds
    Compared with: excitation that produced the polar motion, relative to its size
    """
    s = equation.chandler_frequency(PERIOD, 100.0)
    chi = UAS * np.exp(0.3j * np.arange(2000.0))
    p = equation.polar_motion_from(chi, 1.0, s)
    yield relative_error(equation.excitation(p, 1.0, s), chi)
