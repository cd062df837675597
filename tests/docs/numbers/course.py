"""The lessons of docs/course: what their prose says beside what their cells print."""

from __future__ import annotations

from functools import cache, partial

import numpy as np

import earthspin
from earthspin.bodies import MOON
from earthspin.constants import ARCSEC, JULIAN_YEAR
from tests.docs.numbers.answers import observed, of_c04, value
from tests.docs.numbers.rotors import inclinations, rigid_wobble
from tests.docs.numbers.sentence import Sentence, Told
from tests.docs.numbers.wobble import core_nutation

EARTH = earthspin.EARTH
#: Arcseconds of a turn.
TURN = 2 * np.pi / ARCSEC


def page(lesson: str) -> str:
    """Path of a lesson."""
    return f"docs/course/{lesson}.md"


MOTION, AXES, ROTOR, OBLATE, OBSERVED, LONG = map(
    page,
    (
        "equation-of-motion",
        "principal-axes",
        "symmetric-rotor",
        "oblate-earth",
        "observed-earth",
        "long-run",
    ),
)


def node_period() -> float:
    """Years."""
    return float(MOON.cycle / JULIAN_YEAR)


def thousand_years(perturber: str) -> float:
    """Period of precession."""
    return value("precession", "/", "precession_period", perturber=perturber) / 1e3


def rate(perturber: str) -> float:
    """Of precession, arcsec a year."""
    return value("precession", "/", "precession_rate", perturber=perturber)


def equatorial() -> float:
    """(B - A)/A of the Earth: its triaxiality is (B - A)/(M a^2)."""
    polar = value("precession", "figure_models", "polar_moment_factor")
    return float(EARTH.needed("triaxiality")) / polar / (1 - EARTH.dynamical_flattening)


def drift_of_the_pole() -> float:
    """Of a straight line through C04, cm a year."""
    years = (observed().time.values - np.datetime64("2000-01-01")) / np.timedelta64(1, "D") / 365.25
    slopes = [np.polyfit(years, observed()[axis].values, 1)[0] for axis in "xy"]
    return float(100 * np.hypot(*slopes) * ARCSEC * observed().polar_radius)


def at_the_pole() -> list[float]:
    """An angle, arcsec, and its arc on the ground, m."""
    return [0.2, 0.2 * ARCSEC * float(EARTH.radius)]


def standstills() -> list[float]:
    """Obliquity and inclination (the source text's), deg, the turn of the node, sum, difference."""
    obliquity, inclination = value("precession", "/", "obliquity"), 5.14
    return [
        obliquity,
        inclination,
        node_period(),
        obliquity + inclination,
        obliquity - inclination,
    ]


def cores() -> list[float]:
    """Free core nutation in equilibrium and as observed, d."""
    return [-core_nutation(shape) for shape in ("hydrostatic", "observed")]


@cache
def largest_term(span: str) -> float:
    """Rate of the largest term in the path of the Earth's orbit, arcsec a year."""
    x, y, _ = earthspin.long_term(span, "0 kyr", "1 kyr").ecliptic_pole.values.T
    swing = np.hanning(x.size) * (x - x.mean() + 1j * (y - y.mean()))
    points = 2**19  # three thousandths of an arcsecond a year
    largest = np.argmax(np.abs(np.fft.fft(swing, points)))
    return float(np.fft.fftfreq(points, 1e3)[largest] * TURN)


def of_the_plane() -> list[float]:
    """Rate of the largest term, arcsec a year; its turn and that of the obliquity, years."""
    sigma = largest_term("-1 Myr")
    return [sigma, TURN / abs(sigma), rate("total"), TURN / (rate("total") + sigma)]


def obliquity_in_a_century() -> float:
    """By how much it falls now, arcsec."""
    around = earthspin.long_term("-100 yr", "100 yr", "100 yr").obliquity.values
    return float(around[0] - around[-1]) / 2 * 3600


