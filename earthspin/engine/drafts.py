"""Atomic writes: a result is written to a temporary draft, which then replaces the target file.

A reader always finds the complete old file or the complete new file, even if the writer is ended by
an exception, a kill or a power failure. When `replacing` returns, the new file is on the disk, if
the disk honours the request to store it. Processes that write to the same target do not disturb
one another, also in different containers, or on different machines if the network folder supports
locks; the last one to finish wins.

A file is replaced in one step. A folder (a Zarr store) is replaced in one step if the system can
exchange two folders, as Linux and macOS can on their own file systems. Otherwise there are two
steps: the old folder is moved aside, then the new folder is moved to the target. A reader between
the two steps waits for the second one. If the writer is killed between them, the next process that
opens or writes the target restores the old folder.
"""

from __future__ import annotations

import ctypes
import errno
import glob
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from filelock import FileLock, Timeout

from earthspin.errors import EarthspinError, OutputError, in_bytes, one_line

#: Names in the hidden folder of a draft: the lock of its owner, and the old target.
_LOCK, _OLD = "owner", "old"
#: Age by the clock of the disk after which a draft without a lock has no owner, s. A new draft has
#: no lock for a moment.
_GRACE = 60.0
#: Time between two checks of a folder that is being replaced, s, and the number of checks.
_WAIT, _WAITS = 0.01, 500


def as_path(path: object) -> Path:
    """Convert a str or Path to a Path.

    Raises
    ------
    TypeError
        If `path` is of another type.
    OutputError
        If no file can have this name.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path is of type {type(path).__name__}; give a str or a Path")
    path = Path(path)
    with suppress(UnicodeEncodeError):
        if b"\0" not in os.fsencode(path):
            return path
    raise OutputError(path, "no file can have such a name")


def check_writable(folder: str | Path) -> Path:
    """Raise an error if a folder cannot be written to or created; else return its path.

    Raises
    ------
    OutputError
        If the folder cannot be written to or created.
    """
    path = as_path(folder)
    try:
        existing = next(p for p in (path.absolute(), *path.absolute().parents) if p.exists())
        with tempfile.TemporaryFile(dir=existing):
            pass
    except (OSError, ValueError) as error:
        problem = f"the folder cannot be written to: {one_line(error)}"
        raise OutputError(path, problem, "choose another with --out") from None
    return path


def refuse_what_does_not_fit(path: Path, size: float, what: str) -> None:
    """Raise an error if a result is too large for the free space on the disk.

    Parameters
    ----------
    path : Path
        Path of the result.
    size : float
        Size before compression, bytes.
    what : str
        Name of the result, for the message.

    Raises
    ------
    OutputError
    """
    existing = next(p for p in path.absolute().parents if p.exists())
    free = shutil.disk_usage(existing).free
    if size > free:
        problem = f"{what} take {in_bytes(size)}, but only {in_bytes(free)} of the disk are free"
        raise OutputError(path, problem, "choose a longer step, a shorter span or fewer members")


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """Yield a temporary path for a result; if no error occurs, move the result to `path`.

    Parameters
    ----------
    path : str or Path
        A file, or a folder that holds a Zarr store. If `path` is a link, its target is replaced.

    Yields
    ------
    Path
        Path of the draft, which has the same name.

    Raises
    ------
    OutputError
        If the target cannot be written; it is then not changed.
    """
    target = prepared(path)
    remedy = "the existing file is not changed" if target.exists() else ""
    with output_errors(path, remedy), box_of(target) as box:
        yield box / target.name
        put_in_place(box / target.name, target, box)


def prepared(path: str | Path) -> Path:
    """Resolve links in the path of a file to be written, and create its parent folder.

    Raises
    ------
    OutputError
        If the folder cannot be written, or the target is a folder that is not a Zarr store.
    """
    check_writable(as_path(path).parent)
    with output_errors(path):
        target = Path(path).resolve()
        zarr = (target / ".zgroup").exists() or (target / "zarr.json").exists()
        if target.is_dir() and not zarr:
            raise OutputError(path, "it is a folder, but not a Zarr store", "move it away")
        target.parent.mkdir(parents=True, exist_ok=True)
        return target


@contextmanager
def output_errors(path: str | Path, remedy: str = "") -> Iterator[None]:
    """Convert errors of the operating system to a one-line `OutputError`; a context manager.

    Raises
    ------
    OutputError
    """
    try:
        yield
    except EarthspinError:
        raise
    except (OSError, UnicodeEncodeError) as error:
        raise OutputError(path, f"it cannot be written: {one_line(error)}", remedy) from None


# --- drafts and their owners ---------------------------------------------------------------------


@contextmanager
def box_of(target: Path) -> Iterator[Path]:
    """Yield a new locked hidden folder for a temporary draft, next to the target file.

    Abandoned drafts are removed first.
    """
    box = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".draft", dir=target.parent))
    lock = FileLock(box / _LOCK)
    with suppress(OSError, NotImplementedError):  # without locks, abandoned drafts stay
        lock.acquire()
    try:
        _clear_abandoned_drafts(target, box)
        yield box
    finally:
        _remove(box, target)
        lock.release()


def put_back(path: str | Path) -> None:
    """Restore a folder if a process was killed while it was replacing the folder.

    Parameters
    ----------
    path : str or Path
        Path of the folder; if it exists, nothing is done. If the writer still runs, this function
        waits for the new folder.
    """
    with suppress(OSError):
        target = Path(path).resolve()
        for _ in range(_WAITS):
            if target.exists() or not any((box / _OLD).exists() for box in _boxes(target)):
                break
            _clear_abandoned_drafts(target)
            time.sleep(_WAIT)


def identity(path: Path) -> tuple[int, int, int] | None:
    """Device, inode and modification time, which identify a file; None if it does not exist."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_dev, status.st_ino, status.st_mtime_ns


