"""Class of effects on the axes: name, function that switches an effect on, and its size."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from earthspin.constants import MAS
from earthspin.motion.forces import Forces

#: Days from J2000.0 over which the sizes were measured.
MEASURED = 36160.0
SOURCE = "measured on DE421 from 1901 to 2050: python -m data_tools neglected"


class Growth(NamedTuple):
    """Bound on an angle that grows in time: a + b t + c t2 from J2000.0, in mas and years."""

    swing: float
    rate: float = 0.0
    bend: float = 0.0


class Numbers(Protocol):
    """Interface to the fields of a body from which an effect takes its parameters."""

    def number(self, name: str) -> float:
        """Return a field of the body as a float."""


@dataclass(frozen=True)
class Effect:
    """An effect on the axes, besides the torque on the bulge, that users can switch on.

    Attributes
    ----------
    name : str
        Name of the effect in scenes.
    switch_on : callable
        Function of the forces without the effect and the numbers of the body that returns the
        forces with the effect.
    size : Growth
        Bound on the displacement of the Earth's figure axis: the difference between all effects of
        a rigid Earth under Sun and Moon, and all without this effect.
    source : str
        Source of the size.
    coefficient : str
        Field of the body to which the effect is proportional; empty if there is none.
    """

    name: str
    switch_on: Callable[[Forces, Numbers], Forces]
    size: Growth
    source: str = SOURCE
    coefficient: str = ""

    def size_at(self, reach: float) -> float:
        """Bound on the change of the figure axis by this effect up to a given time, rad.

        Parameters
        ----------
        reach : float
            Longest time from J2000.0, d; measured up to `MEASURED`, and extrapolated beyond.
        """
        years = reach / 365.25
        return MAS * (self.size.swing + self.size.rate * years + self.size.bend * years * years)
