r"""Divergence of neighbouring rotations of a body: growth, Lyapunov exponent, test for chaos.

A neighbour starts at a small distance and is moved back to this distance, in its current direction,
at the end of each batch of windows (Benettin et al. 1976, 1980). The sum of the logarithms of the
factors grows as lambda t for a chaotic motion, and as log t for a regular motion. The rate is the
mean over equal parts of the span; their scatter gives its uncertainty.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import t as students_t

from earthspin.motion.equations import Rigid
from earthspin.motion.march import Masses, Solver
from earthspin.motion.solution import State
from earthspin.numerics import rotations
from earthspin.numerics.arrays import FloatArray

#: Distance of the neighbour, rad; nonlinear terms are smaller by this factor.
ASIDE = 1e-7
#: Tolerance of a window; it may be larger for a rate than for a phase.
TOLERANCE = 1e-11
#: Number of windows between rescalings of the neighbour.
WINDOWS = 4
#: Number of equal parts of the span whose rates are compared. The first part, in which the
#: neighbour approaches the fastest growing direction, is not used.
STRETCHES = 9
#: Growth in the second half of the span, as a natural logarithm, above which the motion is chaotic;
#: for distances that grow as t or t^2 it is 0.7 or 1.4.
CHAOTIC = 4.0


@dataclass(frozen=True)
class Divergence:
    """Growth of the distance between two initially close rotations of a body, in time.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times from the start, s.
    growth : ndarray, shape (n,)
        Natural logarithm of the distance divided by the initial distance.
    """

    times: FloatArray
    growth: FloatArray

    @property
    def rate(self) -> tuple[float, float]:
        """Mean growth rate (Lyapunov exponent) of the distance, and its 95 % half-width, 1/s."""
        edges = np.linspace(self.times[0], self.times[-1], STRETCHES + 1)
        rates = (np.diff(np.interp(edges, self.times, self.growth)) / np.diff(edges))[1:]
        spread = students_t.ppf(0.975, rates.size - 1) * rates.std(ddof=1) / np.sqrt(rates.size)
        return float(rates.mean()), float(spread)

    @property
    def is_chaotic(self) -> bool:
        """Return True if the distance between the two rotations grows exponentially."""
        middle = (self.times[0] + self.times[-1]) / 2
        rate, spread = self.rate
        second_half_growth = self.growth[-1] - np.interp(middle, self.times, self.growth)
        return bool(second_half_growth > CHAOTIC and rate > spread)

    def at(self, times: FloatArray) -> FloatArray:
        """Natural logarithm of distance over initial distance, interpolated at times in s."""
        return np.asarray(np.interp(times, self.times, self.growth))


def divergence(
    body: Rigid, masses: Masses, start: State, end: float, direction: int = 0
) -> Divergence:
    """Integrate two slightly different rotations of a body, and measure how fast they diverge.

    Parameters
    ----------
    body : Rigid
        Body, of which the first column is used.
    masses : Masses
    start : State
        Initial state, of which the first column is used.
    end : float
        Last time, s from the start.
    direction : int
        Axis of the sky about which the neighbour is rotated.
    """
    solver = Solver(body.first(copies=2), masses, True, TOLERANCE)
    solver.begin_with(start.spin)
    q, momentum = start.attitude[:, :1], start.momentum[:, :1]
    state = np.concatenate([rotations.rotated(q, momentum), q, start.core[:, :1]])
    rotation = np.zeros((3, 1))
    rotation[direction] = ASIDE
    pair = _neighbour_pair(state, rotation, np.zeros((3, 1)))
    times, growth, reached = [0.0], [0.0], 0.0
    while reached < end:
        solution = solver.integrate(solver.next_edges(reached, end, WINDOWS), pair)
        if len(solution.edges) < 2:
            continue
        reached = float(solution.edges[-1])
        rotation, change, distance = _distance(solution.end)
        scale = ASIDE / distance
        pair = _neighbour_pair(solution.end[:, :1], rotation * scale, change * scale)
        times.append(reached)
        growth.append(growth[-1] + float(np.log(distance / ASIDE)))
    return Divergence(np.array(times), np.array(growth))


def _neighbour_pair(state: FloatArray, rotation: FloatArray, momentum: FloatArray) -> FloatArray:
    """Return a state of rotation and a slightly different one, as columns, shape (7, 2).

    The neighbour has a small rotation and a relative change of the angular momentum, and the same
    core.
    """
    norm = np.sqrt(np.sum(state[:3] ** 2))
    quaternion = rotations.rotation_about(rotation, np.ones(1))
    other_momentum = state[:3] + momentum * (norm if norm else 1.0)
    turned = rotations.times(quaternion, state[3:7])
    other = np.concatenate([other_momentum, turned, state[7:]])
    return np.concatenate([state, other], axis=1)


def _distance(pair: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Difference of two states: rotation vector, relative momentum change, and combined norm."""
    state, other = pair[:, :1], pair[:, 1:]
    quaternion = 2 * rotations.times(other[3:7], rotations.conjugate(state[3:7]))
    rotation = quaternion[1:] * np.sign(quaternion[:1])
    norm = np.sqrt(np.sum(state[:3] ** 2))
    momentum = (other[:3] - state[:3]) / (norm if norm else 1.0)
    return rotation, momentum, float(np.sqrt(np.sum(rotation**2) + np.sum(momentum**2)))
