"""Figures, CSV files and pages of parts of answers: a picture, a table, or one line."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from earthspin import EarthspinError
from earthspin.views.rendering import scene_page
from tests import shipped

#: Selections and reductions that users make; each takes a dimension of the answer.
PARTS: dict[str, Callable[[xr.Dataset, str, np.random.Generator], xr.Dataset]] = {
    "first": lambda data, dim, _: data.isel({dim: 0}),
    "last alone": lambda data, dim, _: data.isel({dim: slice(-1, None)}),
    "some": lambda data, dim, rng: data.isel({dim: np.sort(rng.permutation(data.sizes[dim])[:5])}),
    "shuffled": lambda data, dim, rng: data.isel({dim: rng.permutation(data.sizes[dim])}),
    "reversed": lambda data, dim, _: data.isel({dim: slice(None, None, -1)}),
    "none": lambda data, dim, _: data.isel({dim: slice(0)}),
    "mean": lambda data, dim, _: data.drop_vars(
        [name for name, array in data.items() if array.dtype.kind in "OUST"]
    ).mean(dim, keep_attrs=True),
    "joined": lambda data, dim, _: xr.concat(
        [data, data], dim, data_vars="minimal", coords="minimal", compat="override"
    ),
    "transposed": lambda data, dim, _: data.transpose(*[*data.sizes][::-1]),
    "scaled": lambda data, dim, _: data.map(
        lambda a: a * 1000.0 if a.dtype.kind == "f" else a, keep_attrs=True
    ),
    "one variable": lambda data, dim, rng: data[[rng.choice([*map(str, data.data_vars)])]],
}
SCENES = sorted(set(shipped.SCENES.values()) - {"iau"})


def drawn(data: xr.Dataset) -> None:
    for figure in data.earthspin.plot():
        figure.savefig(io.BytesIO(), format="png", dpi=40)


def outcome(call: Callable[[], Any]) -> str:
    """ "done", or the message of the refusal; every other exception is passed on."""
    try:
        call()
    except EarthspinError as refusal:
        words = str(refusal)
    else:
        words = "done"
    assert "\n" not in words
    return words


def check(seed: int, folder: Path) -> tuple[str, str]:
    """Draw a part of an answer, and write it as CSV and as a page."""
    rng = np.random.default_rng(seed)
    scene, part = SCENES[seed % len(SCENES)], rng.choice([*PARTS])
    whole = shipped.answer(scene)
    if not whole.sizes:
        return f"{scene} has no dimension", "done"
    data = PARTS[part](whole, str(rng.choice([*map(str, whole.sizes)])), rng)
    if rng.random() < 0.3:
        data.to_netcdf(folder / "part.nc")
        data = xr.load_dataset(folder / "part.nc")
    figure = outcome(lambda: drawn(data))
    table = outcome(lambda: data.earthspin.to_csv(folder / "part.csv", "all"))
    page = outcome(lambda: scene_page(data))
    return f"{scene}, {part}: {figure} | {table} | {page}", page if table == "done" else table


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(300))
def test_each_part_gives_a_picture_or_one_line(seed: int, tmp_path: Path) -> None:
    words, last = check(seed, tmp_path)
    assert last == "done", words
