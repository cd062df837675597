"""docs/files.md, stability, testing, and the first two pages."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, partial

import numpy as np
import xarray as xr

import earthspin
from earthspin.constants import ARCSEC
from tests.docs.numbers.answers import value
from tests.docs.numbers.sentence import ROOT, Part, Sentence, Told

FILES = "docs/files.md"
STABILITY, TESTING = "docs/stability.md", "docs/testing.md"
FIRST, QUICK = "docs/index.md", "docs/quickstart.md"

MAS = ARCSEC / 1e3
BENCH = "run time: make bench"


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
