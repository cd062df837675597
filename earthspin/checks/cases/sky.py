"""Stiff and extreme cases of kernels, equators and nutation."""

from __future__ import annotations

import struct
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import erfa
import numpy as np
from jplephem.daf import DAF
from numpy.typing import NDArray

from earthspin.bodies import MARS, MOON
from earthspin.checks.case import Distances, holds, refused, relative_error, without_folder
from earthspin.checks.sky import BODY, CENTRE, CODES, kernel, positions
from earthspin.constants import DAY, J2000_JD
from earthspin.questions.torque import torque_series
from earthspin.sky.ephemeris import Ephemeris
from earthspin.sky.equator import fixed_equator, spherical
from earthspin.sky.iau import Nutation, mean_equator
from earthspin.sky.standstill import find_standstills

FloatArray = NDArray[np.float64]

SECOND = 1 / DAY


def _ends() -> tuple[float, float]:
    return kernel().coverage({CODES["moon"], CENTRE})


def _moon(days: FloatArray) -> FloatArray:
    return positions(days)["moon"]


@holds(bound=0.02)
def _first_and_last() -> Distances:
    """the Moon in the first and last minutes of the kernel

    Hard because: a record read one too far is extrapolated without a word
    Held against: the acceleration by Newton's law from both masses, over itself; the Sun's tide is
        1 %
    """
    start, end = _ends()
    minute = 60 * SECOND
    for days in (start + minute * np.array([0.0, 5.0, 10.0]), end - minute * np.arange(0, 11, 5.0)):
        place = _moon(days)
        step = (days[1] - days[0]) * DAY
        seen = (place[0] - 2 * place[1] + place[2]) / step**2
        size = np.linalg.norm(place[1])
        law = -(MOON.gm + BODY.gm) * place[1] / size**3
        yield np.linalg.norm(seen - law) / np.linalg.norm(law)


@holds(bound=3e-11)
def _torque_at_the_ends() -> Distances:
    """torques at the very first and last epoch of the kernel

    Hard because: nutation wants nodes beyond the ends, the kernel has none
    Held against: the same epoch inside a series, over the largest torque
    """
    alone = torque_series(times=["1899-07-29", "2053-10-09"], equator="true")
    before = torque_series("1899-07-29", "1899-08-03", "1 h", equator="true")
    after = torque_series("2053-10-04T05:00", "2053-10-09", "1 h", equator="true")
    yield abs(alone.torque[0] - before.torque[0]).max() / abs(before.torque).max()
    yield abs(alone.torque[1] - after.torque[-1]).max() / abs(after.torque).max()


@refused("outside kernel")
def _before() -> None:
    """one second before the kernel

    Hard because: a polynomial gives numbers outside its range, too
    """
    _moon(np.array([_ends()[0] - SECOND]))


@refused("outside kernel")
def _after() -> None:
    """one second after the kernel

    Hard because: the reader extrapolates a whole record past the last
    """
    _moon(np.array([0.0, _ends()[1] + SECOND]))


@refused("outside kernel")
def _nan_time() -> None:
    """a time that is not a number

    Hard because: NaN is neither before nor after the ends
    """
    _moon(np.array([0.0, np.nan]))


