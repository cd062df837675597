"""Numbers of the page on millennia and millions of years."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache

import astropy.units as u
import erfa
import numpy as np
from astropy.coordinates import SkyCoord

import earthspin
from data_tools import long_term
from earthspin.bodies import EARTH
from earthspin.constants import ARCSEC, J2000_JD, JULIAN_YEAR, SOLAR_CONSTANT
from earthspin.secular.budget import ELLIPTICITY_DRIFT
from earthspin.secular.reading import LINEAR_TO, SAMPLED_FROM
from earthspin.secular.sample import MEMBERS
from earthspin.secular.strength import FADES_FROM, FADES_TO, Strength
from earthspin.sky import orbit_table
from earthspin.sky.orbit_table import GROWTH
from tests import shipped
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/long_term.md"
#: Of what is smaller than what is printed.
BOUND = "held by tests/questions/test_long_term.py"


@cache
def effects() -> dict[str, tuple[float, float, float]]:
    """Obliquity, p_A and pole without each effect."""
    return long_term.effects()


@cache
def beside() -> dict[int, tuple[float, float, float, float]]:
    """Angles between poles at some years."""
    return long_term.beside()


@cache
def strength() -> Strength:
    """The Earth's constant of precession."""
    return long_term.solution(EARTH, np.zeros(1)).setting.strength


def share(cause: str, years: float) -> float:
    """Share of a cause in the error of the longitude of perihelion so many years ago, deg."""
    budget = shipped.tree("long-term")["budget"]
    return float(budget.longitude_share.sel(cause=cause, epoch=-years))


def apart(years: float, other: Callable[[float], np.ndarray], **changed: str) -> float:
    """Angle between our pole and another, arcsec."""
    ours = earthspin.long_term(times=[f"{years} yr"], **changed).pole.values[0]
    return float(np.linalg.norm(np.cross(ours, other(years)))) / ARCSEC


def of_iau(years: float) -> np.ndarray:
    """Pole of IAU 2006."""
    return np.asarray(erfa.pmat06(J2000_JD, 365.25 * years)[2])


def of_series(years: float) -> np.ndarray:
    """Pole of the long-term series."""
    return np.asarray(erfa.ltpb(2000.0 + years)[2])


def eccentricity_now() -> float:
    """Of the Earth's orbit at J2000.0."""
    return float(shipped.answer("long-term").eccentricity[-1])


def known_then() -> tuple[float, float]:
    """Half-widths of pole and equinox 12,000 years ago, arcsec."""
    tree = earthspin.run_tree(earthspin.long_term(times=["-12 kyr"]), "matrices")
    return tree.pole_error.item(), tree["matrices"].matrix_error.item()


def _shares(name: str) -> Callable[[], Sequence[float]]:
    return lambda: [share(name, 10.0**power) for power in (3, 4, 5, 6)]


def _beside(year: int) -> Callable[[], Sequence[float]]:
    return lambda: list(beside()[year])


def _without(name: str) -> Callable[[], Sequence[float]]:
    return lambda: list(effects()[name])


MEASURED = [
    *(
        Sentence(PAGE, f"| {words} | {{}} | {{}} | {{}} |", _without(name))
        for name, words in (
            ("eccentricity held", "eccentricity held at today's"),
            ("geodesic", "geodesic precession"),
            ("tides", "tides on Moon and spin"),
            ("ellipticity + 0.1 %", "$H$ larger by 0.1 %"),
            ("Moon's plane", "Moon's plane lags behind"),
            ("J2 rate", "rate of $J_2$, faded"),
        )
    ),
    *(
        Sentence(PAGE, f"| {words} | {{}} | {{}} | {{}} | {{}} |", _shares(name))
        for words, name in (
            ("constant of precession | error of `precession`, and closure", "constant"),
            ("orbit, two ways | as measured against others, see below", "orbit"),
            ("rate of $J_2$ | a fifth of it; later, all that has faded", "J2 rate"),
            ("tides | a fifth of today's, an assumption", "tides"),
            (
                "ellipticity | a drift of 0.7 % in ten million years, an assumption",
                "ellipticity",
            ),
        )
    ),
    *(
        Sentence(PAGE, f"| {words} | {{}} | {{}} | {{}} | {{}} |", _beside(year))
        for year, words in (
            (-2000, "−2000"),
            (-1000, "−1000"),
            (-500, "−500"),
            (500, "+500"),
            (1000, "+1000"),
            (2000, "+2000"),
        )
    ),
    Sentence(PAGE, "by {}″ at −10,000.", lambda: apart(-1e4, of_iau)),
    Sentence(
        PAGE,
        "not verified) beyond; the two solutions differ by {}″",
        lambda: apart(-1e4, of_series),
    ),
    Sentence(
        PAGE,
        "without it we would be {}″ from the series at −10,000 and {}″, not {}″, at +10,000",
        lambda: [
            apart(-1e4, of_series, j2_rate="0 1/s"),
            apart(1e4, of_series, j2_rate="0 1/s"),
            apart(1e4, of_series),
        ],
    ),
    Sentence(
        PAGE,
        "no constant of precession is pasted in: {} and {} ″/yr",
        lambda: [part * JULIAN_YEAR / ARCSEC for part in (strength().sun, strength().moon)],
    ),
]

