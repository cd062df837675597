"""Style and common elements of all figures, such as axes, error bands and legends.

No pyplot: it costs half a second and keeps global state. Matplotlib is imported when something is
drawn, so that tables do not wait for it.
"""

from __future__ import annotations

import io
import math
import os
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from inspect import signature
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
import xarray as xr

from earthspin.views.result_contents import Result, cases_of, resampled, stored_section
from earthspin.views.solids import Solid
from earthspin.views.tables import TextTable

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure
    from matplotlib.colorbar import Colorbar

#: Types for annotations, which do not import the library.
Axes: TypeAlias = "matplotlib.axes.Axes"
Figure: TypeAlias = "matplotlib.figure.Figure"

T = TypeVar("T")

#: Colours that remain apart for colour-blind eyes (Okabe & Ito 2008) and in print.
BLUE, RED, GREEN, PINK, ORANGE, SKY = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9",
)  # fmt: skip
CYCLE = (BLUE, RED, GREEN, PINK, ORANGE, SKY)
GREY = "0.35"

STYLE: Any = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10,
    "axes.grid": True,
    "axes.prop_cycle": f"cycler(color={list(CYCLE)})",
    "grid.alpha": 0.25,
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "svg.hashsalt": "earthspin",
    "svg.fonttype": "none",
}


#: Entry of legends for the bands.
INTERVAL = "95 % interval"
#: Width of figures on a phone, inches: 9 points are then 10 pixels of 390.
NARROW = 4.4

#: Settings of windows and of where things lie, which are none of a picture's.
_NO_STYLE = ("backend", "interactive", "toolbar", "webagg", "tk.", "macosx", "savefig.directory")


@contextmanager
def style() -> Iterator[None]:
    """Use the plot style of this package in a `with` block or a decorated function."""
    matplotlib = _matplotlib()
    defaults = matplotlib.rcParamsDefault.items()
    settings = {name: value for name, value in defaults if not name.startswith(_NO_STYLE)}
    with matplotlib.rc_context(settings | STYLE):
        yield


def _matplotlib() -> Any:
    """Import matplotlib, even if the environment variable MPLBACKEND names a missing backend.

    No window is opened here, and a missing backend would make the import fail.
    """
    named = None if "matplotlib" in sys.modules else os.environ.pop("MPLBACKEND", None)
    try:
        import matplotlib
    finally:
        if named is not None:
            os.environ["MPLBACKEND"] = named
    if named:
        with suppress(ValueError):
            matplotlib.rcParams["backend"] = named  # as the library does when it is imported
    return matplotlib


@dataclass(frozen=True)
class Drawing:
    """Figure, already drawn, with title and caption, for an HTML page.

    Attributes
    ----------
    title, caption : str
    figure : Figure
    square : bool
        Whether it is as high as wide, and is then drawn narrower.
    phone : Figure or None
        The same drawn anew for a phone, where it does not do to make the figure narrower.
    """

    title: str
    caption: str
    figure: Figure
    square: bool = False
    phone: Figure | None = None

    @property
    def svg(self) -> str:
        """SVG text of the figure, without an XML declaration."""
        return _saved(self.figure)

    @property
    def narrow(self) -> str:
        """SVG text of a narrow version of the figure, for phones; empty if not needed."""
        if self.phone is not None:
            return _saved(self.phone)
        width, height = self.figure.get_size_inches()
        if width <= 1.2 * NARROW:
            return ""
        try:
            self.figure.set_size_inches(NARROW, height)
            return _saved(self.figure)
        finally:
            self.figure.set_size_inches(width, height)


@style()
def _saved(figure: Figure) -> str:
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    text, canvas, dpi = io.StringIO(), figure.canvas, figure.dpi
    try:
        # savefig would draw a figure with a layout twice, since it may also trim the margins.
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Glyph .* missing")  # a browser sets the text
            FigureCanvasSVG(figure).print_svg(text, metadata={"Date": None})  # type: ignore[no-untyped-call]
    finally:
        figure.set_canvas(canvas)
        figure.set_dpi(dpi)
    svg = text.getvalue()
    # The metadata name the drawing library, and addresses that no page needs.
    return re.sub(r"<metadata>.*?</metadata>", "", svg[svg.index("<svg") :], flags=re.DOTALL)


