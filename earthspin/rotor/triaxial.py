"""Torque-free rotation of any rigid body: Jacobi's closed form (I.4.4, I.5).

The principal axes are numbered so that the angular momentum m moves about axis 3 and axis 2 has the
intermediate moment, and directed so that m1, m3 >= 0 at the start and 1, 2, 3 are right-handed.
Then

    omega = (a1 cn u, a2 sn u, a3 dn u),        u = lambda t + u0

solves Euler's equations (I.4.4). The remaining variable is one angle about the angular momentum,

    psi' = G/I3 + D3 (I3 - I1)/(I3 (G + m3)),

which follows the shortest rotation from m to the angular momentum; m3 remains positive, so there is
no singularity. With

    r = (I3 - I2)/(I3 - I1),             s = (I2 - I1)/(I3 - I1)
    D1 = s m2^2/I2 + m3^2/I3,            D3 = m1^2/I1 + r m2^2/I2
    k'^2 = (r m3^2/I3 - s m1^2/I1)/(r D1),      lambda = |I3 - I1| sqrt(r D1/(I1 I2 I3))
    a1^2 = D3/I1,        a2^2 = D3/(r I2),      a3^2 = D1/I3

(G^2 - 2T I1 is D1 (I3 - I1), and 2T I3 - G^2 is D3 (I3 - I1).) Only k'^2 contains a difference,
which is small near the separatrix; therefore all constants are computed in double-double precision,
from inputs treated as exact.

Sources: Jacobi 1850, J. reine angew. Math. 39, 293; Whittaker, Analytical Dynamics, sect. 69.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import BodyError, UndefinedError
from earthspin.numerics import elliptic, quaternion
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.double_double import TWO_PI, DoubleDouble, stack, where
from earthspin.rotor.euler import Moments, PrincipalMoments, finite, principal_moments

# --- constants of the motion ----------------------------------------------------------------------

IntArray = NDArray[np.intp]

#: Relative size below which a component of omega counts as zero; its square would underflow.
_NEGLIGIBLE = 2.0**-450
#: Smallest difference of moments whose scaling power of two has an inverse.
_LEAST_CONTRAST = 2.0**-1000
#: Smallest rate, rad/s, whose period is within a float's range.
_SLOWEST = 1e-280
#: Range of binary exponents of energies, J, that are represented with full precision.
_LEAST_ENERGY, _LARGEST_ENERGY = -960, 1000


@dataclass(frozen=True, slots=True, eq=False)
class MomentumTurn:
    """Rotation of a free body about the angular momentum: mean rate and periodic part.

    Attributes
    ----------
    rate : DoubleDouble, shape (...)
        Mean of psi', rad/s.
    swing : ndarray, shape (...)
        Factor of the periodic part, rad.
    n, mean : ndarray, shape (...)
        Parameter of the elliptic integral of the third kind, and the mean of its integrand.
    """

    rate: DoubleDouble
    swing: FloatArray
    n: FloatArray
    mean: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class JacobiMotion:
    """Constants of a torque-free rotation in Jacobi's closed form; arrays for many bodies.

    Attributes
    ----------
    moments : PrincipalMoments
        Moments of the body, in the original order of axes.
    axes : ndarray of int, shape (..., 3)
        Indices of the body axes that are axes 1, 2, 3 of the closed form.
    signs : ndarray, shape (..., 3)
        Signs of axes 1, 2, 3 along the body axes.
    amplitudes : ndarray, shape (..., 3)
        Amplitudes of cn, sn and dn in omega along 1, 2, 3, rad/s; the second is signed.
    cosines : ndarray, shape (..., 3)
        Amplitudes of the direction cosines of the angular momentum.
    angular_momentum, twice_energy : ndarray, shape (...)
        G, kg m2/s, and 2T, J.
    sense : ndarray, shape (...)
        1 if axis 3 has the largest moment, -1 if the smallest, 0 for a sphere.
    rate : DoubleDouble, shape (...)
        lambda, rad/s; 0 if omega is constant in the body.
    start : ndarray, shape (...)
        u0, the argument at t = 0; infinite for a rotation about the middle axis.
    start_angle : ndarray, shape (...)
        The amplitude of u0, whose sine is sn, rad.
    complementary_modulus : ndarray, shape (...)
        k': 0 on the separatrix, 1 for circular cones.
    descent : LandenDescent
        Landen sequence that starts from k'.
    precession : MomentumTurn
        Motion of psi.
    """

    moments: PrincipalMoments
    axes: IntArray
    signs: FloatArray
    amplitudes: FloatArray
    cosines: FloatArray
    angular_momentum: FloatArray
    twice_energy: FloatArray
    sense: FloatArray
    rate: DoubleDouble
    start: FloatArray
    start_angle: FloatArray
    complementary_modulus: FloatArray
    descent: elliptic.LandenDescent
    precession: MomentumTurn

    @property
    def exact_period(self) -> DoubleDouble:
        """Period of the angular velocity in the body, s, to 32 digits; 0 if it is not periodic."""
        quarter = self.descent.quarter_period
        moves = self.rate.hi > _SLOWEST
        return where(moves, quarter.scaled(4.0) / where(moves, self.rate, 1.0), 0.0)

    @property
    def period(self) -> FloatArray:
        """Period of the angular velocity in the body, s; infinite if it is not periodic."""
        period = np.asarray(self.exact_period.hi)
        return np.where(period > 0, period, np.inf)


class _Start(NamedTuple):
    """Initial state of a free rotation, scaled, along renumbered principal axes.

    The axes 1, 2, 3 are in ascending or in descending order of their moments.
    """

    axes: IntArray
    signs: FloatArray
    moment: DoubleDouble
    spin: FloatArray
    g: DoubleDouble
    twice_energy: DoubleDouble
    span: DoubleDouble  # I3 - I1
    side: DoubleDouble  # (G^2 - 2T I2)/(I3 - I1) = r x3 - s x1
    r: DoubleDouble
    s: DoubleDouble
    d1: DoubleDouble
    d3: DoubleDouble


def jacobi_motion(moments: Moments, omega: Any) -> JacobiMotion:
    """Compute the constants of a free rotation from moments and initial angular velocity.

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        Moments of inertia, see `principal_moments`, kg m2; of shape (..., 3) for many bodies.
    omega : array_like, shape (..., 3)
        Angular velocity at t = 0 along the principal axes, rad/s. Bodies and starts
        broadcast against each other.

    Raises
    ------
    BodyError
        If no body can have the moments, or a number is not finite.
    UndefinedError
        If the angular momentum is zero, or the energy is out of a float's range.
    """
    body, spin = _read_start(moments, omega)
    # Division by powers of two is exact and scales all numbers to order one.
    size, speed = _power_of_two(body.values), _power_of_two(spin)
    _refuse_range(size, speed)
    unit = PrincipalMoments(
        body.moment.scaled(1 / size[..., np.newaxis]),
        body.difference.scaled(1 / size[..., np.newaxis]),
    )
    spin = spin / speed[..., np.newaxis]
    spin = np.where(np.abs(spin) < _NEGLIGIBLE, 0.0, spin)
    return _constants(body, _numbered(unit, spin), size, speed)


def _constants(
    body: PrincipalMoments, start: _Start, size: FloatArray, speed: FloatArray
) -> JacobiMotion:
    i1, i2, i3 = _components(start.moment)
    r, d1, d3 = start.r, start.d1, start.d3
    # Without a cone, or with equal moments, any circular motion is valid.
    circular = (d1.hi == 0) | (start.span.hi == 0)
    k2_complementary = where(circular, 1.0, start.side / where(circular, 1.0, r * d1))
    k_complementary = k2_complementary.sqrt()
    descent = elliptic.landen_descent(k_complementary)

    sense = np.sign(start.span.hi)
    towards = np.where(sense < 0, -1.0, 1.0)  # sign of sn for positive lambda
    rate = start.span.scaled(towards) * (r * d1 / (i1 * i2 * i3)).sqrt()
    amplitudes = stack((d3 / i1).sqrt(), (d3 / (r * i2)).sqrt() * towards, (d1 / i3).sqrt())
    # Sine and cosine of the initial amplitude: 0 and 1 for a rotation about axis 3.
    upright = amplitudes.hi[..., 0] == 0
    divisor = np.where(upright[..., np.newaxis], 1.0, amplitudes.hi)
    sine = start.spin[..., 1] / divisor[..., 1]
    cosine = np.where(upright, 1.0, start.spin[..., 0] / divisor[..., 0])
    return JacobiMotion(
        moments=body,
        axes=start.axes,
        signs=start.signs,
        amplitudes=amplitudes.hi * speed[..., np.newaxis],
        cosines=(amplitudes * start.moment / start.g[..., np.newaxis]).hi,
        angular_momentum=start.g.hi * size * speed,
        twice_energy=start.twice_energy.hi * size * speed**2,
        sense=sense,
        rate=rate.scaled(speed),
        start=elliptic.first_kind(sine, cosine, np.asarray(k2_complementary.hi)),
        start_angle=np.arctan2(sine, cosine),
        complementary_modulus=np.asarray(k_complementary.hi),
        descent=descent,
        precession=_precession(start, k_complementary, descent, speed),
    )


def _precession(
    start: _Start, k_complementary: DoubleDouble, descent: elliptic.LandenDescent, speed: FloatArray
) -> MomentumTurn:
    """Compute mean rate and periodic part of the rotation about the angular momentum.

    It integrates psi' = G/I3 + D3 (I3 - I1)/(G I3) / (1 + b dn u), with b = a3 I3/G.

    After one Landen step, to k1 = (1 - k')/(1 + k') and v = (1 + k')u/2,

        1/(1 + b dn u) = [1 + 2 b k1/(1 + b) sn^2 v/(1 + n sn^2 v)]/(1 + b)

    with n = k1 (1 - b)/(1 + b). All terms are positive, and 1 + n is computed without cancellation;
    the usual form divides by 1 - b^2 dn^2, which vanishes for a narrow cone.
    """
    i1, i2, i3 = _components(start.moment)
    g, d3 = start.g, start.d3
    b = (start.d1 * i3).sqrt() / g
    k1 = (1.0 - k_complementary) / (1.0 + k_complementary)
    n = k1 * (1.0 - b) / (1.0 + b)
    mean = elliptic.third_kind_mean(n, descent)
    mean_inverse = (1.0 + b.scaled(2.0) * k1 / (1.0 + b) * mean) / (1.0 + b)
    rate = g / i3 + d3 * start.span / (i3 * g) * mean_inverse
    # dt = du/lambda, and b/lambda = I3 sqrt(I1 I2/r)/(G |I3 - I1|).
    swing = (
        np.sign(start.span.hi)
        * (d3 / (g * g)).hi
        * np.sqrt((i1 * i2 / start.r).hi)
        * (2 * k1.hi * (1 + k1.hi) / (1 + b.hi) ** 2)
    )
    return MomentumTurn(rate.scaled(speed), swing, np.asarray(n.hi), np.asarray(mean.hi))


def _numbered(unit: PrincipalMoments, spin: FloatArray) -> _Start:
    """Renumber the principal axes so that the angular momentum moves around axis 3.

    Axis 2 has the intermediate moment.
    """
    c_b, a_c, b_a = np.moveaxis(unit.difference.hi, -1, 0)
    # Rank of each moment, from the differences because nearly equal moments may be equal as floats.
    rank = np.stack(
        [(b_a < 0) * 1 + (a_c > 0), (b_a >= 0) * 1 + (c_b < 0), (a_c <= 0) * 1 + (c_b >= 0)],
        axis=-1,
    )
    ascending = np.argsort(rank, axis=-1)
    start = _start_along(unit, spin, ascending)
    # On the separatrix either extreme axis is valid, unless two moments are equal: then the third.
    smallest = (start.side.hi < 0) | ((start.side.hi == 0) & (start.r.hi < start.s.hi))
    if not np.any(smallest):
        return start
    return _start_along(
        unit, spin, np.where(smallest[..., np.newaxis], ascending[..., ::-1], ascending)
    )


def _start_along(unit: PrincipalMoments, spin: FloatArray, axes: IntArray) -> _Start:
    """Initial state of a free rotation with its principal axes in the given order.

    The argument `axes` lists the axes of the body in the new order.
    """
    parity = np.where((axes[..., 1] - axes[..., 0]) % 3 == 1, 1.0, -1.0)
    moment, spin = _take(unit.moment, axes), np.take_along_axis(spin, axes, -1)
    signs = np.where(spin < 0, -1.0, 1.0)
    signs[..., 1] = parity * signs[..., 0] * signs[..., 2]  # right-handed
    spin = spin * signs
    momentum = moment * spin
    x1, x2, x3 = _components(momentum * spin)  # m^2/I
    difference = _take(unit.difference, axes).scaled(parity[..., np.newaxis])
    contrast = np.maximum(_power_of_two(difference.hi), _LEAST_CONTRAST)
    i32, i13, i21 = _components(difference.scaled(1 / contrast[..., np.newaxis]))
    sphere = i13.hi == 0
    i31 = where(sphere, 1.0, -i13)
    r, s = where(sphere, 1.0, i32 / i31), where(sphere, 0.0, i21 / i31)
    m1, m2, m3 = _components(momentum * momentum)
    return _Start(
        axes=axes,
        signs=signs,
        moment=moment,
        spin=spin,
        g=(m1 + m2 + m3).sqrt(),
        twice_energy=x1 + x2 + x3,
        span=-i13.scaled(contrast),
        # Divide last, so that integer starts on the separatrix give exactly zero.
        side=(i32 * x3 - i21 * x1) / i31,
        r=r,
        s=s,
        d1=s * x2 + x3,
        d3=x1 + r * x2,
    )


def _read_start(moments: Moments, omega: Any) -> tuple[PrincipalMoments, FloatArray]:
    """Check moments of inertia and angular velocity, and broadcast the arrays to one shape."""
    body = principal_moments(moments)
    spin = finite(omega, "omega", "rad/s")
    if spin.ndim == 0 or spin.shape[-1] != 3:
        raise BodyError("rotor", "shape of omega", spin.shape, "give three components, in rad/s")
    if np.any(np.all(spin == 0, axis=-1)):
        raise UndefinedError(
            "omega = [0, 0, 0] rad/s gives no angular momentum, so there is no rotation to "
            "follow; give a start with at least one component other than zero"
        )
    moment, difference = body.moment, body.difference
    try:
        a, b, c, d, spin = np.broadcast_arrays(
            moment.hi, moment.lo, difference.hi, difference.lo, spin
        )
    except ValueError:
        raise BodyError(
            "rotor", "shape of omega", spin.shape, f"it must broadcast with {moment.hi.shape}"
        ) from None
    return PrincipalMoments(DoubleDouble(a, b), DoubleDouble(c, d)), spin


def _refuse_range(size: FloatArray, speed: FloatArray) -> None:
    exponent = np.log2(size) + 2 * np.log2(speed)
    outside = (exponent < _LEAST_ENERGY) | (exponent > _LARGEST_ENERGY)
    if np.any(outside):
        moment, rate = float(size[outside].flat[0]), float(speed[outside].flat[0])
        raise UndefinedError(
            f"a float cannot hold the energy of a body with moments of {moment:.1g} kg m2 at "
            f"{rate:.1g} rad/s; choose other units"
        )


def _power_of_two(numbers: FloatArray) -> FloatArray:
    _, exponent = np.frexp(np.max(np.abs(numbers), axis=-1))
    return np.asarray(np.ldexp(1.0, exponent))


def _take(numbers: DoubleDouble, axes: IntArray) -> DoubleDouble:
    return DoubleDouble(
        np.take_along_axis(numbers.hi, axes, -1), np.take_along_axis(numbers.lo, axes, -1)
    )


def _components(vector: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble, DoubleDouble]:
    return vector[..., 0], vector[..., 1], vector[..., 2]


# --- Jacobi's closed form in time -----------------------------------------------------------------
# Phases are reduced with 32 digits, so that their error grows beyond that of the functions only
# after about 10^15 rad.

#: Error bound of the closed form for exact inputs: relative to the largest angular velocity, and
#: absolute for the elements of the attitude. Measured: 2e-14 (`python -m tests.rotor.accuracy
#: 600`).
CLOSED_FORM_ERROR = 1e-13
#: Relative error bound of rates and periods in double-double numbers (measured: 2.0**-103.7).
_RATE_ERROR = 2.0**-103
#: Number of half periods or turns up to which it is found exactly from floats.
_EXACT_STEPS = 2.0**50


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
    error : ndarray, shape (...)
        Bound on the error of all of these, relative to their largest values.
    """

    times: FloatArray
    omega_body: FloatArray
    angular_momentum_body: FloatArray
    attitude: FloatArray
    omega_inertial: FloatArray
    energy: FloatArray
    error: FloatArray


def free_rotation(moments: Moments, omega: Any, times: Any) -> FreeRotation:
    """Compute the torque-free rotation of any rigid body in closed form (I.4.4, I.5).

    Inputs are treated as exact. A change in the last digit of an input may change a late attitude
    noticeably; this is a property of the motion, not an error of the method.

    Parameters
    ----------
    moments : sequence of three numbers, mapping or PrincipalMoments
        Moments of inertia, see `principal_moments`, kg m2; of shape (..., 3) for many bodies.
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
        error=np.clip(phase_error(motion, t), CLOSED_FORM_ERROR, 2.0),
    )


def phase_error(motion: JacobiMotion, times: FloatArray) -> FloatArray:
    """Bound on the error of the phases of a free rotation at the latest of given times, rad.

    Near the separatrix the period depends strongly on k'^2, a difference whose terms are larger by
    the factor cos^2(start)/k'^2. The turn about the angular momentum is G/I3 plus a term that may
    nearly cancel it.

    Parameters
    ----------
    motion : JacobiMotion
    times : ndarray, shape (n,)
        s.
    """
    periodic = ~motion.descent.separatrix
    quarter = np.where(periodic, motion.descent.quarter_period.hi, 1.0)
    closeness = np.where(periodic, motion.complementary_modulus, 1.0)
    sharpness = 0.5 / quarter * (np.cos(motion.start_angle) / closeness) ** 2
    third = np.take_along_axis(motion.moments.values, motion.axes[..., 2:], -1)[..., 0]
    rate = np.abs(motion.rate.hi) * (1 + sharpness) + motion.angular_momentum / third
    return np.asarray(_RATE_ERROR * rate * np.max(np.abs(times), initial=0.0))


@dataclass(frozen=True, slots=True, eq=False)
class Phase:
    """Values and argument of the elliptic functions of a free rotation at given times.

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
    upper: elliptic.Jacobi
    lower: elliptic.Jacobi

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
    remainder, sign = _less_whole(run, half_period, start)
    u = remainder.hi + start
    return Phase(times, u, sign, *elliptic.jacobi(u, motion.descent))


def _less_whole(
    run: DoubleDouble, step: DoubleDouble, ahead: FloatArray | float = 0.0
) -> tuple[DoubleDouble, FloatArray]:
    """Phase less whole steps, nearest to `-ahead`, and -1 after an odd number of them, otherwise 1.

    A second pass is needed where the number of steps is not exact. Without a step (on the
    separatrix, where the start may be infinite) the phase is returned.
    """
    periodic, sign = step.hi > 0, np.asarray(1.0)
    for _ in range(2):
        steps = np.rint(np.where(periodic, run.hi + ahead, 0.0) / np.where(periodic, step.hi, 1))
        run, sign = run - step * steps, sign * (1.0 - 2.0 * np.mod(steps, 2.0))
        if np.max(np.abs(steps), initial=0.0) < _EXACT_STEPS:
            break
    return run, sign


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
    x, y, z = np.moveaxis(phase.along(motion.cosines), -1, 0)
    # the smallest rotation from the angular momentum to the third axis
    turn = np.stack([1 + z, y, -x, np.zeros_like(z)], axis=-1)
    return quaternion.multiply(
        quaternion.rotation_about_z(_half_psi(motion, phase)),
        turn / np.sqrt(np.sum(turn * turn, axis=-1, keepdims=True)),
    )


def _attitude(motion: JacobiMotion, phase: Phase) -> FloatArray:
    """Attitude relative to the first time, as a quaternion along the body axes x, y, z."""
    frame = momentum_frame(motion, phase)
    turn = quaternion.multiply(quaternion.conjugate(frame[..., :1, :]), frame)
    return np.concatenate([turn[..., :1], to_body(motion, turn[..., 1:])], axis=-1)


def _half_psi(motion: JacobiMotion, phase: Phase) -> FloatArray:
    """Half of the rotation angle of a body about its angular momentum since the first time, rad."""
    precession = motion.precession
    run = precession.rate.scaled(0.5)[..., np.newaxis] * phase.times
    remainder, _ = _less_whole(run, TWO_PI)
    periodic = precession.swing[..., np.newaxis] * elliptic.third_kind_periodic(
        phase.u, phase.lower, precession.n, precession.mean, motion.descent
    )
    return np.asarray(remainder.hi + (periodic - periodic[..., :1]) / 2)
