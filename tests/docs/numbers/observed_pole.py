"""docs/wobble.md: the observed pole, and what excites it."""

from __future__ import annotations

import re
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import earthspin
from data_tools import driven_wobble
from data_tools.free_wobble import DRAWS, RED
from earthspin.sky import eop
from earthspin.sky.eop import LONGEST_DAYS
from earthspin.wobble import presence
from earthspin.wobble.record import BAND, LONGEST_STEP, NEAR
from tests.docs.numbers.answers import fitted, observed, of_c04, value
from tests.docs.numbers.sentence import ROOT, Sentence, Told
from tests.reference import simulation

PAGE = "docs/wobble.md"
#: Memories of red excitation that were tried, d, and the longer spans, years.
MEMORIES, LONG = [memory for _, memory in RED], (65, 130)


@cache
def of_c01(method: str) -> list[float]:
    """Simulated rows of C01 from 1890 to 2022, as `tests/sky/test_eop.py` writes them."""
    from tests.sky.test_eop import rows_of_c01

    time, p = simulation.simulate(132, 433.0, 96.0, step=365.242198781 / 20, seed=4)
    scatter = 20 * np.random.default_rng(1).standard_normal((time.size, 2)) @ [1, 1j]
    with TemporaryDirectory() as folder:
        file = Path(folder) / "eopc01.txt"
        file.write_text(rows_of_c01(11368.5 + time, (p + scatter) / 1e3))
        return fitted(earthspin.polar_motion(file=file), method)


def amplitudes() -> list[float]:
    """Amplitude of the years of the table, mas."""
    text = (ROOT / PAGE).read_text(encoding="utf-8")
    (years,) = re.findall(r"\| year \|([\d |]+)\|", text)
    wobble = earthspin.fit_chandler(observed()).chandler_amplitude
    return [
        float(wobble.sel(time=f"{year.strip()}-01-01", method="nearest")) * 1e3
        if wobble.attrs["units"] == "arcsec"
        else float(wobble.sel(time=f"{year.strip()}-01-01", method="nearest"))
        for year in years.split("|")
    ]


def rows(method: str) -> list[list[str]]:
    """Cells of a table of docs/measured/free-wobble.inc."""
    text = (ROOT / "docs/measured/free-wobble.inc").read_text(encoding="utf-8")
    burg, likelihood = text.split('**`"likelihood"`**')
    lines = (burg if method == "burg" else likelihood).splitlines()
    return [line.strip("| ").split(" | ") for line in lines if re.match(r"\| \d", line)]


def held_by_burg(column: int) -> list[float]:
    """Smallest and largest share of intervals that hold the truth: of T (7), of Q (9)."""
    found = [float(row[column]) for row in rows("burg")]
    return [min(found), max(found)]


def biases(method: str, years: tuple[int, ...], memories: tuple[str, ...]) -> list[float]:
    """Biases in a table for some spans and memories, d."""
    return [
        float(row[4].split(" ± ")[0])
        for row in rows(method)
        if int(row[1]) in years and row[3].strip() in memories
    ]


def largest_biases(method: str) -> list[float]:
    """Largest bias of a method in 25 years, and in 65 years and more, d."""
    memories = ("", "100", "500", "1096", "1826")
    short, long = (biases(method, years, memories) for years in ((25,), LONG))
    return [max(map(abs, short)), 25, max(map(abs, long)), LONG[0]]


def half_widths_over_scatter() -> list[float]:
    """Least and largest quotient of the median half-width and the scatter, of the likelihood."""
    quotients = [float(row[6]) / float(row[5]) for row in rows("likelihood")]
    return [min(quotients), max(quotients)]


def held_by_likelihood() -> list[float]:
    """Smallest and largest share of intervals of T and Q that hold the truth."""
    found = [float(row[k]) for row in rows("likelihood") for k in (7, 9)]
    return [min(found), max(found)]


def last_amplitude() -> list[float]:
    found = earthspin.fit_chandler(observed())
    return [float(found[f"chandler_amplitude{end}"][-1]) for end in ("", "_error")]


def sinusoids() -> list[float]:
    """Bias, scatter and coverage in per cent of the best sinusoid, 200 records of 65 years."""
    from earthspin.wobble import observed as methods

    fits = [methods.fit(*simulation.simulate(65, seed=k), "least-squares") for k in range(200)]
    off = np.array([fit.period for fit in fits]) - 433
    error = np.array([fit.period_error for fit in fits])
    return [float(off.mean()), float(off.std()), float(100 * np.mean(abs(off) <= error))]


