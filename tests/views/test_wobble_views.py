"""Tables and figures of the free wobble."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin.cli import main
from earthspin.constants import MAS
from earthspin.views import observed_pole, wobble
from earthspin.views.rendering import tables_for

SPAN = ("1962-01-01", "2026-09-29")


@pytest.fixture(scope="module")
def ladder() -> xr.DataTree:
    return earthspin.run_tree("wobble")


@pytest.fixture(scope="module")
def pole() -> xr.DataTree:
    return earthspin.run_tree(earthspin.load_scene("polar-motion", {"span": list(SPAN)}))


def words(result: xr.Dataset | xr.DataTree) -> str:
    return "\n".join(
        " ".join((t.title, t.note, *(" ".join(row) for row in t.rows))) for t in tables_for(result)
    )


def test_tables_of_the_ladder(ladder: xr.DataTree) -> None:
    assert f"{float(ladder.period_solar.sel(rung='anelastic')):.1f}(" in words(ladder)
    assert "has no ocean" in words(earthspin.wobble_ladder(body="mars"))


def test_the_observed_polhode_is_drawn_as_published(pole: xr.DataTree) -> None:
    """I.6.32: the curve is that of the table of the IERS, in milliarcseconds and metres."""
    from astropy.utils.iers import IERS_B

    table = IERS_B.open()
    ax = observed_pole.plot_polhode(pole, years=None)
    y, x = ax.lines[0].get_data()
    first = table["MJD"].value >= 37665
    np.testing.assert_allclose(x, table["PM_x"].to_value("mas")[first][: x.size], rtol=0, atol=1e-9)
    np.testing.assert_allclose(y, table["PM_y"].to_value("mas")[first][: y.size], rtol=0, atol=1e-9)
    # 1 mas is 3.08 cm at the pole, 6,357 km from the centre
    ax.figure.draw_without_rendering()
    low, high = ax.get_ylim()
    (axis,) = (child for child in ax.child_axes if child.get_ylabel() == "x (m)")
    assert np.ptp(axis.get_ylim()) == pytest.approx((high - low) * 6356752 * MAS, rel=1e-6, abs=0)


def test_ladder_figure(ladder: xr.DataTree) -> None:
    ax = wobble.plot_ladder(ladder)
    drawn = ax.containers[0].lines[0]
    assert np.array_equal(drawn.get_ydata(), ladder.period_solar)
    assert [t.get_text() for t in ax.get_xticklabels()] == list(ladder.rung.values)


def test_polhode_of_the_last_six_years(pole: xr.DataTree) -> None:
    ax = observed_pole.plot_polhode(pole)
    y, x = ax.lines[0].get_data()
    assert len(x) == pytest.approx(6 * 365.25, abs=2)
    assert x[-1] == pytest.approx(float(pole.x[-1]) * 1e3, rel=1e-15, abs=0)
    # Counter-clockwise, as seen from above.
    turn = np.unwrap(np.angle((x - x.mean()) - 1j * (y - y.mean())))
    assert turn[-1] - turn[0] > 4 * 2 * np.pi
    far = ax.child_axes[0]
    ax.figure.draw_without_rendering()
    metres = float(pole.polar_radius) * MAS
    assert far.get_xlim()[1] == pytest.approx(ax.get_xlim()[1] * metres, rel=1e-14, abs=0)
    whole = observed_pole.plot_polhode(
        pole.to_dataset().sel(time=slice("1990", "1995")), years=None
    )
    assert len(whole.lines[0].get_xdata()) == 6 * 365 + 1


def test_spectra_peak_at_the_free_wobble(pole: xr.DataTree) -> None:
    ax = observed_pole.plot_spectra(pole)
    prograde, retrograde = (line.get_data() for line in ax.lines[:2])
    at = prograde[0][np.argmax(prograde[1])]
    assert 365.25 / at == pytest.approx(433, abs=4)
    assert retrograde[1].max() < 0.1 * prograde[1].max()


def test_amplitude_figure_takes_either_layout(pole: xr.DataTree) -> None:
    fit = earthspin.fit_chandler(pole.to_dataset())
    for result in (pole, fit):
        ax = observed_pole.plot_amplitude(result)
        assert np.array_equal(ax.lines[0].get_ydata(), fit.chandler_amplitude)
        assert len(observed_pole.plot_phase(result).lines) == 2


@pytest.mark.slow
def test_report(tmp_path: Path) -> None:
    assert main(["report", "wobble", "--out", str(tmp_path)]) == 0
    text = (tmp_path / "wobble.html").read_text()
    assert "303.62464(18) days" in text
    assert text.count("<figure") == 4
    assert 'src="' not in text  # one file that works offline
    assert 'href="http' not in text
    for name in ("wobble", "polar-motion"):
        assert earthspin.open(tmp_path / f"{name}.nc").attrs["compute"] == name
