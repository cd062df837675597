"""Changes of the length of day and of UT1 by the zonal tides of Sun and Moon.

A mass in the declination d at the distance r raises a zonal bulge, which changes the polar moment:

    Z = dC/(k M a2) = -(2/3) sum (m/M) (a/r)3 P2(sin d),    P2(s) = (3 s2 - 1)/2

The potential (G m a2/r3) P2(sin d) P2(sin latitude) changes C20 by k (m/M) (a/r)3 P2(sin d); the
tide does not change the trace of the tensor of inertia, hence dC = -(2/3) M a2 dC20. C times the
spin is constant, with C that of what turns along, and the length of day (LOD) changes by

    LOD/(86400 s) = kappa (Z(t - delay) - mean of Z),    kappa = k M a2/C,    UT1' = -LOD/(86400 s)

(Yoder, Williams & Parke 1981, J. Geophys. Res. 86, 881).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.constants import COMPUTED, DAY, Constant
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import elastic
from earthspin.interior.ocean_and_anelasticity import global_ocean
from earthspin.numerics.arrays import FloatArray

_TABLE = "IERS Conventions (2010), table 8.1"
#: kappa, with the core at rest, anelasticity and ocean included. All terms of table 8.1 shorter
#: than a year are from 0.936 to 0.975; those observed, by band, from 0.925 to 0.966.
KAPPA = Constant(
    0.94, "", 0.014, "Yoder, Williams & Parke 1981, J. Geophys. Res. 86, 881, value of k/C", _TABLE
)
#: kappa at 13.66 days.
OBSERVED = Constant(0.933, "", 0.004, "length of day of C04, 1997 to 2026, term Mf", COMPUTED)
#: Delay of the Earth's response. Table 8.1 has one of 0.14 d in three terms, and none in others.
DELAY = Constant(0.13, "d", 0.03, "length of day of C04, 1997 to 2026, 5 to 28 d", COMPUTED)
#: Mean of (a/r)3 P2(sin d) for a = 6378136.6 m over five turns of the node, 1953 to 2047.
MEAN_FACTORS = {"sun": -2.9558993e-14, "moon": -1.72921618e-6}
#: Half-widths that hold 95 % of the differences from table 8.1 over 93 years, s: of the length of
#: day, and of changes of UT1 in less than a year.
ERRORS = {"sun": (5.9e-6, 2.9e-4), "moon": (1.43e-5, 5.5e-5), "total": (1.65e-5, 3.1e-4)}
#: Growth of the half-width of UT1 over years, s per day.
_DRIFT = 1.6e-7
#: Time between nodes that interpolate the tide, d; it adds up to 3e-7 s.
NODE_STEP = 1.0


def change_of_moment(
    mass_ratio: float, radius: float, declination: FloatArray, distance: FloatArray, mean: float
) -> FloatArray:
    """Change of C/(M a2) by the zonal tide of one mass, for a Love number of 1, without its mean.

    Parameters
    ----------
    mass_ratio : float
        Mass that raises the tide over that of the Earth.
    radius : float
        Equatorial radius of the Earth, m.
    declination, distance : ndarray, shape (n,)
        From the mean equator of date, rad; m.
    mean : float
        Mean of (a/r)3 P2(sin d), from `MEAN_FACTORS`.
    """
    factor = (radius / distance) ** 3 * (3 * np.sin(declination) ** 2 - 1) / 2
    return np.asarray(-2 / 3 * mass_ratio * (factor - mean))


def computed_responses(layers: LayeredBody) -> dict[str, float]:
    """Compute kappa of a layered Earth, by what turns along and what yields.

    The core yields to the tide in each case. If it slips, neither its moment nor its bulge counts.
    An equilibrium ocean on a part of the globe is counted as that part of a global one, which is
    crude.
    """
    love, moment = elastic(layers), layers.moment_factor
    mantle, mantle_k = moment * (1 - layers.core_fraction), float(love.k - love.core_k)
    ocean = global_ocean(layers)
    return {
        "core_turning_along": float(love.k) / moment,
        "liquid_core": mantle_k / mantle,
        "ocean_on_65_percent": (mantle_k + 0.65 * ocean) / mantle,
        "ocean_on_70_percent": (mantle_k + 0.70 * ocean) / mantle,
    }


def spline(days: FloatArray, values: FloatArray) -> Any:
    """Cubic spline through values on given days."""
    from scipy.interpolate import CubicSpline  # imported here because it takes 0.2 s

    return CubicSpline(days, values)


@dataclass(frozen=True)
class ZonalTides:
    """Zonal tides over a span of time.

    Attributes
    ----------
    names : tuple of str
        Names of the masses in `ERRORS`; "total" for their sum.
    change : CubicSpline
        Change of C/(M a2) for a Love number of 1, by days from J2000.0 TDB, shape (n, names).
    """

    names: tuple[str, ...]
    change: Any

    @classmethod
    def through(cls, names: Sequence[str], days: FloatArray, changes: FloatArray) -> ZonalTides:
        """Interpolate changes, of shape (names, n), between days."""
        return cls(tuple(names), spline(days, changes.T))

    def length_of_day(self, days: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Change of the length of day and its 95 % half-width, s, shape (n, names).

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB, from `DELAY` after the first node to the last node.
        """
        value = KAPPA.value * DAY * self.change(days - DELAY.value)
        return value, np.broadcast_to([ERRORS[name][0] for name in self.names], value.shape)

    def ut1(self, days: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Change of UT1 since the first of the days, and its 95 % half-width, s, shape (n, names).

        Parameters
        ----------
        days : ndarray, shape (n,)
            As for `length_of_day`.
        """
        integral = self.change.antiderivative()(days - DELAY.value)
        value = KAPPA.value * DAY * (integral[0] - integral)
        rate, most = np.transpose([ERRORS[name] for name in self.names])
        after = abs(days - days[0])[:, np.newaxis]
        return value, np.minimum(rate * after, most) + _DRIFT * after
