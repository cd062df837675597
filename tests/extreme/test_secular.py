"""Spin axis over millennia to millions of years."""

import math

import numpy as np
import pytest

from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, JULIAN_YEAR
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.long_term import LongTerm, long_term
from earthspin.scenes import run_tree
from earthspin.secular.averaged_torque import PrecessionConstant
from earthspin.secular.insolation import Season, daily
from earthspin.secular.trajectory import solve
from tests.extreme import Distances, holds
from tests.reference.sky import BODY
from tests.reference.spin_axis import spin_axis
from tests.secular.setting import EARTHS, FixedOrbit, inclined_axis, turned

MYR = 1e6 * JULIAN_YEAR
NORTH = np.array([0.0, 0.0, 1.0])
#: Precession constants of Sun and Moon near those of the Earth, and geodesic precession.
STRENGTH = PrecessionConstant(
    sun=17.4 * ARCSEC_PER_YEAR, moon=37.6 * ARCSEC_PER_YEAR, geodesic=0.0192 * ARCSEC_PER_YEAR
)


@holds(bound=3e-7, unit="arcsec")
def test_near_upright() -> Distances:
    """spin axis within 8 degrees of the orbit normal and of its opposite

    Hard because: the longitude about the normal is undefined there, so another reference axis is
        used
    Compared with: cone about the normal
    """
    times = np.linspace(-MYR, MYR, 101)
    for degrees in (1e-6, 0.5, 5, 7.9, 172.1, 179.5, 180):
        axis = inclined_axis(math.radians(degrees))
        constant = STRENGTH.sun + STRENGTH.moon
        angle = (STRENGTH.geodesic - constant * math.cos(math.radians(degrees))) * times
        cone = turned(axis, angle)
        path = solve(STRENGTH, FixedOrbit(), axis, (-MYR, MYR), pieces=2)
        yield (path.at(times) - cone) / ARCSEC


def _apart(end: float, axis: FloatArray, step: float) -> float:
    """Largest angle between the spin axes of the solver and of the reference, arcsec."""
    true = spin_axis(STRENGTH, EARTHS, axis, end, step)
    times = np.linspace(0.0, end, true.shape[1])
    path = solve(STRENGTH, EARTHS, axis, (min(end, 0.0), max(end, 0.0)), pieces=2)
    return float(np.max(np.linalg.norm(path.at(times) - true, axis=0)) / ARCSEC)


@holds(bound=2e-6, unit="arcsec")
def test_lying() -> Distances:
    """spin axis with a mean obliquity of 90 degrees

    Hard because: the mean precession is zero and reverses with the inclination of the orbit
    Compared with: extrapolation in long double over a million years
    """
    normal = EARTHS.at(np.zeros(1))[0][:, 0]
    yield _apart(-MYR, inclined_axis(math.pi / 2, normal), 1e3 * JULIAN_YEAR)


@pytest.mark.slow
@holds(bound=0.05, unit="arcsec")
def test_ends() -> Distances:
    """spin axis over ten million years, to both ends of the orbit table

    Hard because: the axis precesses four hundred times in fifty blocks, and the last window has no
        neighbour
    Compared with: extrapolation in long double
    """
    normal = EARTHS.at(np.zeros(1))[0][:, 0]
    for end in (-10 * MYR, 10 * MYR):
        yield _apart(end, inclined_axis(0.41, normal), 2e3 * JULIAN_YEAR)


@holds(bound=1e-9, unit="arcsec")
def test_now() -> Distances:
    """spin axis at J2000.0 only

    Hard because: the span has zero length, so no window would be solved
    Compared with: initial axis
    """
    yield (solve(STRENGTH, EARTHS, NORTH, (0.0, 0.0)).at(np.zeros(1))[:, 0] - NORTH) / ARCSEC
    asked = long_term(times=["0 kyr"])
    yield (asked.pole.values[0] - BODY.needed("pole").mean(np.zeros(1))[0]) / ARCSEC


@holds(bound=0.0, unit="deg")
def test_coarse() -> Distances:
    """spin axis at only two epochs, a million years apart

    Hard because: forty precession cycles lie between the two epochs, which do not show their number
    Compared with: the same epochs in a series of a thousand
    """
    few, many = long_term("-1 Myr", "0 kyr", "1 Myr"), long_term("-1 Myr", "0 kyr", "1 kyr")
    for name in ("longitude_of_perihelion", "general_precession", "psi_A"):
        yield few[name].values - many[name].sel(epoch=few.epoch).values


@pytest.mark.slow
@holds(bound=2e-4, unit="deg")
def test_all_but_round() -> Distances:
    """longitude of perihelion of a nearly circular orbit

    Hard because: at an eccentricity of 1.6e-4 a perihelion moves by a radian in two hundred years
    Compared with: windows of half the length: contribution of the method to the error
    """
    tree = run_tree(LongTerm(span=["-10 Myr", "0 kyr"], step="20 kyr"), sections="budget")
    yield tree["budget"].to_dataset().longitude_share.sel(cause="method").values


@holds(bound=5e-15)
def test_light() -> Distances:
    """daily insolation on a circular orbit at obliquities from 0 to 180 degrees

    Hard because: the longitude of perihelion is undefined, and the length of the day reaches its
        limits
    Compared with: closed form at a solstice and a pole
    """
    for obliquity in (0.0, 0.4, math.pi / 2, 3.0, math.pi):
        season = Season(*(np.array(x) for x in (obliquity, 0.0, 1.0)))
        at_pole = daily(season, np.array(math.pi / 2), np.array(math.pi / 2))
        yield at_pole - max(math.sin(obliquity), 0.0)
        yield daily(season, np.zeros(1), np.zeros(1)) - 1 / math.pi
