"""Precession of the planets and the Moon beside what is published, for docs/worlds.md."""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

import earthspin
from earthspin.bodies import BODIES, PLANETS, proper
from earthspin.bodies.giants import JUPITER_CONSTANT, SATURN_CONSTANT
from earthspin.bodies.inner import MERCURY_OBLIQUITY, VENUS_PRECESSION
from earthspin.bodies.mars import PRECESSION as MARS_PRECESSION
from earthspin.bodies.moon import OBLIQUITY as MOON_OBLIQUITY
from earthspin.bodies.moons import TITAN_OBLIQUITY, TITAN_OBLIQUITY_IF_SOLID
from earthspin.constants import PSI_A_RATE, Constant
from earthspin.errors import EarthspinError
from earthspin.questions.cassini_states import CassiniStates
from earthspin.questions.precession import Precession
from earthspin.views.table import NUMBERS_ONLY, some_unknown

#: Signs of units; smaller obliquities stand in minutes of arc, deg.
UNITS, SMALL = {"arcmin": "′", "deg": "°"}, 0.1
PAGE = Path(__file__).parents[1] / "docs" / "worlds.md"
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"

#: Said of a comparison with the observation that the body's own numbers come from.
CIRCULAR = "circular: "


@dataclass(frozen=True)
class Published:
    """A published rate, and the reason for the difference from ours.

    Attributes
    ----------
    rate : Constant
        arcsec/yr.
    of_constant : bool
        Whether it is the rate over the cosine of the obliquity.
    why : str
        Reason for the difference; `CIRCULAR` first where ours comes from the same observation.
    """

    rate: Constant
    of_constant: bool
    why: str


PUBLISHED = {
    "venus": Published(
        VENUS_PRECESSION, False, f"{CIRCULAR}the moment was inferred from this rate"
    ),
    "earth": Published(
        PSI_A_RATE,
        False,
        f"{CIRCULAR}$H$ comes from observed precession; geodesic precession and other effects "
        "are left out",
    ),
    "mars": Published(
        MARS_PRECESSION,
        False,
        f"{CIRCULAR}the moment was inferred from this rate; geodesic precession is left out",
    ),
    "jupiter": Published(JUPITER_CONSTANT, True, "the published value has two digits"),
    "saturn": Published(
        SATURN_CONSTANT, True, "Iapetus is excluded here and partly included in the published rate"
    ),
}


@dataclass(frozen=True)
class World:
    """One row: ours and theirs.

    Attributes
    ----------
    name : str
    obliquity : float
        To the orbit, degrees.
    rate, error : float
        Size of the rate of precession and its 95 % half-width from the input numbers, arcsec/yr.
    left_out : float
        Sum of the sizes of what the model leaves out, arcsec/yr; NaN if they are not known.
    period, period_error : float
        Years.
    published : float
        Size of the rate along the orbit, arcsec/yr.
    refused : str
        Why there is no rate; empty if there is.
    """

    name: str
    obliquity: float = math.nan
    rate: float = math.nan
    error: float = math.nan
    left_out: float = math.nan
    period: float = math.nan
    period_error: float = math.nan
    published: float = math.nan
    refused: str = ""


def world(name: str) -> World:
    """Row of a body, pulled on by what pulls on it."""
    try:
        tree = earthspin.run_tree(Precession(body=name), ["neglected"])
    except EarthspinError as error:
        return World(name, refused=str(error))
    answer = tree.to_dataset().isel(perturber=-1)
    obliquity = float(answer.obliquity)
    published = PUBLISHED[name]
    along = math.cos(math.radians(obliquity)) if published.of_constant else 1.0
    return World(
        name,
        obliquity,
        abs(float(answer.precession_rate)),
        float(answer.precession_rate_error),
        left_out(tree),
        float(answer.precession_period),
        float(answer.precession_period_error),
        abs(published.rate.value) * along,
    )


def left_out(tree: xr.DataTree) -> float:
    """Sum of the sizes of what a model leaves out, in the unit of its section; NaN if not known."""
    section = tree["neglected"].to_dataset()
    sizes = section.neglected_effect.values
    return float(np.abs(sizes).sum()) if sizes.size and not some_unknown(section) else math.nan


def in_all(error: float, left_out: float, sign: str = "") -> str:
    """Write a half-width plus the sizes of what is left out; say so if these are not known."""
    return NUMBERS_ONLY if math.isnan(left_out) else f"{error + left_out:.2g}{sign}"


def worlds() -> list[World]:
    """All planets and the Moon."""
    return [world(name) for name in (*PLANETS, "moon") if name in BODIES]


