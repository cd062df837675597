"""Tables and figures of the pole: they say what the result says."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg

import earthspin
from earthspin.views import pole_figures
from earthspin.views.tables import tables_for


@pytest.fixture(scope="module")
def pole() -> xr.Dataset:
    return earthspin.run("pole")


@pytest.fixture(scope="module")
def iau() -> xr.Dataset:
    return earthspin.compare_iau("1990-01-01", "2010-01-01", "20 d")


def test_table_of_the_path(pole: xr.Dataset) -> None:
    (table,) = tables_for(pole)
    assert len(table.rows) == 6
    assert float(table.rows[2][3]) == pytest.approx(float(pole.psi[0, 2]), abs=1e-6)


def test_tables_of_the_comparison(iau: xr.Dataset) -> None:
    titles = [table.title for table in tables_for(iau)]
    assert titles == [
        "Rates at J2000.0, effect by effect",
        "Our pole less that of IAU 2006/2000A",
        "The largest nutations",
        "Free core nutation in IAU 2000A",
        "Angles of precession",
        "H and C that the rate implies",
    ]
    budget = tables_for(iau)[0]
    assert float(budget.rows[-1][1]) == pytest.approx(float(iau.closure) * 1e5, abs=1e-3)
    assert "consistency" in budget.note
    assert len(tables_for(iau)[2].rows) == 30


def test_figures_draw_what_is_there(pole: xr.Dataset, iau: xr.Dataset) -> None:
    path = pole_figures.plot_pole_path(pole)
    drawn = path.collections[0].get_offsets()
    assert len(drawn) == pole.sizes["time"]
    # The nutation is an ellipse of 6.9 by 9.2 arcsec.
    assert 6 < np.max(np.abs(drawn[:, 0])) < 9
    assert 8 < np.max(np.abs(drawn[:, 1])) < 12

    three = pole_figures.plot_pole_residuals(iau)
    assert len(three.axes) == 3
    line = three.axes[1].lines[0].get_ydata()
    assert np.array_equal(line, iau.dpsi_sineps)

    ratio = pole_figures.plot_nutation_ratio(iau)
    budget = pole_figures.plot_budget(iau)
    for ax in (path, ratio, budget):
        FigureCanvasAgg(ax.figure)
        ax.figure.draw_without_rendering()
