"""Make tables, figures, HTML pages and JSON text of a result."""

from __future__ import annotations

import json
import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np
import xarray as xr

from earthspin.engine.accessor import is_ensemble
from earthspin.engine.origin import is_whole, without_lost_units
from earthspin.engine.run import NOT_REQUESTED, REUSED, run_time_words
from earthspin.engine.variables import texts_as_columns
from earthspin.errors import EarthspinError, SceneError
from earthspin.progress import progress
from earthspin.scenes import plan, run_tree
from earthspin.views import (
    ensemble,
    length_of_day,
    long_term,
    observed_pole,
    pole,
    precession,
    rotors,
    tables,
    torque,
    wobble,
)
from earthspin.views.any_answer import any_drawing
from earthspin.views.drawing import Drawing, Figure, Makers, T, Views, style
from earthspin.views.result_contents import (
    Result,
    answer_of,
    ascending,
    changes_of,
    dataset_of,
    laid_out,
    question_of,
    stored_section,
)
from earthspin.views.solids import Solid
from earthspin.views.tables import BRACKETS, TextTable, along

if TYPE_CHECKING:
    from earthspin.engine.accessor import Answer

#: Figures, pictures and special tables of the answers to each question.
VIEWS = precession.VIEWS | torque.VIEWS | pole.VIEWS | rotors.VIEWS | long_term.VIEWS
VIEWS |= observed_pole.VIEWS | length_of_day.VIEWS | wobble.VIEWS

#: Page of the documentation that explains errors.
ERRORS = "work_precision"


#: Table of data without variables that tables show, such as errors alone.
_EMPTY = TextTable("No values", ("quantity", "value"), [])


def tables_for(tree: Result) -> list[TextTable]:
    """Tables of a result and its sections, in reading order.

    Parameters
    ----------
    tree : Dataset or DataTree
        Result of `run` or `run_tree`; only sections that it contains are shown.

    Returns
    -------
    list of TextTable
        Those of the question's own views, then one or more for the answer and for each
        section that these do not show. What the model leaves out stands below the errors that do
        not hold it, or else below the first table.
    """
    answer = answer_of(tree)
    first, *others = (ensemble.tables(tree) if is_ensemble(tree) else _tables(tree)) or [_EMPTY]
    neglected = answer.attrs.get("neglected", "")
    left_out = f"Left out: {neglected}."
    noted = not neglected or any(left_out in t.note.split("\n") for t in (first, *others))
    note = [*changes_of(answer), first.note, "" if noted else left_out]
    shown = [replace(first, note="\n".join(filter(None, note))), *others]
    return tables.with_own_titles(shown)


def _tables(tree: Result) -> list[TextTable]:
    """Tables designed for this type of result, then general tables of the other sections."""
    made = {names: _made(tree, [make]) for names, make in _with_sections(tree, _views(tree).tables)}
    shown = {name for names, some in made.items() if some for name in names.split() or [""]}
    special = [table for some in made.values() for table in some if table.rows]
    return [*special, *tables.tables(tree, without=shown)]


def drawings_for(tree: Result) -> list[Drawing]:
    """Draw all figures of a result and of its sections, with captions.

    Data that have no figure of their own, such as means, are drawn over their longest dimension.
    """
    one_instant = "time" in tree.coords and tree.sizes.get("time", 1) < 2
    figures = [] if one_instant else _views(tree).figures
    drawings = [d for made in _made(tree, [figure.drawings for figure in figures]) for d in made]
    whole = is_whole(dataset_of(tree))
    return drawings if drawings or whole else any_drawing(ascending(laid_out(dataset_of(tree))))


def solids_for(tree: Result) -> list[Solid]:
    """Make all three-dimensional pictures, still or animated, of a result."""
    return _made(tree, [make for _, make in _with_sections(tree, _views(tree).solids)])


def _with_sections(tree: Result, makers: Makers[T]) -> list[tuple[str, Callable[[Result], T]]]:
    """Select the makers of tables or pictures whose required sections are there."""
    return [
        (names, make)
        for names, make in makers
        if all(stored_section(tree, name) is not None for name in names.split())
    ]


#: Errors of tables and figures that need more than a part of an answer holds.
_LACKING = (ArithmeticError, AttributeError, EarthspinError, LookupError, TypeError, ValueError)


