"""Stiff and extreme cases of the axis over millennia to millions of years."""

from __future__ import annotations

import math

import numpy as np

from earthspin.checks.case import Distances, FloatArray, holds, refused
from earthspin.checks.ladders.of_long_term import orbit
from earthspin.checks.sky import BODY
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, JULIAN_YEAR
from earthspin.questions.long_term import LongTerm, long_term
from earthspin.scenes import run_tree
from earthspin.secular.insolation import Season, daily
from earthspin.secular.lanes import solve_many
from earthspin.secular.orbit import Shape
from earthspin.secular.strength import Strength
from earthspin.secular.trajectory import solve

MYR = 1e6 * JULIAN_YEAR
NORTH = np.array([0.0, 0.0, 1.0])
#: Some constants of precession, 17 and 37 arcsec a year, and a geodesic term.
STRENGTH = Strength(
    sun=17.4 * ARCSEC_PER_YEAR, moon=37.6 * ARCSEC_PER_YEAR, geodesic=0.0192 * ARCSEC_PER_YEAR
)


class _Still:
    """A circular orbit that does not change."""

    edges = MYR / 50 * np.arange(-60.0, 61.0)
    coverage = float(edges[0]), float(edges[-1])

    def at(self, times: FloatArray) -> Shape:
        zero = 0 * times
        normal = np.stack([zero, zero, zero + 1])
        return normal, 0 * normal, 0 * normal


def _leaning(obliquity: float, normal: FloatArray = NORTH) -> FloatArray:
    across = np.cross(normal, [1.0, 0.3, 0.2])
    across /= np.linalg.norm(across)
    return math.cos(obliquity) * normal + math.sin(obliquity) * across


@holds(bound=3e-7, unit="arcsec")
def _near_upright() -> Distances:
    """axes within 8 degrees of the normal, and of its opposite

    Hard because: there the longitude about the normal has no derivative; another axis is taken
    Held against: a cone about the normal
    """
    times = np.linspace(-MYR, MYR, 101)
    for degrees in (1e-6, 0.5, 5, 7.9, 172.1, 179.5, 180):
        axis = _leaning(math.radians(degrees))
        constant = STRENGTH.sun + STRENGTH.moon
        turned = (STRENGTH.geodesic - constant * math.cos(math.radians(degrees))) * times
        c, s = np.cos(turned), np.sin(turned)
        cone = np.stack([c * axis[0] - s * axis[1], s * axis[0] + c * axis[1], axis[2] + 0 * c])
        yield (solve(STRENGTH, _Still(), axis, (-MYR, MYR), pieces=2).at(times) - cone) / ARCSEC
        yield (solve_many(STRENGTH, _Still(), axis[:, np.newaxis], times)[..., 0] - cone) / ARCSEC


def _both(span: tuple[float, float], axis: FloatArray, step: float) -> Distances:
    """Newton in time against lanes on the shipped orbit."""
    times = np.linspace(*span, 51)
    path = solve(STRENGTH, orbit(), axis, (min(span[0], 0.0), max(span[1], 0.0)), pieces=2)
    many = solve_many(STRENGTH, orbit(), axis[:, np.newaxis], times, step)
    yield np.linalg.norm(many[..., 0] - path.at(times), axis=0) / ARCSEC


@holds(bound=2e-6, unit="arcsec")
def _lying() -> Distances:
    """a mean obliquity of 90 degrees

    Hard because: the mean precession is zero, and goes forward and back with the tilt of the orbit
    Held against: the other solver over a million years
    """
    normal = orbit().at(np.zeros(1))[0][:, 0]
    yield from _both((-MYR, 0.0), _leaning(math.pi / 2, normal), 1e3 * JULIAN_YEAR)


@holds(bound=0.05, unit="arcsec", slow=True)
def _ends() -> Distances:
    """ten million years to either end of the table

    Hard because: four hundred turns, fifty blocks, and a last window with no neighbour
    Held against: the other solver
    """
    normal = orbit().at(np.zeros(1))[0][:, 0]
    for span in ((-10 * MYR, 0.0), (0.0, 10 * MYR)):
        yield from _both(span, _leaning(0.41, normal), 2e3 * JULIAN_YEAR)


@holds(bound=1e-9, unit="arcsec")
def _now() -> Distances:
    """J2000.0 alone

    Hard because: a span of no length: no window would be solved
    Held against: the start
    """
    yield (solve(STRENGTH, orbit(), NORTH, (0.0, 0.0)).at(np.zeros(1))[:, 0] - NORTH) / ARCSEC
    asked = long_term(times=["0 kyr"])
    yield (asked.pole.values[0] - BODY.needed("pole").mean(np.zeros(1))[0]) / ARCSEC


@holds(bound=0.0, unit="deg")
def _coarse() -> Distances:
    """two epochs a million years apart

    Hard because: forty turns lie between them, of which neither epoch tells
    Held against: the same epochs among a thousand
    """
    few, many = long_term("-1 Myr", "0 kyr", "1 Myr"), long_term("-1 Myr", "0 kyr", "1 kyr")
    for name in ("longitude_of_perihelion", "general_precession", "psi_A"):
        yield few[name].values - many[name].sel(epoch=few.epoch).values


@holds(bound=2e-4, unit="deg", slow=True)
def _all_but_round() -> Distances:
    """perihelia of an orbit that is all but round

    Hard because: at an eccentricity of 1.6e-4 a perihelion turns by a radian in two hundred years
    Held against: windows of half the length, share of the error by the method
    """
    tree = run_tree(LongTerm(span=["-10 Myr", "0 kyr"], step="20 kyr"), sections="budget")
    yield tree["budget"].to_dataset().longitude_share.sel(cause="method").values


@refused("was asked for")
def _too_accurate() -> None:
    """an accuracy that no knowledge of the body allows

    Hard because: the solver itself would keep it
    """
    long_term(times=["-1 Myr"], accuracy="0.1 arcsec")


@holds(bound=5e-15)
def _light() -> Distances:
    """circular orbit, retrograde and upright daily light

    Hard because: the longitude of perihelion has no value, and hours of day are clipped
    Held against: the closed form at a solstice and a pole
    """
    for obliquity in (0.0, 0.4, math.pi / 2, 3.0, math.pi):
        season = Season(*(np.array(x) for x in (obliquity, 0.0, 1.0)))
        at_pole = daily(season, np.array(math.pi / 2), np.array(math.pi / 2))
        yield at_pole - max(math.sin(obliquity), 0.0)
        yield daily(season, np.zeros(1), np.zeros(1)) - 1 / math.pi
