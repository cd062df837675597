r"""How fast neighbouring rotations part: growth, Lyapunov time, and whether there is one.

A neighbour is started a little aside and brought back to that distance, along the direction it has
taken, at the end of each batch of windows (Benettin et al. 1976, 1980). The logarithm of what it
was divided by grows as lambda t where the motion is chaotic, and as log t where it is regular. The
rate is the mean over stretches of the span; their scatter tells how well it is known.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as students_t

from earthspin.motion.equations import Rigid
from earthspin.motion.march import Above, Solver
from earthspin.motion.solution import State
from earthspin.numerics import turns

FloatArray = NDArray[np.float64]

#: How far aside a neighbour is kept, rad; what is not linear is smaller by as much.
ASIDE = 1e-7
#: Tolerance of a window: a rate is wanted, not a phase.
TOLERANCE = 1e-11
#: Windows between two times of being brought back.
WINDOWS = 4
#: Equal stretches whose rates are compared; the first, in which the neighbour finds the direction
#: that grows fastest, is left out.
STRETCHES = 9
#: Growth in the last half of the span, in powers of e, that only chaos gives: where neighbours part
#: as t, or as t^2, it is 0.7 or 1.4.
CHAOTIC = 4.0


@dataclass(frozen=True)
class Divergence:
    """How neighbours part.

    Attributes
    ----------
    times : ndarray, shape (n,)
        From the start, s.
    growth : ndarray, shape (n,)
        Natural logarithm of the distance over that at the start.
    """

    times: FloatArray
    growth: FloatArray

    @property
    def rate(self) -> tuple[float, float]:
        """Mean rate of growth over the stretches and its 95 % half-width, 1/s."""
        edges = np.linspace(self.times[0], self.times[-1], STRETCHES + 1)
        rates = np.diff(np.interp(edges, self.times, self.growth)) / np.diff(edges)
        late = rates[1:]
        spread = students_t.ppf(0.975, late.size - 1) * late.std(ddof=1) / np.sqrt(late.size)
        return float(late.mean()), float(spread)

    @property
    def is_chaotic(self) -> bool:
        """Whether neighbours part faster than by any power of the time, within the span."""
        middle = (self.times[0] + self.times[-1]) / 2
        rate, spread = self.rate
        late = self.growth[-1] - np.interp(middle, self.times, self.growth)
        return bool(late > CHAOTIC and rate > spread)

    def at(self, times: FloatArray) -> FloatArray:
        """Growth at some times, s."""
        return np.asarray(np.interp(times, self.times, self.growth))


def divergence(
    body: Rigid, above: Above, start: State, end: float, direction: int = 0
) -> Divergence:
    """Follow a rotation and a neighbour of it.

    Parameters
    ----------
    body : Rigid
        Its first lane is followed.
    above : Above
    start : State
        The same.
    end : float
        Last time, s from the start.
    direction : int
        Axis of the body that the neighbour is turned about.
    """
    both = _twice(body)
    solver = Solver(both, above, True, TOLERANCE)
    solver.begin_with(start.spin)
    q, momentum = start.attitude[:, :1], start.momentum[:, :1]
    one = np.concatenate([turns.rotated(q, momentum), q])
    turn = np.zeros((3, 1))
    turn[direction] = ASIDE
    pair = _beside(one, turn, np.zeros((3, 1)))
    times, growth, reached = [0.0], [0.0], 0.0
    while reached < end:
        piece = solver.through(solver.next_edges(reached, end, WINDOWS), pair)
        if len(piece.edges) < 2:
            continue
        reached = float(piece.edges[-1])
        aside, carried, distance = _distance(piece.end)
        pair = _beside(piece.end[:, :1], aside * (ASIDE / distance), carried * (ASIDE / distance))
        times.append(reached)
        growth.append(growth[-1] + float(np.log(distance / ASIDE)))
    return Divergence(np.array(times), np.array(growth))


def _twice(body: Rigid) -> Rigid:
    """The first lane two times."""
    one = body.first()
    return replace(
        one,
        c_minus_a=np.repeat(one.c_minus_a, 2),
        c_minus_b=np.repeat(one.c_minus_b, 2),
        tide=np.repeat(one.tide, 2),
    )


def _beside(one: FloatArray, turn: FloatArray, momentum: FloatArray) -> FloatArray:
    """A state and its neighbour, turned and pushed along the sky's axes, shape (7, 2)."""
    size = np.sqrt(np.sum(one[:3] ** 2))
    other = np.concatenate(
        [
            one[:3] + momentum * (size if size else 1.0),
            turns.times(turns.turned_about(turn, np.ones(1)), one[3:]),
        ]
    )
    return np.concatenate([one, other], axis=1)


def _distance(pair: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Turn and relative push between the two, and their length together."""
    one, other = pair[:, :1], pair[:, 1:]
    turn = 2 * turns.times(other[3:], turns.conjugate(one[3:]))
    aside = turn[1:] * np.sign(turn[:1])
    size = np.sqrt(np.sum(one[:3] ** 2))
    carried = (other[:3] - one[:3]) / (size if size else 1.0)
    return aside, carried, float(np.sqrt(np.sum(aside**2) + np.sum(carried**2)))
