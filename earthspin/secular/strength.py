r"""How strongly Sun and Moon turn an axis, as orbit, Moon, day and figure change.

Averaged over orbits, a torque turns the spin axis s about the normal n of an orbit,

    ds/dt = a (n.s) (s x n),

with the constant of precession a (the rate over the cosine of the obliquity). Of the Earth's, the
Sun's share goes with (1 - e^2)^(-3/2), the Moon's with the square of its mean motion, and both with
the dynamical ellipticity H and the spin, because H itself grows with the square of the spin:

    a(t) = a0 (omega/omega0) (H/H0) [share_sun (1 - e^2)^(-3/2)/f0 + share_moon (n_moon/n_moon0)^2]

(after Quinn, Tremaine & Duncan 1991, AJ 101, 2287).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import JULIAN_YEAR, SPEED_OF_LIGHT, Constant
from earthspin.errors import UndefinedError

FloatArray = NDArray[np.float64]
#: A float, or one value for each member.
Numeric = Any

QTD91 = "Quinn, Tremaine & Duncan 1991, AJ 101, 2287"
_QTD91_READ = "constants of snvecR (japhir/snvecR), which cites eq. 3 and 11 of the paper"
#: Relative rate of the Moon's mean motion by tides (lunar laser ranging gives -4.7e-18).
MOON_SLOWS = Constant(-4.6e-18, "s-1", None, QTD91, _QTD91_READ)
#: What that takes of the spin: omega'/omega over n'/n is this times n/omega.
SPIN_OVER_MOON = Constant(51.0, "", None, QTD91, _QTD91_READ)

#: How far the present rate of J2 is taken at its word, and where nothing of it is left, s.
#: In between it fades as a cosine: the rebound of the mantle decays within some thousand years.
FADES_FROM, FADES_TO = 2000 * JULIAN_YEAR, 10_000 * JULIAN_YEAR

#: Share of today's rate of J2 that is uncertain, 95 %: an assumption, of the size by which
#: solutions from satellites differ.
J2_SHARE = 0.2


@dataclass(frozen=True)
class Tides:
    """What tides do to Moon and spin, linear in time.

    Attributes
    ----------
    moon : float
        Relative rate of the Moon's mean motion, s-1.
    spin : float
        Relative rate of the spin, s-1.
    """

    moon: Numeric = 0.0
    spin: Numeric = 0.0

    @classmethod
    def of_the_earth(cls, factor: Numeric, spin_rate: float, moon_motion: float) -> Tides:
        """Those of today times a factor.

        Parameters
        ----------
        factor : float
            1 for today's, 0 for none.
        spin_rate, moon_motion : float
            rad/s.
        """
        moon = MOON_SLOWS.value * np.asarray(factor)
        return cls(moon, SPIN_OVER_MOON.value * moon * moon_motion / spin_rate)


@dataclass(frozen=True)
class Strength:
    """The constant of precession in time.

    Attributes
    ----------
    sun, moon : float
        Its shares at J2000.0, rad/s; `moon` is 0 without one.
    eccentricity : float
        Of the orbit at J2000.0, to which `sun` refers.
    geodesic : float
        Rate of geodesic precession about the normal at that eccentricity, rad/s.
    ellipticity : float
        Factor on the dynamical ellipticity.
    ellipticity_drift : float
        Relative rate at which the ellipticity drifts from there, s-1.
    tides : Tides
    j2_rate : float
        Relative rate of J2 at J2000.0, s-1; it fades, see `faded`.
    j2_band : float
        How much of what is unknown of J2 is added, 1 for a 95 % half-width; see `band`.
    node_rate : float
        How fast the node of the Moon regresses, rad/s; infinite without one.
    """

    sun: Numeric
    moon: Numeric = 0.0
    eccentricity: Numeric = 0.0
    geodesic: Numeric = 0.0
    ellipticity: Numeric = 1.0
    ellipticity_drift: float = 0.0
    tides: Tides = Tides()
    j2_rate: Numeric = 0.0
    j2_band: float = 0.0
    node_rate: Numeric = math.inf

    def constant(self, times: FloatArray, e2: FloatArray) -> FloatArray:
        """The constant of precession, rad/s.

        Parameters
        ----------
        times : ndarray
            s from J2000.0.
        e2 : ndarray
            Squared eccentricity then.

        Raises
        ------
        UndefinedError
            If tides, taken as linear, would have stopped the spin or the Moon by then.
        """
        spin, moon = 1 + self.tides.spin * times, 1 + self.tides.moon * times
        if np.any(spin <= 0.5) or np.any(moon <= 0.5):
            raise UndefinedError(
                "tides that go on as today would have changed the spin or the Moon's motion by "
                "half; give a smaller factor or a shorter span"
            )
        of_sun = self.sun * ((1 - self.eccentricity**2) / (1 - e2)) ** 1.5
        acted = faded(times) + (self.j2_band * band(times) if self.j2_band else 0.0)
        figure = self.ellipticity * (1 + self.j2_rate * acted + self.ellipticity_drift * times)
        return np.asarray(spin * figure * (of_sun + self.moon * moon**2))

    def geodesic_rate(self, e2: FloatArray) -> FloatArray:
        """Geodesic precession about the normal, rad/s: as 1/(1 - e^2)."""
        return np.asarray(self.geodesic * (1 - self.eccentricity**2) / (1 - e2))

    @property
    def moons_share(self) -> Numeric:
        """Share of the Moon at J2000.0."""
        return self.moon / (self.sun + self.moon)


def geodesic_precession(gm: float, motion: float, eccentricity: float) -> float:
    """Rate of geodesic precession on an orbit, 3/2 G M n/(c^2 a (1 - e^2)), rad/s.

    It turns an axis about the normal in the sense of the motion (de Sitter 1916, MNRAS 77, 155).
    What a moon adds (2.6e-4 of it by the Earth's) is left out.

    Parameters
    ----------
    gm : float
        G M of what the orbit goes about, m3/s2.
    motion : float
        Mean motion, rad/s.
    eccentricity : float
    """
    a = (gm / motion**2) ** (1 / 3)
    return float(1.5 * gm * motion / (SPEED_OF_LIGHT.value**2 * a * (1 - eccentricity**2)))


def faded(times: FloatArray) -> FloatArray:
    """Time by which a rate that fades has acted, s: t within `FADES_FROM`, 0 beyond `FADES_TO`.

    The *change* is taken back between the two: over ice ages J2 swings about a mean, and its
    present rate says nothing of that.
    """
    return np.asarray(times * _falling(times, FADES_FROM, FADES_TO))


def band(times: FloatArray) -> FloatArray:
    """By how much that time may be off, s: a share today, later all that has faded.

    Beyond twice `FADES_TO`, J2 is taken to be what it is today but for a drift of the mean (see
    `budget`).
    """
    known = faded(times)
    gone = (times - known) * _falling(times, FADES_TO, 2 * FADES_TO)
    return np.asarray(J2_SHARE * known + gone)


def _falling(times: FloatArray, start: float, end: float) -> FloatArray:
    """A cosine that falls from 1 at one distance from J2000.0 to 0 at another."""
    phase = np.clip((np.abs(times) - start) / (end - start), 0.0, 1.0)
    return np.asarray(0.5 * (1 + np.cos(np.pi * phase)))
