"""Error against run time: table, figure, page."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from earthspin.engine import drafts, store
from earthspin.rounded import duration, plain, shown_unit
from earthspin.views.table import Table

FloatArray = NDArray[np.float64]

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Colours that remain apart for colour-blind eyes (Okabe & Ito 2008), and markers.
_COLOURS = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#7F3C8D", "#666666",
)  # fmt: skip
#: Below this ratio of errors the axis shows more than powers of ten.
FEW_DECADES = 100
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">")


def accuracy_table(result: xr.Dataset) -> Table:
    """Error and run time of every setting that was measured.

    Parameters
    ----------
    result : Dataset
        As `earthspin.accuracy` gives it.
    """
    unit = _unit(result)
    rows = []
    for place, name in enumerate(result["method"].values):
        row = result.isel(method=place)
        for rung in range(int(row.settings)):
            rows.append(_row(str(name) if rung == 0 else "", row.isel(rung=rung)))
    return Table(
        result.attrs["quantity"],
        ("method", "setting", f"error{',' if unit else ''}{unit}", "run time", "±", "calls", ""),
        rows,
        _note(result),
        words=(0, 1, 6),
    )


def _row(name: str, point: xr.Dataset) -> tuple[str, ...]:
    flags = {"front": point.pareto, "at the reference's floor": point.at_floor}
    return (
        f"{name}{'' if bool(point.ours) or not name else ' (other)'}",
        str(point.setting.values),
        plain(float(point.error)),
        duration(float(point.run_time)),
        duration(float(point.run_time_spread)),
        f"{int(point.evaluations):,}",
        ", ".join(words for words, flag in flags.items() if bool(flag)),
    )


def _note(result: xr.Dataset) -> str:
    """The problem, its reference, and the methods that fail."""
    unit = _unit(result)
    words = [
        f"{_capital(result.attrs['problem'])}.",
        f"Reference: {result.attrs['reference']}; good to "
        f"{plain(result.attrs['reference_error'])}{unit}.",
        "Run times are medians, ± half their range.",
    ]
    if result.attrs["skipped"]:
        words.append(f"Left out: {result.attrs['skipped']}.")
    for place in np.flatnonzero(~result.holds.values):
        row = result.isel(method=int(place))
        words.append(
            f"FAILS: {row['method'].item()}, error {plain(float(row.error[-1]))}, bound "
            f"{plain(float(row.bound))}{unit}."
        )
    return " ".join(words)


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _unit(result: xr.Dataset) -> str:
    """Unit of the error as it stands behind a number, with a space."""
    return shown_unit(str(result.error.attrs["units"]))


def print_accuracy(results: Sequence[xr.Dataset]) -> None:
    """Print table and sentence of each quantity to the terminal."""
    from earthspin.views.terminal import WIDTH, Terminal

    console = Terminal(WIDTH + 10)
    for result in results:
        table = accuracy_table(result)
        console.print_table(table)
        console.print(f"\n{result.attrs['sentence']}\n", markup=False)


# --- figure ------------------------------------------------------------------------------------


def plot_accuracy(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Error against run time on log axes: filled markers are methods of this package.

    The broad line is the front, each task with its own. A bar is half the range of the run times.
    The thin line of a method joins those of its settings for which no other setting is both faster
    and more exact.

    Parameters
    ----------
    result : Dataset
        As `earthspin.accuracy` gives it.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    from matplotlib.ticker import LogLocator

    from earthspin.views.drawing import axes

    ax = axes(ax, 7.5, 4.4)
    unit = _unit(result)
    for number, name in enumerate(result["method"].values):
        row = result.isel(method=number, rung=slice(0, int(result.settings[number])))
        colour, ours = _COLOURS[number % len(_COLOURS)], bool(row.ours)
        time, error = row.run_time.values, row.error.values
        spread = row.run_time_spread.values
        ax.errorbar(
            time, error, xerr=[np.minimum(spread, 0.9 * time).tolist(), spread.tolist()],
            fmt=_MARKERS[number % len(_MARKERS)], ms=5.5, mfc=colour if ours else "white",
            mec=colour, color=colour, elinewidth=0.8, alpha=0.9, label=str(name), zorder=3,
        )  # fmt: skip
        ax.step(
            *_front(time, error), where="post", color=colour, lw=0.8, alpha=0.9,
            ls="-" if ours else ":", zorder=2,
        )  # fmt: skip
    ax.set_xscale("log")
    ax.set_yscale("log")
    _draw_fronts(result, ax)
    ax.set_xlabel("run time (s)")
    ax.set_ylabel(f"error ({unit.strip()})" if unit else "relative error")
    if float(result.error.max() / result.error.min()) < FEW_DECADES:
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_major_formatter("{x:g}")
        ax.yaxis.set_minor_formatter("")
    ax.legend(
        title="filled: earthspin\nopen: set by hand with SciPy,\nor another library",
        alignment="left", loc="upper left", bbox_to_anchor=(1.01, 1.0),
        fontsize=8, title_fontsize=8, borderaxespad=0,
    )  # fmt: skip
    return ax


def _front(time: FloatArray, error: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points for which no other is both faster and more exact, the fastest first."""
    order = np.lexsort((error, time))
    time, error = time[order], error[order]
    kept = error < np.concatenate([[np.inf], np.minimum.accumulate(error)[:-1]])
    return time[kept], error[kept]


