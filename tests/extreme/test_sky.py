"""Ephemeris kernels, equators and nutation."""

import erfa
import numpy as np

from earthspin.bodies import MARS, MOON
from earthspin.constants import DAY, J2000_JD
from earthspin.questions.torque import torque_series
from earthspin.sky.iau_models import NutationSpline
from earthspin.sky.poles import spherical
from tests.extreme import Distances, holds, relative_error
from tests.reference.sky import BODY, CENTRE, CODES, kernel, positions


def _ends() -> tuple[float, float]:
    return kernel().coverage({CODES["moon"], CENTRE})


@holds(bound=0.02)
def test_first_and_last() -> Distances:
    """position of the Moon in the first and last minutes of the kernel

    Hard because: a wrong record would be extrapolated without an error
    Compared with: acceleration by Newton's law from both masses, relative; the Sun's tide is 1 %
    """
    start, end = _ends()
    minute = 60 / DAY
    for days in (start + minute * np.array([0.0, 5.0, 10.0]), end - minute * np.arange(0, 11, 5.0)):
        place = positions(days)["moon"]
        step = (days[1] - days[0]) * DAY
        seen = (place[0] - 2 * place[1] + place[2]) / step**2
        size = np.linalg.norm(place[1])
        law = -(MOON.gm + BODY.gm) * place[1] / size**3
        yield np.linalg.norm(seen - law) / np.linalg.norm(law)


@holds(bound=3e-11)
def test_torque_at_the_ends() -> Distances:
    """torques at the first and last epoch of the kernel

    Hard because: nutation is interpolated with nodes beyond the ends, where the kernel has no data
    Compared with: the same epoch in a series, relative to the largest torque
    """
    alone = torque_series(times=["1899-07-29", "2053-10-09"], equator="true")
    before = torque_series("1899-07-29", "1899-08-03", "1 h", equator="true")
    after = torque_series("2053-10-04T05:00", "2053-10-09", "1 h", equator="true")
    yield abs(alone.torque[0] - before.torque[0]).max() / abs(before.torque).max()
    yield abs(alone.torque[1] - after.torque[-1]).max() / abs(after.torque).max()


@holds(bound=1e-11, unit="rad")
def test_nutation_ends() -> Distances:
    """interpolated nutation near both ends of a time span

    Hard because: a spline is least accurate at its ends
    Compared with: ERFA's pnm06a at epochs within an hour of the first and the last node
    """
    for day in (-36000.0, 0.0, 19000.0):
        days = day + np.concatenate([np.linspace(0, 0.04, 20), np.linspace(29.96, 30.0, 20)])
        interpolated = NutationSpline(days[0], days[-1], 1000).true_equator(days)
        yield interpolated - erfa.pnm06a(J2000_JD, days)


@holds(bound=5e-15, unit="rad")
def test_beside_the_pole() -> Distances:
    """declination of directions near the celestial poles

    Hard because: an arc sine has only half the digits there
    Compared with: original distance from the pole
    """
    away = np.array([1e-3, 1e-6, 1e-9])
    vectors = 4e8 * np.stack([np.sin(away), 0 * away, np.cos(away)], axis=1)
    both = np.concatenate([vectors, vectors * [1, 1, -1]])
    _, declination, _ = spherical(both)
    result = np.pi / 2 - np.abs(declination)
    yield result - np.concatenate([away, away])


@holds(bound=5e-15)
def test_both_ways() -> Distances:
    """position of Mars relative to the Earth, by kernel segments of barycentres

    Hard because: common segments of the two paths must cancel instead of being subtracted
    Compared with: the Earth as seen from Mars, relative to the distance
    """
    days = np.linspace(-30000.0, 15000.0, 50)
    mars = kernel().code(MARS.naif, "mars")
    there = kernel().positions({"x": mars}, CENTRE, days)["x"]
    back = kernel().positions({"x": CENTRE}, mars, days)["x"]
    yield relative_error(-back, there)


@holds(bound=1e-14)
def test_legs() -> Distances:
    """position of the Moon from the Earth by two chains of kernel segments

    Hard because: the barycentre of Earth and Moon lies inside the Earth
    Compared with: position of the Sun minus that of the Sun from the Moon, relative to the distance
    """
    days = np.linspace(-30000.0, 15000.0, 50)
    result = positions(days)
    from_moon = kernel().positions({"sun": CODES["sun"]}, CODES["moon"], days)["sun"]
    yield relative_error(result["moon"] + from_moon, result["sun"])
