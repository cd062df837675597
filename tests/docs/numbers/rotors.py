"""docs/rotors.md and docs/theory.md."""

from __future__ import annotations

from functools import cache, partial

import numpy as np

from earthspin import EARTH
from earthspin.bodies import MOON, SUN
from earthspin.constants import ARCSEC_PER_YEAR, DAY
from tests import shipped
from tests.docs.numbers.answers import value
from tests.docs.numbers.sentence import Sentence, Told

ROTORS, THEORY = "docs/rotors.md", "docs/theory.md"
#: Exact by definition (IAU 2012, resolution B2), m.
ASTRONOMICAL_UNIT = 149_597_870_700.0
E = EARTH.dynamical_flattening / (1 - EARTH.dynamical_flattening)


def rigid_wobble() -> list[float]:
    at = shipped.answer("wobble").sel(rung="rigid")
    return [float(at.period_sidereal), float(at.period_solar)]


@cache
def worst_of_rotor(family: str, count: int) -> float:
    """Largest error within a few periods."""
    from tests.rotor.accuracy import cases, errors

    return max(errors(case)[0] for case in cases(family, count))


@cache
def worst_of_top(family: str, count: int) -> list[float]:
    """Largest error within three periods, and in units of what the last place of the input does."""
    from tests.top.accuracy import FRACTIONS, cases, errors

    found = [errors(start, FRACTIONS) for start in cases(family, count)]
    return [max(e.error for e in found), max(e.ulps for e in found)]


def worst_error_of_top(family: str, count: int) -> float:
    return worst_of_top(family, count)[0]


def on_a_circle() -> float:
    """Rate by the Sun on its mean orbit, a circle in the plane of reference, arcsec a year."""
    obliquity = np.radians(value("precession", "/", "obliquity"))
    share = 1.5 * EARTH.dynamical_flattening / EARTH.spin_rate * np.cos(obliquity)
    return float(share * SUN.gm / ASTRONOMICAL_UNIT**3 / ARCSEC_PER_YEAR)


def extremes() -> list[float]:
    """Largest declination of the Moon at a standstill, and the least, deg."""
    found = np.abs(shipped.tree("precession")["standstills"].standstill_declination.values)
    return [float(found.max()), float(found.min())]


ROTOR = {
    "generic": "free rotor, generic",
    "earth-like": "free rotor, like the Earth (cones of 1 µas to 89°)",
    "near the separatrix": "free rotor, near the separatrix (1e-3 to 1e-14)",
    "on the separatrix": "free rotor, on the separatrix",
    "near the sphere": "free rotor, near the sphere (1e-4 to 1e-15)",
    "axisymmetric": "free rotor, axisymmetric",
    "nearly axisymmetric": "free rotor, nearly axisymmetric",
    "needle or leaf": "free rotor, needle or leaf",
}
TOPS = {
    "generic": "generic",
    "near-steady": "near steady precession",
    "sleeping, above": "sleeping, spin just above critical",
    "sleeping, below": "sleeping, just below",
    "near-separatrix": "near the separatrix",
    "near-pole": "near a pole",
    "weightless": "weightless",
    "pendulum": "pendulum",
}

MEASURED = [
    Sentence(ROTORS, "$I_1/(I_3-I_1) = {}$ turns, which is\n{} days", rigid_wobble),
    Sentence(ROTORS, "but $(C-A)/A = 1/{}$", lambda: 1 / E),
    Sentence(ROTORS, "flattened: $f = 1/{}$", lambda: 1 / float(EARTH.needed("flattening"))),
    *(
        Sentence(
            ROTORS,
            f"| {words} | 600 | {{}} |",
            partial(worst_of_rotor, family, 600),
            factor=3.0,
            slow=True,
        )
        for family, words in ROTOR.items()
    ),
    *(
        Sentence(
            ROTORS,
            f"| heavy top, {words} | 500 | {{}}; {{}} of the effect",
            partial(worst_of_top, family, 500),
            factor=3.0,
            slow=True,
        )
        for family, words in TOPS.items()
    ),
    *(
        Sentence(
            ROTORS,
            f"| heavy top, {family} | 500 | {{}} |",
            partial(worst_error_of_top, family, 500),
            factor=3.0,
            slow=True,
        )
        for family in ("fast", "cusp")
    ),
    Sentence(
        THEORY,
        "it is {} days, not 18.6 years of 365.25 days, which is {} days short",
        lambda: [MOON.cycle / DAY, MOON.cycle / DAY - 18.6 * 365.25],
    ),
    Sentence(THEORY, "Sun's mean orbit it gives {} arcsec/yr", on_a_circle),
    Sentence(THEORY, "turns, {} for the Earth, {} days of 86400 s", rigid_wobble),
    Sentence(THEORY, "would give {} turns.", lambda: 1 / float(EARTH.dynamical_flattening)),
    Sentence(
        THEORY,
        "one\ndegree in {} years",
        partial(value, "precession", "seasons", "time_per_degree"),
    ),
    Sentence(
        THEORY,
        "drifts by a day in {} years.",
        partial(value, "precession", "seasons", "time_per_day_of_drift"),
    ),
    Sentence(
        THEORY,
        "which with $J_2$ gives $C = {}\\,Ma^2$",
        partial(value, "precession", "figure_models", "polar_moment_factor"),
    ),
    Sentence(
        THEORY,
        "the Moon reaches {} degrees in single months",
        lambda: extremes()[0],
    ),
    Sentence(THEORY, "stays within {} degrees in others", lambda: extremes()[1]),
]
TOLD = [
    Told(ROTORS, "with\nattitude, takes {} ms", "run time: python -m tests.rotor.accuracy"),
]
