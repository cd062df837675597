"""Tables and figures of the pole: they say what the result says."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg

import earthspin
from earthspin.views import iau as of_iau
from earthspin.views import pole as of_pole
from earthspin.views.of_question import tables_for
from tests import shipped


@pytest.fixture(scope="module")
def pole() -> xr.Dataset:
    return earthspin.run("pole")


@pytest.fixture(scope="module")
def iau() -> xr.DataTree:
    return shipped.tree("iau")


def test_table_of_the_path(pole: xr.Dataset) -> None:
    (table,) = tables_for(pole)
    assert len(table.rows) == 6
    assert float(table.rows[2][3]) == pytest.approx(float(pole.psi[0, 2]), abs=1e-6)


def test_tables_of_the_comparison(iau: xr.DataTree) -> None:
    tables = tables_for(iau)
    assert len(tables) == 7
    budget = tables[0]
    assert float(budget.rows[-1][1]) == pytest.approx(float(iau.closure) * 1e5, abs=1e-3)
    assert len(tables[3].rows) == 30


def test_figures_draw_what_is_there(pole: xr.Dataset, iau: xr.DataTree) -> None:
    path = of_pole.plot_pole_path(pole)
    pieces = np.array(path.collections[0].get_segments())
    assert np.array_equal(pieces[1:, 0], pieces[:-1, 1])  # a line without gaps
    drawn = np.concatenate([pieces[:1, 0], pieces[:, 1]])
    assert len(drawn) == pole.sizes["time"]
    # The nutation is an ellipse of 6.9 by 9.2 arcsec.
    assert 6 < np.max(np.abs(drawn[:, 0])) < 9
    assert 8 < np.max(np.abs(drawn[:, 1])) < 12

    line = of_iau.plot_pole_residuals(iau).lines[0].get_ydata()
    assert np.array_equal(line, iau["residuals"].dpsi_sineps)

    ratio = of_iau.plot_nutation_ratio(iau)
    budget = of_iau.plot_budget(iau)
    for ax in (path, ratio, budget):
        FigureCanvasAgg(ax.figure)
        ax.figure.draw_without_rendering()
