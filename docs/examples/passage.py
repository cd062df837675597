"""Custom positions: a body that passes once, on a path that is not an ellipse."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr

import earthspin
from earthspin.units import FloatArray


@dataclass(frozen=True)
class Passage:
    """A body that passes another on a straight line, nearest to it at J2000.0."""

    nearest: tuple[float, float, float]  # m along the ICRF
    velocity: tuple[float, float, float]  # m/s
    centre: int = 399  # NAIF code of what it passes
    coverage: tuple[float, float] = (-math.inf, math.inf)  # d from J2000.0 TDB

    def positions(self, days: FloatArray) -> FloatArray:
        """Metres along the ICRF, shape (n, 3)."""
        return np.asarray(self.nearest + np.outer(86400.0 * days, self.velocity))


def passing_moon() -> xr.Dataset:
    """A second Moon passes at 200,000 km and 20 km/s, 45 degrees north, in any source."""
    away = math.sqrt(0.5) * 2e8
    moon = earthspin.MOON.replace(position=Passage((away, 0.0, away), (0.0, 2e4, 0.0)))
    return earthspin.torque_series(
        "2000-01-01", "2000-01-02", "1 min", body=earthspin.EARTH, perturbers=moon
    )
