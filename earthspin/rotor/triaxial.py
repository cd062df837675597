"""Torque-free rotation of any rigid body: Jacobi's closed form in time (I.4.4, I.5).

The formulas and constants are in `constants_of_motion`. Phases are reduced with 32 digits, so that
the error does not grow with time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.errors import BodyError
from earthspin.numerics import quaternion
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.double_double import TWO_PI
from earthspin.numerics.elliptic import Jacobi, jacobi, third_kind_periodic
from earthspin.rotor.constants_of_motion import JacobiMotion, jacobi_motion
from earthspin.rotor.moments import Moments, finite

#: Error bound of the closed form for exact inputs: relative to the largest angular velocity, and
#: absolute for the elements of the attitude. Measured: 2e-14 (`python -m tests.rotor.accuracy
#: 600`).
CLOSED_FORM_ERROR = 1e-13


@dataclass(frozen=True, slots=True, eq=False)
class FreeRotation:
    """Angular velocity, angular momentum and attitude of a freely rotating body over time.

    The inertial axes are those of the body at t = 0.

    Attributes
    ----------
    times : ndarray, shape (n,)
        s.
    omega_body : ndarray, shape (..., n, 3)
        Angular velocity along the principal axes, rad/s.
    angular_momentum_body : ndarray, shape (..., n, 3)
        Along the principal axes, kg m2/s.
    attitude : ndarray, shape (..., n, 4)
        Unit quaternion w, x, y, z from body to inertial axes: 1, 0, 0, 0 at t = 0, and
        continuous in time.
    omega_inertial : ndarray, shape (..., n, 3)
        Angular velocity along the inertial axes, rad/s.
    energy : ndarray, shape (..., n)
        Kinetic energy, J.
    """

    times: FloatArray
    omega_body: FloatArray
    angular_momentum_body: FloatArray
    attitude: FloatArray
    omega_inertial: FloatArray
    energy: FloatArray


def free_rotation(moments: Moments, omega: Any, times: Any) -> FreeRotation:
    """Compute the torque-free rotation of any rigid body in closed form (I.4.4, I.5).

    Inputs are treated as exact. A change in the last digit of an input may change a late attitude
    noticeably; this is a property of the motion, not an error of the method.

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        As for `principal_moments`, kg m2; of shape (..., 3) for many bodies.
    omega : array_like, shape (..., 3)
        Angular velocity at t = 0 along the principal axes, rad/s. Bodies and starts
        broadcast against each other.
    times : array_like, shape (n,)
        s, of either sign, in any order.

    Returns
    -------
    FreeRotation

    Raises
    ------
    BodyError
        If no body can have the moments, or a number is not finite.
    UndefinedError
        If the angular momentum is zero.
    """
    t = finite(times, "times", "s")
    if t.ndim != 1:
        raise BodyError(
            "rotor", "shape of times", t.shape, "give a one-dimensional array of times, in s"
        )
    motion = jacobi_motion(moments, omega)
    # t = 0 is the first time, because psi is measured from it.
    phase = phase_at(motion, np.concatenate([[0.0], t]))
    omega_body = to_body(motion, phase.along(motion.amplitudes))[..., 1:, :]
    momentum = omega_body * motion.moments.values[..., np.newaxis, :]
    attitude = _attitude(motion, phase)[..., 1:, :]
    return FreeRotation(
        times=t,
        omega_body=omega_body,
        angular_momentum_body=momentum,
        attitude=attitude,
        omega_inertial=quaternion.rotate(attitude, omega_body),
        energy=np.sum(omega_body * momentum, axis=-1) / 2,
    )


@dataclass(frozen=True, slots=True, eq=False)
class Phase:
    """Values of the elliptic functions of a free rotation at given times, with their argument.

    Attributes
    ----------
    times : ndarray, shape (n,)
        s.
    u : ndarray, shape (..., n)
        Argument of the elliptic functions, reduced by whole half periods to -K to K.
    turned : ndarray, shape (..., n)
        -1 after an odd number of half periods, otherwise 1.
    upper, lower : Jacobi
        Elliptic functions of u, and of the argument after one Landen step.
    """

    times: FloatArray
    u: FloatArray
    turned: FloatArray
    upper: Jacobi
    lower: Jacobi

    def along(self, amplitudes: FloatArray) -> FloatArray:
        """Multiply the elliptic functions cn, sn, dn by three amplitudes, shape (..., n, 3)."""
        sn, cn, dn = self.upper
        return np.stack([self.turned * cn, self.turned * sn, dn], -1) * amplitudes[..., None, :]


def phase_at(motion: JacobiMotion, times: FloatArray) -> Phase:
    """Evaluate the elliptic functions of a torque-free rotation at given times.

    Parameters
    ----------
    motion : JacobiMotion
    times : ndarray, shape (n,)
        s.
    """
    half_period = motion.descent.quarter_period.scaled(2.0)[..., np.newaxis]
    start = motion.start[..., np.newaxis]
    run = motion.rate[..., np.newaxis] * times
    periodic = half_period.hi > 0  # otherwise on the separatrix, where u may be infinite
    halves = np.rint(
        np.where(periodic, run.hi + start, 0.0) / np.where(periodic, half_period.hi, 1)
    )
    rest = run - half_period * halves
    u = rest.hi + start
    return Phase(times, u, 1.0 - 2.0 * np.mod(halves, 2.0), *jacobi(u, motion.descent))


def to_body(motion: JacobiMotion, vectors: FloatArray) -> FloatArray:
    """Convert vector components from the renumbered axes 1, 2, 3 to the body axes x, y, z.

    Parameters
    ----------
    motion : JacobiMotion
    vectors : ndarray, shape (..., n, 3)
    """
    order = np.argsort(motion.axes, axis=-1)[..., np.newaxis, :]
    return np.take_along_axis(vectors * motion.signs[..., np.newaxis, :], order, axis=-1)


def momentum_frame(motion: JacobiMotion, phase: Phase) -> FloatArray:
    """Quaternion from renumbered body axes to inertial axes with angular momentum along z.

    Parameters
    ----------
    motion : JacobiMotion
    phase : Phase
        Phases; psi is measured from the first time.
    """
    return quaternion.multiply(
        quaternion.rotation_about_z(_half_psi(motion, phase)),
        _shortest_turn(phase.along(motion.cosines)),
    )


def _attitude(motion: JacobiMotion, phase: Phase) -> FloatArray:
    """Attitude relative to the first time, as a quaternion along the body axes x, y, z."""
    frame = momentum_frame(motion, phase)
    turn = quaternion.multiply(quaternion.conjugate(frame[..., :1, :]), frame)
    return np.concatenate([turn[..., :1], to_body(motion, turn[..., 1:])], axis=-1)


def _shortest_turn(cosines: FloatArray) -> FloatArray:
    """Quaternion of the smallest rotation from a unit vector to the third axis."""
    x, y, z = np.moveaxis(cosines, -1, 0)
    turn = np.stack([1 + z, y, -x, np.zeros_like(z)], axis=-1)
    return np.asarray(turn / np.sqrt(np.sum(turn * turn, axis=-1, keepdims=True)))


def _half_psi(motion: JacobiMotion, phase: Phase) -> FloatArray:
    """Half of the angle by which a body has rotated about its angular momentum, rad."""
    precession = motion.precession
    run = precession.rate.scaled(0.5)[..., np.newaxis] * phase.times
    rest = run - TWO_PI * np.rint(run.hi / TWO_PI.hi)
    periodic = precession.swing[..., np.newaxis] * third_kind_periodic(
        phase.u, phase.lower, precession.n, precession.mean, motion.descent
    )
    return np.asarray(rest.hi + (periodic - periodic[..., :1]) / 2)
