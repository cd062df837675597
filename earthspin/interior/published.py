"""Published free core nutation, ellipticity of the core, and coupling at its boundaries."""

from __future__ import annotations

from earthspin.constants import IERS, UNVERIFIED, Constant

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
