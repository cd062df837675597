"""Sums of Chebyshev series: positions from the records of a kernel.

A segment of a kernel is a table of records of equal length in time, each with a series for x, y
and z. Two ways of laying them out give the same bits, because each time sees the same products in
the same order:

- times in order, several to a record: the coefficients of a record stand at the side of its times;
- any other times: each is given the coefficients of its record.

The sums are Clenshaw's, in arrays that stay in the processor's cache. Against jplephem, which gives
coefficients to each time and keeps what a velocity would need, the same positions to rounding take
a quarter of the time in order, and a third out of it (`tests/benchmarks/chebyshev.py`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

#: Times summed at once: their arrays stay in the processor's cache.
BLOCK = 1 << 13

#: The same where each has coefficients of its own.
_BLOCK_OF_ANY = 1 << 11

#: Times to a record below which coefficients are given to each time.
_FEWEST_TO_A_RECORD = 2

#: How much longer than the mean the fullest record may be: rows are as long as it.
_UNEVEN = 1.5


class Grid(NamedTuple):
    """Records of equal length, one after another.

    Attributes
    ----------
    start, length : float
        Seconds from J2000.0 at which the first record begins, and seconds to a record.
    records : int
    """

    start: float
    length: float
    records: int

    def places(self, days: FloatArray) -> tuple[IntArray, FloatArray]:
        """Record of each time, and where in it the time stands, from -1 to 1."""
        seconds = days * DAY
        record = ((seconds - self.start) / self.length).astype(np.int64)
        np.clip(record, 0, self.records - 1, out=record)
        # What is subtracted is a whole number of seconds, so that no digit is lost again.
        seconds -= self.start + record * self.length
        seconds *= 2 / self.length
        seconds -= 1
        return record, seconds


class Table(NamedTuple):
    """Records of a segment.

    Attributes
    ----------
    series : ndarray, shape (records, 3 terms)
        Coefficients of x, then y, then z; the constant first.
    start, length : float
        Seconds from J2000.0 at which the first record begins, and seconds to a record.
    """

    series: FloatArray
    start: float
    length: float

    @property
    def grid(self) -> Grid:
        """Its records in time."""
        return Grid(self.start, self.length, len(self.series))

    def positions(self, days: FloatArray) -> FloatArray:
        """Sum the series at given times.

        Parameters
        ----------
        days : ndarray, shape (n,)
            From J2000.0 TDB, within the records; an end belongs to the last one.

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
        """Sum the series at times that other tables are summed at as well, shape (3, n)."""
        return epochs.on(self.grid).sums(self.series)


class Epochs:
    """Times that several tables are summed at; how they lie on a grid of records is found once.

    Parameters
    ----------
    days : ndarray, shape (n,)
        From J2000.0 TDB; not many more than `BLOCK`.
    """

    def __init__(self, days: FloatArray) -> None:
        self.days = days
        self._layouts: dict[Grid, _InOrder | _InAnyOrder] = {}

    def on(self, grid: Grid) -> _InOrder | _InAnyOrder:
        """How the times lie on a grid."""
        if grid not in self._layouts:
            self._layouts[grid] = _laid_out(*grid.places(self.days))
        return self._layouts[grid]


def _laid_out(record: IntArray, place: FloatArray) -> _InOrder | _InAnyOrder:
    """In rows, if times are in order and stand so close that the rows are nearly full."""
    if place.size >= _FEWEST_TO_A_RECORD:
        low, high = int(record[0]), int(record[-1])
        if (high - low) * _FEWEST_TO_A_RECORD < place.size and np.all(np.diff(record) >= 0):
            counts = np.bincount(record - low)
            if counts.max() * counts.size <= _UNEVEN * place.size + counts.max():
                return _InOrder.of(record, counts, place)
    return _InAnyOrder(record, place)


class _InOrder(NamedTuple):
    """Times in order, in rows as long as the fullest record, coefficients at the side.

    Many times to a record: the rows are records. Few: the rows are the first times of all
    records, the second ones, and so on; long rows are what numpy is fast on.

    Attributes
    ----------
    records : slice
        Those that have times.
    rows : ndarray
        Places in the records.
    own : ndarray, shape (n,)
        Where in the rows each time stands.
    side : int
        Axis of the rows along which a coefficient is the same.
    """

    records: slice
    rows: FloatArray
    own: IntArray
    side: int

    @classmethod
    def of(cls, record: IntArray, counts: IntArray, place: FloatArray) -> _InOrder:
        """Lay times out by their records and how many each of these has."""
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
        """Sums of the series of records, shape (3, n)."""
        coefficients = np.expand_dims(_coefficients(series[self.records]), self.side)
        return np.take(_clenshaw(coefficients, self.rows).reshape(3, -1), self.own, axis=1)


class _InAnyOrder(NamedTuple):
    """Any times: the coefficients of its record to each, in blocks that the cache holds."""

    record: IntArray
    place: FloatArray

    def sums(self, series: FloatArray) -> FloatArray:
        """Sums of the series of records, shape (3, n)."""
        sums = np.empty((3, self.place.size))
        for first in range(0, self.place.size, _BLOCK_OF_ANY):
            some = slice(first, first + _BLOCK_OF_ANY)
            coefficients = _coefficients(series[self.record[some]])
            sums[:, some] = _clenshaw(coefficients, self.place[some])
        return sums


def _coefficients(series: FloatArray) -> FloatArray:
    """From (n, 3 terms) to (terms, 3, n), side by side in memory."""
    return np.ascontiguousarray(series.reshape(len(series), 3, -1).transpose(2, 1, 0))


def _clenshaw(series: FloatArray, place: FloatArray) -> FloatArray:
    """Sum of series[k] T_k(place), over the first axis of the series."""
    twice = 2 * place
    last = np.zeros((3, *place.shape))
    now = np.empty_like(last)
    now[...] = series[-1]
    if len(series) == 1:
        return now
    spare = np.empty_like(last)
    for coefficients in series[-2:0:-1]:
        np.multiply(twice, now, out=spare)
        spare -= last
        spare += coefficients
        last, now, spare = now, spare, last
    np.multiply(place, now, out=spare)
    spare -= last
    spare += series[0]
    return spare
