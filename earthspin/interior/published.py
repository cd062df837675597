"""Compliances, ellipticities and coupling numbers of PREM as published."""

from __future__ import annotations

from earthspin.constants import Constant

_MBHS = "Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219"
_READ, _RECALLED = _MBHS + ", as copied in public code", _MBHS + ", as recalled"

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
        ("fluid", 0.113066, _RECALLED),
        ("inner", 7.3059e-4, _RECALLED),
    )
}