@refused("cut short")
def _cut() -> None:
    """a kernel cut in half

    Hard because: its directory still promises what is no longer there
    """
    with tempfile.TemporaryDirectory() as folder:
        half = Path(folder) / "half.bsp"
        whole = kernel().path.read_bytes()
        half.write_bytes(whole[: len(whole) // 2])
        with without_folder(half):
            Ephemeris(half)


@contextmanager
def _changed(offset: int, form: str, *values: float) -> Iterator[Path]:
    """A copy of the kernel with other numbers at one place."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "changed.bsp"
        data = bytearray(kernel().path.read_bytes())
        struct.pack_into(_daf().endian + form, data, offset, *values)
        copy.write_bytes(data)
        with without_folder(copy):
            yield copy


def _daf() -> DAF:
    return kernel()._segments[_TO_MOON].daf


def _summaries() -> int:
    """Byte at which the list of segments begins: the number of the next record stands there."""
    return 1024 * (int(_daf().fward) - 1)


_TO_MOON = (3, CODES["moon"])


@refused("never ends")
def _endless() -> None:
    """a kernel whose list of segments names itself as the next

    Hard because: read on and on, it fills the memory
    """
    with _changed(_summaries(), "d", _daf().fward) as path:
        Ephemeris(path)


@refused("does not move")
def _wrong_centre() -> None:
    """a kernel whose Moon hangs on the planet, not on their barycentre

    Hard because: 1.2 % nearer is within its orbit: the distance is possible
    """
    place = list(kernel()._segments).index(_TO_MOON)
    with _changed(_summaries() + 24 + 40 * place + 20, "i", CENTRE) as path:
        Ephemeris(path)


@refused("other times")
def _late() -> None:
    """a kernel whose records start a second late

    Hard because: every position is smooth, and a kilometre off
    """
    segment = kernel()._segments[_TO_MOON]
    first = segment.daf.read_array(segment.end_i - 3, segment.end_i - 3)[0]
    with _changed(8 * (segment.end_i - 4), "d", first + 1.0) as path:
        Ephemeris(path)


@refused("jumps")
def _metre_off() -> None:
    """a kernel with one coefficient of the Moon a metre off

    Hard because: one record of 14080, and by 3e-9 of the distance
    """
    segment = kernel()._segments[_TO_MOON]
    word = segment.start_i + 7500 * kernel()._records[_TO_MOON].size + 5
    old = segment.daf.read_array(word, word)[0]
    with _changed(8 * (word - 1), "d", old + 1e-3) as path:
        Ephemeris(path).positions(CODES, CENTRE, np.arange(*_ends(), 3.0))


@refused("its SHA-256 is")
def _another_hash() -> None:
    """a kernel with a name, one byte of its comment changed

    Hard because: no number shows it
    """
    with _changed(1024, "B", 0) as path:
        Ephemeris(path, name="de421").positions(CODES, CENTRE, np.array([0.0]))


@refused("does not hold")
def _no_such_body() -> None:
    """a body that the kernel does not hold

    Hard because: its neighbour's code would give a plausible place
    """
    with without_folder(kernel().path):
        kernel().code((999,), "pluto")


@holds(bound=1e-11, unit="rad")
def _nutation_ends() -> Distances:
    """nutation nodes at both ends

    Hard because: a spline is worst at its ends
    Held against: ERFA's pnm06a, epochs within an hour of the first and the last node
    """
    for day in (-36000.0, 0.0, 19000.0):
        days = day + np.concatenate([np.linspace(0, 0.04, 20), np.linspace(29.96, 30.0, 20)])
        ours = Nutation(days[0], days[-1], 1000).true_equator(days)
        yield ours - erfa.pnm06a(J2000_JD, days)


@holds(bound=5e-15)
def _orthogonal() -> Distances:
    """mean equator from 1550 to 2650

    Hard because: polynomials of the fifth degree, eleven centuries from one end to the other
    Held against: an orthogonal matrix
    """
    matrix = mean_equator(np.linspace(-164_000.0, 237_000.0, 50))
    yield matrix @ np.swapaxes(matrix, 1, 2) - np.eye(3)


@holds(bound=5e-15)
def _no_equinox() -> Distances:
    """equator of an axis upright on its orbit

    Hard because: it has no equinox: the node is a vector of zeros
    Held against: right-handed unit axes whose third is the spin axis
    """
    for axis in (np.array([0.0, 0.0, 1.0]), np.array([0.6, 0.0, -0.8])):
        for normal in (axis, -axis, axis + np.array([0.0, 1e-13, 0.0])):
            matrix = fixed_equator(axis, normal)
            yield matrix @ matrix.T - np.eye(3)
            yield matrix[2] - axis


@holds(bound=5e-15, unit="rad")
def _beside_the_pole() -> Distances:
    """declinations beside the poles of the sky

    Hard because: an arc sine there is right to half the digits alone
    Held against: the distance from the pole that was put in
    """
    away = np.array([1e-3, 1e-6, 1e-9])
    vectors = 4e8 * np.stack([np.sin(away), 0 * away, np.cos(away)], axis=1)
    both = np.concatenate([vectors, vectors * [1, 1, -1]])
    _, declination, _ = spherical(both)
    found = np.pi / 2 - np.abs(declination)
    yield found - np.concatenate([away, away])


@holds(bound=5e-15)
def _both_ways() -> Distances:
    """a planet seen from another, kernel codes of barycentres

    Hard because: common legs of the two paths must cancel, not be subtracted
    Held against: the same, seen the other way, over the distance
    """
    days = np.linspace(-30000.0, 15000.0, 50)
    mars = kernel().code(MARS.naif, "mars")
    there = kernel().positions({"x": mars}, CENTRE, days)["x"]
    back = kernel().positions({"x": CENTRE}, mars, days)["x"]
    yield relative_error(-back, there)


@holds(bound=1e-14)
def _legs() -> Distances:
    """the Moon by way of either of its legs

    Hard because: the barycentre of planet and Moon lies inside the planet
    Held against: Moon from planet less barycentre from planet, over the distance
    """
    days = np.linspace(-30000.0, 15000.0, 50)
    found = positions(days)
    from_moon = kernel().positions({"sun": CODES["sun"]}, CODES["moon"], days)["sun"]
    yield relative_error(found["moon"] + from_moon, found["sun"])


@holds(bound=0.0)
def _no_standstill() -> Distances:
    """standstills in a span too short for one

    Hard because: an empty search must not pass for a find
    Held against: none found in a month, and none in no time at all
    """
    for end in (30.0, 0.0):
        yield len(find_standstills(np.sin, 0.0, end))
