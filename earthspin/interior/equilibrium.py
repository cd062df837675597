"""Hydrostatic figure of a layered body, to first order in the flattening (Clairaut 1743)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from earthspin.constants import COMPUTED, Constant, G
from earthspin.errors import UndefinedError
from earthspin.interior.layers import LayeredBody, tidal_inertia
from earthspin.interior.love import FOUR_PI_G, START, Profile, liquid, liquid_centre
from earthspin.numerics.arrays import Array, Numeric
from earthspin.numerics.polynomials import carry

_CHANDRASEKHAR = "Chandrasekhar 1969, Ellipsoidal Figures of Equilibrium, sect. 32"
_CHANDRASEKHAR_READ = f"{COMPUTED}: the maximum of the formula of the Maclaurin spheroid"
#: Largest Omega2/(pi G rho) at which a homogeneous liquid body, a Maclaurin spheroid, has an
#: equilibrium.
FASTEST = Constant(0.449331, "", None, _CHANDRASEKHAR, _CHANDRASEKHAR_READ)


@dataclass(frozen=True)
class Equilibrium:
    """Degree-two response that a layered body would have if all layers were liquid.

    Attributes
    ----------
    k : float
        Love number of the whole liquid body.
    core_k : float
        Contribution of the core's masses to the Love number, as `DegreeTwoLoveNumbers.core_k`.
    tops : ndarray, shape (n,)
        Outer radii of the layers, divided by R.
    potential : ndarray, shape (n,)
        Sum, at these radii, of the deforming potential r2 and that of all masses.
    enclosed : ndarray, shape (n,)
        Love number of the masses inside each radius, which is to first order in proportion to their
        C - A.
    outside : ndarray, shape (n,)
        Coefficient of r2 in the potential: 1 for the deforming potential, plus that of the masses
        outside each radius.
    """

    k: float
    core_k: float
    tops: Array
    potential: Array
    enclosed: Array
    outside: Array


@lru_cache(maxsize=32)
def equilibrium(body: LayeredBody) -> Equilibrium:
    """Compute the degree-two response that a layered body would have if all layers were liquid.

    The equations are those of a static liquid, equivalent to Clairaut's equation.
    """
    profile = Profile(body)
    solutions = [
        liquid_centre(profile, i, top) for i, top in enumerate(profile.tops[: profile.first])
    ]
    pair, r = liquid_centre(profile, profile.first)[:, np.newaxis], START
    for i in range(profile.first, len(profile.tops)):
        pair = carry(liquid(profile, i), r, profile.tops[i], pair)
        solutions.append(pair[:, 0])
        r = profile.tops[i]
    # boundary condition at a free liquid surface under an external potential of degree two
    y5, y7 = (5 / pair[1, 0] * np.array(solutions)).T
    tops = np.array(profile.tops)
    enclosed = tops**3 * (y5 - tops * y7 / 5)
    core_index = profile.tops.index(profile.core) if profile.core else None
    return Equilibrium(
        k=float(y5[-1] - 1),
        core_k=0.0 if core_index is None else float(enclosed[core_index]),
        tops=tops,
        potential=y5,
        enclosed=enclosed,
        outside=y7 / (5 * tops),
    )


def hydrostatic_core(layers: LayeredBody, spin_rate: Numeric) -> Numeric:
    """Dynamical ellipticity (C_f - A_f)/A_f of a core in hydrostatic equilibrium, to first order.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.
    """
    return tidal_inertia(layers, spin_rate) * equilibrium(layers).core_k / layers.core_fraction


@dataclass(frozen=True)
class Regions:
    """Ellipticities and moments of whole body, fluid core and inner core, and coupling numbers.

    Attributes
    ----------
    e, e_f, e_s : float
        (C - A)/A of the whole body, the fluid core and the inner core; 0 for an absent region.
    fluid, inner : float
        Relative equatorial moments A_f/A and A_s/A; 0 for an absent region.
    a1, a2, a3 : float
        Coupling numbers of the inner core (Mathews, Buffett, Herring & Shapiro 1991, JGR 96,
        8219): the fraction of its C - A that fluid in the same volume would have; the torque on it
        by all other regions, pressure included; and the excess, 1 - a1.
    """

    e: Numeric
    e_f: Numeric
    e_s: Numeric
    fluid: Numeric
    inner: Numeric
    a1: Numeric
    a2: Numeric
    a3: Numeric


@dataclass(frozen=True)
class HydrostaticFigure(Regions):
    """Hydrostatic figure: `Regions`, whole-core ellipticity, Omega2 R5/(3 G A), surface flattening.

    The other eight fields are those of `Regions`.

    Attributes
    ----------
    e_core : float
        (C - A)/A of the fluid core and inner core together.
    tidal_inertia : float
        Omega2 R5/(3 G A): product of inertia over A per radian and unit of the Love number k.
    surface : float
        Flattening of the surface.
    """

    e_core: float
    tidal_inertia: float
    surface: float


@lru_cache(maxsize=32)
def figure(layers: LayeredBody, spin_rate: float) -> HydrostaticFigure:
    """Compute the hydrostatic figure of a rotating layered body from Clairaut's equation.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.

    Raises
    ------
    UndefinedError
        If a homogeneous body of the same mean density has no equilibrium at this spin.

    Notes
    -----
    The ellipticity of an equipotential surface is W'/(2 g r), where W' is the potential of degree
    two; the moments A follow from the mean moments, I = A (1 + e/3).
    """
    mean_density = layers.mass / (4 / 3 * np.pi * layers.radius**3)
    fastest = np.sqrt(FASTEST.value * np.pi * G.value * mean_density)
    if abs(spin_rate) > fastest:
        raise UndefinedError(
            f"a body with the mean density of {layers.name}, {mean_density:.0f} kg/m3, has no "
            f"equilibrium at a spin period of {2 * np.pi / abs(spin_rate) / 3600:.3g} h; give more "
            f"than {2 * np.pi / fastest / 3600:.3g} h"
        )
    if not spin_rate**2 * layers.radius**3 / (G.value * layers.mass) > np.finfo(float).tiny:
        raise UndefinedError("the body spins too slowly to be flattened; give it a shorter period")
    liquid_response = equilibrium(layers)
    scale = tidal_inertia(layers, spin_rate)  # over the mean moment
    whole = float(scale * liquid_response.enclosed[-1])
    core = float(scale * liquid_response.core_k)
    moment = layers.moment_of_inertia()
    moment_difference, mean_moment = {"core": core, "inner": 0.0}, {"core": 0.0, "inner": 0.0}
    if layers.core_radius:
        mean_moment["core"] = layers.core_fraction
    a1 = a2 = a3 = 0.0
    gravity = G.value * layers.mass / layers.radius**2
    centrifugal = spin_rate**2 * layers.radius / gravity
    if layers.inner_core_radius:
        profile = Profile(layers)
        r = profile.inner_core
        i = profile.tops.index(r)
        moment_difference["inner"] = float(scale * liquid_response.enclosed[i])
        mean_moment["inner"] = layers.moment_of_inertia(layers.inner_core_radius) / moment
        ellipticity = centrifugal * liquid_response.potential[i] / (2 * profile.gravity(i, r) * r)
        density = float(profile.density(i + 1, r))
        # C - A of a homogeneous fluid spheroid, (8 pi/15) rho eps r5, in units of (3/5) (C -
        # A)/tidal_inertia.
        liquid_excess = 8 * np.pi / 15 * density * profile.density_unit * ellipticity
        liquid_excess *= layers.inner_core_radius**5 / moment
        a1 = float(liquid_excess / moment_difference["inner"])
        a3 = 1 - a1
        # 8 pi G rho eps/(5 Omega2), for the fluid displaced by the inner core
        displaced = 2 * FOUR_PI_G / 5 * density * ellipticity / centrifugal
        a2 = float(a1 - a3 * (liquid_response.outside[i] - 1 + displaced))
    e = _over_equatorial(whole, 1.0)
    e_s = _over_equatorial(moment_difference["inner"], mean_moment["inner"])
    fluid_share = mean_moment["core"] - mean_moment["inner"]
    e_f = _over_equatorial(moment_difference["core"] - moment_difference["inner"], fluid_share)
    equatorial = 1 / (1 + e / 3)  # A over the mean moment
    return HydrostaticFigure(
        e=e,
        e_f=e_f,
        e_s=e_s,
        e_core=_over_equatorial(core, mean_moment["core"]),
        fluid=fluid_share / (1 + e_f / 3) / equatorial,
        inner=mean_moment["inner"] / (1 + e_s / 3) / equatorial,
        a1=a1,
        a2=a2,
        a3=a3,
        tidal_inertia=float(scale / equatorial),
        surface=float(centrifugal * liquid_response.potential[-1] / 2),
    )


def _over_equatorial(difference: float, mean: float) -> float:
    """Ratio (C - A)/A from the difference C - A and the mean moment of inertia (2 A + C)/3."""
    return difference / (mean - difference / 3) if mean else 0.0
