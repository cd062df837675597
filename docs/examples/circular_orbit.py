"""A source of positions of one's own: a circular orbit in the ecliptic of J2000.0."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr

import earthspin
from earthspin.sky.iau import fixed_ecliptic
from earthspin.units import FloatArray


@dataclass(frozen=True)
class CircularOrbit:
    """A body on a circle about another, at the equinox on J2000.0."""

    radius: float  # m
    period: float  # d
    centre: int = 399  # NAIF code of what it circles
    coverage: tuple[float, float] = (-math.inf, math.inf)  # d from J2000.0 TDB

    def positions(self, days: FloatArray) -> FloatArray:
        """Metres along the ICRF, shape (n, 3)."""
        angle = 2 * math.pi * days / self.period
        circle = self.radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)
        return np.asarray(circle @ fixed_ecliptic())


def mean_sun() -> xr.Dataset:
    """A year under a Sun on a circle, with or without Skyfield."""
    sun = earthspin.SUN.replace(position=CircularOrbit(149_597_870_700.0, 365.256363))
    return earthspin.torque_series("2000-01-01T12:00", "2001-01-01", "1 d", perturbers=sun)
