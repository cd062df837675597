"""Numbers on the pages of the docs are those of the program: a sample of each page.

Each entry finds a number in the text by what stands around it, computes it again, and demands that
they agree to half a unit of the last digit that is printed, or to what is said.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH
from earthspin.constants import ARCSEC
from earthspin.sky.ephemeris import open_ephemeris
from tests import shipped

DOCS = Path(__file__).parents[2] / "docs"
MAS_A_CENTURY = 1e5  # of an arcsecond a year


class Number(NamedTuple):
    """A number on a page.

    Attributes
    ----------
    page : str
    around : str
        Regular expression with one group, the number.
    value : callable
        It again.
    unit : float
        Half-width of agreement; 0 for half a unit of the last printed digit.
    """

    page: str
    around: str
    value: Callable[[], float]
    unit: float = 0.0


@cache
def axes() -> dict[str, np.ndarray]:
    """The three axes under Sun and Moon from 1980 to 2020, mas."""
    path = earthspin.pole("1980-01-01", "2020-01-01", "5 d", effects=["second-order"])
    return {
        str(axis): np.stack([path.sel(axis=axis)[c].values for c in "XYZ"], axis=-1) / ARCSEC * 1e3
        for axis in path.axis.values
    }


def apart(one: str, other: str) -> np.ndarray:
    """One axis less another, mas, shape (t, 3)."""
    return axes()[one] - axes()[other]


def budget(effect: str) -> float:
    """Share of an effect in the rate of psi_A by DE421, mas a century."""
    return float(shipped.answer("iau").psi_rate.sel(effect=effect)) * MAS_A_CENTURY


def inferred(name: str, origin: str) -> float:
    section = shipped.tree("iau")["inferred_flattening"]
    return float(section[name].sel(origin=origin))


def nutation(term: str, name: str) -> float:
    return float(shipped.tree("iau")["nutation"][name].sel(term=term))


def rung(name: str) -> float:
    return float(shipped.answer("wobble").period_solar.sel(rung=name))


def mars() -> xr.Dataset:
    return earthspin.wobble_ladder(body="mars").sel(rung="fluid-core")


def exact_pole(first: str, last: str) -> float:
    exact = EARTH.replace(relative_uncertainty={})
    return float(earthspin.pole(first, last, "500 d", body=exact).direction_error.max())


NUMBERS = [
    Number(
        "pole.md",
        r"It stands ([\d.]+) mas from the angular momentum on average",
        lambda: float(np.linalg.norm(apart("figure", "angular_momentum").mean(axis=0))),
    ),
    Number(
        "pole.md",
        r"swings about that by ([\d.]+) and 5.2 mas rms",
        lambda: float(apart("figure", "angular_momentum").std(axis=0)[0]),
    ),
    Number(
        "pole.md",
        r"([\d.]+) mas from the angular momentum on average and swings by 0.018",
        lambda: float(np.linalg.norm(apart("rotation", "angular_momentum").mean(axis=0))),
    ),
    Number(
        "pole.md",
        r"swings by ([\d.]+) and 0.017 mas rms",
        lambda: float(apart("rotation", "angular_momentum").std(axis=0)[0]),
    ),
    Number("pole.md", r"\| planets \| \+31.326 \| \+([\d.]+) \|", lambda: budget("planets")),
    Number("pole.md", r"\| J4 \| \+2.521 \| \+([\d.]+) \|", lambda: budget("j4")),
    Number("pole.md", r"\| geodesic \| -1919.841 \| (-[\d.]+) \|", lambda: budget("geodesic")),
    Number(
        "pole.md", r"\| second order \| -45.954 \| (-[\d.]+) \|", lambda: budget("second-order")
    ),
    Number(
        "pole.md",
        r"\*\*closure\*\* \| \*\*-3.39\*\* \| \*\*(-[\d.]+)\*\*",
        lambda: float(shipped.answer("iau").closure) * MAS_A_CENTURY,
    ),
    Number(
        "pole.md",
        r"\$I = 0.330799\\,M R\^2\$ \| 0.0032730 \| ([\d.]+) \|",
        lambda: inferred("polar_moment", "PREM"),
    ),
    Number(
        "pole.md",
        r"from the IAU's rate, by our theory \| ([\d.]+) ",
        lambda: inferred("flattening", "from the IAU's rate"),
        2e-10,
    ),
    Number(
        "accuracy.md",
        r"grow with the square .*?, (\d+) mas in 1560",
        lambda: open_ephemeris("de421").error(301, 399, -440 * 365.25)[0] / ARCSEC * 1e3,
    ),
    Number(
        "accuracy.md",
        r"at most ([\d.]+) mas and 23 m for the Sun",
        lambda: open_ephemeris("de421").error(10, 399)[0] / ARCSEC * 1e3,
    ),
    Number(
        "accuracy.md",
        r"3e-7 of the rate and the 1 to (\d+) µas of the kernel",
        lambda: exact_pole("1906-01-01", "1912-01-01"),
    ),
    Number(
        "accuracy.md",
        r"that of \$H\$ for `precession` and `pole` \(([\d.]+e-7) of the rate",
        lambda: float(
            (a := earthspin.precession().isel(perturber=-1)).precession_rate_error
            / a.precession_rate
        ),
    ),
    Number(
        "wobble.md",
        r"gives −([\d.]+) d\. The observed −430 d",
        lambda: -float(shipped.tree("wobble")["core_nutation"].free_core_nutation[0]),
    ),
    Number(
        "wobble.md", r"\n([\d.]+) ± 6.3 days, against 206.9", lambda: float(mars().period_solar)
    ),
    Number(
        "wobble.md",
        r"203.2 ± ([\d.]+) days, against 206.9",
        lambda: float(mars().period_solar_error),
    ),
]


def told(number: Number) -> str:
    """The number as it is printed."""
    text = (DOCS / number.page).read_text(encoding="utf-8")
    found = re.findall(number.around, text, flags=re.DOTALL)
    assert len(found) == 1, f"{number.around!r} stands {len(found)} times in {number.page}"
    return str(found[0])


def half_a_unit(printed: str) -> float:
    """Half a unit of the last printed digit."""
    mantissa, _, power = printed.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 0.5 * 10.0 ** (int(power or 0) - decimals)


@pytest.mark.parametrize("number", NUMBERS, ids=lambda n: f"{n.page} {n.around[:40]}")
def test_a_number_of_the_docs_is_that_of_the_program(number: Number) -> None:
    printed = told(number)
    allowed = number.unit or half_a_unit(printed) * (1 + 1e-6)
    assert abs(float(printed) - number.value()) <= allowed


def test_half_a_unit_of_what_is_printed() -> None:
    assert half_a_unit("31.349") == pytest.approx(5e-4, rel=1e-12, abs=0)
    assert half_a_unit("6.5e-7") == pytest.approx(5e-9, rel=1e-12, abs=0)
    assert half_a_unit("146") == 0.5
