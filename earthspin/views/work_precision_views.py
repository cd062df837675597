"""Tables, figures and pages that compare the error and run time of methods."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from earthspin.engine import drafts, store
from earthspin.rounded import duration, plain, shown_unit
from earthspin.units import FloatArray
from earthspin.views.drawing import CYCLE, Axes, Drawing, axes, figure_of, style
from earthspin.views.page import page, write_texts
from earthspin.views.table import Table, along
from earthspin.views.terminal import WIDTH, Terminal

#: Colours of methods, and markers.
_COLOURS = (*CYCLE, "#7F3C8D", "#666666")
#: Below this ratio of errors the axis shows more than powers of ten.
FEW_DECADES = 100
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">")


def accuracy_table(result: xr.Dataset) -> Table:
    """Table of the error and run time of all methods, with a row for each tested accuracy.

    Parameters
    ----------
    result : Dataset
        As `earthspin.accuracy` gives it.
    """
    unit = _unit(result)
    rows = []
    for name, method in along(result, "method"):
        whose = "" if method.ours else " (other)"
        for number in range(int(method.settings)):
            point = method.isel(rung=number)
            flags = {"front": point.pareto, "at the reference's floor": point.at_floor}
            row = (
                "" if number else f"{name}{whose}",
                str(point.setting.values),
                plain(float(point.error)),
                duration(float(point.run_time)),
                duration(float(point.run_time_spread)),
                f"{int(point.evaluations):,}",
                ", ".join(words for words, flag in flags.items() if flag),
            )
            rows.append(row)
    error = f"error,{unit}" if unit else "error"
    headers = ("method", "setting", error, "run time", "±", "calls", "")
    return Table(result.attrs["quantity"], headers, rows, _note(result), words=(0, 1, 6))


def _note(result: xr.Dataset) -> str:
    """Note below a table: the problem, the reference solution, and methods that exceed bounds."""
    unit = _unit(result)
    words = [
        f"{_capital(result.attrs['problem'])}.",
        f"Reference: {result.attrs['reference']}; good to "
        f"{plain(result.attrs['reference_error'])}{unit}.",
        "Run times are medians, ± half their range.",
    ]
    if result.attrs["skipped"]:
        words.append(f"Left out: {result.attrs['skipped']}.")
    for name, method in along(result.isel(method=~result.holds.values), "method"):
        error, bound = plain(float(method.error[-1])), plain(float(method.bound))
        words.append(f"FAILS: {name}, error {error}, bound {bound}{unit}.")
    return " ".join(words)


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _unit(result: xr.Dataset) -> str:
    """Unit of the measured error with a space before it, as text."""
    return shown_unit(str(result.error.attrs["units"]))


def print_accuracy(results: Sequence[xr.Dataset]) -> None:
    """Print the table of error and run time, and the recommended method, for each quantity."""
    console = Terminal(WIDTH + 10)
    for result in results:
        console.print_table(accuracy_table(result))
        console.print(f"\n{result.attrs['sentence']}\n", markup=False)


# --- figure ------------------------------------------------------------------------------------


def plot_accuracy(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Draw error over run time on logarithmic axes; filled markers are methods of this package.

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

    ax = axes(ax, 7.5, 4.4)
    unit = _unit(result)
    for number, name in enumerate(result["method"].values):
        row = result.isel(method=number, rung=slice(0, int(result.settings[number])))
        colour, ours = _COLOURS[number % len(_COLOURS)], bool(row.ours)
        time, error, spread = row.run_time.values, row.error.values, row.run_time_spread.values
        ax.errorbar(
            time, error, xerr=[np.minimum(spread, 0.9 * time).tolist(), spread.tolist()],
            fmt=_MARKERS[number % len(_MARKERS)], ms=5.5, mfc=colour if ours else "white",
            mec=colour, color=colour, elinewidth=0.8, alpha=0.9, label=str(name), zorder=3,
        )  # fmt: skip
        ax.step(
            *_front(time, error), where="post", color=colour, lw=0.8, alpha=0.9,
            ls="-" if ours else ":", zorder=2,
        )  # fmt: skip
    ax.set(xscale="log", yscale="log", xlabel="run time (s)")
    ax.set_ylabel(f"error ({unit.strip()})" if unit else "relative error")
    _draw_fronts(result, ax)
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
    """Select the measurements that no other beats in both run time and error (Pareto front)."""
    order = np.lexsort((error, time))
    time, error = time[order], error[order]
    kept = error < np.concatenate([[np.inf], np.minimum.accumulate(error)[:-1]])
    return time[kept], error[kept]


def _draw_fronts(result: xr.Dataset, ax: Axes) -> None:
    """Draw the best combinations of error and run time (Pareto front) as steps, for each task."""
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
    """SVG text of the figure of error over run time for one quantity."""
    with style():
        ax = plot_accuracy(result)
        ax.set_title(_capital(result.attrs["quantity"].replace("-", " ")), loc="left")
        return Drawing(result.attrs["quantity"], result.attrs["sentence"], figure_of(ax)).svg


# --- files -------------------------------------------------------------------------------------


def write_accuracy(results: Sequence[xr.Dataset], folder: str | Path) -> list[Path]:
    """Write the data and the figure of each quantity, and one HTML page of all quantities.

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
    texts = {place / "accuracy.html": accuracy_page(results, drawn)}
    for path, svg in zip(data, drawn, strict=True):
        texts[path.with_suffix(".svg")] = svg
    page, *pictures = write_texts(texts)
    return [page, *(path for pair in zip(data, pictures, strict=True) for path in pair)]


def store_accuracy(result: xr.Dataset, folder: str | Path) -> Path:
    """Write the measurements of one quantity to a NetCDF file, and return its path."""
    path = Path(folder) / f"accuracy-{result.attrs['quantity']}.nc"
    with drafts.replacing(path) as draft:
        store.write_netcdf(result, draft)
    return path


def accuracy_page(results: Sequence[xr.Dataset], drawn: Sequence[str]) -> str:
    """HTML page with table, recommendation and figure of error and run time for each quantity.

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
