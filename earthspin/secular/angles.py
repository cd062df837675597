r"""Obliquity and precession angles from a spin axis and an orbit.

The spin axis is s; the orbit has the normal n and the eccentricity vector e.

The equinox of date lies along s x n, where the Sun crosses the equator northward. The obliquity is
the angle from n to s; the longitude of perihelion is measured along the orbit from the equinox of
date. Climatic precession and coprecession,

    e sin(longitude) = (e.s)/sin(obliquity),     e cos(longitude) = e.(s x n)/sin(obliquity),

thus need no trigonometric function. Perihelion is where the *body* is closest to the Sun; seen from
the body, the Sun is then in the opposite direction.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.secular.orbit import reference_axes

Numeric = float | FloatArray


class Seasons(NamedTuple):
    """Obliquity, eccentricity e, climatic precession e sin(w), and coprecession e cos(w).

    The angle w is the longitude of perihelion. Each array has the shape (n,).

    Attributes
    ----------
    obliquity : ndarray
        rad.
    eccentricity : ndarray
    climatic_precession, coprecession : ndarray
        Eccentricity times sine and cosine of the longitude of perihelion.
    """

    obliquity: FloatArray
    eccentricity: FloatArray
    climatic_precession: FloatArray
    coprecession: FloatArray


def seasons(axis: FloatArray, normal: FloatArray, eccentricity: FloatArray) -> Seasons:
    """Compute obliquity, eccentricity, climatic precession and coprecession from vectors.

    Parameters
    ----------
    axis, normal, eccentricity : ndarray, shape (3, n)
        Spin axis, orbit normal, eccentricity vector.
    """
    equinox = np.cross(axis, normal, axis=0)
    sine = np.sqrt(np.sum(equinox**2, axis=0))
    upright = np.where(sine > 0, sine, np.nan)
    return Seasons(
        np.arctan2(sine, np.sum(axis * normal, axis=0)),
        np.sqrt(np.sum(eccentricity**2, axis=0)),
        np.sum(eccentricity * axis, axis=0) / upright,
        np.sum(eccentricity * equinox, axis=0) / upright,
    )


def equator_and_equinox(axis: FloatArray, normal: FloatArray) -> FloatArray:
    """Rotation matrices from GCRS to mean equator and equinox of date, shape (..., n, 3, 3).

    Parameters
    ----------
    axis : ndarray, shape (3, ..., n)
    normal : ndarray, shape (3, n)
    """
    equinox = np.cross(axis, broadcast_over_members(axis, normal), axis=0)
    equinox = equinox / np.sqrt(np.sum(equinox**2, axis=0))
    rows = np.stack([equinox, np.cross(axis, equinox, axis=0), axis])
    return np.moveaxis(rows, (0, 1), (-2, -1))


def equinox_error(pole: FloatArray, normal: Numeric, sine: FloatArray) -> FloatArray:
    """95 % half-width of the directions of equinox and pole together, rad.

    A displacement d of the pole can turn the equinox by d/tan(obliquity) along the equator; a
    displacement d of the orbit's normal can turn it by d/sin(obliquity).

    Parameters
    ----------
    pole, normal : ndarray
        95 % half-widths of the directions of the pole and of the orbit's normal, rad.
    sine : ndarray
        Sine of the obliquity.
    """
    return np.asarray(np.hypot(pole, normal) / sine)


def inclined_axis(
    axis: FloatArray, normal: FloatArray, more: Numeric, turned: Numeric
) -> FloatArray:
    """Return a spin axis with its obliquity and longitude increased by given angles.

    Parameters
    ----------
    axis, normal : ndarray, shape (3,)
        Unit vectors.
    more : float or ndarray, shape (...)
        Increment of the obliquity, rad; if the obliquity becomes negative, the axis is on the other
        side of the normal.
    turned : float or ndarray, shape (...)
        Increment of the longitude, in the sense of the orbital motion, rad.

    Returns
    -------
    ndarray, shape (3, ...)
    """
    more, turned = np.broadcast_arrays(more, turned)
    first, _, n = reference_axes(normal)
    equinox = np.cross(n, axis)
    sine = float(np.linalg.norm(equinox))
    towards = np.cross(equinox, n) / sine if sine > 0 else first
    obliquity = np.arctan2(sine, axis @ n) + more
    across = np.sin(obliquity)
    outer = np.multiply.outer
    return np.asarray(
        outer(n, np.cos(obliquity))
        + outer(towards, across * np.cos(turned))
        + outer(np.cross(n, towards), across * np.sin(turned))
    )


def broadcast_over_members(axis: FloatArray, vector: FloatArray) -> FloatArray:
    """Reshape a vector of the orbit from (3, n) to broadcast with the axes of many members."""
    return vector.reshape(3, *(1,) * (axis.ndim - 2), -1)
