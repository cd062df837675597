"""Write, read and verify results as netCDF or Zarr.

A result is written to a draft, which replaces the target when it is complete
(`earthspin.engine.atomic_writes`). An attribute of a netCDF file holds the SHA-256 of its content:
names, dimensions, types, attributes and values. The checksums of a Zarr store are described in
`earthspin.engine.zarr_folder`.
"""

from __future__ import annotations

import datetime as dt
import hashlib
import math
import os
import re
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from earthspin._lazy import xr
from earthspin.engine import atomic_writes
from earthspin.engine.origin import plain_bytes, without_lost_scene
from earthspin.engine.question import SCENE
from earthspin.engine.variables import spelled, with_units_of_answers
from earthspin.errors import EarthspinError, MissingExtraError, OutputError, in_bytes, one_line
from earthspin.process import signals_held

#: Attribute of the root: version of the way in which results are stored.
FORMAT, VERSION = "earthspin_format", 2
#: Attributes of the root of a new file. Only files have units as CF wants them.
OF_FILES = {"Conventions": "CF-1.11", FORMAT: VERSION}
#: Attribute of the root of a netCDF file: SHA-256 of its content.
CONTENT = "content_sha256"
#: Attribute of a store that was made in blocks: SHA-256 of the request.
MADE_OF = "made_of_sha256"

#: Largest size of a chunk of a Zarr store that is written at once, bytes.
CHUNK = 1 << 28

#: Lock of the netCDF library, which is not thread-safe.
_NETCDF = threading.RLock()

#: Rough upper bound on the size of a group of a netCDF file without its numbers, bytes.
_FRAME = 1 << 16

#: Integer microseconds from a recent date hold every epoch of every kernel exactly.
TIME_ENCODING = {
    "units": "microseconds since 2000-01-01T12:00:00",
    "dtype": "int64",
    "calendar": "proleptic_gregorian",
    "_FillValue": np.iinfo(np.int64).min,  # the default, zero, would be a date in 2000
}


def write(result: xr.Dataset | xr.DataTree, path: str | Path) -> Path:
    """Write a result (a Dataset, or a DataTree with sections) to a netCDF file or Zarr store.

    Parameters
    ----------
    result : Dataset or DataTree
    path : str or Path
        Path that ends in ``.nc`` or ``.zarr``. An existing file is replaced when the new one is
        complete. It is not changed if an error occurs.

    Returns
    -------
    Path

    Raises
    ------
    OutputError
        If the path cannot be written, its name has another ending, or `result` is not a Dataset or
        DataTree.
    TypeError
        If `path` is not a path.
    MissingExtraError
        If zarr is needed and not installed.

    Examples
    --------
    >>> import earthspin
    >>> tree = earthspin.run_tree("precession", sections="seasons")
    >>> path = earthspin.write(tree, "precession.nc")
    >>> print(earthspin.open(path).identical(tree))
    True
    """
    place = atomic_writes.as_path(path)
    if not hasattr(result, "data_vars"):
        problem = f"{type(result).__name__} is not an answer"
        raise OutputError(place, problem, "give a Dataset or DataTree")
    _refuse_attributes(result, place)
    if place.suffix not in (".nc", ".zarr"):
        raise OutputError(place, "its name ends in neither .nc nor .zarr", "choose one of the two")
    with atomic_writes.replacing(place) as draft:
        (_write_zarr if place.suffix == ".zarr" else write_netcdf)(result, draft)
    return place


