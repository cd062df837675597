"""Stiff and extreme cases of kernels, equators and nutation."""

from __future__ import annotations

import tempfile
from functools import lru_cache
from pathlib import Path

import erfa
import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import BODIES, MARS, MOON
from earthspin.checks.case import Cases, without_folder
from earthspin.checks.default_body import default_body
from earthspin.constants import DAY, J2000_JD
from earthspin.questions.torque import torque_series
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris
from earthspin.sky.equator import fixed_equator, spherical
from earthspin.sky.iau import Nutation, mean_equator
from earthspin.sky.standstill import find_standstills

FloatArray = NDArray[np.float64]

CASES = Cases("sky")

BODY = default_body()
CENTRE = BODY.naif[0]
SECOND = 1 / DAY


@lru_cache
def _kernel() -> Ephemeris:
    return open_ephemeris("de421")


def _ends() -> tuple[float, float]:
    return _kernel().coverage({MOON.naif[0], CENTRE})


def _moon(days: FloatArray) -> FloatArray:
    return _kernel().positions({"moon": MOON.naif[0]}, CENTRE, days)["moon"]


@CASES.hold(
    "the Moon in the first and last minutes of the kernel",
    because="a record read one too far is extrapolated without a word",
    against="the acceleration by Newton's law from both masses, over itself; the Sun's tide is 1 %",
    bound=0.02,
)
def _first_and_last() -> float:
    start, end = _ends()
    minute, worst = 60 * SECOND, 0.0
    for days in (start + minute * np.array([0.0, 5.0, 10.0]), end - minute * np.arange(0, 11, 5.0)):
        place = _moon(days)
        step = (days[1] - days[0]) * DAY
        seen = (place[0] - 2 * place[1] + place[2]) / step**2
        size = np.linalg.norm(place[1])
        law = -(float(MOON.gm) + float(BODY.gm)) * place[1] / size**3
        worst = max(worst, float(np.linalg.norm(seen - law) / np.linalg.norm(law)))
    return worst


@CASES.hold(
    "torques at the very first and last epoch of the kernel",
    because="nutation wants nodes beyond the ends, the kernel has none",
    against="the same epoch inside a series, over the largest torque",
    bound=3e-11,
)
def _torque_at_the_ends() -> float:
    alone = torque_series(times=["1899-07-29", "2053-10-09"], equator="true")
    before = torque_series("1899-07-29", "1899-08-03", "1 h", equator="true")
    after = torque_series("2053-10-04T05:00", "2053-10-09", "1 h", equator="true")
    off = [
        abs(alone.torque[0] - before.torque[0]).max() / abs(before.torque).max(),
        abs(alone.torque[1] - after.torque[-1]).max() / abs(after.torque).max(),
    ]
    return float(max(off))


@CASES.refuse(
    "one second before the kernel",
    because="a polynomial gives numbers outside its range, too",
    saying="outside kernel",
)
def _before() -> None:
    _moon(np.array([_ends()[0] - SECOND]))


@CASES.refuse(
    "one second after the kernel",
    because="the reader extrapolates a whole record past the last",
    saying="outside kernel",
)
def _after() -> None:
    _moon(np.array([0.0, _ends()[1] + SECOND]))


@CASES.refuse(
    "a time that is not a number",
    because="NaN is neither before nor after the ends",
    saying="outside kernel",
)
def _nan_time() -> None:
    _moon(np.array([0.0, np.nan]))


