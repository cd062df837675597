"""Named interiors: Love number, core and ocean of a body; published core nutation and coupling."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from earthspin import constants as c
from earthspin.constants import Constant, G
from earthspin.interior.layers import PREM, LayeredBody
from earthspin.interior.love import elastic
from earthspin.interior.mars import CORE_RADIUS, MARS
from earthspin.interior.ocean_and_anelasticity import OCEAN_SOURCE, ocean_matrix

# --- interiors by name ----------------------------------------------------------------------------
# An interior is either a layered model, from which all numbers follow by integration, or a set of
# published numbers. A body without an interior is rigid.

_MHB = "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068"
_MHB_2 = _MHB + ", table 2"
_MHB_2000 = "from the period in the code MHB_2000"
#: (C_f - A_f)/A_f inferred from the observed free core nutation: the core's own ellipticity plus
#: the coupling at its boundary, which acts like an additional ellipticity. The equations of `modes`
#: need 2.6672e-3 with the coupling to the inner core, and 2.6684e-3 without.
CORE_ELLIPTICITY = Constant(
    2.66792e-3, "", 2e-6, f"{_MHB_2} (Re K_CMB added)", f"{c.COMPUTED} {_MHB_2000}: 2.6672e-3"
)

_SMITH_DAHLEN = (
    "Smith & Dahlen 1981, Geophys. J. R. astr. Soc. 64, 223: 0.04 to 0.19, chosen there such that "
    "period and decay of the observed wobble are met"
)
#: Exponent of the frequency dependence of the mantle's quality factor.
ANELASTIC_EXPONENT = Constant(0.09, "", 0.04, _SMITH_DAHLEN, c.UNVERIFIED)
#: Range of the exponent that published work allows (Smith & Dahlen 1981).
EXPONENT_RANGE = (0.04, 0.19)


@dataclass(frozen=True)
class Interior:
    """Interior of a body: layers or published Love number and core moment, and an ocean.

    Attributes
    ----------
    name : str
    reference : str
    layers : LayeredBody or None
        Layered model, from which the Love number and the core's moment follow; None if there is
        none.
    k2, core_fraction, core_ellipticity : float or None
        Published values, for an interior without layers: the potential Love number, the moment of
        the core divided by that of the body, and (C_f - A_f)/A_f.
    observed_core_ellipticity : Constant or None
        Ellipticity inferred from observation if it differs from hydrostatic equilibrium.
    ocean : 2 x 2 tuple or None
        Products of inertia (c13, c23)/(M a2) per radian of wobble (m1, m2).
    relative_uncertainty : mapping
        Standard deviation divided by value, by name of the input of the wobble and
        nutation ladders.
    neglected : mapping of str to Constant
        Change of the free wobble's period, in days, by each effect that the model does not include.
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
        """Love number k2, core moment over body moment of inertia, and core ellipticity or None.

        The ellipticity is None if it follows from layers and the spin; see
        `equilibrium.hydrostatic_core`.
        """
        if self.layers is not None:
            return float(elastic(self.layers).k), self.layers.core_fraction, None
        assert self.k2 is not None
        assert self.core_fraction is not None
        return self.k2, self.core_fraction, self.core_ellipticity


def with_layers(layers: LayeredBody, base: Interior | None = None) -> Interior:
    """Make an interior from layers; take ocean and uncertainties from a known interior, if any.

    Parameters
    ----------
    layers : LayeredBody
    base : Interior, optional
        Another interior of the same body. Its ocean, observed core ellipticity and uncertainties
        are kept. Its Love number and core numbers are replaced by those of the layers, and its
        neglected effects are dropped, as their sizes are unknown for these layers.
    """
    if base is None:
        return Interior(layers.name, layers.reference, layers)
    return replace(
        base,
        name=layers.name,
        reference=layers.reference,
        layers=layers,
        k2=None,
        core_fraction=None,
        core_ellipticity=None,
        neglected={},
    )


_K21 = (
    "IERS Conventions (2010), table 6.3: k21 = 0.29470, elastic, with rotation and ellipticity, "
    "in the place of the sphere's 0.29826"
)
_K21_READ = f"{c.COMPUTED}; k21: codes of table 6.3 in public repositories"
_WITH_INNER_CORE = (
    "equations of Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219, with an inner core, less "
    "those with all of the core fluid; compliances of PREM"
)
#: Changes of the free wobble's period by effects that the ladder does not include, for PREM.
_LEFT_OUT_OF_PREM = {
    "rotation and ellipticity in the Love number": Constant(-2.7, "d", None, _K21, _K21_READ),
    "a solid inner core": Constant(-0.03, "d", None, _WITH_INNER_CORE, c.COMPUTED),
}

