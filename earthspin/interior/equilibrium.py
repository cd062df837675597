"""The figure of a layered body in hydrostatic equilibrium, to first order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from earthspin.interior.equations import START, Profile, carry, liquid, liquid_centre
from earthspin.interior.layers import LayeredBody, tidal_inertia

Numeric = Any


@dataclass(frozen=True)
class Equilibrium:
    """How a body of the same densities would be shaped if it were liquid throughout.

    Attributes
    ----------
    k : float
        Love number of the liquid body.
    core_k : float
        Of the masses of its core, as `Yielding.core_k`.
    """

    k: float
    core_k: float


@lru_cache(maxsize=8)
def equilibrium(body: LayeredBody) -> Equilibrium:
    """Clairaut's hydrostatic figure to first order, by the equations of a liquid."""
    profile = Profile(body)
    pair = liquid_centre(profile)[:, None]
    r, at_core = START, pair
    for i, top in enumerate(profile.tops):
        pair = carry(liquid(profile, i), r, top, pair)
        r = top
        if top == profile.core:
            at_core = pair
    # The equation of a free liquid surface: the potential of degree two comes from outside.
    scale = 5 / pair[1, 0]
    b = profile.core
    y5, y7 = scale * at_core[:, 0]
    return Equilibrium(k=float(scale * pair[0, 0] - 1), core_k=float(b**3 * (y5 - b * y7 / 5)))


def hydrostatic_core(layers: LayeredBody, spin_rate: Numeric) -> Numeric:
    """(C_f - A_f)/A_f of a core in hydrostatic equilibrium, to first order.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.
    """
    return tidal_inertia(layers, spin_rate) * equilibrium(layers).core_k / layers.core_fraction
