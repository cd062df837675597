"""How a layered body yields to a tide, a load and the pressure of its own core."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import UndefinedError
from earthspin.interior.equations import (
    FOUR_PI_G,
    START,
    Profile,
    carry,
    liquid,
    liquid_centre,
    solid,
    solid_centre,
)
from earthspin.interior.layers import LayeredBody

Array = NDArray[Any]


@dataclass(frozen=True)
class Yielding:
    """How a layered body yields in degree two; arrays have the shape of the given `strain`.

    Attributes
    ----------
    k, h, l : array
        Love numbers of a tide.
    k_load, h_load : array
        Load Love numbers.
    core_k : array
        As k, but of the masses of the core alone, at the core's radius.
    k_pressure, core_k_pressure : array
        As `k` and `core_k`, for a potential that acts on the matter of the core alone and
        is 1 when continued to the surface: the pressure of a core that turns about
        another axis than the mantle.
    """

    k: Array
    h: Array
    l: Array  # noqa: E741  (the field's own name)
    k_load: Array
    h_load: Array
    core_k: Array
    k_pressure: Array
    core_k_pressure: Array


def yielding(body: LayeredBody, strain: Any = 0.0) -> Yielding:
    """Love numbers of degree two, of tide, load and core pressure.

    Parameters
    ----------
    body : LayeredBody
    strain : complex or array
        Relative change of the shear modulus at quality factor 1; a layer's modulus is
        multiplied by 1 + strain/shear_q. 0 is the elastic body as seismology has it.

    Raises
    ------
    UndefinedError
        If the surface is liquid or there is no liquid core.
    """
    if not body.layers[-1].vs or all(layer.vs for layer in body.layers):
        raise UndefinedError(
            f"interior '{body.name}': Love numbers need a liquid core and a solid surface"
        )
    strain = np.asarray(strain)
    flat = np.atleast_1d(strain).ravel()
    profile = Profile(body)
    columns = _through_mantle(profile, flat, _through_core(profile, flat))
    found = _at_surface(profile, columns)
    return Yielding(*(value.reshape(strain.shape) for value in found))


@lru_cache(maxsize=8)
def elastic(layers: LayeredBody) -> Yielding:
    """Love numbers of the elastic body."""
    return yielding(layers)


#: Strains between which the Love numbers are interpolated, and how many are integrated.
_STRAIN_RANGE = (-40.0, 2.0)
_STRAIN_NODES = 10


@lru_cache(maxsize=8)
def softening(layers: LayeredBody) -> tuple[np.polynomial.Chebyshev, ...]:
    """`k`, `core_k`, `k_pressure`, `core_k_pressure` over their elastic values, by strain.

    Polynomials in the strain of `yielding`, good for complex strains too: Love numbers
    are analytic in the modulus. Within 1e-8 of the integration.
    """
    grid = np.polynomial.chebyshev.chebpts1(_STRAIN_NODES)
    low, high = _STRAIN_RANGE
    strain = (low + high) / 2 + (high - low) / 2 * grid
    found, reference = yielding(layers, strain), elastic(layers)
    names = ("k", "core_k", "k_pressure", "core_k_pressure")
    return tuple(
        np.polynomial.Chebyshev.fit(
            strain,
            getattr(found, name) / float(getattr(reference, name)),
            _STRAIN_NODES - 1,
            domain=list(_STRAIN_RANGE),
        )
        for name in names
    )


# --- from the centre to the surface -------------------------------------------------------------


def _through_core(profile: Profile, strain: Array) -> Array:
    """The regular solution (y5, y7) at the top of the liquid core, shape (strain, 2)."""
    pair = np.broadcast_to(liquid_centre(profile), (strain.size, 2)).astype(strain.dtype)
    i, r = 0, START
    if profile.layers[0].vs:
        y = solid_centre(profile, strain)
        while profile.layers[i].vs:
            y = carry(solid(profile, i, strain), r, profile.tops[i], y)
            r, i = profile.tops[i], i + 1
        # No shear at the liquid, and the liquid's pressure: two conditions on three columns.
        rho, g = profile.density(i, r), profile.gravity(i, r)
        tangential, normal = y[:, 3], y[:, 1] - rho * (g * y[:, 0] - y[:, 4])
        mix = np.cross(tangential, normal)
        y2, y5, y6 = (np.sum(y[:, row] * mix, axis=1) for row in (1, 4, 5))
        pair[:, 0], pair[:, 1] = y5, y6 + FOUR_PI_G * y2 / g
    pair = pair / abs(pair[:, :1])
    while not profile.layers[i].vs:
        pair = carry(liquid(profile, i), r, profile.tops[i], pair[..., None])[..., 0]
        r, i = profile.tops[i], i + 1
    return pair


def _through_mantle(profile: Profile, strain: Array, pair: Array) -> Array:
    """Columns at the core's top and at the surface, shape (2, strain, 6, 4).

    The columns: one of the core's own potential, the two displacements of its boundary,
    which the liquid leaves free, and the pressure of a potential r2 in the core alone.
    """
    b = profile.core
    i = next(n for n, top in enumerate(profile.tops) if top > b)
    rho, g = profile.density(i - 1, b), profile.gravity(i - 1, b)
    y = np.zeros((strain.size, 6, 4), dtype=strain.dtype)
    y[:, 1, 0], y[:, 4, 0] = -rho * pair[:, 0], pair[:, 0]
    y[:, 5, 0] = pair[:, 1] + FOUR_PI_G * rho * pair[:, 0] / g
    y[:, 0, 1], y[:, 1, 1], y[:, 5, 1] = 1, rho * g, -FOUR_PI_G * rho
    y[:, 2, 2] = 1
    # The pair carries the potential that the liquid feels; gravity has r2 less.
    y[:, 4, 3], y[:, 5, 3] = -(b**2), -5 * b
    bottom, r = y, b
    for n in range(i, len(profile.tops)):
        y = carry(solid(profile, n, strain), r, profile.tops[n], y)
        r = profile.tops[n]
    return np.stack([bottom, y])


def _at_surface(profile: Profile, columns: Array) -> tuple[Array, ...]:
    """Meet the three conditions at the surface for tide, load and core pressure."""
    bottom, top = columns
    conditions = top[:, [1, 3, 5], :3]
    pressure = -top[:, [1, 3, 5], 3]
    given = np.stack(
        [
            np.broadcast_to([0.0, 0.0, 5.0], pressure.shape),  # a tide of potential 1
            np.broadcast_to([-5 / 3, 0.0, 5.0], pressure.shape),  # the weight of a load
            pressure,
        ],
        axis=-1,
    )
    mix = np.linalg.solve(conditions, given)
    surface = top[..., :3] @ mix
    surface[..., 2] += top[..., 3]
    core = bottom[..., :3] @ mix
    core[..., 2] += bottom[..., 3]
    k, h = surface[:, 4], surface[:, 0]
    # What the masses inside b add to the potential there, b3 (y5 - b y6/5), as a k.
    b = profile.core
    inside = b**3 * (core[:, 4] - b * core[:, 5] / 5)
    return (
        k[:, 0] - 1,
        h[:, 0],
        surface[:, 2, 0],
        k[:, 1] - 1,
        h[:, 1],
        inside[:, 0],
        k[:, 2],
        inside[:, 2],
    )
