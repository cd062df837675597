"""Results on disk: netCDF, or Zarr by region, whole or not at all, and guarded.

A result is written beside its place and moved there when it is complete (`earthspin.engine.drafts`
says what that promises). It carries checksums (`earthspin.engine.checksums`): the bytes of a netCDF
file are held to its last line before it is opened, and what it says to an attribute if another
program has taken that line away. The files of a Zarr store are held to its ledger as they are read,
and all of them by `verify`.
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

#: One thread at a time in the netCDF library, which is not made for more.
_NETCDF = threading.RLock()

#: Bytes of a group of a netCDF file beside its numbers, at most about.
_FRAME = 1 << 16

#: Integer microseconds from a recent date hold every epoch of every kernel exactly.
TIME_ENCODING = {
    "units": "microseconds since 2000-01-01T12:00:00",
    "dtype": "int64",
    "calendar": "proleptic_gregorian",
    "_FillValue": np.iinfo(np.int64).min,  # no date; zero would be the year 2000
}


def write(result: xr.Dataset | xr.DataTree, path: str | Path) -> Path:
    """Write an answer, alone or with its sections, to a file.

    Parameters
    ----------
    result : Dataset or DataTree
    path : str or Path
        Ends in ``.nc`` or ``.zarr``. What stands there is replaced when all is written and on the
        disk, a file in one step; until then, and if anything goes wrong, it is as it was.

    Returns
    -------
    Path

    Raises
    ------
    OutputError
        If the place cannot be written, its name has another ending, or `result` is no answer.
    TypeError
        If `path` is no path.
    MissingExtraError
        If zarr is asked for and not installed.

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
        problem = f"{type(result).__name__} is no answer"
        raise OutputError(place, problem, "give a Dataset or DataTree")
    _refuse_attributes(result, place)
    if place.suffix not in (".nc", ".zarr"):
        raise OutputError(place, "it ends in neither .nc nor .zarr", "choose one of the two")
    if place.suffix == ".zarr":
        zarr_of()
    with replacing(place) as draft:
        (_write_zarr if place.suffix == ".zarr" else write_netcdf)(result, draft)
    return place


