"""Measure the time spent in importing modules, to exclude it from measured run times.

Parts import modules when they first run, so the first part of a process would include the import
of libraries that all parts share. While a clock runs, import statements are timed. Statements
inside an imported module count with the outermost one, separately in each thread.
"""

from __future__ import annotations

import builtins
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_LOCK = threading.Lock()
_users = 0
_import = builtins.__import__


class _Clock(threading.local):
    """Total time spent in imports by this thread, s, and the depth of nested imports."""

    seconds = 0.0
    depth = 0


_CLOCK = _Clock()


def _timed_import(*args: Any, **kwargs: Any) -> Any:
    """Import a module as Python does, and add the time of an outermost import to the clock."""
    _CLOCK.depth += 1
    begun = time.perf_counter()
    try:
        return _import(*args, **kwargs)
    finally:
        _CLOCK.depth -= 1
        if not _CLOCK.depth:
            _CLOCK.seconds += time.perf_counter() - begun


@contextmanager
def import_clock() -> Iterator[_Clock]:
    """Time the imports of this thread; yield the clock, whose `seconds` is their total time."""
    global _users, _import
    with _LOCK:
        if not _users:
            _import, builtins.__import__ = builtins.__import__, _timed_import
        _users += 1
    try:
        yield _CLOCK
    finally:
        with _LOCK:
            _users -= 1
            if not _users:
                builtins.__import__ = _import
