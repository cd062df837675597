"""The tables of docs/long_term.md: effects, the error by cause, and other solutions beside ours.

Files of other solutions are given by path: `--solutions INSOLN.LA2004.BTL.ASC La2010a_ecc3L.dat`.
The package inso holds those of Laskar and others, for the Earth and Mars; the repository
japhir/paleoinsolation holds out/ZB18a_insolation.dat.
"""

from __future__ import annotations

import argparse
import itertools
import math
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import erfa
import numpy as np
from astropy import units
from numpy.typing import NDArray

from earthspin.bodies import EARTH, MOON, SUN, Body
from earthspin.constants import ARCSEC, J2000_JD, JULIAN_YEAR
from earthspin.parts import averages, orbits
from earthspin.parts import sky as skies
from earthspin.questions import long_term as question
from earthspin.scenes import load_scene, run_tree
from earthspin.secular.angles import seasons
from earthspin.secular.budget import Setting, Solved
from earthspin.secular.orbit import ModifiedOrbit, Orbit, Shape
from earthspin.secular.strength import Tides
from earthspin.secular.trajectory import solve

FloatArray = NDArray[np.float64]

#: Spans, kyr from J2000.0 either way, over which solutions of others are compared.
SPANS = (0, 20, 100, 500, 1000, 3000, 5000, 7500, 10_000)
#: Columns of their files, by how many there are: La2010 (eccentricity alone), La2004 and La93, and
#: ZB18a (with insolation). Times in kyr; perihelia from the moving equinox.
COLUMNS = {
    2: ("time", "eccentricity"),
    4: ("time", "eccentricity", "obliquity", "perihelion"),
    5: ("time", "eccentricity", "obliquity", "perihelion", "insolation"),
}
LISTING = Path(__file__).parents[1] / "docs" / "measured" / "long-term-solutions.inc"
HEAD = """| file | quantity | span | rms | largest | our half-width | inside |
|---|---|---|---:|---:|---:|---:|
"""
#: Where poles are compared, and the epochs at which errors are listed, yr.
NEAR = (-2000, -1000, -500, 500, 1000, 2000)
LISTED = (1e3, 1e4, 1e5, 1e6)
#: What is said of an effect is the largest over this stretch, s.
FAR = np.arange(-1_000_000, -950_000 + 1, 500) * JULIAN_YEAR


def _round(orbit: Orbit) -> Orbit:
    """An orbit whose eccentricity stays what it is at J2000.0."""
    now = np.linalg.norm(orbit.at(np.zeros(1))[1])

    def change(times: FloatArray, shape: Shape) -> Shape:
        normal, vector, turning = shape
        return normal, vector * (now / np.linalg.norm(vector, axis=0)), turning

    return ModifiedOrbit(orbit, change)


def solution(body: Body, times: FloatArray) -> Solved:
    """The axis of a body at times (s), and with each cause changed, as the question solves it."""
    scene = load_scene("long-term")
    assert isinstance(scene, question.LongTerm)
    pulling = (SUN, MOON) if body == EARTH else (SUN,)
    sky = skies.sky(scene.ephemeris, skies.places(body, pulling), scene.source)
    samples = averages.torque_samples(sky, question.stretch(sky), body, pulling)
    means = averages.mean_torques(averages.window_means(samples, pulling))
    rates = averages.mean_rates(means, body, pulling)
    table = orbits.orbit_table("own", body)
    numbers = question.numbers(rates, body, pulling, 1.0, 1.0, None, 0.0, 0.0)
    strength = question.strength(numbers, means, body, table)
    return question.solved(strength, numbers, table, times, body)


def without() -> dict[str, Setting]:
    """The same with one effect left out, or changed, at a time."""
    now = solution(EARTH, np.zeros(1)).setting

    def changed(**fields: Any) -> Setting:
        return replace(now, strength=replace(now.strength, **fields))

    return {
        "all": now,
        "eccentricity held": replace(now, orbit=_round(now.orbit)),
        "geodesic": changed(geodesic=0.0),
        "tides": changed(tides=Tides()),
        "ellipticity + 0.1 %": changed(ellipticity=1.001),
        "Moon's plane": changed(node_rate=math.inf),
        "J2 rate": changed(j2_rate=0.0),
    }


