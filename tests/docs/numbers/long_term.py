"""Numbers of the page on millennia and millions of years."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache

import erfa
import numpy as np

import earthspin
from data_tools import long_term
from earthspin.constants import ARCSEC, J2000_JD, JULIAN_YEAR
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
def beside_la2004() -> dict[int, tuple[float, float, float, float]]:
    """Ours less La2004, with our half-widths."""
    return long_term.beside_la2004()


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


def known_then() -> float:
    """Half-width of the pole 12,000 years ago, arcsec."""
    return float(earthspin.long_term(times=["-12 kyr"]).pole_error[0])


def _shares(name: str) -> Callable[[], Sequence[float]]:
    return lambda: [share(name, 10.0**power) for power in (3, 4, 5, 6)]


def _beside(year: int) -> Callable[[], Sequence[float]]:
    return lambda: list(beside()[year])


def _beside_la2004(kyr: int) -> Callable[[], Sequence[float]]:
    def row() -> list[float]:
        obliquity, climatic, *half = beside_la2004()[kyr]
        return [obliquity, half[0], climatic, half[1]]

    return row


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
            ("constant of precession | error of `precession`", "constant"),
            ("orbit, two ways | steps half as long, and what the series leave out", "orbit"),
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
    *(
        Sentence(PAGE, f"| {words} | {{}} | {{}} | {{}} | {{}} |", _beside_la2004(kyr))
        for kyr, words in (
            (0, "J2000.0"),
            (-100, "−100 kyr"),
            (-200, "−200 kyr"),
            (-1000, "−1 Myr"),
        )
    ),
    Sentence(PAGE, "by {}″ at −10,000.", lambda: apart(-1e4, of_iau)),
    Sentence(PAGE, "as recalled) beyond; {}″ part us", lambda: apart(-1e4, of_series)),
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
        lambda: [
            part * JULIAN_YEAR / ARCSEC
            for part in (long_term.earths().strength.sun, long_term.earths().strength.moon)
        ],
    ),
]

MEASURED += [
    Sentence(
        PAGE,
        "radians, {}° today and {}° at $e = {}$",
        lambda: [math.degrees(2 * e) for e in (eccentricity_now(), 0.058)] + [0.058],
    ),
    Sentence(PAGE, "`matrix_error` is how well the pole is known, {}″ then", known_then),
]

TOLD = [
    Told(PAGE, "is at most {}″ ({}°)", "the largest nutation in obliquity, IAU 2000A"),
    Told(PAGE, "Julian years of {} days (TDB)", "by definition"),
    Told(PAGE, "beyond {}° the\n  spin is retrograde", "by definition"),
    Told(PAGE, "lies between 0 and {}° at J2000.0", "by definition"),
    Told(PAGE, "is today's {}°, as in the tables", "rounded; the answer has it"),
    Told(PAGE, "stands at $\\varpi + {}° = {}°$", "by definition"),
    Told(PAGE, "wants {}° more", "by definition"),
    Told(PAGE, "the *true* longitude of the Sun,\n{}° from", "by definition"),
    Told(PAGE, "point {}° east of it", "by definition"),
    Told(PAGE, "## Sunlight in summer at {}° north", "given"),
    Told(PAGE, "from the moving equinox ({}° is the June\nsolstice)", "by definition"),
    Told(PAGE, "$H$ larger by {} %", "given"),
    Told(PAGE, "is a {} % half-width", "what an error is, by definition"),
    Told(PAGE, "| method | windows half as long | < {} | < {} | < {} | < {} |", BOUND),
    Told(
        PAGE,
        "| start | {}″ (one standard deviation) in the obliquity | < {} | < {} | < {} | {} |",
        BOUND,
    ),
]
