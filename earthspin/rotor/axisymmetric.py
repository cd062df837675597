"""Torque-free rotation of an axisymmetric body (I.6).

With I1 = I2 about transverse axes and I3 about the figure axis, omega moves about the figure axis
on the *body cone* of half-angle alpha, and in space about the angular momentum L on the *space
cone* of half-angle |theta - alpha|, where theta is the angle between figure axis and L. The three
vectors are always coplanar. The third inertial axis is along L, and at t = 0 the attitude is phi =
0, psi = pi/2, so that omega starts in the plane of the body's first and third axis.

The inputs are I1 and the difference I3 - I1, positive for an oblate and negative for a prolate
body, to avoid cancellation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import NORMAL_95
from earthspin.errors import BodyError, UndefinedError
from earthspin.numerics.arrays import FloatArray, Numeric

#: Tolerance for a negative 2T I3 - L2 due to rounding, relative to L2.
_ROUNDING = 8 * np.finfo(float).eps


@dataclass(frozen=True, slots=True)
class SymmetricRotor:
    """An axisymmetric rigid body in torque-free rotation.

    Attributes
    ----------
    equatorial : float or ndarray, shape (...)
        Transverse moment I1 = I2, kg m2.
    difference : float or ndarray, shape (...)
        I3 - I1, kg m2: above -I1 (needle), up to I1 (lamina).
    speed : float or ndarray, shape (...)
        Magnitude of the angular velocity, rad/s.
    alpha : float or ndarray, shape (...)
        Half-angle of the body cone: between figure axis and angular velocity, rad, 0 to pi.

    Raises
    ------
    BodyError
        If a value is out of range.
    """

    equatorial: Numeric
    difference: Numeric
    speed: Numeric
    alpha: Numeric

    def __post_init__(self) -> None:
        i1, difference = self.equatorial, self.difference
        _require(np.greater(i1, 0), "equatorial", i1, "a principal moment must be positive")
        possible = np.greater(difference, -np.asarray(i1)) & np.less_equal(difference, i1)
        _require(possible, "difference", difference, "I3 - I1 must be above -I1, and at most I1")
        _require(np.greater(self.speed, 0), "speed", self.speed, "give |omega| above 0, in rad/s")
        possible = np.greater_equal(self.alpha, 0) & np.less_equal(self.alpha, np.pi)
        _require(possible, "alpha", self.alpha, "the half-angle of the cone must be 0 to pi rad")

    @property
    def polar(self) -> Numeric:
        """Moment of inertia about the figure axis, I3, kg m2."""
        return self.equatorial + self.difference

    @property
    def wobble_rate(self) -> Numeric:
        """Rate at which the angular velocity circles the figure axis in the body, rad/s (I.6.7).

        It is omega cos(alpha) (I3 - I1)/I1.
        """
        return self.speed * np.cos(self.alpha) * self.difference / self.equatorial

    @property
    def theta(self) -> Numeric:
        """Angle from the figure axis to the angular momentum, rad (I.6.20).

        tan theta = (I1/I3) tan alpha (I.6.20).
        """
        return np.arctan2(self.equatorial * np.sin(self.alpha), self.polar * np.cos(self.alpha))

    @property
    def tilt(self) -> Numeric:
        """Angle from angular momentum to rotation axis, positive away from the figure axis, rad.

        The angle is alpha - theta.

        Positive for an oblate body with alpha < pi/2. From (I.6.20), without subtracting angles:
        tan(alpha - theta) = (I3 - I1) sin cos/(I3 cos^2 + I1 sin^2) of alpha.
        """
        sine, cosine = np.sin(self.alpha), np.cos(self.alpha)
        return np.arctan2(
            self.difference * sine * cosine, self.polar * cosine**2 + self.equatorial * sine**2
        )

    @property
    def space_cone(self) -> Numeric:
        """Half-angle of the space cone, from angular momentum to rotation axis, rad (I.6.28)."""
        return np.abs(self.tilt)

    @property
    def angular_momentum(self) -> Numeric:
        """Magnitude L of the angular momentum, kg m2/s (I.6.9)."""
        return self.speed * np.hypot(
            self.equatorial * np.sin(self.alpha), self.polar * np.cos(self.alpha)
        )

    @property
    def energy(self) -> Numeric:
        """Kinetic energy T of rotation, J (I.6.11)."""
        sine, cosine = np.sin(self.alpha), np.cos(self.alpha)
        return self.speed**2 * (self.equatorial * sine**2 + self.polar * cosine**2) / 2

    @property
    def precession_rate(self) -> Numeric:
        """Precession rate of the figure axis about the angular momentum, L/I1, rad/s (I.6.24)."""
        return self.angular_momentum / self.equatorial

    @property
    def rolling(self) -> NDArray[np.str_]:
        """Side of the space cone on which the body cone rolls: ``outside``, ``inside``, ``not``.

        The body cone of a prolate body rolls on the outside of the space cone (I.6.30). That of an
        oblate body encloses the space cone and rolls on it with its inner surface (I.6.31).
        ``not``: there is no cone, so nothing rolls.
        """
        return np.select(
            [self.tilt * np.cos(self.alpha) > 0, self.space_cone > 0], ["inside", "outside"], "not"
        )

    def omega_body(self, times: Numeric) -> FloatArray:
        """Angular velocity along the body's axes, rad/s, shape (..., n, 3) (I.6.7).

        Parameters
        ----------
        times : array_like, shape (n,)
            s.
        """
        sine, cosine = np.sin(self.alpha), np.cos(self.alpha)
        return _on_cone(self.speed * sine, self.speed * cosine, self.wobble_rate, times)

    def angular_momentum_body(self, times: Numeric) -> FloatArray:
        """Angular momentum along the body's axes, kg m2/s, shape (..., n, 3) (I.6.8).

        Parameters
        ----------
        times : array_like, shape (n,)
            s.
        """
        equatorial = self.equatorial * self.speed * np.sin(self.alpha)
        axial = self.polar * self.speed * np.cos(self.alpha)
        return _on_cone(equatorial, axial, self.wobble_rate, times)

    def euler_angles(self, times: Numeric) -> FloatArray:
        """Euler angles phi, theta, psi of the body, rad, shape (..., n, 3) (I.6.25).

        Parameters
        ----------
        times : array_like, shape (n,)
            s.
        """
        phi = np.multiply.outer(self.precession_rate, times)
        psi = np.pi / 2 - np.multiply.outer(self.wobble_rate, times)
        theta = np.broadcast_to(np.asarray(self.theta)[..., np.newaxis], np.shape(phi))
        return np.stack([phi, theta, psi], axis=-1)

    def omega_inertial(self, times: Numeric) -> FloatArray:
        """Angular velocity along inertial axes, rad/s, shape (..., n, 3) (I.6.28).

        Parameters
        ----------
        times : array_like, shape (n,)
            s.
        """
        return self._in_node_plane(self.speed, -self.tilt, times)

    def figure_axis(self, times: Numeric) -> FloatArray:
        """Unit vector of the figure axis along inertial axes, shape (..., n, 3).

        Parameters
        ----------
        times : array_like, shape (n,)
            s.
        """
        return self._in_node_plane(1.0, self.theta, times)

    def inertia_tensor(self, times: Numeric) -> FloatArray:
        """Inertia tensor along inertial axes, kg m2, shape (..., n, 3, 3) (I.6, reader exercise).

        For R = Rz(phi) Rx(theta) Rz(psi), R I R^T = I1 + (I3 - I1) k k^T with the figure axis k; it
        does not depend on psi.

        Parameters
        ----------
        times : array_like, shape (n,)
            s.
        """
        k = self.figure_axis(times)
        i1, difference = (
            np.asarray(x)[..., np.newaxis, np.newaxis, np.newaxis]
            for x in (self.equatorial, self.difference)
        )
        return np.asarray(
            i1 * np.eye(3) + difference * k[..., :, np.newaxis] * k[..., np.newaxis, :]
        )

    def attitude(self, times: Numeric) -> FloatArray:
        """Attitude as unit quaternion w, x, y, z from body to inertial axes, shape (..., n, 4).

        It represents Rz(phi) Rx(theta) Rz(psi), with the angles of (I.6.25).

        Parameters
        ----------
        times : array_like, shape (n,)
            s.
        """
        phi, theta, psi = np.moveaxis(self.euler_angles(times), -1, 0)
        upright, tilted = np.cos(theta / 2), np.sin(theta / 2)
        total, difference = (phi + psi) / 2, (phi - psi) / 2
        w, z = upright * np.cos(total), upright * np.sin(total)
        x, y = tilted * np.cos(difference), tilted * np.sin(difference)
        return np.stack([w, x, y, z], axis=-1)

    def _in_node_plane(self, length: Numeric, angle: Numeric, times: Numeric) -> FloatArray:
        """Vector along inertial axes, tilted from the angular momentum towards the figure axis."""
        phi = np.multiply.outer(self.precession_rate, times)
        radial, axial = (np.asarray(length * f(angle))[..., np.newaxis] for f in (np.sin, np.cos))
        return np.stack(
            [radial * np.sin(phi), -radial * np.cos(phi), np.broadcast_to(axial, np.shape(phi))],
            axis=-1,
        )


def speed_and_cone(
    equatorial: Numeric, difference: Numeric, energy: Numeric, angular_momentum: Numeric
) -> tuple[FloatArray, FloatArray]:
    """Spin rate and half-angle alpha of the body cone, from energy and angular momentum (I.6.12).

        tan^2 alpha = (I3/I1) (2T I3 - L2)/(L2 - 2T I1),   omega^2 = [2T (I1 + I3) - L2]/(I1 I3)

    T and L determine alpha poorly near 0 and pi/2, where it is the square root of a small
    difference.

    Parameters
    ----------
    equatorial, difference : float or ndarray
        I1 and I3 - I1, kg m2.
    energy : float or ndarray
        T, J.
    angular_momentum : float or ndarray
        L, kg m2/s.

    Returns
    -------
    speed, alpha : ndarray
        rad/s, and rad from 0 to pi/2.

    Raises
    ------
    UndefinedError
        For a sphere, as its T and L do not determine alpha, or if L2/2T is not between I1 and I3.
    """
    i1, i3 = np.asarray(equatorial), np.asarray(equatorial) + difference
    if np.any(np.equal(difference, 0)):
        raise UndefinedError("T and L of a sphere (I3 - I1 = 0) do not determine alpha; give omega")
    sign, l2 = np.sign(difference), np.square(angular_momentum)
    radial, axial = sign * (2 * energy * i3 - l2), sign * (l2 - 2 * energy * i1)
    outside = (radial < -_ROUNDING * l2) | (axial < -_ROUNDING * l2)
    if np.any(outside):
        t, m, low, high = (
            float(x[outside].flat[0]) for x in np.broadcast_arrays(energy, angular_momentum, i1, i3)
        )
        raise UndefinedError(
            f"no rotation has T = {t} J with L = {m} kg m2/s: "
            f"L2/2T lies between I1 = {low} and I3 = {high} kg m2"
        )
    alpha = np.arctan2(np.sqrt(i3 * np.maximum(radial, 0)), np.sqrt(i1 * np.maximum(axial, 0)))
    return np.sqrt((2 * energy * (i1 + i3) - l2) / (i1 * i3)), alpha


def wobble_rate_of_cones(speed: Numeric, alpha: Numeric, theta: Numeric) -> Numeric:
    """Wobble rate from spin rate and angles of figure axis to spin and momentum, rad/s (I.6.27).

    It is Omega' = omega sin(alpha - theta)/sin(theta), with the spin rate omega.

    The body cone rolls on the space cone without slipping, so equal arc lengths of both rims pass
    the line of contact: Omega' sin(alpha) = phi' sin(alpha - theta).

    Parameters
    ----------
    speed : float or ndarray
        |omega|, rad/s.
    alpha, theta : float or ndarray
        Angles from the figure axis to omega and to the angular momentum, rad.

    Raises
    ------
    UndefinedError
        If the angular momentum is along the figure axis, so that there are no cones.
    """
    if np.any(np.sin(theta) == 0):
        raise UndefinedError(
            "theta = 0 rad: there is no cone, so its angles do not determine the wobble rate"
        )
    return speed * np.sin(np.subtract(alpha, theta)) / np.sin(theta)


def free_wobble_period(ellipticity: Numeric, spin_period: Numeric) -> Numeric:
    """Period of the free wobble of a body that rotates nearly about its figure axis (I.6.7), s.

    The angular velocity moves about the figure axis at Omega' = omega (I3 - I1)/I1; the denominator
    is the equatorial moment, not the polar one.

    Parameters
    ----------
    ellipticity : float
        (C - A)/A; infinity is returned for a sphere, which does not wobble.
    spin_period : float
        s; the result is in the same unit, and positive for either sense of the wobble.
    """
    with np.errstate(divide="ignore"):
        return np.abs(np.divide(spin_period, ellipticity))


def free_wobble_error(period: Numeric, h: Numeric, u_h: float) -> Numeric:
    """95 % half-width of the free wobble period due to the error of H, in the unit of `period`.

    Parameters
    ----------
    period : float
        s; the result is in the same unit.
    h : float
        Dynamical flattening; the period is (1 - H)/H turns, so dP/P = dH/H/(1 - H).
    u_h : float
        Relative standard uncertainty of the dynamical flattening.
    """
    return NORMAL_95 * period * u_h / (1 - h)


def _on_cone(radial: Numeric, axial: Numeric, rate: Numeric, times: Numeric) -> FloatArray:
    angle = np.multiply.outer(rate, times)
    radial, axial = (np.asarray(x)[..., np.newaxis] for x in (radial, axial))
    return np.stack(
        [radial * np.cos(angle), radial * np.sin(angle), np.broadcast_to(axial, angle.shape)],
        axis=-1,
    )


def _require(holds: Numeric, field: str, value: Numeric, allowed: str) -> None:
    if not np.all(holds):
        worst = np.broadcast_to(value, np.shape(holds))[~np.asarray(holds)]
        raise BodyError("rotor", field, worst.flat[0].item(), allowed)
