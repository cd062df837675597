"""Write and read results as netCDF or Zarr, with atomic writes and checksums.

A result is written to a draft, which is moved to the target when it is complete
(`earthspin.engine.drafts`). It contains checksums (`earthspin.engine.checksums`). The bytes of a
netCDF file are compared with its last line before it is opened; if another program has removed that
line, the content is compared with an attribute. The files of a Zarr store are compared with its
ledger when they are read, and `verify` compares all of them.
"""

from __future__ import annotations

import datetime as dt
import errno
import os
import re
import shutil
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin.engine import checksums
from earthspin.engine.drafts import as_path, check_identity, identity, put_back, replacing
from earthspin.engine.labels import IN_FILES
from earthspin.engine.plan import SCENE, scene_of
from earthspin.errors import EarthspinError, MissingExtraError, OutputError, in_bytes, one_line

if TYPE_CHECKING:
    import xarray as xr

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
    """Write a result, alone or with its sections, to a netCDF file or Zarr store.

    Parameters
    ----------
    result : Dataset or DataTree
    path : str or Path
        Path that ends in ``.nc`` or ``.zarr``. An existing file is replaced when the new one is
        complete and on the disk. It is not changed if an error occurs.

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
    place = as_path(path)
    if not hasattr(result, "data_vars"):
        problem = f"{type(result).__name__} is not an answer"
        raise OutputError(place, problem, "give a Dataset or DataTree")
    _refuse_attributes(result, place)
    if place.suffix not in (".nc", ".zarr"):
        raise OutputError(place, "its name ends in neither .nc nor .zarr", "choose one of the two")
    if place.suffix == ".zarr":
        zarr_of()
    with replacing(place) as draft:
        (_write_zarr if place.suffix == ".zarr" else write_netcdf)(result, draft)
    return place


def write_netcdf(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Write a result directly to a netCDF file, without the protection against interruptions.

    Raises
    ------
    OSError
        If the file cannot be written; the message contains that of the operating system.
    """
    groups = _groups(result)
    if scene := groups["/"].attrs.pop(SCENE, ""):
        groups["/"][SCENE] = ((), scene, {"long_name": "the complete question, a scene in TOML"})
    root = groups["/"].assign_attrs({checksums.CONTENT: checksums.of_content(groups)})
    with _NETCDF:
        try:
            for group, node in (groups | {"/": root}).items():
                mode: Any = "w" if group == "/" else "a"
                encoding = encoding_of(node, zarr=False)
                node.to_netcdf(path, mode=mode, group=group, engine="netcdf4", encoding=encoding)
        except (RuntimeError, OSError) as error:  # "HDF error" for every reason
            _raise_system_error(path, sum(node.nbytes + _FRAME for node in groups.values()))
            raise OSError(f"the netCDF library says: {one_line(error)}") from None
        checksums.append_line(path)


#: Types of numbers that netCDF holds.
_NUMBERS = {"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"}


