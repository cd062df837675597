"""Read orbits over millions of years from published files and from data frames.

Two layouts are supported, recognised by column names or, without names, by the number of columns:

- elements, as written by HNBody and read by snvec: t (d), a, e, inc, then the longitude of
  perihelion (varpi, lph) or its argument (omega, arp), and the longitude of the node (Omega, lan);
- the layout of La2010 (Laskar et al. 2011, A&A 532, A89): t (kyr), a, l, k, h, q, p, where
  k + i h = e exp(i varpi) and q + i p = sin(inc/2) exp(i Omega).

Neither layout includes the reference frame, and a wrong frame is a common error. An orbit of the
Earth is therefore compared with the ecliptic at J2000.0.
"""

from __future__ import annotations

import itertools
import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike

from earthspin import tables
from earthspin.constants import ARCSEC, DAY, JULIAN_YEAR
from earthspin.errors import SeriesError, Where, no_plain_file
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.orbit_table import OrbitTable, fitted, load, shipped
from earthspin.sky.poles import direction
from earthspin.tables import BLANK, Meaning, Sheet
from earthspin.tables.layouts import ORBITS
from earthspin.units import Numbers, Word, time_scale

if TYPE_CHECKING:
    import pandas as pd


#: Units of time, s, and of angles, rad.
TIMES = {"d": DAY, "yr": JULIAN_YEAR, "kyr": 1000 * JULIAN_YEAR}
ANGLES = {"deg": math.pi / 180, "rad": 1.0}
#: Accepted names of columns, by the name used here and in declarations.
NAMES: dict[str, tuple[str, ...]] = {
    "t": ("t", "time"),
    "e": ("e", "ee", "ecc", "eccentricity"),
    "inc": ("inc", "i", "incl", "inclination"),
    "varpi": ("varpi", "lph", "pomega", "longitude_of_perihelion"),
    "omega": ("omega", "arp", "argp", "argument", "argument_of_perihelion"),
    "Omega": ("Omega", "lan", "node", "longitude_of_node"),
    "k": ("k",), "h": ("h",), "q": ("q",), "p": ("p",),
}  # fmt: skip
LA2010 = ("t", "k", "h", "q", "p")
#: Columns that are angles, without which elements cannot be read.
_ANGLES = ("inc", "varpi", "omega", "Omega")
#: Quantities by words in headers, for messages only.
_WORDS = {
    r"^t$|time|year|date|epoch": "t", r"^e$|ecc": "e", r"^i$|inc": "inc",
    r"varpi|pomega|long.*peri|lph|lop": "varpi", r"omega_?$|peri|arg|aop": "omega",
    r"node|lan|raan": "Omega", r"^([khqp])$": r"\1",
}  # fmt: skip
#: Largest median distance of the normals, or of the eccentricity vectors, from those of the
#: package; the argument of the perihelion for its longitude makes 0.007, degrees for radians 0.02.
SAME = 0.0015
#: Smallest number of rows, and smallest and largest spacing, s.
FEWEST, CLOSEST, FARTHEST = 16, JULIAN_YEAR, 5000 * JULIAN_YEAR
#: Ratio to the usual step above which a step is a gap.
GAP = 1.5
#: Number of points per window at which a table is checked after reading.
SAMPLES = 33
#: Largest change of the normal or eccentricity vector between rows.
LARGEST_MOVE = 0.1
#: Largest inclination of the Earth's orbit to the ecliptic at J2000.0, rad: short-period terms
#: reach 3 arcsec, and frames that may be confused differ by a degree or more.
NEAR_ECLIPTIC = 60 * ARCSEC
#: Eccentricities may exceed the largest in the body's own table by this factor. Over ten million
#: years those of the Earth reach 0.061; over fifty million, 0.067 (file of Laskar et al. 2004).
MOST_ECCENTRIC = 1.5
#: Obliquity of the ecliptic that defines ECLIPJ2000 (SPICE, after IAU 1976), rad.
OBLIQUITY = 84381.448 * ARCSEC
#: Pole of the Sun, ICRF, deg (IAU_SUN of SPICE; Archinal et al. 2018, CMDA 130, 22).
SUN_POLE = (286.13, 63.87)
#: Node and inclination of the Sun's equator on ECLIPJ2000 of snvec 3.7.5 and of the files of Zeebe
#: & Lourens 2019, deg: 0.1 degrees from those of SPICE.
SUN_EQUATOR = (75.5940, 7.155)
Table = Mapping[str, FloatArray]


