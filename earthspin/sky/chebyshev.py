"""Evaluate the Chebyshev series that store positions in an ephemeris kernel.

A segment of a kernel is a table of records of equal length in time, each with a series for x, y and
z. Two memory layouts give identical bits, because the operations for each time are the same:

- times in order, several per record: the coefficients of a record broadcast over its times;
- any other times: the coefficients are copied for each time.

Clenshaw's algorithm is used on arrays that fit in the processor's cache. Compared with jplephem,
which copies coefficients for each time and stores the terms for velocities, the same positions (to
rounding) take a quarter of the time for ordered times, and a third otherwise
(`tests/benchmarks/chebyshev.py`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY
from earthspin.numerics.arrays import FloatArray

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
        """For each time, return the index of its record, and its place there, from -1 to 1."""
        seconds = days * DAY
        record = ((seconds - self.start) / self.length).astype(np.int64)
        np.clip(record, 0, self.records - 1, out=record)
        # The subtracted value is a whole number of seconds, so the subtraction is exact.
        seconds -= self.start + record * self.length
        seconds *= 2 / self.length
        seconds -= 1
        return record, seconds


class Table(NamedTuple):
    """Chebyshev coefficients of all records in a kernel segment, and the times of the records.

    Attributes
    ----------
    series : ndarray, shape (records, 3 terms)
        Coefficients of x, then y, then z; the constant first.
    start, length : float
        Start of the first record in seconds from J2000.0, and length of a record in seconds.
    """

    series: FloatArray
    start: float
    length: float

    @property
    def grid(self) -> Grid:
        """Time intervals of the records of the segment."""
        return Grid(self.start, self.length, len(self.series))

    def positions(self, days: FloatArray) -> FloatArray:
        """Evaluate the Chebyshev series of the body's positions at given times.

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB, within the records; the end belongs to the last record.

        Returns
        -------
        ndarray, shape (3, n)
            In the unit of the coefficients.
        """
        sums = np.empty((3, days.size))
        for first in range(0, days.size, BLOCK):
            block = slice(first, first + BLOCK)
            sums[:, block] = self.at(Epochs(days[block]))
        return sums

    def at(self, epochs: Epochs) -> FloatArray:
        """Evaluate positions at given times, in the unit of the coefficients, shape (3, n).

        Tables with equal time grids can share the `Epochs`, which holds the arranged times.
        """
        return epochs.on(self.grid).sums(self.series)


class Epochs:
    """Times at which Chebyshev series are evaluated, with their arrangement for each segment.

    The arrangement of the times on each time grid is computed once.

    Parameters
    ----------
    days : ndarray, shape (n,)
        Days from J2000.0 TDB; not many more than `BLOCK`.
    """

    def __init__(self, days: FloatArray) -> None:
        self.days = days
        self._layouts: dict[Grid, _InOrder | _InAnyOrder] = {}

    def on(self, grid: Grid) -> _InOrder | _InAnyOrder:
        """Arrange the times for the evaluation of Chebyshev series with given record intervals."""
        if grid not in self._layouts:
            self._layouts[grid] = _laid_out(*grid.places(self.days))
        return self._layouts[grid]


def _laid_out(record: IntArray, place: FloatArray) -> _InOrder | _InAnyOrder:
    """Arrange times for Chebyshev series, as a matrix if they fill the kernel records evenly.

    Otherwise each time is evaluated by itself. A matrix also requires sorted times.
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
        within = np.arange(place.size) - starts[record - low]
        row = np.arange(longest)
        if longest >= counts.size:
            at, own, side = starts[:, None] + row, (record - low) * longest + within, -1
        else:
            at, own, side = starts + row[:, None], within * counts.size + (record - low), -2
        rows = place[np.minimum(at, place.size - 1)]
        return cls(slice(low, low + counts.size), rows, own, side)

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
    """Reorder Chebyshev coefficients from shape (n, 3 terms) to a contiguous (terms, 3, n)."""
    return np.ascontiguousarray(series.reshape(len(series), 3, -1).transpose(2, 1, 0))


def _clenshaw(series: FloatArray, place: FloatArray) -> FloatArray:
    """Evaluate Chebyshev series at arguments from -1 to 1, by Clenshaw's algorithm."""
    twice = 2 * place
    last = np.zeros((3, *place.shape))
    current = np.empty_like(last)
    current[...] = series[-1]
    if len(series) == 1:
        return current
    spare = np.empty_like(last)
    for coefficients in series[-2:0:-1]:
        np.multiply(twice, current, out=spare)
        spare -= last
        spare += coefficients
        last, current, spare = current, spare, last
    np.multiply(place, current, out=spare)
    spare -= last
    spare += series[0]
    return spare
