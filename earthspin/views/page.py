"""The HTML page of a report: one file that works offline."""

from __future__ import annotations

from collections.abc import Sequence

import xarray as xr
from jinja2 import Environment, PackageLoader, StrictUndefined

from earthspin.views.tables import run_times, tables_for, with_error


def page(result: xr.Dataset, drawings: Sequence[object] = ()) -> str:
    """Write the page.

    Parameters
    ----------
    result : Dataset
        Of the scene ``precession``.
    drawings : sequence of Drawing
        Figures with their captions.

    Returns
    -------
    str
        HTML, self-contained.
    """
    environment = Environment(
        loader=PackageLoader("earthspin.views"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    total = result.isel(perturber=-1)
    return environment.get_template("report.html.j2").render(
        result=result,
        period=with_error(total.precession_period, total.precession_period_error, "years"),
        tables=[(table, run_times(result, table.parts)) for table in tables_for(result)],
        drawings=drawings,
        square_last=True,
        parts=[
            {
                "name": str(name),
                "status": str(of.part_status.values),
                "reason": str(of.part_reason.values),
                "milliseconds": float(of.part_run_time) * 1e3,
            }
            for name, of in ((n, result.sel(part=n)) for n in result.part.values)
        ],
    )