def _ecliptic() -> FloatArray:
    c, s = math.cos(OBLIQUITY), math.sin(OBLIQUITY)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])


def _solar(pole: FloatArray) -> FloatArray:
    """Axes of the Sun's equator as rows; the first points to the ascending node on the ecliptic."""
    node = np.cross(_ecliptic()[2], pole)
    node /= np.linalg.norm(node)
    return np.stack([node, np.cross(pole, node), pole])


def axes_of(frame: str) -> FloatArray:
    """Axes of the named reference frame as unit vectors in the GCRS, one per row.

    Parameters
    ----------
    frame : str
        One of `FRAMES`.
    """
    if frame == "HCI":
        return _solar(direction(*np.radians(SUN_POLE)))
    if frame == "HCI-snvec":
        node, tilt = np.radians(SUN_EQUATOR)
        pole = [math.sin(tilt) * math.sin(node), -math.sin(tilt) * math.cos(node), math.cos(tilt)]
        return _solar(np.array(pole) @ _ecliptic())
    return _ecliptic() if frame == "ECLIPJ2000" else np.eye(3)


FRAMES = ("ECLIPJ2000", "HCI", "HCI-snvec", "ICRF")


def read_orbit(
    path: str | os.PathLike[str] | pd.DataFrame,
    *,
    body: str = "earth",
    frame: Literal["ECLIPJ2000", "HCI", "HCI-snvec", "ICRF"] | ArrayLike = "ECLIPJ2000",
    time: Literal["d", "yr", "kyr"] | None = None,
    angles: Literal["deg", "rad"] | None = None,
    columns: str | None = None,
) -> OrbitTable:
    """Read an orbit over millions of years from a file, for use in `long_term`.

    Parameters
    ----------
    path : str, Path or DataFrame
        A file written by `OrbitTable.to_file` (``.npz``), a text file, or a table of pandas or
        polars, with elements (t, a, e, inc, varpi or omega, Omega; also named lph, arp, lan) or in
        the layout of La2010 (t, a, l, k, h, q, p). Text files without names are recognised by their
        number of columns, and must agree with the orbit of the package around J2000.0. Times are
        from J2000.0 TDB, negative in the past, in either order.
    body : str
        Name of the orbiting body.
    frame : str or array_like, shape (3, 3)
        Reference frame: ``"ECLIPJ2000"`` and ``"HCI"`` as in SPICE, ``"HCI-snvec"`` for the Sun's
        equator
        as in snvec and the files of Zeebe & Lourens (2019), ``"ICRF"``, or the axes in the GCRS as
        rows.
    time : str, optional
        Unit of the times; by default days for elements and thousands of years for La2010.
    angles : str, optional
        Unit of inclination, perihelion and node; by default detected from their size.
    columns : str, optional
        Names of all columns, like ``"t (kyr ago), a, e, inc (deg), omega (deg), Omega (deg)"``; a
        column without a name is not read, and ``...`` at the end stands for any more columns.

    Returns
    -------
    OrbitTable
        Variations shorter than some thousand years are smoothed if rows are dense.

    Raises
    ------
    SeriesError
        For gaps, rows out of order or repeated, wrong units or frames, an eccentricity of 1 or more
        or above the range of the body, missing numbers, too few rows, or an unknown layout.

    Examples
    --------
    >>> import earthspin, numpy as np, pandas as pd
    >>> t = np.arange(-100.0, 1.0)
    >>> rows = pd.DataFrame({"t": t, "k": 0.01 * np.cos(t / 15), "h": 0.01 * np.sin(t / 15)})
    >>> orbit = earthspin.read_orbit(rows.assign(q=0.0, p=0.0))
    >>> past = earthspin.long_term("-20 kyr", "0 kyr", "5 kyr", orbit=orbit)
    >>> print(past.eccentricity.round(6).values)
    [0.01 0.01 0.01 0.01 0.01]
    """
    where = Where("read_orbit")
    axes = _axes(frame, where)
    for word, allowed, name in ((time, TIMES, "time"), (angles, ANGLES, "angles")):
        if word is not None:
            Word(allowed).read(word, where.at(name))
    if not isinstance(body, str):
        raise where.at("body").error(body, "give the name of a body, like 'mars'")
    if tables.is_frame(path):
        sheet = tables.of_frame(path)
    elif not isinstance(path, (str, os.PathLike)) or not os.fspath(path).strip():
        raise where.at("path").error(path, "give the path of a file, or a DataFrame")
    elif Path(path).suffix == ".npz":
        return _load(Path(path))
    else:
        sheet = tables.split(Path(path), ORBITS)
    meaning, declared = _meaning(sheet, columns, time, angles)
    rows = _Rows.of_sheet(sheet, meaning)
    _check_steps(rows)
    _check_times(rows)
    _compare(rows, declared, axes, body)
    table = _table(rows, body, axes, frame)
    return table if sheet.is_frame else replace(table, sha256=tables.checksum(Path(sheet.file)))


