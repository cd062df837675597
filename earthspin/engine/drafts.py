"""Whole or not at all: what is written goes into a draft, which then takes its place.

What is promised. Whoever reads a file finds the old one or the new one, never a part of either,
whatever happens to the writer: an exception, a kill, a loss of power. When `replacing` has ended,
the new one is on the disk, as far as the disk keeps what it is told to keep. Two who write to the
same place do not disturb each other, in two processes, two containers, or on two machines whose
network folder has locks; the last to finish stays.

A file is replaced in one step, and so is a folder (a Zarr store) where the system can exchange two
folders, as Linux and macOS can on their own file systems. Elsewhere a folder takes two steps: the
old one is moved aside, and the new one into its place. A reader who comes between waits for the
second step; if the writer is killed there, the next who opens or writes it puts the old one back.
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

#: Names inside the hidden folder of a draft: its owner's lock, and what was moved aside.
_LOCK, _OLD = "owner", "old"
#: A draft without a lock, older than this against the clock of its disk, has no owner, s. Its
#: owner had a moment to make one.
_GRACE = 60.0
#: Time between two looks at a folder that is being replaced, s, and how often is looked.
_MOMENT, _MOMENTS = 0.01, 500


def as_path(path: object) -> Path:
    """Read the path of a file or folder.

    Raises
    ------
    TypeError
        If it is something else.
    OutputError
        If no file can have that name.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path is of type {type(path).__name__}; give a str or a Path")
    path = Path(path)
    with suppress(UnicodeEncodeError):
        if b"\0" not in os.fsencode(path):
            return path
    raise OutputError(path, "no file can have such a name")


def check_writable(folder: str | Path) -> Path:
    """Check that a folder can be written to, or made, before anything is computed for it.

    Raises
    ------
    OutputError
        If it cannot.
    """
    path = as_path(folder)
    try:
        existing = next(p for p in (path.absolute(), *path.absolute().parents) if p.exists())
        with tempfile.TemporaryFile(dir=existing):
            pass
    except (OSError, ValueError) as error:
        words = f"the folder cannot be written to: {one_line(error)}"
        raise OutputError(path, words, "choose another with --out") from None
    return path


def refuse_what_does_not_fit(path: Path, size: float, what: str) -> None:
    """Refuse what the disk has no room for, before it is half-written.

    Parameters
    ----------
    path : Path
        Where it should go.
    size : float
        Bytes, before they are packed.
    what : str
        For the message.

    Raises
    ------
    OutputError
    """
    existing = next(p for p in path.absolute().parents if p.exists())
    free = shutil.disk_usage(existing).free
    if size > free:
        words = f"{what} take {in_bytes(size)}, and {in_bytes(free)} of the disk are free"
        raise OutputError(path, words, "ask for less: a longer step, a shorter span, fewer members")


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """Give a draft beside `path`, and put it in place if all goes well.

    Parameters
    ----------
    path : str or Path
        A file, or a folder that holds a Zarr store. A link stays a link; what it leads to is
        replaced.

    Yields
    ------
    Path
        Where to write; it has the same name.

    Raises
    ------
    OutputError
        If the place cannot be written; it is then as it was.
    """
    target = prepared(path)
    remedy = "what stood there is kept" if target.exists() else ""
    with output_errors(path, remedy), box_of(target) as box:
        yield box / target.name
        put_in_place(box / target.name, target, box)


def prepared(path: str | Path) -> Path:
    """Make the folder in which something is to stand, and give its place, links followed.

    Raises
    ------
    OutputError
        If it cannot be written, or a folder stands there that is none of ours.
    """
    check_writable(as_path(path).parent)
    with output_errors(path):
        target = Path(path).resolve()
        zarr = (target / ".zgroup").exists() or (target / "zarr.json").exists()
        if target.is_dir() and not zarr:
            raise OutputError(path, "a folder stands there that is no Zarr store", "move it away")
        target.parent.mkdir(parents=True, exist_ok=True)
        return target


