"""A progress bar for whatever takes more than two seconds; silent when nobody watches."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

PATIENCE = 2.0  # seconds before a bar appears


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
    if not sys.stderr.isatty():
        yield lambda amount: None
        return
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
    begun = time.monotonic()

    def advance(amount: int) -> None:
        bar.advance(task, amount)
        if not bar.live.is_started and time.monotonic() - begun > PATIENCE:
            bar.start()

    try:
        yield advance
    finally:
        bar.stop()
