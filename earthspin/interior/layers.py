"""Layered bodies: shells with polynomial profiles, from samples along the radius, and PREM."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial.polynomial import polyval

from earthspin.constants import PREM_READ, G, Tabulated
from earthspin.numerics.arrays import Numeric

# --- layers, mass and moments of inertia ----------------------------------------------------------


@dataclass(frozen=True)
class Layer:
    """Spherical shell with density and velocities as polynomials in x = r/R, constant term first.

    Attributes
    ----------
    top : float
        Outer radius, m.
    density : tuple of float
        kg m-3.
    vp, vs : tuple of float
        Speeds of compressional and shear waves at a period of 1 s, m/s; no `vs` in a liquid.
    shear_q : float
        Quality factor in shear; infinite in a liquid.
    """

    top: float
    density: tuple[float, ...]
    vp: tuple[float, ...]
    vs: tuple[float, ...] = ()
    shear_q: float = math.inf


@dataclass(frozen=True)
class LayeredBody:
    """A layered body: solid mantle, optional liquid core, and optional solid inner core.

    The core and the inner core may be absent.

    Attributes
    ----------
    name : str
    layers : tuple of Layer
        From the centre outwards.
    reference : str
    """

    name: str
    layers: tuple[Layer, ...]
    reference: str

    def __str__(self) -> str:
        return f"{self.name}, {len(self.layers)} layers to {self.radius / 1000:.6g} km"

    @property
    def radius(self) -> float:
        """Outer radius R of the body, m."""
        return self.layers[-1].top

    @property
    def core_radius(self) -> float:
        """Radius of the core-mantle boundary, m; 0 without a core."""
        return max((layer.top for layer in self.layers[:-1] if not layer.vs), default=0.0)

    @property
    def inner_core_radius(self) -> float:
        """Radius of the solid inner core, m; 0 if there is none."""
        first = next((i for i, layer in enumerate(self.layers) if not layer.vs), 0)
        return self.layers[first - 1].top if first else 0.0

    @property
    def mass(self) -> float:
        """Mass of the whole body, kg."""
        return float(4 * math.pi * self._radial_moment(2, self.radius))

    def moment_of_inertia(self, radius: float | None = None) -> float:
        """Moment of inertia of the mass inside a radius, by default of the whole body, kg m2."""
        outer_radius = self.radius if radius is None else radius
        return float(8 * math.pi / 3 * self._radial_moment(4, outer_radius))

    @property
    def moment_factor(self) -> float:
        """Moment of inertia factor I/(M R2) of the whole body."""
        return self.moment_of_inertia() / (self.mass * self.radius**2)

    @property
    def core_fraction(self) -> float:
        """Moment of inertia of the whole core (liquid and solid) divided by that of the body."""
        return self.moment_of_inertia(self.core_radius) / self.moment_of_inertia()

    def _radial_moment(self, power: int, radius: float) -> float:
        """Integral of density times r^power from the centre to a radius, in closed form."""
        total, below = 0.0, 0.0
        for layer in self.layers:
            top = min(layer.top, radius) / self.radius
            total += _primitive(layer.density, power, top) - _primitive(layer.density, power, below)
            below = top
        return float(total * self.radius ** (power + 1))


def _primitive(density: tuple[float, ...], power: int, x: float) -> float:
    """Integral of x^power rho(x) from 0 to x, for a polynomial density rho."""
    integral = [coefficient / (n + power + 1) for n, coefficient in enumerate(density)]
    return float(polyval(x, integral) * x ** (power + 1))


def tidal_inertia(layers: LayeredBody, spin_rate: Numeric) -> Numeric:
    """Ratio Omega2 R5/(3 G A): product of inertia over A for k2 = 1 and a wobble of 1 rad.

    A is taken as the moment of inertia of the spherical layers.
    """
    moment = layers.moment_of_inertia()
    return spin_rate**2 * layers.radius**5 / (3 * G.value * moment)


# --- layers from samples, as in seismological tables ----------------------------------------------


def from_samples(
    name: str,
    radius: Sequence[float],
    density: Sequence[float],
    vp: Sequence[float],
    vs: Sequence[float],
    shear_q: Sequence[float],
    reference: str = "",
) -> LayeredBody:
    """Make a layered body from samples along the radius, linear between the samples.

    Parameters
    ----------
    name : str
    radius : sequence of float
        Radii from the centre outwards, m; a boundary is given by the same radius twice.
    density, vp, vs : sequence of float
        Density, kg m-3, and wave speeds, m/s; `vs` is 0 in a liquid.
    shear_q : sequence of float
        Quality factor of each sample; the value of the upper of two samples applies between them.
        Not used in a liquid.
    reference : str

    Raises
    ------
    ValueError
        If the radii do not begin at 0 or do not increase, or the columns differ in length.
    """
    r, rho, p, s, q = (
        np.asarray(column, dtype=float) for column in (radius, density, vp, vs, shear_q)
    )
    if len({column.shape for column in (r, rho, p, s, q)}) > 1 or r.ndim != 1 or r.size < 2:
        raise ValueError("give columns of equal length, at least two samples")
    if r[0] != 0 or np.any(np.diff(r) < 0) or not np.all(np.isfinite([r, rho, p, s])):
        raise ValueError("radii must begin at 0 and grow outwards, and all samples must be finite")
    whole, layers = r[-1], []
    for i in np.flatnonzero(np.diff(r) > 0):
        x = r[i : i + 2] / whole

        def line(column: Any, x: Any = x, i: int = int(i)) -> tuple[float, ...]:
            slope = (column[i + 1] - column[i]) / (x[1] - x[0])
            return float(column[i] - slope * x[0]), float(slope)

        solid = s[i] > 0 or s[i + 1] > 0
        vs, quality = (line(s), float(q[i + 1])) if solid else ((), np.inf)
        layers.append(Layer(float(r[i + 1]), line(rho), line(p), vs, quality))
    return LayeredBody(name, tuple(layers), reference)


# --- preliminary reference Earth model (PREM) -----------------------------------------------------


_PREM_SOURCE = "Dziewonski & Anderson 1981, PEPI 25, 297, table I"
PREM_LAYERS = Tabulated("layers of PREM", _PREM_SOURCE, PREM_READ)

_LOWER_MANTLE = (7956.5, -6476.1, 5528.3, -3080.7)  # density
_LID = ((2691.0, 692.4), (4187.5, 3938.2), (2151.9, 2348.1))
#: Isotropic layers below the upper crust.
_BELOW_CRUST = (
    Layer(1221.5e3, (13088.5, 0.0, -8838.1), (11262.2, 0.0, -6364.0), (3667.8, 0.0, -4447.5), 84.6),
    Layer(3480e3, (12581.5, -1263.8, -3642.6, -5528.1), (11048.7, -4036.2, 4802.3, -13573.2)),
    *(
        Layer(top, _LOWER_MANTLE, vp, vs, 312.0)
        for top, vp, vs in (
            (3630e3, (15389.1, -5318.1, 5524.2, -2551.4), (6925.4, 1467.2, -2083.4, 978.3)),
            (5600e3, (24952.0, -40467.3, 51483.2, -26641.9), (11167.1, -13781.8, 17457.5, -9277.7)),
            (5701e3, (29276.6, -23602.7, 5524.2, -2551.4), (22345.9, -17247.3, -2083.4, 978.3)),
        )
    ),
    Layer(5771e3, (5319.7, -1483.6), (19095.7, -9867.2), (9983.9, -4932.4), 143.0),
    Layer(5971e3, (11249.4, -8029.8), (39702.7, -32616.6), (22351.2, -18585.6), 143.0),
    Layer(6151e3, (7108.9, -3804.5), (20392.6, -12256.9), (8949.6, -4459.7), 143.0),
    Layer(6291e3, *_LID, 80.0),
    Layer(6346.6e3, *_LID, 600.0),
    Layer(6356e3, (2900.0,), (6800.0,), (3900.0,), 600.0),
)

#: PREM with its ocean of 3 km replaced by upper crust, so that the surface is solid and an ocean
#: can be added separately.
PREM = LayeredBody(
    "prem",
    (*_BELOW_CRUST, Layer(6371e3, (2600.0,), (5800.0,), (3200.0,), 600.0)),
    _PREM_SOURCE + "; its ocean filled by upper crust",
)
