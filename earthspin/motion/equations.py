r"""Euler's equations for the whole attitude, in two forms, on the nodes of one window.

With the angular momentum L in units of C u (u a unit of spin), the quaternion q from the body's
axes to the sky's, R its matrix and n what turns the body, along the body's axes,

    in space    l' = R n,               \omega = I^{-1} R^T l
    in the body m' = m x \omega + n,    \omega = I^{-1} m

and q' = (1/2) q \omega in both. Inside a window the attitude is counted from a body that goes on
turning as it did: about the axis that the spin \omega_0 has in the body, or in space,

    q = p e,    e' = (1/2) e \omega_0,    p' = (1/2) p [e (\omega - \omega_0) e^{-1}]
    q = e p,    e' = (1/2) \omega_0 e,    p' = (1/2) [e^{-1} (R \omega - \omega_0) e] p

p is slow where the spin is steady, and the rounds of Picard's iteration are few. The torque of a
mass at r is 3 GM/r5 r x I r (I.9.34); the differences of the moments are given, never formed.
Arrays are component first, and lanes (bodies side by side under one sky) follow one another in
each row: shape (3, lanes * nodes).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from earthspin.numerics import turns
from earthspin.torque.harmonics import zonal_torque

FloatArray = NDArray[np.float64]

#: Torque along the body's axes over C, s-2, shape (m, 3), from times (s), shape (m,),
#: quaternions (m, 4) and angular velocities along the body's axes, rad/s (m, 3).
CustomTorque = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
#: What an effect adds to l' in the sky's axes, s-1, from figure axis and angular momentum, each of
#: shape (3, lanes, nodes).
SkyLaw = Callable[[FloatArray, FloatArray], FloatArray]


#: What is changed in the lanes of a body's neighbours, in this order where it is uncertain.
FLATTENING, TRIAXIALITY, PULL, ROUNDING = "flattening", "triaxiality", "pull", "rounding"


@dataclass(frozen=True, kw_only=True)
class Rigid:
    """The numbers of rigid bodies that their motion depends on, one for each lane.

    Attributes
    ----------
    c_minus_a, c_minus_b : ndarray, shape (lanes,)
        (C - A)/C and (C - B)/C.
    tide : ndarray, shape (lanes,)
        Factor on all that pulls.
    unit : float
        Unit of spin u, rad/s.
    zonal : sequence of (int, float)
        Degree n, and J_n times M a2/C.
    radius : float
        That J_n refer to, m.
    trend : float
        Relative rate of the differences of moments, s-1.
    epoch : float
        Start of the motion, s from J2000.0, at which they are those given.
    own : callable or None
        A torque of one's own.
    """

    c_minus_a: FloatArray
    c_minus_b: FloatArray
    tide: FloatArray
    unit: float
    zonal: Sequence[tuple[int, float]] = ()
    radius: float = 0.0
    trend: float = 0.0
    epoch: float = 0.0
    own: CustomTorque | None = None

    @property
    def moments(self) -> FloatArray:
        """Principal moments over C, shape (3, lanes)."""
        return np.stack([1 - self.c_minus_a, 1 - self.c_minus_b, np.ones_like(self.c_minus_a)])

    @property
    def levers(self) -> FloatArray:
        """C - B, A - C and B - A over C, shape (3, lanes)."""
        return np.stack([self.c_minus_b, -self.c_minus_a, self.c_minus_a - self.c_minus_b])

    @property
    def lanes(self) -> int:
        """How many bodies there are side by side."""
        return int(self.tide.size)

    def first(self) -> Rigid:
        """The first lane alone."""
        one = slice(0, 1)
        return replace(
            self, c_minus_a=self.c_minus_a[one], c_minus_b=self.c_minus_b[one], tide=self.tide[one]
        )

    def spin(self, state: FloatArray) -> FloatArray:
        """Angular velocity along the body's axes, rad/s, shape (3, t), of one lane.

        Parameters
        ----------
        state : ndarray, shape (7, t)
            Angular momentum along the sky's axes, in units of C u, and attitude.
        """
        return self.unit / self.moments * turns.rotated(turns.conjugate(state[3:]), state[:3])


@dataclass(frozen=True)
class Pull:
    """All that pulls, at the nodes of one window.

    Attributes
    ----------
    times : ndarray, shape (n,)
        From the start of the motion, s.
    gm : ndarray, shape (masses,)
        m3 s-2.
    places : ndarray, shape (3, masses, n)
        m, along the sky's axes.
    near : int
        How many of the masses, the first, count for J_n.
    laws : sequence of callable
        What effects add.
    """

    times: FloatArray
    gm: FloatArray
    places: FloatArray
    near: int = 0
    laws: Sequence[SkyLaw] = ()


class Equations:
    """Rates of one window's unknowns: angular momentum and p, shape (7, lanes * n).

    Parameters
    ----------
    body : Rigid
    pull : Pull
    in_space : bool
        Whether the angular momentum is counted along the sky's axes or the body's.
    start : ndarray, shape (7, lanes)
        Angular momentum and quaternion where the window begins.
    since : ndarray, shape (n,)
        Time from there, s.
    """

    def __init__(
        self, body: Rigid, pull: Pull, in_space: bool, start: FloatArray, since: FloatArray
    ) -> None:
        self._body, self._pull, self._in_space = body, pull, in_space
        self._lanes, self._nodes = start.shape[1], since.size
        self._times = np.tile(pull.times, self._lanes)
        self._spin_per_momentum = self._rows(body.unit / body.moments)
        self._levers = self._rows(3 / body.unit * body.levers)
        self._places = np.tile(pull.places, self._lanes)
        square = np.einsum("ipm,ipm->pm", pull.places, pull.places)
        strength = pull.gm[:, np.newaxis] / (square * square * np.sqrt(square))
        strength = strength * (1 + body.trend * (body.epoch + pull.times))
        self._strength = np.tile(strength, self._lanes) * self._rows(body.tide)
        turn = turns.matrices(start[3:])
        seen = _into(turn, start[:3]) if in_space else start[:3]
        spin = body.unit / body.moments * seen
        #: Angular velocity where the window begins, rad/s, shape (3, lanes): along the sky's axes
        #: where the angular momentum is, else along the body's.
        self.steady = _out_of(turn, spin) if in_space else spin
        self._steady = self._rows(self.steady)
        ahead = turns.turned_about(self._steady, np.tile(since, self._lanes))
        self._ahead = turns.left(ahead) if in_space else turns.right(ahead)
        self._turn_ahead = turns.matrices(ahead)

    def _rows(self, values: FloatArray) -> FloatArray:
        """One number for each lane, along the rows."""
        return np.repeat(values, self._nodes, axis=-1)

    def attitude(self, unknowns: FloatArray) -> FloatArray:
        """Quaternions, shape (4, lanes * n)."""
        return np.asarray(np.einsum("abm,bm->am", self._ahead, unknowns[3:]))

    def unknowns(self, state: FloatArray) -> FloatArray:
        """Unknowns of every lane, from angular momentum along the sky's axes and attitude, (7, n).

        For a form that counts the angular momentum along the sky's axes.
        """
        q = np.tile(state[3:], self._lanes)
        p = np.einsum("bam,bm->am", self._ahead, q)  # the inverse of a turn is its transpose
        return np.concatenate([np.tile(state[:3], self._lanes), p])

    def rates(self, unknowns: FloatArray) -> FloatArray:
        """Rates of the unknowns, s-1, shape (7, lanes * n)."""
        momentum, q = unknowns[:3], self.attitude(unknowns)
        turn = turns.matrices(q)
        seen = _into(turn, momentum) if self._in_space else momentum
        spin = self._spin_per_momentum * seen
        torque = self._torque(q, turn, spin)
        rate = _out_of(turn, torque) if self._in_space else turns.cross(momentum, spin) + torque
        if self._body.zonal or self._pull.laws:
            added = self._added(turn, momentum if self._in_space else _out_of(turn, momentum))
            rate = rate + (added if self._in_space else _into(turn, added))
        if self._in_space:
            extra = _into(self._turn_ahead, _out_of(turn, spin) - self._steady)
            drift = turns.vector_times(extra, unknowns[3:])
        else:
            extra = _out_of(self._turn_ahead, spin - self._steady)
            drift = turns.times_vector(unknowns[3:], extra)
        return np.concatenate([rate, 0.5 * drift])

    def _torque(self, q: FloatArray, turn: FloatArray, spin: FloatArray) -> FloatArray:
        """On the three moments, and one's own; along the body's axes, s-1."""
        seen = np.einsum("jim,jpm->ipm", turn, self._places)
        products = seen.take((1, 0, 0), 0) * seen.take((2, 2, 1), 0)
        torque = self._levers * np.einsum("pm,ipm->im", self._strength, products)
        if self._body.own is not None:
            torque += self._body.own(self._times, q.T, spin.T).T / self._body.unit
        return np.asarray(torque)

    def _added(self, turn: FloatArray, momentum: FloatArray) -> FloatArray:
        """On J_n and by effects, along the sky's axes, s-1."""
        body, pull = self._body, self._pull
        lanes = (3, self._lanes, self._nodes)
        axis, along = turn[:, 2].reshape(lanes), momentum.reshape(lanes)
        total = np.zeros(lanes)
        for degree, coefficient in body.zonal:
            for mass in range(pull.near):
                total += body.tide[:, np.newaxis] * zonal_torque(
                    degree,
                    coefficient / body.unit,
                    body.radius,
                    float(pull.gm[mass]),
                    pull.places[:, mass, np.newaxis, :],
                    axis,
                )
        for law in pull.laws:
            total += law(axis, along)
        return total.reshape(3, -1)


def _into(turn: FloatArray, vector: FloatArray) -> FloatArray:
    """Vectors of the sky along the body's axes."""
    return np.asarray(np.einsum("jim,jm->im", turn, vector))


def _out_of(turn: FloatArray, vector: FloatArray) -> FloatArray:
    """Vectors of the body along the sky's axes."""
    return np.asarray(np.einsum("ijm,jm->im", turn, vector))
