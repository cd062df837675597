"""Named interiors: what a body's wobble needs beside its figure, each number with its source.

An interior is either a layered model, from which everything follows by integration, or a
set of published numbers. A body names its interior; one that names none is rigid.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from earthspin.constants import Constant
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import elastic
from earthspin.interior.mars import MARS
from earthspin.interior.ocean import OCEAN_SOURCE, ocean_matrix
from earthspin.interior.prem import PREM

_MHB = "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068"

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
    neglected : mapping of str to Constant
        By how many days the period of the free wobble is off for what the model leaves out.
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
    neglected: Mapping[str, Constant] = field(default_factory=dict, hash=False)

    def values(self) -> tuple[float, float, float | None]:
        """Love number k2, core fraction and hydrostatic (or published) core ellipticity.

        The ellipticity is None where layers give it in proportion to the spin; see
        `equilibrium.hydrostatic_core`.
        """
        if self.layers is not None:
            return float(elastic(self.layers).k), self.layers.core_fraction, None
        assert self.k2 is not None
        assert self.core_fraction is not None
        return self.k2, self.core_fraction, self.core_ellipticity


#: Change of the free wobble by what the ladder leaves out, for the body that PREM is.
_LEFT_OUT_OF_PREM = {
    "rotation and ellipticity in the Love number": Constant(
        -2.7,
        "d",
        None,
        "IERS Conventions (2010), table 6.3, as recalled: k21 = 0.29470 with rotation and "
        "ellipticity, in the place of the sphere's 0.29826",
    ),
    "a solid inner core": Constant(
        -0.03,
        "d",
        None,
        "equations and compliances of Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219, with "
        "an inner core, less those with all of the core fluid",
    ),
}

#: Core radius 1835 (55) km (Le Maistre et al. 2023) and mean density 6000 (300) kg m-3 (Staehler et
#: al. 2021), over A = (0.36367 - J2) M R2.
_MARS_CORE = 8 * math.pi / 15 * 6000.0 * 1835e3**5 / (0.36171 * 6.4171e23 * 3396e3**2)

INTERIORS: dict[str, Interior] = {
    interior.name: interior
    for interior in (
        Interior(
            name="prem",
            reference=f"{PREM.reference}; ocean: {OCEAN_SOURCE}",
            layers=PREM,
            observed_core_ellipticity=CORE_ELLIPTICITY,
            ocean=ocean_matrix(),
            relative_uncertainty={
                # Half the differences between PREM, 1066A and their dressed variants.
                "k2": 0.003,
                "core_fraction": 0.002,
                "core_ellipticity": 0.02,
                # Published Love numbers of the real ocean spread from 0.045 to 0.048.
                "ocean": 0.02,
            },
            neglected=_LEFT_OUT_OF_PREM,
        ),
        Interior(
            name="mars-layers",
            reference=MARS.reference,
            layers=MARS,
            relative_uncertainty={
                # Of the observed k2, and three times that of the core's radius.
                "k2": 0.008 / 0.174,
                "core_fraction": 3 * 55 / 1835,
                "core_ellipticity": 0.1,
            },
        ),
        Interior(
            name="mars-insight",
            reference=(
                "k2 = 0.174 (8): Konopliv et al. 2020, Geophys. Res. Lett. 47, e2020GL090568; "
                "core: radius from Le Maistre et al. 2023, Nature 619, 733, density from Staehler "
                "et al. 2021, Science 373, 443; its ellipticity such that the free core nutation "
                "has the -242 d of Le Maistre et al. 2023"
            ),
            k2=0.174,
            core_fraction=_MARS_CORE,
            core_ellipticity=3.91e-3,
            relative_uncertainty={
                "k2": 0.008 / 0.174,
                # five times that of the radius, and that of the density
                "core_fraction": 0.16,
                "core_ellipticity": 0.1,
            },
        ),
    )
}
