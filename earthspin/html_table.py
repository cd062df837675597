"""HTML tables (cards) that a notebook shows for a body, a question or a plan."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape


def card(caption: str, rows: Iterable[tuple[str, ...]]) -> str:
    """HTML text of a table; the first cell of each row is the heading of the row.

    Parameters
    ----------
    caption : str
    rows : iterable of tuple of str
        Plain text: it is escaped here.
    """
    body = "".join(
        f"<tr><th>{escape(first)}</th>{''.join(f'<td>{escape(cell)}</td>' for cell in rest)}</tr>"
        for first, *rest in rows
    )
    return f"<table><caption>{escape(caption)}</caption>{body}</table>"
