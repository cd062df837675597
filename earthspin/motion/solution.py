r"""The whole attitude of a rigid body in time, with its error.

The error is seen by doing it twice, in two forms and two lengths of step: Euler's equations along
the body's axes in windows twice as long, and the angular momentum along the sky's axes in these
halved. What separates them at each time is a bound on the second, because halving a window of n
nodes divides its error by some 2^2n; where the motion is chaotic it grows as any error does.
What an uncertain number does is seen from a neighbour that has it changed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from earthspin.motion.equations import FLATTENING, PULL, ROUNDING, TRIAXIALITY, Rigid
from earthspin.motion.march import (
    CONVERGED,
    FINEST,
    ORDER,
    Above,
    Piece,
    Solver,
    halved,
)
from earthspin.numerics import turns

FloatArray = NDArray[np.float64]

#: A motion that is asked for at its start alone is followed so far, s.
SHORTEST = 1e-6
#: The same share for the halved windows. Their rounds begin with what the others found, and have to
#: go on long enough to leave it: with 1e-2 they were off by up to three times what is claimed.
_FINE = 1e-4 * CONVERGED
_EPS = float(np.finfo(float).eps)
#: What is claimed of what separates the two ways: rounding errors of both may be alike in size.
TWICE = 2.0
#: What a window may be off by, of what is asked for of the whole; and the coarsest, so that
#: windows stay shorter than a turn.
_SHARE, COARSEST = 1e-4, 1e-6
#: Errors: of the attitude, rad; of the spin, rad/s; of the angular momentum, C u.
KINDS = ("attitude", "omega", "angular_momentum")


@dataclass(frozen=True)
class State:
    """Angular momentum and attitude at a time, one for each lane.

    Attributes
    ----------
    momentum : ndarray, shape (3, lanes)
        In units of C u, along the body's axes.
    attitude : ndarray, shape (4, lanes)
        Unit quaternion (w, x, y, z), from the axes of the body to those of the sky.
    spin : ndarray, shape (3, lanes)
        Along the body's axes, rad/s.
    """

    momentum: FloatArray
    attitude: FloatArray
    spin: FloatArray


@dataclass(frozen=True)
class RotationSeries:
    """Rotation at some times, with its error.

    Attributes
    ----------
    momentum : ndarray, shape (t, 3)
        In units of C u, along the sky's axes.
    attitude : ndarray, shape (t, 4)
        Unit quaternion, from the axes of the body to those of the sky.
    omega : ndarray, shape (t, 3)
        Along the body's axes, rad/s.
    error : ndarray, shape (lanes, 3, t)
        Largest so far, by `KINDS`: of the method, then what the neighbour in each further lane is
        away by.
    """

    momentum: FloatArray
    attitude: FloatArray
    omega: FloatArray
    error: FloatArray


def start_of(body: Rigid, attitude: FloatArray, omega: FloatArray) -> State:
    """State of a body and its neighbours that start alike.

    Parameters
    ----------
    body : Rigid
    attitude : ndarray, shape (4,)
        From its axes to the sky's; only its direction counts.
    omega : ndarray, shape (3,)
        Along its axes, rad/s.
    """
    spin = np.repeat(omega[:, np.newaxis], body.lanes, axis=1)
    q = np.repeat((attitude / np.linalg.norm(attitude))[:, np.newaxis], body.lanes, axis=1)
    return State(momentum=body.moments * spin / body.unit, attitude=q, spin=spin)


def tolerance_for(accuracy: float | None) -> float:
    """Tolerance of windows that keeps an error of the attitude over many turns, if any does.

    Parameters
    ----------
    accuracy : float or None
        rad; None asks for the finest.
    """
    return FINEST if accuracy is None else min(max(FINEST, _SHARE * accuracy), COARSEST)


class Motion:
    """A motion from its start onward; what is past is forgotten, so that no length is too long.

    Parameters
    ----------
    body : Rigid
        The body, and in further lanes its neighbours: the same with an uncertain number changed.
    above : Above
    start : State
    end : float
        Last time, s from the start.
    tolerance : float
        Share of the last terms in the windows that are twice as long.
    order : int
        Nodes in a window.

    Raises
    ------
    UndefinedError
        If windows become so short that the motion runs away.
    """

    def __init__(
        self,
        body: Rigid,
        above: Above,
        start: State,
        end: float,
        *,
        tolerance: float = FINEST,
        order: int = ORDER,
    ) -> None:
        self._body, self._above, self._start = body, above, start
        self._end = max(end, SHORTEST)
        self._tolerance, self._order = tolerance, order
        self._restart()

    def _restart(self) -> None:
        start, body, how = self._start, self._body, (self._tolerance, self._order)
        self._fine = Solver(body, self._above, True, *how, converged=_FINE)
        self._coarse = Solver(body.first(), self._above, False, *how)
        self._coarse.begin_with(start.spin)
        speed = float(np.max(np.sqrt(np.sum(start.spin**2, axis=0))))
        self._rounding = _EPS * speed * self._end
        self._pieces = self._march(
            np.concatenate([turns.rotated(start.attitude, start.momentum), start.attitude]),
            np.concatenate([start.momentum, start.attitude])[:, :1],
        )
        self._now: tuple[Piece, Piece] | None = None
        self._asked = 0.0
        self._worst = np.zeros((body.lanes, len(KINDS), 1))

    @property
    def order(self) -> int:
        """Nodes in a window."""
        return self._order

    @property
    def evaluations(self) -> int:
        """Nodes at which rates were evaluated so far, those of the error among them."""
        return self._order * (self._fine.evaluations + self._coarse.evaluations)

    def _march(self, fine: FloatArray, coarse: FloatArray) -> Iterator[tuple[Piece, Piece]]:
        """Batches of windows, long and halved, from the start to the end."""
        reached = 0.0
        while True:
            rough = self._coarse.through(self._coarse.next_edges(reached, self._end), coarse)
            if len(rough.edges) < 2:
                continue
            exact = self._fine.through(halved(rough.edges), fine, rough)
            if exact.edges[-1] < rough.edges[-1]:
                self._coarse.window /= 2
                continue
            coarse, fine, reached = rough.end, exact.end, float(rough.edges[-1])
            yield rough, exact
            if reached >= self._end:
                return

    def at(self, times: FloatArray, tell: Callable[[float], None] | None = None) -> RotationSeries:
        """The rotation at some times, with its error.

        Parameters
        ----------
        times : ndarray, shape (t,)
            From the start, s, ascending; if they go back, the motion is made again.
        tell : callable, optional
            Called with the time that is reached, s, after each batch of windows.

        Returns
        -------
        RotationSeries
        """
        if times[0] < self._asked:
            self._restart()
        self._asked = float(times[-1])
        states, errors, done = [], [], 0
        while done < times.size:
            if self._now is None or times[done] > self._now[1].edges[-1]:
                if self._now is not None:
                    self._worst = self._errors_until(self._now[0].edges)[..., -1:]
                self._now = next(self._pieces)
                if tell is not None:
                    tell(float(self._now[1].edges[-1]))
            upto = int(np.searchsorted(times, self._now[1].edges[-1], side="right"))
            part = times[done:upto]
            states.append(self._now[1].at(part)[:, 0])
            errors.append(self._errors_at(part))
            done = upto
        state = np.concatenate(states, axis=1)
        return RotationSeries(
            momentum=state[:3].T,
            attitude=state[3:].T,
            omega=self._body.first().spin(state).T,
            error=np.concatenate(errors, axis=2),
        )

    def _errors_at(self, times: FloatArray) -> FloatArray:
        """Largest errors at the edges of windows before some times, and at these."""
        assert self._now is not None
        edges = self._now[0].edges
        before = self._errors_until(edges)[..., np.clip(np.searchsorted(edges, times) - 1, 0, None)]
        return np.maximum(before, self._errors(times))

    def _errors_until(self, edges: FloatArray) -> FloatArray:
        """Largest errors so far at the edges of the present windows."""
        return np.maximum(np.maximum.accumulate(self._errors(edges), axis=2), self._worst)

    def _errors(self, times: FloatArray) -> FloatArray:
        """Errors at times in the present windows, shape (lanes, kinds, t)."""
        assert self._now is not None
        rough, exact = self._now
        states = exact.at(times)
        other = rough.along_sky(times)
        method = TWICE * apart(self._body.first(), states[:, 0], other)
        method += np.array([self._rounding + _EPS] + [0.0] * 2)[:, np.newaxis]
        shares = [
            apart(self._body, states[:, 0], states[:, lane]) for lane in range(1, states.shape[1])
        ]
        return np.stack([method, *shares])


def shares_of(
    series: RotationSeries, changed: Sequence[str], doubt: float
) -> dict[str, FloatArray]:
    """Errors of a rotation by where they come from, each of shape (3, t).

    Parameters
    ----------
    series : RotationSeries
    changed : sequence of str
        What each further lane has changed.
    doubt : float
        Of the pull; NaN if it was never measured.

    Returns
    -------
    dict of str to ndarray
        ``method``, ``input`` and ``kernel``, and all of them together under an empty name; an angle
        is at most half a turn.
    """
    nothing = np.zeros_like(series.error[0])
    by_name = dict(zip(changed, series.error[1:], strict=True))
    kernel = np.full_like(nothing, np.nan) if np.isnan(doubt) else by_name.get(PULL, nothing)
    given = np.hypot(by_name.get(FLATTENING, nothing), by_name.get(TRIAXIALITY, nothing))
    method = series.error[0] + by_name.get(ROUNDING, nothing)
    shares = {"method": method, "input": given, "kernel": kernel}
    shares[""] = np.sqrt(shares["method"] ** 2 + given**2 + kernel**2)
    for share in shares.values():
        share[0] = np.minimum(share[0], np.pi)
    return shares


def apart(body: Rigid, one: FloatArray, other: FloatArray) -> FloatArray:
    """Angle between attitudes (rad), and lengths of the differences of spin and angular momentum.

    Parameters
    ----------
    body : Rigid
        Of the first lane.
    one, other : ndarray, shape (7, t)
        Angular momentum along the sky's axes, in units of C u, and attitude.

    Returns
    -------
    ndarray, shape (3, t)
        By `KINDS`: rad, rad/s, C u.
    """
    spin = body.first().spin(one) - body.first().spin(other)
    momentum = one[:3] - other[:3]
    return np.stack(
        [
            turns.angle_between(one[3:], other[3:]),
            np.sqrt(np.sum(spin * spin, axis=0)),
            np.sqrt(np.sum(momentum * momentum, axis=0)),
        ]
    )