MEASURED += [
    Sentence(
        PAGE,
        "radians, {}° today and {}° at $e = {}$",
        lambda: [math.degrees(2 * e) for e in (eccentricity_now(), 0.058)] + [0.058],
    ),
    Sentence(
        PAGE,
        "known to {}″ (`pole_error`), and the equinox to {}″ (`matrix_error`)",
        lambda: [*known_then()],
    ),
]


def nutation_in_obliquity() -> list[float]:
    """Largest of a turn of the node, IAU 2000A, arcsec and deg."""
    largest = float(np.abs(erfa.nut06a(J2000_JD, np.arange(0.0, 7000.0, 3.0))[1]).max())
    return [largest / ARCSEC, math.degrees(largest)]


def perihelion_now() -> float:
    """Its longitude at J2000.0, deg."""
    return float(shipped.answer("long-term").longitude_of_perihelion.sel(epoch=0.0))


def window_of_the_orbit() -> float:
    """Length of the windows of the shipped orbit, yr."""
    return float(orbit_table.WINDOW) / JULIAN_YEAR


def last_million(name: str) -> float:
    """Of the answer a million years ago."""
    return float(shipped.answer("long-term")[name].sel(epoch=-1e6))


def a_year_of_obliquity() -> float:
    """By how much the obliquity changes in a year, arcsec."""
    found = earthspin.long_term(times=["0 yr", "100 yr"]).obliquity
    return float(abs(found[1] - found[0])) * 36


def vega() -> float:
    """Its distance from the pole 12,000 years ago, deg, as the page has place and motion."""
    place = SkyCoord(
        ra=279.2347 * u.deg,
        dec=38.7837 * u.deg,
        distance=7.679 * u.pc,
        pm_ra_cosdec=200.94 * u.mas / u.yr,
        pm_dec=286.23 * u.mas / u.yr,
        radial_velocity=-20.6 * u.km / u.s,
    )
    then = place.cartesian.xyz - place.velocity.d_xyz * (12_000 * u.yr)
    pole = earthspin.long_term(times=["-12 kyr"]).pole.values[0]
    return float(np.degrees(np.arccos(pole @ (then / np.linalg.norm(then)).value)))


def obliquity_now() -> float:
    """By how much it is less than that of IAU 2006 at J2000.0, arcsec."""
    ours = float(shipped.answer("long-term").obliquity.sel(epoch=0.0))
    return (float(erfa.obl06(J2000_JD, 0)) - math.radians(ours)) / ARCSEC


MEASURED += [
    Sentence(PAGE, "is at most {}″ ({}°)", nutation_in_obliquity, (1, 0)),
    Sentence(PAGE, "is today's {}°, as in the tables", perihelion_now),
    Sentence(PAGE, "+ 180° = {}°$", lambda: perihelion_now() + 180),
    Sentence(
        PAGE,
        "Over a turn of {} years the two\npart by degrees",
        lambda: float(shipped.answer("precession").precession_period.sel(perturber="total")),
        500.0,
    ),
    Sentence(PAGE, "an obliquity changes by {}″ in a year", a_year_of_obliquity),
    Sentence(PAGE, "Vega was {}° from the pole", vega),
    Sentence(
        PAGE,
        "is geodesic precession, {}″ a century",
        lambda: strength().geodesic * JULIAN_YEAR * 100 / ARCSEC,
    ),
    Sentence(
        PAGE,
        "at today's rate within {} years; beyond, the change is taken back with a cosine, and is"
        " gone {}\n  years from now",
        lambda: [FADES_FROM / JULIAN_YEAR, FADES_TO / JULIAN_YEAR],
    ),
    Sentence(PAGE, "polynomials in windows of {} years", window_of_the_orbit),
    Sentence(
        PAGE,
        "a drift of {} % in ten million years, an assumption",
        lambda: 100 * ELLIPTICITY_DRIFT * 1e7 * JULIAN_YEAR,
    ),
    Sentence(PAGE, "the solar constant is {} W/m² unless", lambda: SOLAR_CONSTANT.value),
    Sentence(
        PAGE,
        "obliquity of IAU 1976, {}″ more than that of IAU 2006",
        lambda: float(erfa.obl80(J2000_JD, 0) - erfa.obl06(J2000_JD, 0)) / ARCSEC,
    ),
    Sentence(PAGE, "without which the obliquity is {}″ less now", obliquity_now),
    Sentence(
        PAGE,
        "million years back, {}° at a million, and more than a turn",
        lambda: last_million("longitude_of_perihelion_error"),
    ),
    Sentence(
        PAGE,
        "the obliquity the half-width is {}° at a million years",
        lambda: last_million("obliquity_error"),
    ),
]