@dataclass(frozen=True)
class PageFigure:
    """Description of a figure on an HTML page: title, caption, plot function, required sections.

    Attributes
    ----------
    title : str
    caption : str or callable
        A function makes it from the answer.
    plot : callable
        Function from the answer to axes or to a whole figure; takes axes as `ax`, if `phone` is
        given.
    section : str
        Section without which it is left out.
    uses : sequence of str
        Further sections that it shows.
    applies : callable, optional
        Condition that the answer must meet.
    square : bool
        See `Drawing`.
    phone : float
        Height of the same drawn anew for a phone, inches; 0 if it is only made narrower.
    points : int
        Number of times at which a closed form is computed for it; 0 for those of the answer.
    """

    title: str
    caption: str | Callable[[Result], str]
    plot: Callable[..., Axes | Figure]
    section: str = ""
    uses: Sequence[str] = ()
    applies: Callable[[Result], bool] | None = None
    square: bool = False
    phone: float = 0.0
    points: int = 0

    def drawings(self, tree: Result) -> list[Drawing]:
        """Draw the figure for a result that has what it needs; empty for others."""
        is_present = not self.section or stored_section(tree, self.section) is not None
        applies = is_present and (self.applies is None or self.applies(tree))
        return [self.drawn(tree)] if applies else []

    @style()
    def drawn(self, tree: Result) -> Drawing:
        """Draw the figure for a result; return it with caption and, if needed, a phone version."""
        caption = self.caption(tree) if callable(self.caption) else self.caption
        cases, phone = cases_of(resampled(tree, self.points) if self.points else tree), None
        figure = _side_by_side(self.plot, cases)
        if self.phone:
            phone = figure_of(self.plot(tree, ax=axes(None, NARROW, self.phone)))
        return Drawing(self.title, caption, figure, self.square, phone)


def page_figure(
    title: str, caption: str | Callable[[Result], str], **options: Any
) -> Callable[[T], T]:
    """Decorate a function that plots a result: it draws a `PageFigure` of pages and reports."""

    def decorated(plot: Any) -> Any:
        plot.on_page = PageFigure(title, caption, plot, **options)
        return plot

    return decorated


def _side_by_side(plot: Callable[..., Axes | Figure], cases: Mapping[str, Result]) -> Figure:
    """Draw several bodies or initial states in one figure; the first if `plot` takes no axes."""
    takes = signature(plot).parameters
    if len(cases) == 1 or not {"ax", "figure"} & {*takes}:
        return figure_of(plot(next(iter(cases.values()))))
    figure = empty(10, 3.2 * math.ceil(len(cases) / 2))
    parts: Any = figure.subfigures(math.ceil(len(cases) / 2), 2, squeeze=False).flat
    for part, (words, case) in zip(parts, cases.items(), strict=False):
        part.suptitle(words)
        plot(case, **({"ax": part.add_subplot()} if "ax" in takes else {"figure": part}))
    return figure


#: Tables or pictures of a result, each with the names of the sections that it needs.
Makers: TypeAlias = Sequence[tuple[str, Callable[[Result], T]]]


@dataclass(frozen=True)
class Views:
    """Definitions of figures, 3-D pictures and special tables for one type of result.

    Attributes
    ----------
    plots : sequence of callable
        Functions that `page_figure` decorates, in the order of the page.
    solids, tables : sequence of (str, callable)
        Names of the sections that it needs, and the function that makes it. A table replaces that
        of the answer, if it names no section, or those of the sections that it names.
    lead : callable, optional
        Function that makes the first sentence of the page.
    """

    plots: Sequence[Callable[..., Axes | Figure]] = ()
    solids: Makers[Solid] = ()
    tables: Makers[TextTable] = ()
    lead: Callable[[Result], str] | None = None

    @property
    def figures(self) -> list[PageFigure]:
        """Figures of pages, in their order."""
        return [plot.on_page for plot in self.plots]  # type: ignore[attr-defined]


def figure_of(shown: Axes | Figure) -> Figure:
    """Return the figure that contains the given axes; return a given figure unchanged."""
    figure = shown.get_figure(root=True)
    assert figure is not None
    return figure


def stacked(
    count: int, height: float, figure: Figure | None = None, *, width: float = 8.0, **how: Any
) -> tuple[Figure, list[Axes]]:
    """Return axes one above the other with a common horizontal axis, by default in a new figure."""
    figure = empty(width, height) if figure is None else figure
    return figure, list(figure.subplots(count, 1, sharex=True, squeeze=False, **how)[:, 0])


