"""Store and evaluate tables of orbits that change over millions of years.

An orbit is stored as two components each of its unit normal n and its eccentricity vector e
(towards the pericentre, with the eccentricity as its length), in the table's own frame; the third
components follow from n.n = 1 and n.e = 0. Each component is a Legendre series in windows of about
twenty thousand years, so that values and rates at any time are fast to compute.
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
from earthspin.number_text import plain
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.polynomials import Windows, rule
from earthspin.tables import checksum

#: Length of a window, s, and number of terms per window.
WINDOW, TERMS = 20_000 * JULIAN_YEAR, 16
#: Smallest number of samples per term for a least-squares fit; with fewer, splines are used.
DENSE = 3
#: Cache of evaluated orbits: largest number of times per set, and number of sets. Solutions with
#: different causes of error evaluate the orbit at the same times.
LONGEST_REMEMBERED, SETS_REMEMBERED = 1 << 12, 32
#: Largest total size of the arrays of a file, bytes; a billion years need 13 million.
LARGEST = 1 << 26
#: Unit in which coefficients are stored as integers.
UNIT = 1e-9


class ErrorGrowth(NamedTuple):
    """Growth with time of the errors of the orbit tables included in the package.

    The integration error is excluded.

    Attributes
    ----------
    short_periods : float
        Half-width of the eccentricity due to terms shorter than about 2,000 years, which the table
        omits.
    normal : float
        Growth rate of the half-width of the normal, rad/s.
    eccentricity : float
        Growth rate of the half-width of the eccentricity vector, s-1.
    """

    short_periods: float
    normal: float
    eccentricity: float

    def at(self, times: FloatArray) -> FloatArray:
        """95 % half-widths of orbit normal (rad) and eccentricity at times in s, shape (2, n)."""
        distance = np.abs(times)
        by_shape = np.hypot(self.short_periods, self.eccentricity * distance)
        return np.stack([self.normal * distance, by_shape])


_MYR = 1e6 * JULIAN_YEAR
#: By body, measured. Eccentricities: La2010a to d (Laskar et al. 2011, A&A 532, A89) and La2004
#: (Laskar et al. 2004, A&A 428, 261) for the Earth, ZB18a over the last million years; the file of
#: La2004 for Mars; differences by span are in docs/long_term.md. Normals, which none of these
#: files contains: the integration of `python -m data_tools orbits` repeated with what it leaves
#: out, as mean motions of perihelia and nodes to first order: the Sun's flattening (J2 2.2e-7) and
#: Ceres, Pallas and Vesta (7.2e-10 solar masses on a ring of 2.77 au). It is closer to La2010a by
#: a factor of two beyond six million years.
GROWTH = {
    "earth": ErrorGrowth(4.5e-5, 4.0e-5 / _MYR, 1.8e-5 / _MYR),
    "mars": ErrorGrowth(1.4e-4, 6.0e-5 / _MYR, 2.0e-5 / _MYR),
}


@dataclass(frozen=True, eq=False)
class OrbitTable:
    """Orbit over millions of years: polynomials in time for orbit normal and eccentricity vector.

    Attributes
    ----------
    name : str
        Name of the orbiting body.
    edges : ndarray, shape (w + 1,)
        Edges of the windows, s from J2000.0 TDB, ascending.
    coefficients : ndarray, shape (4, w, m)
        Legendre coefficients of n_1, n_2, e_1, e_2.
    axes : ndarray, shape (3, 3)
        Rows: axes of the table's frame in the GCRS.
    source : str
        Source of the orbit.
    errors : ndarray, shape (2, w)
        95 % half-widths of n (rad) and of e in each window, for each of two directions. For a
        shipped table they include the change by halving the step, the residuals of the series, and
        the divergence from other solutions (see `GROWTH`). For a user's table they include only the
        residuals of the series.
    sha256 : str
        SHA-256 of the file; empty if there was none.
    """

    name: str
    edges: FloatArray
    coefficients: FloatArray
    axes: FloatArray
    source: str
    errors: FloatArray
    sha256: str = ""

    def __post_init__(self) -> None:
        """Make the arrays read-only, so that stored results of this table stay valid."""
        for array in (self.edges, self.coefficients, self.axes, self.errors):
            array.setflags(write=False)

    def __repr__(self) -> str:
        first, last = (_words(float(round(edge))) for edge in self.coverage)
        angle = np.degrees(self.errors[0].max()) * 3600
        return (
            f"<OrbitTable of {self.name}: {first} to {last}, error of the normal at most "
            f"{plain(angle)} arcsec; {self.source}>"
        )

    @property
    def provenance(self) -> dict[str, str]:
        """SHA-256 hash of the orbit table file, as attribute for results; empty without a file."""
        return {"orbit_sha256": self.sha256} if self.sha256 else {}

    @property
    def reference(self) -> str:
        """Body and source of the orbit, as text for the references of a result."""
        return f"orbit of {self.name}: {self.source}"

    @property
    def coverage(self) -> tuple[float, float]:
        """First and last time that the orbit table covers, s from J2000.0 TDB."""
        return float(self.edges[0]), float(self.edges[-1])

    @cached_property
    def _rates(self) -> FloatArray:
        """Legendre coefficients of the rates of the orbit normal's x and y components, s-1."""
        half = np.diff(self.edges)[:, np.newaxis] / 2
        return np.asarray(legendre.legder(self.coefficients[:2], axis=-1) / half)

    def check_times(self, times: FloatArray) -> None:
        """Refuse times outside the orbit table, with a CoverageError."""
        first, last = self.coverage
        low, high = float(np.min(times)), float(np.max(times))
        if not (first <= low and high <= last):
            requested, coverage = ((_words(low), _words(high)), (_words(first), _words(last)))
            raise CoverageError(f"orbit of {self.name}", requested, coverage, "table")

    def error(self, times: FloatArray) -> FloatArray:
        """95 % half-widths of orbit normal (rad) and eccentricity vector at times, shape (2, n)."""
        middle = (self.edges[:-1] + self.edges[1:]) / 2
        return np.stack([np.interp(times, middle, widths) for widths in self.errors])

    def at(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Orbit normal, eccentricity vector and rate of the normal (s-1), in the GCRS, (3, n) each.

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

    @cached_property
    def _windows(self) -> Windows:
        """Windows of the series, which evaluate them in blocks of times."""
        return Windows(self.edges, self.coefficients.shape[-1])

    def _evaluated(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        self.check_times(times)
        n1, n2, e1, e2 = self._windows.evaluate(self.coefficients, times)
        r1, r2 = self._windows.evaluate(self._rates, times)
        n3 = np.sqrt(1 - n1 * n1 - n2 * n2)
        parts = (
            (n1, n2, n3),
            (e1, e2, -(n1 * e1 + n2 * e2) / n3),
            (r1, r2, -(n1 * r1 + n2 * r2) / n3),
        )
        normal, eccentricity, normal_rate = (self.axes.T @ np.stack(part) for part in parts)
        return normal, eccentricity, normal_rate

    def to_file(self, path: str | os.PathLike[str]) -> None:
        """Write the orbit table to a file that `earthspin.read_orbit` can read.

        Coefficients are stored as integer multiples of 1e-9 (0.2 mas), so that reading and writing
        a file again does not change them.

        Parameters
        ----------
        path : str or Path
            Output file, ending in ``.npz``.

        Raises
        ------
        OutputError
            If the name has another ending, or the file cannot be written.
        """
        if not isinstance(path, (str, os.PathLike)):
            raise TypeError(f"path is of type {type(path).__name__}; give a str or a Path")
        file = Path(path)
        if file.suffix != ".npz":
            raise OutputError(
                file, "the file name of an orbit table must end in .npz", "name it so"
            )
        try:
            write(file, self)
        except OSError as error:
            raise OutputError(file, f"it cannot be written: {one_line(error)}") from None


@lru_cache(maxsize=SETS_REMEMBERED)
def _remembered(table: OrbitTable, times: bytes) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the orbit at given times, as read-only arrays; repeated times come from a cache."""
    arrays = table._evaluated(np.frombuffer(times))
    for values in arrays:
        values.flags.writeable = False
    return arrays


def _words(time: float) -> str:
    """Format a time (s from J2000.0) as text in thousands of years."""
    return f"{time / JULIAN_YEAR / 1000:.15g} kyr"


def fitted(
    name: str,
    times: FloatArray,
    normal: FloatArray,
    eccentricity: FloatArray,
    axes: FloatArray,
    source: str,
) -> OrbitTable:
    """Make an orbit table: fit polynomials to samples of orbit normal and eccentricity vector.

    In a window with many samples the series are fitted by least squares, which smooths faster
    variations; with few samples, quintic splines are used.

    Parameters
    ----------
    name, source : str
    times : ndarray, shape (n,)
        s from J2000.0 TDB, ascending.
    normal, eccentricity : ndarray, shape (n, 3)
        Samples in the GCRS.
    axes : ndarray, shape (3, 3)
        Axes of the table's frame; the third is near the normal.
    """
    from scipy.interpolate import make_interp_spline

    first = np.floor(round(times[0] / WINDOW, 6)) * WINDOW
    edges = np.arange(first, times[-1] + 0.5 * WINDOW, WINDOW)
    edges = np.clip(edges, times[0], times[-1])
    edges = np.unique(np.append(edges, times[-1]))
    samples = np.concatenate([normal @ axes[:2].T, eccentricity @ axes[:2].T], axis=1)
    gauss, spline = rule(TERMS), None
    coefficients = np.empty((4, len(edges) - 1, TERMS))
    for window, (start, end) in enumerate(pairwise(edges)):
        span = slice(*np.searchsorted(times, [start, end + 1.0]))  # the sample at the end, too
        middle, half = (start + end) / 2, (end - start) / 2
        x = (times[span] - middle) / half
        if x.size >= DENSE * TERMS:
            series = legendre.legfit(x, samples[span], TERMS - 1)
            series[-2:] += _to_meet(legendre.legval(x[[0, -1]], series).T, samples[span][[0, -1]])
        else:
            spline = spline or make_interp_spline(times, samples, k=5)
            series = gauss.project.T @ spline(middle + half * gauss.nodes)
        coefficients[:, window] = series.T
    table = OrbitTable(name, edges, coefficients, axes, source, np.zeros((2, len(edges) - 1)))
    return replace(table, errors=_left_out(table, times, normal, eccentricity))


def _left_out(
    table: OrbitTable, times: FloatArray, normal: FloatArray, eccentricity: FloatArray
) -> FloatArray:
    """Error of a fitted orbit table in each window: twice the rms residual of the samples.

    The shape is (2, w), for the normal and the eccentricity vector.
    """
    n, e, _ = table.at(times)
    windows = len(table.edges) - 1
    window = np.clip(np.searchsorted(table.edges, times) - 1, 0, windows - 1)
    count = np.maximum(np.bincount(window, minlength=windows), 1)
    residuals = (n.T - normal, e.T - eccentricity)
    squares = (np.bincount(window, np.sum(r**2, axis=1), windows) for r in residuals)
    return np.stack([2 * np.sqrt(square / count) for square in squares])


def _to_meet(ends: FloatArray, samples: FloatArray) -> FloatArray:
    """Corrections of the last two Legendre coefficients, so that the series meets both end samples.

    The last two terms are 1 at the end, plus and minus 1 at the start, and small in between.
    """
    before, after = samples - ends
    return np.stack([(after + before) / 2, (after - before) / 2])


def write(path: Path, table: OrbitTable) -> None:
    """Write an orbit table to a compressed file, in which the coefficients are integers."""
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
    """Read an orbit table from a file written by `write`.

    Raises
    ------
    ValueError
        If arrays are too large, or their shapes or numbers are invalid. Errors of zipfile, zlib and
        tokenize for a damaged file are passed on.
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
    """Read the arrays of an .npz file, after a check of their declared sizes."""
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
    """Return the package's orbit table of a body, or None if the package has none.

    The errors are those of the integration, stored in the file, plus those of `GROWTH`.
    """
    path = Path(__file__).parent / "orbits" / f"{name}.npz"
    # os.path.exists is false for a name that is too long, where Path.exists raises an error
    if not name.isidentifier() or not os.path.exists(path):
        return None
    table = load(path)
    middle = (table.edges[:-1] + table.edges[1:]) / 2
    errors = np.hypot(table.errors, GROWTH[name].at(middle))
    return replace(table, errors=errors.astype(np.float32).astype(float))  # precision of a file