def table(rows: list[World]) -> str:
    """The rows in Markdown: first those that precess, then those that are refused."""
    lines = [
        "| world | obliquity (°) | rate (″/yr) | ± input numbers | ± in all | period (yr) "
        "| published (″/yr) | ± | source |",
        "|---|---:|---:|---:|---:|---:|---:|---:|---|",
    ]
    for row in rows:
        if row.refused:
            continue
        known = PUBLISHED[row.name].rate
        error = "" if known.uncertainty is None else f"{1.96 * known.uncertainty:.2g}"
        lines.append(
            f"| {proper(row.name)} | {row.obliquity:.2f} | {_to(row.error, row.rate)} "
            f"| {row.error:.2g} | {in_all(row.error, row.left_out)} "
            f"| {_to(row.period_error, row.period)} "
            f"| {row.published:.4g} | {error} | {known.source} |"
        )
    lines += ["", "| world | reason for the difference |", "|---|---|"]
    lines += [f"| {proper(name)} | {published.why} |" for name, published in PUBLISHED.items()]
    lines += ["", "| world | why there is no rate |", "|---|---|"]
    lines += [f"| {proper(row.name)} | {row.refused} |" for row in rows if row.refused]
    return "\n".join([*lines, ""])


@dataclass(frozen=True)
class Observed:
    """Where an axis is observed to stand, and the reason for the difference from ours.

    Attributes
    ----------
    obliquity : Constant or None
        To its own orbit, arcmin or deg; None if it is not known here.
    why : str
        Reason for the difference, `CIRCULAR` first where ours comes from the same observation; or
        what is missing.
    """

    obliquity: Constant | None
    why: str


OBSERVED = {
    "mercury": Observed(
        MERCURY_OBLIQUITY, f"{CIRCULAR}the moment was inferred from this obliquity"
    ),
    "moon": Observed(
        MOON_OBLIQUITY,
        "a solid body on a mean ellipse: the Sun disturbs the orbit (0.023°), another mean "
        "inclination is in use (0.012°), turns count from the node (0.008°)",
    ),
    "titan": Observed(
        TITAN_OBLIQUITY,
        f"a solid body: for one {TITAN_OBLIQUITY_IF_SOLID.value:g}° are published "
        f"({TITAN_OBLIQUITY_IF_SOLID.source}); a shell on an ocean leans more",
    ),
    "phobos": Observed(None, "no observed obliquity to its own orbit is known here"),
    "iapetus": Observed(None, "J2 and the moments were never measured"),
    "triton": Observed(None, "J2 and the moments were never measured"),
}


@dataclass(frozen=True)
class Locked:
    """A spin that is locked: where its axis stands, ours and observed.

    Attributes
    ----------
    name : str
    obliquity, error : float
        To its own orbit, of the lowest upright Cassini state, and half-width from the input
        numbers, deg.
    left_out : float
        Sum of the sizes of what the model leaves out, deg; NaN if they are not known.
    refused : str
        Why there is none; empty if there is.
    """

    name: str
    obliquity: float = math.nan
    error: float = math.nan
    left_out: float = math.nan
    refused: str = ""


def locked_spin(name: str) -> Locked:
    """Row of a body in the Cassini state that it is in."""
    try:
        tree = earthspin.run_tree(CassiniStates(body=name), ["neglected"])
    except EarthspinError as error:
        return Locked(name, refused=str(error))
    first = tree.to_dataset().isel(state=0)  # for the Moon state 2, the only upright one
    return Locked(name, float(first.obliquity), float(first.obliquity_error), left_out(tree))


def locked() -> list[Locked]:
    """Mercury and the moons."""
    return [locked_spin(name) for name in OBSERVED]


def table_of_locked(rows: list[Locked]) -> str:
    """The locked spins in Markdown: those that have states, then those that are refused."""
    lines = [
        "| locked spin | obliquity to its orbit | ± input numbers | ± in all | observed | ± "
        "| source |",
        "|---|---:|---:|---:|---:|---:|---|",
    ]
    for row in rows:
        if row.refused:
            continue
        known = OBSERVED[row.name].obliquity
        small = row.obliquity < SMALL
        sign, factor = ("′", 60.0) if small else ("°", 1.0)
        error = f"{factor * row.error:.2g}{sign}" if row.error else ""
        columns = ["", "", ""]
        if known is not None:
            half = (
                ""
                if known.uncertainty is None
                else f"{1.96 * known.uncertainty:.2g}{UNITS[known.unit]}"
            )
            columns = [f"{known.value:g}{UNITS[known.unit]}", half, known.source]
        lines.append(
            f"| {proper(row.name)} | {factor * row.obliquity:.3g}{sign} | {error} "
            f"| {in_all(factor * row.error, factor * row.left_out, sign)} | {' | '.join(columns)} |"
        )
    lines += ["", "| locked spin | reason for the difference |", "|---|---|"]
    lines += [f"| {proper(row.name)} | {OBSERVED[row.name].why} |" for row in rows]
    lines += ["", "| locked spin | why there is no state |", "|---|---|"]
    lines += [f"| {proper(row.name)} | {row.refused} |" for row in rows if row.refused]
    return "\n".join([*lines, ""])


def _to(error: float, value: float) -> str:
    """A value to the second digit of its error."""
    digits = 1 - math.floor(math.log10(error))
    return f"{round(value, digits):,.{max(0, digits)}f}"


def main(arguments: argparse.Namespace) -> int:
    """Write the table into the page."""
    made = f"{table(worlds())}\n{table_of_locked(locked())}"
    print(made)
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    PAGE.write_text(f"{before}{BEGIN}\n\n{made}\n{END}{after}", "utf-8")
    return 0
