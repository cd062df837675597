"""What an effect is: a word, a switch, and how far it moves the axes of the Earth."""

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
    """A bound that grows with the time from J2000.0: mas, mas per year, mas per year squared."""

    swing: float
    rate: float = 0.0
    bend: float = 0.0


class Numbers(Protocol):
    """What an effect may ask of the body that spins: its fields, in SI units."""

    def number(self, name: str) -> float:
        """Return a field as a float."""


@dataclass(frozen=True)
class Effect:
    """Something that moves the axes beside the pull on the bulge.

    Attributes
    ----------
    name : str
        The word for it.
    switch_on : callable
        Forces without it, and the numbers of the body, to forces with it.
    size : Growth
        Bound on how far it moves the figure axis of the Earth: with all effects of a rigid Earth
        under Sun and Moon, less with this one switched off.
    source : str
        Where the size comes from.
    """

    name: str
    switch_on: Callable[[Forces, Numbers], Forces]
    size: Growth
    source: str = SOURCE

    def size_at(self, reach: float) -> float:
        """Bound on the change of the figure axis, rad.

        Parameters
        ----------
        reach : float
            Longest time from J2000.0, d; measured up to `MEASURED`, and continued beyond.
        """
        years = reach / 365.25
        return MAS * (self.size.swing + self.size.rate * years + self.size.bend * years * years)
