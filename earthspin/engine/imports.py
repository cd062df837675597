"""Time spent in importing modules, so that the run time of a part can leave it out.

Parts import what they need when they first run, and the first part of a process would be charged
for libraries that all parts share. While a clock runs, import statements are timed; statements
inside an imported module count with the outermost one, in each thread by itself.
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
    """Seconds of imports in this thread, and how deep they are nested."""

    seconds = 0.0
    depth = 0


_CLOCK = _Clock()


def _timed_import(*args: Any, **kwargs: Any) -> Any:
    """Import as Python does, and add the time of the outermost statement."""
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
    """Time the imports of this thread; `seconds` of the clock grows with each."""
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
