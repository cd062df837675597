"""The terminal: where tables are printed, and what happens when nobody reads on."""

from __future__ import annotations

import sys

from rich.console import Console

#: Columns where the output goes to a file or a pipe.
WIDTH = 100


class Terminal(Console):
    """A console that leaves a closed pipe to the command line, which knows its exit status."""

    def __init__(self, width: int = WIDTH) -> None:
        super().__init__(width=None if sys.stdout.isatty() else width, highlight=False)

    def on_broken_pipe(self) -> None:
        """Whoever read our output has gone: say so instead of leaving with status 1."""
        raise BrokenPipeError