@CASES.refuse(
    "a kernel cut in half",
    because="its directory still promises what is no longer there",
    saying="cut short",
)
def _cut() -> None:
    with tempfile.TemporaryDirectory() as folder:
        half = Path(folder) / "half.bsp"
        whole = _kernel().path.read_bytes()
        half.write_bytes(whole[: len(whole) // 2])
        with without_folder(half):
            Ephemeris(half)


@CASES.refuse(
    "a body that the kernel does not hold",
    because="its neighbour's code would give a plausible place",
    saying="does not hold",
)
def _no_such_body() -> None:
    with without_folder(_kernel().path):
        _kernel().code((999,), "pluto")


@CASES.hold(
    "nutation nodes at both ends",
    because="a spline is worst at its ends",
    against="ERFA's pnm06a, epochs within an hour of the first and the last node",
    unit="rad",
    bound=1e-11,
)
def _nutation_ends() -> float:
    worst = 0.0
    for day in (-36000.0, 0.0, 19000.0):
        days = day + np.concatenate([np.linspace(0, 0.04, 20), np.linspace(29.96, 30.0, 20)])
        ours = Nutation(days[0], days[-1], 1000).true_equator(days)
        worst = max(worst, float(np.max(np.abs(ours - erfa.pnm06a(J2000_JD, days)))))
    return worst


@CASES.hold(
    "mean equator from 1550 to 2650",
    because="polynomials of the fifth degree, eleven centuries from one end to the other",
    against="an orthogonal matrix",
    bound=5e-15,
)
def _orthogonal() -> float:
    matrix = mean_equator(np.linspace(-164_000.0, 237_000.0, 50))
    return float(np.max(np.abs(matrix @ np.swapaxes(matrix, 1, 2) - np.eye(3))))


@CASES.hold(
    "equator of an axis upright on its orbit",
    because="it has no equinox: the node is a vector of zeros",
    against="right-handed unit axes whose third is the spin axis",
    bound=5e-15,
)
def _no_equinox() -> float:
    worst = 0.0
    for axis in (np.array([0.0, 0.0, 1.0]), np.array([0.6, 0.0, -0.8])):
        for normal in (axis, -axis, axis + np.array([0.0, 1e-13, 0.0])):
            matrix = fixed_equator(axis, normal)
            off = np.abs(matrix @ matrix.T - np.eye(3))
            worst = max(worst, float(np.max(off)), float(np.max(np.abs(matrix[2] - axis))))
    return worst


@CASES.hold(
    "declinations beside the poles of the sky",
    because="an arc sine there is right to half the digits alone",
    against="the distance from the pole that was put in",
    unit="rad",
    bound=5e-15,
)
def _beside_the_pole() -> float:
    away = np.array([1e-3, 1e-6, 1e-9])
    vectors = 4e8 * np.stack([np.sin(away), 0 * away, np.cos(away)], axis=1)
    both = np.concatenate([vectors, vectors * [1, 1, -1]])
    _, declination, _ = spherical(both)
    found = np.pi / 2 - np.abs(declination)
    return float(np.max(np.abs(found - np.concatenate([away, away]))))


@CASES.hold(
    "a planet seen from another, kernel codes of barycentres",
    because="common legs of the two paths must cancel, not be subtracted",
    against="the same, seen the other way, over the distance",
    bound=5e-15,
)
def _both_ways() -> float:
    days = np.linspace(-30000.0, 15000.0, 50)
    kernel = _kernel()
    mars = kernel.code(MARS.naif, "mars")
    there = kernel.positions({"x": mars}, CENTRE, days)["x"]
    back = kernel.positions({"x": CENTRE}, mars, days)["x"]
    return float(np.max(np.abs(there + back)) / np.max(np.abs(there)))


@CASES.hold(
    "the Moon by way of either of its legs",
    because="the barycentre of planet and Moon lies inside the planet",
    against="Moon from planet less barycentre from planet, over the distance",
    bound=1e-14,
)
def _legs() -> float:
    days = np.linspace(-30000.0, 15000.0, 50)
    found = _kernel().positions({"moon": MOON.naif[0], "sun": BODIES["sun"].naif[0]}, CENTRE, days)
    seen = _kernel().positions({"sun": BODIES["sun"].naif[0]}, MOON.naif[0], days)["sun"]
    off = found["sun"] - found["moon"] - seen
    return float(np.max(np.abs(off)) / np.max(np.abs(found["sun"])))


@CASES.hold(
    "standstills in a span too short for one",
    because="an empty search must not pass for a find",
    against="none found in a month, and none in no time at all",
    bound=0.0,
)
def _no_standstill() -> float:
    def declination(days: FloatArray) -> FloatArray:
        return np.sin(days)

    return float(sum(len(find_standstills(declination, 0.0, end)) for end in (30.0, 0.0)))
