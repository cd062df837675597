"""Effect of an equilibrium ocean on the wobble: published for the Earth, or a global ocean."""

from __future__ import annotations

import math

from earthspin.constants import ARCSEC, Constant, Tabulated
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import elastic

# Products of inertia of the ocean over M a2, per radian of wobble: c = -sqrt(5/3) M a2 C21.
_OCEAN_C21 = (2.1778e-10, 0.01724)  # of -C21 per arcsecond: a (m1 - b m2)
_OCEAN_S21 = (1.7232e-10, 0.03365)  # of -S21 per arcsecond: a (m2 - b m1)
OCEAN_SOURCE = (
    "IERS Conventions (2010), eq. 6.24: self-consistent equilibrium ocean pole tide, "
    "after Desai 2002, JGR 107(C11), 3186"
)
POLE_TIDE = Tabulated(
    "ocean pole tide, four coefficients",
    OCEAN_SOURCE,
    "codes of the equation in public repositories, Orekit among them",
)

#: Density of sea water, as the IERS Conventions (2010), sect. 6.5, use it.
SEA_WATER = Constant(
    1025.0,
    "kg m-3",
    None,
    "IERS Conventions (2010), sect. 6.5",
    "pyTMD 3.0.9, compute.py: ocean pole tide",
)


def ocean_matrix() -> tuple[tuple[float, float], tuple[float, float]]:
    """Products of inertia c13 and c23 of the Earth's ocean per radian of wobble, over M a2.

    The products are divided by M a2.

    Only the symmetric part of the published response is used; the antisymmetric part is due to the
    delay of the mantle's response.
    """
    (a, ab), (d, dc) = _OCEAN_C21, _OCEAN_S21
    unit = math.sqrt(5 / 3) / ARCSEC
    off = -(a * ab + d * dc) / 2
    return (unit * a, unit * off), (unit * off, unit * d)


def global_ocean(layers: LayeredBody, density: float = SEA_WATER.value) -> float:
    """Contribution of an equilibrium ocean that covers the whole body to its Love number k2.

    The sea surface follows the potential of the wobble, of the deformed body, of the water and of
    the loading by the water. This is one equation of degree two, solved in closed form (Munk &
    MacDonald 1960, The Rotation of the Earth, sect. 5.7, self-attraction
    and loading added).
    """
    love = elastic(layers)
    mean_density = layers.mass / (4 / 3 * math.pi * layers.radius**3)
    pull = 3 * density / (5 * mean_density)
    k, h, k_load, h_load = (float(v) for v in (love.k, love.h, love.k_load, love.h_load))
    return (1 + k_load) * pull * (1 + k - h) / (1 - pull * (1 + k_load - h_load))