# --- columns and their meaning --------------------------------------------------------------------


def _meaning(
    sheet: Sheet, text: str | None, time: str | None, angles: str | None
) -> tuple[list[Meaning], bool]:
    """Columns with their units, and whether they are declared, and not told by their number.

    They are declared by the user, by the header, or by a layout that the header names.
    """
    sheet.refuse_text()
    layouts = [x for x in ORBITS if tables.fits(x.columns, sheet.width)]
    layout = sheet.layout if sheet.layout in layouts else None
    if text is not None:
        columns = sheet.as_declared(text)
    elif sheet.names and not layout:
        columns = [tables.column_of(name) for name in sheet.names]
    else:
        layout = layout or next((x for x in layouts if not x.head), None)
        if layout is None:
            problem = f"{sheet.width} columns without names are no known layout"
            raise sheet.error(problem, "name them, like columns='t (yr), k, h, q, p'")
        columns = tables.declared(layout.columns)
    places = _chosen(sheet, columns)
    units = {"t": time or "", **dict.fromkeys(_ANGLES, angles or "")}
    meaning = [BLANK] * sheet.width
    for name, place in places.items():
        unit, known = columns[place].unit, units.get(name)
        same = unit in ("", known) or (known and time_scale(unit) == time_scale(known))
        if known and not same and not (name == "t" and layout):
            key = "time" if name == "t" else "angles"
            problem = f"its header has '{columns[place]}'"
            raise sheet.error(problem, f"leave out {key} = {known!r}")
        meaning[place] = Meaning(name, known or unit)
    if not meaning[places["t"]].unit:
        meaning[places["t"]] = Meaning("t", "kyr" if "k" in places else "d")
    return meaning, bool(text or sheet.names or (layout and layout.head))


def _chosen(sheet: Sheet, columns: Sequence[Meaning]) -> dict[str, int]:
    """Return the column index of each orbital element, found by the column names."""
    names = [column.quantity for column in columns]
    places = tables.places(sheet.file, names, NAMES)
    if places.get("Omega") == places.get("omega") and "Omega" in places:
        del places["omega"]
    if set(LA2010) <= set(places):
        return {name: places[name] for name in LA2010}
    perihelion = next((name for name in ("varpi", "omega") if name in places), "varpi")
    required = ("t", "e", "inc", perihelion, "Omega")
    missing = [name for name in required if name not in places]
    if missing:
        problem = f"no column {' and none '.join(missing)} among {', '.join(names[:12])}"
        key = tables.typed([_by_words(name) for name in names])
        remedy = f"give t, e, inc, varpi, Omega, or t, k, h, q, p, like {key}"
        raise sheet.error(problem, remedy)
    return {name: places[name] for name in required}


def _by_words(name: str) -> Meaning:
    """Meaning of a column by the words of its header; blank if they are not known."""
    word = next((m.expand(q) for p, q in _WORDS.items() if (m := re.search(p, name, re.I))), "")
    return Meaning(word, "yr" if word == "t" else "")


def _compare(given: _Rows, declared: bool, axes: FloatArray, body: str) -> None:
    """Compare an orbit around J2000.0 with that of the package, if there is one of the body.

    Raises
    ------
    SeriesError
        If the columns agree with it only in another meaning, or their number alone tells their
        meaning and they do not agree.
    """
    known, meaning = shipped(body), given.meaning
    if known is None:
        return

    def misfit(columns: Sequence[Meaning]) -> float:
        try:
            rows = _Rows.of_sheet(given.sheet, columns)
            near = np.abs(rows.times) <= tables.NEAR * JULIAN_YEAR
            if np.count_nonzero(near) < tables.FEWEST:
                return math.nan
            vectors = np.array(rows.vectors())[:, near] @ axes
            if columns is not meaning and np.ptp(vectors, axis=1).max() < tables.CHANGE * SAME:
                return math.inf
        except SeriesError:
            return math.inf
        off = vectors - np.swapaxes(known.at(rows.times[near])[:2], 1, 2)
        return float(np.median(np.linalg.norm(off, axis=2), axis=1).max()) / SAME

    tables.refuse_other_meaning(given.sheet, meaning, _others(meaning), misfit)
    if not declared and 1 < misfit(meaning) < math.inf:
        problem = f"as {tables.typed(meaning)} its perihelion is not that of {body} today"
        raise given.sheet.error(problem, "give the right columns='...', or body =")


