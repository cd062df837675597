"""An HTML page: one file that works offline, in light and dark, wide and narrow."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader, StrictUndefined

from earthspin.views.typeset import anchor, figure_on_page, typeset

if TYPE_CHECKING:
    from earthspin.views.drawing import Drawing
    from earthspin.views.solids import Solid
    from earthspin.views.table import Table


def page(
    title: str,
    tables: Sequence[Table] = (),
    drawings: Sequence[Drawing] = (),
    solids: Sequence[Solid] = (),
    *,
    lead: str = "",
    note: str = "",
    links: Sequence[tuple[str, str]] = (),
    last: Sequence[Table] = (),
    footer: str = "",
) -> str:
    """Page of figures, solids and tables, in this order.

    Parameters
    ----------
    title : str
    tables : sequence of Table
    drawings : sequence of Drawing
        If the first is square, it stands beside the title.
    solids : sequence of Solid
    lead, note : str
        A sentence at the head, and what holds for all that follows.
    links : sequence of (str, str)
        Words and addresses of other pages, relative to this one.
    last : sequence of Table
        At the end, folded away.
    footer : str

    Returns
    -------
    str
        HTML, self-contained.
    """
    shows_first = bool(drawings) and drawings[0].square
    return (
        environment()
        .get_template("page.html.j2")
        .render(
            title=title,
            tables=tables,
            first=drawings[0] if shows_first else None,
            drawings=drawings[1:] if shows_first else drawings,
            solids=solids,
            contents=[one.title for group in (drawings, solids, tables, last) for one in group],
            lead=lead,
            note=note,
            links=links,
            last=last,
            footer=footer,
            figure_on_page=figure_on_page,
            sheet=source("page.css"),
            script=source("touch.js") + source("solid.js"),
        )
    )


@cache
def environment() -> Environment:
    """Templates, and the filters that set words and names."""
    made = Environment(
        loader=PackageLoader("earthspin.views"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters |= {"typeset": typeset, "anchor": anchor}
    return made


def source(name: str) -> str:
    """Text of a file beside the templates: a style sheet or a script."""
    loader = environment().loader
    assert loader is not None
    return loader.get_source(environment(), name)[0]
