"""Read published solutions of obliquity, precession and eccentricity."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from functools import cache, partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from earthspin import tables
from earthspin._lazy import xr
from earthspin.engine.atomic_writes import as_path
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.questions.long_term import LongTermSeries, long_term
from earthspin.tables import BLANK, Meaning, Sheet
from earthspin.tables.layouts import ASTROGEO22, SOLUTIONS
from earthspin.units import time_scale

if TYPE_CHECKING:
    import pandas as pd

#: Quantities of `long_term` that depend on the epoch alone, with their errors, and its epoch.
QUANTITIES = {name: q for name, q in LongTermSeries.schema.items() if q.dims == ("epoch",)}
QUANTITIES["epoch"] = LongTermSeries.fields["epoch"]
#: Name of the Sun's perigee, whose longitude is that of the perihelion plus 180 degrees.
_PERIGEE = "longitude_of_perigee"
#: Longest time between rows over which the perihelion can be followed, Julian years.
FARTHEST = 5000.0

# --- known numbers of today -----------------------------------------------------------------------

#: Bodies with which a solution is compared.
KNOWN = ("earth", "mars")
#: Largest median difference, in the units of `long_term`. Published solutions differ by up to a
#: third of it (Berger & Loutre 1991).
BOUNDS = {"eccentricity": 0.0015, "obliquity": 0.1, "longitude_of_perihelion": 3.0}
BOUNDS |= dict.fromkeys(("climatic_precession", "coprecession"), 0.002)
#: Meanings of columns and times that are tried for a message, never read.
_OPTIONS = (
    Meaning("eccentricity"), Meaning("climatic_precession"), Meaning("coprecession"),
    *(
        Meaning(name, unit)
        for name in ("obliquity", "longitude_of_perihelion", _PERIGEE)
        for unit in ("deg", "rad")
    ),
)  # fmt: skip
_TIMES = ("kyr", "kyr ago", "yr", "yr ago", "Myr", "Myr ago")
#: Names of columns with years of the calendar, and numbers that may be such years.
_CALENDAR, _RECENT = r"(calendar\W?)?years?\W*(AD|CE)?\W*", (1000.0, 3000.0)
#: Quantities by words in headers, for messages only.
_WORDS = {
    r"ecc|^e$": "eccentricity", r"obl|tilt|^eps": "obliquity", r"perigee": _PERIGEE,
    r"perih|varpi|omega|lpe|angle": "longitude_of_perihelion", r"prec": "climatic_precession",
    r"time|age|epoch|^t$|yr|year|\bk?a\b|bp": "epoch",
}  # fmt: skip


def read_solution(
    path: str | PathLike[str] | pd.DataFrame, *, columns: str | None = None
) -> xr.Dataset:
    """Read a published solution into a Dataset with the names and units of `long_term`.

    Files of La2004, La93, La2010 (eccentricity), ZB18a, Berger & Loutre (1991, ``orbit91``),
    AstroGeo22 and astrochron are recognised, and CSV files of `long_term` by their first line. For
    orbital elements (La2010 ``alkhqp``, HNBody) use `read_orbit`. What the columns mean is compared
    with the Earth and Mars around J2000.0.

    Parameters
    ----------
    path : str, Path or DataFrame
        Text file, also compressed by gzip, or a table of pandas or polars.
    columns : str, optional
        Names of all columns with their units, separated by commas, like ``"epoch (kyr), obliquity
        (deg),, climatic_precession"``; a column without a name is not read. Names are those of
        `long_term`, or ``longitude_of_perigee``, which is that of the Sun and larger by 180
        degrees. Epochs count from J2000.0 and are negative in the past. Those in ``ka`` or ``kyr
        ago`` are positive in the past; ``kyr from 1950`` counts from 1950, and ``kyr BP`` backwards
        from it.

    Returns
    -------
    Dataset
        Over `epoch` (Julian years from J2000.0, ascending), in the units and with the signs of
        `long_term`. The longitude of perihelion is unwrapped if rows are at most 5000 years apart,
        and lies between 0 and 360 degrees in the row nearest to J2000.0. Where an orbit is nearly
        circular, two solutions may differ by whole turns. Climatic precession and coprecession are
        computed from eccentricity and perihelion if the file lacks them. The attribute ``body`` is
        the body, Earth or Mars, with which the solution agrees around J2000.0.

    Raises
    ------
    SeriesError
        If the columns are not understood, have an unknown name or unit, or agree with the Earth
        only in another meaning, or an epoch is repeated. The message has the `columns` to give.

    Examples
    --------
    >>> from pathlib import Path
    >>> import earthspin
    >>> row = "0.000  0.1670236225D-01  0.4090928042D+00  0.1796256991D+01"
    >>> _ = Path("la2004.txt").write_text(row)
    >>> laskar = earthspin.read_solution("la2004.txt")
    >>> past = earthspin.long_term("-1 kyr", "0 kyr", "1 kyr")
    >>> print((past - laskar).longitude_of_perihelion.round(2).values)
    [0.01]
    """
    frame = tables.is_frame(path)
    sheet = tables.of_frame(path) if frame else tables.split(as_path(path), SOLUTIONS)
    sheet.refuse_text()
    known = (*QUANTITIES, _PERIGEE)
    meaning = sheet.as_declared(columns, known) if columns else _understood(sheet)
    data = _converted(sheet, meaning)
    tables.refuse_other_meaning(sheet, meaning, _others(sheet, meaning), partial(_misfit, sheet))
    body = next((body for body in KNOWN if _misfit(sheet, meaning, (body,)) <= 1), "")
    origin = {"source": Path(sheet.file).name, "columns": columns or tables.written(meaning)}
    origin |= {} if sheet.is_frame else {"sha256": tables.checksum(Path(sheet.file))}
    solution = xr.Dataset(attrs=origin | ({"body": body} if body else {}))
    for name, column in _in_order(sheet, data).items():
        attributes = {"long_name": QUANTITIES[name].long_name, "units": QUANTITIES[name].units}
        solution[name] = ("epoch", column, attributes)
    return solution


def _in_order(sheet: Sheet, data: dict[str, FloatArray]) -> dict[str, FloatArray]:
    """Sort columns by epoch, unwrap the perihelion, and compute climatic precession from it."""
    order = np.argsort(data["epoch"])
    data = {name: column[order] for name, column in data.items()}
    steps = np.diff(data["epoch"])
    if not np.all(steps > 0):
        epoch = data["epoch"][np.argmin(steps > 0)]
        raise sheet.error(f"epoch {epoch:g} yr is repeated", "keep one of the rows")
    if "longitude_of_perihelion" in data:
        longitude = data["longitude_of_perihelion"] % 360
        if steps.max(initial=0.0) <= FARTHEST:
            longitude = np.unwrap(longitude, period=360)
            longitude -= 360 * np.floor(longitude[np.argmin(np.abs(data["epoch"]))] / 360)
        data["longitude_of_perihelion"] = longitude
        if "eccentricity" in data:
            angle = np.radians(longitude)
            data.setdefault("climatic_precession", data["eccentricity"] * np.sin(angle))
            data.setdefault("coprecession", data["eccentricity"] * np.cos(angle))
    return data


def _understood(sheet: Sheet) -> list[Meaning]:
    """Columns as the header or a layout declares them; one without a header must be confirmed."""
    if sheet.layout and tables.fits(sheet.layout.columns, sheet.width):
        return tables.declared(sheet.layout.columns)
    if sheet.names:
        meaning = [tables.column_of(name) for name in sheet.names]
        if all(column.quantity in (*QUANTITIES, _PERIGEE, "") for column in meaning):
            return sheet.as_declared(tables.written(meaning))
        raise sheet.not_understood(_suggested(sheet))
    readings = [tables.declared(layout.columns) for layout in SOLUTIONS if not layout.head]
    for meaning in readings:
        if len(meaning) == sheet.width and _misfit(sheet, meaning) <= 1:
            return meaning
    far = tables.declared(ASTROGEO22.columns)
    if len(far) == sheet.width and math.isinf(_misfit(sheet, far)):
        return far
    share, guess = max(
        _guesses(sheet, [BLANK] * sheet.width, range(1, sheet.width)), key=lambda pair: pair[0]
    )
    agreeing = f"; {tables.typed(guess)} would agree with what is known of today" if share else ""
    problem = f"its {sheet.width} columns without names are not those of a known solution"
    remedy = "name them, columns='epoch (kyr), obliquity (deg)', or use read_orbit for elements"
    raise sheet.error(problem, f"name them{agreeing}" if share else remedy)


def _converted(
    sheet: Sheet, meaning: Sequence[Meaning], rows: slice | BoolArray = slice(None)
) -> dict[str, FloatArray]:
    """Columns of a solution by variable name, converted to the units of `long_term`."""
    data = {}
    for place, column in enumerate(meaning):
        name = column.quantity.replace("perigee", "perihelion")
        if not name:
            continue
        data[name] = sheet.values(meaning, column.quantity, QUANTITIES[name].units, rows)
        data[name] = data[name] - 180.0 * (name != column.quantity)
        rest = [*meaning[:place], BLANK, *meaning[place + 1 :]]
        remedy = f"fill it, leave out the row, or the column: {tables.typed(rest)}"
        sheet.refuse(~np.isfinite(data[name]), f"{name} is missing", remedy)
    if "epoch" not in data:
        raise sheet.error("it has no epoch", "epoch is needed, like 'epoch (kyr)'")
    return data


# --- comparison with today ------------------------------------------------------------------------


@cache
def _known(body: str) -> dict[str, FloatArray]:
    """Quantities around J2000.0 on which all published solutions agree."""
    past = long_term("-20 kyr", "20 kyr", "0.5 kyr", body=body)
    return {name: past[name].values for name in ("epoch", *BOUNDS)}


def _misfit(
    sheet: Sheet,
    meaning: Sequence[Meaning],
    bodies: Sequence[str] = KNOWN,
    changing: bool = False,
) -> float:
    """Largest median difference from a known body in units of its bound; inf if none is known.

    It is also inf if columns must change and none does.
    """
    try:
        place = [column.quantity for column in meaning].index("epoch")
        factor, origin = meaning[place].conversion("yr")
        near = abs(factor * sheet.column(place) + origin) <= tables.NEAR
        if abs(factor) == 1 and _are_calendar_years(sheet, place):
            return math.inf
        data = _converted(sheet, meaning, near)
    except ValueError:  # a column of text is one, too
        return math.inf
    names = [name for name in BOUNDS if name in data]
    if np.count_nonzero(near) < max(1, min(tables.FEWEST, near.size)) or not names:
        return math.inf
    if changing and not any(np.ptp(data[name]) > tables.CHANGE * BOUNDS[name] for name in names):
        return math.inf

    def misfit(body: str, name: str) -> float:
        known = _known(body)
        off = data[name] - np.interp(data["epoch"], known["epoch"], known[name])
        off = (off + 180) % 360 - 180 if name == "longitude_of_perihelion" else off
        return float(np.median(abs(off))) / BOUNDS[name]

    return min(max(misfit(body, name) for name in names) for body in bodies)


def _are_calendar_years(sheet: Sheet, place: int) -> bool:
    """Return True if a column may hold years of the calendar, 2000 more than epochs in years."""
    named = bool(sheet.names) and re.fullmatch(_CALENDAR, sheet.names[place].strip(), re.IGNORECASE)
    numbers, (first, last) = sheet.column(place), _RECENT
    return bool(named) or bool(np.all((numbers > first) & (numbers < last)))


def _guesses(
    sheet: Sheet, columns: Sequence[Meaning], places: Sequence[int], time: int = 0
) -> Iterator[tuple[float, list[Meaning]]]:
    """Meanings of blank columns that agree with a known body: share of them, and all columns."""
    units = dict.fromkeys([columns[time].unit or _TIMES[0], *_TIMES])
    times = [[*columns[:time], Meaning("epoch", u), *columns[time + 1 :]] for u in units]
    for body in KNOWN:
        yield tables.guessed(places, times, _OPTIONS, partial(_misfit, sheet, bodies=(body,)))


def _others(sheet: Sheet, meaning: Sequence[Meaning]) -> Iterator[list[Meaning]]:
    """Other meanings of all columns that can be compared."""
    names = [column.quantity for column in meaning]
    compared = (*BOUNDS, _PERIGEE)
    places = [place for place, name in enumerate(names) if name in compared]
    blank = [BLANK if column.quantity in compared else column for column in meaning]
    time = names.index("epoch")
    for share, other in _guesses(sheet, blank, places, time):
        changing = other[time] != meaning[time]
        if share == 1 and math.isfinite(_misfit(sheet, other, changing=changing)):
            yield other


def _suggested(sheet: Sheet) -> list[Meaning]:
    """Columns to type for a header that is not understood, by its numbers and words."""
    by_words = [_by_words(sheet, place) for place in range(sheet.width)]
    times = [place for place, column in enumerate(by_words) if column.quantity == "epoch"]
    time = times[0] if times else 0
    if times and _are_calendar_years(sheet, time):
        problem = f"its column '{sheet.names[time]}' may hold years of the calendar"
        remedy = "epochs count from J2000.0: subtract 2000, and name the column 'epoch (yr)'"
        raise sheet.error(problem, remedy)
    blank = [BLANK] * sheet.width
    blank[time] = by_words[time] if times else Meaning("epoch", "kyr")
    places = [place for place in range(sheet.width) if place != time]
    _, meaning = max(_guesses(sheet, blank, places, time), key=lambda guess: guess[0])
    for place, column in enumerate(by_words):
        if column.quantity not in {c.quantity for c in meaning} and not meaning[place].quantity:
            meaning[place] = column
    return meaning


def _by_words(sheet: Sheet, place: int) -> Meaning:
    """Meaning of a column by the words of its header."""
    words = sheet.names[place]
    name = next((name for pattern, name in _WORDS.items() if re.search(pattern, words, re.I)), "")
    if name == "epoch":
        sense = re.search(r"BP|ago|b2k|(before|after|from) (present|1950|2000)", words, re.I)
        unit = next((u for u in re.findall(r"[A-Za-z]+", words) if time_scale(u)), "kyr")
        return Meaning(name, f"{unit} {sense[0]}" if sense else unit)
    if name and QUANTITIES[name.replace("perigee", "perihelion")].units == "deg":
        with_numbers = np.nanmax(abs(sheet.column(place)), initial=0.0)
        return Meaning(name, "rad" if with_numbers < 7 else "deg")
    return Meaning(name)
