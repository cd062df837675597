"""Print tables to the terminal; raise BrokenPipeError if the reading program has ended."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Literal

from rich import box
from rich.console import Console
from rich.table import Table as RichTable
from rich.text import Text

from earthspin.errors import printable
from earthspin.views.tables import SHORT, SPACE, least_width, short_exponents

if TYPE_CHECKING:
    from earthspin.views.tables import TextTable

#: Columns where the output goes to a file or a pipe.
WIDTH = 100


class Terminal(Console):
    """Console for tables; it raises an error if the pipe that reads stdout is closed."""

    def __init__(self, width: int = WIDTH) -> None:
        super().__init__(width=None if sys.stdout.isatty() else width, highlight=False)

    def on_broken_pipe(self) -> None:
        """Raise BrokenPipeError, as the program that reads stdout has closed the pipe."""
        raise BrokenPipeError

    def print_table(self, table: TextTable) -> None:
        """Print a table with its note and its run time."""
        self.print(_plain(table.title), style="bold")
        shown = RichTable(box=box.SIMPLE_HEAD)
        columns = [[row[number] for row in table.rows] for number in range(len(table.headers))]
        pairs = list(zip(table.headers, columns, strict=True))
        natural = 1 + sum(SPACE + max(map(len, [header, *cells])) for header, cells in pairs)
        for number, (header, cells) in enumerate(pairs):
            # of a table that is too wide, headers and long text are wrapped, and no numbers
            least = least_width(header, cells) if natural > self.width else None
            flexible = any(len(cell) > SHORT for cell in cells)
            side: Literal["left", "right"] = "left" if number in table.words else "right"
            width = None if flexible else least
            shown.add_column(_plain(header), justify=side, width=width, overflow="fold")
        for row in table.rows:
            shown.add_row(*(_plain(short_exponents(cell)) for cell in row))
        self.print(shown)
        for words in filter(None, (table.note, table.cost)):
            self.print_text(words, style="dim")

    def print_text(self, words: str, style: str = "") -> None:
        """Print sentences; exponents are shortened, and control characters are escaped."""
        self.print(_plain(short_exponents(words)), style=style)


def _plain(words: str) -> Text:
    """Convert text to a rich `Text` that ignores markup and escapes control characters."""
    return Text("\n".join(map(printable, words.split("\n"))))
