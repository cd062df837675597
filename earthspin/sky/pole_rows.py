"""Rows of tables of the pole: what can be repaired is repaired and said, all else is refused."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from earthspin.constants import ARCSEC
from earthspin.errors import SeriesError
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.tables import MJD_0

#: Columns of rows: line of the file, date, values and their standard deviations, arcsec.
COLUMNS = ("line", "mjd", "x", "y", "x_error", "y_error")
#: Longest gap that is interpolated linearly, in steps and in days; the oldest tables have ten rows
#: per year.
LONGEST_BRIDGE, LONGEST_DAYS = 10, 37.0
#: Largest fraction of rows without numbers that is ignored; one such row is always ignored.
LOST = 0.01
#: Tolerance of evenly spaced dates, as a fraction of a step.
DATE_ROUNDING = 1e-3
#: Period of the free wobble, used to report the error of interpolation, d.
FREE_WOBBLE = 433.0
#: First day after the optical observations of the table C01, MJD of 1962-01-01.
_AFTER_OPTICAL = 37665.0


@dataclass(frozen=True)
class Coordinates:
    """Names and plausibility limits (arcsec) of polar motion, or of celestial pole offsets.

    Attributes
    ----------
    name, words : str
        Name of the two together, and of each, in messages.
    flag : int
        Number of the column "type" that marks rows as observed or predicted, if there are several.
    datum : str
        Their name in the header of EOP2.
    largest, smallest : float
        Larger values, and tables whose largest value is smaller, are in another unit, arcsec.
    fastest, jump : float
        Largest motion in a day, and largest further change that is not a jump, arcsec.
    """

    name: str
    words: str
    flag: int
    datum: str
    largest: float
    smallest: float
    fastest: float
    jump: float


#: Polar motion has never passed 0.7 arcsec, and never stayed within a milliarcsecond of the origin.
POLAR_MOTION = Coordinates(
    "polar motion", "x, y", 0, "UTPM", largest=2.0, smallest=1e-3, fastest=0.01, jump=0.1
)
#: Offsets from IAU 2006/2000A have never passed 9 mas; those from IAU 1980 pass 20 mas since 1991.
POLE_OFFSETS = Coordinates(
    "celestial pole offsets", "dX, dY", 2, "DX,DY", 0.02, smallest=1e-5, fastest=1e-4, jump=5e-3
)
_NO_OPTICAL = "before 1962 they are optical; give a span that begins in 1962 or later"
NOT_IAU_1980 = "offsets from IAU 2006/2000A are needed; are they from IAU 1980?"


def refuse(file: object, rows: FloatArray, wrong: BoolArray, problem: str, remedy: str) -> None:
    """Raise an error for the first wrong row, if any; the message contains the row's values."""
    if wrong.any():
        row = dict(zip(COLUMNS, rows[np.argmax(wrong)], strict=False))
        raise SeriesError(file, problem.format(**row), remedy, int(row["line"]))


def complete(file: object, rows: FloatArray, text: list[int], repairs: list[str]) -> FloatArray:
    """Remove rows without pole coordinates, and note how many; refuse a table with too many.

    Lines of text between rows count as such rows.
    """
    refuse(file, rows, ~np.isfinite(rows[:, 1]), "the date is {mjd}", "give each row a date")
    complete = rows[np.isfinite(rows[:, 2:4]).all(axis=1)]
    gaps = sorted([*text, *np.setdiff1d(rows[:, 0], complete[:, 0]).astype(int).tolist()])
    if gaps:
        if len(gaps) > max(1, LOST * (len(complete) + len(gaps))):
            problem = f"{len(gaps)} of {len(complete) + len(gaps)} rows hold no numbers"
            remedy = f"at most {LOST:.0%} are left out; is the file damaged?"
            raise SeriesError(file, problem, remedy, gaps[0])
        repairs.append(f"{len(gaps)} rows without numbers left out, the first in line {gaps[0]}")
    return complete


def check_size(file: object, rows: FloatArray, pair: Coordinates, name: str) -> None:
    """Refuse pole coordinates of implausible size (wrong unit or model), and negative errors."""
    values, size = f"{pair.words} = {{x:g}}, {{y:g}} arcsec", np.hypot(rows[:, 2], rows[:, 3])
    suspect = np.max(abs(rows[:, 2:4]), axis=1) > pair.largest
    remedy = f"{pair.name} stays below {pair.largest / 2:g}; is it in milliarcseconds?"
    if pair is POLE_OFFSETS and suspect.any():
        optical = name == "c01" and rows[suspect][0, 1] < _AFTER_OPTICAL
        remedy = _NO_OPTICAL if optical else NOT_IAU_1980
    refuse(file, rows, suspect, values, remedy)
    problem = f"errors of {pair.words} = {{x_error:g}}, {{y_error:g}} arcsec"
    remedy = "errors are not negative; is a column lost?"
    refuse(file, rows, np.any(rows[:, 4:] < 0, axis=1), problem, remedy)
    if 0 < size.max() < pair.smallest:
        remedy = f"the pole moves farther than {pair.smallest:g} arcsec; is it in radians?"
        refuse(file, rows, size == size.max(), f"{values}, and no more elsewhere", remedy)