def write_netcdf(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Write an answer straight to a netCDF file; `write` does so whole or not at all.

    Raises
    ------
    OSError
        If the file cannot be written, with the reason of the system.
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
        except (RuntimeError, OSError) as error:  # "HDF error", whatever the system said
            _raise_reason_of_system(path, sum(node.nbytes + _FRAME for node in groups.values()))
            raise OSError(f"the netCDF library says: {one_line(error)}") from None
        checksums.append_line(path)


#: Types of numbers that netCDF holds.
_NUMBERS = {"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"}


def _refuse_attributes(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Refuse attributes that are neither text nor real numbers: no file can hold them."""
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
    except Exception:  # uneven lists, and whatever somebody's class says
        return False
    return dtype.kind in "US" or dtype.str[1:] in _NUMBERS


def _raise_reason_of_system(path: Path, size: int) -> None:
    """Write so many bytes to a file of no more use, to learn what the system says of it.

    Raises
    ------
    OSError
        If they do not fit.
    """
    try:
        with path.open("wb") as file:
            file.write(bytes(size))
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        words = f"{one_line(error)}; it takes about {in_bytes(size)}"
        if error.errno == errno.ENOSPC:
            written = path.stat().st_size if path.exists() else 0
            room = shutil.disk_usage(path.parent).free + written
            words += f", and {in_bytes(room)} of the disk are free"
        raise OSError(error.errno, words) from None


def _groups(result: xr.Dataset | xr.DataTree) -> dict[str, xr.Dataset]:
    """The answer, with the date in its history, and its sections, by the path of each in a file."""
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


#: Attributes of a variable in a file: the units, and how people read them.
UNITS, SHOWN = "units", "units_shown"


def spelled(node: xr.Dataset) -> xr.Dataset:
    """A copy whose units are spelled for files, the word for people kept beside."""
    node = node.copy()
    for name, variable in node.variables.items():
        word = variable.attrs.get(UNITS)
        if word in IN_FILES:
            node[name].attrs = variable.attrs | {UNITS: IN_FILES[word], SHOWN: word}
    return node


def _write_zarr(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Write an answer with its sections to Zarr, a group for each node."""
    with zarr_of().config.set({"threading.max_workers": 1}):
        for group, node in _groups(result).items():
            mode: Any = "w" if group == "/" else "a"
            node.to_zarr(path, mode=mode, group=group, encoding=encoding_of(node), **ZARR)
    checksums.write_ledger(path, checksums.of_files(path, checksums.files_in(path)))


#: How our Zarr stores are made. Version 3 has no settled way to keep words. A chunk of nothing but
#: fill values is written too: one that is missing is then always a loss.
ZARR: dict[str, Any] = {"consolidated": False, "zarr_format": 2, "write_empty_chunks": True}


def zarr_of() -> Any:
    """Zarr, if it is installed.

    Raises
    ------
    MissingExtraError
    """
    try:
        import zarr
    except ImportError:
        raise MissingExtraError("zarr", "zarr", "a result in chunks") from None
    return zarr


def open(path: str | Path) -> xr.Dataset | xr.DataTree:
    """Read what was written back as it was: an answer, or an answer with its sections.

    Parameters
    ----------
    path : str or Path
        NetCDF is read whole and held to its checksum. Zarr is read as it is used: each file of it
        is held to the ledger as it is read; `verify` reads it all.

    Returns
    -------
    Dataset or DataTree
        Times as ``datetime64[us]``.

    Raises
    ------
    OutputError
        If it is no result, was cut short, or is not what was written. A Zarr store may raise it
        later, where a chunk is missing or the store was replaced since.
    TypeError
        If `path` is no path.

    Examples
    --------
    ``read`` is the same call, for those who import names one by one.

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
            if SHOWN in variable.attrs:  # a file of ours has both spellings
                variable.attrs[UNITS] = variable.attrs.pop(SHOWN)
    root = nodes["/"]
    root.attrs = {name: value for name, value in root.attrs.items() if name not in _OWN}
    if SCENE in root.data_vars:
        root.attrs[SCENE] = scene_of(root)
        nodes["/"] = root = root.drop_vars(SCENE)
    if "history" in root.attrs:  # the date belongs to the file
        root.attrs["history"] = _STAMP.sub("", root.attrs["history"])
    return root if len(nodes) == 1 else xr.DataTree.from_dict(nodes)


def verify(path: str | Path) -> Path:
    """Read all of a file of ours and hold it to the checksums that it carries.

    Parameters
    ----------
    path : str or Path
        NetCDF, or a Zarr store of any length.

    Returns
    -------
    Path
        The same; every label, number and attribute is then what was written.

    Raises
    ------
    OutputError
        If something in it is not what was written or cannot be read, or it carries no checksum.
    TypeError
        If `path` is no path.

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
        what = "it carries checksums of an earlier version alone, which are not checked"
        raise OutputError(place, what, "open it and write it again")
    raise OutputError(place, "it carries no checksum", "earthspin.write gives it one")


def _verify_files(store: Path) -> bool:
    """Hold every file of a Zarr store to its ledger; False if it has none.

    Raises
    ------
    OutputError
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
    """Nodes of a file by their paths, units as the file has them.

    NetCDF is held to its checksums, to that of its content only where no line guards its bytes.
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
                raise checksums.changed(path, "its bytes")
            nodes = xr.open_groups(path, decode_times=coder, engine="netcdf4")
            for node in nodes.values():
                with node:
                    node.load()
        content = None if line_holds else nodes["/"].attrs.get(checksums.CONTENT)
        if content and content != checksums.of_content(nodes):
            raise checksums.changed(path, "its names, numbers, words or attributes")
        return nodes
    except EarthspinError:
        raise
    except Exception as error:  # whatever the libraries say of a file that is damaged
        check_identity(path, opened)
        raise _unreadable(path, error) from None


def _unreadable(path: Path, error: Exception) -> OutputError:
    """What to say of it: the words of our own if the libraries met them on their way."""
    met: BaseException | None = error
    while met is not None:
        if isinstance(met, OutputError):
            return met
        met = met.__cause__ or met.__context__  # xarray 2025 stumbles when it passes them on
    words = one_line(error) or type(error).__name__
    return OutputError(path, f"it cannot be read: {words}")


#: Attribute of a store that was made in blocks: one word for what was asked, and of which versions.
MADE_OF = "made_of_sha256"
#: Attributes that belong to the file, not to the answer.
_OWN = (checksums.CONTENT, *checksums.EARLIER, MADE_OF)
#: Date that a file's history begins with.
_STAMP = re.compile(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ ")

#: The same by its older name.
read = open


def encoding_of(
    node: xr.Dataset, *, zarr: bool = True, chunked: str = ""
) -> dict[str, dict[str, Any]]:
    """Return the encoding of each variable.

    A coordinate variable of netCDF is a number to the CF conventions; words along a dimension are
    rows of characters, which xarray reads as the labels that they were. The scene is characters
    too: netCDF ends the process where a file with a text of any length is opened a second time. A
    chunk that is missing from Zarr reads as no number.

    Parameters
    ----------
    node : Dataset
    zarr : bool
        Whether it is for Zarr, or for netCDF.
    chunked : str
        A dimension along which the node is one chunk of a longer one.
    """
    encoding: dict[str, dict[str, Any]] = {}
    for name, variable in node.variables.items():
        kind, coordinate = variable.dtype.kind, variable.dims == (name,)
        entry = encoding[str(name)] = dict(TIME_ENCODING) if kind == "M" else {}
        if zarr and kind == "f":
            entry["_FillValue"] = np.nan
        elif not zarr and (kind == "f" or coordinate):
            entry["_FillValue"] = None  # nothing is ever missing; CF forbids it of a coordinate
        if not zarr and kind in "UO" and (coordinate or name == SCENE):
            entry["dtype"] = "S1"
        if chunked in variable.dims:
            entry["chunks"] = variable.shape
    return encoding
