"""Detect spin-orbit resonances, in which torques averaged over the orbit would be wrong.

A body that rotates p/2 times per orbit (the Moon once, Mercury one and a half times) has the same
orientation at the same position of each orbit. The torque on its equatorial ellipticity then does
not average to zero, and is as large as the mean torque on the bulge.
"""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import FloatArray

#: Largest number of half turns per orbit of a resonance, tolerance of the ratio, and number of
#: orbits. Over `ORBITS` an eccentricity of 0.2 changes the mean ratio by less than half of the
#: tolerance.
MOST_HALF_TURNS, CLOSENESS, ORBITS = 6, 0.01, 20
#: Rotation period, s, below which a body is far from resonance with orbits of days or longer.
SLOW = 5 * 86400.0


def locked_ratio(
    times: FloatArray, position: FloatArray, axis: FloatArray, spin_rate: float
) -> float | None:
    """Rotations per orbit of a body in spin-orbit resonance, from positions; otherwise None.

    Return None if there is no resonance.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Times, s, with a spacing much shorter than the orbit, over about 20 orbits.
    position : ndarray, shape (n, 3)
        From the body to the other body.
    axis : ndarray, shape (3,)
        Unit vector of the spin, in the same frame.
    spin_rate : float
        rad/s, not negative, about that axis.
    """
    across = np.cross(axis, position[0])
    first, second = np.cross(across, axis), across
    angle = np.unwrap(np.arctan2(position @ second, position @ first))
    mean_motion = (angle[-1] - angle[0]) / (times[-1] - times[0])
    if mean_motion <= 0:
        return None
    return locked_turns(spin_rate, mean_motion)


def locked_turns(spin_rate: float, mean_motion: float) -> float | None:
    """Rotations per orbit of a body in spin-orbit resonance, from rates; otherwise None.

    Parameters
    ----------
    spin_rate : float
        rad/s.
    mean_motion : float
        Mean motion of the orbit about the spin axis, rad/s; negative if retrograde.
    """
    ratio = spin_rate / mean_motion
    half_turns = round(2 * ratio)
    if not 1 <= half_turns <= MOST_HALF_TURNS:
        return None
    return half_turns / 2 if abs(2 * ratio / half_turns - 1) < CLOSENESS else None
