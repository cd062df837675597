r"""Windows of a rotation, solved one after another as long as their nodes allow.

Each holds a few Gauss-Legendre nodes; Picard's iteration brings the unknowns of
`earthspin.motion.equations` there to what their own rates integrate to. A window is as long as the
last Legendre terms of the rates allow, so that a fast passage is met with short ones. The sky is
asked for many windows at once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY
from earthspin.errors import UndefinedError
from earthspin.motion.equations import Equations, Pull, Rigid, SkyLaw
from earthspin.numerics import turns
from earthspin.numerics.gauss_windows import Windows, integrated, rule

FloatArray = NDArray[np.float64]

#: Nodes in a window, and windows whose sky is asked for at once.
ORDER, BATCH = 16, 32
#: Share of the last terms of the rates in a window that is let pass.
FINEST = 1e-13
#: Rounds after which a window is too long.
MOST_ROUNDS = 40
#: Share of the tolerance by which the last round may move the unknowns.
CONVERGED = 1e-3
#: By what the length changes at most from one batch to the next, and where a window was too long.
_SHRINK, _GROW, _SHORTER = 0.2, 1.6, 0.8
#: What is aimed at of what is allowed.
_CAREFUL = 0.85
#: First window, and shortest, in radians of the spin: shorter ones are of a motion that runs away.
FIRST_TURN, SHORTEST_TURN = 0.5, 1e-7
#: Share of a window that no further one is begun for.
_HARDLY = 1e-9
#: Length of a window over the time, below which its nodes cannot be told apart.
_ALIKE = 1e-13
_ROUND_OFF, _NEAR_ROUND_OFF = float(np.finfo(float).eps), 1e-13
#: A window is given up when a round moves the unknowns by more, in radians and in units of C u.
_RUNAWAY = 1e6


@dataclass(frozen=True)
class Above:
    """What pulls, whenever it is asked for.

    Attributes
    ----------
    gm : mapping of str to float
        m3 s-2; those that count for J_n come first.
    positions : callable
        Times (t,), s, to positions (t, 3) by name, m, along the sky's axes.
    near : int
        How many count for J_n.
    laws : callable or None
        What effects add: from one window and the positions at its nodes by name, each of shape
        (3, 1, n).
    """

    gm: Mapping[str, float]
    positions: Callable[[FloatArray], Mapping[str, FloatArray]]
    near: int = 0
    laws: Callable[[Windows, Mapping[str, FloatArray]], Sequence[SkyLaw]] | None = None

    def over(self, windows: Windows) -> list[Pull]:
        """All that pulls at the nodes of each window."""
        times, gm = windows.times, np.array(list(self.gm.values()))
        if not self.gm:
            nothing = np.zeros((3, 0, windows.order))
            return [Pull(row, gm, nothing) for row in times]
        found = self.positions(times.ravel())
        places = np.stack([found[name].T for name in self.gm], axis=1)
        places = places.reshape(3, len(self.gm), *times.shape)
        return [
            Pull(
                row,
                gm,
                np.ascontiguousarray(places[:, :, w]),
                self.near,
                self._laws(windows, places, w),
            )
            for w, row in enumerate(times)
        ]

    def _laws(self, windows: Windows, places: FloatArray, w: int) -> Sequence[SkyLaw]:
        if self.laws is None:
            return ()
        one = Windows(windows.edges[w : w + 2], windows.order)
        return self.laws(one, {name: places[:, m, w : w + 1] for m, name in enumerate(self.gm)})


@dataclass(frozen=True)
class Piece:
    """Windows that have been solved, one after another.

    Attributes
    ----------
    edges : ndarray, shape (w + 1,)
        s.
    series : ndarray, shape (7, lanes, w, n + 1)
        Legendre series of the unknowns.
    steady : ndarray, shape (3, lanes, w)
        Angular velocity that each window counts from, rad/s.
    in_space : bool
        Along which axes: the sky's or the body's, as the angular momentum.
    end : ndarray, shape (7, lanes)
        Unknowns where it ends, the attitude as a unit quaternion.
    """

    edges: FloatArray
    series: FloatArray
    steady: FloatArray
    in_space: bool
    end: FloatArray

    def at(self, times: FloatArray) -> FloatArray:
        """Angular momentum and attitude, shape (7, lanes, t)."""
        lanes = self.series.shape[1]
        windows = Windows(self.edges, self.series.shape[-1])
        flat = windows.evaluate(self.series.reshape(7 * lanes, len(windows.half), -1), times)
        found = flat.reshape(7, lanes * times.size)
        window = np.clip(np.searchsorted(self.edges, times) - 1, 0, len(windows.half) - 1)
        ahead = turns.turned_about(
            self.steady[:, :, window].reshape(3, -1), np.tile(times - self.edges[window], lanes)
        )
        q = turns.times(ahead, found[3:]) if self.in_space else turns.times(found[3:], ahead)
        q /= np.sqrt(np.sum(q * q, axis=0))
        return np.concatenate([found[:3], q]).reshape(7, lanes, times.size)

    def along_sky(self, times: FloatArray) -> FloatArray:
        """The same of the first lane, angular momentum along the sky's axes, shape (7, t)."""
        found = self.at(times)[:, 0]
        if not self.in_space:
            found[:3] = turns.rotated(found[3:], found[:3])
        return found