@contextmanager
def output_errors(path: str | Path, remedy: str = "") -> Iterator[None]:
    """Say in one line what the system says of something that cannot be written.

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


# --- whose a draft is ----------------------------------------------------------------------------


@contextmanager
def box_of(target: Path) -> Iterator[Path]:
    """Make a hidden folder beside the target, locked by its owner; remove those of dead owners."""
    box = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".draft", dir=target.parent))
    lock = FileLock(box / _LOCK)
    with suppress(OSError, NotImplementedError):  # where there are no locks, no draft is cleared
        lock.acquire()
    try:
        _clear_up_after_the_dead(target, box)
        yield box
    finally:
        _remove(box, target)
        lock.release()


def put_back(path: str | Path) -> None:
    """Put back a folder whose writer was killed after he had moved it aside.

    Parameters
    ----------
    path : str or Path
        Where it should be; if something stands there, nothing is done. While its writer lives, the
        new one is waited for.
    """
    with suppress(OSError):
        target = Path(path).resolve()
        for _ in range(_MOMENTS):
            if target.exists() or not any((box / _OLD).exists() for box in _boxes(target)):
                break
            _clear_up_after_the_dead(target)
            time.sleep(_MOMENT)


def identity(path: Path) -> tuple[int, int, int] | None:
    """What tells a file or folder from another that takes its place; None if there is none."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_dev, status.st_ino, status.st_mtime_ns


def check_identity(path: Path, opened: tuple[int, int, int] | None) -> None:
    """Refuse to read on in a file or folder that is not the one that was opened.

    Raises
    ------
    OutputError
    """
    if identity(path) != opened:
        raise OutputError(path, "it was replaced while it was read", "open it again")


def _clear_up_after_the_dead(target: Path, own: Path | None = None) -> None:
    """Remove drafts whose owners are gone; put back a folder that one had moved aside."""
    for box in _boxes(target):
        if box != own and _is_left(box, own):
            _remove(box, target)


def _remove(box: Path, target: Path) -> None:
    """Remove the folder of a draft; what was moved aside goes back if nothing took its place."""
    if (box / _OLD).exists() and not target.exists():
        os.replace(box / _OLD, target)
    shutil.rmtree(box, ignore_errors=True)


def _boxes(target: Path) -> Iterator[Path]:
    return target.parent.glob(f".{glob.escape(target.name)}.*.draft")


def _is_left(box: Path, own: Path | None) -> bool:
    """Whether the owner of a draft has ended."""
    with suppress(OSError, NotImplementedError, Timeout):
        if not (box / _LOCK).exists():
            # Its owner may be about to lock it. Clocks of machines differ, a disk has one.
            return own is not None and own.stat().st_mtime - box.stat().st_mtime > _GRACE
        with FileLock(box / _LOCK, blocking=False):
            return True
    return False


# --- into its place ------------------------------------------------------------------------------


def put_in_place(draft: Path, target: Path, box: Path) -> None:
    """Keep the draft on the disk, then let it take its place, then keep that.

    If it cannot take its place, the end of `box_of` puts back what was moved aside.
    """
    sync(draft)
    if not (target.is_dir() and _exchange(draft, target)):
        if target.is_dir():
            os.replace(target, box / _OLD)
        os.replace(draft, target)
    sync_one(target.parent)


def _exchange(draft: Path, target: Path) -> bool:
    """Let two folders change places in one step; False where the system cannot."""
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
    """Have a file, or a folder with all that is in it, written to the disk."""
    for each in (*path.rglob("*"), path):
        sync_one(each)


def sync_one(path: Path) -> None:
    """Have one file written to the disk, or the names in one folder."""
    try:
        file = os.open(path, os.O_RDONLY)
    except OSError:
        return  # a folder on Windows
    try:
        os.fsync(file)
    except OSError as error:
        # Some file systems cannot; a disk that is full or broken must be told.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.EBADF, errno.EACCES):
            raise
    finally:
        os.close(file)
