"""Streams, signals and exit status of the command-line process.

Everything that can go wrong in a command ends here in one line on stderr and an exit status; a
warning is told when the command has succeeded, never before a message.
"""

from __future__ import annotations

import errno
import logging
import os
import signal
import sys
import threading
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from pathlib import Path
from types import FrameType

from earthspin.errors import EarthspinError, one_line, printable

USAGE_ERROR = 2
#: A defect of the program (EX_SOFTWARE of sysexits), and a reader who has gone.
DEFECT, READER_GONE = 70, 141

#: Beginning of a note to an error that is shown after its line; libraries add notes of their own.
RESULTS = "the results are stored in"

#: Set to anything but nothing or 0, it asks for the traceback of whatever goes wrong.
TRACEBACK = "EARTHSPIN_TRACEBACK"

#: What ends a program politely; each leaves it time to clear up as an interrupt does.
_SIGNALS = [getattr(signal, n) for n in ("SIGTERM", "SIGHUP") if hasattr(signal, n)]


#: Time at which this module, among the first of the package, was loaded.
_LOADED = time.monotonic()


def seconds_since_start() -> float:
    """Wall time since this process began, s; not on Linux, since it loaded earthspin."""
    try:
        fields = Path("/proc/self/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        begun = int(fields[19]) / os.sysconf("SC_CLK_TCK")
        return time.clock_gettime(time.CLOCK_BOOTTIME) - begun
    except (OSError, AttributeError):  # not Linux
        return time.monotonic() - _LOADED


def run_command(command: Callable[[], None], *, show_traceback: bool = False) -> int:
    """Run a command and turn every exception into an exit status.

    Parameters
    ----------
    command : callable
    show_traceback : bool
        Whether to show where an error arose, after its line.

    Returns
    -------
    int
        The exit status: 0; 2 if something given is wrong, or the output cannot
        be written; 70 for a defect of the program; 130 if interrupted, 143 if terminated, 129 if
        the terminal is gone; 141 if whoever read the output has gone.
    """
    with warnings.catch_warnings(record=True) as recorded:
        status = _status(command, show_traceback)
    for warning in recorded if status == 0 else ():
        _say(" ".join(str(warning.message).split()))
    return status


def _status(command: Callable[[], None], show_traceback: bool) -> int:
    """Run a command, print the message of an exception, and return the exit status."""
    try:
        _check_streams()
        logging.getLogger("matplotlib").setLevel(logging.ERROR)  # its own affairs
        with _signals_as_interrupts():
            command()
            sys.stdout.flush()
    except KeyboardInterrupt as interrupt:
        number = interrupt.args[0] if interrupt.args else signal.SIGINT
        how = f"ended by {signal.Signals(number).name}" if interrupt.args else "interrupted"
        kept = "; ".join(getattr(interrupt, "__notes__", ())) or "nothing was left half-written"
        _say(f"{how}; {kept}")
        return 128 + int(number)
    except BrokenPipeError:
        _drop_output()  # the interpreter must not try to flush it again
        return READER_GONE
    except Exception as error:
        status, words = _outcome(error)
        notes = (note for note in getattr(error, "__notes__", ()) if note.startswith(RESULTS))
        _say("; ".join([words, *notes]))
        if show_traceback or os.environ.get(TRACEBACK, "0") not in ("", "0"):
            _print("".join(traceback.format_exception(error)).rstrip())
        return status
    return 0


def _outcome(error: Exception) -> tuple[int, str]:
    """Return the exit status for an error, and the message to print."""
    if isinstance(error, EarthspinError):
        return USAGE_ERROR, str(error)
    if isinstance(error, MemoryError) or getattr(error, "errno", None) == errno.ENOMEM:
        return USAGE_ERROR, "there is not enough memory; ask for less at once, or see ulimit -v"
    if isinstance(error, ImportError) and not (error.name or "").startswith("earthspin"):
        cause = one_line(error.__cause__ or error)
        words = "install it again, or allow it more memory (ulimit -v)"
        return USAGE_ERROR, str(EarthspinError(f"a library cannot be loaded: {cause}; {words}"))
    if isinstance(error, OSError):
        _drop_output()
        return USAGE_ERROR, f"the output cannot be written: {one_line(error)}"
    words = str(EarthspinError(f"{type(error).__name__}: {error}"))
    return DEFECT, (
        f"a defect of earthspin, not of the input: {words}; please report it, with the "
        "command, to its maintainers; --traceback shows where it arose"
    )


def _say(words: str) -> None:
    _print(f"earthspin: {printable(words)}")


def _print(words: str) -> None:
    """Print a line on stderr; ignore the failure if stderr cannot be written."""
    with suppress(OSError, ValueError, AttributeError):
        print(words, file=sys.stderr or None, flush=True)


def _drop_output() -> None:
    """Discard output that is not yet written to stdout."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _check_streams() -> None:
    """Replace missing standard streams, and escape characters that a stream cannot encode.

    A stream that is closed leaves its number to the next file that is opened, which what is
    printed would then be written into. In place of stdout stands one that cannot be written to.
    """
    for number, mode in enumerate((os.O_WRONLY, os.O_RDONLY, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, mode)  # the lowest number that is free: this one
    sys.stdout = sys.stdout or os.fdopen(1, "w", encoding="utf-8", closefd=False)
    sys.stderr = sys.stderr or os.fdopen(2, "w", encoding="utf-8", closefd=False)
    for stream in (sys.stdout, sys.stderr):
        if stream in (sys.__stdout__, sys.__stderr__) and isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


@contextmanager
def signals_held() -> Iterator[None]:
    """Hold all signals that have a handler until the block ends; a context manager.

    A handler that raises an exception, such as KeyboardInterrupt, may strike inside a lock of
    xarray, which stays locked, so that closing a netCDF file would wait for ever. Handlers run in
    the main thread only.
    """
    received: list[int] = []
    numbers = (
        signal.valid_signals() if threading.current_thread() is threading.main_thread() else ()
    )
    handlers = {number: h for number in numbers if callable(h := signal.getsignal(number))}
    try:
        for number in handlers:
            signal.signal(number, lambda number, _: received.append(number))
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for held in received:
            signal.raise_signal(held)


@contextmanager
def _signals_as_interrupts() -> Iterator[None]:
    """Turn termination signals into KeyboardInterrupt, so that temporary files are removed."""

    def end(number: int, frame: FrameType | None) -> None:
        signal.signal(number, signal.SIG_DFL)  # the second one ends it at once
        raise KeyboardInterrupt(number)

    before = [n for n in _SIGNALS if signal.getsignal(n) is signal.SIG_DFL]  # not under nohup
    try:
        with suppress(ValueError):  # in another thread than the main one
            for number in before:
                signal.signal(number, end)
        yield
    finally:
        with suppress(ValueError):
            for number in before:
                signal.signal(number, signal.SIG_DFL)
