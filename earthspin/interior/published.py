"""Compliances, coupling and Love numbers as published: of PREM, of the Earth, from nutations."""

from __future__ import annotations

from earthspin.constants import IERS, Constant

_MBHS = "Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219"
_COPIED = ", as copied in public code"
_READ, _RECALLED = _MBHS + _COPIED, _MBHS + ", as recalled"

#: By the name in that paper; a_1 to a_3 are its alphas.
PREM_PUBLISHED: dict[str, Constant] = {
    name: Constant(value, "", None, source)
    for name, value, source in (
        ("kappa", 1.039e-3, _READ),
        ("xi", 2.222e-4, _READ),
        ("zeta", 4.964e-9, _RECALLED),
        ("gamma", 1.965e-3, _READ),
        ("beta", 6.16e-4, _READ),
        ("delta", -4.869e-7, _RECALLED),
        ("theta", 6.794e-6, _RECALLED),
        ("chi", -7.536e-5, _RECALLED),
        ("nu", 7.984e-5, _RECALLED),
        ("e", 3.247e-3, _RECALLED),
        ("e_f", 2.548e-3, _RECALLED),
        ("e_s", 2.422e-3, _RECALLED),
        ("a1", 0.9463, _RECALLED),
        ("a2", 0.8294, _RECALLED),
        ("a3", 0.0537, _RECALLED),
        ("fluid", 0.113066, _READ + ": moments 9.0583e36 (there e37) over 8.0115e37"),
        ("inner", 7.3059e-4, _RECALLED),
    )
}

_GROSS = "Gross 2007, Treatise on Geophysics 3.09, table 1, as recalled"

#: Love numbers of the Earth: of a tide with rotation and ellipticity, of a load for PREM.
LOVE_PUBLISHED: dict[str, Constant] = {
    "k2": Constant(0.29525, "", None, IERS + ", table 6.3, elastic, zonal" + _COPIED),
    "h2": Constant(0.6078, "", None, IERS + ", tables 7.3a and 7.3b, nominal" + _COPIED),
    "l2": Constant(0.0847, "", None, IERS + ", tables 7.3a and 7.3b, nominal" + _COPIED),
    "k2_load": Constant(-0.305, "", None, _GROSS),
    "h2_load": Constant(-0.990, "", None, _GROSS),
}

_MHB = "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068"
_MHB_2 = _MHB + ", table 2, as recalled"

#: The free core nutation, observed through its resonance in the nutations, and built into
#: IAU 2000A.
CORE_NUTATION = Constant(
    -430.21,
    "d",
    0.05,
    _MHB + "; -1.0023181092 turns per sidereal day, 430.2082 d, in their code of IAU 2000A "
    "(MHB_2000); its uncertainty recalled",
)
CORE_NUTATION_QUALITY = Constant(
    20000.0, "", None, _MHB + ", rounded; 20,046 of the 0.000025 in " + IERS + ", table 6.4"
)
#: (C_f - A_f)/A_f of the core, without what couples it.
DYNAMICAL_CORE_ELLIPTICITY = Constant(2.6456e-3, "", 2e-6, _MHB_2)
#: What couples the core beside its figure, in phase and out, magnetic by that paper; all inferred
#: from nutation.
K_CMB = (Constant(2.232e-5, "", None, _MHB_2), Constant(-1.85e-5, "", 1.4e-6, _MHB_2))
K_ICB = (
    Constant(1.11e-3, "", 1e-4, _MHB_2),
    Constant(-7.8e-4, "", 1.3e-4, _MHB_2),
)
