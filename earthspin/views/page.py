"""An HTML page: one file that works offline."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader, StrictUndefined

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
    last: Sequence[Table] = (),
    footer: str = "",
) -> str:
    """Page of tables, figures and solids.

    Parameters
    ----------
    title : str
    tables : sequence of Table
    drawings : sequence of Drawing
    solids : sequence of Solid
    lead, note : str
        A sentence at the head, and what holds for all that follows.
    last : sequence of Table
        At the end.
    footer : str

    Returns
    -------
    str
        HTML, self-contained.
    """
    loader = PackageLoader("earthspin.views")
    environment = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("page.html.j2").render(
        title=title,
        tables=tables,
        drawings=drawings,
        solids=solids,
        lead=lead,
        note=note,
        last=last,
        footer=footer,
        script=loader.get_source(environment, "solid.js")[0],
    )
