"""Tables and work-precision diagrams of measured ladders."""

from collections.abc import Iterable, Mapping

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from earthspin.number_text import plain, shown_unit
from earthspin.views.drawing import BLUE, GREEN, ORANGE, PINK, RED, SKY, Axes, Drawing, power_of_ten
from tests.benchmarks.accuracy.ladder import Ladder

#: Colours and markers of methods of the package (filled), and of others (open).
OURS = (BLUE, GREEN, SKY, "#5B3F9E", "#1B4F72", "#7FB069")
OTHERS = (RED, ORANGE, PINK, "0.45", "#8C564B", "0.2")
MARKERS = "osD^vP"
KEY = "filled: earthspin\nopen: other methods and libraries"
#: Methods in the picture of the README, by ladder.
PANELS = {
    "torque": (
        *("nutation from nodes, 2000A", "nutation from nodes, 2000B", "nutation at each epoch"),
        *("torque_series(), first and later", "Skyfield, radec of date"),
        *("ERFA, nutation IAU 2000B", "mean equator, no nutation"),
    ),
    "pole": (
        *("windows of 8 d", "windows of 16 d", "windows of 32 d", "pole(), first and later"),
        *("SciPy RK45", "SciPy LSODA", "SciPy DOP853", "ERFA, IAU 2006/2000A"),
    ),
    "precession": (
        *("hann window", "sin4 window", "blackman-harris window"),
        *("precession(), first and later", "plain mean over years"),
    ),
}


def table(ladder: Ladder, rows: pd.DataFrame) -> str:
    """Table in MyST of the settings that lead and the finest of each method, and a note."""
    unit = shown_unit(ladder.unit)
    lines = [
        f"| method | setting | error{unit and ','}{unit} | run time | evaluations | |",
        "| --- | --- | ---: | ---: | ---: | --- |",
    ]
    finest = rows.groupby("method", sort=False).tail(1).index
    for row in rows[rows.leads | rows.index.isin(finest)].itertuples():
        name = row.method if row.method in ladder.bounds else f"{row.method} (other)"
        lines.append(
            f"| {name} | {row.setting} | {plain(row.error)} | {plain(row.seconds)} s "
            f"| {row.evaluations:,} | {'front' if row.leads else ''} |"
        )
    problem = ladder.problem[0].upper() + ladder.problem[1:]
    note = f"{problem}. Reference: {ladder.reference}; error {plain(ladder.floor)}{unit}."
    return "\n".join([*lines, "", note, ""])


def draw(ax: Axes, ladder: Ladder, rows: pd.DataFrame, methods: Iterable[str]) -> None:
    """Draw error over run time, with filled markers for methods of the package."""
    counts = [0, 0]
    for method in methods:
        own = method in ladder.bounds
        number, points = counts[own], rows[rows.method == method].sort_values("seconds")
        best = points[points.error <= points.error.cummin()]
        colour, face = (OURS[number], OURS[number]) if own else (OTHERS[number], "white")
        look = {"color": colour, "mfc": face, "marker": MARKERS[number], "ms": 5, "lw": 1}
        ax.plot(best.seconds, best.error, "-" if own else "--", label=method, **look)
        ax.plot(points.seconds, points.error, ls="", **look)
        counts[own] += 1
    ax.set(xscale="log", yscale="log")
    ax.set_title(ladder.title, loc="left")
    ax.set_ylabel("relative error" if ladder.unit == "1" else f"error ({ladder.unit})")
    ax.xaxis.set_major_formatter(power_of_ten)
    ax.yaxis.set_major_formatter(power_of_ten)
    if rows.error.max() < 100 * rows.error.min():
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter("")
    ax.yaxis.set_minor_locator(NullLocator())
    legend = {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0), "borderaxespad": 0}
    ax.legend(**legend, fontsize=8, title_fontsize=8, alignment="left", title=KEY)


def svg(ladder: Ladder, rows: pd.DataFrame) -> str:
    """SVG text of the diagram of one ladder."""
    figure = Figure(figsize=(7.5, 3.8), layout="constrained")
    ax = figure.add_subplot()
    draw(ax, ladder, rows, ladder.runs)
    ax.set_xlabel("run time (s)")
    return Drawing(ladder.title, ladder.problem, figure).svg


def picture(ladders: Mapping[str, Ladder], measured: Mapping[str, pd.DataFrame]) -> Figure:
    """Picture of the README: torque, pole and precession, each beside other methods."""
    figure = Figure(figsize=(8, 7.4), layout="constrained")
    panels = figure.subplots(3, 1, sharex=True)
    for ax, (quantity, methods) in zip(panels, PANELS.items(), strict=True):
        draw(ax, ladders[quantity], measured[quantity], methods)
        if ax is not panels[0]:
            ax.get_legend().set_title(None)
    panels[-1].set_xlabel("run time (s)")
    return figure
