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
from earthspin.sky.ephemeris import find_kernel, open_ephemeris
from earthspin.sky.skyfield import Skyfield
from tests import shipped
from tests.docs.numbers.answers import nutation_between_nodes
from tests.docs.numbers.sentence import ROOT, Sentence, Told

SKYFIELD = "docs/skyfield.md"
#: All that DE421 covers.
DAYS = np.arange(-36000.0, 19000.0, 27.5)


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


def standstills_apart() -> float:
    """Extreme declinations by both sources, over the largest."""
    slow = earthspin.load_scene("precession", {"source": "skyfield"})
    theirs = earthspin.run_tree(slow, "standstills")["standstills"].standstill_declination
    ours = shipped.tree("precession")["standstills"].standstill_declination
    return float(abs(ours - theirs).max() / abs(ours).max())


@cache
def by_skyfield() -> Skyfield:
    return Skyfield(open_ephemeris("de421"))


def matrices_apart() -> float:
    """Largest difference of an element of the mean equator's matrix."""
    theirs = by_skyfield().equator(DAYS, true=False)
    return float(np.abs(theirs - erfa.pmat06(J2000_JD, DAYS)).max())


@cache
def moon() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Declination of the Moon by our source, by Skyfield's own radec, and by ERFA, rad."""
    ours = by_skyfield().radec({"moon": 301}, 399, DAYS, true=True)["moon"][1]
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
        SKYFIELD,
        "| extreme declinations at standstills | scene `precession` | ${}$ |",
        standstills_apart,
        factor=3.0,
        slow=True,
    ),
    Sentence(
        SKYFIELD,
        "precession and bias differs from ERFA's by\n${}$, and the default",
        matrices_apart,
        factor=1.5,
    ),
    Sentence(
        SKYFIELD, "between daily nodes, ${}$ rad. Skyfield", nutation_between_nodes, bound=True
    ),
    Sentence(
        SKYFIELD,
        "declinations change by ${}$ rad by 2030 and by ${}$ rad in 1900",
        by_iau_2006,
    ),
    Sentence(SKYFIELD, "is then within ${}$ rad of ERFA", of_erfa, bound=True),
]
TOLD = [
    Told(SKYFIELD, "tests require agreement to ${}$ of the largest", "tests/sky/test_skyfield.py"),
]
