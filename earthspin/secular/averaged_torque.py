"""Orbits that change over millennia, the constant of precession, and the averaged torque."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from earthspin.constants import JULIAN_YEAR, SPEED_OF_LIGHT, Constant
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray, Numeric
from earthspin.torque.gravity import cross, dot

# --- constant of precession -----------------------------------------------------------------------
# Averaged over orbits, a torque turns the spin axis s about the normal n of an orbit,
#
#     ds/dt = a (n.s) (s x n),
#
# with the constant of precession a (the rate divided by the cosine of the obliquity). For the
# Earth, the Sun's share is proportional to (1 - e^2)^(-3/2), the Moon's to the square of its mean
# motion, and both to the dynamical ellipticity H divided by the spin; as H is proportional to the
# square of the spin and a factor H/H0,
#
#     a(t) = a0 (omega/omega0) (H/H0)
#            [share_sun (1 - e^2)^(-3/2)/f0 + share_moon (n_moon/n_moon0)^2]
#
# (after Quinn, Tremaine & Duncan 1991, AJ 101, 2287).


QTD91 = "Quinn, Tremaine & Duncan 1991, AJ 101, 2287"
_QTD91_READ = "constants of snvecR (japhir/snvecR), which cites eq. 3 and 11 of the paper"
#: Relative rate of the Moon's mean motion due to tides (lunar laser ranging: -4.7e-18).
MOON_SLOWS = Constant(-4.6e-18, "s-1", None, QTD91, _QTD91_READ)
#: Ratio of spin deceleration to lunar deceleration: (omega'/omega)/(n'/n) is this times n/omega.
SPIN_OVER_MOON = Constant(51.0, "", None, QTD91, _QTD91_READ)

#: Times from J2000.0, s, up to which the present rate of J2 applies, and beyond which its effect is
#: zero, with a cosine taper between: postglacial rebound decays within some thousand years.
FADES_FROM, FADES_TO = 2000 * JULIAN_YEAR, 10_000 * JULIAN_YEAR

#: Relative half-width of the present rate of J2, 95 %: an assumption, from the scatter of satellite
#: solutions.
J2_SHARE = 0.2


@dataclass(frozen=True)
class Tides:
    """Relative rates of change of the Moon's mean motion and the Earth's spin, due to tides.

    Attributes
    ----------
    moon : float
        Relative rate of the Moon's mean motion, s-1.
    spin : float
        Relative rate of the spin, s-1.
    """

    moon: Numeric = 0.0
    spin: Numeric = 0.0

    @classmethod
    def of_the_earth(cls, factor: Numeric, spin_rate: float, moon_motion: float) -> Tides:
        """Make `Tides` with the Earth's present tidal rates, multiplied by a factor.

        Parameters
        ----------
        factor : float
            1 for the present rates, 0 for none.
        spin_rate, moon_motion : float
            rad/s.
        """
        moon = MOON_SLOWS.value * np.asarray(factor)
        return cls(moon, SPIN_OVER_MOON.value * moon * moon_motion / spin_rate)


@dataclass(frozen=True)
class PrecessionConstant:
    """Constant of precession at J2000.0, with parameters of its change in time.

    Attributes
    ----------
    sun, moon : float
        Contributions of Sun and Moon at J2000.0, rad/s; `moon` is 0 without a moon.
    eccentricity : float
        Eccentricity of the orbit at J2000.0, to which `sun` refers.
    geodesic : float
        Rate of geodesic precession about the normal at that eccentricity, rad/s.
    ellipticity : float
        Factor on the dynamical ellipticity.
    ellipticity_drift : float
        Relative rate of change of the ellipticity, s-1.
    tides : Tides
    j2_rate : float
        Relative rate of J2 at J2000.0, s-1; for its decay see `rebound`.
    j2_band : float
        Multiple of the half-width of J2 to add, 1 for a 95 % half-width; see `rebound_error`.
    node_rate : float
        Rate of regression of the Moon's node, rad/s; infinite without a moon.
    """

    sun: Numeric
    moon: Numeric = 0.0
    eccentricity: Numeric = 0.0
    geodesic: Numeric = 0.0
    ellipticity: Numeric = 1.0
    ellipticity_drift: float = 0.0
    tides: Tides = Tides()
    j2_rate: Numeric = 0.0
    j2_band: float = 0.0
    node_rate: Numeric = math.inf

    def constant(self, times: FloatArray, e2: FloatArray) -> FloatArray:
        """Precession constant of the body at given times, rad/s.

        Parameters
        ----------
        times : ndarray
            s from J2000.0.
        e2 : ndarray
            Squared eccentricity at these times.

        Raises
        ------
        UndefinedError
            If linear tides would have changed the spin or the Moon's motion too much.
        """
        spin, moon = 1 + self.tides.spin * times, 1 + self.tides.moon * times
        if np.any(spin <= 0.5) or np.any(moon <= 0.5):
            raise UndefinedError(
                "tides at the present rate would have changed the spin or the Moon's motion by "
                "half; give a smaller factor or a shorter span"
            )
        sun = self.sun * ((1 - self.eccentricity**2) / (1 - e2)) ** 1.5
        change = rebound(times) + (self.j2_band * rebound_error(times) if self.j2_band else 0.0)
        figure = self.ellipticity * (1 + self.j2_rate * change + self.ellipticity_drift * times)
        return np.asarray(spin * figure * (sun + self.moon * moon**2))

    def geodesic_rate(self, e2: FloatArray) -> FloatArray:
        """Rate of geodesic precession about the orbit normal for a squared eccentricity, rad/s."""
        return np.asarray(self.geodesic * (1 - self.eccentricity**2) / (1 - e2))

    @property
    def moon_share(self) -> Numeric:
        """Fraction of the precession constant at J2000.0 that is due to the Moon."""
        return self.moon / (self.sun + self.moon)


def geodesic_precession(gm: float, motion: float, eccentricity: float) -> float:
    """Rate of geodesic precession of a body on an orbit about a central mass, rad/s.

    It is 3/2 G M n/(c^2 a (1 - e^2)).

    It rotates an axis about the normal in the sense of the motion (de Sitter 1916, MNRAS 77, 155).
    The contribution of a moon is neglected (2.6e-4 of the rate for the Earth).

    Parameters
    ----------
    gm : float
        G M of the central body, m3/s2.
    motion : float
        Mean motion, rad/s.
    eccentricity : float
    """
    a = (gm / motion**2) ** (1 / 3)
    return float(1.5 * gm * motion / (SPEED_OF_LIGHT.value**2 * a * (1 - eccentricity**2)))


def rebound(times: FloatArray) -> FloatArray:
    """Change of J2 since J2000.0, divided by the present rate of J2, s.

    It is t up to `FADES_FROM` and 0 beyond `FADES_TO`.

    The *change* itself returns to zero in between: over ice ages J2 oscillates about a mean, which
    does not depend on its present rate.
    """
    return np.asarray(times * _cosine_taper(times, FADES_FROM, FADES_TO))


def rebound_error(times: FloatArray) -> FloatArray:
    """95 % half-width of `rebound`, the change of J2 divided by its present rate, s.

    It is the fraction `J2_SHARE` of the time up to `FADES_FROM`, the whole time at `FADES_TO`, and
    zero beyond twice `FADES_TO`.

    Beyond twice `FADES_TO`, J2 has its present value apart from a drift of the mean (see `budget`).
    """
    nominal = rebound(times)
    uncertain_fading = (times - nominal) * _cosine_taper(times, FADES_TO, 2 * FADES_TO)
    return np.asarray(J2_SHARE * nominal + uncertain_fading)


def _cosine_taper(times: FloatArray, start: float, end: float) -> FloatArray:
    """Weight that falls from 1 at |t| = `start` to 0 at |t| = `end`, as a cosine taper."""
    phase = np.clip((np.abs(times) - start) / (end - start), 0.0, 1.0)
    return np.asarray(0.5 * (1 + np.cos(np.pi * phase)))


# --- orbits and averaged torque -------------------------------------------------------------------

#: Orbit at some times: unit normal in the sense of the motion, eccentricity vector (towards the
#: pericentre), and rate of the normal (s-1); each of shape (3, n), in the GCRS.
Shape: TypeAlias = "tuple[FloatArray, FloatArray, FloatArray]"


class ChangingOrbit(Protocol):
    """Interface of an orbit that changes in time: normal and eccentricity at any covered time."""

    @property
    def coverage(self) -> tuple[float, float]:
        """First and last time that the orbit covers, s from J2000.0 TDB."""

    @property
    def edges(self) -> FloatArray:
        """Ascending times, s, at which polynomial pieces of the orbit join, and J2000.0."""

    def at(self, times: FloatArray) -> Shape:
        """Orbit normal, eccentricity vector and rate of the normal at times, s from J2000.0."""


@dataclass(frozen=True)
class ModifiedOrbit:
    """Orbit that follows from another orbit by a change of its normal and eccentricity.

    Attributes
    ----------
    orbit : ChangingOrbit
    change : callable
        Function of times (s) and the shape at these times that returns the changed shape.
    """

    orbit: ChangingOrbit
    change: Callable[[FloatArray, Shape], Shape]

    @property
    def coverage(self) -> tuple[float, float]:
        """First and last time that the original orbit covers, s from J2000.0 TDB."""
        return self.orbit.coverage

    @property
    def edges(self) -> FloatArray:
        """Times, s, at which polynomial pieces of the original orbit join."""
        return self.orbit.edges

    def at(self, times: FloatArray) -> Shape:
        """Changed orbit normal, eccentricity vector and rate of the normal at given times (s)."""
        return self.change(times, self.orbit.at(times))


def reference_axes(normal: FloatArray) -> FloatArray:
    """Three orthogonal unit vectors, as rows; the third is the given orbit normal."""
    third = normal[:, np.newaxis] / np.linalg.norm(normal)
    first = cross(third, np.eye(3)[:, [np.argmin(np.abs(normal))]])
    first /= np.linalg.norm(first)
    return np.concatenate([first, cross(third, first), third], axis=1).T


class AveragedTorque(NamedTuple):
    """Averaged torque on a spin axis: torque axis, constant of precession, geodesic rotation.

    The spin axis moves by ds/dt = (g n - a (m.s) m) x s.

    Attributes
    ----------
    axis : ndarray, shape (3, n)
        m: the normal, with a small correction for the lag of the Moon's plane.
    constant : ndarray, shape (n,)
        a, rad/s.
    geodesic : ndarray, shape (3, n)
        g n, rad/s.
    """

    axis: FloatArray
    constant: FloatArray
    geodesic: FloatArray


def mean_torque(precession: PrecessionConstant, shape: Shape, times: FloatArray) -> AveragedTorque:
    """Compute the torque of Sun and Moon on a spin axis, averaged over their orbits.

    The node of the Moon regresses about an orbit that moves; its mean torque acts about n + (n x
    dn/dt)/|node rate|, which differs from n by 1.4 arcsec for the Earth. To first order the total
    torque of Sun and Moon acts about one axis, with this difference times the Moon's share.
    """
    normal, eccentricity, normal_rate = shape
    e2 = dot(eccentricity, eccentricity)
    moon_tilt = cross(normal, normal_rate) / precession.node_rate
    return AveragedTorque(
        normal + precession.moon_share * moon_tilt,
        precession.constant(times, e2),
        precession.geodesic_rate(e2) * normal,
    )


def moon_rate_factor(shape: Shape, axis: FloatArray, node_rate: float) -> FloatArray:
    """Precession rate due to the Moon, divided by the Moon's constant of precession.

    The shape is (..., n).

    The result is the cosine of the obliquity, apart from the lag of the Moon's plane.

    Parameters
    ----------
    shape : Shape
        Orbit, with arrays that broadcast against the axis.
    axis : ndarray, shape (3, ..., n)
        Unit vector of the spin axis.
    node_rate : float
        rad/s.
    """
    normal, _, normal_rate = shape
    moon_normal, equinox = normal + cross(normal, normal_rate) / node_rate, cross(axis, normal)
    projection = dot(cross(axis, moon_normal), equinox) / np.maximum(dot(equinox, equinox), 1e-300)
    return np.asarray(dot(moon_normal, axis) * projection)


def broadcast_over_members(axis: FloatArray, vector: FloatArray) -> FloatArray:
    """Reshape a vector of the orbit from (3, n) to broadcast with many spin axes, (3, ..., n)."""
    return vector.reshape(3, *(1,) * (axis.ndim - 2), -1)
