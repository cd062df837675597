"""Numbers of the page on other worlds; its table is held by tests/test_worlds.py."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

import earthspin
from data_tools import lunar_state
from data_tools.coverage.worlds import (
    LA2004_RATE,
    LA2004_START,
    OTHER_POLES,
    la2004,
    like_la2004,
    vector,
)
from earthspin.bodies import BODIES, JUPITER, NUMBERS, SATURN
from earthspin.bodies.giants import OF_JUPITER, OF_SATURN
from earthspin.bodies.moon import OBLIQUITY
from earthspin.bodies.satellites import added_by
from earthspin.constants import ARCSEC, NORMAL_95
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/worlds.md"


def shares() -> list[float]:
    """J2 with satellites over that of the planet alone."""
    found = []
    for planet, moons in ((JUPITER, OF_JUPITER), (SATURN, OF_SATURN)):
        q, _ = added_by(moons, planet.gm, planet.radius, planet.spin_period)
        found.append(planet.j2 / (NUMBERS[planet.name]["j2"].value - q))
    return found


def halves() -> list[float]:
    """Half-widths of the poles, arcsec, in the order of the table."""
    names = ("earth", "mars", "saturn", "mercury")
    return [NORMAL_95 * (BODIES[name].pole_uncertainty or 0.0) / ARCSEC for name in names]


def poles_apart(name: str, other: str) -> float:
    """Angle between the pole of a body and that of another solution, arcsec."""
    pole = BODIES[name].needed("pole").without_nutation().mean(np.zeros(1))[0]
    return float(np.linalg.norm(pole - vector(OTHER_POLES[name][other]))) / ARCSEC


@cache
def mars(times: str) -> float:
    """Obliquity of Mars, deg."""
    return float(earthspin.long_term(times=[times], body="mars").obliquity[0])


def rate_of_mars() -> float:
    """Rate of precession of Mars with geodesic precession, arcsec/yr."""
    return float(earthspin.long_term(times=["0 kyr"], body="mars").precession_rate[-1, 0])


def rms(start: float | None, rate: float | None) -> list[float]:
    """Ours less La2004 over the spans of the table, deg."""
    ours = like_la2004(start, rate)
    return _by_span(ours.epoch.values, ours.obliquity.values - la2004())


def half_width() -> list[float]:
    """Rms of the half-width of the obliquity of Mars over the spans of the table, deg."""
    ours = like_la2004()
    return _by_span(ours.epoch.values, ours.obliquity_error.values)


def _by_span(epochs: np.ndarray, values: np.ndarray) -> list[float]:
    spans = ((0.0, 2e4), (2e4, 1e5), (1e5, 1e6))
    return [
        float(np.sqrt(np.mean(values[(-epochs >= first) & (-epochs <= last)] ** 2)))
        for first, last in spans
    ]


def left_of_la2004() -> float:
    """Largest difference with the constants of La2004, deg."""
    ours = like_la2004(LA2004_START, LA2004_RATE)
    return float(np.abs(ours.obliquity.values - la2004()).max())


def tilt_of_the_moon() -> float:
    """To the ecliptic, on the real orbit, deg."""
    full = lunar_state.obliquity(lunar_state.sky(), with_sun=True, from_node=True)
    return full - math.degrees(lunar_state.ORBIT.i)


_ROW = "| {} | {} | {} |\n"
MEASURED = [
    Sentence(PAGE, "satellites, with {} times and {} times the $J_2$", shares),
    Sentence(
        PAGE,
        "The obliquity of the Moon comes out {}° too large",
        lambda: float(earthspin.cassini_states("moon").obliquity[0]) - OBLIQUITY.value,
    ),
    Sentence(PAGE, "Moon is inclined by {}° to the ecliptic", tilt_of_the_moon),
    Sentence(PAGE, "| Earth | {} | obliquity of IAU", lambda: halves()[0]),
    Sentence(
        PAGE,
        "| Mars | {} | IAU 2009 and IAU 2015, {}″ apart without",
        lambda: [halves()[1], poles_apart("mars", "IAU 2009")],
    ),
    Sentence(
        PAGE,
        "| Saturn | {} | IAU 2015 and Jacobson (2007), {}″ apart |",
        lambda: [halves()[2], poles_apart("saturn", "Jacobson 2007")],
    ),
    Sentence(PAGE, "| Mercury | {} |", lambda: halves()[3]),
    Sentence(
        PAGE,
        "(2016) lies {}″ from that of IAU 2015",
        lambda: poles_apart("mars", "Konopliv et al. 2016"),
    ),
    Sentence(
        PAGE,
        "J2000.0 is {}° here and {}° in La2004",
        lambda: [mars("0 kyr"), float(la2004()[0])],
    ),
    Sentence(PAGE, "and we find {}° then", lambda: mars("1980-01-01")),
    Sentence(
        PAGE,
        "grows by {}″ a year",
        lambda: 3600 * (mars("0 kyr") - mars("1980-01-01")) / 20,
    ),
    Sentence(PAGE, "precession included, is {} ″/yr", rate_of_mars),
    Sentence(PAGE, "the rate of La2004 is {} ″/yr", lambda: LA2004_RATE),
    Sentence(PAGE, "less than stated by {} ″/yr", lambda: 7.597 - LA2004_RATE),
    Sentence(
        PAGE,
        "twice geodesic precession ({} ″/yr)",
        lambda: float(earthspin.precession(body="mars").precession_rate[-1]) - rate_of_mars(),
        within=2e-5,  # the obliquity of the other is that with nutation
    ),
    Sentence(PAGE, f"| earthspin {_ROW}", lambda: rms(None, None)),
    Sentence(PAGE, f"| start of La2004, our rate {_ROW}", lambda: rms(LA2004_START, None)),
    Sentence(
        PAGE, "| start of La2004, 7.597 ″/yr | {} | {} | {} |", lambda: rms(LA2004_START, 7.597)
    ),
    Sentence(PAGE, f"| start and rate of La2004 {_ROW}", lambda: rms(LA2004_START, LA2004_RATE)),
    Sentence(PAGE, f"| our half-width {_ROW}", half_width),
    Sentence(PAGE, "La2004 agrees to {}° over", left_of_la2004),
]
TOLD = [
    Told(PAGE, "Half-widths are for {} %", "what an error is, by definition"),
    Told(PAGE, "half-width of {} % (″)", "what an error is, by definition"),
    Told(PAGE, "obliquity of {} ± {}′ (Stark", "published: Stark et al. 2015"),
    Told(PAGE, "where {}° are observed", "published: arXiv:2201.00803"),
    Told(PAGE, "landers gave {}° ± {}° (Yoder", "published: Yoder & Standish 1997"),
    Told(PAGE, "La2004 states {} ″/yr", "published: README of the files of La2004"),
    Told(PAGE, "observed one is {} ± {} ″/yr", "published: Konopliv et al. 2016, 95 %"),
    Told(PAGE, "less than its stated {} ″/yr", "published: README of the files of La2003"),
    Told(PAGE, "| {} to {} kyr back | {} to {} kyr back | {} kyr to {} Myr back |", "given"),
    Told(PAGE, "| start of La2004, {} ″/yr |", "given"),
]
