"""Published free core nutation, and coupling at the boundaries of the core."""

from __future__ import annotations

from earthspin.constants import IERS, Constant

_MHB = "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068"
_MHB_2 = _MHB + ", table 2"
_LATER = "Koot et al. 2010, Geophys. J. Int. 182, 1279"
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
#: Coupling constants of the core's boundaries, magnetic according to that paper; all inferred from
#: nutation. Of that to the mantle this is the out-of-phase part: the part in phase acts as an
#: additional ellipticity of the core, which is adjusted to the period of the free core nutation.
K_CMB_OUT_OF_PHASE = Constant(
    -1.85e-5, "", 1.4e-6, _MHB_2, f"-1.78e-5 +- 0.02e-5 {_LATER_READ}, within the uncertainty"
)
#: In phase and out of phase. The uncertainty of the latter is the difference from the later value.
K_ICB = (
    Constant(1.11e-3, "", 1.0e-4, _MHB_2, f"1.01e-3 +- 0.02e-3 {_LATER_READ}"),
    Constant(
        -7.8e-4,
        "",
        3.1e-4,
        f"{_MHB_2}; uncertainty: difference from {_LATER}",
        f"-1.09e-3 +- 0.03e-3 {_LATER_READ}",
    ),
)
