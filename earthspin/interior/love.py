"""Degree-two response of a layered body to tides, surface loads and rotation of its core."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.polynomial.polynomial import polyval

from earthspin.constants import G
from earthspin.errors import UndefinedError
from earthspin.interior.layers import LayeredBody
from earthspin.numerics.arrays import Array
from earthspin.numerics.polynomials import carry

# --- equations of static deformation --------------------------------------------------------------
# In the notation of Takeuchi & Saito (1972, Methods in Computational Physics 11, eq. 82):
#
#     y1, y3  radial and tangential displacement      y5  potential of the displaced masses
#     y2, y4  radial and tangential stress            y6 = dy5/dr - 4 pi G rho y1 + 3 y5/r
#
# and, in the liquid core, where displacement is not defined, the pair y5 and y7 = y6 + 4 pi G y2/g
# of Saito (1974, J. Phys. Earth 22, 123). Lengths are in units of the radius R, densities in mean
# densities, accelerations in surface gravity g; then 4 pi G = 3.

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
        self.core = body.core_radius / body.radius
        self.inner_core = body.inner_core_radius / body.radius
        #: The layer in which the integration starts; of the layers below it only the mass matters.
        self.first = next(i for i, top in enumerate(self.tops) if top > START)
        self.density_unit = body.mass / (4 / 3 * np.pi * body.radius**3)
        gravity = G.value * body.mass / body.radius**2
        self.modulus_unit = self.density_unit * gravity * body.radius
        densities = (np.array(layer.density) / self.density_unit for layer in body.layers)
        self._mass = [FOUR_PI_G * Polynomial((0.0, 0.0, *rho)).integ() for rho in densities]
        self._below = np.zeros(len(self.tops))
        for i in range(1, len(self.tops)):
            edge = self.tops[i - 1]
            step = self._mass[i - 1](edge) - self._mass[i](edge)
            self._below[i] = self._below[i - 1] + step

    def density(self, i: int, r: Any) -> Any:
        """Density of layer i at radius r, in normalised units."""
        return polyval(r, self.layers[i].density) / self.density_unit

    def gravity(self, i: int, r: Any) -> Any:
        """Gravity at radius r in layer i, in normalised units with 4 pi G = 3."""
        return (self._mass[i](r) + self._below[i]) / r**2

    def moduli(self, i: int, r: Any, dmu: Array) -> tuple[Array, Array]:
        """Lame parameters lambda and mu of layer i at radii r, normalised, shape (changes, r) each.

        There is one row for each value of `dmu` and one column for each radius in `r`.
        """
        layer, rho = self.layers[i], polyval(r, self.layers[i].density)
        seismic = rho * polyval(r, layer.vs) ** 2 / self.modulus_unit
        bulk = rho * polyval(r, layer.vp) ** 2 / self.modulus_unit - 4 / 3 * seismic
        mu = seismic * (1 + dmu / layer.shear_q)[:, None]
        return bulk - 2 / 3 * mu, mu


def solid(profile: Profile, i: int, dmu: Array) -> Callable[[Array], Array]:
    """Function of r that returns the matrix M of the equations dy/dr = M y in solid layer i.

    The function takes an array of radii and returns an array of shape (changes, r, 6, 6).

    The equations are those of degree two.
    """

    def matrix(r: Array) -> Array:
        rho, g = profile.density(i, r), profile.gravity(i, r)
        lam, mu = profile.moduli(i, r, dmu)
        p = lam + 2 * mu
        shear = 2 * mu * (3 * lam + 2 * mu) / p / r**2
        m = np.zeros((dmu.size, r.size, 6, 6), dtype=dmu.dtype)
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


def solid_centre(profile: Profile, dmu: Array) -> Array:
    """Three regular solutions of the deformation equations near a solid centre, (changes, 6, 3)."""
    r, i = START, profile.first
    lam, mu = (modulus[:, 0] for modulus in profile.moduli(i, np.array([r]), dmu))
    rho = profile.density(i, r)
    y = np.zeros((dmu.size, 6, 3), dtype=dmu.dtype)
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


# --- Love numbers and core response ---------------------------------------------------------------

#: Amplitude of each potential, and of a load's potential, in inner core, fluid core and mantle.
_ACTS_IN = np.array([[1.0, 0.0, 1.0, 1.0], [1.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]])
_LOAD = 3


@dataclass(frozen=True)
class DegreeTwoLoveNumbers:
    """Degree-two Love numbers of a layered body, and responses of its core regions.

    Arrays have the shape of the given `dmu`.

    Attributes
    ----------
    k, h, l : array
        Love numbers of a tide.
    k_load, h_load, l_load : array
        Load Love numbers.
    response : array, shape (..., 3, 3)
        [i, j]: potential at the surface due to the displaced masses of region i, if a potential of
        unit size at the surface is applied in region j only. The regions are the whole body, its
        fluid core and its inner core. Symmetric by Betti's theorem; [0, 0] is k.
    tilt_factor : array, shape (..., 3)
        Height of the equipotential surface above the ground for each applied potential, relative to
        it: 1 + k - h for a tide.
    """

    k: Array
    h: Array
    l: Array  # noqa: E741  (the field's own name)
    k_load: Array
    h_load: Array
    l_load: Array
    response: Array
    tilt_factor: Array

    @property
    def core_k(self) -> Array:
        """Contribution of mass displacements in the whole core to the tidal Love number k."""
        return np.asarray(self.response[..., 1:, 0].sum(axis=-1))

    @property
    def k_pressure(self) -> Array:
        """Love number k of the whole body for a potential that acts on its core only.

        Such a potential is due to a tilt of the rotation axis of the core.
        """
        return np.asarray(self.response[..., 0, 1:].sum(axis=-1))

    @property
    def core_k_pressure(self) -> Array:
        """Contribution of mass displacements in the whole core to `k_pressure`."""
        return np.asarray(self.response[..., 1:, 1:].sum(axis=(-1, -2)))


def solve_love_numbers(body: LayeredBody, dmu: Any = 0.0) -> DegreeTwoLoveNumbers:
    """Compute Love numbers of a layered body, and responses to potentials in each region.

    Parameters
    ----------
    body : LayeredBody
    dmu : complex or array
        Relative change of the shear modulus at quality factor 1; a layer's modulus is multiplied by
        1 + dmu/shear_q. 0 is the elastic body at seismic periods.

    Raises
    ------
    UndefinedError
        If the surface is liquid, there are several liquid layers separated by solid ones, or the
        radius of a core is less than a hundredth of the body's.
    """
    fluid = [not layer.vs for layer in body.layers]
    liquids = sum(
        is_liquid and not below_liquid for below_liquid, is_liquid in pairwise([False, *fluid])
    )
    if fluid[-1] or liquids > 1:
        fault = "ends in a liquid" if fluid[-1] else f"has {liquids} liquids with solids between"
        raise UndefinedError(
            f"interior '{body.name}' {fault}; Love numbers need a solid surface and at most one "
            "liquid under it, with or without a solid in that: leave out the others, or give them "
            "a vs"
        )
    for core, radius in (("an inner core", body.inner_core_radius), ("a core", body.core_radius)):
        if 0 < radius < SMALLEST_CORE * body.radius:
            raise UndefinedError(
                f"interior '{body.name}': {core} of {radius / 1000:.4g} km is less than a "
                "hundredth of the radius, too small to have an effect; leave it out"
            )
    dmu = np.asarray(dmu)
    flat = np.atleast_1d(dmu).ravel()
    solution = _solved(Profile(body), flat)
    return DegreeTwoLoveNumbers(
        *(value.reshape((*dmu.shape, *value.shape[1:])) for value in solution)
    )


@lru_cache(maxsize=32)
def elastic(layers: LayeredBody) -> DegreeTwoLoveNumbers:
    """Compute Love numbers and responses of a layered body with its elastic moduli."""
    return solve_love_numbers(layers)


#: Interpolation of Love numbers: range of the change of the shear modulus, and number of nodes.
_DMU_RANGE = (-40.0, 2.0)
_SOFTENING_NODES = 10


@lru_cache(maxsize=8)
def softening(layers: LayeredBody) -> tuple[Chebyshev, ...]:
    """Ratios of anelastic to elastic Love numbers as polynomials in the change of rigidity.

    The Love numbers are `k`, `core_k`, `k_pressure` and `core_k_pressure`.

    The variable is `dmu` of `solve_love_numbers`, which may be complex, because Love
    numbers are analytic in the modulus. The error relative to the integration is at most 1e-8.
    """
    grid = np.polynomial.chebyshev.chebpts1(_SOFTENING_NODES)
    low, high = _DMU_RANGE
    dmu = (low + high) / 2 + (high - low) / 2 * grid
    love, reference = solve_love_numbers(layers, dmu), elastic(layers)
    ratios = []
    for name in ("k", "core_k", "k_pressure", "core_k_pressure"):
        ratio = getattr(love, name) / float(getattr(reference, name))
        ratios.append(Chebyshev.fit(dmu, ratio, _SOFTENING_NODES - 1, domain=list(_DMU_RANGE)))
    return tuple(ratios)


# --- from the centre to the surface -------------------------------------------------------------
#
# A state has one column for each unknown, then one for each applied potential. If the applied
# potential differs by d across a boundary, y5 jumps by d r2, and y6 by 5 d r.


def _solved(profile: Profile, dmu: Array) -> tuple[Array, ...]:
    """Solve the deformation equations for all potentials; return the Love numbers in order."""
    if not profile.core:
        y = _across(profile, profile.first, solid_centre(profile, dmu), dmu)
        bottom = y = np.concatenate([y, np.zeros((dmu.size, 6, 4))], axis=-1)
        conditions: list[Array] = []
        inner = core = None
    else:
        first, inner, conditions = _through_inner_core(profile, dmu)
        pair, i = _through_liquid(profile, first)
        bottom = _onto_mantle(profile, pair)
        core = bottom
        y = _across(profile, i, bottom, dmu)
    sources = np.zeros((3, 4))
    sources[0, _LOAD] = -5 / 3  # weight of the load
    sources[2] = 5 * _ACTS_IN[2]
    unknowns = y.shape[-1] - 4
    boundary = np.concatenate([*conditions, y[:, [1, 3, 5]]], axis=1)
    required = np.zeros((boundary.shape[1], 4))
    required[-3:] = sources
    weights = np.linalg.solve(boundary[..., :unknowns], required - boundary[..., unknowns:])
    weights = np.concatenate([weights, np.broadcast_to(np.eye(4), (dmu.size, 4, 4))], axis=1)
    top = y @ weights
    response = np.zeros((dmu.size, 3, 4), dtype=top.dtype)
    response[:, 0] = top[:, 4] - _ACTS_IN[2]
    if core is not None:
        response[:, 1] = _inside(core @ weights, profile.core)
    if inner is not None:
        response[:, 2] = _inside(inner @ weights, profile.inner_core)
        response[:, 1] -= response[:, 2]
    tilt_factor = top[:, 4] - top[:, 0]
    return (
        response[:, 0, 0], top[:, 0, 0], top[:, 2, 0],
        response[:, 0, _LOAD], top[:, 0, _LOAD], top[:, 2, _LOAD],
        response[..., :_LOAD], tilt_factor[:, :_LOAD]
    )  # fmt: skip


def _inside(state: Array, r: float) -> Array:
    """Contribution to the Love number k by mass displacements inside the radius `r`."""
    return np.asarray(r**3 * (state[:, 4] - r * state[:, 5] / 5))


def _across(profile: Profile, first: int, y: Array, dmu: Array) -> Array:
    """Integrate the deformation equations through solid layers, up to a liquid or the surface."""
    r = START if first == profile.first else profile.tops[first - 1]
    for i in range(first, len(profile.tops)):
        if not profile.layers[i].vs:
            break
        # From the centre, solutions may be recombined until the next boundary sets conditions on
        # all.
        y = carry(solid(profile, i, dmu), r, profile.tops[i], y, together=first == profile.first)
        r = profile.tops[i]
    return y


def _through_inner_core(profile: Profile, dmu: Array) -> tuple[Array, Array | None, list[Array]]:
    """Integrate the deformation equations through the inner core, from the centre outwards.

    Return (y5, y7) in the liquid, the state at the top of the inner core, and conditions there.
    """
    if not profile.inner_core:
        pair = np.zeros((dmu.size, 2, 3 + 4), dtype=dmu.dtype)
        pair[:, :, 0] = liquid_centre(profile, profile.first)
        return pair, None, []
    y = _across(profile, profile.first, solid_centre(profile, dmu), dmu)
    applied = np.zeros((dmu.size, 6, 2 + 4))
    y = np.concatenate([y, applied], axis=-1)
    r = profile.inner_core
    i = profile.tops.index(r) + 1
    rho, g = profile.density(i, r), profile.gravity(i, r)
    y5, y6 = _stepped(y, r, _ACTS_IN[1] - _ACTS_IN[0])
    # at the liquid: no shear stress, and the normal stress equals the pressure
    conditions = np.stack([y[:, 3], y[:, 1] - rho * (g * y[:, 0] - y5)], axis=1)
    return np.stack([y5, y6 + FOUR_PI_G * y[:, 1] / g], axis=1), y, [conditions]


def _stepped(y: Array, r: float, step: Array) -> tuple[Array, Array]:
    """Potential y5 and gradient y6 after the jump of the applied potential at a boundary.

    The applied potential acts in one region only, so at the boundary of this region, of radius
    `r`, it changes by `step` r2.
    """
    y5, y6 = y[:, 4].copy(), y[:, 5].copy()
    y5[:, -4:] += step * r**2
    y6[:, -4:] += 5 * step * r
    return y5, y6


def _through_liquid(profile: Profile, pair: Array) -> tuple[Array, int]:
    """Potential y5 and gradient y7 at the top of the liquid core, and index of the next layer."""
    r = profile.inner_core or START
    liquids = (n for n, layer in enumerate(profile.layers) if not layer.vs)
    i = max(next(liquids), profile.first)
    while not profile.layers[i].vs:
        pair = carry(liquid(profile, i), r, profile.tops[i], pair)
        r, i = profile.tops[i], i + 1
    return pair, i


def _onto_mantle(profile: Profile, pair: Array) -> Array:
    """Initial solutions at the base of the mantle, from solutions at the top of the liquid core.

    Two columns are unit displacements of the mantle, which are free because the liquid may slip.
    """
    b = profile.core
    i = profile.tops.index(b)
    rho, g = profile.density(i, b), profile.gravity(i, b)
    y = np.zeros((pair.shape[0], 6, pair.shape[2]), dtype=pair.dtype)
    y[:, 0, -6], y[:, 2, -5] = 1, 1
    y[:, 1] = rho * (g * y[:, 0] - pair[:, 0])
    y[:, 4], y[:, 5] = pair[:, 0], pair[:, 1] - FOUR_PI_G * y[:, 1] / g
    y[:, 4], y[:, 5] = _stepped(y, b, _ACTS_IN[2] - _ACTS_IN[1])
    return y