def effects() -> dict[str, tuple[float, float, float]]:
    """By effect: obliquity (arcsec) and p_A (deg) after 1 Myr, and pole (arcsec) at -2 kyr."""
    at = np.append(FAR, -2000 * JULIAN_YEAR)
    settings = without()
    normal = settings["all"].orbit.at(at)[0]
    poles = {
        name: solve(setting.strength, setting.orbit, setting.start, (float(at[0]), 0.0)).at(at)
        for name, setting in settings.items()
    }
    mine = poles.pop("all")
    equinox = np.cross(mine, normal, axis=0)
    by_effect = {}
    for name, pole in poles.items():
        other = np.cross(pole, normal, axis=0)
        tilt = np.abs(np.arcsin(_length(other)) - np.arcsin(_length(equinox)))
        # along the orbit of date, from one equinox to the other
        sine = np.sum(normal * np.cross(equinox, other, axis=0), axis=0)
        along = np.abs(np.arctan2(sine, np.sum(equinox * other, axis=0)))
        by_effect[name] = (
            float(np.max(tilt[:-1])) / ARCSEC,
            math.degrees(np.max(along[:-1])),
            float(_length(pole - mine)[-1]) / ARCSEC,
        )
    return by_effect


def _length(vectors: FloatArray) -> FloatArray:
    """Lengths of vectors, shape (3, n)."""
    return np.asarray(np.sqrt(np.sum(vectors**2, axis=0)))


def _apart(first: FloatArray, second: FloatArray) -> float:
    """Angle between two unit vectors that are close to one another, arcsec."""
    return float(np.linalg.norm(np.cross(first, second))) / ARCSEC


def beside() -> dict[int, tuple[float, float, float, float]]:
    """By year: angles between poles (arcsec), ours to IAU 2006 and to `ltp`, and those; our error.

    IAU 2006 and the long-term series are ERFA's `pmat06` and `ltpb`, both from the GCRS.
    """
    answer = question.long_term(times=[f"{year} yr" for year in NEAR])
    by_year = {}
    for place, year in enumerate(NEAR):
        own = answer.pole.values[place]
        iau, series = erfa.pmat06(J2000_JD, 365.25 * year)[2], erfa.ltpb(2000.0 + year)[2]
        pairs = (own, iau), (own, series), (iau, series)
        to_iau, to_series, between = (_apart(first, second) for first, second in pairs)
        by_year[year] = to_iau, to_series, between, float(answer.pole_error[place])
    return by_year


def read_solution(path: Path) -> dict[str, FloatArray]:
    """Columns of a file of another solution within ten million years; angles in rad."""
    rows = np.array(
        [
            [float(word.replace("D", "e")) for word in line.split()]
            for line in path.read_text().splitlines()
        ]
    )
    rows = rows[np.abs(rows[:, 0]) <= SPANS[-1]]
    columns = dict(zip(COLUMNS[rows.shape[1]], rows.T, strict=True))
    for name in ("obliquity", "perihelion"):
        if rows.shape[1] == 5:
            columns[name] = np.radians(columns[name])
    return columns


class Beside(NamedTuple):
    """One quantity of another solution beside ours, over a span.

    Attributes
    ----------
    name, quantity, span : str
    rms, largest, half_width, inside : float
        Of the differences, in the unit of the quantity; our median half-width; share inside.
    """

    name: str
    quantity: str
    span: str
    rms: float
    largest: float
    half_width: float
    inside: float

    def line(self) -> str:
        """Return the row as a line of a Markdown table."""
        numbers = (f"{number:.3g}" for number in (self.rms, self.largest, self.half_width))
        columns = (self.name, self.quantity, self.span, *numbers, f"{100 * self.inside:.0f} %")
        return f"| {' | '.join(columns)} |\n"


