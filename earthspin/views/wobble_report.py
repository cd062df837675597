"""The wobble report: the ladder and the observed pole on one page, their data beside it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from earthspin import storage
from earthspin.progress import progress
from earthspin.scene.running import run
from earthspin.scene.spec import load_scene
from earthspin.views.tables import run_times, tables_for, with_error

if TYPE_CHECKING:
    import xarray as xr


def write_wobble_report(
    folder: str | Path, *, file: str = "c04", method: str = "burg", figures: bool = True
) -> tuple[list[xr.Dataset], list[Path]]:
    """Run the scenes ``wobble`` and ``polar-motion`` and write a page and the data.

    Parameters
    ----------
    folder : str or Path
        Gets ``wobble.html``, ``wobble.nc`` and ``polar-motion.nc``.
    file : str
        Table of polar motion.
    method : str
        As of `earthspin.fit_chandler`.
    figures : bool
        Without them nothing is drawn.

    Returns
    -------
    results : list of Dataset
        Ladder and polar motion.
    written : list of Path

    Raises
    ------
    EarthspinError
        Whatever is wrong; the folder's old files are then as they were.
    """
    place = storage.check_writable(folder)
    settings = {"polar_motion.file": file, "polar_motion.method": method}
    with progress("wobble report", 4) as advance:
        ladder = run("wobble")
        advance(1)
        pole = run(load_scene("polar-motion", settings))
        advance(1)
        drawn = _draw(ladder, pole) if figures else []
        advance(1)
        text = _page(ladder, pole, drawn)
        advance(1)
    written = [
        storage.write_text(text, place / "wobble.html"),
        storage.write(ladder, place / "wobble.nc"),
        storage.write(pole, place / "polar-motion.nc"),
    ]
    return [ladder, pole], written


def _draw(ladder: xr.Dataset, pole: xr.Dataset) -> list[Any]:
    from earthspin.views import wobble_figures as w

    return [w.rungs(ladder), w.amplitude_and_phase(pole), w.spectra(pole), w.polhode(pole)]


def _page(ladder: xr.Dataset, pole: xr.Dataset, drawings: list[Any]) -> str:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("earthspin.views"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    rigid, last = ladder.sel(rung="rigid"), ladder.isel(rung=-1)
    return environment.get_template("wobble.html.j2").render(
        result=ladder,
        title="The free wobble, explained and observed",
        rigid=with_error(rigid.period_solar, rigid.period_solar_error, "days"),
        last=with_error(last.period_solar, last.period_solar_error, "days"),
        seen=with_error(pole.chandler_period, pole.chandler_period_error, "days"),
        tables=[
            (table, run_times(of, table.parts)) for of in (ladder, pole) for table in tables_for(of)
        ],
        drawings=drawings,
        square_last=True,
        parts=[
            {
                "name": str(name),
                "status": "ran",
                "reason": str(of.part_reason.sel(part=name).values),
                "milliseconds": float(of.part_run_time.sel(part=name)) * 1e3,
            }
            for of in (ladder, pole)
            for name in of.part.values
            if str(of.part_status.sel(part=name).values) == "ran"
        ],
    )
