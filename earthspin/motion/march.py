r"""Integrate the rotation of bodies in successive time windows of variable length.

Each window has a few Gauss-Legendre nodes, at which Picard iteration solves for the unknowns of
`earthspin.motion.equations`. The length of the windows is chosen such that the last Legendre terms
of the rates are within the tolerance, so fast passages have short windows. Positions are evaluated
for many windows in one call.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.polynomial import legendre

from earthspin.constants import DAY
from earthspin.errors import UndefinedError
from earthspin.motion.equations import BodyLaw, Equations, Perturbers, Rigid, SkyLaw
from earthspin.numerics import rotations
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.polynomials import Windows, integrated, rule

#: Number of nodes in a window, and of windows for which positions are evaluated in one call.
ORDER, BATCH = 16, 32
#: Smallest tolerance: relative size of the last terms of the rates in a window.
FINEST = 1e-13
#: Number of Picard rounds after which a window is regarded as too long.
MOST_ROUNDS = 40
#: Largest change of the unknowns in the last round, as a fraction of the tolerance.
CONVERGED = 1e-3
#: Limits on the factor between window lengths of successive batches: smallest, largest, and largest
#: after a window was too long.
_SHRINK, _GROW, _SHORTER = 0.2, 1.6, 0.8
#: Safety factor of the window length.
_CAREFUL = 0.85
#: First and shortest window length in radians of the spin; shorter windows mean a divergent motion.
FIRST_TURN, SHORTEST_TURN = 0.5, 1e-7
#: Fraction of a window at the end of the span for which no further window is added.
_HARDLY = 1e-9
#: Smallest ratio of window length and time for which the nodes are distinct floats.
_ALIKE = 1e-13
_ROUND_OFF, _NEAR_ROUND_OFF = float(np.finfo(float).eps), 1e-13
#: Largest change of the unknowns in a round before the window is abandoned, rad and C u.
_RUNAWAY = 1e6


def subdivided(edges: FloatArray, count: int) -> FloatArray:
    """Edges of windows, with further ones that divide each window into equal parts."""
    index = np.arange(count * (len(edges) - 1) + 1) / count
    return np.interp(index, np.arange(len(edges)), edges)


@dataclass(frozen=True)
class Masses:
    """GM of perturbing masses, with functions for their positions and for further effects.

    Attributes
    ----------
    gm : mapping of str to float
        GM, m3 s-2; masses that act on J_n come first.
    positions : callable
        Function of times (t,), s, that returns positions (t, 3) along the sky's axes by name, m.
    near : int
        Number of masses that act on J_n.
    laws : callable or None
        Function of windows and the positions at their nodes by name, each of shape (3, w, n), that
        returns the contributions of effects.
    body_torques, inertia_changes : callable or None
        The same for effects that depend on the full attitude.
    """

    gm: Mapping[str, float]
    positions: Callable[[FloatArray], Mapping[str, FloatArray]]
    near: int = 0
    laws: Callable[[Windows, Mapping[str, FloatArray]], Sequence[SkyLaw]] | None = None
    body_torques: Callable[[Windows, Mapping[str, FloatArray]], Sequence[BodyLaw]] | None = None
    inertia_changes: Callable[[Windows, Mapping[str, FloatArray]], Sequence[BodyLaw]] | None = None

    def over(self, windows: Windows) -> list[Perturbers]:
        """Make the `Perturbers` of each time window: GM and positions of the masses."""
        times, gm = windows.times, np.array(list(self.gm.values()))
        if not self.gm:
            no_positions = np.zeros((3, 0, windows.order))
            return [Perturbers(window_times, gm, no_positions) for window_times in times]
        positions = self.positions(times.ravel())
        places = np.stack([positions[name].T for name in self.gm], axis=1)
        places = places.reshape(3, len(self.gm), *times.shape)
        masses_at_nodes = []
        for w, window_times in enumerate(times):
            by_name = {name: places[:, m, w : w + 1] for m, name in enumerate(self.gm)}
            window = Windows(windows.edges[w : w + 2], windows.order)
            laws, body_torques, inertia_changes = (
                () if effects is None else effects(window, by_name)
                for effects in (self.laws, self.body_torques, self.inertia_changes)
            )
            place = np.ascontiguousarray(places[:, :, w])
            masses_at_nodes.append(
                Perturbers(window_times, gm, place, self.near, laws, body_torques, inertia_changes)
            )
        return masses_at_nodes


@dataclass(frozen=True)
class Piece:
    """Numerical solution for the rotation of bodies over some consecutive time windows.

    Attributes
    ----------
    edges : ndarray, shape (w + 1,)
        Edges of the windows, s.
    series : ndarray, shape (7, bodies, w, n + 1) or (10, bodies, w, n + 1)
        Legendre series of the unknowns.
    steady : ndarray, shape (3, bodies, w)
        Reference angular velocity of each window, rad/s.
    in_space : bool
        True if angular momentum and reference angular velocity are along the sky's axes, False if
        along the body's axes.
    end : ndarray, shape (7, bodies) or (10, bodies)
        Angular momentum and attitude quaternion at the end, and angular momentum of a core.
    """

    edges: FloatArray
    series: FloatArray
    steady: FloatArray
    in_space: bool
    end: FloatArray

    def at(self, times: FloatArray) -> FloatArray:
        """State of all bodies at given times, (7, bodies, t), or (10, bodies, t) with a core."""
        count, bodies = self.series.shape[:2]
        windows = Windows(self.edges, self.series.shape[-1])
        rows = windows.evaluate(self.series.reshape(count * bodies, len(windows.half), -1), times)
        unknowns = rows.reshape(count, bodies * times.size)
        window = np.clip(np.searchsorted(self.edges, times) - 1, 0, len(windows.half) - 1)
        reference = rotations.rotation_about(
            self.steady[:, :, window].reshape(3, -1), np.tile(times - self.edges[window], bodies)
        )
        p = unknowns[3:7]
        q = rotations.times(reference, p) if self.in_space else rotations.times(p, reference)
        q /= np.sqrt(np.sum(q * q, axis=0))
        return np.concatenate([unknowns[:3], q, unknowns[7:]]).reshape(count, bodies, times.size)

    def spin(self, times: FloatArray) -> FloatArray:
        """Angular velocity of the first body along its axes, rad/s, from the rate of its attitude.

        The shape is (3, t). This is only valid for the form along the sky's axes.
        """
        attitude = self.series[3:7, 0]
        half = np.diff(self.edges)[:, np.newaxis] / 2
        p = Windows(self.edges, attitude.shape[-1]).evaluate(attitude, times)
        rate = Windows(self.edges, attitude.shape[-1] - 1).evaluate(
            legendre.legder(attitude, axis=-1) / half, times
        )
        window = np.clip(np.searchsorted(self.edges, times) - 1, 0, len(half) - 1)
        steady = self.steady[:, 0, window]
        reference = rotations.rotation_about(steady, times - self.edges[window])
        relative_spin = 2 * rotations.times(rate, rotations.conjugate(p)) / np.sum(p * p, axis=0)
        along_sky = steady + rotations.rotated(reference, relative_spin[1:])
        q = rotations.times(reference, p) / np.sqrt(np.sum(p * p, axis=0))
        return rotations.rotated(rotations.conjugate(q), along_sky)

    def along_sky(self, times: FloatArray) -> FloatArray:
        """Angular momentum in sky axes and attitude quaternion of the first body, shape (7, t)."""
        state = self.at(times)[:, 0]
        if not self.in_space:
            state[:3] = rotations.rotated(state[3:7], state[:3])
        return state


@dataclass
class Solver:
    """Solver for the rotation of bodies in successive time windows, by Euler's equations.

    Attributes
    ----------
    body : Rigid
    masses : Masses
    in_space : bool
        True for the form with the angular momentum along the sky's axes.
    tolerance : float
        Largest relative size of the last terms in a window.
    order : int
        Number of nodes in a window.
    converged : float
        Largest change of the unknowns in the last round, as a fraction of the tolerance.
    window : float
        Length of the next windows, s.
    shortest : float
        Shortest allowed window, s.
    evaluations : int
        Number of evaluations of the rates at all nodes of a window.
    """

    body: Rigid
    masses: Masses
    in_space: bool
    tolerance: float = FINEST
    order: int = ORDER
    converged: float = CONVERGED
    window: float = 0.0
    shortest: float = 0.0
    evaluations: int = field(default=0)

    def begin_with(self, spin: FloatArray) -> None:
        """Set the first and the shortest window length from the initial angular velocity.

        The angular velocity is in rad/s and has the shape (3, bodies).
        """
        fastest = max(float(np.max(np.sqrt(np.sum(spin**2, axis=0)))), abs(self.body.unit))
        self.window, self.shortest = FIRST_TURN / fastest, SHORTEST_TURN / fastest

    def next_edges(self, reached: float, end: float, count: int = BATCH) -> FloatArray:
        """Edges of the next time windows to be solved, s; no window extends beyond `end`.

        Raises
        ------
        UndefinedError
            If the windows have become shorter than the shortest allowed length.
        """
        if not self.window > max(self.shortest, _ALIKE * abs(reached)):
            raise UndefinedError(
                f"{reached / DAY:.6g} d from the start the rotation changes too fast to be "
                "integrated; check the custom torque and the distances of the perturbers"
            )
        window_count = min(count, max(1, int(np.ceil((end - reached) / self.window - _HARDLY))))
        edges = reached + self.window * np.arange(window_count + 1.0)
        edges[-1] = min(edges[-1], max(end, edges[-2]))
        return np.asarray(edges)

    def integrate(self, edges: FloatArray, start: FloatArray, other: Piece | None = None) -> Piece:
        """Integrate over consecutive windows; stop before a window that is too long to be accurate.

        Parameters
        ----------
        edges : ndarray, shape (w + 1,)
            s.
        start : ndarray, shape (7, bodies) or (10, bodies)
        other : Piece, optional
            Approximate solution, whose first body is the first estimate for the iteration.

        Returns
        -------
        Piece
            Solution over the windows that were solved; there may be none.
        """
        windows, (count, bodies) = Windows(edges, self.order), start.shape
        rates: list[FloatArray] = []
        starts: list[FloatArray] = []
        steady: list[FloatArray] = []
        worst = 0.0
        estimate: FloatArray | None = None
        if other is not None:
            state = other.along_sky(windows.times.ravel())
            estimate = np.asarray(state.reshape(count, *windows.times.shape))
        for masses, begin, half in zip(
            self.masses.over(windows), edges[:-1], windows.half[:, 0], strict=True
        ):
            equations = Equations(self.body, masses, self.in_space, start, masses.times - begin)
            guess = None if estimate is None else equations.unknowns(estimate[:, len(rates)])
            rate, error_ratio = self._solve(equations, start, half, guess)
            worst = max(worst, error_ratio)
            if error_ratio > 1.0:
                break
            rates.append(rate)
            starts.append(start)
            steady.append(equations.steady)
            start = self._end(rate, equations, start, half)
        solved = len(rates)
        self._resize(worst, complete=solved == len(windows.half))
        series = np.zeros((count * bodies, 0, self.order + 1))
        if solved:
            rate_rows = np.reshape(rates, (solved, count * bodies, -1)).swapaxes(0, 1)
            series = integrated(
                windows.coefficients(rate_rows),
                windows.half[:solved],
                np.reshape(starts, (solved, count * bodies)).T,
            )
        return Piece(
            edges[: solved + 1],
            series.reshape(count, bodies, solved, self.order + 1),
            np.reshape(steady, (solved, 3, bodies)).transpose(1, 2, 0),
            self.in_space,
            start,
        )

    def _solve(
        self, equations: Equations, start: FloatArray, half: float, guess: FloatArray | None
    ) -> tuple[FloatArray, float]:
        """Integrate over one window; return rates at nodes, and truncation error over tolerance.

        The error is estimated from the last two Legendre terms; the window fails if the ratio is
        above 1.
        """
        gauss = rule(self.order)
        start_rows = np.repeat(start, self.order, axis=1)
        unknowns, change = start_rows if guess is None else guess, np.inf
        weighted = gauss.integrate * half
        for _ in range(MOST_ROUNDS):
            rates = equations.rates(unknowns)
            self.evaluations += 1
            change_of_unknowns = rates.reshape(-1, self.order) @ weighted
            new_unknowns = start_rows + change_of_unknowns.reshape(start_rows.shape)
            previous, change = change, float(np.max(np.abs(new_unknowns - unknowns)))
            unknowns = new_unknowns
            if not change < _RUNAWAY:
                return rates, np.inf
            if change <= max(_ROUND_OFF, self.converged * self.tolerance) or (
                change < _NEAR_ROUND_OFF and change > 0.3 * previous
            ):
                break
        else:
            return rates, np.inf
        last = np.sum(np.abs(rates.reshape(-1, self.order) @ gauss.project[:, -2:]), axis=1)
        last = np.max(last.reshape(len(start), -1), axis=1)
        size = float(np.max(np.abs(start[:3])))
        error = max(float(np.max(last[:3])) / size if size else 0.0, float(np.max(last[3:7])))
        return rates, error * half / self.order / self.tolerance

    def _end(
        self, rates: FloatArray, equations: Equations, start: FloatArray, half: float
    ) -> FloatArray:
        """State at the end of a window, shape (7, bodies), or (10, bodies) with a core."""
        count, bodies = start.shape
        change = rates.reshape(count, bodies, self.order) @ rule(self.order).weights * half
        end = start + change
        turn = rotations.rotation_about(equations.steady, np.full(bodies, 2 * half))
        p = end[3:7]
        q = rotations.times(turn, p) if self.in_space else rotations.times(p, turn)
        return np.concatenate([end[:3], q / np.sqrt(np.sum(q * q, axis=0)), end[7:]])

    def _resize(self, error_ratio: float, *, complete: bool) -> None:
        """Set the length of the next window from the ratio of truncation error to tolerance."""
        if not np.isfinite(error_ratio):
            self.window *= 0.5
            return
        factor = _CAREFUL * max(error_ratio, 1e-300) ** (-1 / self.order)
        if complete:
            self.window *= min(max(factor, _SHRINK), _GROW)
        else:
            self.window *= min(max(factor, _SHRINK), _SHORTER)