def _refuse_attributes(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Raise an error if an attribute is neither text nor real numbers, as no file can hold it."""
    for node in getattr(result, "subtree", (result,)):
        owners = {f"'{name}'": variable.attrs for name, variable in node.variables.items()}
        for owner, attrs in ({"the answer": node.attrs} | owners).items():
            for name, value in attrs.items():
                if not (isinstance(name, str) and _is_storable(value)):
                    what = f"attribute {name!r} of {owner} is of type {type(value).__name__}"
                    raise OutputError(path, what, "give text or real numbers, or remove it")


def _is_storable(value: object) -> bool:
    if isinstance(value, (str, bytes)):
        return True
    try:
        dtype = np.asarray(value).dtype
    except Exception:  # uneven lists, or any error of a user's class
        return False
    return dtype.kind in "US" or dtype.str[1:] in _NUMBERS


def _raise_system_error(path: Path, size: int) -> None:
    """Write `size` zero bytes to a file, only to raise the system's error if this fails.

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
        if error.errno == errno.ENOSPC:
            written = path.stat().st_size if path.exists() else 0
            room = shutil.disk_usage(path.parent).free + written
            problem += f", and {in_bytes(room)} of the disk are free"
        raise OSError(error.errno, problem) from None


def _groups(result: xr.Dataset | xr.DataTree) -> dict[str, xr.Dataset]:
    """Datasets of a result and of its sections, by the path of their group in the file.

    The date is added to the attribute `history`.
    """
    import xarray as xr

    tree = xr.DataTree(result) if isinstance(result, xr.Dataset) else result
    groups = {
        "/" if path == "." else f"/{path}": spelled(node.to_dataset(inherit=False))
        for path, node in tree.subtree_with_keys
    }
    history = groups["/"].attrs.get("history")
    if history is not None:
        stamp = dt.datetime.now(dt.UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
        groups["/"] = groups["/"].assign_attrs(history=f"{stamp} {history}")
    return groups


#: Attributes of a variable in a file: units in the spelling of files, and of earthspin.
UNITS, SHOWN = "units", "units_shown"


def spelled(node: xr.Dataset) -> xr.Dataset:
    """Return a Dataset with units spelled as in files; `units_shown` has the screen spelling."""
    node = node.copy()
    for name, variable in node.variables.items():
        unit = variable.attrs.get(UNITS)
        if unit in IN_FILES:
            node[name].attrs = variable.attrs | {UNITS: IN_FILES[unit], SHOWN: unit}
    return node


def _write_zarr(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Write a result with its sections to a Zarr store, one group for each section."""
    with zarr_of().config.set({"threading.max_workers": 1}):
        for group, node in _groups(result).items():
            mode: Any = "w" if group == "/" else "a"
            node.to_zarr(path, mode=mode, group=group, encoding=encoding_of(node), **ZARR)
    checksums.write_ledger(path, checksums.of_files(path, checksums.files_in(path)))


#: Options of Zarr stores. Zarr version 3 has no standard for arrays of text. Chunks with fill
#: values only are written too, so that a missing chunk always means a loss of data.
ZARR: dict[str, Any] = {"consolidated": False, "zarr_format": 2, "write_empty_chunks": True}


def zarr_of() -> Any:
    """Import and return the module `zarr`; raise an error if it is not installed.

    Raises
    ------
    MissingExtraError
        If zarr is not installed.
    """
    try:
        import zarr
    except ImportError:
        raise MissingExtraError("zarr", "zarr", "a result in chunks") from None
    return zarr


def open(path: str | Path) -> xr.Dataset | xr.DataTree:
    """Read a result, alone or with its sections, exactly as it was written.

    Parameters
    ----------
    path : str or Path
        A netCDF file is read completely and compared with its checksum. A Zarr store is read when
        values are used, and each of its files is compared with the ledger when it is read;
        `verify` reads all of them.

    Returns
    -------
    Dataset or DataTree
        Times as ``datetime64[us]``.

    Raises
    ------
    OutputError
        If the file is not a result, is truncated, or differs from what was written. A Zarr store
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
    import xarray as xr

    import earthspin.engine.accessor  # noqa: F401 - registers ds.earthspin

    nodes = _read(as_path(path))
    for node in nodes.values():
        for variable in node.variables.values():
            if SHOWN in variable.attrs:  # a file of earthspin has both spellings
                variable.attrs[UNITS] = variable.attrs.pop(SHOWN)
    root = nodes["/"]
    root.attrs = {name: value for name, value in root.attrs.items() if name not in _FILE_ATTRIBUTES}
    if SCENE in root.data_vars:
        root.attrs[SCENE] = scene_of(root)
        nodes["/"] = root = root.drop_vars(SCENE)
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
        If the file was changed, cannot be read, or has no checksum.
    TypeError
        If `path` is not a path.

    Examples
    --------
    >>> import earthspin
    >>> _ = earthspin.write(earthspin.precession(), "precession.nc")
    >>> print(earthspin.verify("precession.nc"))
    precession.nc
    """
    place = as_path(path)
    if place.suffix == ".zarr" and _verify_files(place):
        return place
    attrs = _read(place)["/"].attrs
    if place.suffix != ".zarr" and (checksums.CONTENT in attrs or checksums.line_holds(place)):
        return place
    if any(name in attrs for name in checksums.EARLIER):
        problem = "it has only checksums of an earlier version, which cannot be checked"
        raise OutputError(place, problem, "open it and write it again")
    raise OutputError(place, "it has no checksum", "earthspin.write adds one")


def _verify_files(store: Path) -> bool:
    """Compare all files of a Zarr store with its checksum list; return False without a list.

    Raises
    ------
    OutputError
        If a file was changed or cannot be read.
    """
    put_back(store)
    opened = identity(store)
    try:
        ledger = checksums.ledger_of(store)
        if ledger is None:
            return False
        sums = checksums.of_files(store, [*ledger, *checksums.files_in(store)])
    except OSError as error:
        check_identity(store, opened)
        raise _unreadable(store, error) from None
    check_identity(store, opened)
    for name, digest in sums.items():
        checksums.check_file(store, name, digest, ledger)
    return True


def _read(path: Path) -> dict[str, xr.Dataset]:
    """Read all groups of a file by their paths; units stay in the spelling of files.

    A netCDF file is compared with the checksum of its bytes, or of its content if it has no other.
    """
    import xarray as xr

    coder = xr.coders.CFDatetimeCoder(time_unit="us")
    put_back(path)
    opened = identity(path)
    try:
        if path.suffix == ".zarr":
            zarr_of()
            from earthspin.engine.zarr_folder import ZarrFolder

            options: dict[str, Any] = {"engine": "zarr", "consolidated": False}
            return xr.open_groups(ZarrFolder(path), decode_times=coder, **options)  # type: ignore[arg-type]
        with _NETCDF:
            if path.is_fifo():
                raise OutputError(path, "it is a pipe", "give a file")
            line_holds = checksums.line_holds(path)
            if line_holds is False:
                raise checksums.mismatch_error(path, "its bytes")
            nodes = xr.open_groups(path, decode_times=coder, engine="netcdf4")
            for node in nodes.values():
                with node:
                    node.load()
        content = None if line_holds else nodes["/"].attrs.get(checksums.CONTENT)
        if content and content != checksums.of_content(nodes):
            raise checksums.mismatch_error(path, "its names, numbers, words or attributes")
        return nodes
    except EarthspinError:
        raise
    except Exception as error:  # the libraries raise many types for damaged files
        check_identity(path, opened)
        raise _unreadable(path, error) from None


def _unreadable(path: Path, error: Exception) -> OutputError:
    """Make the error for a file that cannot be read, or return the `OutputError` behind it."""
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, OutputError):
            return cause
        cause = cause.__cause__ or cause.__context__  # xarray 2025 replaces errors of the store
    reason = one_line(error) or type(error).__name__
    return OutputError(path, f"it cannot be read: {reason}")


#: Attribute of a store that was made in blocks: SHA-256 of the request.
MADE_OF = "made_of_sha256"
#: Attributes of the file that are not part of the answer.
_FILE_ATTRIBUTES = (checksums.CONTENT, *checksums.EARLIER, MADE_OF)
#: Pattern of the date at the start of a file's history.
_STAMP = re.compile(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ ")

#: The same function by its older name.
read = open


def encoding_of(
    node: xr.Dataset, *, zarr: bool = True, chunked: str = ""
) -> dict[str, dict[str, Any]]:
    """Return, by variable name, the encoding with which each variable is stored in a file.

    The CF conventions require that coordinate variables are numeric, so text labels are stored as
    arrays of characters, which xarray reads back as text. The scene is stored as characters too,
    because the netCDF library crashes if a file with variable-length text is opened twice. Missing
    chunks of a Zarr store are read as NaN.

    Parameters
    ----------
    node : Dataset
    zarr : bool
        Return the encoding for Zarr rather than for netCDF.
    chunked : str
        Dimension along which the node is one chunk of a store.
    """
    encoding: dict[str, dict[str, Any]] = {}
    for name, variable in node.variables.items():
        kind, coordinate = variable.dtype.kind, variable.dims == (name,)
        entry = encoding[str(name)] = dict(TIME_ENCODING) if kind == "M" else {}
        if zarr and kind == "f":
            entry["_FillValue"] = np.nan
        elif not zarr and (kind == "f" or coordinate):
            entry["_FillValue"] = None  # no value is missing, and CF forbids it for coordinates
        if not zarr and kind in "UO" and (coordinate or name == SCENE):
            entry["dtype"] = "S1"
        if chunked in variable.dims:
            entry["chunks"] = variable.shape
    return encoding
