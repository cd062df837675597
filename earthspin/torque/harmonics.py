"""Torques on zonal harmonics of a body beyond J2: J3 (pear shape) and J4.

A mass m at r has the energy + (G M m / r) J_n (a/r)^n P_n(u) in the field of J_n, where u is the
cosine of its angle from the figure axis F. A rotation of the body by dtheta changes F by dtheta x
F, so the torque on the body is

    N_n = (G M m / r) J_n (a/r)^n P_n'(u) (r/r) x F

which for n = 2 is (I.9.34). Per unit of C it is proportional to M a2/C = H/J2.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.polynomial import legendre

from earthspin.numerics.arrays import FloatArray
from earthspin.torque.quadrupole import cross, dot


def zonal_torque(
    degree: int,
    coefficient: float,
    radius: float,
    gm: float,
    position: FloatArray,
    axis: FloatArray,
) -> FloatArray:
    """Torque of a mass on one zonal harmonic J_n of a body, divided by M a2, s-2.

    Parameters
    ----------
    degree : int
        n of J_n, 2 or more.
    coefficient : float
        J_n in the convention of geodesy (unnormalised, J2 of an oblate body positive).
    radius : float
        Equatorial reference radius a, m.
    gm : float
        Gravitational parameter of the mass, m3 s-2.
    position : ndarray, shape (3, ...)
        From the body to the mass, m.
    axis : ndarray, shape (3, ...)
        Unit vectors of the figure axis.
    """
    return zonal_law({degree: coefficient}, radius, gm, position)(axis)


def zonal_law(
    coefficients: Mapping[int, float], radius: float, gm: float, position: FloatArray
) -> Callable[[FloatArray], FloatArray]:
    """Make a function of the figure axis that returns the torque on several harmonics J_n.

    Parameters
    ----------
    coefficients : mapping of int to float
        J_n by degree.
    radius, gm, position
        As for `zonal_torque`.

    Returns
    -------
    callable
        Function of unit vectors of the figure axis, shape (3, ...), that returns the torque per
        unit of M a2, s-2.
    """
    distance = np.sqrt(dot(position, position))
    direction = position / distance
    series = np.zeros((max(coefficients, default=1), *distance.shape))
    for degree, coefficient in coefficients.items():
        pull = gm / distance**3 * coefficient * (radius / distance) ** (degree - 2)
        slope = legendre.legder(np.eye(degree + 1)[degree])
        series[:degree] += np.multiply.outer(slope, pull)

    def torque(axis: FloatArray) -> FloatArray:
        size = legendre.legval(dot(direction, axis), series, tensor=False)
        return np.asarray(size * cross(direction, axis))

    return torque
