"""Binary PCK files of SPICE, type 2: Chebyshev series of three Euler angles of a body's axes.

The format is that of NAIF's DAF and PCK Required Reading. The angles phi, theta, psi lead from the
axes of the body to the ICRF by Rz(phi) Rx(theta) Rz(psi); in the terms of NAIF they are the right
ascension of the pole + 90 deg, 90 deg - its declination, and W. They are continuous in time.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import BinaryIO

import numpy as np

from earthspin.numerics.arrays import FloatArray

#: Degree of the series.
DEGREE = 9
#: Length of a record of a DAF, bytes and numbers.
_RECORD, _NUMBERS = 1024, 128
#: Text by which readers recognise files that a transfer has changed.
_FTP = b"FTPSTR:\r:\n:\r\n:\r\x00:\x81:\x10\xce:ENDFTP"


def euler_angles(attitude: FloatArray) -> FloatArray:
    """Angles phi, theta, psi (rad, shape (3, t)), continuous in time, of quaternions (t, 4).

    The dates must be so close that no angle changes by half a turn between them.
    """
    w, x, y, z = attitude.T
    half_sum, half_difference = np.arctan2(z, w), np.arctan2(y, x)
    theta = 2 * np.arctan2(np.hypot(x, y), np.hypot(w, z))
    phi, psi = half_sum + half_difference, half_sum - half_difference
    return np.stack([np.unwrap(phi), theta, np.unwrap(psi)])


def chebyshev_series(
    angles: Callable[[FloatArray], FloatArray], start: float, stop: float, count: int
) -> FloatArray:
    """Chebyshev series of angles in equal windows, shape (count, 3, DEGREE + 1).

    Parameters
    ----------
    angles : callable
        Function of ascending times (t,), s, that returns angles (3, t).
    start, stop : float
        First and last time, s.
    count : int
        Number of windows.
    """
    number = DEGREE + 1
    nodes = -np.cos(np.pi * (np.arange(number) + 0.5) / number)
    fit = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes, DEGREE))
    half = (stop - start) / count / 2
    middles = start + half * (2 * np.arange(count) + 1)
    values = angles((middles[:, np.newaxis] + half * nodes).ravel()).reshape(3, count, number)
    return np.asarray(np.einsum("kn,iwn->wik", fit, values))


def write(
    file: BinaryIO, series: FloatArray, start: float, stop: float, frame_id: int, name: str
) -> None:
    """Write series of angles to a file, padded to whole records, as CSPICE requires.

    Parameters
    ----------
    file : file
    series : ndarray, shape (windows, 3, n)
        From `chebyshev_series`.
    start, stop : float
        First and last time, s from J2000.0 TDB.
    frame_id : int
        Class ID of the frame.
    name : str
        Name of the segment.
    """
    count = len(series)
    length = (stop - start) / count
    middles = start + length * (np.arange(count) + 0.5)
    rows = np.column_stack([middles, np.full(count, length / 2), series.reshape(count, -1)])
    numbers = np.concatenate([rows.ravel(), [start, length, rows.shape[1], count]])
    first = 3 * _NUMBERS + 1
    last = first + numbers.size - 1
    # two doubles and five integers in a summary: times; frame, ICRF (1), type (2), addresses
    origin = b"earthspin".ljust(60)
    head = struct.pack("<8sii60siii8s", b"DAF/PCK ", 2, 5, origin, 2, 2, last + 1, b"LTL-IEEE")
    summary = struct.pack("<3d2d5i4x", 0, 0, 1, start, stop, frame_id, 1, 2, first, last)
    file.write((head + bytes(603) + _FTP).ljust(_RECORD, b"\0"))
    file.write(summary.ljust(_RECORD, b"\0"))
    file.write(name.encode("ascii", "replace")[:40].ljust(_RECORD))
    file.write(numbers.astype("<f8").tobytes())
    file.write(bytes(-numbers.size % _NUMBERS * 8))
