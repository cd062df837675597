"""Ensembles: one question for many members, in memory or in a store that can be resumed."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import xarray as xr

from earthspin.engine.drafts import as_path
from earthspin.engine.ensemble import Ensemble, with_members
from earthspin.engine.store import open as open_store
from earthspin.errors import OutputError
from earthspin.scenes import load_scene


def ensemble(
    question: Any,
    members: Any = None,
    *,
    seed: int | None = None,
    path: str | Path | None = None,
    client: object = None,
    block: int | None = None,
    impossible: Literal["refuse", "drop"] | None = None,
) -> xr.Dataset:
    """Answer one question for many members that differ in their inputs.

    Member 17 is the same alone, in any block and with any workers: it draws its own random numbers
    by the seed and its number.

    Parameters
    ----------
    question : str, Path, Question or answer
        As `load_scene` takes it.
    members : int, mapping, Dataset or path, optional
        How many: they are drawn from the published uncertainties of the bodies, or from what the
        question's own table ``members`` says. A mapping, as that table has it, of inputs to
        distributions: ``{"n": 1000, "body.j2": {"normal": [1.0826e-3, 1e-10]}}``, with ``normal``,
        ``uniform``, ``choice`` and ``grid``; the last two take words as well, such as the paths of
        orbits: ``{"orbit": {"grid": ["own", "la2010a.dat"]}}``. Or the values themselves: a Dataset
        of variables along `member`, named after the inputs, or the path of a file (.csv, .nc,
        .zarr) that holds one.
    seed : int, optional
        Of the random numbers; 0 if nothing says otherwise.
    path : str or Path, optional
        A Zarr store to write into, block by block; if the run is ended before all is written, the
        same call goes on from there.
    client : Client, int or str, optional
        Of ``dask.distributed``, whose workers make the blocks: a client, a number of workers to
        start here, or the address of a scheduler. A plain loop without.
    block : int, optional
        How many members are kept at a time; by their size if not given.
    impossible : str, optional
        What is done with members that cannot exist: ``"refuse"`` them all, or ``"drop"`` these.

    Returns
    -------
    Dataset
        The answer along `member`, whose coordinates hold the inputs; variables that no input
        touches stand once. ``ds.earthspin.quantiles()`` and ``ds.earthspin.sensitivity()`` sum it
        up. Opened from the store, if there is a `path`.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line; among it members that cannot exist.

    Examples
    --------
    >>> import earthspin
    >>> earths = earthspin.ensemble("precession", 1000)
    >>> total = earths.precession_period.sel(perturber="total")
    >>> print(f"{float(total.mean()):.1f} +/- {2 * float(total.std()):.3f} years")
    25712.1 +/- 0.016 years
    """
    request = with_members(load_scene(question), members, seed, impossible=impossible)
    if block is not None and (isinstance(block, bool) or not isinstance(block, int) or block < 1):  # type: ignore[redundant-expr]
        raise request.error("block", block, "give a whole number, 1 or more")
    if path is not None and as_path(path).suffix != ".zarr":
        raise OutputError(path, "its name does not end in .zarr", "an ensemble goes to Zarr")
    work = Ensemble(request, block=block)
    if path is None:
        return work.hold(client)
    answer = open_store(work.write(path, client))
    return answer.to_dataset() if isinstance(answer, xr.DataTree) else answer
