"""Read effective angular momentum functions of atmosphere, ocean and land water from files.

The layout is the common one: year, month, day, hour, MJD, then chi1, chi2, chi3 of the mass term
and, if there is one, of the motion term, as pure numbers (Dobslaw & Dill 2018, GFZ, user's guide).
There is one file for each year and component, and the years may overlap.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from earthspin import tables
from earthspin.errors import SeriesError, nearest
from earthspin.numerics.arrays import Array, ComplexArray, FloatArray
from earthspin.tables import Meaning, Sheet
from earthspin.tables.layouts import ANGULAR_MOMENTUM

#: Components, by the word in the file name.
COMPONENTS = {"AAM": "atmosphere", "OAM": "ocean", "HAM": "hydrology", "SLAM": "sea level"}
#: Mass and motion terms, by which a component excites polar motion.
TERMS = ("mass", "motion")
#: Fields of the series: equatorial and axial part of each term.
_FIELDS = {"mass": complex, "motion": complex, "mass3": float, "motion3": float}
_NAMES = ("mass1", "mass2", "mass3", "motion1", "motion2", "motion3")
#: Row of a file: the place of the file in the list of files, its line, its date and both terms.
_ROW = np.dtype([("file", int), ("line", int), ("mjd", float), *_FIELDS.items()])
#: Plausibility bound, rad: 20 arcsec, more than any observed value.
LARGEST = 1e-4
#: Tolerance for equal dates, d.
SAME_TIME = 1e-6


@dataclass(frozen=True)
class AngularMomentum:
    """Effective angular momentum functions: time series of the mass term and of the motion term.

    Attributes
    ----------
    mjd : array, shape (n,)
        Modified Julian dates, evenly spaced.
    mass, motion : complex array, shape (n,)
        Mass and motion terms, chi1 + i chi2, rad.
    mass3, motion3 : array, shape (n,)
        Axial part chi3 of both terms, the relative change of the length of day; NaN if a file does
        not have it, or has zeros in its place.
    """

    mjd: FloatArray
    mass: ComplexArray
    motion: ComplexArray
    mass3: FloatArray
    motion3: FloatArray

    def daily(self) -> AngularMomentum:
        """Average the angular momentum functions over each day from 0h to 0h, dated at noon.

        Samples are connected by straight lines.

        Daily values at noon are treated as daily means.

        Raises
        ------
        SeriesError
            If no whole day is covered.
        """
        step = (self.mjd[-1] - self.mjd[0]) / (self.mjd.size - 1)
        if abs(step - 1) < SAME_TIME and abs(self.mjd[0] % 1 - 0.5) < SAME_TIME:
            return self
        edges = np.arange(np.ceil(self.mjd[0] - SAME_TIME), self.mjd[-1] + SAME_TIME)
        if edges.size < 2:
            raise SeriesError("excitation", "it covers no whole day", "omit daily")
        edges[[0, -1]] = np.clip(edges[[0, -1]], self.mjd[0], self.mjd[-1])
        times = np.union1d(self.mjd, edges)

        def means(values: Array) -> Array:
            samples = np.interp(times, self.mjd, values)
            pieces = np.diff(times) * (samples[1:] + samples[:-1]) / 2
            total = np.concatenate([[0], np.cumsum(pieces)])
            return np.asarray(np.diff(total[np.searchsorted(times, edges)]))

        middles = np.asarray(np.round(edges[:-1]) + 0.5, dtype=float)
        return AngularMomentum(middles, *(means(getattr(self, name)) for name in _FIELDS))


def read_angular_momentum(
    paths: str | Path | Sequence[str | Path],
    components: Iterable[str] | None = None,
    *,
    daily: bool = False,
    columns: str | None = None,
) -> AngularMomentum:
    """Read effective angular momentum functions from files, and add up all components.

    The files of each component are joined first.

    Parameters
    ----------
    paths : str, Path or sequence of them
        Files or folders of files. The component of a file follows from ``AAM``, ``OAM``, ``HAM`` or
        ``SLAM`` in its name.
    components : iterable of str, optional
        A selection of ``"AAM"``, ``"OAM"``, ``"HAM"``, ``"SLAM"``; by default all components in the
        files.
    daily : bool
        Whether to compute daily means, which is necessary if the components have different dates.
    columns : str, optional
        Declaration of the columns of all files, like ``"mjd, mass1, mass2, ..."``.

    Raises
    ------
    SeriesError
        If a file is invalid; the message gives the line.
    """
    files = _files(paths, components)
    joined = [_joined(group, columns) for group in files.values()]
    parts = [part.daily() for part in joined] if daily else joined
    first, last = max(p.mjd[0] for p in parts), min(p.mjd[-1] for p in parts)
    common = [_between(part, first, last) for part in parts]
    mjd, names = common[0].mjd, ", ".join(str(group[0]) for group in files.values())
    if any(p.mjd.size != mjd.size or np.any(abs(p.mjd - mjd) > SAME_TIME) for p in common):
        raise SeriesError(names, "the components have different dates", "average them: daily=True")
    if mjd.size < 2:
        raise SeriesError(names, "there is no span of two steps that all components cover")
    sums = (np.sum([getattr(p, name) for p in common], axis=0) for name in _FIELDS)
    return AngularMomentum(mjd, *sums)


def _between(series: AngularMomentum, first: float, last: float) -> AngularMomentum:
    selected = (series.mjd >= first - SAME_TIME) & (series.mjd <= last + SAME_TIME)
    parts = (getattr(series, name)[selected] for name in ("mjd", *_FIELDS))
    return AngularMomentum(*parts)


def _files(
    paths: str | Path | Sequence[str | Path], components: Iterable[str] | None
) -> dict[str, list[Path]]:
    """Group the paths of the files by component, such as atmosphere, ocean or land water."""
    folders = [paths] if isinstance(paths, (str, Path)) else list(paths)
    names = ", ".join(map(str, folders))
    files: dict[str, list[Path]] = {}
    for path in map(Path, folders):
        # os.path.isdir is false for a name that is too long, where Path.is_dir raises an error
        for file in sorted(path.iterdir()) if os.path.isdir(path) else [path]:
            # No word contains another; only the file name is searched, not the folder.
            name = next((word for word in COMPONENTS if word in file.name.upper()), "")
            files.setdefault(name, []).append(file)
    if not files:
        raise SeriesError(names, "there is no file")
    if components is None:
        if len(files) > 1 and "" in files:
            problem = "its name does not contain its component"
            raise SeriesError(files[""][0], problem, f"names hold one of {', '.join(COMPONENTS)}")
        return files
    chosen = list(components)
    if not chosen:
        remedy = f"give one or more of {', '.join(COMPONENTS)}"
        raise SeriesError(names, "no component is named", remedy)
    for word in chosen:
        if word not in files:
            remedy = (
                nearest(word, files) if any(files) else "the file names do not contain components"
            )
            raise SeriesError(names, f"there is no component {word!r}", remedy)
    return {word: files[word] for word in chosen}


def _joined(files: list[Path], columns: str | None) -> AngularMomentum:
    """Join the rows of all files of one component in order of time, without repeated rows."""
    rows = np.concatenate([_rows(files, place, columns) for place in range(len(files))])
    rows = rows[np.argsort(rows["mjd"], kind="stable")]
    if len(rows) < 2:
        raise SeriesError(files[0], f"it holds {len(rows)} rows of excitation")
    again = np.diff(rows["mjd"]) <= SAME_TIME
    known = [np.nan_to_num(rows[name]) for name in _FIELDS]
    other = again & np.any([values[1:] != values[:-1] for values in known], axis=0)
    if other.any():
        last, row = rows[np.argmax(other) :][:2]
        place = f"line {last['line']} of '{files[last['file']].name}'"
        problem = f"MJD {row['mjd']:.3f} stands twice, in {place} with other numbers"
        raise SeriesError(files[row["file"]], problem, "keep one of them", int(row["line"]))
    rows = rows[np.append(True, ~again)]
    steps = np.diff(rows["mjd"])
    uneven = abs(steps - np.median(steps)) > SAME_TIME
    if uneven.any():
        row = rows[np.argmax(uneven) + 1]
        problem = f"the step changes before MJD {row['mjd']:.3f}"
        remedy = "even steps are needed; is a file missing?"
        raise SeriesError(files[row["file"]], problem, remedy, int(row["line"]))
    return AngularMomentum(rows["mjd"], *(rows[name] for name in _FIELDS))


def _rows(files: list[Path], place_of_file: int, columns: str | None) -> Array:
    """Rows of one file."""
    sheet = tables.split(files[place_of_file])
    sheet.refuse_text()
    meaning = [column._replace(unit=column.unit or "rad") for column in _meaning(sheet, columns)]
    mjd = tables.dates_of(sheet, meaning)
    problem = "MJD {mjd:.3f} comes after {last:.3f}"
    backwards = np.diff(mjd, prepend=-np.inf) < 0
    sheet.refuse(backwards, problem, "time runs backwards", mjd=mjd, last=np.roll(mjd, 1))
    rows = np.zeros(mjd.size, _ROW)
    rows["file"], rows["line"], rows["mjd"] = place_of_file, sheet.lines, mjd
    parts = {n: sheet.values(meaning, n, "rad", missing=0.0) for n in _NAMES}
    for name in TERMS:
        rows[name] = parts[f"{name}1"] + 1j * parts[f"{name}2"]
        rows[f"{name}3"] = parts[f"{name}3"]
    for name in _FIELDS:
        problem = "excitation {chi:.3g} is no such number"
        sheet.refuse(~(abs(rows[name]) <= LARGEST), problem, "give radians", chi=rows[name])
    if not (np.any(rows["mass3"]) or np.any(rows["motion3"])):  # zeros stand for no numbers
        rows["mass3"] = rows["motion3"] = np.nan
    return rows


def _meaning(sheet: Sheet, text: str | None) -> list[Meaning]:
    """Columns of a file: as declared, or those of the common layout with as many.

    Raises
    ------
    SeriesError
        If there is no such layout, or the header has the date in another column.
    """
    if text:
        return sheet.as_declared(text, (*tables.DATES, *_NAMES))
    known = [tables.declared(layout.columns) for layout in ANGULAR_MOMENTUM]
    meaning = next((columns for columns in known if len(columns) == sheet.width), None)
    dates = tables.places(sheet.file, sheet.names, {"mjd": tables.DATES["mjd"]})
    if meaning is None:
        remedy = "8 or 11 are expected; name them, like columns='mjd, mass1, mass2, ...'"
        raise sheet.error(f"{sheet.width} columns", remedy, 0)
    if dates and meaning[dates["mjd"]].quantity != "mjd":
        words = [tables.BLANK] * sheet.width
        words[dates["mjd"]] = Meaning("mjd")
        raise sheet.not_understood(words)
    return meaning
