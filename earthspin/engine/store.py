"""Results on disk: netCDF, or Zarr by region, whole or not at all.

A result is written beside its place and moved there when it is complete; whoever is
interrupted finds the old file as it was.
"""

from __future__ import annotations

import datetime as dt
import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from earthspin.engine.labels import IN_FILES
from earthspin.errors import EarthspinError, MissingExtraError, OutputError

if TYPE_CHECKING:
    import xarray as xr

#: Integer microseconds from a recent date hold every epoch of every kernel exactly.
TIME_ENCODING = {
    "units": "microseconds since 2000-01-01T12:00:00",
    "dtype": "int64",
    "calendar": "proleptic_gregorian",
}


def write(result: xr.Dataset | xr.DataTree, path: str | Path) -> Path:
    """Write an answer, alone or with its sections, to a file.

    Parameters
    ----------
    result : Dataset or DataTree
    path : str or Path
        Ends in ``.nc`` or ``.zarr``.

    Returns
    -------
    Path

    Raises
    ------
    OutputError
        If the place cannot be written, or its name has another ending.
    MissingExtraError
        If zarr is asked for and not installed.
    """
    if not hasattr(result, "attrs"):
        raise OutputError(
            path, f"{type(result).__name__} is no answer", "give a Dataset or DataTree"
        )
    if Path(path).suffix == ".zarr":
        return _write_zarr(result, path)
    _refuse_other_endings(Path(path))  # by its own name, not the draft's
    with replacing(path) as draft:
        write_netcdf(result, draft)
    return Path(path)


def write_netcdf(result: xr.Dataset | xr.DataTree, path: Path) -> None:
    """Write an answer straight to a netCDF file; `write` does so whole or not at all.

    Raises
    ------
    OutputError
        If the name does not end in ``.nc``.
    """
    _refuse_other_endings(path)
    for number, (group, node) in enumerate(_groups(result).items()):
        node.to_netcdf(
            path,
            mode="a" if number else "w",
            group=group,
            engine="netcdf4",
            encoding=_encoding(node, characters=True),
        )