def _others(meaning: list[Meaning]) -> Iterator[list[Meaning]]:
    """Other meanings: of times, of angles, argument for longitude, and exchanged components."""
    unit = next(column.unit for column in meaning if column.quantity == "t")
    units = dict.fromkeys([unit, *TIMES, *(f"{word} ago" for word in TIMES)])
    exchanges: tuple[dict[str, str], ...] = (
        {},
        {"varpi": "omega", "omega": "varpi"},
        {"k": "h", "h": "k", "q": "p", "p": "q"},
    )
    for words in exchanges:
        for angles in ({}, {"deg": "rad", "rad": "deg"}):
            turned = tables.with_words(meaning, angles)
            inclined = [
                new if new.quantity == "inc" else old
                for old, new in zip(meaning, turned, strict=True)
            ]
            for time, columns in itertools.product(units, (turned, inclined)):
                yield tables.with_words(columns, words | {unit: time})


def _axes(frame: object, where: Where) -> FloatArray:
    if isinstance(frame, str):
        return axes_of(Word(FRAMES).read(frame, where.at("frame")))
    axes = Numbers("", "1", (3, 3)).read(frame, where.at("frame"))
    if not np.allclose(axes @ axes.T, np.eye(3), rtol=0, atol=1e-9):
        raise where.at("frame").error(frame, "give three unit vectors at right angles, as rows")
    return axes


def _load(file: Path) -> OrbitTable:
    if problem := no_plain_file(file):
        raise SeriesError(file, problem)
    try:
        table = load(file)
    except OSError as error:
        raise SeriesError(file, f"it cannot be read: {error.strerror or error}") from None
    except Exception:  # errors of zipfile, zlib, tokenize and numpy
        raise SeriesError(file, "it is no table that to_file wrote", "write it again") from None
    # n.n = 1 requires the two stored components to have a norm below 1
    basis = legendre.legvander(
        np.cos(np.linspace(0, np.pi, SAMPLES)), table.coefficients.shape[-1] - 1
    )
    n1, n2, e1, e2 = table.coefficients @ basis.T
    if not (np.max(n1**2 + n2**2) < 1 and np.max(e1**2 + e2**2) < 1):
        raise SeriesError(file, "its numbers are those of no orbit", "write it again")
    return table


@dataclass(frozen=True)
class _Rows:
    """Columns of orbital elements, as read from the user's file or data frame.

    Attributes
    ----------
    sheet : Sheet
    meaning : list of Meaning
        Meaning of the columns of the table, all angles with their units.
    columns : Table
        Columns by the names used here: times in the unit of the table, angles in radians.
    unit : str
        Unit of the times, d, yr or kyr.
    """

    sheet: Sheet
    meaning: list[Meaning]
    columns: Table
    unit: str

    @classmethod
    def of_sheet(cls, sheet: Sheet, columns: Sequence[Meaning]) -> _Rows:
        """Read the columns of orbital elements from a table."""
        data = {c.quantity: sheet.column(place) for place, c in enumerate(columns) if c.quantity}
        for name, column in data.items():
            problem, remedy = f"{name} is not a number", "fill it, or leave out rows"
            sheet.refuse(~np.isfinite(column), problem, remedy)
        units = {column.quantity: column.unit for column in columns}
        angles = data.keys() & {*_ANGLES}
        if angles:
            unit = _unit_of_angles(sheet, data, units["Omega"])
            columns = [
                c._replace(unit=c.unit or unit) if c.quantity in angles else c for c in columns
            ]
        data |= {name: sheet.values(columns, name, "rad") for name in angles}
        if units["t"] in TIMES:
            return cls(sheet, [*columns], data, units["t"])
        return cls(sheet, [*columns], data | {"t": sheet.values(columns, "t", "yr")}, "yr")

    @property
    def times(self) -> FloatArray:
        """Times from J2000.0, s."""
        return np.asarray(self.columns["t"] * TIMES[self.unit])

    def vectors(self) -> tuple[FloatArray, FloatArray]:
        """Unit normals and eccentricity vectors, shape (n, 3) each."""
        return (_from_sines if "k" in self.columns else _from_elements)(self)