@dataclass
class Solver:
    """One form of the equations, from a state onward.

    Attributes
    ----------
    body : Rigid
    above : Above
    in_space : bool
        Which form.
    tolerance : float
        Largest share of the last terms in a window.
    order : int
        Nodes in a window.
    converged : float
        Share of the tolerance by which the last round may move the unknowns.
    window : float
        Length of the next windows, s.
    shortest : float
        No window may become shorter, s.
    evaluations : int
        How often rates were evaluated, at so many nodes at a time.
    """

    body: Rigid
    above: Above
    in_space: bool
    tolerance: float = FINEST
    order: int = ORDER
    converged: float = CONVERGED
    window: float = 0.0
    shortest: float = 0.0
    evaluations: int = field(default=0)

    def begin_with(self, spin: FloatArray) -> None:
        """Choose the first length, and the shortest, from a spin, rad/s, shape (3, lanes)."""
        fastest = max(float(np.max(np.sqrt(np.sum(spin**2, axis=0)))), abs(self.body.unit))
        self.window, self.shortest = FIRST_TURN / fastest, SHORTEST_TURN / fastest

    def next_edges(self, reached: float, end: float, count: int = BATCH) -> FloatArray:
        """Edges of the next windows, the last not beyond the end, s.

        Raises
        ------
        UndefinedError
            If they have become so short that nothing follows the motion.
        """
        if not self.window > max(self.shortest, _ALIKE * abs(reached)):
            raise UndefinedError(
                f"{reached / DAY:.6g} d from the start the rotation changes faster than any "
                "step follows; check a torque of your own, and how near what pulls comes"
            )
        few = min(count, max(1, int(np.ceil((end - reached) / self.window - _HARDLY))))
        edges = reached + self.window * np.arange(few + 1.0)
        edges[-1] = min(edges[-1], max(end, edges[-2]))
        return np.asarray(edges)

    def through(self, edges: FloatArray, start: FloatArray, near: Piece | None = None) -> Piece:
        """Solve windows, up to the first that is too long for its nodes.

        Parameters
        ----------
        edges : ndarray, shape (w + 1,)
            s.
        start : ndarray, shape (7, lanes)
        near : Piece, optional
            What is about as good, of the first lane: the rounds begin with it.

        Returns
        -------
        Piece
            Of as many windows as could be solved, none among them.
        """
        windows, lanes = Windows(edges, self.order), start.shape[1]
        rates: list[FloatArray] = []
        starts: list[FloatArray] = []
        steady: list[FloatArray] = []
        worst = 0.0
        seen: FloatArray | None = None
        if near is not None:
            found = near.along_sky(windows.times.ravel())
            seen = np.asarray(found.reshape(7, *windows.times.shape))
        for pull, begin, half in zip(
            self.above.over(windows), edges[:-1], windows.half[:, 0], strict=True
        ):
            equations = Equations(self.body, pull, self.in_space, start, pull.times - begin)
            guess = None if seen is None else equations.unknowns(seen[:, len(rates)])
            found, over = self._solve(equations, start, half, guess)
            worst = max(worst, over)
            if over > 1.0:
                break
            rates.append(found)
            starts.append(start)
            steady.append(equations.steady)
            start = self._end(found, equations, start, half)
        done = len(rates)
        self._resize(worst, complete=done == len(windows.half))
        series = np.zeros((7 * lanes, 0, self.order + 1))
        if done:
            laid = np.reshape(rates, (done, 7 * lanes, -1)).swapaxes(0, 1)
            series = integrated(
                windows.coefficients(laid),
                windows.half[:done],
                np.reshape(starts, (done, 7 * lanes)).T,
            )
        return Piece(
            edges[: done + 1],
            series.reshape(7, lanes, done, self.order + 1),
            np.reshape(steady, (done, 3, lanes)).transpose(1, 2, 0),
            self.in_space,
            start,
        )

    def _solve(
        self, equations: Equations, start: FloatArray, half: float, guess: FloatArray | None
    ) -> tuple[FloatArray, float]:
        """Rates in one window, and how far their last terms go over what is allowed."""
        gauss = rule(self.order)
        rows = np.repeat(start, self.order, axis=1)
        unknowns, change = rows if guess is None else guess, np.inf
        weighted = gauss.integrate * half
        for _ in range(MOST_ROUNDS):
            rates = equations.rates(unknowns)
            self.evaluations += 1
            found = rows + (rates.reshape(-1, self.order) @ weighted).reshape(7, -1)
            previous, change = change, float(np.max(np.abs(found - unknowns)))
            unknowns = found
            if not change < _RUNAWAY:
                return rates, np.inf
            if change <= max(_ROUND_OFF, self.converged * self.tolerance) or (
                change < _NEAR_ROUND_OFF and change > 0.3 * previous
            ):
                break
        else:
            return rates, np.inf
        last = np.sum(np.abs(rates.reshape(-1, self.order) @ gauss.project[:, -2:]), axis=1)
        last = np.max(last.reshape(7, -1), axis=1)
        size = float(np.max(np.abs(start[:3])))
        share = max(float(np.max(last[:3])) / size if size else 0.0, float(np.max(last[3:])))
        return rates, share * half / self.order / self.tolerance

    def _end(
        self, rates: FloatArray, equations: Equations, start: FloatArray, half: float
    ) -> FloatArray:
        """Angular momentum and quaternion where a window ends."""
        lanes = start.shape[1]
        whole = rates.reshape(7, lanes, self.order) @ rule(self.order).weights * half
        end = start + whole
        ahead = turns.turned_about(equations.steady, np.full(lanes, 2 * half))
        q = turns.times(ahead, end[3:]) if self.in_space else turns.times(end[3:], ahead)
        return np.concatenate([end[:3], q / np.sqrt(np.sum(q * q, axis=0))])

    def _resize(self, over: float, *, complete: bool) -> None:
        """Choose the next length from what the last terms came to."""
        if not np.isfinite(over):
            self.window *= 0.5
            return
        by = _CAREFUL * max(over, 1e-300) ** (-1 / self.order)
        if complete:
            self.window *= min(max(by, _SHRINK), _GROW)
        else:
            self.window *= min(max(by, _SHRINK), _SHORTER)


def halved(edges: FloatArray) -> FloatArray:
    """Edges of windows half as long."""
    return np.sort(np.concatenate([edges, (edges[1:] + edges[:-1]) / 2]))