def _groups(result: xr.Dataset | xr.DataTree) -> dict[str | None, xr.Dataset]:
    """The answer, with the date in its history, and its sections by the group of each in a file."""
    groups: dict[str | None, xr.Dataset] = {None: _answer_of(result)}
    for path, node in getattr(result, "subtree_with_keys", ()):
        if path != ".":
            groups[path] = node.to_dataset(inherit=False)
    groups = {group: _spelled(node) for group, node in groups.items()}
    history = groups[None].attrs.get("history")
    if history is not None:
        stamp = dt.datetime.now(dt.UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
        groups[None] = groups[None].assign_attrs(history=f"{stamp} {history}")
    return groups


#: Attributes of a variable in a file: the units, and how people read them.
UNITS, SHOWN = "units", "units_shown"


def _spelled(node: xr.Dataset) -> xr.Dataset:
    """A copy whose units are spelled for files, the word for people kept beside."""
    node = node.copy()
    for name, variable in node.variables.items():
        word = variable.attrs.get(UNITS)
        if word in IN_FILES:
            node[name].attrs = variable.attrs | {UNITS: IN_FILES[word], SHOWN: word}
    return node


def _as_shown(node: xr.Dataset) -> xr.Dataset:
    """Units as people read them, where a file of ours has both spellings."""
    for variable in node.variables.values():
        if SHOWN in variable.attrs:
            variable.attrs[UNITS] = variable.attrs.pop(SHOWN)
    return node


def _answer_of(result: xr.Dataset | xr.DataTree) -> xr.Dataset:
    import xarray as xr

    return result.to_dataset() if isinstance(result, xr.DataTree) else result


def _write_zarr(result: xr.Dataset | xr.DataTree, path: str | Path) -> Path:
    """Write an answer with its sections to Zarr, a group for each node."""
    zarr = _zarr()
    with replacing(path) as draft, zarr.config.set({"threading.max_workers": 1}):
        for group, node in _groups(result).items():
            node.to_zarr(
                str(draft),
                mode="w" if group is None else "a",
                group=group,
                consolidated=False,
                zarr_format=2,  # version 3 has no settled way to keep words
                encoding=_encoding(node),
            )
    return Path(path)


def _refuse_other_endings(path: Path) -> None:
    if path.suffix != ".nc":
        raise OutputError(path, "it ends in neither .nc nor .zarr", "choose one of the two")


def _zarr() -> Any:
    try:
        import zarr
    except ImportError:
        raise MissingExtraError("zarr", "zarr", "a result in chunks") from None
    return zarr


def write_blocks(blocks: Iterable[xr.Dataset], path: str | Path) -> Path:
    """Write a long result to Zarr block after block, holding one block at a time.

    Parameters
    ----------
    blocks : iterable of Dataset
        Consecutive along `time`, all of one size but the last, which becomes the chunk.
    path : str or Path
        A folder; one that is there is replaced when all is written.

    Raises
    ------
    OutputError
        If the place cannot be written.
    MissingExtraError
        If zarr is not installed.
    """
    if Path(path).suffix != ".zarr":
        raise OutputError(
            path, "its name does not end in .zarr", "a long series goes to Zarr alone"
        )
    zarr = _zarr()
    # Each thread of zarr's would keep the memory of the largest chunk that it has ever packed.
    with replacing(path) as draft, zarr.config.set({"threading.max_workers": 1}):
        for number, block in enumerate(blocks):
            if number == 0:
                _groups(block)[None].to_zarr(
                    draft,
                    mode="w",
                    consolidated=False,
                    zarr_format=2,  # version 3 has no settled way to keep words
                    encoding=_encoding(block, chunked=True),
                )
            else:
                grows = block.drop_vars([n for n in block.variables if "time" not in block[n].dims])
                grows.to_zarr(draft, append_dim="time", consolidated=False)
    return Path(path)


def open(path: str | Path) -> xr.Dataset | xr.DataTree:
    """Read what was written back as it was: an answer, or an answer with its sections.

    Parameters
    ----------
    path : str or Path
        NetCDF is read whole, Zarr as it is used.

    Returns
    -------
    Dataset or DataTree
        Times as ``datetime64[us]``.

    Raises
    ------
    OutputError
        If it is no result, or was cut short.
    """
    import xarray as xr

    import earthspin.accessor  # noqa: F401 - registers ds.earthspin

    zarr = Path(path).suffix == ".zarr"
    options: dict[str, Any] = (
        {"engine": "zarr", "consolidated": False} if zarr else {"engine": "netcdf4"}
    )
    coder = xr.coders.CFDatetimeCoder(time_unit="us")
    try:
        nodes = xr.open_groups(path, decode_times=coder, **options)
        if not zarr:
            nodes = {name: _loaded(node) for name, node in nodes.items()}
    except (OSError, ValueError, KeyError) as error:
        raise OutputError(path, f"it cannot be read: {_one_line(error)}") from None
    nodes = {name: _as_shown(node) for name, node in nodes.items()}
    root = nodes["/"]
    if "history" in root.attrs:  # the date belongs to the file
        nodes["/"] = root.assign_attrs(history=_STAMP.sub("", root.attrs["history"]))
    return nodes["/"] if len(nodes) == 1 else xr.DataTree.from_dict(nodes)


def _loaded(node: xr.Dataset) -> xr.Dataset:
    """Read a node whole and close its file."""
    with node:
        return node.load()


#: Date that a file's history begins with.
_STAMP = re.compile(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ ")

#: The same by its older name.
read = open


def check_writable(folder: str | Path) -> Path:
    """Check that a folder can be written to, or made, before anything is computed for it.

    Raises
    ------
    OutputError
        If it cannot.
    """
    path = Path(folder)
    try:
        there = next(p for p in (path.absolute(), *path.absolute().parents) if p.exists())
        with tempfile.TemporaryFile(dir=there):
            pass
    except OSError as error:
        raise OutputError(
            path, f"the folder cannot be written to: {error.strerror}", "choose another with --out"
        ) from None
    return path


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """Give a draft beside `path`, and put it in place if all goes well.

    Raises
    ------
    OutputError
        If the place cannot be written; it is then as it was.
    """
    target = Path(path)
    check_writable(target.parent)
    target = target.resolve()  # a link stays a link, what it leads to is replaced
    if target.is_dir() and not _is_zarr(target):
        raise OutputError(path, "a folder stands there that is no Zarr store", "move it away")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        _clear_up_after_the_dead(target)
        box = Path(tempfile.mkdtemp(prefix=f".{target.name}.{os.getpid()}.", dir=target.parent))
        try:
            draft = box / target.name
            yield draft
            _put_in_place(draft, target, box)
        finally:
            shutil.rmtree(box, ignore_errors=True)
    except OSError as error:
        if isinstance(error, EarthspinError):
            raise
        raise OutputError(path, f"it cannot be written: {_one_line(error)}") from None


def _is_zarr(folder: Path) -> bool:
    return (folder / ".zgroup").exists() or (folder / "zarr.json").exists()


def _put_in_place(draft: Path, target: Path, box: Path) -> None:
    if not target.is_dir():
        os.replace(draft, target)
        return
    aside = box / "old"
    os.replace(target, aside)  # a folder is not replaced in one step, but moved aside
    try:
        os.replace(draft, target)
    except BaseException:
        os.replace(aside, target)
        raise


def _clear_up_after_the_dead(target: Path) -> None:
    """Remove drafts of processes that were killed; put back a folder that one had moved aside."""
    for box in target.parent.glob(f".{target.name}.*"):
        owner = box.name.removeprefix(f".{target.name}.").split(".")[0]
        if not owner.isdigit() or _is_alive(int(owner)):
            continue
        if (box / "old").exists() and not target.exists():
            os.replace(box / "old", target)
        shutil.rmtree(box, ignore_errors=True)


def _is_alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def _encoding(
    result: xr.Dataset, *, chunked: bool = False, characters: bool = False
) -> dict[str, dict[str, Any]]:
    """How variables are laid down: chunks for Zarr, words along a dimension for netCDF.

    A coordinate variable is a number to the CF conventions; words along a dimension stand as rows
    of characters, which xarray reads as the labels that they were.
    """
    encoding: dict[str, dict[str, Any]] = {}
    for name, variable in result.variables.items():
        entry: dict[str, Any] = {}
        if variable.dtype.kind == "M":
            entry |= TIME_ENCODING
        if characters and variable.dims == (name,) and variable.dtype.kind in "UO":
            entry["dtype"] = "S1"
        if chunked and "time" in variable.dims:
            entry["chunks"] = variable.shape
        if variable.dtype.kind == "f":
            entry["_FillValue"] = None  # nothing is ever missing
        if entry:
            encoding[str(name)] = entry
    return encoding


def _one_line(error: BaseException) -> str:
    return " ".join(str(getattr(error, "strerror", None) or error).split())
