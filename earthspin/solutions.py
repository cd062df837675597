"""Read published solutions of obliquity, precession and eccentricity."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import numpy as np
from astropy.units import Unit

from earthspin._lazy import xr
from earthspin.engine.atomic_writes import as_path
from earthspin.errors import SeriesError, Where, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.long_term import LongTermSeries
from earthspin.sky.columns import checksum, table_of

#: Columns of published files without names; one without a name is not read.
LAYOUTS = (
    # La2010; ZB18a, ZB20a (with the inclination)
    "epoch (kyr),eccentricity",
    "epoch (kyr),eccentricity,",
    # La2004, La93
    "epoch (kyr),eccentricity,obliquity (rad),longitude_of_perihelion (rad)",
    # ZB18a: files of snvec (with the angle of precession), and of paleoinsolation
    "epoch (kyr),obliquity (rad),,climatic_precession",
    "epoch (kyr),eccentricity,obliquity (rad),,longitude_of_perihelion (rad),climatic_precession",
    "epoch (kyr),eccentricity,obliquity (deg),longitude_of_perihelion (deg),",
    # Berger & Loutre 1991 (with four insolations)
    "epoch (kyr from 1950),eccentricity,longitude_of_perihelion (deg),obliquity (deg),"
    "climatic_precession,,,,",
    # AstroGeo22
    "epoch (Gyr ago),,,,,,,obliquity (deg),,,,,",
)
#: Quantities of `long_term` that depend on the epoch alone, with their errors, and its epoch.
QUANTITIES = {name: q for name, q in LongTermSeries.schema.items() if q.dims == ("epoch",)}
QUANTITIES["epoch"] = LongTermSeries.fields["epoch"]
#: Sign of epochs and their origin, Julian years from J2000.0, by the word after their unit.
SENSES = {"": (1, 0.0), "ago": (-1, 0.0), "from 1950": (1, -50.0), "BP": (-1, -50.0)}
#: Longest time between rows, Julian years, over which the perihelion can be followed.
FARTHEST = 5000.0
#: Upper limit of eccentricities in files without names.
MOST_ECCENTRIC = 0.3
_WHERE = Where("columns", "read_solution")


def read_solution(path: str | PathLike[str], *, columns: str | None = None) -> xr.Dataset:
    """Read a published solution into a Dataset with the names and units of `long_term`.

    Files of La2004, La93, La2010 (eccentricity), ZB18a, Berger & Loutre (1991, ``orbit91``) and
    AstroGeo22 are recognised by their columns, and CSV files of `long_term` by their first line.
    For orbital elements (La2010 ``alkhqp``, HNBody) use `read_orbit`.

    Parameters
    ----------
    path : str or Path
        Text file; spaces, commas or semicolons separate its columns.
    columns : str, optional
        Names of all columns with their units, separated by commas, like ``"epoch (kyr), obliquity
        (deg),, climatic_precession"``; a column without a name is not read. Names are those of
        `long_term`, or ``longitude_of_perigee``, which is that of the Sun and larger by 180
        degrees. Epochs count from J2000.0 and are negative in the past. Those in ``kyr ago`` are
        positive in the past; ``kyr from 1950`` counts from 1950, and ``kyr BP`` backwards from it.

    Returns
    -------
    Dataset
        Over `epoch` (Julian years from J2000.0, ascending), in the units and with the signs of
        `long_term`. The longitude of perihelion is unwrapped if rows are at most 5000 years apart,
        and lies between 0 and 360 degrees in the row nearest to J2000.0. Where an orbit is nearly
        circular, two solutions may differ by whole turns. Climatic precession and coprecession are
        computed from eccentricity and perihelion if the file lacks them.

    Raises
    ------
    SeriesError
        If the columns are those of no known solution, or an epoch is repeated.
    SceneError
        If `columns` has an unknown name or unit.

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
    file = as_path(path)
    header, rows, _ = table_of(file)
    values = np.array(rows)
    if columns is None:
        columns = header.lstrip("#%! ") if "epoch (" in header else _layout(file, values)
    elif not isinstance(columns, str):
        raise _WHERE.error(columns, "give one text, like 'epoch (kyr), obliquity (deg)'")
    data = _converted(columns, values)
    if columns.count(",") + 1 != values.shape[1] or "epoch" not in data:
        problem = f"{values.shape[1]} columns, of which {columns.count(',') + 1} are named"
        raise SeriesError(file, problem, "name each, or leave its name empty; epoch is needed")
    order = np.argsort(data["epoch"])
    data = {name: column[order] for name, column in data.items()}
    steps = np.diff(data["epoch"])
    if not np.all(steps > 0):
        epoch = data["epoch"][np.argmin(steps > 0)]
        raise SeriesError(file, f"epoch {epoch:g} yr is repeated", "keep one of the rows")
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
    origin = {"source": file.name, "columns": columns, "sha256": checksum(file)}
    solution = xr.Dataset(attrs=origin)
    for name, column in data.items():
        attributes = {"long_name": QUANTITIES[name].long_name, "units": QUANTITIES[name].units}
        solution[name] = ("epoch", column, attributes)
    return solution


def _converted(columns: str, values: FloatArray) -> dict[str, FloatArray]:
    """Columns of a solution file by variable name, converted to the units of `long_term`."""
    data = {}
    for header, column in zip(columns.split(","), values.T, strict=False):
        name, _, unit = header.strip().removesuffix(")").partition(" (")
        unit, _, sense = unit.partition(" ")
        shift = 0.0
        if name == "longitude_of_perigee":
            name, shift = "longitude_of_perihelion", -180.0
        if not name:
            continue
        if name not in QUANTITIES:
            raise _WHERE.error(name, nearest(name, QUANTITIES))
        units = QUANTITIES[name].units
        try:
            sign, origin = SENSES[sense]
            factor = sign * Unit(unit).to(Unit(units))
        except (KeyError, ValueError):
            raise _WHERE.error(header, f"write its unit like '{name} ({units})'") from None
        data[name] = factor * column + origin + shift
    return data


def _layout(file: Path, values: FloatArray) -> str:
    """Names and units of unnamed columns, inferred from the number of columns and the values."""
    fitting = [c for c in LAYOUTS if c.count(",") + 1 == values.shape[1] and _fits(c, values)]
    if len(fitting) == 1:
        return fitting[0]
    problem = f"its {values.shape[1]} columns are not those of a known solution"
    remedy = "name them, columns='epoch (kyr), obliquity (deg)', or use read_orbit for elements"
    raise SeriesError(file, problem, remedy)


def _fits(columns: str, values: FloatArray) -> bool:
    """Return True if the values fit the assumed column names, and the epochs have no large gaps."""
    data = _converted(columns, values)
    small = [data[name] for name in ("eccentricity", "climatic_precession") if name in data]
    close = np.abs(np.diff(data["epoch"])).max(initial=0.0) <= FARTHEST or not small
    # an obliquity of at most pi degrees is one in radians
    tilted = np.pi < data.get("obliquity", np.array([90.0])).max() <= 180
    return bool(close and tilted and np.abs(small).max(initial=0.0) <= MOST_ECCENTRIC)