def check_jumps(file: object, rows: FloatArray, pair: Coordinates) -> None:
    """Refuse a jump of the pole that is too large for its usual motion and the stated errors."""
    step, error = abs(np.diff(rows, axis=0)), np.nansum(rows[:, 4:], axis=1)
    limit = pair.jump + pair.fastest * step[:, 1] + 3 * (error[1:] + error[:-1])
    wrong = np.max(step[:, 2:4], axis=1) > limit
    step[:, 0] = rows[1:, 0]
    problem = "the pole jumps by {x:.3g}, {y:.3g} arcsec in {mjd:.4g} d"
    remedy = f"it moves by less than {pair.fastest:g} arcsec a day; is a digit wrong?"
    refuse(file, step, wrong, problem, remedy)


def in_order(file: object, rows: FloatArray, repairs: list[str]) -> FloatArray:
    """Sort rows by date; remove repeated rows, and refuse different rows with the same date."""
    order = np.argsort(rows[:, 1], kind="stable")
    if np.any(np.diff(order) < 0):
        repairs.append("rows sorted by date")
    ordered = rows[order]
    step = np.diff(ordered, axis=0)
    repeated = step[:, 1] <= 1e-6
    other = repeated & np.any(np.nan_to_num(step[:, 2:]) != 0, axis=1)
    problem = "MJD {mjd:.2f} stands twice, with different numbers"
    refuse(file, ordered[1:], other, problem, "keep one of the two rows")
    if repeated.any():
        repairs.append(f"{np.count_nonzero(repeated)} repeated rows left out")
    return np.asarray(ordered[np.append(True, ~repeated)])


def without_fillers(rows: FloatArray, pair: Coordinates, repairs: list[str]) -> FloatArray:
    """Leave out rows of zeros where nothing was observed.

    These are rows in which a value and its error are zero, as for y of C01 from 1858.9 to 1860.9,
    and the offsets of zero with which C04 and C01 begin.
    """
    zero = rows[:, 2:4] == 0
    filled = np.any(zero & (rows[:, 4:] == 0), axis=1)
    if pair is POLE_OFFSETS:
        filled |= np.logical_and.accumulate(zero.all(axis=1))
    if filled.any():
        first, last = map(day_of, rows[filled][[0, -1], 1])
        count = np.count_nonzero(filled)
        repairs.append(f"{count} rows of zeros, not observed, left out, {first} to {last}")
    return np.asarray(rows[~filled])


def without_gaps(
    rows: FloatArray, span: tuple[float, float], filled: bool, repairs: list[str]
) -> FloatArray:
    """Select the part of the rows, between long gaps, that holds a span.

    Parameters
    ----------
    rows : array, shape (n, 6)
        In order of time.
    span : tuple of float
        First and last modified Julian date that are wanted; infinite if all are.
    filled : bool
        Whether rows were left out because nothing was observed. Without a span the longest part is
        then selected, and the repairs say so; any other gap must be closed by the user.
    repairs : list of str
    """
    steps = np.diff(rows[:, 1])
    parts = np.split(rows, np.flatnonzero(steps > _longest_bridge(steps)) + 1)
    wanted = [p for p in parts if len(p) > 1 and p[0, 1] <= span[1] and p[-1, 1] >= span[0]]
    if len(parts) == 1 or len(wanted) == 1:
        return wanted[0] if len(wanted) == 1 else rows
    if not filled or math.isfinite(max(span)):
        return rows
    longest = max(parts, key=len)
    first, last = map(day_of, longest[[0, -1], 1])
    repairs.append(f"the longest part without gaps kept, {first} to {last}; a span selects another")
    return longest


def _longest_bridge(steps: FloatArray) -> float:
    """Longest gap that is bridged between rows with given steps, d."""
    usual = float(np.median(steps))
    return min(LONGEST_BRIDGE * usual, max(LONGEST_DAYS, usual)) * (1 + DATE_ROUNDING)


def evenly_spaced(file: object, rows: FloatArray, repairs: list[str]) -> FloatArray:
    """Interpolate rows to evenly spaced dates, about the median step apart; refuse long gaps.

    Returns
    -------
    array, shape (n, 5)
        Modified Julian dates, and values and standard deviations in rad.
    """
    mjd, values = rows[:, 1], rows[:, 2:] * ARCSEC
    steps = np.diff(mjd)
    usual, bridge = float(np.median(steps)), _longest_bridge(steps)
    longest = int(np.argmax(steps))
    if steps[longest] > bridge:
        problem = f"a gap of {steps[longest]:.1f} d follows MJD {mjd[longest]:.2f}"
        remedy = f"gaps up to {bridge:.0f} d are bridged; take a span on one side of it"
        raise SeriesError(file, problem, remedy, int(rows[longest, 0]))
    # Dates are rounded: the mean of all steps is more accurate than a single step.
    count = round((mjd[-1] - mjd[0]) / usual)
    days = int(np.sum(np.round(steps / usual)))
    count = days if abs(days - count) <= DATE_ROUNDING * count else count
    even = np.linspace(mjd[0], mjd[-1], count + 1)
    step = float(even[1] - even[0])
    if even.size != mjd.size or np.max(abs(even - mjd)) > DATE_ROUNDING * step:
        cut = (math.pi * steps[longest] / FREE_WOBBLE) ** 2 / 2
        repairs.append(
            f"{max(even.size - mjd.size, 0)} missing steps bridged by straight lines, which cut "
            f"a wobble of {FREE_WOBBLE:g} d by up to {cut:.1%}"
        )
        values = np.column_stack([np.interp(even, mjd, column) for column in values.T])
    return np.column_stack([even, values])


def day_of(mjd: float) -> str:
    """Calendar date, as text like ``"1962-01-01"``, of a modified Julian date."""
    return str(MJD_0 + np.timedelta64(int(mjd // 1), "D"))