def check_identity(path: Path, opened: tuple[int, int, int] | None) -> None:
    """Raise an error if a file or folder was replaced since it was opened.

    Raises
    ------
    OutputError
    """
    if identity(path) != opened:
        raise OutputError(path, "it was replaced while it was read", "open it again")


def _clear_abandoned_drafts(target: Path, own: Path | None = None) -> None:
    """Remove the drafts of processes that have ended, and restore a target left in such a draft."""
    for box in _boxes(target):
        if box != own and _is_abandoned(box, own):
            _remove(box, target)


def _remove(box: Path, target: Path) -> None:
    """Remove the hidden folder of a draft; if the target is missing, restore its old version."""
    if (box / _OLD).exists() and not target.exists():
        os.replace(box / _OLD, target)
    shutil.rmtree(box, ignore_errors=True)


def _boxes(target: Path) -> Iterator[Path]:
    return target.parent.glob(f".{glob.escape(target.name)}.*.draft")


def _is_abandoned(box: Path, own: Path | None) -> bool:
    """Return True if the process that made a draft has ended."""
    with suppress(OSError, NotImplementedError, Timeout):
        if not (box / _LOCK).exists():
            # The owner may be about to lock it. Both times are by the clock of the disk.
            return own is not None and own.stat().st_mtime - box.stat().st_mtime > _GRACE
        with FileLock(box / _LOCK, blocking=False):
            return True
    return False


# --- replacement of the target -------------------------------------------------------------------


def put_in_place(draft: Path, target: Path, box: Path) -> None:
    """Replace the target by the draft, with both safely on the disk.

    If the draft cannot be moved, the end of `box_of` restores the old target.
    """
    sync(draft)
    if not (target.is_dir() and _exchange(draft, target)):
        if target.is_dir():
            os.replace(target, box / _OLD)
        os.replace(draft, target)
    sync_one(target.parent)


def _exchange(draft: Path, target: Path) -> bool:
    """Exchange two folders in one step; return False if the system does not support it."""
    here, swap = -100, 2  # AT_FDCWD; RENAME_EXCHANGE of Linux and RENAME_SWAP of macOS
    names = os.fsencode(draft), os.fsencode(target)
    try:
        library = ctypes.CDLL(None)
        if sys.platform == "darwin":
            return bool(library.renamex_np(*names, swap) == 0)
        return bool(library.renameat2(here, names[0], here, names[1], swap) == 0)
    except (OSError, AttributeError, TypeError):
        return False


def sync(path: Path) -> None:
    """Write a file, or a folder with all its contents, from the cache to the disk."""
    for each in (*path.rglob("*"), path):
        sync_one(each)


def sync_one(path: Path) -> None:
    """Write one file, or the directory entry list of one folder, from the cache to the disk."""
    try:
        file = os.open(path, os.O_RDONLY)
    except OSError:
        return  # a folder on Windows
    try:
        os.fsync(file)
    except OSError as error:
        # Some file systems cannot sync; errors of a full or broken disk must be raised.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.EBADF, errno.EACCES):
            raise
    finally:
        os.close(file)
