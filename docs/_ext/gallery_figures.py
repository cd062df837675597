"""Rules of the gallery's pictures: one style, one figure in each part, axes that name their units.

``python docs/_ext/gallery_figures.py SCRIPT ...`` runs scripts, and prints a line of JSON
for each: its path and the faults of its figures.
"""

from __future__ import annotations

import json
import re
import runpy
import sys
from collections.abc import Iterator
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.dates import AutoDateFormatter, ConciseDateFormatter
from matplotlib.figure import Figure

from earthspin.views.drawing import STYLE

#: The package's own style, and what a figure on a page of a journal needs beside it.
JOURNAL: dict[str, Any] = {
    **STYLE,
    "figure.figsize": (6.4, 4.0),
    "figure.constrained_layout.use": True,
    "figure.dpi": 110,
    "lines.linewidth": 1.3,
    "axes.titlelocation": "left",
    "legend.fontsize": 8,
}

#: What a label says of the unit of its numbers, as a word of its own.
UNIT = re.compile(
    r"(?<![\w$])(m|cm|km|kg|s|h|d|day|days|yr|year|years|century|cycles|turns|TDB|deg|degrees|rad|1/s|"
    r"rad/s|rad²/s²|arcsec|mas|µas|ms|%|number|ppm|N\sm|m²/s²|kg\sm²|kg/m³|W/m²|GJ/m²)(?![\w$])"
)

#: Words of quantities without a unit.
RATIO = re.compile(r"\b(relative|over|flattening|Love number|eccentricity|climatic precession)\b")


def journal(_conf: object = None, _script: object = None) -> None:
    """Set the style of the gallery, and close all figures."""
    plt.close("all")
    plt.rcdefaults()
    plt.rcParams.update(JOURNAL)


def faults(figures: list[Figure], expected: int) -> list[str]:
    """List the faults of some figures, of which `expected` should be drawn."""
    if len(figures) != expected:
        return [f"{len(figures)} figures are drawn, not {expected}"]
    for figure in figures:
        figure.canvas.draw()
    return [fault for figure in figures for ax in figure.axes for fault in _faults_of(ax)]


def _faults_of(ax: Axes) -> Iterator[str]:
    for name, axis in _axes_with_numbers(ax):
        words = axis.get_label_text()
        if RATIO.search(words):
            continue
        if not UNIT.search(words):
            yield f"the label of {name}, {words!r}, has no unit"
        elif not words.endswith(")"):
            yield f"the label of {name}, {words!r}, has its unit not in brackets at its end"
    for line in ax.lines:
        drawn = ~np.ma.getmaskarray(line.get_ydata(orig=True))  # gaps on purpose are masked
        if not np.all(np.isfinite(np.asarray(line.get_xydata(), dtype=float)[drawn])):
            yield f"the line {line.get_label()!r} has NaN"
    for dots in ax.collections:
        if np.ma.isMaskedArray(offsets := dots.get_offsets()) and np.ma.is_masked(offsets):
            yield f"the dots {dots.get_label()!r} have NaN"


def _axes_with_numbers(ax: Axes) -> Iterator[tuple[str, Axis]]:
    """Axes whose ticks are labelled with numbers: names and dates speak for themselves."""
    if not ax.axison:
        return
    for name in ("x", "y", "z"):
        axis = getattr(ax, f"{name}axis", None)
        if axis is None or not axis.get_visible():
            continue
        if isinstance(axis.get_major_formatter(), AutoDateFormatter | ConciseDateFormatter):
            continue
        texts = [tick.get_text() for tick in axis.get_ticklabels() if tick.get_visible()]
        shown = [re.sub(r"[\s$\\{}^−+×.,°-]|mathdefault|times", "", text) for text in texts if text]
        if any(text.isdigit() for text in shown):
            yield name, axis


def one_figure(block: Any, variables: Any, conf: Any) -> str:
    """Save the picture of a part of a script, and refuse one with faults (for sphinx-gallery)."""
    from sphinx_gallery.scrapers import matplotlib_scraper

    figures = [plt.figure(number) for number in plt.get_fignums()]
    # the first block of a script has its imports
    if wrong := faults(figures, min(len(figures), 1)):
        raise ValueError(f"{variables['src_file']}: {'; '.join(wrong)}")
    page: str = matplotlib_scraper(block, variables, conf, dpi=110)
    return page


def main(scripts: list[str]) -> None:
    """Run each script with a style that is set anew, and print the faults of its figures."""
    plt.switch_backend("Agg")
    for script in scripts:
        journal()
        printed = StringIO()
        with redirect_stdout(printed):
            runpy.run_path(script, run_name="__main__")
        figures = [plt.figure(number) for number in plt.get_fignums()]
        parts = Path(script).read_text(encoding="utf-8").count("\n# %%\n")
        line = {"script": script, "faults": faults(figures, max(parts, 1))}
        print(json.dumps(line), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