def _draw_fronts(result: xr.Dataset, ax: Axes) -> None:
    """Steps through the points of each task's front."""
    right, top = float(result.run_time.max()), float(result.error.max())
    label = "front (Pareto)"
    for task in dict.fromkeys(result.task.values.tolist()):
        mine = (result.task == task) & result.pareto
        time, error = _front(result.run_time.values[mine], result.error.values[mine])
        ax.step(
            [time[0], *time, right], [top, *error, error[-1]], where="post", color="0.55", lw=3.5,
            alpha=0.35, zorder=1, solid_joinstyle="round", label=label,
        )  # fmt: skip
        label = "_"  # the others are alike


def svg_of(result: xr.Dataset) -> str:
    """Figure of a quantity as the text of an SVG."""
    from earthspin.views.drawing import Drawing, figure_of, style

    with style():
        ax = plot_accuracy(result)
        ax.set_title(_capital(result.attrs["quantity"].replace("-", " ")), loc="left")
        return Drawing(result.attrs["quantity"], result.attrs["sentence"], figure_of(ax)).svg


# --- files -------------------------------------------------------------------------------------


def write_accuracy(results: Sequence[xr.Dataset], folder: str | Path) -> list[Path]:
    """Write the data of each quantity, and then its figure and one page of all.

    Parameters
    ----------
    results : sequence of Dataset
    folder : str or Path
        ``accuracy.html`` and, for each quantity, ``accuracy-QUANTITY.nc`` and ``.svg`` are written
        to it.

    Returns
    -------
    list of Path

    Raises
    ------
    OutputError
        If the folder cannot be written to.
    """
    place = drafts.check_writable(folder)
    data = [store_accuracy(result, place) for result in results]
    drawn = [svg_of(result) for result in results]
    page, pictures = place / "accuracy.html", [path.with_suffix(".svg") for path in data]
    with ExitStack() as together:
        texts = (accuracy_page(results, drawn), *drawn)
        for path, text in zip((page, *pictures), texts, strict=True):
            together.enter_context(drafts.replacing(path)).write_text(text, encoding="utf-8")
    return [page, *(path for pair in zip(data, pictures, strict=True) for path in pair)]


def store_accuracy(result: xr.Dataset, folder: str | Path) -> Path:
    """Write the data of one quantity, ``accuracy-QUANTITY.nc``, and return its path."""
    path = Path(folder) / f"accuracy-{result.attrs['quantity']}.nc"
    with drafts.replacing(path) as draft:
        store.write_netcdf(result, draft)
    return path


def accuracy_page(results: Sequence[xr.Dataset], drawn: Sequence[str]) -> str:
    """Page of all quantities: table, sentence, figure.

    Parameters
    ----------
    results : sequence of Dataset
    drawn : sequence of str
        Their figures as SVG.

    Returns
    -------
    str
        HTML, self-contained.
    """
    from earthspin.views.page import page

    tables = [
        replace(accuracy_table(result), figure=svg, cost=result.attrs["sentence"])
        for result, svg in zip(results, drawn, strict=True)
    ]
    return page(
        "Error against run time",
        tables,
        lead="How much time each method needs for a quantity, and how large its error is.",
        note="The sentence below each table says which method to use. Filled markers are methods "
        "of this package; open markers are SciPy set by hand, or another library. The front joins "
        "the points for which no other has both a smaller error and a shorter run time.",
        footer=f"{results[0].attrs['source']}.",
    )
