"""A line of text, as a kind that reads itself: the one kind that needs no number and no unit."""

from __future__ import annotations

from dataclasses import dataclass

from earthspin.errors import Where, is_one_line


@dataclass(frozen=True)
class Text:
    """A line of text."""

    words, hint = "a line of text", "str"

    def read(self, given: object, where: Where) -> str:
        """Check."""
        if not isinstance(given, str) or not is_one_line(given):
            raise where.error(given, f"it is {self.words}")
        return given

    def write(self, value: str) -> str:
        """Give the text."""
        return value
