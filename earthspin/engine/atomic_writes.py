"""Atomic writes: a result is written to a draft (temporary path), which replaces the target.

The draft is in a hidden folder next to the target, ``.<name>.draft``, together with a lock. A
second writer of the same target is refused while the first one runs. The system releases the lock
when its owner ends, and the next writer removes the draft of a killed one.

A file is replaced in one step, so a reader finds the complete old file or the complete new one. A
folder (a Zarr store) is replaced in two steps: the old folder is moved into the hidden folder, then
the draft is moved to the target. If the writer is killed between them, the next writer restores the
old folder. Nothing is flushed to the disk: that is left to the system.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from filelock import FileLock, Timeout

from earthspin.errors import EarthspinError, OutputError, in_bytes, no_plain_file, one_line

#: Names in the folder of a draft: the lock of its owner, and the old target.
LOCK, _OLD = "owner", "old"


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
        existing = next(p for p in (path.absolute(), *path.absolute().parents) if _exists(p))
        with tempfile.TemporaryFile(dir=existing):
            pass
    except (OSError, ValueError) as error:
        problem = f"the folder cannot be written to: {one_line(error)}"
        raise OutputError(path, problem, "choose another with --out") from None
    return path


def _exists(path: Path) -> bool:
    """Return True if a path exists; unlike `Path.exists`, raise an error for a loop of links."""
    with suppress(FileNotFoundError, NotADirectoryError):
        path.stat()
        return True
    return False


def refuse_what_does_not_fit(path: Path, size: float, what: str) -> None:
    """Raise an error if a result is larger than the free space on the disk.

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
        If the target cannot be written, or another process writes it; it is then not changed.
    """
    target = prepared(path)
    remedy = "the existing file is not changed" if target.exists() else ""
    box = target.with_name(f".{target.name}.draft")
    with output_errors(path, remedy), claimed(box, target):
        for stale in (entry for entry in box.iterdir() if entry.name != LOCK):
            remove(stale)
        try:
            # A thread that still writes the draft of an earlier error does not touch this one.
            draft = Path(tempfile.mkdtemp(dir=box)) / target.name
            yield draft
            put_in_place(draft, target, box)
        finally:
            remove(box)


def prepared(path: str | Path) -> Path:
    """Check that a result can be written to a path, and return the path with links resolved.

    Raises
    ------
    OutputError
        If the folder cannot be written, or the target is a device, a pipe, or a folder that is not
        a Zarr store.
    """
    check_writable(as_path(path).parent)
    with output_errors(path):
        _exists(Path(path))
        target = Path(path).resolve()
        zarr = (target / ".zgroup").exists() or (target / "zarr.json").exists()
        if target.is_dir() and not zarr:
            raise OutputError(path, "it is a folder, but not a Zarr store", "move it away")
        if not target.is_dir() and (problem := no_plain_file(target)):
            raise OutputError(path, problem, "choose another name")
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


@contextmanager
def claimed(box: Path, target: Path) -> Iterator[None]:
    """Create and lock the folder in which a result is drafted; a context manager.

    On a file system without locks, two writers are not detected. Folders that are created for it
    are removed at the end if they are empty.

    Parameters
    ----------
    box, target : Path
        Folder of the draft, and the file or folder that the draft will replace.

    Raises
    ------
    OutputError
        If another process has locked the folder.
    """
    lock, created = FileLock(box / LOCK, blocking=False), [p for p in box.parents if not p.exists()]
    try:
        box.mkdir(parents=True, exist_ok=True)
        try:
            lock.acquire()
        except Timeout:
            remedy = "wait for that run, or stop it"
            raise OutputError(target, "another run is writing it", remedy) from None
        except (OSError, NotImplementedError):
            pass
        _restore(box, target)
        yield
    finally:
        lock.release()
        with suppress(OSError):
            for folder in created:
                folder.rmdir()


def put_in_place(draft: Path, target: Path, box: Path) -> None:
    """Move a complete draft to the target path; if this fails, the old target is restored.

    Parameters
    ----------
    draft, target : Path
    box : Path
        Folder into which an old Zarr store is moved.
    """
    try:
        if target.is_dir():
            remove(box / _OLD)
            os.replace(target, box / _OLD)
        os.replace(draft, target)
    finally:
        _restore(box, target)


def _restore(box: Path, target: Path) -> None:
    """Move the old store back to the target path, if nothing is there."""
    if (box / _OLD).exists() and not target.exists():
        os.replace(box / _OLD, target)


def remove(path: Path) -> None:
    """Remove a file, or a folder with its contents."""
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


def identity(path: Path) -> tuple[int, int, int] | None:
    """Device, inode and modification time (ns), which identify a file; None if there is no file."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_dev, status.st_ino, status.st_mtime_ns


def check_identity(path: Path, opened: tuple[int, int, int] | None) -> None:
    """Raise an error if a file or folder was replaced after it was opened.

    Raises
    ------
    OutputError
    """
    if identity(path) != opened:
        raise OutputError(path, "it was replaced while it was read", "open it again")


def mismatch_error(path: Path, what: str) -> OutputError:
    """Make the error for a file that does not match its checksum."""
    remedy = "if they were changed on purpose, read the file with xarray.open_dataset"
    return OutputError(path, f"{what} do not match the stored checksum", remedy)
