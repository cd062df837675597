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
    proper_motion : (float, float) or None
        mas a year, in right ascension times the cosine of the declination, and in declination; None
        where no public copy of the catalogue was seen.
    """

    name: str
    right_ascension: float
    declination: float
    magnitude: float
    proper_motion: tuple[float, float] | None = None


#: Read in the list of bright stars of PyEphem 4.2.1, which was made from hip_main.dat; stars
#: without a proper motion are rounded from the catalogue to 0.01 degrees.
STARS = (
    Star("Polaris", 37.9545, 89.2641, 1.97, (44.22, -11.74)),
    Star("Kochab", 222.6764, 74.1555, 2.07, (-32.29, 11.91)),
    Star("Pherkad", 230.18, 71.83, 3.0),
    Star("Thuban", 211.0973, 64.3759, 3.67, (-56.52, 17.19)),
    Star("Edasich", 231.23, 58.97, 3.3),
    Star("Eltanin", 269.1515, 51.4889, 2.24, (-8.52, -23.05)),
    Star("Errai", 354.84, 77.63, 3.2),
    Star("Alfirk", 322.1650, 70.5607, 3.23, (12.6, 8.73)),
    Star("Alderamin", 319.6449, 62.5856, 2.45, (149.91, 48.27)),
    Star("Deneb", 310.3580, 45.2803, 1.25, (1.56, 1.55)),
    Star("Delta Cygni", 296.24, 45.13, 2.9),
    Star("Vega", 279.2347, 38.7837, 0.03, (201.02, 287.46)),
    Star("Tau Herculis", 244.94, 46.31, 3.9),
    Star("Alkaid", 206.8852, 49.3133, 1.85, (-121.23, -15.56)),
    Star("Mizar", 200.9814, 54.9254, 2.23, (121.23, -22.01)),
    Star("Alioth", 193.5073, 55.9598, 1.76, (111.74, -8.99)),
    Star("Dubhe", 165.9320, 61.7510, 1.81, (-136.46, -35.25)),
)
#: 95 % half-width of a motion that is not known, rad/s: the largest of those above.
UNKNOWN_MOTION = float(np.hypot(201.02, 287.46)) * 1e-3 * ARCSEC / JULIAN_YEAR


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
    motions = np.array([star.proper_motion or (0.0, 0.0) for star in STARS])
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