def limit() -> float:
    """The least scatter of the period for Q = 100 and 65 years, d."""
    return float(433 * np.sqrt(433 / (4 * np.pi * 100 * 65 * 365.25)))


def cut_by_bridges() -> list[float]:
    """How much of the wobble straight lines over ten days and a tenth of a year cut, %."""
    return [100 * (np.pi * days / NEAR) ** 2 / 2 for days in (10, 36.525)]


def beats() -> list[float]:
    """One and two beats of wobble and year, yr."""
    beat = 1 / (1 / 365.25 - 1 / NEAR) / 365.25
    return [NEAR, 365, beat, 2 * beat]


def coverage_of_a_row() -> float:
    """Standard deviation of a share near 95 per cent in a row of the likelihood, %."""
    return float(100 * np.sqrt(0.95 * 0.05 / DRAWS["likelihood"]))


def under_metres() -> float:
    """Largest radius of the wobble since the middle of 2016, m."""
    found = earthspin.fit_chandler(observed()).chandler_amplitude
    largest = float(found.sel(time=slice("2021-01-01", None)).max())
    return float(np.radians(largest / 3.6e6) * value("polar-motion", "/", "polar_radius"))


def round_trip() -> list[float]:
    """Years of C04, and how well excitation and polar motion give it back, mas."""
    pole = observed()
    back = earthspin.polar_motion_from(earthspin.excitation(pole))
    off = max(float(abs(back[c] - pole[c]).max()) for c in "xy")
    scale = 1e3 if pole.x.attrs["units"] == "arcsec" else 1.0
    years = float((pole.time[-1] - pole.time[0]) / np.timedelta64(1, "D")) / 365.25
    return [years, scale * off]


@cache
def tenfold_by_euler() -> float:
    """Years in which explicit Euler in steps of a day increases a wobble tenfold."""
    return float(2 * np.log(10) / np.log1p((2 * np.pi / NEAR) ** 2) / 365.25)


GIVEN = "given: the truth of a simulation, or what a table is made for"


ERROR = "what an error is, by definition"


LAYOUT = "published: the layout of the tables of the IERS"


