"""Published compliances, coupling constants and Love numbers of PREM and of the Earth."""

from __future__ import annotations

from earthspin.constants import IERS, UNVERIFIED, Constant

_MBHS = "Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219"
_CODE = "codes of the nutation of PREM in public repositories"

#: By the name in that paper; a_1 to a_3 are the paper's alpha_1 to alpha_3.
PREM_PUBLISHED: dict[str, Constant] = {
    name: Constant(value, "", None, _MBHS, read_in)
    for name, value, read_in in (
        ("kappa", 1.039e-3, _CODE),
        ("xi", 2.222e-4, _CODE),
        ("zeta", 4.964e-9, UNVERIFIED),
        ("gamma", 1.965e-3, _CODE),
        ("beta", 6.16e-4, _CODE),
        ("delta", -4.869e-7, UNVERIFIED),
        ("theta", 6.794e-6, UNVERIFIED),
        ("chi", -7.536e-5, UNVERIFIED),
        ("nu", 7.984e-5, UNVERIFIED),
        ("e", 3.247e-3, UNVERIFIED),
        ("e_f", 2.548e-3, UNVERIFIED),
        ("e_s", 2.422e-3, UNVERIFIED),
        ("a1", 0.9463, UNVERIFIED),
        ("a2", 0.8294, UNVERIFIED),
        ("a3", 0.0537, UNVERIFIED),
        ("fluid", 0.113066, _CODE + ": moments 9.0583e36 (there e37) over 8.0115e37"),
        ("inner", 7.3059e-4, UNVERIFIED),
    )
}

_GROSS = "Gross 2007, Treatise on Geophysics 3.09, table 1"
_TIDES_READ = "codes of the solid tides of the Conventions in public repositories"

#: Love numbers of the Earth: tidal ones with rotation and ellipticity, load ones for PREM.
LOVE_PUBLISHED: dict[str, Constant] = {
    "k2": Constant(0.29525, "", None, IERS + ", table 6.3, elastic, zonal", _TIDES_READ),
    "h2": Constant(0.6078, "", None, IERS + ", tables 7.3a and 7.3b, nominal", _TIDES_READ),
    "l2": Constant(0.0847, "", None, IERS + ", tables 7.3a and 7.3b, nominal", _TIDES_READ),
    "k2_load": Constant(-0.305, "", None, _GROSS, UNVERIFIED),
    "h2_load": Constant(-0.990, "", None, _GROSS, UNVERIFIED),
}

_MHB = "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068"
_MHB_2 = _MHB + ", table 2"

#: The free core nutation, observed through its resonance in the nutations, and used in IAU 2000A.
CORE_NUTATION = Constant(
    -430.21,
    "d",
    0.05,
    _MHB + "; -1.0023181092 turns per sidereal day, 430.2082 d, in their code of IAU 2000A "
    "(MHB_2000)",
    "code MHB_2000 in public repositories: the period; its uncertainty " + UNVERIFIED,
)
#: The same from very long baseline interferometry, 1984 to 2011, with the tides of the solid Earth;
#: 1.00273790935 sidereal days are a mean solar day.
OBSERVED_CORE_NUTATION = Constant(
    -431.18 / 1.00273790935,
    "d",
    0.10 / 1.00273790935,
    "Krasna, Boehm & Schuh 2013, A&A 555, A29: -431.18 +/- 0.10 sidereal days",
    "abstract of the paper, aanda.org/articles/aa/full_html/2013/07/aa21585-13",
)
CORE_NUTATION_QUALITY = Constant(
    20000.0,
    "",
    None,
    _MHB + ", rounded; 20,046 of the 0.000025 in " + IERS + ", table 6.4",
    "codes of the diurnal Love numbers in public repositories: 1.0023181 + 0.000025 i",
)
#: (C_f - A_f)/A_f of the core, without boundary coupling.
DYNAMICAL_CORE_ELLIPTICITY = Constant(2.6456e-3, "", 2e-6, _MHB_2, UNVERIFIED)
#: Coupling constants of the core's boundaries, in phase and out of phase, magnetic according to
#: that paper; all inferred from nutation.
K_CMB = (
    Constant(2.232e-5, "", None, _MHB_2, UNVERIFIED),
    Constant(-1.85e-5, "", 1.4e-6, _MHB_2, UNVERIFIED),
)
K_ICB = (
    Constant(1.11e-3, "", 1e-4, _MHB_2, UNVERIFIED),
    Constant(-7.8e-4, "", 1.3e-4, _MHB_2, UNVERIFIED),
)
