"""Precession of the planets and the Moon beside what is published, for docs/worlds.md."""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from pathlib import Path

import earthspin
from data_tools.stability import with_tables
from earthspin.bodies import BODIES, PLANETS, proper
from earthspin.bodies.giants import JUPITER_CONSTANT, SATURN_CONSTANT
from earthspin.bodies.inner import MERCURY_OBLIQUITY, MERCURY_ORBIT, VENUS_PRECESSION
from earthspin.bodies.mars import PRECESSION as MARS_PRECESSION
from earthspin.bodies.mean_orbits import MEAN_MOON
from earthspin.bodies.moon import OBLIQUITY as MOON_OBLIQUITY
from earthspin.constants import PSI_A_RATE, Constant
from earthspin.errors import EarthspinError

PAGE = Path(__file__).parents[1] / "docs" / "worlds.md"


@dataclass(frozen=True)
class Published:
    """A published rate, and why ours is another.

    Attributes
    ----------
    rate : Constant
        arcsec/yr.
    of_constant : bool
        Whether it is the rate over the cosine of the obliquity.
    why : str
        What parts the two.
    """

    rate: Constant
    of_constant: bool
    why: str


PUBLISHED = {
    "venus": Published(VENUS_PRECESSION, False, "the moment was inferred from this rate"),
    "earth": Published(PSI_A_RATE, False, "geodesic precession and other effects left out"),
    "mars": Published(MARS_PRECESSION, False, "within its error"),
    "jupiter": Published(JUPITER_CONSTANT, True, "theirs is known here to two digits"),
    "saturn": Published(SATURN_CONSTANT, True, "Iapetus, outside, is carried in part by theirs"),
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
        Size of the rate of precession and its 95 % half-width, arcsec/yr.
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
    period: float = math.nan
    period_error: float = math.nan
    published: float = math.nan
    refused: str = ""


def world(name: str) -> World:
    """Row of a body, pulled on by what pulls on it."""
    try:
        found = earthspin.precession(body=name).isel(perturber=-1)
    except EarthspinError as error:
        return World(name, refused=str(error))
    obliquity = float(found.obliquity)
    published = PUBLISHED[name]
    along = math.cos(math.radians(obliquity)) if published.of_constant else 1.0
    return World(
        name,
        obliquity,
        abs(float(found.precession_rate)),
        float(found.precession_rate_error),
        float(found.precession_period),
        float(found.precession_period_error),
        abs(published.rate.value) * along,
    )


def worlds() -> list[World]:
    """All planets and the Moon."""
    return [world(name) for name in (*PLANETS, "moon") if name in BODIES]


def table(rows: list[World]) -> str:
    """The rows in Markdown: first those that precess, then those that are refused."""
    lines = [
        "| world | obliquity (°) | rate (″/yr) | ± | period (yr) | published (″/yr) | ± | source |",
        "|---|---:|---:|---:|---:|---:|---:|---|",
    ]
    for row in rows:
        if row.refused:
            continue
        of = PUBLISHED[row.name].rate
        error = "" if of.uncertainty is None else f"{1.96 * of.uncertainty:.2g}"
        lines.append(
            f"| {proper(row.name)} | {row.obliquity:.2f} | {_to(row.error, row.rate)} "
            f"| {row.error:.2g} | {_to(row.period_error, row.period)} | {row.published:.4g} "
            f"| {error} | {of.source} |"
        )
    lines += ["", "| world | parts ours from the published one |", "|---|---|"]
    lines += [f"| {proper(name)} | {one.why} |" for name, one in PUBLISHED.items()]
    lines += ["", "| world | why there is no rate |", "|---|---|"]
    lines += [f"| {proper(row.name)} | {row.refused} |" for row in rows if row.refused]
    return "\n".join([*lines, ""])


@dataclass(frozen=True)
class Locked:
    """A spin that is locked: where its axis stands, ours and observed.

    Attributes
    ----------
    name : str
    obliquity, error : float
        To its own orbit in Cassini state 1, and half-width, in the unit of the observed one.
    observed : Constant
    """

    name: str
    obliquity: float
    error: float
    observed: Constant


def locked() -> list[Locked]:
    """Mercury and the Moon in the Cassini states that they are in."""
    rows = []
    for name, orbit, observed, in_a_degree in (
        ("mercury", MERCURY_ORBIT, MERCURY_OBLIQUITY, 60.0),
        ("moon", MEAN_MOON.orbit, MOON_OBLIQUITY, 1.0),
    ):
        states = earthspin.cassini_states(name, orbit)
        first = states.isel(state=0)  # for the Moon state 2, the only upright one
        found = float(first.obliquity) * in_a_degree, float(first.obliquity_error) * in_a_degree
        rows.append(Locked(name, *found, observed))
    return rows


def table_of_locked(rows: list[Locked]) -> str:
    """The locked spins in Markdown."""
    units = {"arcmin": "′", "deg": "°"}
    lines = [
        "| locked spin | obliquity to its orbit | ± | observed | ± | source |",
        "|---|---:|---:|---:|---:|---|",
    ]
    for row in rows:
        of, unit = row.observed, units[row.observed.unit]
        error = "" if of.uncertainty is None else f"{of.uncertainty:g}{unit}"
        lines.append(
            f"| {proper(row.name)} | {row.obliquity:.2f}{unit} | {row.error:.2g}{unit} "
            f"| {of.value:g}{unit} | {error} | {of.source} |"
        )
    return "\n".join([*lines, ""])


def _to(error: float, value: float) -> str:
    """A value to the second digit of its error."""
    digits = 1 - math.floor(math.log10(error))
    return f"{round(value, digits):,.{max(0, digits)}f}"


def main(given: argparse.Namespace) -> int:
    """Write the table into the page."""
    made = f"{table(worlds())}\n{table_of_locked(locked())}"
    print(made)
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8"), made), "utf-8")
    return 0
