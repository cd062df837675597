"""Class of effects on the axes: name, and function that switches an effect on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from earthspin.motion.forces import Forces


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
    coefficient : str
        Field of the body to which the effect is proportional; empty if there is none.
    """

    name: str
    switch_on: Callable[[Forces, Numbers], Forces]
    coefficient: str = ""
