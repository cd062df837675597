"""Orbits that change over millions of years, as tables: read, kept and evaluated.

An orbit is kept as its unit normal n and its eccentricity vector e (to the pericentre, as long as
the eccentricity), two components of each along axes of its own; the third follows from n.n = 1 and
n.e = 0. In windows of some twenty thousand years each is a Legendre series, so that values and
rates at any time cost a few products.
"""

from __future__ import annotations

import os
import zipfile
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.lib import format as npy
from numpy.polynomial import legendre
from numpy.typing import NDArray

from earthspin.constants import JULIAN_YEAR
from earthspin.errors import CoverageError, OutputError, one_line
from earthspin.sky.columns import checksum

FloatArray = NDArray[np.float64]

#: Length of a window, s, and terms in it.
WINDOW, TERMS = 20_000 * JULIAN_YEAR, 16
#: Samples a window must hold for each term to be fitted; with fewer, samples are joined by splines.
DENSE = 3
#: Times whose orbit is kept, and how many such sets: whoever follows an axis with each cause of its
#: error changed asks for the same ones every time.
LONGEST_REMEMBERED, SETS_REMEMBERED = 2048, 32
#: Bytes that the arrays of a file may hold together; a billion years take 13 million.
LARGEST = 1 << 26
#: Smallest unit in which coefficients are stored.
UNIT = 1e-9


class Growth(NamedTuple):
    """95 % half-widths of a shipped orbit beyond those of its integration, for each direction.

    Attributes
    ----------
    short_periods : float
        Of the eccentricity: terms of less than some 2,000 years, which the table leaves out.
    normal : float
        Rate at which that of the normal grows, rad/s.
    eccentricity : float
        Rate at which that of the eccentricity vector grows, s-1.
    """

    short_periods: float
    normal: float
    eccentricity: float

    def at(self, times: FloatArray) -> FloatArray:
        """Half-widths of normal (rad) and eccentricity vector at times in s, shape (2, n)."""
        away = np.abs(times)
        by_shape = np.hypot(self.short_periods, self.eccentricity * away)
        return np.stack([self.normal * away, by_shape])


_MYR = 1e6 * JULIAN_YEAR
#: By body, measured. Eccentricities: La2010a to d (Laskar et al. 2011, A&A 532, A89) and La2004
#: (Laskar et al. 2004, A&A 428, 261) for the Earth, ZB18a over the last million years; the file of
#: La2004 for Mars. Normals, which none of these files holds: an integration that adds what ours
#: lacks, the Sun's flattening and three asteroids, and that lies nearer to La2010a by a factor of
#: two past six million years. `python -m data_tools long-term --solutions` and `python -m
#: data_tools orbits --left-out` measure both again.
GROWTH = {
    "earth": Growth(4.5e-5, 4.0e-5 / _MYR, 1.8e-5 / _MYR),
    "mars": Growth(1.4e-4, 6.0e-5 / _MYR, 2.0e-5 / _MYR),
}