def band(
    ax: Axes,
    x: Any,
    value: Any,
    error: Any,
    colour: str,
    *,
    alpha: float = 0.3,
    lowest: float = -np.inf,
    **how: Any,
) -> None:
    """Draw a line with its 95 % half-width as a band, clipped below the value `lowest`.

    Bands that are clearly wider than the line share one entry of the legend.
    """
    low, high = np.maximum(value - error, lowest), value + error
    ax.plot(x, value, color=colour, **how)
    filled = ax.fill_between(x, low, high, color=colour, alpha=alpha, lw=0)
    pixels = np.nan_to_num(high - low).max() / np.ptp(ax.get_ylim()) * ax.bbox.height
    if pixels > 4 and INTERVAL not in ax.get_legend_handles_labels()[1]:
        filled.set_label(INTERVAL)


def path_in_time(ax: Axes, x: Any, y: Any, years: Any, words: str, **how: Any) -> Colorbar:
    """Draw a path in a plane, coloured by the time, and return its bar of colours."""
    ax.plot(x, y, color="0.8", lw=0.6, zorder=1)
    dots = ax.scatter(x, y, c=years, s=3, cmap="viridis", zorder=2)
    ax.set_aspect("equal")
    where: Any = {"ax": ax, "location": "bottom", "shrink": 0.8, "aspect": 40}
    return ax.figure.colorbar(dots, label=words, **where, **how)


def lines(ax: Axes, x: Any, values: xr.DataArray, **how: Any) -> None:
    """Draw one line for each label along the last dimension of `values`, in different colours."""
    labels = values[values.dims[-1]].values
    for colour, label, value in zip((*CYCLE, GREY), labels, values.values.T, strict=False):
        ax.plot(x, value, color=colour, label=literal(label), **how)


#: Longest name in a figure; more would leave no room for the axes.
_LONGEST = 40


def literal(words: object) -> str:
    """Escape a text so that matplotlib shows every character; shorten a very long text.

    A dollar sign would begin a formula, and a legend leaves out what begins with an underscore.
    """
    text = str(words) if len(str(words)) <= _LONGEST else f"{str(words)[:_LONGEST]}\u2026"
    return re.sub("^_", "\u200b_", text).replace("$", r"\$")


def rungs(ax: Axes, labels: Sequence[object]) -> None:
    """Label the horizontal axis with the names of models of increasing detail (rungs)."""
    ax.set_xticks(range(len(labels)), [str(label) for label in labels])
    ax.margins(x=0.08)
    ax.grid(axis="x", visible=False)


def empty(width: float, height: float) -> Figure:
    """Create an empty figure of a given width and height, in inches."""
    _matplotlib()
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def axes(ax: Axes | None, width: float = 8.0, height: float = 3.8) -> Axes:
    """Return the given axes; if None is given, return the axes of a new figure."""
    if ax is not None:
        return ax
    with style():
        return empty(width, height).add_subplot()


def minus(text: str) -> str:
    """Replace all hyphens in a text, such as those before numbers, by minus signs."""
    return text.replace("-", "\u2212")


#: Superscript characters, which stay powers if a text is copied.
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(value: float, _: object = None) -> str:
    """Label of a logarithmic axis, such as 10⁻³, as plain text, which is faster than a formula."""
    power = round(np.log10(value)) if value > 0 else 0
    if not np.isclose(value, 10.0**power, rtol=1e-9, atol=0):
        return f"{value:g}"  # under the pointer
    return "10" + str(power).translate(RAISED)


def few_dates(ax: Axes) -> None:
    """Limit the number of dates along an axis, so that their labels do not overlap on a phone."""
    from matplotlib.dates import AutoDateLocator, ConciseDateFormatter

    dates = AutoDateLocator(minticks=3, maxticks=7)  # type: ignore[no-untyped-call]
    ax.xaxis.set_major_locator(dates)
    ax.xaxis.set_major_formatter(ConciseDateFormatter(dates))  # type: ignore[no-untyped-call]


def legend_above(ax: Axes) -> None:
    """Place the legend above the axes, at the right end."""
    legend = ax.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, borderaxespad=0.1, fontsize=8
    )
    for line in legend.get_lines():
        line.set_linewidth(1.4)


def note(ax: Axes, text: str, at: tuple[float, float], by: tuple[float, float], **how: Any) -> None:
    """Write small text near a point, shifted from it by a distance in typographic points."""
    ax.annotate(text, at, xytext=by, textcoords="offset points", **{"fontsize": 8} | how)
