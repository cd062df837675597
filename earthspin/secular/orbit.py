"""An orbit that changes over millennia, as what turns an axis needs it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from earthspin.secular.strength import Strength
from earthspin.torque.quadrupole import cross, dot

FloatArray = NDArray[np.float64]

#: Of an orbit at some times: unit normal in the sense of the motion, vector to the pericentre as
#: long as the eccentricity, and rate of the normal (s-1); each of shape (3, n), along the GCRS.
Shape: TypeAlias = "tuple[FloatArray, FloatArray, FloatArray]"


class Orbit(Protocol):
    """Whatever gives an orbit at any time that it covers."""

    @property
    def coverage(self) -> tuple[float, float]:
        """First and last time, s from J2000.0 TDB."""

    @property
    def edges(self) -> FloatArray:
        """Where its pieces meet, s, ascending, J2000.0 among them: smooth in between."""

    def at(self, times: FloatArray) -> Shape:
        """The orbit at times, s from J2000.0 TDB."""


@dataclass(frozen=True)
class Changed:
    """An orbit that is another one, changed at every time.

    Attributes
    ----------
    orbit : Orbit
    change : callable
        Takes times (s) and the shape then, and gives the shape it is changed to.
    """

    orbit: Orbit
    change: Callable[[FloatArray, Shape], Shape]

    @property
    def coverage(self) -> tuple[float, float]:
        """That of the other orbit."""
        return self.orbit.coverage

    @property
    def edges(self) -> FloatArray:
        """Those of the other orbit."""
        return self.orbit.edges

    def at(self, times: FloatArray) -> Shape:
        """The orbit, changed."""
        return self.change(times, self.orbit.at(times))


def reference_axes(normal: FloatArray) -> FloatArray:
    """Right-handed unit vectors, as rows: two across a normal, and the normal."""
    third = normal[:, np.newaxis] / np.linalg.norm(normal)
    first = cross(third, np.eye(3)[:, [np.argmin(np.abs(normal))]])
    first /= np.linalg.norm(first)
    return np.concatenate([first, cross(third, first), third], axis=1).T


class Pull(NamedTuple):
    """What turns an axis s at some times: ds/dt = (g n - a (m.s) m) x s.

    Attributes
    ----------
    axis : ndarray, shape (3, n)
        m: the normal, and a little of what the Moon lags behind it.
    constant : ndarray, shape (n,)
        a, rad/s.
    geodesic : ndarray, shape (3, n)
        g n, rad/s.
    """

    axis: FloatArray
    constant: FloatArray
    geodesic: FloatArray


def pull(strength: Strength, shape: Shape, times: FloatArray) -> Pull:
    """Averaged torque of Sun and Moon on an axis.

    The node of the Moon regresses about an orbit that moves; its mean torque acts about
    n + (n x dn/dt)/|node rate|, 1.4 arcsec aside for the Earth. To first order in that, the two
    together act about one axis with the Moon's share of it.
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
    """Rate in longitude by the Moon over her constant of precession, shape (..., n).

    It is the cosine of the obliquity, but for the lag of the Moon's plane.

    Parameters
    ----------
    shape : Shape
        Of arrays that broadcast against the axis.
    axis : ndarray, shape (3, ..., n)
        Unit vector of the spin axis.
    node_rate : float
        rad/s.
    """
    normal, _, turning = shape
    moons, across = normal + cross(normal, turning) / node_rate, cross(axis, normal)
    along = dot(cross(axis, moons), across) / np.maximum(dot(across, across), 1e-300)
    return np.asarray(dot(moons, axis) * along)
