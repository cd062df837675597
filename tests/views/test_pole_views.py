"""Tables and figures of the pole: they say what the result says."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg

import earthspin
from earthspin.views import pole as of_iau
from earthspin.views import pole as of_pole
from earthspin.views.rendering import tables_for
from tests import shipped


@pytest.fixture(scope="module")
def pole() -> xr.Dataset:
    return earthspin.run("pole")


@pytest.fixture(scope="module")
def iau() -> xr.DataTree:
    return shipped.tree("iau")


def test_table_of_the_path(pole: xr.Dataset) -> None:
    head = "psi figure, arcsec"
    (table,) = (table for table in tables_for(pole) if head in table.headers)
    first, last = (row[table.headers.index(head)] for row in (table.rows[0], table.rows[-1]))
    for text, at in ((first, 0), (last, -1)):
        assert float(text.split("(")[0]) == pytest.approx(float(pole.psi[at, 2]), abs=1e-5)


def test_tables_of_the_comparison(iau: xr.DataTree) -> None:
    budget, *_ = tables_for(iau)
    assert float(budget.rows[-1][1]) == pytest.approx(float(iau.closure) * 1e5, abs=1e-3)


def test_figures_draw_what_is_there(pole: xr.Dataset, iau: xr.DataTree) -> None:
    path = of_pole.plot_pole_path(pole)
    drawn = path.lines[0].get_xydata()
    assert np.isfinite(drawn).all()  # a line without gaps
    assert len(drawn) == pole.sizes["time"]
    # The nutation is an ellipse of 6.9 by 9.2 arcsec.
    assert 6 < np.max(np.abs(drawn[:, 0])) < 9
    assert 8 < np.max(np.abs(drawn[:, 1])) < 12

    line = of_iau.plot_pole_residuals(iau).lines[0].get_ydata()
    assert np.array_equal(line, iau["residuals"].dX)

    ratio = of_iau.plot_nutation_ratio(iau)
    budget = of_iau.plot_budget(iau)
    assert 0 not in np.concatenate([line.get_xdata() for line in budget.lines[:2]])
    for ax in (path, ratio, budget):
        FigureCanvasAgg(ax.figure)
        ax.figure.draw_without_rendering()
