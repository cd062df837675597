"""Named interiors: what a body's wobble needs beside its figure, each number with its source.

An interior is either a layered model, from which everything follows by integration, or a
set of published numbers. A body names its interior; one that names none is rigid.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from earthspin.constants import ARCSEC, Constant, G
from earthspin.wobble.interior import (
    PREM,
    LayeredBody,
    Yielding,
    equilibrium,
    yielding,
)

Numeric = Any

_MHB = "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068"

# Products of inertia of the ocean over M a2, per radian of wobble: c = -sqrt(5/3) M a2 C21.
_OCEAN_C21 = (2.1778e-10, 0.01724)  # of -C21 per arcsecond: a (m1 - b m2)
_OCEAN_S21 = (1.7232e-10, 0.03365)  # of -S21 per arcsecond: a (m2 - b m1)
OCEAN_SOURCE = (
    "IERS Conventions (2010), eq. 6.24: self-consistent equilibrium ocean pole tide, "
    "after Desai 2002, JGR 107(C11), 3186"
)

#: Density of sea water, as the IERS Conventions (2010), sect. 6.5, use it.
SEA_WATER = Constant(1025.0, "kg m-3", None, "IERS Conventions (2010), sect. 6.5")

#: (C_f - A_f)/A_f that the observed free core nutation asks for: their e_f = 2.6456e-3, and
#: the coupling at the core's boundary, 2.2e-5, which acts like a larger ellipticity.
CORE_ELLIPTICITY = Constant(2.6456e-3 + 2.232e-5, "", 2e-6, _MHB + ", table 2 (Re K_CMB added)")

#: Exponent of frequency in the mantle's quality factor.
ANELASTIC_EXPONENT = Constant(
    0.09,
    "",
    0.04,
    "Smith & Dahlen 1981, Geophys. J. R. astr. Soc. 64, 223: 0.04 to 0.19, chosen there such "
    "that period and decay of the observed wobble are met",
)


def _ocean_matrix() -> tuple[tuple[float, float], tuple[float, float]]:
    """The symmetric part of the published response: the other is the mantle's delay."""
    (a, ab), (d, dc) = _OCEAN_C21, _OCEAN_S21
    unit = math.sqrt(5 / 3) / ARCSEC
    off = -(a * ab + d * dc) / 2
    return (unit * a, unit * off), (unit * off, unit * d)


@dataclass(frozen=True)
class Interior:
    """What lies under the surface.

    Attributes
    ----------
    name : str
    reference : str
    layers : LayeredBody or None
        Where there is one, the Love number and the core's moment follow from it.
    k2, core_fraction, core_ellipticity : float or None
        Published, where there are no layers: the potential Love number, the moment of the
        core over that of the body, and (C_f - A_f)/A_f.
    observed_core_ellipticity : Constant or None
        Where observation asks for another one than hydrostatic equilibrium.
    ocean : 2 x 2 tuple or None
        Products of inertia (c13, c23)/(M a2) per radian of wobble (m1, m2).
    relative_uncertainty : mapping
        One standard deviation over value, by name of the input (`Inputs` of the ladder).
    """

    name: str
    reference: str
    layers: LayeredBody | None = None
    k2: float | None = None
    core_fraction: float | None = None
    core_ellipticity: float | None = None
    observed_core_ellipticity: Constant | None = None
    ocean: tuple[tuple[float, float], tuple[float, float]] | None = None
    relative_uncertainty: Mapping[str, float] = field(default_factory=dict, hash=False)

    def values(self) -> tuple[float, float, float | None]:
        """Love number k2, core fraction and hydrostatic (or published) core ellipticity.

        The ellipticity is None where layers give it in proportion to the spin; see
        `hydrostatic_core`.
        """
        if self.layers is not None:
            return float(elastic(self.layers).k), self.layers.core_fraction, None
        assert self.k2 is not None
        assert self.core_fraction is not None
        return self.k2, self.core_fraction, self.core_ellipticity


@lru_cache(maxsize=8)
def elastic(layers: LayeredBody) -> Yielding:
    """Love numbers of the elastic body."""
    return yielding(layers)


def hydrostatic_core(layers: LayeredBody, spin_rate: Numeric) -> Numeric:
    """(C_f - A_f)/A_f of a core in hydrostatic equilibrium, to first order.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.
    """
    return tidal_inertia(layers, spin_rate) * equilibrium(layers).core_k / layers.core_fraction


def tidal_inertia(layers: LayeredBody, spin_rate: Numeric) -> Numeric:
    """Omega2 R5/(3 G A): products of inertia over A per radian of wobble and unit of k2."""
    moment = layers.moment_of_inertia()
    return spin_rate**2 * layers.radius**5 / (3 * G.value * moment)


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


def global_ocean(layers: LayeredBody, density: float = SEA_WATER.value) -> float:
    """Love number that an ocean in equilibrium all over the body adds to k2.

    The sea surface follows the potential of the wobble, of the yielding body, of the
    water and of what the water presses in: one equation of degree two, solved in closed
    form (Munk & MacDonald 1960, The Rotation of the Earth, sect. 5.7, self-attraction
    and loading added).
    """
    love = elastic(layers)
    mean_density = layers.mass / (4 / 3 * math.pi * layers.radius**3)
    pull = 3 * density / (5 * mean_density)
    k, h, k_load, h_load = (float(v) for v in (love.k, love.h, love.k_load, love.h_load))
    return (1 + k_load) * pull * (1 + k - h) / (1 - pull * (1 + k_load - h_load))


#: Core radius 1830 (40) km and mean density 6000 (300) kg m-3 (Staehler et al. 2021), over
#: A = 0.3634 M R2 (Konopliv et al. 2011).
_MARS_CORE = 8 * math.pi / 15 * 6000.0 * 1830e3**5 / (0.3634 * 6.4171e23 * 3396e3**2)

INTERIORS: dict[str, Interior] = {
    interior.name: interior
    for interior in (
        Interior(
            name="prem",
            reference=f"{PREM.reference}; ocean: {OCEAN_SOURCE}",
            layers=PREM,
            observed_core_ellipticity=CORE_ELLIPTICITY,
            ocean=_ocean_matrix(),
            relative_uncertainty={
                # Half the differences between PREM, 1066A and their dressed variants.
                "k2": 0.003,
                "core_fraction": 0.002,
                "core_ellipticity": 0.02,
                # Published Love numbers of the real ocean spread from 0.045 to 0.048.
                "ocean": 0.02,
            },
        ),
        Interior(
            name="mars-insight",
            reference=(
                "k2 = 0.174 (8): Konopliv et al. 2020, Geophys. Res. Lett. 47, e2020GL090568; "
                "core: Staehler et al. 2021, Science 373, 443; its ellipticity such that the "
                "free core nutation has the -242 d of Le Maistre et al. 2023, Nature 619, 733"
            ),
            k2=0.174,
            core_fraction=_MARS_CORE,
            core_ellipticity=3.91e-3,
            relative_uncertainty={
                "k2": 0.008 / 0.174,
                "core_fraction": 0.12,
                "core_ellipticity": 0.1,
            },
        ),
    )
}
