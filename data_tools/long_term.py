"""The tables of docs/long_term.md: effects, the error by cause, and other solutions beside ours."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from typing import Any

import erfa
import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import EARTH, MOON, SUN, Body
from earthspin.constants import ARCSEC, J2000_JD, JULIAN_YEAR
from earthspin.parts import averages, orbits
from earthspin.parts import sky as skies
from earthspin.questions import long_term as question
from earthspin.scenes import load_scene, run_tree
from earthspin.secular.budget import Setting, Solved
from earthspin.secular.orbit import Changed, Orbit, Shape
from earthspin.secular.strength import Tides
from earthspin.secular.trajectory import solve

FloatArray = NDArray[np.float64]

#: Obliquity (rad) and climatic precession of the nominal solution of Laskar et al. (2004), A&A 428,
#: 261, file INSOLN.LA2004.BTL.ASC of the IMCCE, by thousands of years from J2000.0.
LA2004 = {
    -1000: (0.4123891471500025, -0.033760490135305736),
    -200: (0.4037251011418818, -0.03833572638169867),
    -100: (0.4130265591582125, -0.0006501053038830341),
    0: (0.4090928042223415, 0.01627964595166013),
}
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

    return Changed(orbit, change)


def solution(body: Body, times: FloatArray) -> Solved:
    """The axis of a body at times (s), and with each cause changed, as the question solves it."""
    scene = load_scene("long-term")
    assert isinstance(scene, question.LongTerm)
    pulling = (SUN, MOON) if body == EARTH else (SUN,)
    sky = skies.sky(scene.ephemeris, skies.places(body, pulling), scene.source)
    samples = averages.torque_samples(sky, question.stretch(sky), body, pulling, None)
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
        name: solve(of.strength, of.orbit, of.start, (float(at[0]), 0.0)).at(at)
        for name, of in settings.items()
    }
    mine = poles.pop("all")
    equinox = np.cross(mine, normal, axis=0)
    found = {}
    for name, pole in poles.items():
        other = np.cross(pole, normal, axis=0)
        tilt = np.abs(np.arcsin(_length(other)) - np.arcsin(_length(equinox)))
        # along the orbit of date, from one equinox to the other
        sine = np.sum(normal * np.cross(equinox, other, axis=0), axis=0)
        along = np.abs(np.arctan2(sine, np.sum(equinox * other, axis=0)))
        found[name] = (
            float(np.max(tilt[:-1])) / ARCSEC,
            math.degrees(np.max(along[:-1])),
            float(_length(pole - mine)[-1]) / ARCSEC,
        )
    return found


def _length(vectors: FloatArray) -> FloatArray:
    """Lengths of vectors, shape (3, n)."""
    return np.asarray(np.sqrt(np.sum(vectors**2, axis=0)))


def _apart(one: FloatArray, other: FloatArray) -> float:
    """Angle between two unit vectors that are close to one another, arcsec."""
    return float(np.linalg.norm(np.cross(one, other))) / ARCSEC


def beside() -> dict[int, tuple[float, float, float, float]]:
    """By year: angles between poles (arcsec), ours to IAU 2006 and to `ltp`, and those; our error.

    IAU 2006 and the long-term series are ERFA's `pmat06` and `ltpb`, both from the GCRS.
    """
    of = question.long_term(times=[f"{year} yr" for year in NEAR])
    found = {}
    for place, year in enumerate(NEAR):
        ours = of.pole.values[place]
        iau, series = erfa.pmat06(J2000_JD, 365.25 * year)[2], erfa.ltpb(2000.0 + year)[2]
        pairs = (ours, iau), (ours, series), (iau, series)
        to_iau, to_series, between = (_apart(one, other) for one, other in pairs)
        found[year] = to_iau, to_series, between, float(of.pole_error[place])
    return found


def beside_la2004() -> dict[int, tuple[float, float, float, float]]:
    """By kyr: obliquity (arcsec) and climatic precession, ours less La2004; errors of both."""
    of = question.long_term(times=[f"{kyr} kyr" for kyr in LA2004])
    found = {}
    for place, (kyr, (tilt, climate)) in enumerate(LA2004.items()):
        at = of.isel(epoch=place)
        found[kyr] = (
            (float(at.obliquity) - math.degrees(tilt)) * 3600,
            float(at.climatic_precession) - climate,
            float(at.obliquity_error) * 3600,
            float(at.climatic_precession_error),
        )
    return found


def by_cause() -> dict[str, list[float]]:
    """By cause: its share in the error of the longitude of perihelion (deg), at `LISTED`."""
    scene = load_scene("long-term", {"span": ["-1 Myr", "0 kyr"], "step": "1 kyr"})
    shares = run_tree(scene, ["budget"])["budget"].longitude_share
    return {
        str(cause): [float(shares.sel(cause=cause, epoch=-years)) for years in LISTED]
        for cause in shares.cause.values
    }


def main(given: argparse.Namespace) -> int:
    """Print every table."""
    for head, rows in (
        ("effects: obliquity, arcsec; p_A, deg; pole at -2 kyr, arcsec", effects()),
        ("angles between poles, arcsec: IAU 2006; ltp; those two; our error", beside()),
        ("ours less La2004: obliquity, arcsec; climatic precession; errors", beside_la2004()),
        ("share in the error of the perihelion, deg, 1 to 1000 kyr back", by_cause()),
    ):
        print(head)
        for name, numbers in rows.items():
            print(f"  {name!s:22}", *(f"{number:12.3g}" for number in numbers))
    return 0
