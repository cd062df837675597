"""Layered bodies: shells with polynomial profiles, with their mass and moments of inertia."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from earthspin.constants import G

Numeric = Any


@dataclass(frozen=True)
class Layer:
    """One shell, whose density and velocities are polynomials in x = r/R, constant term first.

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
        outer = self.radius if radius is None else radius
        return float(8 * math.pi / 3 * self._radial_moment(4, outer))

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
    total = 0.0
    for n in reversed(range(len(density))):
        total = total * x + density[n] / (n + power + 1)
    return float(total * x ** (power + 1))


def tidal_inertia(layers: LayeredBody, spin_rate: Numeric) -> Numeric:
    """Ratio Omega2 R5/(3 G A): product of inertia over A for k2 = 1 and a wobble of 1 rad.

    It is the product of inertia divided by A for k2 = 1 and a wobble of 1 rad.
    """
    moment = layers.moment_of_inertia()
    return spin_rate**2 * layers.radius**5 / (3 * G.value * moment)
