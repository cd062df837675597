"""A progress bar for whatever takes more than two seconds; silent when nobody watches."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock, Timer
from typing import Protocol

PATIENCE = 2.0  # seconds before a bar appears

#: Held by whoever shows a bar: of work within work, only the outer is shown.
_watching = Lock()


class Advance(Protocol):
    """Call it with how much has been done since the last call."""

    def __call__(self, amount: int) -> None:
        """Note that `amount` more is done."""


@contextmanager
def progress(label: str, total: int) -> Iterator[Advance]:
    """Show a bar on stderr once the work has lasted two seconds.

    Parameters
    ----------
    label : str
        What is being done.
    total : int
        How much there is to do.

    Yields
    ------
    Advance
        To be called as the work proceeds.
    """
    if not sys.stderr.isatty() or _watching.locked():
        yield lambda amount: None
        return
    with _watching:
        yield from _bar(label, total)


def _bar(label: str, total: int) -> Iterator[Advance]:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    bar = Progress(
        "{task.description}",
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        console=Console(stderr=True),
        transient=True,
    )
    task = bar.add_task(label, total=total)
    # A clock of its own, for a first step that lasts longer than anyone likes to wait.
    late = Timer(PATIENCE, bar.start)
    late.daemon = True
    late.start()
    try:
        yield lambda amount: bar.advance(task, amount)
    finally:
        late.cancel()
        late.join()
        bar.stop()
