"""The page on ensembles: members that differ in orbits, as one types them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

PAGE = Path(__file__).parents[2] / "docs" / "ensembles.md"
CELL = re.compile(r"^```\{code-cell\} ipython3\n((?:.*\n)*?)```$", flags=re.MULTILINE)


def test_orbits_beside_one_another(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    section = PAGE.read_text(encoding="utf-8").split("## Orbits, kernels, models\n")[1]
    names: dict[str, Any] = {}
    exec("import earthspin", names)
    for cell in CELL.findall(section.split("\n## ")[0]):
        exec(compile(cell, str(PAGE), "exec"), names)
    many, shares = names["many"], names["shares"]
    assert many.orbit.values.tolist() == ["own", "still.npz"] * 3
    still = many.obliquity.sel(member=many.orbit == "still.npz")
    # "keeps its value, whatever the tides": a plane that does not move (measured: 1e-8 deg)
    np.testing.assert_allclose(still, 23.43926, rtol=0, atol=1e-4)
    assert float(np.ptp(still.values)) < 1e-6
    share = shares.obliquity_share.sel(epoch=-75_000)
    # "nearly all of the spread"
    assert float(share.sel(input="orbit")) > 0.999
    assert float(share.sel(input="tides")) == pytest.approx(0, abs=1e-3)
