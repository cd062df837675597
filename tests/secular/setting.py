"""What the tests of the secular motion share: the Earth's numbers, fixed orbits, a third solver."""

from dataclasses import dataclass

import erfa
import numpy as np
from scipy.integrate import solve_ivp

from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, J2000_JD, JULIAN_YEAR
from earthspin.secular.averaged_torque import ChangingOrbit, PrecessionConstant, Shape, Tides
from earthspin.sky.orbit_table import OrbitTable, shipped

KYR = 1000 * JULIAN_YEAR
TABLE = shipped("earth")
assert TABLE is not None
EARTHS: OrbitTable = TABLE
#: Pole of IAU 2006 at J2000.0, and obliquity.
POLE = np.asarray(erfa.pmat06(J2000_JD, 0.0)[2])
COSINE = np.cos(84381.406 * ARCSEC)
NODE_RATE = 2 * np.pi / (6798.383 * 86400.0)
#: Rates of precession in longitude by Sun and Moon, "/yr, as tests of precession pin them, and
#: -0.46780e-3 + 0.31367e-3 - 0.21050e-3 + 0.02600e-3 from table 3 of Capitaine et al. 2003.
SUN, MOON, PUBLISHED, GEODESIC = 15.948974, 34.455341, -33.863e-5, 1919.883e-5
SPIN = 2 * np.pi * 1.00273781191135448 / 86400.0
MONTH = 27.321662 * 86400.0
J2_RATE = -3.001e-9 / 1.0826359e-3 / (100 * JULIAN_YEAR)
E0 = 0.016708634


def earths(tides: float = 1.0, j2_rate: float = J2_RATE) -> PrecessionConstant:
    """The Earth's constant of precession, by the numbers above."""
    return PrecessionConstant(
        sun=SUN * ARCSEC_PER_YEAR / COSINE,
        moon=(MOON + PUBLISHED) * ARCSEC_PER_YEAR / COSINE,
        eccentricity=E0,
        geodesic=GEODESIC * ARCSEC_PER_YEAR,
        tides=Tides.of_the_earth(tides, SPIN, 2 * np.pi / MONTH),
        j2_rate=j2_rate,
        node_rate=NODE_RATE,
    )


def arcsec(found: np.ndarray, true: np.ndarray) -> float:
    """Largest angle between unit vectors, component first."""
    return float(np.max(np.linalg.norm(found - true, axis=0)) / ARCSEC)


def inclined_axis(obliquity: float, normal: np.ndarray | None = None) -> np.ndarray:
    """An axis at an obliquity, rad, from a normal."""
    normal = np.array([0.0, 0.0, 1.0]) if normal is None else normal
    across = np.cross(normal, [1.0, 0.3, 0.2])
    across /= np.linalg.norm(across)
    return np.cos(obliquity) * normal + np.sin(obliquity) * across


@dataclass(frozen=True)
class FixedOrbit:
    """An orbit that does not change."""

    eccentricity: float = 0.0

    @property
    def coverage(self) -> tuple[float, float]:
        return float(self.edges[0]), float(self.edges[-1])

    @property
    def edges(self) -> np.ndarray:
        return 20 * KYR * np.arange(-60.0, 61.0)

    def at(self, times: np.ndarray) -> Shape:
        one = np.ones_like(times)
        normal = np.stack([0 * one, 0 * one, one])
        return normal, np.stack([self.eccentricity * one, 0 * one, 0 * one]), 0 * normal


def turned(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """An axis turned about the third, shape (3, n)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * axis[0] - s * axis[1], s * axis[0] + c * axis[1], axis[2] + 0 * c])


def by_scipy(
    strength: PrecessionConstant, orbit: ChangingOrbit, start: np.ndarray, times: np.ndarray
) -> np.ndarray:
    """The equation as one writes it: two torques, each about its own axis, and the geodesic turn.

    Times lead away from J2000.0. The fade of the J2 rate stands here again, as a formula.
    """
    span = 1 - strength.eccentricity**2

    def slope(t: float, s: np.ndarray) -> np.ndarray:
        n, e, turning = (of[:, 0] for of in orbit.at(np.array([t])))
        share = (span / (1 - e @ e)) ** 1.5
        years = abs(t) / JULIAN_YEAR
        fade = 1.0 if years < 2000 else 0.0
        if 2000 <= years < 10_000:
            fade = 0.5 + 0.5 * np.cos(np.pi * (years - 2000) / 8000)
        h = (1 + strength.tides.spin * t) * strength.ellipticity
        h *= 1 + strength.j2_rate * t * fade
        moons = n + np.cross(n, turning) / strength.node_rate
        total = strength.sun * share * (n @ s) * np.cross(s, n)
        total += (
            strength.moon * (1 + strength.tides.moon * t) ** 2 * (moons @ s) * np.cross(s, moons)
        )
        return h * total + strength.geodesic * span / (1 - e @ e) * np.cross(n, s)

    found = np.empty((3, times.size))
    state, now = start, 0.0
    # from edge to edge: there the series of a table has a corner
    inner = orbit.edges[(np.abs(orbit.edges) < abs(times[-1])) & (orbit.edges * times[-1] > 0)]
    stops = np.append(inner[np.argsort(np.abs(inner))], times[-1])
    for stop in stops:
        done = solve_ivp(
            slope, (now, stop), state, "DOP853", rtol=3e-13, atol=1e-14, dense_output=True
        )
        asked = (np.abs(times) >= abs(now)) & (np.abs(times) <= abs(stop))
        found[:, asked] = done.sol(times[asked])
        state, now = done.y[:, -1], stop
    return found / np.linalg.norm(found, axis=0)
