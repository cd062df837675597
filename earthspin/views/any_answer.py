"""Figure of any data, from labels, units and errors alone."""

from __future__ import annotations

import re

import numpy as np
import xarray as xr

from earthspin.views import drawing, tables
from earthspin.views.drawing import CYCLE, Drawing

#: Dimensions over which nothing is drawn.
_AXES = ("component", "quaternion")
#: Largest number of panels.
MOST_PANELS = 6


@drawing.style()
def any_drawing(data: xr.Dataset) -> list[Drawing]:
    """Draw variables over the dimension that most of them have; none if all are single numbers."""
    panels: dict[str, dict[str, list[tables.DataColumn]]] = {}
    for name in tables.main_variables(data):
        for dim, column in tables.data_columns(data, name):
            if (
                dim not in _AXES
                and data.sizes.get(dim, 0) > 1
                and np.isfinite(column.numbers).any()
            ):
                panels.setdefault(dim, {}).setdefault(name, []).append(column)
    if not panels:
        return []
    dim, shown = max(panels.items(), key=lambda item: len(item[1]))
    figure, rows = drawing.stacked(min(len(shown), MOST_PANELS), 1.0 + 1.6 * len(shown))
    labels = data[dim].values
    x = np.arange(labels.size) if labels.dtype.kind not in "Mfiu" else labels
    for ax, (name, columns) in zip(rows, shown.items(), strict=False):
        for colour, column in zip(CYCLE, columns, strict=False):
            errors = np.zeros(x.size) if column.errors is None else column.errors.values
            words = drawing.literal(column.head)
            if x is labels:
                drawing.band(ax, x, column.numbers, errors, colour, lw=1.0, label=words)
            else:
                bars = ax.errorbar(x, column.numbers, errors, fmt="o", capsize=3, color=colour)
                bars.set_label(words)
        ax.set_ylabel(_label(data[name]))
        if len(columns) > 1:
            ax.legend(fontsize=7)
    if x is not labels:
        drawing.rungs(rows[-1], labels.tolist())
    elif labels.dtype.kind == "M":
        drawing.few_dates(rows[-1])
    rows[-1].set_xlabel(_label(data[dim]))
    return [Drawing(str(data.attrs.get("title", "Data")), "Bands are 95 % half-widths.", figure)]


def _label(variable: xr.DataArray) -> str:
    """Label of an axis, with the unit in brackets."""
    return drawing.literal(re.sub(", (.*)", r" (\1)", tables.label(variable)))
