"""Whole or not at all: what is written goes into a draft, which then takes its place in one step.

What is promised. Whoever reads a file finds the old one or the new one, never a part of either,
whatever happens to the writer: an exception, a kill, a loss of power. When `replacing` has ended,
the new one is on the disk, as far as the disk keeps what it is told to keep. Two who write to the
same place do not disturb each other, in two processes, two containers, or on two machines whose
network folder has locks; the last to finish stays.

A folder (a Zarr store) is exchanged in one step as well where the system can do that, which Linux
and macOS can on their own file systems. Elsewhere it is moved aside first: it is absent for a
moment, and if the writer is killed in that moment, the next who opens or writes it puts it back.
"""

from __future__ import annotations

import ctypes
import errno
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from earthspin.errors import EarthspinError, OutputError, in_bytes, one_line

if sys.platform != "win32":
    import fcntl

#: Names inside the hidden folder of a draft: its owner's lock, and what was moved aside.
_LOCK, _OLD = "owner", "old"
#: A draft without a lock, older than this against the clock of its disk, has no owner, s. Its
#: owner had a moment to make one.
_GRACE = 60.0


def as_path(given: object) -> Path:
    """Read the path of a file or folder.

    Raises
    ------
    TypeError
        If it is something else.
    OutputError
        If no file can have that name.
    """
    if not isinstance(given, (str, os.PathLike)):
        raise TypeError(f"path is of type {type(given).__name__}; give a str or a Path")
    path = Path(given)
    try:
        if b"\0" not in os.fsencode(path):
            return path
    except UnicodeEncodeError:
        pass
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
        there = next(p for p in (path.absolute(), *path.absolute().parents) if p.exists())
        with tempfile.TemporaryFile(dir=there):
            pass
    except (OSError, ValueError) as error:
        raise OutputError(
            path,
            f"the folder cannot be written to: {one_line(error)}",
            "choose another with --out",
        ) from None
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
    there = next(p for p in path.absolute().parents if p.exists())
    free = shutil.disk_usage(there).free
    if size > free:
        raise OutputError(
            path,
            f"{what} take {in_bytes(size)}, and {in_bytes(free)} of the disk are free",
            "ask for less: a longer step, a shorter span, fewer members",
        )


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
    target = made_ready(path)
    remedy = "what stood there is kept" if target.exists() else ""
    with told_as_output_error(path, remedy), box_of(target) as box:
        clear_up_after_the_dead(target, box)
        draft = box / target.name
        yield draft
        put_in_place(draft, target, box)


def made_ready(path: str | Path) -> Path:
    """Make the folder in which something is to stand, and give its place, links followed.

    Raises
    ------
    OutputError
        If it cannot be written, or a folder stands there that is none of ours.
    """
    check_writable(as_path(path).parent)
    with told_as_output_error(path):
        target = Path(path).resolve()
        if target.is_dir() and not _is_zarr(target):
            raise OutputError(path, "a folder stands there that is no Zarr store", "move it away")
        target.parent.mkdir(parents=True, exist_ok=True)
        return target


@contextmanager
def told_as_output_error(path: str | Path, remedy: str = "") -> Iterator[None]:
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


def _is_zarr(folder: Path) -> bool:
    return (folder / ".zgroup").exists() or (folder / "zarr.json").exists()


# --- whose a draft is ----------------------------------------------------------------------------


@contextmanager
def box_of(target: Path) -> Iterator[Path]:
    """Hidden folder beside the target, locked by its owner as long as he lives."""
    box = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".draft", dir=target.parent))
    lock = os.open(box / _LOCK, os.O_CREAT | os.O_RDWR, 0o600)
    try:
        take_lock(lock)
        yield box
    finally:
        shutil.rmtree(box, ignore_errors=True)
        os.close(lock)


def take_lock(file: int) -> bool:
    """Take the lock of an open file, which the system gives back when its owner ends.

    Process ids would say nothing: each container counts its own. On Windows there is no such lock,
    and nobody's draft is cleared but one's own.
    """
    if sys.platform == "win32":
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def put_back(path: str | Path) -> None:
    """Put back a folder whose writer was killed after he had moved it aside.

    Parameters
    ----------
    path : str or Path
        Where it should be; if something stands there, nothing is done.
    """
    target = Path(path)
    with suppress(OSError):
        if not target.exists():
            clear_up_after_the_dead(target.resolve(), None)


def clear_up_after_the_dead(target: Path, own: Path | None) -> None:
    """Remove drafts whose owners are gone; put back a folder that one had moved aside."""
    for box in target.parent.glob(f".{_literal(target.name)}.*.draft"):
        if box == own or not _is_left(box, own):
            continue
        if (box / _OLD).exists() and not target.exists():
            os.replace(box / _OLD, target)
        shutil.rmtree(box, ignore_errors=True)


def _literal(name: str) -> str:
    """A name for `glob`, which means itself."""
    return "".join(f"[{c}]" if c in "*?[" else c for c in name)


def _is_left(box: Path, own: Path | None) -> bool:
    """Whether the owner of a draft has ended."""
    try:
        lock = os.open(box / _LOCK, os.O_RDWR)
    except FileNotFoundError:
        # Its owner may be about to lock it. Clocks of machines differ, a disk has one.
        with suppress(OSError):
            return own is not None and own.stat().st_mtime - box.stat().st_mtime > _GRACE
        return False
    except OSError:
        return False
    try:
        return take_lock(lock)
    finally:
        os.close(lock)


# --- into its place ------------------------------------------------------------------------------


def put_in_place(draft: Path, target: Path, box: Path) -> None:
    """Keep the draft on the disk, then let it take its place, then keep that."""
    sync(draft)
    if not target.is_dir():
        os.replace(draft, target)
    elif not _exchange(draft, target):
        aside = box / _OLD
        os.replace(target, aside)
        try:
            os.replace(draft, target)
        except BaseException:
            os.replace(aside, target)
            raise
    sync_one(target.parent)


def sync(path: Path) -> None:
    """Have a file, or a folder with all that is in it, written to the disk."""
    for folder, _, files in os.walk(path):
        for name in files:
            sync_one(Path(folder, name))
        sync_one(Path(folder))
    if not path.is_dir():
        sync_one(path)


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


def _exchange(one: Path, other: Path) -> bool:
    """Let two folders change places in one step; False where the system cannot."""
    here, swap = -100, 2  # AT_FDCWD; RENAME_EXCHANGE of Linux and RENAME_SWAP of macOS
    names = os.fsencode(one), os.fsencode(other)
    try:
        library = ctypes.CDLL(None, use_errno=True)
        if sys.platform == "darwin":
            return bool(library.renamex_np(*names, swap) == 0)
        return bool(library.renameat2(here, names[0], here, names[1], swap) == 0)
    except (OSError, AttributeError, TypeError):
        return False