MEASURED = [
    Sentence(AXES, "and $(B-A)/A$ is ${}$", equatorial),
    Sentence(AXES, "about {} cm a year since 1962", drift_of_the_pole),
    Sentence(ROTOR, "once in {} days if it were rigid", lambda: rigid_wobble()[1]),
    Sentence(ROTOR, "An amplitude of {} arcsec is\n{} m at the pole", at_the_pole),
    Sentence(ROTOR, "a period of {} days or so", lambda: of_c04("burg")[0], 5.0),
    Sentence(
        OBLATE, "instead,** with a period of {} thousand years", partial(thousand_years, "total")
    ),
    Sentence(
        OBLATE,
        "The Sun alone would take {} thousand years, Sun and Moon take less than {} thousand",
        lambda: [thousand_years(name) for name in ("sun", "total")],
    ),
    Sentence(
        OBLATE,
        "{}° ± {}°, with the period of the lunar node, {} years: {}° and {}°, the major",
        standstills,
    ),
    Sentence(OBLATE, "inclination itself swing between {}° and {}°", inclinations),
    Sentence(OBSERVED, "observed to\ntake {}. What came after", lambda: of_c04("burg")[0], 5.0),
    Sentence(OBSERVED, "the {} years of the Moon's node, makes the axis nod", node_period),
    Sentence(OBSERVED, "an ellipse in the {} years of the Moon's node", node_period),
    Sentence(OBSERVED, "equilibrium that would be {} days; {} are observed", cores),
    Sentence(
        LONG,
        "at the rate $p = \\alpha\\cos\\varepsilon$, in {} years",
        lambda: 1e3 * thousand_years("total"),
        500.0,
    ),
    Sentence(
        LONG,
        "orbit has $\\sigma \\approx {}$ arcsec a year, a turn in some {} years. With $p = {}$ it "
        "tilts the equator to and fro in\n$360°/(p+\\sigma)$, that is {} years",
        of_the_plane,
        (0, 500.0, 0, 500.0),
    ),
    Sentence(LONG, "The obliquity decreases by {} arcsec a century now", obliquity_in_a_century),
    Sentence(
        LONG,
        "the term with $\\sigma = {}$ arcsec a year do",
        partial(largest_term, "-10 Myr"),
        0.02,
        slow=True,
    ),
    Sentence(LONG, "The Sun alone gives $p = {}$ arcsec a year", partial(rate, "sun")),
]

#: Right angles, turns and the like.
BY_DEFINITION = (
    (page("inertia-tensor"), "perpendicular to it, at ${}° - \\chi$ from the axle"),
    (AXES, "minimum, each {}° from the others"),
    (OBLATE, "The Julian calendar has years of {} days"),
    (OBLATE, "and shorter than {} days by another amount"),
    (OBLATE, "The reform takes out {} days in {} years"),
    (OBSERVED, "$C/(Ma^2)$, {} for a body of one density"),
    (LONG, "to and fro in\n${}°/(p+\\sigma)$"),
    (LONG, "$\\nu = {}° - (\\varpi + {}°)$"),
    (LONG, "library, whose {} % band"),
)
#: What an exercise or a picture begins with, and what the cell below it takes.
GIVEN = (
    (
        MOTION,
        "Its moments are\n{} kg m² about its own axis and {} kg m² across, the axle makes {} turns",
    ),
    (page("euler-equations"), "thrown with its spin {}° from each of its axes"),
    (AXES, "An ice sheet of ${}$ kg melts at latitude {}°"),
    (AXES, "$mr^2\\sin {}°\\cos {}°$"),
    (LONG, "the June solstice at {}° north, {} years ago"),
)
TOLD = [
    *(Told(lesson, text, "by definition") for lesson, text in BY_DEFINITION),
    *(Told(lesson, text, "given: what the cell below begins with") for lesson, text in GIVEN),
    Told(OBLATE, "(The text\nhas {} years, beside", "the source text, I.8"),
    Told(OBLATE, "The Moon's orbit is inclined by {}° to the ecliptic", "the source text, I.8"),
    Told(OBSERVED, "with a wobble of {} days that is", "the source text, I.6.32"),
]
