"""A layered body: its shells, and its moments by the polynomials' primitives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.constants import G

Numeric = Any


@dataclass(frozen=True)
class Layer:
    """One shell; polynomials in x = r/R, constant term first.

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
    shear_q: float = np.inf


@dataclass(frozen=True)
class LayeredBody:
    """A body of layers: a solid mantle, and in it a liquid core, and in that a solid inner core.

    Core and inner core may be missing.

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

    @property
    def radius(self) -> float:
        """Radius R, m."""
        return self.layers[-1].top

    @property
    def core_radius(self) -> float:
        """Radius of the boundary between the liquid core and the mantle, m; 0 without a core."""
        return max((layer.top for layer in self.layers[:-1] if not layer.vs), default=0.0)

    @property
    def inner_core_radius(self) -> float:
        """Radius of the solid inner core, m; 0 if there is none."""
        first = next((i for i, layer in enumerate(self.layers) if not layer.vs), 0)
        return self.layers[first - 1].top if first else 0.0

    @property
    def mass(self) -> float:
        """Mass, kg."""
        return float(4 * np.pi * self._radial_moment(2, self.radius))

    def moment_of_inertia(self, radius: float | None = None) -> float:
        """Moment of inertia of what lies within a radius, kg m2; of all by default."""
        outer = self.radius if radius is None else radius
        return float(8 * np.pi / 3 * self._radial_moment(4, outer))

    @property
    def moment_factor(self) -> float:
        """I/(M R2)."""
        return self.moment_of_inertia() / (self.mass * self.radius**2)

    @property
    def core_fraction(self) -> float:
        """Moment of inertia of the core, inner core included, over that of the whole body."""
        return self.moment_of_inertia(self.core_radius) / self.moment_of_inertia()

    def _radial_moment(self, power: int, radius: float) -> float:
        """Integral of rho r^power from the centre, by the polynomials' primitives."""
        total, below = 0.0, 0.0
        for layer in self.layers:
            primitive = np.polynomial.Polynomial((0.0,) * power + layer.density).integ()
            top = min(layer.top, radius) / self.radius
            total += primitive(top) - primitive(below)
            below = top
        return float(total * self.radius ** (power + 1))


def tidal_inertia(layers: LayeredBody, spin_rate: Numeric) -> Numeric:
    """Omega2 R5/(3 G A): products of inertia over A per radian of wobble and unit of k2."""
    moment = layers.moment_of_inertia()
    return spin_rate**2 * layers.radius**5 / (3 * G.value * moment)


def from_samples(
    name: str,
    radius: Sequence[float],
    density: Sequence[float],
    vp: Sequence[float],
    vs: Sequence[float],
    shear_q: Sequence[float],
    reference: str = "",
) -> LayeredBody:
    """Make a layered body of samples, straight lines between them.

    Parameters
    ----------
    name : str
    radius : sequence of float
        m, from the centre outwards; a boundary has the same radius twice.
    density, vp, vs : sequence of float
        kg m-3, m/s; `vs` is 0 in a liquid.
    shear_q : sequence of float
        Of each sample; that of the upper of two counts between them. Not used in a liquid.
    reference : str

    Raises
    ------
    ValueError
        If the radii do not begin at 0 or do not grow, or the columns are not of one length.
    """
    r, rho, p, s, q = (
        np.asarray(column, dtype=float) for column in (radius, density, vp, vs, shear_q)
    )
    if len({column.shape for column in (r, rho, p, s, q)}) > 1 or r.ndim != 1 or r.size < 2:
        raise ValueError("samples are columns of one length, two at least")
    if r[0] != 0 or np.any(np.diff(r) < 0) or not np.all(np.isfinite([r, rho, p, s])):
        raise ValueError("radii begin at 0 and grow outwards, and all samples are finite")
    whole, layers = r[-1], []
    for i in np.flatnonzero(np.diff(r) > 0):
        x = r[i : i + 2] / whole

        def line(column: Any, x: Any = x, i: int = int(i)) -> tuple[float, ...]:
            slope = (column[i + 1] - column[i]) / (x[1] - x[0])
            return float(column[i] - slope * x[0]), float(slope)

        solid = s[i] > 0 or s[i + 1] > 0
        layers.append(
            Layer(
                float(r[i + 1]),
                line(rho),
                line(p),
                line(s) if solid else (),
                float(q[i + 1]) if solid else np.inf,
            )
        )
    return LayeredBody(name, tuple(layers), reference)
