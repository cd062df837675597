"""Reductions of xarray work on every answer, in memory and in files."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from tests import shipped

REDUCTIONS = ("mean", "sum", "std", "median")
TOP = {"transverse_moment": 1, "axial_moment": 1.2, "weight_moment": 1.5, "theta": 0.7, "spin": 3}


#: Some numbers are infinite, such as the quality of a rigid body.
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning:numpy")


def reduced(answer: xr.Dataset) -> None:
    for dim in answer.sizes:
        for name in REDUCTIONS:
            assert dim not in getattr(answer, name)(dim).sizes
        assert not answer.mean().sizes


@pytest.mark.parametrize("scene", [*shipped.SCENES.values(), "wobble-ensemble"])
def test_every_section_is_reduced(scene: str) -> None:
    tree = shipped.tree(scene)
    for name in ["/", *tree.children]:
        if name != "plan":
            reduced(tree[name].to_dataset(inherit=False))


@pytest.mark.parametrize("ending", ["nc", "zarr"])
def test_a_file_is_reduced(tmp_path: Path, ending: str) -> None:
    top = earthspin.heavy_top([0, 1, 2], **TOP)
    path = earthspin.write(top, tmp_path / f"top.{ending}")
    with xr.open_dataset(path, **({"consolidated": True} if ending == "zarr" else {})) as stored:
        assert float(stored.mean("time").theta) == float(np.mean(top.theta.values))
        assert earthspin.run(stored).identical(top)
    assert earthspin.open(path).identical(top)


def test_an_ensemble_of_tops_is_reduced() -> None:
    spins = {"top.spin": {"grid": [3, 4]}}
    question = earthspin.Scene(compute="top", top=TOP | {"times": [0, 1]})
    tops = earthspin.ensemble(question, spins)
    assert tops.mean("time").theta.sizes == {"member": 2}
    assert "pattern" in tops.earthspin.to_frame("pattern")