def beside_solution(path: Path) -> list[Beside]:
    """By quantity and span, what the file of another solution holds beside ours, as returned.

    A file of Mars has MARS in its name. The obliquity of the Earth is compared again, over a
    million years, without the lag of the Moon's plane.
    """
    published = read_solution(path)
    body = "mars" if "MARS" in path.name else "earth"
    pulling = ("sun",) if body == "mars" else ("sun", "moon")
    answer = question.long_term(
        times=published["time"] * 1000 * units.yr, body=body, perturbers=pulling
    )
    quantities = {"eccentricity": ("`eccentricity`, $10^{-5}$", published["eccentricity"], 1e-5)}
    if "obliquity" in published:
        climate = published["eccentricity"] * np.sin(published["perihelion"])
        quantities["obliquity"] = "`obliquity`, ″", np.degrees(published["obliquity"]), 1 / 3600
        quantities["climatic_precession"] = "`climatic_precession`, $10^{-5}$", climate, 1e-5
    rows = []
    for name, (quantity, values, unit) in quantities.items():
        half_width = answer[f"{name}_error"].values / unit
        rows += _by_span(
            path, quantity, published, (answer[name].values - values) / unit, half_width
        )
    if body == "earth" and "obliquity" in published:
        near = np.abs(published["time"]) < 1000
        published = {name: column[near] for name, column in published.items()}
        apart = (without_lag(published["time"]) - published["obliquity"]) / ARCSEC
        half_width = answer.obliquity_error.values[near] * 3600
        rows += _by_span(path, "`obliquity` without the lag, ″", published, apart, half_width)
    return rows


def _by_span(
    path: Path, quantity: str, published: dict[str, FloatArray], apart: FloatArray, half: FloatArray
) -> list[Beside]:
    """Rows of one quantity."""
    kyr, rows = np.abs(published["time"]), []
    way = "back" if published["time"][-1] < 0 else "ahead"
    for first, last in itertools.pairwise(SPANS):
        at = (kyr >= first) & (kyr < last)
        if at.any():
            rows.append(
                Beside(
                    f"`{path.name}`",
                    quantity,
                    f"{first} to {last} kyr {way}",
                    float(np.sqrt(np.mean(apart[at] ** 2))),
                    float(np.abs(apart[at]).max()),
                    float(np.median(half[at])),
                    float(np.mean(np.abs(apart[at]) <= half[at])),
                )
            )
    return rows


def without_lag(kyr: FloatArray) -> FloatArray:
    """Our obliquity without the lag of the Moon's plane, rad."""
    times = kyr * 1000 * JULIAN_YEAR
    setting = solution(EARTH, times).setting
    setting = replace(setting, strength=replace(setting.strength, node_rate=math.inf))
    span = float(times.min()), float(times.max())
    path = solve(setting.strength, setting.orbit, setting.start, span, pieces=2)
    normal, eccentricity, _ = setting.orbit.at(times)
    return seasons(path.at(times), normal, eccentricity).obliquity


def by_cause() -> dict[str, list[float]]:
    """By cause: its share in the error of the longitude of perihelion (deg), at `LISTED`."""
    scene = load_scene("long-term", {"span": ["-1 Myr", "0 kyr"], "step": "1 kyr"})
    shares = run_tree(scene, ["budget"])["budget"].longitude_share
    return {
        str(cause): [float(shares.sel(cause=cause, epoch=-years)) for years in LISTED]
        for cause in shares.cause.values
    }


def main(arguments: argparse.Namespace) -> int:
    """Print every table, or write that of the solutions whose files are given."""
    if arguments.solutions:
        rows: list[Beside] = []
        for path in map(Path, arguments.solutions):
            rows += beside_solution(path)
        LISTING.write_text(HEAD + "".join(row.line() for row in rows), encoding="utf-8")
        print(f"wrote {LISTING.name}")
        return 0
    for head, table in (
        ("effects: obliquity, arcsec; p_A, deg; pole at -2 kyr, arcsec", effects()),
        ("angles between poles, arcsec: IAU 2006; ltp; those two; our error", beside()),
        ("share in the error of the perihelion, deg, 1 to 1000 kyr back", by_cause()),
    ):
        print(head)
        for name, numbers in table.items():
            print(f"  {name!s:22}", *(f"{number:12.3g}" for number in numbers))
    return 0
