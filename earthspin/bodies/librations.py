"""Attitude and spin of the Moon at some dates, from which its rotation is integrated.

`librations.txt` is made by `python -m data_tools librations` from the ephemeris DE421 (Folkner,
Williams & Boggs 2009, IPN Progress Report 42-178).
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from earthspin.constants import ARCSEC, DAY, J2000_JD, Tabulated
from earthspin.numerics.arrays import FloatArray

TABLE = Path(__file__).with_suffix(".txt")
SOURCE = Tabulated(
    "librations of the Moon and spin of its core",
    "DE421: Folkner, Williams & Boggs 2009, IPN Progress Report 42-178",
    "package de421 2008.1 on PyPI",
)
#: 95 % half-width of the attitude: DE418 and DE421 differ by up to 0.093 arcsec from 2000 to 2020
#: (NAIF, comments of moon_080317.tf); half as much again is for what both have in common.
HALF_WIDTH = 0.14 * ARCSEC

#: Angles of the rotations about z, y and x that lead from principal to mean-Earth axes, rad
#: (Williams, Boggs & Folkner 2008, JPL IOM 335-JW,DB,WF-20080314-001; moon_080317.tf of NAIF).
MEAN_EARTH_ANGLES = (-67.92 * ARCSEC, -78.56 * ARCSEC, -0.30 * ARCSEC)


def mean_earth_matrix() -> FloatArray:
    """Matrix that turns vectors from the principal axes of the Moon to its mean-Earth axes."""
    from scipy.spatial.transform import Rotation

    # extrinsic rotations of vectors turn them opposite to the axes
    return np.asarray(Rotation.from_euler("zyx", np.negative(MEAN_EARTH_ANGLES)).as_matrix())


class Libration(NamedTuple):
    """State of rotation of the Moon at a date.

    Attributes
    ----------
    day : float
        Days from J2000.0 TDB.
    attitude : ndarray, shape (4,)
        Quaternion from the principal axes to the ICRF.
    omega : ndarray, shape (3,)
        Angular velocity of the mantle along its principal axes, rad/s.
    core : ndarray, shape (3,)
        Angular velocity of the core along the ICRF, rad/s.
    """

    day: float
    attitude: FloatArray
    omega: FloatArray
    core: FloatArray


@lru_cache(maxsize=1)
def _table() -> FloatArray:
    """Rows of Julian date, three angles (rad) and two angular velocities (rad/d), shape (n, 10)."""
    return np.loadtxt(TABLE)


def last_before(day: float) -> Libration | None:
    """Last tabulated state at or before a date, days from J2000.0 TDB; None if there is none."""
    from scipy.spatial.transform import Rotation

    days = _table()[:, 0] - J2000_JD
    row = int(np.searchsorted(days, day, side="right")) - 1
    if row < 0:
        return None
    angles, omega, core = _table()[row, 1:].reshape(3, 3)
    attitude = Rotation.from_euler("ZXZ", angles).as_quat(scalar_first=True)
    return Libration(float(days[row]), attitude, omega / DAY, core / DAY)
