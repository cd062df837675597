"""docs/rotors.md and docs/theory.md."""

from __future__ import annotations

from functools import cache, partial

import numpy as np

import earthspin
from earthspin import EARTH
from earthspin.bodies import MOON, SUN
from earthspin.constants import ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, G
from earthspin.sky import iau
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.torque.average import Window, window_mean_and_error
from tests import shipped
from tests.docs.numbers.answers import of_c04, value
from tests.docs.numbers.sentence import Column, Sentence, Told
from tests.mass.accuracy import ROWS as WORST_OF_MASS
from tests.mass.accuracy import spheroid_errors
from tests.mass.spheroid_reference import FAMILIES as SPHEROIDS
from tests.mass.spheroid_reference import PLACES

ROTORS, THEORY = "docs/rotors.md", "docs/theory.md"
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


def on_the_mean_orbit() -> float:
    """Rate by the Sun on its mean orbit in the plane of reference, arcsec a year."""
    eccentricity, axis = 0.016708634, 149598023e3  # at J2000.0, Simon et al. 1994
    obliquity = np.radians(value("precession", "/", "obliquity"))
    share = 1.5 * EARTH.dynamical_flattening / EARTH.spin_rate * np.cos(obliquity)
    pull = SUN.gm / axis**3 * (1 - eccentricity**2) ** -1.5
    return float(share * pull / ARCSEC_PER_YEAR)


def off_the_ephemeris() -> float:
    """That rate beside the ephemeris, relative."""
    ours = value("precession", "/", "precession_rate", perturber="sun")
    return abs(on_the_mean_orbit() / ours - 1)


def rate_about(year: float, taper: str, turns: float, cycle: float = MOON.cycle) -> float:
    """Rate under Sun and Moon averaged about a time from J2000.0, by DE421, arcsec a century."""
    rate, times = daily_rates()
    window = Window(year * JULIAN_YEAR, turns, cycle, taper)
    inside = np.abs(times - window.centre) <= window.length / 2
    mean, _ = window_mean_and_error(window, times[inside], rate[inside], np.zeros(2))
    return float(mean[-1]) / 1e3


@cache
def daily_rates() -> tuple[np.ndarray, np.ndarray]:
    """Daily rates, mas a century, and their times, s."""
    from data_tools.windows import rates

    kernel = open_ephemeris("de421")
    return rates(kernel, min(abs(day) for day in kernel.coverage({10, 301, 399})) - 1)


def drift() -> float:
    """Of the averaged rate, arcsec a century in a century."""
    return (rate_about(24, "sin4", 3) - rate_about(-24, "sin4", 3)) / 0.48


def extremes() -> list[float]:
    """Largest declination of the Moon at a standstill, and the least, deg."""
    found = np.abs(shipped.tree("precession")["standstills"].standstill_declination.values)
    return [float(found.max()), float(found.min())]


def inclinations() -> list[float]:
    """Least and largest inclination of the Moon's orbit to the ecliptic of J2000.0, deg."""
    kernel, days, step = open_ephemeris("de421"), np.arange(-36000.0, 19000.0), 0.05
    before, now, after = (
        kernel.positions({"moon": 301}, 399, days + shift)["moon"] for shift in (-step, 0, step)
    )
    normal = np.cross(now, after - before)
    along = normal @ iau.ecliptic_pole() / np.linalg.norm(normal, axis=1)
    tilt = np.degrees(np.arccos(along))
    return [float(tilt.min()), float(tilt.max())]


def chandler_period() -> float:
    """As observed, d."""
    return of_c04("burg")[0]


def worst_of_mass(words: str) -> float:
    return WORST_OF_MASS[words](600)


def spheroid_beside_the_input() -> float:
    """Largest error over what the last place of the input does, where that is much."""
    return max(spheroid_errors(family, place, 100).ulps for family in SPHEROIDS for place in PLACES)


def ten_thousand_periods() -> float:
    """Largest change of what a free rotor keeps, as in docs/stability.md."""
    found = earthspin.stability(only="over 10^4 periods")
    return float(found.measured.max())


@cache
def late_errors_of_tops() -> list[float]:
    """After ten thousand periods, over the effect of the input's last place: of three kinds."""
    from tests.top.accuracy import LATE, cases, errors
    from tests.top.families import FAMILIES

    late = {
        family: max(errors(start, (LATE,)).ulps for start in cases(family, 500))
        for family in FAMILIES
    }
    below = late.pop("sleeping, below")
    odd = [late.pop(family) for family in ("cusp", "near-separatrix")]
    return [min(late.values()), max(late.values()), max(odd), below]


