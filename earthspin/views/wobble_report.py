"""The wobble report: the ladder and the observed pole on one page, their data beside it."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from earthspin import storage
from earthspin.progress import progress
from earthspin.scene.running import run
from earthspin.scene.spec import load_scene
from earthspin.views.tables import with_error

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
    names = ("wobble.html", "wobble.nc", "polar-motion.nc")
    with ExitStack() as together:
        page, *data = (together.enter_context(storage.replacing(place / name)) for name in names)
        page.write_text(text, encoding="utf-8")
        for result, draft in zip((ladder, pole), data, strict=True):
            storage.write_netcdf(result, draft)
    return [ladder, pole], [place / name for name in names]


def _draw(ladder: xr.Dataset, pole: xr.Dataset) -> list[Any]:
    from earthspin.views import wobble_figures as w

    return [w.rungs(ladder), w.amplitude_and_phase(pole), w.spectra(pole), w.polhode(pole)]


def _page(ladder: xr.Dataset, pole: xr.Dataset, drawings: list[Any]) -> str:
    from earthspin.views.page import results_page

    rigid, last = ladder.sel(rung="rigid"), ladder.isel(rung=-1)
    rigid_days = with_error(rigid.period_solar, rigid.period_solar_error, "days")
    last_days = with_error(last.period_solar, last.period_solar_error, "days")
    seen = with_error(pole.chandler_period, pole.chandler_period_error, "days")
    return results_page(
        "The free wobble, explained and observed",
        f"Rigid, the {ladder.attrs['body'].capitalize()} would wobble in {rigid_days}; as it "
        f"yields, with its core and its seas, in {last_days}. Observed: {seen}.",
        [ladder, pole],
        drawings,
    )
