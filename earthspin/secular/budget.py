"""How wrong the axis may be far from the present, cause by cause.

Each cause is a change of what the solution stands on, by its 95 % half-width; the solution is made
again with it, and how far it then lies away is the share of that cause. Up to a few thousand years
the constant of precession and the rate of J2 count; beyond ten thousand years what counts is the
Earth itself: how its tides and its figure were in the past.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import ARCSEC, JULIAN_YEAR, NORMAL_95
from earthspin.secular.orbit import Orbit, Shape
from earthspin.secular.strength import Strength, Tides

FloatArray = NDArray[np.float64]

#: Half-width of the start: the mean obliquity at J2000.0 (Capitaine et al. 2003, 0.001 arcsec).
START = NORMAL_95 * 0.001 * ARCSEC
#: Share of today's tides by which their mean over the past may differ: an assumption. People sweep
#: factors of 0 to 1.2; 0.2 is the distance of today's from that end.
TIDES_SHARE = 0.2
#: Drift of the mean dynamical ellipticity by mantle convection, relative, s-1: an assumption.
#: People sweep factors of 0.998 to 1.012; half of that width is reached in ten million years.
ELLIPTICITY_DRIFT = 0.007 / (10e6 * JULIAN_YEAR)


@dataclass(frozen=True)
class Setting:
    """All that a solution stands on.

    Attributes
    ----------
    strength : Strength
    orbit : Orbit
    start : ndarray, shape (3,)
        Unit vector of the axis at J2000.0.
    """

    strength: Strength
    orbit: Orbit
    start: FloatArray


@dataclass(frozen=True)
class Moved:
    """An orbit moved by how far it may be wrong.

    Attributes
    ----------
    orbit : Orbit
    error : callable
        Half-widths of normal (rad) and eccentricity vector at times, s, shape (2, n).
    """

    orbit: Orbit
    error: Callable[[FloatArray], FloatArray]

    @property
    def coverage(self) -> tuple[float, float]:
        """That of the orbit."""
        return self.orbit.coverage

    @property
    def edges(self) -> FloatArray:
        """Those of the orbit."""
        return self.orbit.edges

    def at(self, times: FloatArray) -> Shape:
        """The orbit with normal and perihelion turned, and the eccentricity longer."""
        normal, eccentricity, turning = self.orbit.at(times)
        by_normal, by_shape = self.error(times)
        along = eccentricity / np.maximum(np.sqrt(np.sum(eccentricity**2, axis=0)), 1e-300)
        beside = np.cross(normal, along, axis=0)
        tilted = normal + by_normal * beside
        tilted = tilted / np.sqrt(np.sum(tilted**2, axis=0))
        return tilted, eccentricity + by_shape * (along + beside), turning


def _later(strength: Strength, rate: float) -> Strength:
    """An ellipticity that drifts: taken into the spin, which enters in the same way."""
    tides = strength.tides
    return replace(strength, tides=Tides(tides.moon, tides.spin + rate))


def changes(
    setting: Setting,
    *,
    constant: float,
    earth: bool,
    error: Callable[[FloatArray], FloatArray],
) -> dict[str, Setting]:
    """What each cause makes of a setting.

    Parameters
    ----------
    setting : Setting
    constant : float
        Relative half-width of the constant of precession.
    earth : bool
        Whether tides and ellipticity are those of the Earth, and uncertain as hers are.
    error : callable
        Half-widths of the orbit's normal (rad) and eccentricity at times, s.
    """
    strength, normal = setting.strength, setting.orbit.at(np.zeros(1))[0][:, 0]
    across = np.cross(np.cross(normal, setting.start), setting.start)
    tilted = setting.start + START * across / max(float(np.linalg.norm(across)), 1e-300)
    found = {
        "constant": replace(
            setting,
            strength=replace(
                strength, sun=strength.sun * (1 + constant), moon=strength.moon * (1 + constant)
            ),
        ),
        "start": replace(setting, start=tilted / np.linalg.norm(tilted)),
        "orbit": replace(setting, orbit=Moved(setting.orbit, error)),
    }
    if earth:
        tides = strength.tides
        slower = Tides(tides.moon * (1 + TIDES_SHARE), tides.spin * (1 + TIDES_SHARE))
        found |= {
            "J2 rate": replace(setting, strength=replace(strength, j2_band=1.0)),
            "tides": replace(setting, strength=replace(strength, tides=slower)),
            "ellipticity": replace(setting, strength=_later(strength, ELLIPTICITY_DRIFT)),
        }
    return found
