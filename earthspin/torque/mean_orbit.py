r"""Mean tidal tensor and torque over a Keplerian orbit, in closed form.

The mean over the mean anomaly of an ellipse with semi-major axis a, eccentricity e and normal n is

    < r r^T/r^5 > = (I - n n^T) / (2 a^3 (1 - e^2)^(3/2)),

for any pericentre. For a node that precesses uniformly about the pole p of a plane, at the
inclination i,

    < n n^T > = (sin^2(i)/2) (I - p p^T) + cos^2(i) p p^T.

The mean torque per unit of C - A on an axis k is 3 (Q k) x k, where Q is the mean of GM r r^T/r^5.
For a circle in the plane of reference it is (3/2) GM/a^3 cos(eps) sin(eps) (`rates`); for an
inclined orbit with precessing node it is 1 - (3/2) sin^2(i) times that.
"""

from __future__ import annotations

import math

import numpy as np

from earthspin.numerics.arrays import FloatArray

#: Bound on the error of a mean in units of its rounding; measured: 0.73 at most, for 2000 orbits
#: against 40-digit arithmetic.
ROUNDINGS = 2


def square_of_normal(normal: FloatArray) -> FloatArray:
    """Tensor n n^T of the unit normal n of a fixed orbit, shape (3, 3)."""
    return np.outer(normal, normal)


def mean_square_of_normal(pole: FloatArray, inclination: float) -> FloatArray:
    """Tensor n n^T of an orbit normal n, averaged over a period of the node, shape (3, 3).

    Parameters
    ----------
    pole : ndarray, shape (3,)
        Unit vector about which the normal precesses.
    inclination : float
        Angle between the two, rad.
    """
    along = np.outer(pole, pole)
    across = math.sin(inclination) ** 2 / 2
    return across * (np.eye(3) - along) + math.cos(inclination) ** 2 * along


def mean_tide(gm: float, a: float, e: float, square: FloatArray) -> FloatArray:
    """Tidal tensor GM r r^T/r^5, averaged over an orbit, s-2, shape (3, 3).

    Parameters
    ----------
    gm : float
        Gravitational parameter of the perturber, m3 s-2.
    a, e : float
        Semi-major axis, m, and eccentricity.
    square : ndarray, shape (3, 3)
        Mean of n n^T.
    """
    size = gm / (2 * a**3 * ((1 - e) * (1 + e)) ** 1.5)
    return np.asarray(size * (np.eye(3) - square))


def mean_torque(tide: FloatArray, axis: FloatArray) -> FloatArray:
    """Torque averaged over an orbit, per unit of C - A, from the mean tidal tensor, s-2.

    The shape is (3,).
    """
    return np.asarray(3 * np.cross(tide @ axis, axis))


def rounding(tide: FloatArray) -> float:
    """Bound on the rounding error of each component of a mean torque, s-2."""
    return float(3 * ROUNDINGS * np.finfo(float).eps * np.linalg.norm(tide))


def rounding_of_precessing(of_torque: FloatArray, obliquity: float) -> FloatArray:
    """Rounding error of `precessing_torque`, from that of the mean torque, s-2."""
    return np.asarray(of_torque / math.sin(obliquity))