TABLE = "| family | cases | worst error | time |"
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
    Sentence(ROTORS, "$I_1/(I_3-I_1) = {}$ rotations, which is\n{} days", rigid_wobble),
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
        Sentence(ROTORS, f"| heavy top, {row}", partial(worst, family, 500), factor=3.0, slow=True)
        for family, row, worst in (
            *((f, f"{w} | 500 | {{}}; {{}} of the effect", worst_of_top) for f, w in TOPS.items()),
            *((f, f"{f} | 500 | {{}} |", worst_error_of_top) for f in ("fast", "cusp")),
        )
    ),
    Sentence(
        THEORY,
        "it is {} days, not {} years of {} days, which is {} days short",
        lambda: [MOON.cycle / DAY, 18.6, 365.25, MOON.cycle / DAY - 18.6 * 365.25],
    ),
    Sentence(THEORY, "Sun's mean orbit it gives {} arcsec/yr", on_the_mean_orbit),
    Sentence(THEORY, "arcsec/yr, within ${}$ of the ephemeris", off_the_ephemeris),
    Sentence(THEORY, "which is known to\n${}$ only", lambda: G.uncertainty / G.value),
    Sentence(
        THEORY,
        "With the rounded length, Hann and sin$^4$ tapers over four turns give {} and {}",
        lambda: [rate_about(0, taper, 4, 18.6 * JULIAN_YEAR) for taper in ("hann", "sin4")],
        slow=True,
    ),
    Sentence(
        THEORY,
        "one in 400/3 = {}\nyears, and so departs from the seasons by a day in {} years",
        lambda: [
            value("precession", "seasons", "time_per_dropped_leap_day"),
            value("precession", "seasons", "time_per_day_of_gregorian_drift"),
        ],
    ),
    Sentence(
        THEORY,
        "the right one both give {} or {}.",
        lambda: sorted(rate_about(0, taper, 4) for taper in ("hann", "sin4")),
        slow=True,
    ),
    Sentence(THEORY, 'The rate drifts by {} "/cy per century', drift, slow=True),
    Sentence(THEORY, "turns, {} for the Earth, {} days of {} s", lambda: [*rigid_wobble(), DAY]),
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
    Sentence(
        THEORY,
        "most of all, the {} years of the\nMoon's node",
        lambda: MOON.cycle / JULIAN_YEAR,
    ),
    Sentence(THEORY, "has a period of about [{} days]", chandler_period),
    Sentence(THEORY, "Moon's orbit vary between {} and {} degrees", inclinations),
    *(
        Sentence(
            ROTORS,
            f"| {words} | 600 | {{}} |",
            partial(worst_of_mass, words),
            factor=3.0,
            slow=True,
        )
        for words in WORST_OF_MASS
    ),
    Sentence(ROTORS, "The observed wobble takes about {} days", chandler_period),
    Sentence(
        ROTORS,
        "there the error of the spheroid is {} of that effect at most",
        spheroid_beside_the_input,
        factor=3.0,
        slow=True,
    ),
    Sentence(
        ROTORS,
        "energy, angular momentum and unit\nquaternion of the rotor are constant within {} (",
        ten_thousand_periods,
        factor=3.0,
        slow=True,
    ),
    Sentence(
        ROTORS,
        "the worst errors then are {} to {} times that\neffect in seven families, and {} (cusp, "
        "near the separatrix) and {} (just below critical spin) times in three",
        late_errors_of_tops,
        factor=1.5,
        slow=True,
    ),
]
TOLD = [
    Column(ROTORS, TABLE, "time", "run time: python -m tests.rotor.accuracy, and its like"),
    Column(ROTORS, TABLE, "family", "given: where the cases of a family are drawn from"),
    Told(
        ROTORS,
        "If the error of a\ntop exceeds {}, the table also gives its ratio",
        "given: tests/top/accuracy.py, GOOD",
    ),
    Told(THEORY, "$J_2$ with $C = {}\\,Ma^2$", "by definition: a homogeneous sphere"),
    Told(THEORY, "a calendar with years of {} days", "by definition: the Julian year"),
    Told(THEORY, "The source text has\n{} years", "the source text"),
    Told(THEORY, "extreme declinations of {} and {} degrees, that is {} ± {}", "the source text"),
    Told(ROTORS, "with\nattitude, takes {} ms", "run time: python -m tests.rotor.accuracy"),
]
