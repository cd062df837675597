"""HTML pages: one file each that works offline."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import xarray as xr
from jinja2 import Environment, PackageLoader, StrictUndefined

from earthspin._version import __version__
from earthspin.scene.planning import NOT_NEEDED
from earthspin.views.drawing import Drawing
from earthspin.views.tables import run_times, tables_for, with_error

if TYPE_CHECKING:
    from earthspin.views.solids import Solid


def precession_page(result: xr.Dataset, drawings: Sequence[Drawing]) -> str:
    """Page of the precession report.

    Parameters
    ----------
    result : Dataset
        Of the scene ``precession``.
    drawings : sequence of Drawing

    Returns
    -------
    str
        HTML, self-contained.
    """
    total = result.isel(perturber=-1)
    period = with_error(total.precession_period, total.precession_period_error, "years")
    pullers = " and ".join(name.capitalize() for name in result.attrs["perturbers"].split())
    return scene_page(
        result,
        drawings,
        lead=f"The axis of the {result.attrs['body'].capitalize()} goes once round in {period} "
        f"under the pull of {pullers} on its bulge.",
    )


def scene_page(
    result: xr.Dataset,
    drawings: Sequence[Drawing] = (),
    solids: Sequence[Solid] = (),
    lead: str = "",
) -> str:
    """Page of any result: its tables, figures and solids, and what ran for it.

    Parameters
    ----------
    result : Dataset
    drawings : sequence of Drawing
    solids : sequence of Solid
    lead : str
        A sentence at the head.

    Returns
    -------
    str
        HTML, self-contained.
    """
    return results_page(result.attrs["title"], lead, [result], drawings, solids)


def results_page(
    title: str,
    lead: str,
    results: Sequence[xr.Dataset],
    drawings: Sequence[Drawing] = (),
    solids: Sequence[Solid] = (),
) -> str:
    """Page of several results together.

    Parameters
    ----------
    title, lead : str
    results : sequence of Dataset
    drawings : sequence of Drawing
    solids : sequence of Solid

    Returns
    -------
    str
        HTML, self-contained.
    """
    first = results[0].attrs
    footer = f"{first['source']}."
    if "ephemeris" in first:
        footer += f" Kernel {first['ephemeris']}, SHA-256 {first['ephemeris_sha256']}."
    if first["references"]:
        footer += f" Numbers of the bodies: {first['references']}."
    return _render(
        title=title,
        lead=lead,
        note="Every error is the half-width of a 95 % interval. Under each table stand the parts "
        "that made it and their run times.",
        footer=footer,
        tables=[(t, run_times(of, t.parts)) for of in results for t in tables_for(of)],
        drawings=drawings,
        solids=solids,
        parts=[row for of in results for row in _plan_rows(of, all_parts=len(results) == 1)],
    )


def _plan_rows(result: xr.Dataset, all_parts: bool) -> list[dict[str, Any]]:
    """What ran, and, on a page of one result, what was left out for a reason of its own."""
    rows = [
        {
            "name": str(name),
            "status": str(of.part_status.values),
            "reason": str(of.part_reason.values),
            "milliseconds": float(of.part_run_time) * 1e3,
        }
        for name, of in ((n, result.sel(part=n)) for n in result.part.values)
    ]
    return [
        row for row in rows if row["status"] == "ran" or (all_parts and row["reason"] != NOT_NEEDED)
    ]


def solids_page(title: str, lead: str, solids: Sequence[Solid]) -> str:
    """Page of solids alone.

    Parameters
    ----------
    title, lead : str
    solids : sequence of Solid

    Returns
    -------
    str
        HTML, self-contained.
    """
    return _render(
        title=title,
        lead=lead,
        note="",
        footer=f"earthspin {__version__}.",
        tables=[],
        drawings=[],
        solids=solids,
        parts=[],
    )


def _render(**content: Any) -> str:
    loader = PackageLoader("earthspin.views")
    environment = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    script = loader.get_source(environment, "solid.js")[0]
    return environment.get_template("page.html.j2").render(script=script, **content)
