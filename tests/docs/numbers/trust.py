"""docs/files.md, stability, testing, and the first two pages."""

from __future__ import annotations

import inspect
import re
import tomllib
from collections.abc import Sequence
from functools import cache, partial
from typing import Any

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin.bodies import MOON
from earthspin.constants import DAY, J2000_JD, JULIAN_YEAR
from earthspin.sky import orbit_table
from tests.docs.numbers.answers import value
from tests.docs.numbers.sentence import ROOT, Part, Sentence, Told

FILES = "docs/files.md"
STABILITY, TESTING = "docs/stability.md", "docs/testing.md"


# --- stability -------------------------------------------------------------------------------


COSTS = (
    "the averaged rate",
    "the axis solver",
    "integrating (L, F)",
    "integrating the full attitude",
)


def project() -> dict[str, Any]:
    """What pyproject.toml says of it."""
    found = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert isinstance(found, dict)
    return found


@cache
def cases() -> xr.Dataset:
    return earthspin.stability()


def measured_again(name: str) -> float:
    return float(abs(cases().measured.sel(case=name)))


def over_days(name: str) -> list[float]:
    """Over how many days the case compares, as it says of itself, and what it measures."""
    (days,) = re.findall(r"over (\d+) d\b", str(cases().held_against.sel(case=name).values))
    return [float(days), measured_again(name)]


def average_and_pole() -> list[float]:
    """What is left of the rate, uas a year, and the rate, arcsec a year."""
    left = measured_again("averaged precession rate and Earth's pole over 93 years")
    return [1e6 * left, value("precession", "/", "precession_rate", perturber="total")]


def exponents() -> list[float]:
    """By how much exponents of the cost are off 1: of all, and of average and pole alone."""
    off = {name: measured_again(f"cost of {name} as the span grows") for name in COSTS}
    return [max(off.values()), max(off["the averaged rate"], off["the axis solver"])]


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


def reach_of_the_orbit() -> float:
    """How far the shipped orbit of the Earth goes, million years."""
    table = orbit_table.shipped("earth")
    assert table is not None
    return table.coverage[1] / JULIAN_YEAR / 1e6


def tolerances_not_named() -> list[float]:
    """What assert_allclose, isclose and approx allow if nothing is said."""
    of_numpy = [
        float(inspect.signature(compare).parameters[name].default)
        for compare, name in ((np.testing.assert_allclose, "rtol"), (np.isclose, "atol"))
    ]
    return [*of_numpy, float(pytest.approx(0.0, rel=1e-15).tolerance)]


def tally() -> Sequence[float]:
    """Of all cases: how many, which must hold, hold, are refused, fail."""
    verdict = cases().verdict.values
    must = cases().must_hold.values
    counts = [int(np.sum(verdict == word)) for word in ("holds", "refused", "fails")]
    return [verdict.size, int(must.sum()), *counts]


MEASURED = [
    *(
        Sentence(STABILITY, text, partial(over_days, name), slow=True)
        for text, name in (
            (
                "- pole and $(L, F)$ step by step over {} days: {} µas",
                "Earth's pole for 30 d: axis solver and integration of (L, F)",
            ),
            (
                "- $(L, F)$ and the whole attitude over {} days: {} µas",
                "Earth's pole for 10 d: integration of (L, F) and of the full attitude",
            ),
            (
                "- a triaxial pole and the whole attitude over {} days: {} µas",
                "Earth's pole with three unequal moments of inertia",
            ),
        )
    ),
    Sentence(
        STABILITY,
        "- average and pole over {} years: they differ",
        lambda: 5 * float(MOON.cycle) / JULIAN_YEAR,
    ),
    Sentence(
        STABILITY,
        "{} µas a year remain of {} arcsec",
        average_and_pole,
        (0, 0.5),
        slow=True,
    ),
    Sentence(
        STABILITY,
        "are 1 within {}\n(within {} for average and pole)",
        exponents,
        bound=True,
        slow=True,
    ),
    Sentence(
        "docs/architecture.md",
        "a float64 then keeps {} µs over a century, where a Julian\n  date keeps {} µs",
        lambda: [1e6 * DAY * np.spacing(days) / 2 for days in (36525.0, 2 * J2000_JD)],
        (0, 1),
    ),
    Sentence(TESTING, "`tests/fuzz` makes {} malformed scenes", malformed),
    Sentence(
        TESTING,
        "allows a difference of ${}$ as well, `isclose(a, b, rtol=1e-15)`\none of ${}$, and "
        "`approx(a, rel=1e-15)` one of ${}$.",
        tolerances_not_named,
    ),
    Sentence(
        STABILITY,
        "\n{} cases, {} of which must hold: {} hold, {} are refused as they should be, {} fail;",
        tally,
        slow=True,
    ),
]
TOLD: list[Told | Part] = [
    Told(STABILITY, "published size, ${}$ arcsec/yr", "published: Capitaine et al. 2003, table 3"),
    Told(TESTING, "calls and requests from fixed seeds ({} s)", "run time: tests/fuzz"),
    Told(TESTING, "days for seconds, {} days for a Julian year", "a planted error, as it is"),
    Told(TESTING, "runs the same with Python {} and", "the version of a program"),
    Told(TESTING, "repeats it with Python {} where", "the version of a program"),
    Told(TESTING, "PYTHON_NEWEST=python{} NEWEST=.venv-{}", "the version of a program"),
    Told(
        FILES,
        "({} MB) are written in {} s and verified in {} s, of which the last line takes {} s",
        "size of a file and run times",
    ),
    Told(
        STABILITY,
        "`--long` adds {} epochs made block by block, which took six\nminutes and {} MB more memory"
        " than {}.",
        "given: the epochs; memory: earthspin stability --long",
    ),
    Told(
        "docs/architecture.md",
        "Skyfield reads them, to the same ${}$",
        "docs/skyfield.md, with what is measured",
    ),
]
