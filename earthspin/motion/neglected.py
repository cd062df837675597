"""How far each effect moves the axes of the Earth, for those who leave it out.

Measured by `python -m data_tools neglected`: the path of the figure axis with all effects of a rigid
Earth under Sun and Moon, less the path with one switched off; the response of the inside switched on.
"""

from __future__ import annotations

from typing import NamedTuple

from earthspin.constants import MAS

#: Days from J2000.0 over which the sizes were measured.
MEASURED = 36160.0
SOURCE = "measured on DE421 from 1901 to 2050: python -m data_tools neglected"


class Growth(NamedTuple):
    """A bound that grows with the time from J2000.0: mas, mas per year, mas per year squared."""

    swing: float
    rate: float = 0.0
    bend: float = 0.0


SIZES = {
    "planets": Growth(0.20, 0.1255),
    "j3": Growth(0.202, 0.00187),
    "j4": Growth(0.0016, 0.01003),
    "triaxiality": Growth(0.038, 0.00035),
    "geodesic": Growth(0.141, 7.6377),
    "j2-rate": Growth(0.006, 0.0, 2.76e-4),
    "second-order": Growth(9.2, 0.2438),
    "nonrigid": Growth(57.5),
}


def size_of_effect(effect: str, reach: float) -> float:
    """Bound on the change of the figure axis by an effect, rad.

    Parameters
    ----------
    effect : str
        A word of `SIZES`.
    reach : float
        Longest time from J2000.0, d; measured up to `MEASURED`, and continued beyond.
    """
    growth, years = SIZES[effect], reach / 365.25
    return MAS * (growth.swing + growth.rate * years + growth.bend * years * years)
