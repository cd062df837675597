"""docs/skyfield.md."""

from __future__ import annotations

import runpy
from contextlib import closing
from functools import cache

import erfa
import numpy as np
from numpy.typing import NDArray
from skyfield.api import load, load_file

import earthspin
from earthspin.constants import J2000_JD
from earthspin.sky import iau
from earthspin.sky.ephemeris import find_kernel, open_ephemeris
from earthspin.sky.skyfield import Skyfield
from tests import shipped
from tests.docs.numbers.answers import nutation_between_nodes
from tests.docs.numbers.sentence import ROOT, Sentence, Told

SKYFIELD = "docs/skyfield.md"
#: All that DE421 covers.
DAYS = np.arange(-36000.0, 19000.0, 27.5)


@cache
def plain() -> dict[str, float]:
    """Rates of precession by the chain in plain Skyfield, arcsec/yr."""
    example = runpy.run_path(str(ROOT / "docs/examples/method_in_skyfield.py"))
    rates: dict[str, float] = example["plain_skyfield"]()
    return rates


def example() -> float:
    """Largest relative difference of the rates by plain Skyfield and by the library."""
    ours = shipped.answer("precession").precession_rate
    return max(abs(rate / float(ours.sel(perturber=name)) - 1) for name, rate in plain().items())


def periods() -> list[float]:
    """Period by plain Skyfield, and by the library with its half-width, years."""
    total = shipped.answer("precession").isel(perturber=-1)
    by_hand = 360 * 3600 / sum(plain().values())
    return [by_hand, float(total.precession_period), float(total.precession_period_error)]


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


def standstills_apart() -> float:
    """Extreme declinations by both sources, over the largest."""
    fast = earthspin.load_scene("precession", {"source": "jplephem"})
    theirs = earthspin.run_tree(fast, "standstills")["standstills"].standstill_declination
    ours = shipped.tree("precession")["standstills"].standstill_declination
    return float(abs(ours - theirs).max() / abs(ours).max())


@cache
def by_skyfield() -> Skyfield:
    return Skyfield(open_ephemeris("de421"))


def matrices_apart() -> float:
    """Largest difference of an element of the mean equator's matrix."""
    theirs = by_skyfield().equator(DAYS)
    return float(np.abs(theirs - erfa.pmat06(J2000_JD, DAYS)).max())


@cache
def moon() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Declination of the Moon by our source, by Skyfield's own radec, and by ERFA, rad."""
    ours = by_skyfield().radec({"moon": 301}, 399, DAYS, iau.true_equator)["moon"][1]
    with closing(load_file(str(find_kernel("de421")))) as kernel:
        at = (kernel["moon"] - kernel["earth"]).at(
            load.timescale(builtin=True).tdb_jd(J2000_JD, DAYS)
        )
        _, plain, _ = at.radec("date")
        x, y, z = np.einsum("tij,jt->it", erfa.pnm06a(J2000_JD, DAYS), at.position.m)
    return ours, np.asarray(plain.radians), np.arctan2(z, np.hypot(x, y))


def by_iau_2006() -> list[float]:
    """What IAU 2006 changes: until 2030, and at most, which is in 1900, rad."""
    ours, plain, _ = moon()
    off = np.abs(ours - plain)
    return [float(off[abs(DAYS) < 30 * 365.25].max()), float(off.max())]


def of_erfa() -> float:
    ours, _, exact = moon()
    return float(np.abs(ours - exact).max())


MEASURED = [
    Sentence(SKYFIELD, "The rates agree to ${}$; the period", example, bound=True),
    Sentence(
        SKYFIELD,
        "the plain function is {} years, and that of earthspin\n{} ± {}",
        periods,
    ),
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
        SKYFIELD,
        "| extreme declinations at standstills | scene `precession` | ${}$ |",
        standstills_apart,
        factor=3.0,
        slow=True,
    ),
    Sentence(
        SKYFIELD,
        "precession and bias differs from ERFA's by\n${}$, and the fast reader",
        matrices_apart,
        factor=1.5,
    ),
    Sentence(SKYFIELD, "between daily nodes, ${}$ rad.\n", nutation_between_nodes, bound=True),
    Sentence(
        SKYFIELD,
        "declinations change by ${}$ rad by 2030 and by ${}$ rad in 1900",
        by_iau_2006,
    ),
    Sentence(SKYFIELD, "declinations are then within ${}$ rad of\nERFA", of_erfa, bound=True),
]
TOLD = [
    Told(SKYFIELD, "tests require agreement to ${}$ of the largest", "tests/sky/test_skyfield.py"),
]