def write_netcdf(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Write a result directly to a netCDF file; if interrupted, the file remains incomplete.

    Raises
    ------
    OSError
        If the file cannot be written; the message contains that of the operating system.
    """
    groups = _groups(result)
    root = groups["/"].assign_attrs({CONTENT: content_hash(groups)})
    with signals_held(), _NETCDF:
        try:
            for group, node in (groups | {"/": root}).items():
                mode: Any = "w" if group == "/" else "a"
                encoding = encoding_of(node, zarr=False)
                node.to_netcdf(path, mode=mode, group=group, engine="netcdf4", encoding=encoding)
        except (RuntimeError, OSError) as error:  # "HDF error" for every reason
            _raise_system_error(path, sum(node.nbytes + _FRAME for node in groups.values()))
            raise OSError(f"the netCDF library says: {one_line(error)}") from None


#: Types of numbers that netCDF holds.
_NUMBERS = {"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"}


def _refuse_attributes(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Raise an error if an attribute of a result is not text, a real number or a list of these."""
    for node in getattr(result, "subtree", (result,)):
        owners = {f"'{name}'": variable.attrs for name, variable in node.variables.items()}
        for owner, attrs in ({"the answer": node.attrs} | owners).items():
            for name, value in attrs.items():
                wanted = _is_storable(value) and (name != SCENE or isinstance(value, str))
                if not (isinstance(name, str) and wanted):
                    what = f"attribute {name!r} of {owner} is of type {type(value).__name__}"
                    remedy = "give text, a real number or a plain list of these, or remove it"
                    raise OutputError(path, what, remedy)


def _is_storable(value: object) -> bool:
    if isinstance(value, str):
        return "\0" not in value  # netCDF ends text there
    numeric = isinstance(value, (int, float, np.number, list, tuple))
    if not numeric and type(value) is not np.ndarray:
        return False
    try:
        array = np.asarray(value)
    except Exception:  # uneven lists, or any error of a user's class
        return False
    return array.ndim < 2 and (array.dtype.kind == "U" or array.dtype.str[1:] in _NUMBERS)


def _raise_system_error(path: Path, size: int) -> None:
    """Write `size` bytes to a file as a test, and raise the operating system's error, if any.

    Raises
    ------
    OSError
        If `size` bytes cannot be written to `path`.
    """
    try:
        with path.open("wb") as file:
            file.write(bytes(size))
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        problem = f"{one_line(error)}; it takes about {in_bytes(size)}"
        raise OSError(error.errno, problem) from None


def _groups(result: xr.Dataset | xr.DataTree) -> dict[str, xr.Dataset]:
    """Datasets of a result and its sections as they are written, by group path in the file.

    The root has the version of the format, and the date in the attribute `history`.
    """
    tree = xr.DataTree(result) if isinstance(result, xr.Dataset) else result
    groups = {
        "/" if path == "." else f"/{path}": spelled(node.to_dataset(inherit=False))
        for path, node in tree.subtree_with_keys
    }
    groups["/"] = without_lost_scene(groups["/"]).assign_attrs(OF_FILES)
    history = groups["/"].attrs.get("history")
    if history is not None:
        stamp = dt.datetime.now(dt.UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
        groups["/"] = groups["/"].assign_attrs(history=f"{stamp} {history}")
    return groups


def _write_zarr(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Write a result with its sections to a Zarr store, one group for each section."""
    groups, zarr_folder = _groups(result), zarr_of()
    zarr_folder.write(groups, path, {name: encoding_of(node) for name, node in groups.items()})
    zarr_folder.seal(path)
    zarr_folder.close(path)


def zarr_of() -> ModuleType:
    """Import and return the module `zarr_folder`; raise an error if zarr is not installed.

    Raises
    ------
    MissingExtraError
        If zarr is not installed.
    """
    try:
        from earthspin.engine import zarr_folder
    except ImportError:
        raise MissingExtraError("zarr", "zarr", "a result in chunks") from None
    return zarr_folder


def open(path: str | Path) -> xr.Dataset | xr.DataTree:
    """Read a result (a Dataset, or a DataTree with sections) from a netCDF file or Zarr store.

    Parameters
    ----------
    path : str or Path
        A netCDF file is read completely and compared with its checksum. A Zarr store is read when
        values are used, and each chunk is compared with its checksum; `verify` reads all of them.

    Returns
    -------
    Dataset or DataTree
        Times as ``datetime64[us]``.

    Raises
    ------
    OutputError
        If the file is not a result, is truncated, or does not match its checksum. A Zarr store
        may raise it later, if a chunk is missing or the store was replaced.
    TypeError
        If `path` is not a path.

    Examples
    --------
    ``read`` is the same function; ``from earthspin import read`` does not hide Python's ``open``.

    >>> import earthspin
    >>> _ = earthspin.write(earthspin.precession(), "precession.nc")
    >>> print(earthspin.open("precession.nc").identical(earthspin.read("precession.nc")))
    True
    """
    import earthspin.engine.accessor  # noqa: F401 - registers ds.earthspin

    groups = _read(atomic_writes.as_path(path)).items()
    nodes = {name: with_units_of_answers(node) for name, node in groups}
    root = nodes["/"]
    root.attrs = {name: value for name, value in root.attrs.items() if name not in _FILE_ATTRIBUTES}
    if SCENE in root.data_vars:  # a file of an earlier version
        root.attrs[SCENE] = root[SCENE].values.tolist()
        root = root.drop_vars(SCENE)
    nodes["/"] = root = without_lost_scene(root)
    if "history" in root.attrs:  # the date belongs to the file
        root.attrs["history"] = _STAMP.sub("", root.attrs["history"])
    return root if len(nodes) == 1 else xr.DataTree.from_dict(nodes)


def verify(path: str | Path) -> Path:
    """Read a complete result file and compare it with the checksums that it stores.

    Parameters
    ----------
    path : str or Path
        A netCDF file, or a Zarr store of any length.

    Returns
    -------
    Path
        The path, if every label, number and attribute is as it was written.

    Raises
    ------
    OutputError
        If the file was changed, cannot be read, has no checksum, or is of format 1.
    TypeError
        If `path` is not a path.

    Examples
    --------
    >>> import earthspin
    >>> _ = earthspin.write(earthspin.precession(), "precession.nc")
    >>> print(earthspin.verify("precession.nc"))
    precession.nc
    """
    place = atomic_writes.as_path(path)
    if place.suffix == ".zarr":
        zarr_folder = zarr_of()
        with _reading(place):
            attrs = zarr_folder.attributes(place)
            if _format_of(place, attrs) == VERSION:
                zarr_folder.verify(place)
    else:
        attrs = _read(place)["/"].attrs
    if attrs.get(FORMAT) == VERSION:
        return place
    if CONTENT in attrs or any(place.rglob("SHA256SUMS")):
        raise OutputError(place, "format 1: open it and write it again")
    raise OutputError(place, "it has no checksum", "earthspin.write adds one")


def _format_of(path: Path, attrs: Mapping[str, Any]) -> int:
    """Format version of a result file; 1 if the file states none (another program's file).

    Raises
    ------
    OutputError
        If the version is unknown.
    """
    version = attrs.get(FORMAT, 1)
    if version not in (1, VERSION):
        problem = f"its format is {version}, and this version of earthspin reads 1 and {VERSION}"
        raise OutputError(path, problem, "update earthspin")
    return int(version)


@contextmanager
def _reading(path: Path) -> Iterator[None]:
    """Convert all errors of a damaged file to an `OutputError`; a context manager.

    Raises
    ------
    OutputError
        Also if a Zarr store is replaced while it is read.
    """
    opened = atomic_writes.identity(path)
    try:
        yield
        if path.suffix == ".zarr":
            atomic_writes.check_identity(path, opened)
    except Exception as error:  # the libraries raise many types for damaged files
        atomic_writes.check_identity(path, opened)
        raise _unreadable(path, error) from None


def _read(path: Path) -> dict[str, xr.Dataset]:
    """Read all groups of a file as Datasets, by group path; units are spelled as in files."""
    with _reading(path):
        return _read_zarr(path) if path.suffix == ".zarr" else _read_netcdf(path)


def _read_zarr(path: Path) -> dict[str, xr.Dataset]:
    """Open the groups of a Zarr store; check the metadata if this package wrote the store."""
    zarr_folder = zarr_of()
    sealed = _format_of(path, zarr_folder.attributes(path)) == VERSION
    (zarr_folder.metadata_of if sealed else zarr_folder.check_nodes)(path)
    store = zarr_folder.ZarrFolder(path) if sealed else path
    nodes = open_groups(store, engine="zarr", consolidated=sealed)
    nodes["/"].attrs.pop(zarr_folder.METADATA, None)
    return nodes


def _read_netcdf(path: Path) -> dict[str, xr.Dataset]:
    """Read a netCDF file completely, and compare it with the checksum of its content."""
    if path.is_fifo():
        raise OutputError(path, "it is a pipe", "give a file")
    with signals_held(), _NETCDF:
        nodes = open_groups(path, engine="netcdf4")
        try:
            for node in nodes.values():
                node.load()
        finally:
            for node in nodes.values():
                node.close()
    attrs = nodes["/"].attrs
    if _format_of(path, attrs) == VERSION and attrs.get(CONTENT) != content_hash(nodes):
        raise atomic_writes.mismatch_error(path, "its names, numbers, words or attributes")
    return nodes


def open_groups(store: Any, **options: Any) -> dict[str, xr.Dataset]:
    """Open all groups of a file as Datasets, by group path, with times as ``datetime64[us]``."""
    return xr.open_groups(store, decode_times=xr.coders.CFDatetimeCoder(time_unit="us"), **options)


def _unreadable(path: Path, error: Exception) -> EarthspinError:
    """Return the `EarthspinError` that caused a read error, or else make an `OutputError`."""
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, EarthspinError):
            return cause
        cause = cause.__cause__ or cause.__context__  # xarray 2025 replaces errors of the store
    reason = one_line(error) or type(error).__name__
    return OutputError(path, f"it cannot be read: {reason}")


#: Attributes of the file that are not part of the answer.
_FILE_ATTRIBUTES = (*OF_FILES, CONTENT, MADE_OF)
#: Pattern of the date at the start of a file's history.
_STAMP = re.compile(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ ")

#: The same function by its older name.
read = open


def encoding_of(node: xr.Dataset, *, zarr: bool = True) -> dict[str, dict[str, Any]]:
    """Return the netCDF or Zarr encoding of each variable of a Dataset, by variable name.

    The CF conventions require that coordinate variables are numeric, so text labels are stored as
    arrays of characters, which xarray reads back as text. Missing chunks of a Zarr store are read
    as NaN. A variable up to `CHUNK` bytes is one chunk, because Zarr writes chunks at the same
    time, and after an error in one of them it writes the others.

    Parameters
    ----------
    node : Dataset
    zarr : bool
        Return the encoding for Zarr rather than for netCDF.
    """
    encoding: dict[str, dict[str, Any]] = {}
    for name, variable in node.variables.items():
        kind, coordinate = variable.dtype.kind, variable.dims == (name,)
        entry = encoding[str(name)] = dict(TIME_ENCODING) if kind == "M" else {}
        if zarr and kind == "f":
            entry["_FillValue"] = np.nan
        elif not zarr and (kind == "f" or coordinate):
            entry["_FillValue"] = None  # no value is missing, and CF forbids it for coordinates
        if not zarr and kind in "UO" and coordinate:
            entry["dtype"] = "S1"
        if zarr and variable.dims:
            length, *others = (max(size, 1) for size in variable.shape)
            rows = CHUNK // (math.prod(others) * variable.dtype.itemsize)
            entry["chunks"] = (min(length, max(rows, 1)), *others)
    return encoding


# --- checksum of the content ---------------------------------------------------------------------


def content_hash(groups: Mapping[str, xr.Dataset]) -> str:
    """SHA-256 of the contents of a result; the hash is the same after writing and reading.

    Parameters
    ----------
    groups : mapping of str to Dataset
        Groups by path, ``"/"`` for the root, whose attribute `CONTENT` is ignored.
    """
    total = hashlib.sha256()
    for group, node in sorted(groups.items()):
        total.update(repr((group, _listed(node.attrs))).encode("utf-8", "surrogatepass"))
        for name, variable in sorted(node.variables.items(), key=lambda item: str(item[0])):
            kind, content = plain_bytes(variable.values)
            head = (name, dict(variable.sizes), kind, _listed(variable.attrs), len(content))
            total.update(repr(head).encode("utf-8", "surrogatepass"))
            total.update(content)
    return total.hexdigest()


def _listed(attrs: Mapping[Any, Any]) -> list[tuple[str, list[Any]]]:
    """Sorted attributes, with values as lists, because netCDF turns a list of one into a number."""
    values = {k: [v] if isinstance(v, str) else np.ravel(v).tolist() for k, v in attrs.items()}
    return sorted((name, value) for name, value in values.items() if name != CONTENT)
