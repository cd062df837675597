"""The README's numbers and its Python are those of the program."""

import re
from pathlib import Path

import numpy as np
import xarray as xr

from earthspin.views.precession import periods, rates
from tests.processes import printed

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def test_the_table_is_the_one_that_is_printed(precession_result: xr.Dataset) -> None:
    for row in rates(precession_result).rows:
        for cell in row:
            assert cell in README, cell


def test_the_box_of_periods_is_the_one_that_is_printed(precession_tree: xr.DataTree) -> None:
    first_page = (Path(__file__).parents[2] / "docs" / "index.md").read_text(encoding="utf-8")
    for row in periods(precession_tree).rows:
        assert " | ".join(row) in README
        assert " | ".join(row) in first_page


def test_the_python_runs_and_gives_the_same_numbers() -> None:
    (program,) = re.findall(r"```python\n(.*?)```", README, flags=re.DOTALL)
    lines = [line for line in program.splitlines() if line.strip()]
    assert len(lines) == 8
    numbers = [float(n) for n in re.findall(r"\d+\.\d+", printed(program))]
    assert np.min(np.abs(np.array(numbers) - 50.404315)) < 1e-5
    assert np.min(np.abs(np.array(numbers) - 25712.084)) < 0.005
