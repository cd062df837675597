"""The precession report: several scenes that share their parts, one page, one file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin import storage
from earthspin.progress import progress
from earthspin.scene.running import Session, run
from earthspin.scene.spec import load_scene

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene

HALF_A_YEAR = np.timedelta64(183, "D")
HALF_A_NODE_CYCLE = np.timedelta64(3400, "D")


def write_report(
    folder: str | Path, *, ephemeris: Any = "de421", figures: bool = True
) -> tuple[xr.Dataset, list[Path]]:
    """Run the scenes of the report and write the page and the data.

    Parameters
    ----------
    folder : str or Path
        Gets ``index.html`` and ``precession.nc``.
    ephemeris : str, path or Skyfield kernel
    figures : bool
        Without them, nothing is drawn and the scenes behind them are not run.

    Returns
    -------
    result : Dataset
        Of the scene ``precession``.
    written : list of Path

    Raises
    ------
    EarthspinError
        Whatever is wrong; the folder's old files are then as they were.
    """
    from earthspin.views.page import page

    place = storage.check_writable(folder)
    session = Session()
    with progress("report", 4) as advance:
        result = run(load_scene("precession", {"ephemeris": ephemeris}), session=session)
        advance(1)
        drawn = _draw(result, ephemeris, session, advance) if figures else []
        text = page(result, drawn)
    paths = [place / "index.html", place / "precession.nc"]
    with storage.replacing(paths[0]) as html, storage.replacing(paths[1]) as data:
        html.write_text(text, encoding="utf-8")
        storage.write_netcdf(result, data)
    return result, paths


def _draw(result: xr.Dataset, ephemeris: Any, session: Session, advance: Any) -> list[Any]:
    """Run the scenes behind the figures and draw them."""
    from earthspin.views import figures

    epoch = np.datetime64(result.reference_epoch.values, "D")

    def series(half_span: np.timedelta64, step: str) -> Scene:
        span = str(epoch - half_span), str(epoch + half_span)
        return load_scene("torque", {"ephemeris": ephemeris, "span": span, "step": step})

    # Both spans lie inside the window that has just been averaged over, so the kernel has them.
    year = series(HALF_A_YEAR, "6 h")
    cycle = series(HALF_A_NODE_CYCLE, "1 d")
    through_year = run(year, session=session)
    through_cycle = run(cycle, session=session)
    advance(1)
    drawn = [
        figures.torque_through(through_year, "A year of declination and torque"),
        figures.torque_through(through_cycle, "A turn of the Moon's node", smooth_days=27.32),
    ]
    advance(1)
    drawn += [figures.convergence_of_windows(result), figures.circle_of_pole(result)]
    advance(1)
    return drawn
