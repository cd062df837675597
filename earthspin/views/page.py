"""Build an HTML page as a single file, for light and dark screens, wide and narrow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from functools import cache
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from earthspin.engine import drafts
from earthspin.views.drawing import Drawing
from earthspin.views.solids import Solid
from earthspin.views.table import Table
from earthspin.views.typeset import anchor, figure_on_page, typeset


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
    """HTML text of a page with figures, three-dimensional pictures and tables, in this order.

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
    return rendered(
        "page.html.j2",
        title=title,
        tables=tables,
        first=drawings[0] if shows_first else None,
        drawings=drawings[1:] if shows_first else drawings,
        solids=solids,
        contents=[part.title for parts in (drawings, solids, tables, last) for part in parts],
        lead=lead,
        note=note,
        links=links,
        last=last,
        footer=footer,
        figure_on_page=figure_on_page,
        script=source("touch.js") + source("solid.js"),
    )


def rendered(template: str, **content: object) -> str:
    """Insert content and the common style sheet into a template; return the HTML text."""
    return environment().get_template(template).render(sheet=source("page.css"), **content)


def write_texts(texts: Mapping[Path, str]) -> list[Path]:
    """Write several text files; if an error occurs, write none of them."""
    with ExitStack() as together:
        for path, text in texts.items():
            draft = together.enter_context(drafts.replacing(path))
            draft.write_text(text, encoding="utf-8")
    return [*texts]


@cache
def environment() -> Environment:
    """Jinja environment that loads the page templates and defines their text filters."""
    templates = Environment(
        loader=PackageLoader("earthspin.views"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates.filters |= {"typeset": typeset, "anchor": anchor}
    return templates


def source(name: str) -> str:
    """Text of a file in the folder of the templates, such as a style sheet or a script."""
    loader = environment().loader
    assert loader is not None
    return loader.get_source(environment(), name)[0]
