"""How far each effect moves the axes of the Earth, for those who leave it out.

Measured by `python -m data_tools neglected`: the path of the figure axis with all effects of a
rigid Earth under Sun and Moon, less the path with one switched off; for the response of the inside,
the path with it less the path without.
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
    "planets": Growth(0.237, 0.125),
    "j3": Growth(0.215),
    "j4": Growth(0.00163, 0.0101),
    "triaxiality": Growth(0.041),
    "geodesic": Growth(0.0629, 7.64),
    "j2-rate": Growth(0.00483, 0.0, 2.81e-4),
    "second-order": Growth(9.72, 0.179),
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
