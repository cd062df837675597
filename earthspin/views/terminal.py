"""The terminal: where tables are printed, and what happens when nobody reads on."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from rich import box
from rich.console import Console
from rich.table import Table as RichTable
from rich.text import Text

from earthspin.errors import printable
from earthspin.views.table import short_exponents

if TYPE_CHECKING:
    from earthspin.views.table import Table

#: Columns where the output goes to a file or a pipe.
WIDTH = 100


class Terminal(Console):
    """A console that leaves a closed pipe to the command line, which knows its exit status."""

    def __init__(self, width: int = WIDTH) -> None:
        super().__init__(width=None if sys.stdout.isatty() else width, highlight=False)

    def on_broken_pipe(self) -> None:
        """Whoever read our output has gone: say so instead of leaving with status 1."""
        raise BrokenPipeError

    def print_table(self, table: Table) -> None:
        """Print a table, its note and its cost."""
        shown = RichTable(
            title=_plain(table.title), title_justify="left", title_style="bold", box=box.SIMPLE_HEAD
        )
        for number, header in enumerate(table.headers):
            shown.add_column(_plain(header), justify="left" if number in table.words else "right")
        for row in table.rows:
            shown.add_row(*(_plain(short_exponents(cell)) for cell in row))
        self.print(shown)
        for words in filter(None, (table.note, table.cost)):
            self.print(_plain(short_exponents(words)), style="dim")


def _plain(words: str) -> Text:
    """Words as they are: brackets are no markup, and escapes do nothing to the terminal."""
    return Text("\n".join(map(printable, words.split("\n"))))
