"""Tables with foreign headers and shuffled columns: read rightly, or refused in one line."""

import functools
import random
from collections.abc import Callable

import numpy as np

import earthspin
from earthspin.constants import ARCSEC
from earthspin.sky import eop

Random = random.Random

#: Headers of a column by its quantity: declared, of some program, or of nobody.
SOLUTION = {
    "epoch": ("epoch ({})", "Time_ka", "age", "t", "kyr_BP", "x1", "time ({})"),
    "eccentricity": ("eccentricity", "ecc", "e", "ECC", "eccentricity (1)", "x2"),
    "obliquity": ("obliquity ({})", "tilt", "obl", "OBL", "eps", "obliquity", "x3"),
    "longitude_of_perihelion": ("longitude_of_perihelion ({})", "omega", "varpi", "prec", "x4"),
}
POLE = {
    "mjd": ("MJD", "mjd", "Modified_Julian_Date", "t", "day"),
    "x": ("x", "x_pole", "PM_x", "Xpole", "x({})", "east"),
    "y": ("y", "y_pole", "PM_y", "Ypole", "y({})", "north"),
    "e_x": ("sigma_x", "e_x", "x_error", "Xsig", "err"),
}
#: Units of a column: as they are written, and numbers in them by those in the first unit.
TIMES = {"yr": 1.0, "kyr": 1e-3, "Myr": 1e-6, "yr ago": -1.0, "ka": -1e-3, "kyr ago": -1e-3}
ANGLES = {"deg": 1.0, "rad": np.pi / 180}
ARCS = {"arcsec": 1.0, "mas": 1e3, "uas": 1e6}
#: Files that begin with these are no such tables.
STARTS = ("", "", "", "# comment, with, cells\n", "title of 1 table\n\n", "\ufeff", "%=SNX 2.02\n")


@functools.cache
def _solution() -> dict[str, np.ndarray]:
    past = earthspin.long_term("-15 kyr", "0 kyr", "0.5 kyr")
    return {name: past[name].values for name in SOLUTION}


@functools.cache
def _pole() -> dict[str, np.ndarray]:
    seen = eop.read_polar_motion().between(58849, 58949)
    x, y, error = (v / ARCSEC for v in (seen.x, seen.y, seen.x_error))
    return {"mjd": seen.mjd, "x": x, "y": y, "e_x": error}


def _written(
    rng: Random, numbers: dict[str, np.ndarray], headers: dict[str, tuple[str, ...]], units: dict
) -> str:
    """Text of a table with shuffled columns, any delimiter, and a header of any kind or none."""
    names = [*numbers]
    if rng.random() < 0.6:
        rng.shuffle(names)
    names = names[: rng.choice((2, 3, len(names), len(names)))]
    chosen = {name: rng.choice([*units[name]]) if name in units else "" for name in names}
    columns = [numbers[n] * (units[n][chosen[n]] if n in units else 1.0) for n in names]
    mark, quote = rng.choice((",", ";", "\t", " ", "   ")), rng.choice(("", "", '"'))
    header = mark.join(
        f"{quote}{rng.choice(headers[name]).format(chosen[name])}{quote}" for name in names
    )
    rows = [mark.join(f"{value:.12g}" for value in row) for row in zip(*columns, strict=True)]
    if mark in (";", "\t") and rng.random() < 0.3:
        rows = [row.replace(".", ",") for row in rows]
    if rng.random() < 0.1:
        rows[rng.randrange(len(rows))] = rng.choice(("", "nan", "x", "1", "# c", "1,2,3,4,5,6,7"))
    head = rng.choice(("", header + "\n", header + "\n", f"# {header}\n"))
    return rng.choice(STARTS) + head + "\n".join(rows) + rng.choice(("", "\n", f"{mark}\n", "\x1a"))


def solution(rng: Random) -> tuple[str, Callable[[], None]]:
    """A solution: if it is read, its numbers are those of the Earth."""
    angles = dict.fromkeys(("obliquity", "longitude_of_perihelion"), ANGLES)
    text = _written(rng, _solution(), SOLUTION, {"epoch": TIMES} | angles)

    def ask() -> None:
        with open("solution.txt", "w", encoding="utf-8") as file:
            file.write(text)
        read, known = earthspin.read_solution("solution.txt"), _solution()
        for name in {*read.data_vars} & {*known}:
            off = read[name] - np.interp(read.epoch, known["epoch"], known[name])
            off = (off + 180) % 360 - 180 if name == "longitude_of_perihelion" else off
            if float(abs(off).max()) > {"eccentricity": 0.001}.get(name, 0.1):
                raise AssertionError(f"{name} is off by {float(abs(off).max()):.3g}")

    return text[:250], ask


def pole(rng: Random) -> tuple[str, Callable[[], None]]:
    """A table of the pole: if it is read, its numbers are those of C04."""
    text = _written(rng, _pole(), POLE, dict.fromkeys(("x", "y", "e_x"), ARCS))

    def ask() -> None:
        with open("pole.txt", "w", encoding="utf-8") as file:
            file.write(text)
        read, known = eop.read_polar_motion("pole.txt"), _pole()
        for name in ("x", "y"):
            off = getattr(read, name) / ARCSEC - np.interp(read.mjd, known["mjd"], known[name])
            if abs(off).max() > 0.01:
                raise AssertionError(f"{name} is off by {abs(off).max():.3g}")

    return text[:250], ask
