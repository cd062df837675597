"""Precession of the planets and the Moon beside what is published, for docs/worlds.md."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

import earthspin
from earthspin.bodies import BODIES, PLANETS, proper
from earthspin.bodies.earth_moon_sun import MOON_OBLIQUITY
from earthspin.bodies.giants import JUPITER_CONSTANT, SATURN_CONSTANT
from earthspin.bodies.inner import MARS_PRECESSION, MERCURY_OBLIQUITY, VENUS_PRECESSION
from earthspin.bodies.moons import TITAN_OBLIQUITY, TITAN_OBLIQUITY_IF_SOLID
from earthspin.constants import NORMAL_95, PSI_A_RATE, UNVERIFIED, Constant
from earthspin.errors import EarthspinError
from earthspin.questions.cassini_states import CassiniStates
from earthspin.questions.precession import Precession

#: Signs of units, and their size in degrees; obliquities below `SMALL` (deg) are in minutes of arc.
UNITS, SMALL = {"arcmin": "′", "deg": "°"}, 0.1
PAGE = Path(__file__).parents[1] / "docs" / "measured" / "worlds.inc"
#: Start of the reason in a comparison with the observation that the body's numbers come from.
CIRCULAR = "circular: "
#: Entry of a half-width if the sizes of neglected effects are not known.
UNKNOWN = "unknown"


@dataclass(frozen=True)
class Published:
    """A published number, and the reason for the difference from ours.

    Attributes
    ----------
    number : Constant or None
        Rate (arcsec/yr) or obliquity (arcmin or deg); None if it is not known here.
    why : str
        Reason for the difference, `CIRCULAR` first where ours comes from the same observation; or
        what is missing.
    of_constant : bool
        Whether the number is the rate over the cosine of the obliquity.
    """

    number: Any
    why: str
    of_constant: bool = False

    @property
    def half_width(self) -> str:
        """Half-width of the 95 % interval as text; empty if it is not known."""
        if self.number is None or self.number.uncertainty is None:
            return ""
        return f"{NORMAL_95 * self.number.uncertainty:.2g}"


#: Rates of precession.
PUBLISHED = {
    "venus": Published(VENUS_PRECESSION, f"{CIRCULAR}the moment was inferred from this rate"),
    "earth": Published(
        PSI_A_RATE,
        f"{CIRCULAR}$H$ comes from observed precession; geodesic precession and other effects "
        "are left out",
    ),
    "mars": Published(
        MARS_PRECESSION,
        f"{CIRCULAR}the moment was inferred from this rate; geodesic precession is left out",
    ),
    "jupiter": Published(
        JUPITER_CONSTANT,
        "published to two digits; with all satellites in the equator the computed rate would be "
        "2.645, and the linear part of the pole of IAU 2015 moves at 2.444",
        True,
    ),
    "saturn": Published(
        SATURN_CONSTANT, "satellites in both; the published constant has two digits", True
    ),
}


#: Obliquities to the own orbit.
OBSERVED = {
    "mercury": Published(
        MERCURY_OBLIQUITY, f"{CIRCULAR}the moment was inferred from this obliquity"
    ),
    "moon": Published(
        MOON_OBLIQUITY,
        "a solid body on a mean ellipse: the Sun disturbs the orbit (0.023°), another mean "
        "inclination is in use (0.012°), turns count from the node (0.008°)",
    ),
    "titan": Published(
        TITAN_OBLIQUITY,
        f"a solid body: for one {TITAN_OBLIQUITY_IF_SOLID.value:g}° are published "
        f"({TITAN_OBLIQUITY_IF_SOLID.source}); a shell on an ocean leans more",
    ),
    "phobos": Published(None, "no observed obliquity to its own orbit is known here"),
    "iapetus": Published(None, "J2 and the moments were never measured"),
    "triton": Published(None, "J2 and the moments were never measured"),
}


@dataclass(frozen=True)
class World:
    """One row: a rate of precession, or the obliquity of a locked spin.

    Attributes
    ----------
    name : str
    obliquity : float
        To the orbit, deg; of a locked spin, that of the lowest upright Cassini state.
    error : float
        Half-width from the input numbers, of the rate (arcsec/yr) or of the obliquity (deg).
    left_out : float
        Sum of the sizes of what the model leaves out, in the unit of `error`; NaN if not known.
    rate, period, period_error, published : float
        Rate (arcsec/yr), its period and half-width (yr), and the published rate with the sign that
        it has here.
    refused : str
        Why there is no answer; empty if there is.
    """

    name: str
    obliquity: float = math.nan
    error: float = math.nan
    left_out: float = math.nan
    rate: float = math.nan
    period: float = math.nan
    period_error: float = math.nan
    published: float = math.nan
    refused: str = ""

    def in_all(self, factor: float = 1.0) -> str:
        """Half-width plus the sizes of what is left out; `UNKNOWN` if these are not known."""
        whole = factor * (self.error + self.left_out)
        return UNKNOWN if math.isnan(whole) else f"{whole:.2g}"


def left_out(tree: xr.DataTree) -> float:
    """Sum of the sizes of what a model leaves out, in the unit of its section; NaN if not known.

    The nodes of satellites do not count: they move the pole about the mean that has this rate.
    """
    sizes = tree["neglected"].neglected_effect
    if not sizes.size or sizes.attrs.get("of_unknown_size"):
        return math.nan
    periodic = sizes.attrs.get("zero_in_the_mean", "").split("; ")
    return float(abs(sizes[~np.isin(sizes["effect"].values, periodic)]).sum())


def world(name: str) -> World:
    """Row of a body that precesses, with its own perturbers."""
    try:
        tree = earthspin.run_tree(Precession(body=name), ["neglected"])
    except EarthspinError as error:
        return World(name, refused=str(error))
    answer = tree.to_dataset().isel(perturber=-1)
    rate, half_width, period, period_error = (
        float(answer[f"precession_{name}"])
        for name in ("rate", "rate_error", "period", "period_error")
    )
    obliquity = float(answer.obliquity)
    published = PUBLISHED[name]
    along = math.cos(math.radians(obliquity)) if published.of_constant else 1.0
    size = math.copysign(published.number.value * along, rate)
    return World(
        name, obliquity, half_width, left_out(tree), rate, period, period_error, published=size
    )


def worlds() -> list[World]:
    """All planets and the Moon."""
    return [world(name) for name in (*PLANETS, "moon") if name in BODIES]


def locked_spin(name: str) -> World:
    """Row of a body in the Cassini state that it is in."""
    try:
        tree = earthspin.run_tree(CassiniStates(body=name), ["neglected"])
    except EarthspinError as error:
        return World(name, refused=str(error))
    first = tree.to_dataset().isel(state=0)  # for the Moon state 2, the only upright one
    return World(name, float(first.obliquity), float(first.obliquity_error), left_out(tree))


def locked() -> list[World]:
    """Mercury and the moons."""
    return [locked_spin(name) for name in OBSERVED]


def table(rows: list[World]) -> str:
    """The rows in Markdown: first those that precess, then those that are refused."""
    lines = [
        "| world | obliquity (°) | rate (″/yr) | ± input numbers | ± in all | period (yr) "
        "| published (″/yr) | ± | source |",
        "|---|---:|---:|---:|---:|---:|---:|---:|---|",
    ]
    for row in rows:
        if not row.refused:
            known = PUBLISHED[row.name]
            source = _short(known.number)
            lines.append(
                f"| {proper(row.name)} | {row.obliquity:.2f} | {_to(row.error, row.rate)} "
                f"| {row.error:.2g} | {row.in_all()} | {_to(row.period_error, row.period)} "
                f"| {row.published:.4g} | {known.half_width} | {source} |"
            )
    return "\n".join([*lines, *_reasons("world", "rate", PUBLISHED, PUBLISHED, rows), ""])


def table_of_locked(rows: list[World]) -> str:
    """The locked spins in Markdown: those that have states, then those that are refused."""
    lines = [
        "| locked spin | obliquity to its orbit | ± input numbers | ± in all | observed | ± "
        "| source |",
        "|---|---:|---:|---:|---:|---:|---|",
    ]
    for row in rows:
        if row.refused:
            continue
        known = OBSERVED[row.name]
        sign, factor = ("′", 60.0) if row.obliquity < SMALL else ("°", 1.0)
        error = f"{factor * row.error:.2g}{sign}" if row.error else ""
        whole = row.in_all(factor) + (sign if row.in_all() != UNKNOWN else "")
        columns = " |  | "
        if known.number is not None:
            unit = UNITS[known.number.unit]
            half = known.half_width and known.half_width + unit
            columns = f"{known.number.value:g}{unit} | {half} | {known.number.source}"
        lines.append(
            f"| {proper(row.name)} | {factor * row.obliquity:.3g}{sign} | {error} "
            f"| {whole} | {columns} |"
        )
    names = [row.name for row in rows]
    return "\n".join([*lines, *_reasons("locked spin", "state", OBSERVED, names, rows), ""])


def _short(number: Constant) -> str:
    """Authors and year of the source of a number, with a mark if it is not verified."""
    cited = re.match(r".*?\b\d{4}", number.source)
    authors = number.source if cited is None else cited[0]
    return authors if number.verified else f"{authors} ({UNVERIFIED})"


def _reasons(
    head: str, answer: str, known: Mapping[str, Published], names: Iterable[str], rows: list[World]
) -> list[str]:
    """Tables of the reasons for differences, and for refusals."""
    why = [f"| {proper(name)} | {known[name].why} |" for name in names]
    refused = [f"| {proper(row.name)} | {row.refused} |" for row in rows if row.refused]
    return [
        *("", f"| {head} | reason for the difference |", "|---|---|", *why),
        *("", f"| {head} | why there is no {answer} |", "|---|---|", *refused),
    ]


def _to(error: float, value: float) -> str:
    """A value to the second digit of its error."""
    digits = 1 - math.floor(math.log10(error))
    return f"{round(value, digits):,.{max(0, digits)}f}"


def main() -> int:
    """Write the tables."""
    PAGE.write_text(f"{table(worlds())}\n{table_of_locked(locked())}", encoding="utf-8")
    return 0