@dataclass(frozen=True, eq=False)
class OrbitTable:
    """An orbit through time.

    Attributes
    ----------
    name : str
        Of the body that goes round.
    edges : ndarray, shape (w + 1,)
        Where windows meet, s from J2000.0 TDB, ascending.
    coefficients : ndarray, shape (4, w, m)
        Legendre coefficients of n_1, n_2, e_1, e_2.
    axes : ndarray, shape (3, 3)
        Rows: the axes of the table in the GCRS.
    source : str
        Where it comes from.
    errors : ndarray, shape (2, w)
        95 % half-widths of n (rad) and of e in each window, for each of two directions: what half
        the step changes, what the series leave out, and how the orbit goes away from those of
        others (see `growth`). Of a table that was given, what the series leave out alone: the orbit
        is taken at its word.
    sha256 : str
        Of the file it was read from; empty if there was none.
    """

    name: str
    edges: FloatArray
    coefficients: FloatArray
    axes: FloatArray
    source: str
    errors: FloatArray
    sha256: str = ""

    @property
    def provenance(self) -> dict[str, str]:
        """Checksum of the file, for the attributes of an answer."""
        return {"orbit_sha256": self.sha256} if self.sha256 else {}

    @property
    def coverage(self) -> tuple[float, float]:
        """First and last time, s from J2000.0 TDB."""
        return float(self.edges[0]), float(self.edges[-1])

    @cached_property
    def _rates(self) -> FloatArray:
        """Legendre coefficients of the rates of n_1 and n_2, s-1."""
        half = np.diff(self.edges)[:, np.newaxis] / 2
        return np.asarray(legendre.legder(self.coefficients[:2], axis=-1) / half)

    def check_times(self, times: FloatArray) -> None:
        """Refuse, with a CoverageError, times outside the table."""
        first, last = self.coverage
        low, high = float(np.min(times)), float(np.max(times))
        if not (first <= low and high <= last):
            requested, coverage = ((_words(low), _words(high)), (_words(first), _words(last)))
            raise CoverageError(f"orbit of {self.name}", requested, coverage, "table")

    def error(self, times: FloatArray) -> FloatArray:
        """95 % half-widths of normal (rad) and eccentricity vector at times in s, shape (2, n)."""
        middle = (self.edges[:-1] + self.edges[1:]) / 2
        return np.stack([np.interp(times, middle, widths) for widths in self.errors])

    def at(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Unit normal, eccentricity vector and rate of the normal (s-1) in the GCRS, (3, n) each.

        Parameters
        ----------
        times : ndarray, shape (n,)
            s from J2000.0 TDB.

        Raises
        ------
        CoverageError
            If a time lies outside the table.
        """
        if times.size > LONGEST_REMEMBERED:
            return self._evaluated(times)
        return _remembered(self, np.asarray(times, dtype=float).tobytes())

    def _evaluated(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        self.check_times(times)
        window = np.clip(np.searchsorted(self.edges, times) - 1, 0, len(self.edges) - 2)
        middle, half = (self.edges[:-1] + self.edges[1:]) / 2, np.diff(self.edges) / 2
        degree = self.coefficients.shape[-1] - 1
        basis = legendre.legvander((times - middle[window]) / half[window], degree)
        n1, n2, e1, e2 = np.einsum("kwm,wm->kw", self.coefficients[:, window], basis)
        r1, r2 = np.einsum("kwm,wm->kw", self._rates[:, window], basis[:, :-1])
        n3 = np.sqrt(1 - n1 * n1 - n2 * n2)
        parts = (
            (n1, n2, n3),
            (e1, e2, -(n1 * e1 + n2 * e2) / n3),
            (r1, r2, -(n1 * r1 + n2 * r2) / n3),
        )
        normal, eccentricity, turning = (self.axes.T @ np.stack(part) for part in parts)
        return normal, eccentricity, turning

    def to_file(self, path: str | os.PathLike[str]) -> None:
        """Write the table to a file, which `earthspin.read_orbit` reads.

        Coefficients are kept as whole numbers of 1e-9 (0.2 mas), so that a table that was read
        from such a file is written to the same numbers.

        Parameters
        ----------
        path : str or Path
            It ends in ``.npz``.

        Raises
        ------
        OutputError
            If it does not, or cannot be written.
        """
        if not isinstance(path, (str, os.PathLike)):
            raise TypeError(f"path is of type {type(path).__name__}; give a str or a Path")
        file = Path(path)
        if file.suffix != ".npz":
            raise OutputError(file, "the table of an orbit ends in .npz", "name it so")
        try:
            write(file, self)
        except OSError as error:
            raise OutputError(file, f"it cannot be written: {one_line(error)}") from None


@lru_cache(maxsize=SETS_REMEMBERED)
def _remembered(table: OrbitTable, times: bytes) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The orbit at times, as arrays that cannot be written to."""
    arrays = table._evaluated(np.frombuffer(times))
    for values in arrays:
        values.flags.writeable = False
    return arrays


def _words(time: float) -> str:
    """A time in thousands of years from J2000.0, as one would give it."""
    return f"{time / JULIAN_YEAR / 1000:.15g} kyr"


def fitted(
    name: str,
    times: FloatArray,
    normal: FloatArray,
    eccentricity: FloatArray,
    axes: FloatArray,
    source: str,
) -> OrbitTable:
    """A table from samples of an orbit.

    Where a window holds many samples its series are fitted by least squares, which leaves out what
    varies faster than the series can; where it holds few, quintic splines join them.

    Parameters
    ----------
    name, source : str
    times : ndarray, shape (n,)
        s from J2000.0 TDB, ascending.
    normal, eccentricity : ndarray, shape (n, 3)
        In the GCRS.
    axes : ndarray, shape (3, 3)
        Of the table; the third is near the normal.
    """
    from scipy.interpolate import make_interp_spline

    first = np.floor(round(times[0] / WINDOW, 6)) * WINDOW
    edges = np.arange(first, times[-1] + 0.5 * WINDOW, WINDOW)
    edges = np.clip(edges, times[0], times[-1])
    edges = np.unique(np.append(edges, times[-1]))
    samples = np.concatenate([normal @ axes[:2].T, eccentricity @ axes[:2].T], axis=1)
    nodes, weights = legendre.leggauss(TERMS)
    project = legendre.legvander(nodes, TERMS - 1) * weights[:, np.newaxis]
    project *= np.arange(TERMS) + 0.5
    spline = None
    coefficients = np.empty((4, len(edges) - 1, TERMS))
    for window, (start, end) in enumerate(pairwise(edges)):
        inside = slice(*np.searchsorted(times, [start, end + 1.0]))  # the sample at the end, too
        middle, half = (start + end) / 2, (end - start) / 2
        x = (times[inside] - middle) / half
        if x.size >= DENSE * TERMS:
            series = legendre.legfit(x, samples[inside], TERMS - 1)
            series[-2:] += _to_meet(legendre.legval(x[[0, -1]], series).T, samples[inside][[0, -1]])
        else:
            spline = spline or make_interp_spline(times, samples, k=5)
            series = project.T @ spline(middle + half * nodes)
        coefficients[:, window] = series.T
    table = OrbitTable(name, edges, coefficients, axes, source, np.zeros((2, len(edges) - 1)))
    return replace(table, errors=_left_out(table, times, normal, eccentricity))


def _left_out(
    table: OrbitTable, times: FloatArray, normal: FloatArray, eccentricity: FloatArray
) -> FloatArray:
    """Twice the scatter of samples about the series, window by window, shape (2, w)."""
    n, e, _ = table.at(times)
    windows = len(table.edges) - 1
    window = np.clip(np.searchsorted(table.edges, times) - 1, 0, windows - 1)
    count = np.maximum(np.bincount(window, minlength=windows), 1)
    residuals = (n.T - normal, e.T - eccentricity)
    squares = (np.bincount(window, np.sum(r**2, axis=1), windows) for r in residuals)
    return np.stack([2 * np.sqrt(square / count) for square in squares])


def _to_meet(ends: FloatArray, samples: FloatArray) -> FloatArray:
    """What the last two terms add so that a series ends on its samples, and meets the next one.

    They are 1 at the end, plus and minus 1 at the start, and small in between.
    """
    before, after = samples - ends
    return np.stack([(after + before) / 2, (after - before) / 2])


def write(path: Path, table: OrbitTable) -> None:
    """Write a table: whole numbers of `UNIT`, compressed."""
    np.savez_compressed(
        path,
        name=table.name,
        source=table.source,
        errors=table.errors.astype(np.float32),
        axes=table.axes,
        edges=table.edges / JULIAN_YEAR,
        coefficients=np.rint(table.coefficients / UNIT).astype(np.int32),
    )


def load(path: Path) -> OrbitTable:
    """Read a table that `write` wrote.

    Raises
    ------
    ValueError
        If arrays are too large, or their shapes or numbers are those of no table; what zipfile,
        zlib and tokenize raise of a damaged file passes.
    """
    arrays = _arrays(path)
    table = OrbitTable(
        name=str(arrays["name"]),
        edges=arrays["edges"] * JULIAN_YEAR,
        coefficients=arrays["coefficients"] * UNIT,
        axes=arrays["axes"],
        source=str(arrays["source"]),
        errors=arrays["errors"].astype(float),
        sha256=checksum(path),
    )
    _, windows, terms = table.coefficients.shape
    shapes = {
        "name": (), "source": (), "edges": (windows + 1,), "axes": (3, 3), "errors": (2, windows),
        "coefficients": (4, windows, terms),
    }  # fmt: skip
    wrong = [name for name, shape in shapes.items() if arrays[name].shape != shape]
    if wrong or not (windows and terms):
        raise ValueError(f"shapes of {wrong}")
    if not (
        all(np.isfinite(arrays[name]).all() for name in ("edges", "axes", "errors"))
        and np.all(np.diff(table.edges) > 0)
        and np.all(table.errors >= 0)
        and np.allclose(table.axes @ table.axes.T, np.eye(3), rtol=0, atol=1e-9)
    ):
        raise ValueError("numbers of no table")
    return table


def _arrays(path: Path) -> dict[str, NDArray[Any]]:
    """Arrays of an .npz file, refused by their declared size before they are unpacked."""
    arrays = {}
    with zipfile.ZipFile(path) as archive:
        members = archive.infolist()
        if sum(member.file_size for member in members) > LARGEST:
            raise ValueError(f"it unpacks to more than {LARGEST} bytes")
        for member in members:
            data = BytesIO(archive.read(member))
            if npy.read_magic(data) != (1, 0):
                raise ValueError("another version of .npy")
            shape, by_columns, dtype = npy.read_array_header_1_0(data)
            if dtype.kind not in "fiU":
                raise ValueError(f"an array of {dtype}")
            order: Literal["F", "C"] = "F" if by_columns else "C"
            array = np.frombuffer(data.read(), dtype).reshape(shape, order=order)
            arrays[member.filename.removesuffix(".npy")] = array
    return arrays


@cache
def shipped(name: str) -> OrbitTable | None:
    """The table of a body that is shipped with the library, or nothing.

    Its errors are those of its integration, which the file holds, and what `GROWTH` adds.
    """
    path = Path(__file__).parent / "orbits" / f"{name}.npz"
    # os.path.exists is false for a name that is too long, where Path.exists raises an error
    if not name.isidentifier() or not os.path.exists(path):
        return None
    table = load(path)
    middle = (table.edges[:-1] + table.edges[1:]) / 2
    errors = np.hypot(table.errors, GROWTH[name].at(middle))
    return replace(table, errors=errors.astype(np.float32).astype(float))  # as a file holds them
