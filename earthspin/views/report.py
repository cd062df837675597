"""Reports with pages and data, one on precession and one on the wobble."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from os import PathLike
from pathlib import Path

import numpy as np
import xarray as xr

from earthspin._version import __version__
from earthspin.engine import atomic_writes, store
from earthspin.engine.variables import largest_of
from earthspin.progress import progress
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.scenes import load_scene, run, run_tree
from earthspin.views import drawing, precession, rotors, solids, torque
from earthspin.views.page import page
from earthspin.views.rendering import drawings_for, page_of, solids_for
from earthspin.views.result_contents import answer_of, body_of, section
from earthspin.views.tables import measured

HALF_A_YEAR = np.timedelta64(183, "D")
HALF_A_NODE_CYCLE = np.timedelta64(3400, "D")
MONTH = 27.32  # d
#: What each rung of the ladder adds to a rigid body.
ADDED = {
    "elastic": "an elastic mantle",
    "fluid-core": "a fluid core",
    "ocean": "an ocean",
    "anelastic": "anelasticity",
}


def write_report(
    folder: str | Path, *, ephemeris: str | PathLike[str] = "de421", figures: bool = True
) -> tuple[xr.DataTree, list[Path]]:
    """Run all computations of the precession report, and write its pages and data.

    Parameters
    ----------
    folder : str or Path
        ``index.html``, ``precession.nc`` and ``rotors.html``, where free rotors and tops can be
        turned and played, are written to it.
    ephemeris : str, path or Skyfield kernel
    figures : bool
        If false, nothing is drawn, and scenes that only figures need are not run.

    Returns
    -------
    tree : DataTree
        Answer to the scene ``precession``.
    written : list of Path

    Raises
    ------
    OutputError
        If the folder cannot be written. The data are written before anything is drawn.
    """
    place = atomic_writes.check_writable(folder)
    with progress("report", 4) as advance:
        tree = run_tree(load_scene("precession", {"ephemeris": ephemeris}))
        data = _write({place / "precession.nc": tree})
        advance(1)
        drawings = []
        if figures:
            circle, *others = drawings_for(tree)
            drawings = [circle, *_torques(tree, advance), *others]
        title = answer_of(tree).attrs["title"]
        links = [("Rotors and tops, to turn and to play", "rotors.html")] if figures else []
        pages = {place / "index.html": page_of(tree, title=title, drawings=drawings, links=links)}
        if figures:
            pages[place / "rotors.html"] = gallery_page()
        advance(1)
    return tree, [*_write(pages), *data]


def _torques(tree: xr.DataTree, advance: Callable[[int], None]) -> list[drawing.Drawing]:
    """Draw declination and torque over one year and over one period of the Moon's node."""
    epoch = np.datetime64(answer_of(tree).reference_epoch.values, "D")
    keys = load_scene(tree).keys()
    positions = {"ephemeris": keys["ephemeris"], "source": keys["source"]}

    def series(half_span: np.timedelta64, step: str) -> xr.Dataset:
        # Inside the window that has just been averaged over, so the kernel has it.
        span = str(epoch - half_span), str(epoch + half_span)
        return run(load_scene("torque", {**positions, "span": span, "step": step}))

    year, cycle = series(HALF_A_YEAR, "6 h"), series(HALF_A_NODE_CYCLE, "1 d")
    advance(1)
    title = "Declination and torque through a cycle of the Moon's node"
    chain = precession.chain_figure(tree, year)
    drawings = [chain, torque.torque_figure(cycle, title, smooth_days=MONTH)]
    advance(1)
    return drawings


def gallery() -> list[solids.Solid]:
    """Three-dimensional pictures for the report's page on rotors and tops, as a list."""
    prolate = SymmetricRotor(equatorial=1.0, difference=-0.6, speed=1.0, alpha=0.35)
    oblate = SymmetricRotor(equatorial=1.0, difference=0.8, speed=1.0, alpha=0.6)
    tops = ("top-wave", "top-cusp", "top-loop")
    return [
        *solids_for(run_tree("poinsot", ["poinsot"])),
        rotors.rolling_cones(prolate, "Rolling cones, prolate"),
        rotors.rolling_cones(oblate, "Rolling cones, oblate"),
        *(rotors.path_of_top(run_tree(name, ["turning"])) for name in tops),
    ]


def gallery_page() -> str:
    """HTML page with three-dimensional pictures of rotors and tops, for the precession report."""
    return page(
        "Rotors and tops",
        solids=gallery(),
        lead="How bodies rotate without torque, and how a heavy top moves (sections I.5 to I.7 of "
        'the source text, Appendix I, "Rigid Body Dynamics"). Every picture can be turned with '
        "the mouse or the arrow keys and played in time. Click a picture, then scroll to zoom.",
        footer=f"earthspin {__version__}.",
    )


def write_wobble_report(
    folder: str | Path, *, figures: bool = True
) -> tuple[list[xr.DataTree], list[Path]]:
    """Run all computations of the wobble report, and write its page and data.

    Parameters
    ----------
    folder : str or Path
        ``wobble.html``, ``wobble.nc`` and ``polar-motion.nc`` are written to it.
    figures : bool
        If false, nothing is drawn.

    Returns
    -------
    trees : list of DataTree
        Ladder and polar motion.
    written : list of Path

    Raises
    ------
    OutputError
        If the folder cannot be written. The data are written before anything is drawn.
    """
    place = atomic_writes.check_writable(folder)
    with progress("wobble report", 3) as advance:
        ladder = run_tree("wobble")
        advance(1)
        pole = run_tree("polar-motion")
        data = _write({place / "wobble.nc": ladder, place / "polar-motion.nc": pole})
        advance(1)
        title = "The free wobble, explained and observed"
        lead, drawings = _explained_and_observed(ladder, pole), None if figures else ()
        text = page_of(ladder, pole, title=title, lead=lead, drawings=drawings)
        advance(1)
    return [ladder, pole], [*_write({place / "wobble.html": text}), *data]


def _explained_and_observed(ladder: xr.DataTree, pole: xr.DataTree) -> str:
    """Sentence with the rigid, computed and observed periods of the free wobble."""
    answer = answer_of(ladder)
    rigid, top = measured(answer.sel(rung="rigid"), "period_solar", "days"), answer.isel(rung=-1)
    last = measured(top, "period_solar", "days")
    largest = largest_of(answer.attrs["neglected"])
    left_out = f", without {largest[0]} ({largest[1]:g} {largest[2]})" if largest else ""
    *others, other = (ADDED[rung] for rung in answer.rung.values if rung in ADDED)
    return (
        f"If {body_of(answer)} were rigid, its free wobble would have a period of {rigid}; with "
        f"{', '.join(others)} and {other}, the computed period is {last}{left_out}. The "
        f"observed period is {measured(section(pole, 'chandler'), 'chandler_period', 'days')}."
    )


def _write(files: Mapping[Path, str | xr.DataTree]) -> list[Path]:
    """Write pages and data files, and return the paths; if one file fails, none is replaced."""
    with ExitStack() as together:
        for path, content in files.items():
            draft = together.enter_context(atomic_writes.replacing(path))
            if isinstance(content, str):
                draft.write_text(content, encoding="utf-8")
            else:
                store.write_netcdf(content, draft)
    return [*files]
