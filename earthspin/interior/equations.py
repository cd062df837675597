"""Equations of the static deformation of a self-gravitating layered body, in degree two.

In the notation of Takeuchi & Saito (1972, Methods in Computational Physics 11, eq. 82):

    y1, y3  radial and tangential displacement      y5  potential of the displaced masses
    y2, y4  radial and tangential stress            y6 = dy5/dr - 4 pi G rho y1 + 3 y5/r

and, in the liquid core, where displacement is not defined, the pair y5 and
y7 = y6 + 4 pi G y2/g of Saito (1974, J. Phys. Earth 22, 123). Lengths are in units of the
radius R, densities in mean densities, accelerations in surface gravity g; then 4 pi G = 3.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from earthspin.constants import G
from earthspin.interior.layers import Layer, LayeredBody
from earthspin.numerics.arrays import Array

FOUR_PI_G = 3.0
#: Starting radius of the integration; the equations are singular at the centre.
START = 1e-3
#: Smallest core radius, as a fraction of R. At this size the starting radius causes an error of
#: 1.6e-5 in the response of an inner core to a potential of its own.
SMALLEST_CORE = 1e-2


class Profile:
    """Density, elastic moduli and gravity of a layered body as functions of radius, normalised."""

    def __init__(self, body: LayeredBody) -> None:
        self.layers = body.layers
        self.tops = [layer.top / body.radius for layer in body.layers]
        #: The layer in which the integration starts; of the layers below it only the mass matters.
        self.first = next(i for i, top in enumerate(self.tops) if top > START)
        self.density_unit = body.mass / (4 / 3 * np.pi * body.radius**3)
        gravity = G.value * body.mass / body.radius**2
        self.modulus_unit = self.density_unit * gravity * body.radius
        self._mass = [self._primitive(layer) for layer in body.layers]
        self._below = np.zeros(len(self.tops))
        for i in range(1, len(self.tops)):
            edge = self.tops[i - 1]
            step = self._mass[i - 1](edge) - self._mass[i](edge)
            self._below[i] = self._below[i - 1] + step

    def _primitive(self, layer: Layer) -> np.polynomial.Polynomial:
        density = tuple(d / self.density_unit for d in layer.density)
        return FOUR_PI_G * np.polynomial.Polynomial((0.0, 0.0, *density)).integ()

    def density(self, i: int, r: Any) -> Any:
        """Density of layer i at radius r, in normalised units."""
        return _horner(self.layers[i].density, r) / self.density_unit

    def gravity(self, i: int, r: Any) -> Any:
        """Gravity at radius r in layer i, in normalised units with 4 pi G = 3."""
        return (self._mass[i](r) + self._below[i]) / r**2

    def moduli(self, i: int, r: Any, strain: Array) -> tuple[Array, Array]:
        """Lame parameters lambda and mu of layer i at radii r, normalised, shape (strain, r) each.

        There is one row for each value of `strain` and one column for each radius in `r`.
        """
        layer, rho = self.layers[i], _horner(self.layers[i].density, r)
        seismic = rho * _horner(layer.vs, r) ** 2 / self.modulus_unit
        bulk = rho * _horner(layer.vp, r) ** 2 / self.modulus_unit - 4 / 3 * seismic
        mu = seismic * (1 + strain / layer.shear_q)[:, None]
        return bulk - 2 / 3 * mu, mu


def _horner(coefficients: tuple[float, ...], x: Any) -> Any:
    total = 0.0 * x
    for c in reversed(coefficients):
        total = total * x + c
    return total


def solid(profile: Profile, i: int, strain: Array) -> Callable[[Array], Array]:
    """Function of r that returns the matrix M of the equations dy/dr = M y in solid layer i.

    The function takes an array of radii and returns an array of shape (strain, r, 6, 6).

    The equations are those of degree two.
    """

    def matrix(r: Array) -> Array:
        rho, g = profile.density(i, r), profile.gravity(i, r)
        lam, mu = profile.moduli(i, r, strain)
        p = lam + 2 * mu
        shear = 2 * mu * (3 * lam + 2 * mu) / p / r**2
        m = np.zeros((strain.size, r.size, 6, 6), dtype=strain.dtype)
        m[..., 0, 0], m[..., 0, 1], m[..., 0, 2] = -2 * lam / (p * r), 1 / p, 6 * lam / (p * r)
        m[..., 1, 0], m[..., 1, 1] = 2 * shear - 4 * rho * g / r, -4 * mu / (p * r)
        m[..., 1, 2], m[..., 1, 3] = 6 * (rho * g / r - shear), 6 / r
        m[..., 1, 4], m[..., 1, 5] = 3 * rho / r, -rho
        m[..., 2, 0], m[..., 2, 2], m[..., 2, 3] = -1 / r, 1 / r, 1 / mu
        m[..., 3, 0], m[..., 3, 1] = rho * g / r - shear, -lam / (p * r)
        m[..., 3, 2] = 2 * mu / (p * r**2) * (11 * lam + 10 * mu)
        m[..., 3, 3], m[..., 3, 4] = -3 / r, -rho / r
        m[..., 4, 0], m[..., 4, 4], m[..., 4, 5] = FOUR_PI_G * rho, -3 / r, 1
        m[..., 5, 0], m[..., 5, 2] = 3 * FOUR_PI_G * rho / r, -6 * FOUR_PI_G * rho / r
        m[..., 5, 5] = 1 / r
        return m

    return matrix


def liquid(profile: Profile, i: int) -> Callable[[Array], Array]:
    """Function of r that returns the matrix M of the equations dy/dr = M y in liquid layer i.

    The function takes an array of radii and returns an array of shape (r, 2, 2).

    The unknowns are y5 and y7 (Saito 1974, eq. 17).
    """

    def matrix(r: Array) -> Array:
        s = FOUR_PI_G * profile.density(i, r) / profile.gravity(i, r)
        rows = ([s - 3 / r, np.ones_like(r)], [2 * s / r, 1 / r - s])
        return np.moveaxis(np.array(rows), -1, 0)

    return matrix


def solid_centre(profile: Profile, strain: Array) -> Array:
    """Three regular solutions of the deformation equations near a solid centre, (strain, 6, 3)."""
    r, i = START, profile.first
    lam, mu = (modulus[:, 0] for modulus in profile.moduli(i, np.array([r]), strain))
    rho = profile.density(i, r)
    y = np.zeros((strain.size, 6, 3), dtype=strain.dtype)
    y[:, 0, 0], y[:, 1, 0], y[:, 2, 0], y[:, 3, 0] = 2 * r, 4 * mu, r, 2 * mu
    y[:, 5, 0] = -2 * FOUR_PI_G * rho * r
    y[:, 4, 1], y[:, 5, 1] = r**2, 5 * r
    ratio = (5 * lam + 7 * mu) / (6 * lam)
    y[:, 0, 2], y[:, 1, 2] = r**3, ((5 - 6 * ratio) * lam + 6 * mu) * r**2
    y[:, 2, 2], y[:, 3, 2] = ratio * r**3, mu * (2 * ratio + 1) * r**2
    return y


def liquid_centre(profile: Profile, i: int, r: float = START) -> Array:
    """Regular solution of the deformation equations near a liquid centre: y5 and y7."""
    s = FOUR_PI_G * profile.density(i, r) / profile.gravity(i, r)
    return np.array([r**2, (5 / r - s) * r**2])
