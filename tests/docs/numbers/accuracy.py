"""docs/accuracy.md."""

from __future__ import annotations

from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

import earthspin
from data_tools import windows as tool
from earthspin import EARTH
from earthspin.bodies import MOON, body
from earthspin.choosing.choice import models
from earthspin.constants import ARCSEC, JULIAN_YEAR
from earthspin.mass import spheroid
from earthspin.rotor import triaxial
from earthspin.sky import kernel_checks, kernel_differences
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.top import rounding
from earthspin.torque.average import Window
from tests import shipped
from tests.docs.numbers.answers import (
    input_error_of_the_pole,
    kernel_of_the_pole,
    nutation_between_nodes,
    value,
)
from tests.docs.numbers.sentence import ROOT, Column, Part, Sentence, Told

PAGE = "docs/accuracy.md"

MAS = ARCSEC / 1e3
ERROR = "what an error is, by definition"
BENCH = "run time: make bench"
GIVEN = "given: where random scenes are drawn from, tests/choosing/accuracy.py"
REQUESTS = (
    "| question | requests | within the request | largest true error over request "
    "| cost over the cheapest, median | 95 % |"
)


# --- the averaged rate -----------------------------------------------------------------------


def relative_error_of_rate() -> float:
    total = shipped.answer("precession").sel(perturber="total")
    return float(total.precession_rate_error / total.precession_rate)


def input_error() -> float:
    """95 % half-width of the rate by H, mas a century."""
    return 1e5 * value("precession", "/", "precession_rate_error_input", perturber="total")


@cache
def windows_of_de440() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Centres, s, daily rates, mas a century, and their times, s."""
    kernel = open_ephemeris("de440")
    half = min(abs(day) for day in kernel.coverage({10, 301, 399})) - 1
    rate, times = tool.rates(kernel, half)
    reach = times[-1] - 4.01 * MOON.cycle
    return np.arange(-reach, reach, tool.SPACING), rate, times


@cache
def windows(taper: str, turns: float) -> list[float]:
    """Rms and largest distance in mas a century, per cent within the error, by DE440."""
    centres, rate, times = windows_of_de440()
    rms, largest, share = tool.scatter(rate, times, taper, turns, centres)
    return [rms, largest, 100 * share]


def turns_that_are_not_whole(taper: str) -> list[float]:
    return [4.5, *windows(taper, 4.5)]


def plain_mean() -> float:
    """Of the rate, rms, %."""
    _, rate, _ = windows_of_de440()
    return 100 * windows("plain", 2)[0] / float(rate.sum(axis=1).mean())


def about_now(turns: int) -> float:
    """Mean rate about J2000.0 under a taper of so many turns, mas a century."""
    _, rate, times = windows_of_de440()
    window = Window(0.0, turns, MOON.cycle, "sin4")
    inside = np.abs(times) <= window.length / 2
    return float(window.mean(times[inside], rate[inside].sum(axis=1)))


def long_windows() -> list[float]:
    """What the curvature moves a mean by, mas a century, and the windows' length, yr."""
    turn = MOON.cycle / JULIAN_YEAR
    seen = {turns: abs(about_now(turns) - about_now(5)) for turns in (24, 47)}
    return [number for turns, off in seen.items() for number in (off, turns * turn)]


