"""The precession report: several scenes that share their parts, one page, one file."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin import storage
from earthspin.progress import progress
from earthspin.scene.running import Session, run
from earthspin.scene.spec import load_scene

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr

    from earthspin.scene.spec import Scene
    from earthspin.views.drawing import Drawing

HALF_A_YEAR = np.timedelta64(183, "D")
HALF_A_NODE_CYCLE = np.timedelta64(3400, "D")


def write_report(
    folder: str | Path, *, ephemeris: Any = "de421", figures: bool = True
) -> tuple[xr.Dataset, list[Path]]:
    """Run the scenes of the report and write the page and the data.

    Parameters
    ----------
    folder : str or Path
        Gets ``index.html``, ``precession.nc``, and ``rotors.html``, where free rotors and tops
        can be turned and played.
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
    from earthspin.views.page import precession_page, solids_page
    from earthspin.views.rotor_solids import gallery

    place = storage.check_writable(folder)
    session = Session()
    with progress("report", 4) as advance:
        result = run(load_scene("precession", {"ephemeris": ephemeris}), session=session)
        advance(1)
        drawn = _draw(result, ephemeris, session, advance) if figures else []
        pages = {"index.html": precession_page(result, drawn)}
        if figures:
            pages["rotors.html"] = solids_page(*gallery())
    with ExitStack() as together:
        for name, text in pages.items():
            draft = together.enter_context(storage.replacing(place / name))
            draft.write_text(text, encoding="utf-8")
        storage.write_netcdf(
            result, together.enter_context(storage.replacing(place / "precession.nc"))
        )
    return result, [*(place / name for name in pages), place / "precession.nc"]


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


def scene_views(result: xr.Dataset) -> str:
    """Page of one scene: its tables, figures and, where there are any, its solids."""
    from earthspin.views import figures, pole_figures, rotor_solids, wobble_figures
    from earthspin.views.page import precession_page, scene_page

    question = result.attrs["compute"]
    if question == "precession":
        return precession_page(result, [figures.convergence_of_windows(result)])
    if question == "free-rotor":
        solids = rotor_solids.of_free_rotor(result) if "polhode" in result else []
        return scene_page(result, figures.free_rotor_drawings(result), solids)
    if question == "top":
        return scene_page(result, figures.top_drawings(result), [rotor_solids.path_of_top(result)])
    draw: dict[str, Callable[[], list[Drawing]]] = {
        "torque": lambda: [figures.torque_through(result, "Declination and torque")],
        "pole": lambda: pole_figures.pole_drawings(result),
        "iau": lambda: pole_figures.iau_drawings(result),
        "wobble": lambda: [wobble_figures.rungs(result)],
        "polar-motion": lambda: [
            wobble_figures.amplitude_and_phase(result),
            wobble_figures.spectra(result),
            wobble_figures.polhode(result),
        ],
    }
    return scene_page(result, draw[question]() if question in draw else [])