def _table(rows: _Rows, body: str, axes: FloatArray, frame: object) -> OrbitTable:
    sheet, times = rows.sheet, rows.times
    n, e = rows.vectors()
    _check_moves(sheet, n, e)
    order = slice(None, None, 1 if times[0] < times[-1] else -1)
    present = np.array([np.interp(0.0, times[order], component) for component in n[order].T])
    if body == "earth":
        _check_ecliptic(sheet, present, axes, frame)
    _check_body(sheet, np.linalg.norm(e, axis=1), body)
    times, n, e = times[order], n[order] @ axes, e[order] @ axes
    third = np.mean(n, axis=0)
    third /= np.linalg.norm(third)
    if np.min(n @ third) < 0.5:
        raise sheet.error("the orbit tips over by more than 60 degrees", "give a shorter part")
    first = np.cross(third, np.eye(3)[np.argmin(np.abs(third))])
    first /= np.linalg.norm(first)
    basis = np.stack([first, np.cross(third, first), third])
    name = Path(sheet.file).name
    return fitted(body, times, n, e, basis, f"{name}, {'given axes' if frame is axes else frame}")


def _check_steps(rows: _Rows) -> None:
    """Refuse gaps, repeated times, rows out of order, and too few rows."""
    sheet, t = rows.sheet, rows.columns["t"]
    if t.size < FEWEST:
        raise sheet.error(f"{t.size} rows are too few", f"give {FEWEST} or more")
    steps = np.diff(t, prepend=np.nan) * (1 if t[-1] > t[0] else -1)  # from the row before
    times = {"time": t, "last": np.roll(t, 1)}
    sheet.refuse(steps == 0, "time {time:g} stands twice", "keep one of the rows", **times)
    problem = "time {time:g} comes after {last:g}"
    sheet.refuse(steps < 0, problem, "sort the rows by time", **times)
    usual = float(np.nanmedian(steps))
    problem = f"a gap between times {{last:g}} and {{time:g}}; rows are {usual:g} apart"
    sheet.refuse(steps > GAP * usual, problem, "fill it, or give a part without gaps", **times)


def _check_times(rows: _Rows) -> None:
    """Refuse times in another unit, and those without J2000.0."""
    times, unit = rows.times, rows.unit
    step = float(np.median(np.abs(np.diff(times))))
    if not CLOSEST <= step <= FARTHEST:
        raise rows.sheet.error(
            f"with times in {unit} rows are {step / JULIAN_YEAR:.3g} yr apart, where 1 to 5000 yr "
            "can be used",
            f"is it another unit? time = {' or '.join(repr(u) for u in TIMES if u != unit)}",
        )
    first, last = np.min(times), np.max(times)
    if not first <= 0 <= last:
        problem = f"it covers {first / TIMES['kyr']:g} to {last / TIMES['kyr']:g} kyr"
        raise rows.sheet.error(
            problem, "J2000.0, from which the axis starts, must be among the times"
        )


def _from_sines(rows: _Rows) -> tuple[FloatArray, FloatArray]:
    """Unit normals and eccentricity vectors from the variables k, h, q, p, shape (n, 3) each."""
    k, h, q, p = (rows.columns[name] for name in ("k", "h", "q", "p"))
    half = q * q + p * p  # squared sine of half the inclination
    rows.sheet.refuse(half >= 1, "sin(inc/2) is 1 or more", "are q and p angles?")
    _check_eccentricity(rows.sheet, np.hypot(k, h))
    c = 2 * np.sqrt(1 - half)
    normal = np.stack([c * p, -c * q, 1 - 2 * half], axis=1)
    # axes in the plane of the orbit from which longitudes count
    f = np.stack([1 - 2 * p * p, 2 * p * q, -c * p], axis=1)
    g = np.stack([2 * p * q, 1 - 2 * q * q, c * q], axis=1)
    return normal, k[:, np.newaxis] * f + h[:, np.newaxis] * g


