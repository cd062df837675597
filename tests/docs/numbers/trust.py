"""docs/accuracy.md, files, stability, testing, and the first two pages."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, partial

import numpy as np
import xarray as xr

import earthspin
from earthspin import EARTH
from earthspin.bodies import MOON
from earthspin.constants import ARCSEC
from earthspin.sky.ephemeris import open_ephemeris
from tests import shipped
from tests.docs.numbers.answers import value
from tests.docs.numbers.sentence import ROOT, Part, Sentence, Told

ACCURACY, FILES = "docs/accuracy.md", "docs/files.md"
STABILITY, TESTING = "docs/stability.md", "docs/testing.md"
FIRST, QUICK = "docs/index.md", "docs/quickstart.md"

MAS = ARCSEC / 1e3
BENCH = "run time: make bench"


# --- accuracy --------------------------------------------------------------------------------


def kernel_error(target: int, centre: int, years: float = 0.0) -> list[float]:
    """Claimed of DE421: direction in mas, and distance in m."""
    direction, distance = open_ephemeris("de421").error(target, centre, years * 365.25)
    return [direction / MAS, distance]


def relative_error_of_rate() -> float:
    total = shipped.answer("precession").sel(perturber="total")
    return float(total.precession_rate_error / total.precession_rate)


def input_error() -> float:
    """95 % half-width of the rate by H, mas a century."""
    return 1e5 * value("precession", "/", "precession_rate_error_input", perturber="total")


def pole_error(*span: str, exact: bool = False, of: str = "direction_error") -> float:
    body = EARTH.replace(relative_uncertainty={}) if exact else EARTH
    return float(earthspin.pole(*span, "500 d", body=body)[of].max())


@cache
def windows(taper: str, turns: float) -> list[float]:
    """Rms and largest distance in mas a century, per cent within the error, by DE440."""
    from data_tools import windows as tool

    reach, rate, times = windows_of_de440()
    centres = np.arange(-reach, reach, tool.SPACING)
    rms, largest, share = tool.scatter(rate, times, taper, turns, centres)
    return [rms, largest, 100 * share]


@cache
def windows_of_de440() -> tuple[float, np.ndarray, np.ndarray]:
    from data_tools import windows as tool

    kernel = open_ephemeris("de440")
    half = min(abs(day) for day in kernel.coverage({10, 301, 399})) - 1
    rate, times = tool.rates(kernel, half)
    return times[-1] - 4.01 * MOON.cycle, rate, times


TAPERS = {
    ("plain", 2): "| plain mean, 2 |",
    ("hann", 2): "| Hann, 2 |",
    ("hann", 3): "| Hann, 3 |",
    ("sin4", 3): "| sin⁴, 3 |",
    ("sin4", 4): "| sin⁴, 4 |",
    ("sin4", 8): "| sin⁴, 8 |",
    ("blackman-harris", 5): "| Blackman-Harris, 5 |",
    ("sin4", 4.5): "| sin⁴, 4.5 (not whole) |",
    ("blackman-harris", 4.5): "| Blackman-Harris, 4.5 (not whole) |",
}


def drift(body: str) -> float:
    """How far DE421 and DE440 let axes part from 1901 to 2050, uas."""
    from data_tools.kernels import drifts

    return {words: apart for words, (apart, _) in drifts("de440").items()}[body]


# --- stability -------------------------------------------------------------------------------


@cache
def cases() -> xr.Dataset:
    return earthspin.stability()


def measured_again(name: str) -> float:
    return float(abs(cases().measured.sel(case=name)))


def rows_of_stability() -> list[tuple[str, str]]:
    """Name and measured difference, as printed, of the cases that hold."""
    found = []
    for line in (ROOT / STABILITY).read_text(encoding="utf-8").splitlines():
        cells = line.removeprefix("| ").removesuffix(" |").split(" | ")
        if line.startswith("| ") and cells[-1] == "holds":
            found.append((cells[0], cells[3].split()[0]))
    return found


def malformed() -> float:
    from tests.fuzz.test_fuzz import COUNTS

    return sum(COUNTS.values())


def period() -> float:
    return value("precession", "/", "precession_period", perturber="total")


def epochs_of_the_example() -> float:
    """Minutes from 1900 to 2050, millions."""
    span = np.datetime64("2050-01-01") - np.datetime64("1900-01-01")
    return float(span / np.timedelta64(1, "m") / 1e6)


def tally() -> Sequence[float]:
    """Of all cases: how many, which must hold, hold, are refused, fail."""
    verdict = cases().verdict.values
    must = cases().must_hold.values
    counts = [int(np.sum(verdict == word)) for word in ("holds", "refused", "fails")]
    return [verdict.size, int(must.sum()), *counts]


MEASURED = [
    Sentence(
        ACCURACY,
        "(7.3 mas a century squared along the track, {} mas in 1560)",
        lambda: kernel_error(301, 399, -440)[0],
    ),
    Sentence(
        ACCURACY, "at most {} mas and {} m for the Sun", partial(kernel_error, 10, 399), (0.1, 1)
    ),
    Sentence(
        ACCURACY,
        "for the Sun, {} mas (in 2053) and {} m for\nthe Moon",
        partial(kernel_error, 301, 399),
        (0.1, 0.1),
    ),
    Sentence(
        ACCURACY,
        "and where $H$ is given exactly, 3e-7 of the rate and the 1 to {} µas of the kernel",
        lambda: pole_error("1906-01-01", "1912-01-01", exact=True),
    ),
    Sentence(
        ACCURACY,
        "that of $H$ for `precession` and `pole` ({} of the rate",
        relative_error_of_rate,
    ),
    Sentence(ACCURACY, "(one standard deviation), which is\n{} mas/cy at 95 %.", input_error),
    *(
        Sentence(
            ACCURACY,
            f"{words} {{}} | {{}} | {{}} % |",
            partial(windows, *which),
            within,
            slow=True,
            de440=True,
        )
        for (which, words), within in zip(
            TAPERS.items(), [(50, 5, 0), *[(0, 0, 0)] * 8], strict=True
        )
    ),
    Sentence(
        ACCURACY,
        "| **sin⁴, 5 (the default with DE421)** | **{}** | **{}** | {} % |",
        partial(windows, "sin4", 5),
        slow=True,
        de440=True,
    ),
    Sentence(
        ACCURACY,
        "and by {} µas a century\nfrom it",
        partial(drift, "earth under sun and moon"),
        slow=True,
        de440=True,
    ),
    Sentence(
        ACCURACY,
        "those of Mars by {} µas",
        partial(drift, "mars under sun"),
        slow=True,
        de440=True,
    ),
    *(
        Sentence(STABILITY, text, partial(measured_again, name), slow=True)
        for text, name in (
            (
                "- pole and $(L, F)$ step by step over 30 days: {} µas",
                "spin to precession 10^7: the pole and (L, F) step by step",
            ),
            (
                "- $(L, F)$ and the whole attitude over 10 days: {} µas",
                "spin to precession 10^7: (L, F) and the whole attitude",
            ),
            (
                "- a triaxial pole and the whole attitude over 10 days: {} µas",
                "spin to precession 10^7: three unequal moments",
            ),
        )
    ),
    Sentence(TESTING, "`tests/fuzz` makes {} malformed scenes", malformed),
    Sentence(FIRST, "once round in {} years", period, 0.5),
    Sentence(QUICK, '"torque.zarr")  # {} million epochs', epochs_of_the_example),
    Sentence(
        STABILITY,
        "\n{} cases, {} of which must hold: {} hold, {} are refused as they should be, {} fail;",
        tally,
        slow=True,
    ),
]
TOLD: list[Told | Part] = [
    Part(ACCURACY, "## Run times", BENCH),
    Part(ACCURACY, "## Savings from parts left out", "run time: tests/benchmarks/leaving_out.py"),
    Told(
        FILES,
        "({} MB) are written in {} s and verified in {} s, of which the last line takes {} s",
        "size of a file and run times",
    ),
    Told(
        STABILITY,
        "made block by block, which took six\nminutes and {} MB more memory",
        "memory: earthspin stability --long",
    ),
]