MEASURED += [
    Sentence(
        PAGE,
        "From a phase error\nof {} to {} rad on",
        lambda: [LINEAR_TO, SAMPLED_FROM],
    ),
    Sentence(PAGE, "are therefore quantiles: {} solutions", lambda: MEMBERS),
    Sentence(
        PAGE,
        "Earth this is {} in a million years, measured beside",
        lambda: GROWTH["earth"].eccentricity * 1e6 * JULIAN_YEAR,
    ),
    Sentence(
        PAGE,
        "of Mars {}, beside La2004",
        lambda: GROWTH["mars"].eccentricity * 1e6 * JULIAN_YEAR,
    ),
    Sentence(
        PAGE,
        "normals differ by {} rad (Earth)\nand {} rad (Mars) in a million years",
        lambda: [GROWTH[name].normal * 1e6 * JULIAN_YEAR for name in ("earth", "mars")],
    ),
    Sentence(
        PAGE,
        "our pole would lie {}″ elsewhere two thousand years ago",
        lambda: effects()["Moon's plane"][2],
    ),
]
#: Of files that others publish.
OF_FILES = "python -m data_tools long-term --solutions, and orbits --left-out"

#: Right angles, turns and the like.
BY_DEFINITION = (
    "Julian years of {} days (TDB)",
    "beyond {}° the\n  spin is retrograde",
    "lies between 0 and {}° at J2000.0",
    "stands at $\\varpi + {}° = 283°$",
    "wants {}° more",
    "the *true* longitude of the Sun,\n{}° from",
    "point {}° east of it",
    "from the moving equinox ({}° is the June\nsolstice)",
)
TOLD = [
    *(Told(PAGE, text, "by definition") for text in BY_DEFINITION),
    Told(PAGE, "is a {} % half-width", "what an error is, by definition"),
    *(
        Told(PAGE, text, "given: the epoch")
        for text in (
            "$p_A$, deg | pole at {} kyr, ″ | source |",
            "half-width of it | {} kyr | {} kyr | {} kyr | {} Myr back |",
        )
    ),
    Told(PAGE, "## Sunlight in summer at {}° north", "given"),
    Told(PAGE, "$H$ larger by {} %", "given"),
    Told(PAGE, "the\npole at {} years (`python -m data_tools long-term`)", "given: the epoch"),
    Told(
        PAGE, "without terms of less than some {} years", "what the smoothing of the samples passes"
    ),
    Told(PAGE, "the {} % quantile of their distances", "what an error is, by definition"),
    Told(
        PAGE,
        "inside the half-widths in {} to {} % of cases",
        "docs/measured/coverage-long-term.inc",
    ),
    Told(PAGE, "three times what {} stands for", OF_FILES),
    Told(PAGE, "between {} and {} kyr falls from {}″ to {}″. IAU", OF_FILES),
    Told(
        PAGE,
        "from {} to {} Myr falls from {} to {}, of which {} are short periods",
        OF_FILES,
    ),
    Told(PAGE, "in a million years at {} %", "what an error is, by definition"),
    Told(PAGE, "**Obliquity, up to {} kyr**: the difference exceeds", OF_FILES),
    Told(PAGE, "our half-width, which is {}″ to {}″ there", OF_FILES),
    Told(PAGE, "comes to within {}″ of ZB18a over {} kyr, and to {}″ to {}″ from there", OF_FILES),
    Told(PAGE, "beyond {} kyr**: the difference from La2004 grows to {}″ and ${}$", OF_FILES),
    Told(PAGE, "| method | windows half as long | < {} | < {} | < {} | < {} |", BOUND),
    Told(
        PAGE,
        "| start | {}″ (one standard deviation) in the obliquity | < {} | < {} | < {} | {} |",
        BOUND,
    ),
]
