"""Spins that are locked to an orbit: there an average over orbits without resonance terms fails.

A body that turns p/2 times in each orbit (the Moon once, Mercury one and a half times) shows the
same face at the same place of each orbit. The torque on the ellipse of its equator then does not
average out, and what it adds is as large as what is left.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: Half-turns in an orbit up to which a spin may be locked, and how near it then is to the ratio.
#: Over `ORBITS` an eccentricity of 0.2 shifts the mean angle by less than half of this.
MOST_HALF_TURNS, CLOSENESS, ORBITS = 6, 0.01, 20
#: Bodies that turn faster than this are far from any lock with what takes days to go round, s.
SLOW = 5 * 86400.0


def locked_ratio(
    times: FloatArray, position: FloatArray, axis: FloatArray, spin_rate: float
) -> float | None:
    """Turns of a body in an orbit if its spin is locked, None if it is not.

    Parameters
    ----------
    times : ndarray, shape (n,)
        s, a small part of an orbit apart, over some 20 orbits.
    position : ndarray, shape (n, 3)
        From the body to what it is locked to.
    axis : ndarray, shape (3,)
        Unit vector of the spin, in the same axes.
    spin_rate : float
        rad/s, not negative: about that axis.
    """
    across = np.cross(axis, position[0])
    first, second = np.cross(across, axis), across
    angle = np.unwrap(np.arctan2(position @ second, position @ first))
    mean_motion = (angle[-1] - angle[0]) / (times[-1] - times[0])
    if mean_motion <= 0:
        return None
    return locked_turns(spin_rate, mean_motion)


def locked_turns(spin_rate: float, mean_motion: float) -> float | None:
    """Turns of a body in an orbit if its spin is locked, None if it is not.

    Parameters
    ----------
    spin_rate : float
        rad/s.
    mean_motion : float
        Of the orbit about the axis of the spin, rad/s; negative if it goes the other way.
    """
    ratio = spin_rate / mean_motion
    half_turns = round(2 * ratio)
    if not 1 <= half_turns <= MOST_HALF_TURNS:
        return None
    return half_turns / 2 if abs(2 * ratio / half_turns - 1) < CLOSENESS else None