_STAEHLER = "Staehler et al. 2021, Science 373, 443"
_STAEHLER_READ = "abstract, doi.org/10.1126/science.abi7730: 5.7 to 6.3 g/cm3"
#: Mean density of the core of Mars.
MARS_CORE_DENSITY = Constant(6000.0, "kg m-3", 300.0, _STAEHLER, _STAEHLER_READ)
_MARS_EQUATORIAL = (c.MARS_POLAR_MOMENT.value - c.MARS_J2.value) * c.MARS_GM.value / G.value
_MARS_EQUATORIAL *= c.MARS_RADIUS.value**2
#: Moment of a homogeneous core, divided by A = (C/(M R2) - J2) M R2.
_MARS_CORE = 8 * math.pi / 15 * MARS_CORE_DENSITY.value * CORE_RADIUS.value**5 / _MARS_EQUATORIAL
#: Observed Love number of Mars. The paper has an uncertainty of 0.008; this one contains the two
#: earlier results.
MARS_K2 = Constant(
    0.174,
    "",
    0.010,
    "Konopliv et al. 2020, Geophys. Res. Lett. 47, e2020GL090568; uncertainty from Konopliv et al. "
    "2011, Icarus 211, 401",
    "abstracts of Konopliv et al. 2011, 0.164 +- 0.009, and of Genova et al. 2016, Icarus 272, "
    "228, 0.1697 +- 0.0027; the digits of 2020 were not seen",
)

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
                # No error of the diurnal response was published; the three waves of FES2004 differ
                # from their mean by so much.
                "diurnal_ocean": 0.13,
                # The density jump at the boundary of the inner core is 0.6 +- 0.1 g/cm3: 0.41 in
                # Smylie 1992, Science 255, 1678; 0.5 to 0.6 in Masters & Shearer 1990, JGR
                # 95, 21691 (abstracts). The excess density has a jump of 0.6 and a rise of 0.09.
                "inner_core_excess": 0.15,
                "inner_core_fraction": 0.02,
                # The boundary of the inner core is taken to be as near to equilibrium as that of
                # the outer core.
                "inner_core_ellipticity": 0.02,
            },
            neglected=_LEFT_OUT_OF_PREM,
        ),
        Interior(
            name="mars-layers",
            reference=MARS.reference,
            layers=MARS,
            relative_uncertainty={
                # From the observed k2, and three times that of the core's radius.
                "k2": MARS_K2.relative_uncertainty,
                "core_fraction": 3 * CORE_RADIUS.relative_uncertainty,
                "core_ellipticity": 0.1,
            },
        ),
        Interior(
            name="mars-insight",
            reference=(
                f"k2: {MARS_K2.source}; core: radius from {CORE_RADIUS.source}, density from "
                f"{MARS_CORE_DENSITY.source}; its ellipticity such that the free core nutation "
                "has the -242 d of Le Maistre et al. 2023"
            ),
            k2=MARS_K2.value,
            core_fraction=_MARS_CORE,
            core_ellipticity=3.91e-3,
            relative_uncertainty={
                "k2": MARS_K2.relative_uncertainty,
                # five times that of the radius, and that of the density
                "core_fraction": 0.16,
                "core_ellipticity": 0.1,
            },
        ),
    )
}


# --- published free core nutation and coupling ----------------------------------------------------

_LATER = "Koot et al. 2010, Geophys. J. Int. 182, 1279"
_MHB_OR_LATER = f"{_MHB_2}; uncertainty: difference from {_LATER}"
_LATER_READ = f"in the abstract of {_LATER} (insu.hal.science/insu-03605291)"

#: The free core nutation, observed through its resonance in the nutations, and used in IAU 2000A.
#: The uncertainty is the rms difference of three later results: 431.18, 431.46 and 431.33 sidereal
#: days.
CORE_NUTATION = Constant(
    -430.21,
    "d",
    0.13,
    _MHB + "; -1.0023181092 turns per sidereal day, 430.2082 d, in their code of IAU 2000A "
    "(MHB_2000); uncertainty from later results",
    "code MHB_2000 in public repositories; later results: table 1 of Sci. Rep. 10 (2020), "
    "s41598-020-66426-7",
)
_KRASNA = "Krasna, Boehm & Schuh 2013, A&A 555, A29: -431.18 +/- 0.10 sidereal days"
_KRASNA_READ = "abstract of the paper, aanda.org/articles/aa/full_html/2013/07/aa21585-13"
#: The same from very long baseline interferometry, 1984 to 2011, with the tides of the solid Earth;
#: 1.00273790935 sidereal days are a mean solar day.
OBSERVED_CORE_NUTATION = Constant(
    -431.18 / 1.00273790935, "d", 0.10 / 1.00273790935, _KRASNA, _KRASNA_READ
)
#: Coupling constants of the core's boundaries, magnetic according to that paper; all inferred from
#: nutation. Of that to the mantle this is the out-of-phase part: the part in phase acts as an
#: additional ellipticity of the core, which is adjusted to the period of the free core nutation.
K_CMB_OUT_OF_PHASE = Constant(
    -1.85e-5, "", 1.4e-6, _MHB_2, f"-1.78e-5 +- 0.02e-5 {_LATER_READ}, within the uncertainty"
)
#: In phase and out of phase. The uncertainty of the latter is the difference from the later value.
K_ICB = (
    Constant(1.11e-3, "", 1.0e-4, _MHB_2, f"1.01e-3 +- 0.02e-3 {_LATER_READ}"),
    Constant(-7.8e-4, "", 3.1e-4, _MHB_OR_LATER, f"-1.09e-3 +- 0.03e-3 {_LATER_READ}"),
)