def _made(tree: Result, makers: Iterable[Callable[[Result], T]]) -> list[T]:
    """Make tables or pictures of a result; of a part of an answer, those for which it suffices."""
    part, made = laid_out(tree) if isinstance(tree, xr.Dataset) else tree, list[T]()
    if is_whole(dataset_of(tree)):
        return [make(part) for make in makers]
    for make in makers:
        with suppress(*_LACKING, UserWarning, RuntimeWarning), warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)
            warnings.simplefilter("error", RuntimeWarning)
            made.append(make(part))
    return made


def _views(tree: Result) -> Views:
    """Return the definitions of tables, figures and pictures (`Views`) for this type of result."""
    if without_lost_units(data := dataset_of(tree)) is not data:
        return Views()  # whose texts name units
    own = VIEWS.get(tree.attrs.get("compute", ""), Views())
    return ensemble.VIEWS if is_ensemble(tree) else own


@progress("figures")
def figures_of(answer: xr.Dataset) -> list[Figure]:
    """Draw all figures of a result, and return them as a list; missing sections are computed.

    Parameters
    ----------
    answer : Dataset
        The sections that its figures need are run for it, if it is the answer to its scene.
    """
    nodes = {"/": ascending(laid_out(answer))}
    needed = {name for f in _views(answer).figures for name in (f.section, *f.uses)}
    with suppress(EarthspinError):  # a part of an answer, a function of the caller, a short record
        names = [name for name in plan(answer, "all").sections if name in needed]
        if names:
            sections = run_tree(answer, names)
            # in the order of the answer's labels, which the caller may have changed
            for name in names:
                nodes[name] = sections.earthspin.section(name).reindex_like(nodes["/"])
    return [drawing.figure for drawing in drawings_for(xr.DataTree.from_dict(nodes))]


def plot(answer: Answer) -> list[Figure]:
    """Draw the standard figures of a result.

    Of a part of an answer, such as a mean, what can be drawn is drawn.

    Parameters
    ----------
    answer : Answer
        Accessor of the result, of which this is a method.

    Returns
    -------
    list of Figure

    Raises
    ------
    SceneError
        If no number varies along a dimension.

    Examples
    --------
    >>> import earthspin
    >>> year = earthspin.torque_series("2026-01-01", "2027-01-01", "6 h")
    >>> year.earthspin.plot()[0].savefig("torque.png")
    """
    data = answer.dataset
    if {"time", "chandler_amplitude"} <= {*data.variables}:
        with style():  # a result of `fit_chandler`
            return [observed_pole.plot_amplitude_and_phase(data)]
    figures = figures_of(data) or [drawing.figure for drawing in any_drawing(ascending(data))]
    if not figures:
        problem = "these are single numbers; print(ds.earthspin.to_frame()) shows them"
        raise SceneError("plot", data.attrs.get("title", "data"), problem)
    return figures


def print_tables(tree: Result, *, with_plan: bool = False) -> None:
    """Print lead and tables of a result and, if `with_plan`, a table of what was computed."""
    from earthspin.views.terminal import Terminal

    console = Terminal()
    if lead := _lead(tree):
        console.print_text(f"{lead}\n")
    for table in [*tables_for(tree), *(run_time_tables(tree) if with_plan else ())]:
        console.print_table(table)
        console.print()
    console.print(BRACKETS, style="dim")


def scene_page(tree: Result) -> str:
    """HTML page of one result: tables, figures, 3-D pictures, and the computations that ran.

    Returns
    -------
    str
        HTML, self-contained.
    """
    return page_of(tree, title=answer_of(tree).attrs.get("title", "Data"))


def page_of(
    *trees: Result,
    title: str,
    lead: str | None = None,
    drawings: Sequence[Drawing] | None = None,
    links: Sequence[tuple[str, str]] = (),
) -> str:
    """HTML page with tables, figures and 3-D pictures of one or more results.

    Parameters
    ----------
    *trees : Dataset or DataTree
    title : str
    lead : str, optional
        A sentence at the head; that of the first question by default.
    drawings : sequence of Drawing, optional
        Figures of the page; those of the results by default.
    links : sequence of (str, str)
        Words and addresses of other pages, relative to this one.

    Returns
    -------
    str
        HTML, self-contained.
    """
    from earthspin.views.page import page

    return page(
        title,
        tables.with_own_titles(table for tree in trees for table in tables_for(tree)),
        [d for tree in trees for d in drawings_for(tree)] if drawings is None else drawings,
        [solid for tree in trees for solid in solids_for(tree)],
        lead=_lead(trees[0]) if lead is None else lead,
        note=f"{BRACKETS}\n{_pages_of(trees[0])}",
        links=links,
        last=run_time_tables(*trees),
        footer=_footer(answer_of(trees[0])),
    )