@cache
def daily() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times, s, and rates by DE421 over five turns of the node, mas a century."""
    kernel = open_ephemeris("de421")
    rate, times = tool.rates(kernel, Window(0.0, 5, MOON.cycle, "sin4").length / 2 / 86400 + 1)
    return times, rate.sum(axis=1)


def sampled(days: int) -> float:
    """By what samples so many days apart change the default mean, relative."""
    window = Window(0.0, 5, MOON.cycle, "sin4")
    times, rate = daily()

    def mean(step: int) -> float:
        sampled = window.sample_times(step * 86400.0)
        return float(window.mean(sampled, rate[np.rint((sampled - times[0]) / 86400).astype(int)]))

    return abs(mean(days) / mean(1) - 1)


# --- kernels ---------------------------------------------------------------------------------


def kernel_error(target: int, centre: int, years: float = 0.0) -> list[float]:
    """Claimed of DE421: direction in mas, and distance in m."""
    direction, distance = open_ephemeris("de421").error(target, centre, years * 365.25)
    return [direction / MAS, distance]


def direction_errors() -> list[float]:
    """Of Sun and Moon by DE421, mas."""
    return [kernel_error(code, 399)[0] for code in (10, 301)]


@cache
def drifts() -> dict[str, tuple[float, float]]:
    from data_tools import kernels

    return kernels.drifts("de440")


def drift(body: str) -> float:
    """How far DE421 and DE440 let axes part from 1901 to 2050, uas."""
    return drifts()[body][0]


def tidal_accelerations() -> float:
    """By which the Moons of DE421 and DE440 part along track, mas a century squared."""
    one, other = (open_ephemeris(name) for name in ("de421", "de440"))
    days = np.linspace(-36000.0, 19000.0, 8001)
    place = [kernel.positions({"moon": 301}, 399, days)["moon"] for kernel in (one, other)]
    speed = np.gradient(place[0], days, axis=0)
    along = speed / np.linalg.norm(speed, axis=1, keepdims=True)
    off = np.sum((place[0] - place[1]) * along, axis=1) / np.linalg.norm(place[0], axis=1) / MAS
    return float(np.polynomial.Polynomial.fit(days / 36525, off, 2).convert().coef[2])


def off_skyfield() -> float:
    """Declinations at the true equator beside those of `source = "skyfield"`, rad."""
    span = ("1900-01-01", "2050-01-01", "1.37 d")
    ours, theirs = (
        earthspin.torque_series(*span, equator="true", source=source).declination
        for source in ("jplephem", "skyfield")
    )
    return float(np.radians(abs(ours - theirs).max()))


def random_damage() -> list[float]:
    """Per cent refused in data and directories of a small kernel, largest torque that passes."""
    from tests.sky.kernel_files import from_de421
    from tests.sky.test_kernel_checks import damaged_at_random

    with TemporaryDirectory() as folder:
        found = damaged_at_random(Path(folder) / "small.bsp", from_de421())
    return [100 * found.directories / 200, found.worst]


# --- asking for an accuracy ------------------------------------------------------------------


def known_figure_rate() -> float:
    """Relative error of the rate where the figure is known exactly."""
    exact = earthspin.precession(body=EARTH.replace(relative_uncertainty={})).sel(perturber="total")
    return float(exact.precession_rate_error / exact.precession_rate)


def menu_of_the_pole() -> list[float]:
    settings = np.array(models()["pole"]["settings"])
    days, nodes = settings.T
    return [len(settings), nodes.min(), nodes.max(), days.min(), days.max()]


def menu_of_averages() -> list[float]:
    cycles, steps = (models()["average"][name] for name in ("cycles", "steps"))
    return [len(cycles) * len(steps), cycles[0], cycles[-1], steps[0], steps[-1]]


def random_scenes(kind: str) -> list[float]:
    """Per cent within, worst ratio, median and 95th percentile of the cost, of 120 scenes."""
    from tests.choosing.accuracy import outcomes, summary

    found = summary(list(outcomes(kind, 120)))
    return [100 * found["within"], found["worst"], found["median cost"], found["95 % cost"]]


TAPERS = {
    ("plain", 2): "| plain mean, 2 |",
    ("hann", 2): "| Hann, 2 |",
    ("hann", 3): "| Hann, 3 |",
    ("sin4", 3): "| sin⁴, 3 |",
    ("sin4", 4): "| sin⁴, 4 |",
    ("sin4", 8): "| sin⁴, 8 |",
    ("blackman-harris", 5): "| Blackman-Harris, 5 |",
}

MEASURED = [
    *(
        Sentence(
            PAGE,
            f"{words} {{}} | {{}} | {{}} % |",
            partial(windows, *which),
            within,
            slow=True,
            de440=True,
        )
        for (which, words), within in zip(
            TAPERS.items(), [(50, 5, 0), *[(0, 0, 0)] * 6], strict=True
        )
    ),
    *(
        Sentence(
            PAGE,
            f"| {words}, {{}} (not whole) | {{}} | {{}} | {{}} % |",
            partial(turns_that_are_not_whole, taper),
            slow=True,
            de440=True,
        )
        for taper, words in (("sin4", "sin⁴"), ("blackman-harris", "Blackman-Harris"))
    ),
    Sentence(
        PAGE,
        "| **sin⁴, 5 (the default with DE421)** | **{}** | **{}** | {} % |",
        partial(windows, "sin4", 5),
        slow=True,
        de440=True,
    ),
    Sentence(PAGE, "fail to show: ${}$ of it,", lambda: MOON.slow_swing),
    Sentence(PAGE, "${}$ for the pull of a planet", lambda: body("jupiter").slow_swing),
    Sentence(PAGE, "windows centred every {} days", lambda: tool.SPACING / 86400),
    Sentence(PAGE, "plain mean over two turns is wrong by {} %", plain_mean, slow=True, de440=True),
    Sentence(
        PAGE,
        "({} mas/cy at {} years, {} at {})",
        long_windows,
        (0, 5, 0.5, 5),
        slow=True,
        de440=True,
    ),
    Sentence(
        PAGE,
        "two days change the rate by less than\n${}$.",
        partial(sampled, 2),
        bound=True,
    ),
    Sentence(
        PAGE,
        "four days\nare wrong by ${}$, nineteen only by ${}$, twenty-nine by ${}$.",
        lambda: [sampled(days) for days in (4, 19, 29)],
    ),
    Sentence(PAGE, "(one standard deviation), which is\n{} mas/cy at 95 %.", input_error),
    Sentence(
        PAGE,
        "({} mas a century squared along the track, {} mas in 1560)",
        lambda: [abs(tidal_accelerations()), kernel_error(301, 399, -440)[0]],
        (0.1, 0),
        slow=True,
        de440=True,
    ),
    Sentence(PAGE, "at most {} mas and {} m for the Sun", partial(kernel_error, 10, 399), (0.1, 1)),
    Sentence(
        PAGE,
        "for the Sun, {} mas (in 2053) and {} m for\nthe Moon",
        partial(kernel_error, 301, 399),
        (0.1, 0.1),
    ),
    Sentence(
        PAGE,
        "and differ by {} µas a century\nfrom it",
        lambda: drift("earth under sun and moon"),
        slow=True,
        de440=True,
    ),
    Sentence(
        PAGE, "those of Mars by {} µas", lambda: drift("mars under sun"), slow=True, de440=True
    ),
    Sentence(PAGE, "1901 to 2050): ${}$ of the angle", lambda: kernel_differences.DRIFT),
    Sentence(
        PAGE,
        "the largest is {} of it",
        lambda: max(over for _, over in drifts().values()),
        slow=True,
        de440=True,
    ),
    Sentence(PAGE, "quintic spline, off by\n${}$ rad at most", nutation_between_nodes, bound=True),
    Sentence(
        PAGE, 'those of `source = "skyfield"` to\n${}$ rad', off_skyfield, bound=True, slow=True
    ),
    Sentence(PAGE, "to {} of the acceleration, at eight times", lambda: kernel_checks._NEWTON),
    Sentence(
        PAGE,
        "half were refused and of 200 in its directories {} %; the\n"
        "others were too low in their numbers to matter, ${}$ of the torque at most",
        random_damage,
        slow=True,
    ),
    Sentence(PAGE, "| {} settings, {} to {} nodes on {} to {} days |", menu_of_the_pole),
    Sentence(PAGE, "| {} settings, {} to {} cycles, {} to {} days |", menu_of_averages),
    Sentence(PAGE, "| {} settings | |", lambda: len(models()["nutation"])),
    Sentence(
        PAGE,
        "So one table of {} kB holds",
        lambda: (ROOT / "earthspin/choosing/error_models.json").stat().st_size / 1e3,
        5.0,
    ),
    *(
        Sentence(
            PAGE,
            f"| `{kind}` | {asked} | {{}} % | {{}} | {{}} | {{}} |",
            partial(random_scenes, kind),
            (0, 0.02, 0.1, 0.2),
            slow=True,
        )
        for kind, asked in (
            ("pole", "0.2 µas to 200″"),
            ("precession", "2e-6 to 1"),
            ("torque", "8 mas to 5′"),
        )
    ),
    Sentence(
        PAGE, "comes from the kernel for `torque` ({} mas for the\nSun, {} mas", direction_errors
    ),
    Sentence(
        PAGE,
        "that of $H$ for `precession` and `pole` ({} of the rate; {} mas after\ntwenty years)",
        lambda: [relative_error_of_rate(), input_error_of_the_pole()],
    ),
    Sentence(
        PAGE,
        "and where $H$ is given exactly, {} of the rate and the {} to {} µas of the kernel",
        lambda: [
            known_figure_rate(),
            *kernel_of_the_pole(),
        ],
    ),
    Sentence(
        PAGE,
        "The closed forms keep {} (rotor), {}\n(spheroid), and for a top {} or",
        lambda: [
            triaxial.CLOSED_FORM_ERROR,
            spheroid.CLOSED_FORM_ERROR,
            rounding.CLOSED_FORM_ERROR,
        ],
    ),
    Sentence(
        PAGE,
        "is that of $H$, ${}$ (one standard deviation)",
        lambda: EARTH.dynamical_flattening * EARTH.relative_uncertainty["dynamical_flattening"],
    ),
]
TOLD: list[Told | Column | Part] = [
    Told(PAGE, "is the half-width of a {} %\ninterval", ERROR),
    Told(PAGE, "mas/cy at {} %.", ERROR),
    Told(PAGE, "wrong by more than ${}$ of the largest", "held by tests/sky/test_kernel_checks.py"),
    Told(PAGE, "bodies with $H$ from ${}$ to\n${}$", GIVEN),
    Told(PAGE, "longer than {} years begin to see", "the first length at which they do"),
    Told(PAGE, "with the published one before the first position is read: {} ms", BENCH),
    Told(PAGE, "DE421, {} s for DE440, once for each process", BENCH),
    Told(PAGE, "it is opened ({} ms for DE421)", BENCH),
    Told(PAGE, "spins of {} hours to {} days in both senses", GIVEN),
    Told(PAGE, "spans of {} days to {} years)", GIVEN),
    Column(PAGE, REQUESTS, "requests", GIVEN),
    Told(PAGE, "over the cheapest, median | {} % |", "which percentile, a name"),
    Part(PAGE, "## Run times", BENCH),
    Part(PAGE, "## Savings from parts left out", "run time: tests/benchmarks/leaving_out.py"),
]
