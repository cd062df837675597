r"""Euler's equations for the full attitude of rigid bodies in one time window, in two forms.

With the angular momentum L in units of C u (u a unit of spin), the quaternion q from the body's
axes to the sky's, its matrix R, and the torque n along the body's axes,

    in space    l' = R n,               \omega = I^{-1} R^T l
    in the body m' = m x \omega + n,    \omega = I^{-1} m

and q' = (1/2) q \omega in both forms. Inside a window the attitude is relative to a uniform
rotation with the initial angular velocity \omega_0, fixed in the body or in space,

    q = p e,    e' = (1/2) e \omega_0,    p' = (1/2) p [e (\omega - \omega_0) e^{-1}]
    q = e p,    e' = (1/2) \omega_0 e,    p' = (1/2) [e^{-1} (R \omega - \omega_0) e] p

If the spin is nearly constant, p changes slowly and few Picard iterations are needed. The torque of
a mass at r is 3 GM/r5 r x I r (I.9.34). The differences of the moments are inputs, so they are not
computed by subtraction. Arrays have the component first; several bodies with the same
perturbers follow one another in each row: shape (3, bodies * nodes).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from earthspin.numerics import rotations
from earthspin.numerics.arrays import FloatArray
from earthspin.torque.gravity import apply, cross, zonal_law

#: Torque divided by C along the body's axes, s-2, shape (m, 3), from times (s), shape (m,),
#: quaternions (m, 4) and angular velocities along the body's axes, rad/s (m, 3).
CustomTorque = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
#: Contribution of an effect to l' along the sky's axes, s-1, from figure axis and angular momentum,
#: each of shape (3, bodies, nodes) in one window, or (3, w, n) in many windows for one body.
SkyLaw = Callable[[FloatArray, FloatArray], FloatArray]
#: Contribution of an effect that depends on the full attitude, from matrices from body to sky axes,
#: shape (3, 3, bodies, nodes), and angular velocities along the body's axes, rad/s, shape (3,
#: bodies, nodes): a torque per C along the body's axes, s-2, or a change of the products of inertia
#: per C, shape (6, bodies, nodes), in the order of `earthspin.torque.gravity.tidal_tensor`. In many
#: windows, shapes end with (w, n) instead.
BodyLaw = Callable[[FloatArray, FloatArray], FloatArray]

#: Inputs that are changed in the neighbours of a body, in this order; the last is the first state.
FLATTENING, TRIAXIALITY, TIDE, ROUNDING = "flattening", "triaxiality", "tide", "rounding"
START = "start"


@dataclass(frozen=True, kw_only=True)
class LiquidCore:
    """Fluid core of uniform vorticity, coupled to the mantle by friction and by its flattening.

    Attributes
    ----------
    moment : float
        Polar moment of the core, divided by C of the whole body.
    flattening : float
        (C - A)/C of the core.
    friction : float
        Torque divided by C and by the difference of the angular velocities, s-1.
    spin : ndarray, shape (3,), or None
        Angular velocity of the core along the sky's axes at the start, rad/s; None: as the mantle.
    """

    moment: float
    flattening: float
    friction: float
    spin: FloatArray | None

    @cached_property
    def moments(self) -> FloatArray:
        """Principal moments divided by C of the whole body, shape (3, 1)."""
        equatorial = self.moment * (1 - self.flattening)
        return np.array([[equatorial], [equatorial], [self.moment]])

    def torque(self, core: FloatArray, mantle: FloatArray) -> FloatArray:
        """Torque of the core on the mantle, divided by C, along the body's axes, s-2.

        Parameters
        ----------
        core, mantle : ndarray, shape (3, ...)
            Angular velocities along the body's axes, rad/s.
        """
        x, y, z = core
        bulge = self.moment * self.flattening * z
        pressure = np.stack([-bulge * y, bulge * x, np.zeros_like(z)])
        return np.asarray(self.friction * (core - mantle) + pressure)


@dataclass(frozen=True, kw_only=True)
class Rigid:
    """Parameters of one or more rigid bodies under the same perturbers, one column per body.

    Attributes
    ----------
    c_minus_a, c_minus_b : ndarray, shape (bodies,)
        (C - A)/C and (C - B)/C.
    tide : ndarray, shape (bodies,)
        Factor on the tides of all masses.
    unit : float
        Unit of spin u, rad/s.
    zonal : sequence of (int, float)
        Degrees n with J_n times M a2/C.
    radius : float
        Reference radius of J_n, m.
    trend : float
        Relative rate of the differences of moments, s-1.
    epoch : float
        Start of the motion, s from J2000.0.
    custom_torque : callable or None
        Custom torque.
    core : LiquidCore or None
        Fluid core; the moments are those of the whole body, the angular velocity is that of the
        mantle.
    """

    c_minus_a: FloatArray
    c_minus_b: FloatArray
    tide: FloatArray
    unit: float
    zonal: Sequence[tuple[int, float]] = ()
    radius: float = 0.0
    trend: float = 0.0
    epoch: float = 0.0
    custom_torque: CustomTorque | None = None
    core: LiquidCore | None = None

    @cached_property
    def moments(self) -> FloatArray:
        """Ratios A/C, B/C and C/C of the principal moments of each body, shape (3, bodies)."""
        return np.stack([1 - self.c_minus_a, 1 - self.c_minus_b, np.ones_like(self.c_minus_a)])

    @cached_property
    def mantle_moments(self) -> FloatArray:
        """Principal moments without those of the core, divided by C, shape (3, bodies)."""
        return self.moments if self.core is None else self.moments - self.core.moments

    @cached_property
    def moment_differences(self) -> FloatArray:
        """Ratios (C - B)/C, (A - C)/C, (B - A)/C of the moments of each body, shape (3, bodies)."""
        return np.stack([self.c_minus_b, -self.c_minus_a, self.c_minus_a - self.c_minus_b])

    @property
    def count(self) -> int:
        """Number of rigid bodies, each of which has one column in all arrays."""
        return int(self.tide.size)

    def first(self, copies: int = 1) -> Rigid:
        """Return the first body only, repeated in a given number of columns."""
        first = np.zeros(copies, dtype=int)
        return replace(
            self,
            c_minus_a=self.c_minus_a[first],
            c_minus_b=self.c_minus_b[first],
            tide=self.tide[first],
        )

    def spin(self, state: FloatArray) -> FloatArray:
        """Angular velocity of a single body along its principal axes, rad/s, shape (3, t).

        Parameters
        ----------
        state : ndarray, shape (7, t) or (10, t)
            Angular momentum along the sky's axes, in units of C u, attitude, and angular momentum
            of the core.
        """
        mantle = state[:3] if self.core is None else state[:3] - state[7:]
        in_body = rotations.rotated(rotations.conjugate(state[3:7]), mantle)
        return self.unit / self.mantle_moments * in_body


@dataclass(frozen=True)
class Perturbers:
    """GM of the perturbing masses, and their positions at the nodes of one time window.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times from the start of the motion, s.
    gm : ndarray, shape (masses,)
        GM, m3 s-2.
    places : ndarray, shape (3, masses, n)
        Positions along the sky's axes, m.
    near : int
        Number of near masses, which are the first in `gm` and `places`. Only they also act on the
        zonal harmonics J_n of the body; the others are too far away.
    laws : sequence of callable
        Contributions of effects to the torque.
    body_torques, inertia_changes : sequence of callable
        Effects that depend on the full attitude: torques, and changes of the products of inertia.
    """

    times: FloatArray
    gm: FloatArray
    places: FloatArray
    near: int = 0
    laws: Sequence[SkyLaw] = ()
    body_torques: Sequence[BodyLaw] = ()
    inertia_changes: Sequence[BodyLaw] = ()


class Equations:
    """Euler's equations in one time window, for angular momentum and an attitude quaternion.

    Several bodies under the same perturbers are integrated together. Arrays of
    unknowns and of rates have the shape (7, bodies * n): the n times of the first body, then those
    of the next. A fluid core adds three rows, its angular momentum along the sky's axes; the first
    rows are then those of the whole body.

    Parameters
    ----------
    body : Rigid
        The bodies, one in each column.
    masses : Perturbers
    in_space : bool
        True if the angular momentum is along the sky's axes, False if along the body's axes.
    start : ndarray, shape (7, bodies) or (10, bodies)
        Unknowns at the start of the window.
    since : ndarray, shape (n,)
        Times from the start of the window, s.
    """

    def __init__(
        self, body: Rigid, masses: Perturbers, in_space: bool, start: FloatArray, times: FloatArray
    ) -> None:
        self._body, self._masses, self._in_space = body, masses, in_space
        self._count, self._nodes = start.shape[1], times.size
        self._spin_per_momentum = self._at_nodes(body.unit / body.mantle_moments)
        self._moment_differences = self._at_nodes(3 / body.unit * body.moment_differences)
        self._places = self._in_columns(masses.places)
        r2 = np.einsum("ipm,ipm->pm", masses.places, masses.places)
        tide = masses.gm[:, np.newaxis] / (r2 * r2 * np.sqrt(r2))
        tide = tide * (1 + body.trend * (body.epoch + masses.times))
        self._tide = self._in_columns(tide) * self._at_nodes(body.tide)
        zonal = {degree: coefficient / body.unit for degree, coefficient in body.zonal}
        near = masses.gm[: masses.near, np.newaxis, np.newaxis]
        places = masses.places[:, : masses.near, np.newaxis]
        self._on_harmonics = zonal_law(zonal, body.radius, near, places) if zonal else None
        matrix = rotations.matrices(start[3:7])
        momentum = _into(matrix, start[:3]) if in_space else start[:3]
        if body.core is not None:
            momentum = momentum - _into(matrix, start[7:])
        spin = body.unit / body.mantle_moments * momentum
        #: Angular velocity at the start of the window, rad/s, shape (3, bodies), along the same
        #: axes as the angular momentum.
        self.steady = _out_of(matrix, spin) if in_space else spin
        self._steady = self._at_nodes(self.steady)
        reference = rotations.rotation_about(self._steady, self._in_columns(times))
        self._reference = rotations.left(reference) if in_space else rotations.right(reference)
        self._reference_matrix = rotations.matrices(reference)

    def _at_nodes(self, values: FloatArray) -> FloatArray:
        """Repeat the value of each body for all nodes of the time window."""
        return np.repeat(values, self._nodes, axis=-1)

    def _in_columns(self, values: FloatArray) -> FloatArray:
        """Repeat the values at all nodes of the time window for each body."""
        return np.concatenate([values] * self._count, axis=-1)

    def attitude(self, unknowns: FloatArray) -> FloatArray:
        """Attitude quaternions of all bodies from the unknowns, shape (4, bodies * nodes)."""
        return np.asarray(np.einsum("abm,bm->am", self._reference, unknowns[3:7]))

    def unknowns(self, state: FloatArray) -> FloatArray:
        """Unknowns of the equations: angular momentum, and attitude relative to uniform rotation.

        `state`, shape (7, n) or (10, n), holds angular momentum and attitude of one body, and the
        angular momentum of its core. They are repeated for all bodies.

        This is only valid for the form with the angular momentum along the sky's axes.
        """
        q = self._in_columns(state[3:7])
        p = np.einsum("bam,bm->am", self._reference, q)  # the inverse is the transpose
        return np.concatenate([self._in_columns(state[:3]), p, self._in_columns(state[7:])])

    def rates(self, unknowns: FloatArray) -> FloatArray:
        """Time derivatives of the unknowns: angular momentum and relative attitude, s-1.

        The shape is (7, bodies * n), with n values for each body, or (10, bodies * n).
        """
        momentum, q = unknowns[:3], self.attitude(unknowns)
        matrix = rotations.matrices(q)
        in_body = _into(matrix, momentum) if self._in_space else momentum
        core = self._body.core
        core_momentum = _into(matrix, unknowns[7:]) if core is not None else np.zeros((3, 1))
        spin = self._spin_per_momentum * (in_body if core is None else in_body - core_momentum)
        if self._masses.inertia_changes:
            change = self._sum_of(self._masses.inertia_changes, matrix, spin)
            spin = spin - self._spin_per_momentum / self._body.unit * apply(change, spin)
            torque = self._torque(q, matrix, spin, change)
        else:
            torque = self._torque(q, matrix, spin)
        if self._masses.body_torques:
            torque += self._sum_of(self._masses.body_torques, matrix, spin) / self._body.unit
        rate = _out_of(matrix, torque) if self._in_space else cross(momentum, spin) + torque
        if self._body.zonal or self._masses.laws:
            in_space = momentum if self._in_space else _out_of(matrix, momentum)
            effects_torque = self._effects_torque(matrix, in_space)
            rate = rate + (effects_torque if self._in_space else _into(matrix, effects_torque))
        if self._in_space:
            spin_change = _into(self._reference_matrix, _out_of(matrix, spin) - self._steady)
            quaternion_rate = rotations.vector_times(spin_change, unknowns[3:7])
        else:
            spin_change = _out_of(self._reference_matrix, spin - self._steady)
            quaternion_rate = rotations.times_vector(unknowns[3:7], spin_change)
        if core is None:
            return np.concatenate([rate, 0.5 * quaternion_rate])
        unit = self._body.unit
        on_mantle = core.torque(unit * core_momentum / core.moments, spin) / unit
        return np.concatenate([rate, 0.5 * quaternion_rate, -_out_of(matrix, on_mantle)])

    def _sum_of(self, laws: Sequence[BodyLaw], matrix: FloatArray, spin: FloatArray) -> FloatArray:
        """Sum of effects that depend on the full attitude, shape (3 or 6, bodies * nodes)."""
        shape = (self._count, self._nodes)
        matrix, spin = matrix.reshape(3, 3, *shape), spin.reshape(3, *shape)
        total = sum(law(matrix, spin) for law in laws)
        return np.asarray(total).reshape(-1, self._count * self._nodes)

    def _torque(
        self,
        q: FloatArray,
        matrix: FloatArray,
        spin: FloatArray,
        inertia_change: FloatArray | None = None,
    ) -> FloatArray:
        """Tidal torque on the bulge plus custom torque, in body axes, per C and spin unit, s-1.

        The torque is divided by C u. C is the polar moment of inertia, and u the unit of spin.
        """
        position = np.einsum("jim,jpm->ipm", matrix, self._places)
        products = position.take((1, 0, 0), 0) * position.take((2, 2, 1), 0)
        torque = self._moment_differences * np.einsum("pm,ipm->im", self._tide, products)
        if inertia_change is not None:
            on_change = cross(position, apply(inertia_change[:, np.newaxis], position))
            torque += 3 / self._body.unit * np.einsum("pm,ipm->im", self._tide, on_change)
        if self._body.custom_torque is not None:
            times = self._in_columns(self._masses.times)
            torque += self._body.custom_torque(times, q.T, spin.T).T / self._body.unit
        return np.asarray(torque)

    def _effects_torque(self, matrix: FloatArray, momentum: FloatArray) -> FloatArray:
        """Torque on harmonics J_n and by other effects, in sky axes, per C and spin unit, s-1.

        The torque is divided by C u. C is the polar moment of inertia, and u the unit of spin.
        """
        body, masses = self._body, self._masses
        shape = (3, self._count, self._nodes)
        axis, momentum_vectors = matrix[:, 2].reshape(shape), momentum.reshape(shape)
        total = np.zeros(shape)
        if self._on_harmonics is not None:
            torque = np.sum(self._on_harmonics(axis[:, np.newaxis]), axis=1)
            total += body.tide[:, np.newaxis] * torque
        for law in masses.laws:
            total += law(axis, momentum_vectors)
        return total.reshape(3, -1)


def _into(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Transform vectors from sky axes to body axes by rotation matrices."""
    return np.asarray(np.einsum("jim,jm->im", matrix, vector))


def _out_of(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Transform vectors from body axes to sky axes by rotation matrices."""
    return np.asarray(np.einsum("ijm,jm->im", matrix, vector))