def _lead(tree: Result) -> str:
    """Sentences at the head of a result: its main numbers, or the changes of the bodies."""
    leads = _made(tree, filter(None, [_views(tree).lead]))
    return leads[0] if leads else " ".join(changes_of(answer_of(tree)))


def run_time_tables(*trees: Result) -> list[TextTable]:
    """Table of the computations that ran for the results, with run times.

    For a single result it also lists the computations that were left out, with reasons.

    Returns
    -------
    list of TextTable
        One, or none if the answers do not carry their plans.
    """
    plans = [parts for tree in trees if (parts := stored_section(tree, "plan")) is not None]
    rows = []
    for part, row in (row for parts in plans for row in along(parts, "part")):
        reason = row.reason.item()
        status = row.status.item()
        if status in ("ran", REUSED):
            run_time = REUSED if status == REUSED else f"{float(row.run_time) * 1e3:.1f}"
            rows.append((part, reason, run_time))
        elif len(trees) == 1 and reason != NOT_REQUESTED:
            rows.append((part, f"left out: {reason}", ""))
    title = "Parts that ran, and parts left out" if len(trees) == 1 else "Parts that ran"
    headers = "part", "what it computes", "ms"
    wall, computation = (sum(float(p[f"{n}_time"]) for p in plans) for n in ("wall", "computation"))
    cost = run_time_words(wall, computation)
    return [TextTable(title, headers, rows, words=(0, 1), cost=cost)] if plans else []


def _pages_of(tree: Result) -> str:
    """Sentence that names the documentation pages on the method and the errors of a result."""
    page = question.page if (question := question_of(tree)) else ""
    method = f"the method in docs/{page}.md, " if page else ""
    return f"In the documentation: {method}the errors in docs/{ERRORS}.md."


def _footer(answer: xr.Dataset) -> str:
    """Sentence that gives the program version, kernel and sources of a result."""
    attrs = answer.attrs
    words = f"{attrs.get('source', '')}."
    if "ephemeris" in attrs:
        words += f" Kernel {attrs['ephemeris']}, SHA-256 {attrs['ephemeris_sha256']}."
    if attrs.get("references"):
        words += f" Sources of the numbers: {attrs['references']}."
    return words


# --- result as JSON ------------------------------------------------------------------------------


#: Numbers that become text at once.
AT_ONCE = 1 << 16


def write_json(tree: xr.DataTree, stream: TextIO) -> None:
    """Write a result and its sections as JSON, in the layout of `Dataset.to_dict`.

    Dates are text in ISO 8601, and so are infinity and what is no number, for which JSON has none.

    Parameters
    ----------
    tree : DataTree
    stream : text file
    """
    content, sections = _node(tree), tree.children.items()
    if others := {name: _node(section) for name, section in sections if name != "plan"}:
        content["sections"] = others
    stream.writelines(_json_of(content))
    stream.write("\n")


def _node(node: xr.DataTree) -> dict[str, Any]:
    return texts_as_columns(node.earthspin.dataset).to_dict(data="array")


def _json_of(value: Any) -> Iterator[str]:
    """Yield the JSON text of a value in pieces, of which none holds many numbers."""
    if isinstance(value, Mapping):
        yield "{"
        for number, (key, inner) in enumerate(value.items()):
            yield f"{',' if number else ''}\n{json.dumps(str(key))}: "
            yield from _json_of(inner)
        yield "}"
    elif isinstance(value, np.ndarray) and value.size > AT_ONCE:
        rows = max(1, AT_ONCE * len(value) // value.size)
        yield "["
        for first in range(0, len(value), rows):
            piece = json.dumps(_plain(value[first : first + rows]))
            yield f"{',' if first else ''}{piece[1:-1]}"
        yield "]"
    else:
        yield json.dumps(_plain(value), default=str)


def _plain(value: Any) -> Any:
    """Convert arrays, dates and infinite numbers to types that JSON can represent."""
    if isinstance(value, (np.ndarray, np.generic)):
        if value.dtype.kind == "f" and np.isfinite(value).all():
            return value.tolist()
        value = value.astype("M8[us]").tolist() if value.dtype.kind == "M" else value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    if isinstance(value, datetime):
        return value.isoformat()
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