def _from_elements(rows: _Rows) -> tuple[FloatArray, FloatArray]:
    """Unit normals and eccentricity vectors from Keplerian elements, shape (n, 3) each."""
    e = rows.columns["e"]
    _check_eccentricity(rows.sheet, e)
    tilt, node = rows.columns["inc"], rows.columns["Omega"]
    outside = (tilt < 0) | (tilt > math.pi)
    rows.sheet.refuse(outside, "an inclination lies between 0 and 180 degrees")
    argument = rows.columns["omega"] if "omega" in rows.columns else rows.columns["varpi"] - node
    ci, si, cn, sn = np.cos(tilt), np.sin(tilt), np.cos(node), np.sin(node)
    cw, sw = np.cos(argument), np.sin(argument)
    normal = np.stack([si * sn, -si * cn, ci], axis=1)
    to = np.stack([cn * cw - sn * sw * ci, sn * cw + cn * sw * ci, sw * si], axis=1)
    return normal, e[:, np.newaxis] * to


def _check_eccentricity(sheet: Sheet, e: FloatArray) -> None:
    outside = ~((e >= 0) & (e < 1))
    sheet.refuse(outside, "an eccentricity of {e:g}", "it lies between 0 and 1", e=e)


def _unit_of_angles(sheet: Sheet, data: Table, declared: str) -> str:
    """Unit of the angles in a table: as declared, unless their values contradict it, or by size."""
    turning = [data[name] for name in _ANGLES[1:] if name in data]
    largest = max(float(np.max(np.abs(column))) for column in turning)
    jump = max(float(np.max(np.abs(np.diff(column)), initial=0.0)) for column in turning)
    steep, within_turn = np.max(data["inc"]) > math.pi, largest <= 2 * math.pi * (1 + 1e-6)
    if declared == "rad" and (steep or 180 < jump <= 360.001):
        problem = f"angles reach {largest:g}: these are degrees, not radians"
        raise sheet.error(problem, "give angles = 'deg'")
    if declared == "deg" and within_turn and jump > 1.5 * math.pi:
        problem = f"angles go round at {largest:.4g}: these are radians, not degrees"
        raise sheet.error(problem, "give angles = 'rad'")
    if not declared and not steep and not within_turn and largest > 360.001:
        problem = f"angles reach {largest:g}: degrees or radians that go on past a turn?"
        raise sheet.error(problem, "say which: angles = 'deg' or 'rad'")
    return declared or ("rad" if within_turn and not steep else "deg")


def _check_moves(sheet: Sheet, normal: FloatArray, eccentricity: FloatArray) -> None:
    for name, vectors in (("the orbit's plane", normal), ("its perihelion", eccentricity)):
        moves = np.linalg.norm(np.diff(vectors, axis=0), axis=1)
        if moves.max() > LARGEST_MOVE:
            problem = f"{name} jumps by {moves.max():.2g} from one row to the next"
            remedy = "are time or angles in other units? angles = 'deg' or 'rad'"
            raise sheet.error(problem, remedy, int(np.argmax(moves)) + 1)


def _check_ecliptic(sheet: Sheet, normal: FloatArray, axes: FloatArray, frame: object) -> None:
    """Refuse an orbit of the Earth far from the ecliptic at J2000.0; suggest another frame."""

    def lean(frame_axes: FloatArray) -> float:
        n = normal @ frame_axes
        return math.acos(min(float(n @ _ecliptic()[2] / np.linalg.norm(n)), 1.0))

    if lean(axes) <= NEAR_ECLIPTIC:
        return
    fits = [word for word in FRAMES if lean(axes_of(word)) <= NEAR_ECLIPTIC]
    name = frame if isinstance(frame, str) else "the axes given"
    raise sheet.error(
        f"in {name} the Earth's orbit leans {math.degrees(lean(axes)):.2g} deg on the ecliptic at "
        "J2000.0",
        f"it fits frame = '{fits[0]}'" if fits else "other axes or angles? or another body: body =",
    )


def _check_body(sheet: Sheet, e: FloatArray, body: str) -> None:
    """Refuse eccentricities far above the largest one in the package's orbit table of the body."""
    largest = _largest_eccentricity(body)
    if largest is not None:
        problem = f"an eccentricity of {{e:g}}, where that of {body} stays below {largest:.2g}"
        sheet.refuse(e > MOST_ECCENTRIC * largest, problem, "is it another body? body =", e=e)


@cache
def _largest_eccentricity(body: str) -> float | None:
    """Largest eccentricity in the package's orbit table of a body; None if there is no table."""
    table = shipped(body)
    if table is None:
        return None
    times = np.arange(table.edges[0], table.edges[-1], TIMES["kyr"])
    return float(np.linalg.norm(table.at(times)[1], axis=0).max())
