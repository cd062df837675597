"""docs/skyfield.md and docs/work_precision.md."""

from __future__ import annotations

import runpy
from functools import cache

import numpy as np

import earthspin
from earthspin.constants import JULIAN_YEAR
from earthspin.sky import iau
from tests.docs.numbers.sentence import ROOT, Sentence, Told

SKYFIELD, WORK = "docs/skyfield.md", "docs/work_precision.md"


@cache
def example() -> float:
    """Declinations of Skyfield's ten lines and of the library in 2026, rad."""
    from skyfield.api import load

    found = runpy.run_path(str(ROOT / "docs/examples/method_in_skyfield.py"))
    t = load.timescale(builtin=True).tdb(2026, range(1, 13), 1)
    declination, _ = found["plain_skyfield"](t)
    ours = found["with_earthspin"](t).sel(perturber="sun").declination.values
    return float(np.radians(np.abs(ours - declination)).max())


def sources_apart(equator: str) -> float:
    """Largest difference of torques by both sources in three years, of the largest torque."""
    worst = 0.0
    for year in (1900, 2000, 2052):
        one, other = (
            earthspin.torque_series(
                f"{year}-01-01", f"{year + 1}-01-01", "3 d", equator=equator, source=source
            ).torque
            for source in ("jplephem", "skyfield")
        )
        off = np.abs(one.values - other.values).max() / np.abs(one.values).max()
        worst = max(worst, float(off))
    return worst


def rates_apart() -> list[float]:
    """Rate of precession and mean torque by both sources, relative."""
    one, other = (earthspin.precession(source=source) for source in ("jplephem", "skyfield"))
    return [
        float(abs(one[name] / other[name] - 1).max()) for name in ("precession_rate", "mean_torque")
    ]


def period_of_the_slow_term() -> float:
    """Of 3 D + 3 l' - l - 2 F, Julian years."""
    rate = np.array([-1, 3, -2, 3, 0]) @ iau.delaunay_rates()
    return float(abs(2 * np.pi / rate) / JULIAN_YEAR)


MEASURED = [
    Sentence(SKYFIELD, "They agree to ${}$ rad in 2026", example, bound=True),
    Sentence(
        SKYFIELD,
        "| torque, mean equator of date | 1900, 2000, 2052 | ${}$ |",
        lambda: sources_apart("mean"),
        factor=3.0,
    ),
    Sentence(
        SKYFIELD,
        "| torque, true equator of date | 1900, 2000, 2052 | ${}$ |",
        lambda: sources_apart("true"),
        factor=3.0,
        slow=True,
    ),
    Sentence(
        SKYFIELD,
        "| rate of precession, mean torque | scene `precession` | ${}$, ${}$ |",
        rates_apart,
        factor=3.0,
        slow=True,
    ),
    Sentence(
        WORK,
        "for no method can it be smaller than\n$T\\sqrt{T/4\\pi QL}$, {} days for 65 years",
        lambda: float(433 * np.sqrt(433 / (4 * np.pi * 100 * 65 * 365.25))),
    ),
    Sentence(WORK, "Its period is {} years, in which the perigee", period_of_the_slow_term),
]
TOLD: list[Told] = []
