"""Orbits that change over millennia, and the averaged torque on a spin axis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.secular.strength import Strength
from earthspin.torque.gravity import cross, dot

#: Orbit at some times: unit normal in the sense of the motion, eccentricity vector (towards the
#: pericentre), and rate of the normal (s-1); each of shape (3, n), in the GCRS.
Shape: TypeAlias = "tuple[FloatArray, FloatArray, FloatArray]"


class Orbit(Protocol):
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
    orbit : Orbit
    change : callable
        Function of times (s) and the shape at these times that returns the changed shape.
    """

    orbit: Orbit
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


class Pull(NamedTuple):
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


def pull(strength: Strength, shape: Shape, times: FloatArray) -> Pull:
    """Compute the torque of Sun and Moon on a spin axis, averaged over their orbits.

    The node of the Moon regresses about an orbit that moves; its mean torque acts about n + (n x
    dn/dt)/|node rate|, which differs from n by 1.4 arcsec for the Earth. To first order the total
    torque of Sun and Moon acts about one axis, with this difference times the Moon's share.
    """
    normal, eccentricity, turning = shape
    e2 = dot(eccentricity, eccentricity)
    aside = cross(normal, turning) / strength.node_rate
    return Pull(
        normal + strength.moons_share * aside,
        strength.constant(times, e2),
        strength.geodesic_rate(e2) * normal,
    )


def moons_height(shape: Shape, axis: FloatArray, node_rate: float) -> FloatArray:
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
    normal, _, turning = shape
    moons, across = normal + cross(normal, turning) / node_rate, cross(axis, normal)
    along = dot(cross(axis, moons), across) / np.maximum(dot(across, across), 1e-300)
    return np.asarray(dot(moons, axis) * along)
