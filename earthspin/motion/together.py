r"""Integrate the rotation of bodies near a principal axis in many successive time windows at once.

Inside a window, the attitude of a body is q = Q u r: Q is approximately that at the start of the
window, u a uniform rotation with the angular velocity \omega_0 along the body's axes, and r = (s,
v), s = \sqrt{1 - v^2}, a small rotation. With the angular momentum l along the sky's axes, the
matrix R from body to sky and the torque n along the body's axes,

    l' = R n,   v' = (1/2) [s (\omega - \omega_0) + v x (\omega + \omega_0)],
    \omega = I^{-1} R^T l

The linear part of v' in v is K = I^{-1} [l] - [\omega] (matrices of vector products), which is
small if the body spins near a principal axis. Each sweep evaluates the rates at all nodes of all
windows, integrates them, and corrects the nodes by their linear part J, and the differences at the
edges by propagators of J over each window. J is evaluated once at v = 0 by differences of the
rates.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.polynomial import legendre

from earthspin.motion.equations import Rigid
from earthspin.motion.march import Masses, Piece, subdivided
from earthspin.numerics import rotations
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.polynomials import Windows, integrated, rule
from earthspin.torque.gravity import apply, cross, dot, tidal_tensor, zonal_law

#: Number of nodes in a window, and largest number of windows that are solved together.
NODES, MOST = 24, 256
#: Longest window times the size of K, and in rotations: the nodes must resolve torques that rotate
#: with the body.
_SWAY, _LONGEST = 0.5, 3.0
#: Shortest window in rotations, as limited by K and by the tails. The solution of shorter ones in
#: succession is not slower.
_SHORTEST, _TOO_SHORT = 0.2, 0.02
#: Smallest angular velocity that limits windows, rad/s.
_AT_REST = 1e-99
#: Number of windows whose rates set the window length, and smallest number solved together.
_PROBE, _FEWEST = 8, 16
#: Change of the unknowns at which the iteration ends, for full and half windows; the differences of
#: neighbours need the second one.
_SETTLED, _FINE = 1e-13, 1e-14
#: Change in a sweep below which changes that no longer decrease are rounding errors.
_NEAR_ROUND_OFF = 1e-11
#: Largest number of sweeps, v, and angular momentum in C u.
_MOST_SWEEPS, _FAR, _LARGE = 20, 0.3, 1e3
#: Step of the differences of the rates, rad and C u, and number of rounds that solve the linear
#: equations: for the propagators, and in each sweep.
_STEP, _ROUNDS, _INNER = 1e-7, 4, 2
#: Safety factor of the window length, and fraction of a window for which no further one is added.
_CAREFUL, _HARDLY = 0.85, 1e-9

#: Contribution of an effect, as `earthspin.motion.equations.SkyLaw` and `BodyLaw`.
Law = Callable[[FloatArray, FloatArray], FloatArray]


class NotConverged(ArithmeticError):
    """Raised if the sweeps do not converge, so that fewer windows must be solved together."""


class Together:
    """Solver for the rotation of bodies in many windows at once, where this converges.

    Parameters
    ----------
    body : Rigid
        The body and its neighbours.
    masses : Masses
    tolerance : float
        Largest relative size of the last terms of the rates in a full window.
    end : float
        Last time, s.
    """

    def __init__(self, body: Rigid, masses: Masses, tolerance: float, end: float) -> None:
        self._body, self._masses, self._tolerance, self._end = body, masses, tolerance, end
        self._window, self._count = np.inf, MOST
        #: Number of evaluations of the rates at nodes.
        self.evaluations = 0

    def solve(
        self, time: float, full: FloatArray, halves: FloatArray
    ) -> tuple[Piece, Piece] | None:
        """Return solutions with full and half windows after a given time, s.

        The result is None if windows in succession are better.

        Parameters
        ----------
        time : float
            s.
        full : ndarray, shape (7, 1) or (10, 1)
            State of the first body at this time by the solution with full windows.
        halves : ndarray, shape (7, bodies) or (10, bodies)
            State of all bodies at this time by the solution with half windows.
        """
        left = self._end - time
        turn, longest = _turn_and_longest(self._body.first(), full)
        if longest < min(_SHORTEST * turn, left):
            return None
        self._window = min(self._window, longest, left)
        while self._window >= min(_TOO_SHORT * turn, left):
            probe = self._chunk(time, full, _PROBE)
            tails = probe.tails(probe.rates(probe.guess)) / self._tolerance
            pair = None
            if np.max(tails) <= 1.0:
                chunk = self._chunk(time, full, self._count)
                try:
                    pair, tails = self._pair(chunk, full, halves)
                except NotConverged:
                    if chunk.count <= _FEWEST:
                        break
                    self._count = max(_FEWEST, chunk.count // 3)
                    continue
                finally:
                    self.evaluations += chunk.evaluations
                accurate = int(np.argmax(tails > 1.0))
                if accurate >= _FEWEST:
                    self._count = accurate
                    continue
            self._window *= _CAREFUL * max(float(np.max(tails)), 1e-99) ** (-1 / NODES)
            if pair is not None:
                self._count = min(2 * self._count, MOST)
                return pair
        self._window = np.inf
        return None

    def _chunk(self, time: float, state: FloatArray, count: int) -> _Chunk:
        """Prepare the full windows after a time (s), about a rotation without torques."""
        needed = max(1, int(np.ceil((self._end - time) / self._window - _HARDLY)))
        edges = time + self._window * np.arange(min(needed, count) + 1.0)
        if needed <= count:
            edges = np.linspace(time, self._end, needed + 1)
        body = self._body.first()
        return _Chunk(body, self._masses, edges, _free_states(body, state, edges[:-1]))

    def _pair(
        self, full: _Chunk, start: FloatArray, halves_start: FloatArray
    ) -> tuple[tuple[Piece, Piece] | None, FloatArray]:
        """Solve full windows and their halves; return the solutions, and tails over tolerance."""
        jacobian = full.jacobian()
        solution = full.solve(full.guess, start, jacobian, _SETTLED)
        tails = full.tails(full.rates_at_nodes) / self._tolerance
        if np.max(tails) > 1.0:
            return None, tails
        edges = subdivided(solution.edges, 2)
        halved = _Chunk(self._body, self._masses, edges, solution.along_sky(edges[:-1]))
        near = solution.along_sky(halved.windows.times.ravel())
        guess = halved.unknowns(near, halved.reference).reshape(-1, 1, *halved.windows.times.shape)
        guess = np.repeat(guess, self._body.count, axis=1)
        fine = halved.solve(guess, halves_start, _on_halves(jacobian), _FINE)
        self.evaluations += halved.evaluations
        return (solution, fine), tails


class _Chunk:
    """Rates of the rotation of bodies at the nodes of consecutive windows.

    Unknowns have the shape (6, bodies, w, n): v, and the angular momentum along the sky's axes. A
    fluid core adds three rows, its angular momentum along the sky's axes.

    Parameters
    ----------
    body : Rigid
    masses : Masses
    edges : ndarray, shape (w + 1,)
        s.
    states : ndarray, shape (7, w) or (10, w)
        Approximate states of the first body at the start of each window.
    """

    def __init__(self, body: Rigid, masses: Masses, edges: FloatArray, states: FloatArray) -> None:
        self._body, self._states, self.evaluations = body, states, 0
        self.windows = windows = Windows(edges, NODES)
        self.count, shape = len(edges) - 1, windows.times.shape
        begin, self._steady = states[3:7], body.first().spin(states)
        since = (windows.times - edges[:-1, np.newaxis]).ravel()
        turn = rotations.rotation_about(np.repeat(self._steady, NODES, axis=1), since)
        #: Reference attitude at the nodes, shape (4, w * n).
        self.reference = rotations.times(np.repeat(begin, NODES, axis=1), turn)
        turn = rotations.rotation_about(self._steady, np.diff(edges))
        self._ends = rotations.times(begin, turn)
        #: Rotation from the reference at the end of each window to that of the next one.
        self._step = rotations.times(rotations.conjugate(begin[:, 1:]), self._ends[:, :-1])
        self._step *= np.where(self._step[0] < 0, -1.0, 1.0)
        at = masses.positions(windows.times.ravel()) if masses.gm else {}
        places = {name: np.ascontiguousarray(at[name].T).reshape(3, *shape) for name in masses.gm}
        self._tensor = np.zeros((6, *shape))
        if masses.gm:
            self._tensor = tidal_tensor((gm, places[name]) for name, gm in masses.gm.items())
            self._tensor *= 1 + body.trend * (body.epoch + windows.times)
        zonal = {degree: coefficient / body.unit for degree, coefficient in body.zonal}
        self._on_harmonics = [
            zonal_law(zonal, body.radius, gm, places[name][:, np.newaxis])
            for name, gm in list(masses.gm.items())[: masses.near if zonal else 0]
        ]
        self._laws, self._body_torques, self._inertia_changes = (
            () if laws is None else laws(windows, places)
            for laws in (masses.laws, masses.body_torques, masses.inertia_changes)
        )

    @property
    def guess(self) -> FloatArray:
        """Unknowns at the nodes for the reference rotation, shape (6 or 9, 1, w, n)."""
        rows = np.concatenate([np.zeros_like(self._steady), self._states[:3], self._states[7:]])
        return np.repeat(rows[:, np.newaxis, :, np.newaxis], NODES, axis=-1)

    def unknowns(self, states: FloatArray, reference: FloatArray) -> FloatArray:
        """Convert states (7 or 10, m) to unknowns (6 or 9, m) relative to attitudes (4, m)."""
        r = rotations.times(rotations.conjugate(reference), states[3:7])
        return np.concatenate([r[1:] * np.sign(r[0]), states[:3], states[7:]])

    def rates(self, unknowns: FloatArray) -> FloatArray:
        """Time derivatives of the unknowns at the nodes, s-1."""
        body, unit, windows = self._body, self._body.unit, self.windows
        self.evaluations += windows.times.size
        v, momentum, core = unknowns[:3], unknowns[3:6], unknowns[6:]
        q = rotations.times(self.reference.reshape(4, 1, *windows.times.shape), _unit(v))
        matrix = rotations.matrices(q.reshape(4, -1)).reshape(3, *v.shape)
        x, y, z = axes = matrix.swapaxes(0, 1)
        per_momentum = _at_nodes(unit / body.mantle_moments)
        mantle = momentum - core if body.core else momentum
        spin = per_momentum * np.stack([dot(axis, mantle) for axis in axes])
        tides = [apply(self._tensor[:, np.newaxis], axis) for axis in axes]
        tide_factor = _at_nodes(body.tide)
        torque = np.stack([dot(y, tides[2]), dot(x, tides[2]), dot(x, tides[1])])
        torque *= 3 / unit * _at_nodes(body.moment_differences) * tide_factor
        if self._inertia_changes:
            change = _sum_of(self._inertia_changes, matrix, spin)
            spin = spin - per_momentum / unit * apply(change, spin)
            # vector part of the product of the tidal tensor along the body's axes and the change
            t = [apply(change, np.stack([dot(axis, tide) for tide in tides])) for axis in axes]
            moment = np.stack([t[1][2] - t[2][1], t[2][0] - t[0][2], t[0][1] - t[1][0]])
            torque += 3 / unit * tide_factor * moment
        if self._body_torques:
            torque += _sum_of(self._body_torques, matrix, spin) / unit
        if body.custom_torque is not None:
            times = np.broadcast_to(windows.times, v.shape[1:]).ravel()
            custom = body.custom_torque(times, q.reshape(4, -1).T, spin.reshape(3, -1).T)
            torque += custom.T.reshape(v.shape) / unit
        rate = x * torque[0] + y * torque[1] + z * torque[2]
        for on_harmonics in self._on_harmonics:
            rate += tide_factor * on_harmonics(z)
        if self._laws:
            rate += _sum_of(self._laws, z, momentum)
        steady = self._steady[:, np.newaxis, :, np.newaxis]
        turning = 0.5 * (np.sqrt(1 - dot(v, v)) * (spin - steady) + cross(v, spin + steady))
        if body.core is None:
            return np.concatenate([turning, rate])
        per_momentum = _at_nodes(unit / body.core.moments)
        core_spin = per_momentum * np.stack([dot(axis, core) for axis in axes])
        on_core = -body.core.torque(core_spin, spin) / unit
        in_sky = x * on_core[0] + y * on_core[1] + z * on_core[2]
        return np.concatenate([turning, rate, in_sky])

    def tails(self, rates: FloatArray) -> FloatArray:
        """Sizes of the last two Legendre terms of the rates in each window, first body only."""
        last = np.abs(rates[:6, 0] @ rule(NODES).project[:, -2:]).sum(axis=-1)
        last[3:] /= np.sqrt(np.max(np.sum(self._states[:3] ** 2, axis=0))) or 1.0
        return np.asarray(np.max(last, axis=0) * self.windows.half[:, 0] / NODES)

    def jacobian(self) -> FloatArray:
        """Derivatives of the rates at v = 0, shape (6, 6, w, n) or (9, 9, w, n)."""
        guess = self.guess
        rates, columns = self.rates(guess), []
        for row in guess:
            row += _STEP
            columns.append((self.rates(guess) - rates)[:, 0] / _STEP)
            row -= _STEP
        return np.stack(columns, axis=1)

    def _propagators(self, jacobian: FloatArray) -> FloatArray:
        """Changes of the unknowns at the start of each next window by those in this one."""
        gauss, half = rule(NODES), self.windows.half
        identity = np.eye(len(jacobian))
        solution = np.broadcast_to(_at_nodes(identity), jacobian.shape)
        for _ in range(_ROUNDS):
            slope = np.einsum("ijwn,jkwn->ikwn", jacobian, solution)
            solution = _at_nodes(identity) + (slope @ gauss.integrate) * half
        over = identity[..., np.newaxis] + (slope @ gauss.weights) * half[:, 0]
        change_of_reference = np.tile(identity, (self.count - 1, 1, 1))
        change_of_reference[:, :3, :3] = np.moveaxis(rotations.left(self._step)[1:, 1:], 2, 0)
        return np.asarray(change_of_reference @ np.moveaxis(over[..., :-1], 2, 0))

    def solve(
        self, unknowns: FloatArray, start: FloatArray, jacobian: FloatArray, settled: float
    ) -> Piece:
        """Iterate to the solution from estimates at the nodes and the state at the start.

        Raises
        ------
        NotConverged
        """
        gauss, half, bodies = rule(NODES), self.windows.half, start.shape[1]
        at_edges = np.repeat(self.guess[..., 0], bodies, axis=1)
        first = np.repeat(self._states[3:7, :1], bodies, axis=1)
        at_edges[..., 0] = self.unknowns(start, first)
        over, previous = self._propagators(jacobian), np.inf
        for sweep in range(_MOST_SWEEPS):
            rates = self.rates(unknowns)
            base = at_edges[..., np.newaxis] + (rates @ gauss.integrate) * half
            change = base - unknowns
            for _ in range(_INNER):
                slope = np.einsum("ijwn,jbwn->ibwn", jacobian, change)
                change = base + (slope @ gauss.integrate) * half - unknowns
            rates += slope
            end = at_edges + (rates @ gauss.weights) * half[:, 0]
            _refuse_far(end)
            r = rotations.times(self._step[:, np.newaxis], _unit(end[:3, :, :-1]))
            gaps = np.concatenate([r[1:], end[3:, :, :-1]]) - at_edges[..., 1:]
            shift = np.zeros((self.count, *at_edges.shape[:2]))
            for w, gap in enumerate(np.moveaxis(gaps, 2, 0)):
                shift[w + 1] = over[w] @ shift[w] + gap
            shift = np.moveaxis(shift, 0, 2)
            at_edges += shift
            unknowns = unknowns + change + shift[..., np.newaxis]
            _refuse_far(unknowns)
            size = max(float(np.max(np.abs(change))), float(np.max(np.abs(shift))))
            stagnant = size < _NEAR_ROUND_OFF and size > 0.5 * previous
            if sweep and (stagnant or size * min(previous, size) <= 0.1 * settled * previous):
                break
            previous = size
        else:
            raise NotConverged
        self.rates_at_nodes = rates
        return self._piece(unknowns, at_edges, end[..., -1] + shift[..., -1])

    def _piece(self, unknowns: FloatArray, at_edges: FloatArray, end: FloatArray) -> Piece:
        """Make the solution from the unknowns at nodes, at starts of windows, and at the end."""
        v, rates, begin = unknowns[:3], self.rates_at_nodes, self._states[3:7, np.newaxis]
        scalar = -dot(v, rates[:3]) / np.sqrt(1 - dot(v, v))
        turning = rotations.times(begin[..., np.newaxis], np.stack([scalar, *rates[:3]]))
        series = integrated(
            self.windows.coefficients(np.concatenate([rates[3:6], turning, rates[6:]])),
            self.windows.half,
            _states(at_edges, begin),
        )
        steady = rotations.rotated(self._states[3:7], self._steady)[:, np.newaxis]
        return Piece(
            self.windows.edges,
            series,
            np.repeat(steady, end.shape[1], axis=1),
            True,
            _states(end, self._ends[:, -1:]),
        )


def _turn_and_longest(body: Rigid, state: FloatArray) -> tuple[float, float]:
    """Duration of a rotation, and longest window that converges in a given state, s."""
    spin, moments = body.spin(state), body.mantle_moments
    size_of_k = float(np.linalg.norm(spin * (moments / moments.T - 1)))
    turn = 2 * np.pi / max(float(np.linalg.norm(spin)), _AT_REST)
    return turn, min(_SWAY / max(size_of_k, _AT_REST), _LONGEST * turn)


def _refuse_far(unknowns: FloatArray) -> None:
    """Raise an error if the rotation is too far from the reference to converge."""
    if not (np.max(np.abs(unknowns[:3])) < _FAR and np.max(np.abs(unknowns)) < _LARGE):
        raise NotConverged


def _free_states(body: Rigid, state: FloatArray, times: FloatArray) -> FloatArray:
    """States (7 or 10, t) of an axisymmetric body without torque, from the first time on."""
    mantle = state[:3] if body.core is None else state[:3] - state[7:]
    a, c = float(body.mantle_moments[:2].mean()), float(body.mantle_moments[2, 0])
    z = rotations.rotated(rotations.conjugate(state[3:7]), mantle)[2, 0]
    since, count = times - times[0], times.size
    about_momentum = np.repeat(body.unit / a * mantle, count, axis=1)
    about_axis = np.zeros((3, count))
    about_axis[2] = body.unit * (1 / c - 1 / a) * z
    q = rotations.times(
        rotations.times(rotations.rotation_about(about_momentum, since), state[3:7]),
        rotations.rotation_about(about_axis, since),
    )
    states = np.repeat(state, count, axis=1)
    states[3:7] = q / np.sqrt(np.sum(q * q, axis=0))
    return states


def _states(unknowns: FloatArray, reference: FloatArray) -> FloatArray:
    """Convert unknowns (6 or 9, ...) relative to attitudes (4, ...) to states (7 or 10, ...)."""
    q = rotations.times(reference, _unit(unknowns[:3]))
    q /= np.sqrt(np.sum(q * q, axis=0))
    return np.concatenate([unknowns[3:6], q, unknowns[6:]])


def _unit(v: FloatArray) -> FloatArray:
    """Unit quaternions with given vector parts v (3, ...)."""
    return np.concatenate([np.sqrt(1 - dot(v, v))[np.newaxis], v])


def _at_nodes(values: FloatArray) -> FloatArray:
    """Add axes for windows and nodes."""
    return values[..., np.newaxis, np.newaxis]


def _sum_of(laws: Sequence[Law], vectors: FloatArray, others: FloatArray) -> FloatArray:
    """Sum of the contributions of effects, for one body after the other, (3 or 6, bodies, w, n)."""
    lanes = range(others.shape[1])
    return np.stack(
        [sum(law(vectors[..., b, :, :], others[:, b]) for law in laws) for b in lanes], axis=1
    )


def _on_halves(values: FloatArray) -> FloatArray:
    """Values at the nodes of the two halves of each window, from those at its nodes."""
    gauss = rule(NODES)
    halves = np.empty((*values.shape[:-2], 2 * values.shape[-2], NODES))
    for k, nodes in enumerate(((gauss.nodes - 1) / 2, (gauss.nodes + 1) / 2)):
        halves[..., k::2, :] = values @ (gauss.project @ legendre.legvander(nodes, NODES - 1).T)
    return halves