MEASURED = [
    Sentence(PAGE, "or at most {} % of the rows; the first is named", lambda: 100 * eop.LOST),
    Sentence(
        PAGE,
        '| {} ± {} d, $Q$ = {} ({} to {}) |\n| `"likelihood"`',
        partial(of_c04, "burg"),
        (0, 0, 0, 0, 50),
    ),
    Sentence(PAGE, "For $Q$ = 100 and {} years that is {} days", lambda: [65, limit()]),
    Sentence(
        PAGE,
        "Burg's contain $T$ in {} to {} %",
        partial(held_by_burg, 7),
    ),
    Sentence(PAGE, "and $Q$ in {} to {} %, the\nlikelihood's", partial(held_by_burg, 9)),
    Sentence(
        PAGE,
        "\n{} ± {} d by Burg's method, with $Q$ = {} ({} to {})",
        partial(of_c01, "burg"),
        (0, 0, 0, 0, 5),
    ),
    Sentence(
        PAGE,
        "and as {} ± {} d by the likelihood, with {} ({} to\n{})",
        partial(of_c01, "likelihood"),
        (0, 0, 0, 0, 5),
        slow=True,
    ),
    Sentence(
        PAGE,
        "restricted likelihood | {} ± {} d, $Q$ = {} ({} to {}) |",
        partial(of_c04, "likelihood"),
        (0, 0, 0, 0, 5),
        slow=True,
    ),
    Sentence(PAGE, "gives no $Q$ | {} ± {} d |", partial(of_c04, "least-squares"), slow=True),
    Sentence(
        PAGE,
        "The last window of the table to September 2026 has its middle in June 2023: {} ± {} mas",
        last_amplitude,
    ),
    Sentence(
        PAGE,
        "Burg's bias is at most {} d in {} years and {} d in {} years and more",
        partial(largest_biases, "burg"),
    ),
    Sentence(
        PAGE,
        "The likelihood's is at most {} d\nin {} years and {} d in {} years and more",
        partial(largest_biases, "likelihood"),
    ),
    Sentence(PAGE, "contain both in {} to {} % of each row", held_by_likelihood),
    Sentence(PAGE, "are {} to {} times the scatter, where 2", half_widths_over_scatter),
    Sentence(
        PAGE,
        "is down to {} for a true 180",
        lambda: min(float(row[8]) for row in rows("likelihood") if row[0] == "180"),
    ),
    Sentence(
        PAGE,
        "One milliarcsecond is {} cm on the ground",
        lambda: 100 * np.radians(1 / 3.6e6) * value("polar-motion", "/", "polar_radius"),
    ),
    Sentence(
        PAGE,
        "has a bias of {} d and a scatter of {} d, and its error\ncontains the true value in {} %",
        sinusoids,
        slow=True,
    ),
    Sentence(PAGE, "| amplitude, mas |" + " {} |" * 9, amplitudes),
    Sentence(
        PAGE,
        "gaps up to ten steps and {} days. These",
        lambda: LONGEST_DAYS,
    ),
    Sentence(
        PAGE, "a fraction $(\\pi D/T)^2/2$: {} % over ten days, {} % over the tenth", cut_by_bridges
    ),
    Sentence(PAGE, "All methods accept steps up to {} days", lambda: LONGEST_STEP),
    Sentence(PAGE, "with known parameters: $T$ = {} d, with seasons", lambda: NEAR),
    Sentence(
        PAGE,
        "its correlation time: {} to {} days were tested.",
        lambda: [min(MEMORIES), max(MEMORIES)],
    ),
    Sentence(PAGE, "determine the percentage to {} %", coverage_of_a_row),
    Sentence(
        PAGE,
        "To separate {} from {} days takes\none beat, {} years; "
        "the methods require two beats, {} years",
        beats,
    ),
    Sentence(
        PAGE,
        "the power between {} and {} days is compared",
        lambda: BAND,
    ),
    Sentence(
        PAGE,
        "on either side ({} to {} and {} to {} days)",
        lambda: [*presence.SLOWER[::-1], *presence.FASTER[::-1]],
    ),
    Sentence(PAGE, "It is under {} m now", under_metres, bound=True),
    Sentence(
        PAGE,
        "Applied one after the other to {} years of daily\nvalues, they reproduce C04 within",
        lambda: round_trip()[0],
        1.0,
    ),
    Sentence(PAGE, "they reproduce C04 within ${}$ mas", lambda: round_trip()[1], bound=True),
    Sentence(PAGE, "increases an undamped wobble tenfold in {} years", tenfold_by_euler),
    Sentence(
        PAGE,
        "at prograde periods of {} to {} days",
        lambda: driven_wobble.BAND,
    ),
    Sentence(
        PAGE,
        "poles with a period of {} d, driven by the same excitation plus a random rest of {} mas",
        lambda: [NEAR, driven_wobble.DENSITY],
    ),
    Sentence(
        PAGE,
        "intervals that contain the truth, of {} poles in each row",
        lambda: [driven_wobble.DRAWS],
    ),
]
TOLD = [
    Told(PAGE, "All errors are {} %", ERROR),
    Told(PAGE, "the percentage of the {} %\nintervals that contain", ERROR),
    Told(PAGE, "| {} year from 1846, {} year from 1890 |", LAYOUT),
    Told(PAGE, '(`"least-squares"`, 200 records of {} years', GIVEN),
    Told(PAGE, "A span of {} years determines $Q$ only", GIVEN),
    Told(PAGE, "simulated wobbles pass, even in {}\nyears", GIVEN),
    Told(
        PAGE, "has a circle of {} m, a cone of {} arcsec and a period of {} days", "the source text"
    ),
    Told(PAGE, "A simulated pole of {} days and", GIVEN),
    Told(PAGE, "with errors of {} mas, is recovered", GIVEN),
    Told(PAGE, "found {} ± {} d, one", "published: Nastula & Gross 2015"),
    Told("docs/coverage.md", "$T$ = {} d, $Q$ = 50", GIVEN),
    Told("docs/coverage.md", "excitation with 30 and {} % of", GIVEN),
    Told(PAGE, "times the scatter, where {} is expected", ERROR),
    Told(PAGE, "For memories outside {} to {} days", GIVEN),
    Told(PAGE, "down to 98 for a true {}", GIVEN),
    Told(PAGE, "its likelihood takes {} s for {} years in steps", "run times on one machine"),
    Told(PAGE, "that of block means {} ms, and", "a run time on one machine"),
    Told(
        PAGE,
        "the bias was {} ± {} d with a memory fixed at {} d, and is\n{} ± {} d ({} years, 40",
        "measured with simulated records when the memory became a parameter",
    ),
    Told(PAGE, "in 94 to {} % of [640 other records](coverage.md) of 65 and {} years", GIVEN),
]
