"""Progress bar on the terminal, for work that takes more than two seconds.

Programs that watch get lines of JSON instead: how much is done, of how much, how much a second, and
the seconds left.
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock, Timer
from typing import Any, Protocol, TextIO

PATIENCE = 2.0  # seconds before a bar appears
#: Seconds between two lines for programs.
EVERY = 1.0

#: Held by whoever shows a bar: of work within work, only the outer is shown.
_watching = Lock()
#: Bars: when each began, and functions that hide it while a bar within it is shown, and show it
#: again.
_outer: list[tuple[float, Callable[[], None], Callable[[], None]]] = []
#: Where lines for programs go; none where a person watches.
_lines: list[TextIO] = []


class Advance(Protocol):
    """Protocol of the function that advances a progress bar by an amount of work."""

    def __call__(self, amount: int) -> None:
        """Advance the progress bar by an amount of finished work."""


@contextmanager
def progress(label: str, total: int | None = None, already: int = 0) -> Iterator[Advance]:
    """Show a progress bar on stderr as soon as the work has lasted two seconds.

    Parameters
    ----------
    label : str
        Name of the work.
    total : int, optional
        Amount of work. If it is None, the bar moves to and fro, and a bar of known length inside
        this work replaces it for its time.
    already : int
        Amount that was done before; it counts as done, but not for the rate.

    Yields
    ------
    Advance
        To be called as the work proceeds.
    """
    replaced = [] if total is None or _watching.locked() else [*_outer]
    for _, hide, _ in replaced:  # before isatty(): a visible bar replaces sys.stderr
        hide()
    unwatched = not (_lines or sys.stderr.isatty()) or (total is None and (_lines or _outer))
    try:
        if _watching.locked() or unwatched:
            yield lambda amount: None
        elif total is None:
            yield from _bar(label, None, 0)
        else:
            with _watching:
                if _lines:
                    yield from _in_lines(label, total, already, _lines[-1])
                else:
                    yield from _bar(label, total, already)
    finally:
        for _, _, show_again in replaced:
            show_again()


@contextmanager
def up_to(label: str, total: float) -> Iterator[Callable[[float], None]]:
    """Show a progress bar for work that reports how far it is.

    Parameters
    ----------
    label : str
        Name of the work.
    total : float
        Amount of work.

    Yields
    ------
    callable
        To be called with the amount that is done.
    """
    whole, shown = round(total), 0
    with progress(label, whole) as advance:

        def report(reached: float) -> None:
            nonlocal shown
            now = min(max(round(reached), shown), whole)
            advance(now - shown)
            shown = now

        yield report


@contextmanager
def lines_to(stream: TextIO) -> Iterator[None]:
    """Write the progress of all work to a stream, as lines of JSON, instead of showing a bar.

    Parameters
    ----------
    stream : file
    """
    _lines.append(stream)
    try:
        yield
    finally:
        _lines.pop()


def _in_lines(label: str, total: int, already: int, stream: TextIO) -> Iterator[Advance]:
    begun, done, last = time.monotonic(), already, -math.inf

    def advance(amount: int) -> None:
        nonlocal done, last
        done += amount
        now = time.monotonic()
        if now - last < EVERY and done < total:
            return
        last, rate = now, (done - already) / max(now - begun, 1e-9)
        left = round((total - done) / rate, 1) if rate else None
        line = {"doing": label, "done": done, "of": total, "rate": round(rate, 3), "left": left}
        print(json.dumps(line), file=stream, flush=True)

    advance(0)
    yield advance


def _bar(label: str, total: int | None, already: int) -> Iterator[Advance]:
    done = already
    shown: list[Any] = []
    # A bar within another waits no longer than that: two seconds from the start of all the work.
    begun = _outer[0][0] if _outer else time.monotonic()
    late: Timer

    def show() -> None:
        shown.append(_rich_bar(label, total, done))
        shown[0].start()

    def show_later() -> None:
        # A clock of its own, for a first step that lasts longer than anyone likes to wait.
        nonlocal late
        late = Timer(max(0.0, begun + PATIENCE - time.monotonic()), show)
        late.daemon = True
        late.start()

    def hide() -> None:
        late.cancel()
        late.join()
        if shown:
            shown.pop().stop()

    def advance(amount: int) -> None:
        nonlocal done
        done += amount
        if shown:
            shown[0].update(shown[0].task_ids[0], completed=done)

    show_later()
    _outer.append((begun, hide, show_later))
    try:
        yield advance
    finally:
        _outer.pop()
        hide()


def _rich_bar(label: str, total: int | None, done: int) -> Any:
    """Build a progress bar of the library rich, which takes 0.1 s to import."""
    import rich.progress as columns
    from rich.console import Console
    from rich.text import Text

    class Rate(columns.TextColumn):
        """Column of the progress bar that shows the work done per second."""

        def render(self, task: columns.Task) -> Text:
            """Show the work done per second with three digits, or nothing before it is known."""
            speed = task.finished_speed or task.speed
            return Text(f"{speed:.3g}/s" if speed else "")

    count, left = columns.MofNCompleteColumn(), columns.TimeRemainingColumn()
    cells = ("{task.description}", columns.BarColumn(), count, Rate(""), left)
    bar = columns.Progress(*cells, console=Console(stderr=True), transient=True)
    bar.add_task(label, total=total, completed=done)
    return bar
