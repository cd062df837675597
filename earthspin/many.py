"""Ensembles: answers to one question for many members (sets of inputs)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr

from earthspin.engine import blocks
from earthspin.engine.drafts import as_path
from earthspin.engine.ensemble import Ensemble
from earthspin.engine.members import LARGEST_COUNT, LARGEST_SEED, Members
from earthspin.engine.question import Question
from earthspin.engine.store import open as open_store
from earthspin.errors import OutputError, Where
from earthspin.scenes import load_scene
from earthspin.units import Whole, is_whole


def ensemble(
    question: Any,
    members: Any = None,
    *,
    seed: int | None = None,
    rng: int | np.random.Generator | np.random.SeedSequence | None = None,
    path: str | Path | None = None,
    client: object = None,
    block: int | None = None,
    impossible: Literal["refuse", "drop"] | None = None,
) -> xr.Dataset:
    """Answer one question (computation) for many members, which differ in their inputs.

    The random numbers of a member depend only on the seed and on the number of the member, not on
    blocks or workers.

    Parameters
    ----------
    question : str, Path, Question or answer
        See `load_scene`.
    members : int, mapping, Dataset or path, optional
        A number of members: they are drawn from the published uncertainties of the bodies, or as
        the table ``members`` of the question says. A mapping of inputs to distributions:
        ``{"n": 1000, "body.j2": {"normal": [1.0826e-3, 1e-10]}}``, with ``normal``, ``uniform``,
        ``choice`` and ``grid``; the last two also take words, such as the paths of orbits:
        ``{"orbit": {"grid": ["own", "la2010a.dat"]}}``. Or values: a Dataset of variables along
        `member`, named after the inputs, or the path of a file (.csv, .nc, .zarr) with one.
    seed : int, optional
        Seed of the random numbers; 0 by default.
    rng : int, Generator or SeedSequence, optional
        Instead of `seed`: a seed, or a source of random numbers of NumPy, from which a seed is
        drawn (SPEC 7).
    path : str or Path, optional
        Zarr store to write, block by block; after an interruption the same call resumes it.
    client : Client, int or str, optional
        Cluster of ``dask.distributed`` that computes the blocks: a client, a number of workers to
        start here, or the address of a scheduler. Without it the blocks are computed here.
    block : int, optional
        Number of members that are computed and stored at a time; chosen by their size by default.
    impossible : str, optional
        Treatment of impossible members: ``"refuse"`` the ensemble, or ``"drop"`` them.

    Returns
    -------
    Dataset
        Answer along `member`, with the inputs as coordinates; variables that depend on no input
        have no dimension `member`. ``ds.earthspin.quantiles()`` and
        ``ds.earthspin.sensitivity()`` summarise it. With `path` it is opened from the store.

    Raises
    ------
    EarthspinError
        If an input is wrong or a member is not possible; the message is one line.

    Examples
    --------
    >>> import earthspin
    >>> earths = earthspin.ensemble("precession", 1000)
    >>> total = earths.precession_period.sel(perturber="total")
    >>> print(f"{float(total.mean()):.1f} +/- {2 * float(total.std()):.3f} years")
    25712.1 +/- 0.016 years
    """
    loaded = load_scene(question)
    if rng is not None:
        if seed is not None:
            raise loaded.error("rng", rng, "give either seed or rng")
        seed = _seed_from(rng)
    request = _with_members(loaded, members, {"seed": seed, "impossible": impossible})
    if block is not None:
        block = Whole(1, LARGEST_COUNT).read(block, request.where("block"))
    if path is not None and as_path(path).suffix != ".zarr":
        raise OutputError(path, "its name does not end in .zarr", "an ensemble goes to Zarr")
    work = Ensemble(request, block=block, in_memory=path is None)
    if path is None:
        return work.hold(client)
    answer = open_store(blocks.write(work, path, client=client))
    return answer.to_dataset() if isinstance(answer, xr.DataTree) else answer


def _with_members(question: Question, members: object, settings: dict[str, Any]) -> Question:
    """Return a question with changed members; a whole number changes only how many there are."""
    own, where = question.members, question.where("members")
    request: Members | None = own if members is None else Members.read(members, where)
    if request is None:
        raise where.error(None, "give the number of members, a file or a table")
    if own is not None and is_whole(members):
        request = replace(own, n=request.n)
    changes = {name: value for name, value in settings.items() if value is not None}
    checked = Members.read(changes, where)
    changes = {name: getattr(checked, name) for name in changes}
    return question.replace(members=replace(request, **changes))


def _seed_from(rng: int | np.random.Generator | np.random.SeedSequence) -> int:
    """Return a given integer seed, or draw one from a NumPy generator or seed sequence."""
    if isinstance(rng, (np.random.Generator, np.random.SeedSequence)):
        return int(np.random.default_rng(rng).integers(2**32))
    others = ", or a Generator or SeedSequence of NumPy"
    return Whole(0, LARGEST_SEED, others).read(rng, Where("rng"))
