"""Tables and figures of the axis over millennia: they say what the result says."""

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Annotation
from matplotlib.transforms import Bbox

import earthspin
from earthspin.errors import UndefinedError
from earthspin.views import drawing, long_term, precession
from earthspin.views.rendering import drawings_for, tables_for
from earthspin.views.star_chart import year_words
from tests import shipped


@pytest.fixture(scope="module")
def about_now() -> xr.Dataset:
    return earthspin.long_term("-13 kyr", "13 kyr", "1 kyr")


def drawn_path(ax: object) -> np.ndarray:
    """The longest line of a chart."""
    lines = ax.get_lines()  # type: ignore[attr-defined]
    return np.asarray(max(lines, key=lambda line: len(line.get_xdata())).get_xydata())


def test_the_table_holds_first_and_last_epoch() -> None:
    table, *_ = tables_for(shipped.answer("long-term"))
    assert table.rows[0][0] == "-1000000"
    assert table.rows[-1][0] == "0"
    answer = shipped.answer("long-term")
    assert float(table.rows[-1][1].split("(")[0]) == pytest.approx(
        float(answer.obliquity[-1]), abs=1e-6
    )


def test_times_in_any_order_are_drawn_in_theirs() -> None:
    mixed = earthspin.long_term(times=["5 kyr", "-5 kyr", "0 kyr", "5 kyr", "-1 kyr"])
    climate = long_term.plot_climate(mixed)
    assert climate.lines[0].get_xdata().tolist() == [-5.0, -1.0, 0.0, 5.0]


def test_one_epoch_can_be_drawn() -> None:
    then = earthspin.long_term(times=["-1 kyr"])
    for ax in (long_term.plot_climate(then), long_term.plot_periods(then)):
        ax.figure.draw_without_rendering()
        assert ax.lines[0].get_marker() == "o"


@pytest.mark.parametrize(
    ("keys", "lines", "label"),
    [
        ({}, 1, "time from J2000.0 (1000 years)"),
        (
            {"latitude": ["65N", "65S"], "longitude": [1.0, 2.0]},
            4,
            "time from J2000.0 (1000 years)",
        ),
        ({"times": ["0 kyr"], "latitude": ["10S", "20N", "5N"]}, 1, "latitude (deg)"),
        ({"times": ["0 kyr"]}, 1, "time from J2000.0 (1000 years)"),
        ({"latitude": [k / 10 for k in range(9)]}, 0, "time from J2000.0 (1000 years)"),
    ],
)
def test_insolation_is_drawn_as_lines_or_as_a_map(keys: Any, lines: int, label: str) -> None:
    ax = long_term.plot_insolation(earthspin.insolation(**{"times": ["-9 kyr", "0 kyr"]} | keys))
    ax.figure.draw_without_rendering()
    assert len(ax.lines) == lines
    assert ax.get_xlabel() == label
    assert len(ax.figure.axes) == (1 if lines else 2)  # with the bar of colours
    for line in ax.lines:
        assert np.all(np.diff(line.get_xdata()) > 0)


@pytest.mark.parametrize(
    ("keys", "title"),
    [
        ({"latitude": "65S", "longitude": "270 deg"}, "65° S, December solstice"),
        ({"latitude": "0 deg", "longitude": "360 deg"}, "latitude 0°, March equinox"),
        ({"longitude": "180 deg"}, "65° N, September equinox"),
        ({"day": 172}, "65° N, day 172"),
        ({"body": "mars", "longitude": "90 deg"}, "65° N, Sun at 90°"),
    ],
)
def test_insolation_names_hemisphere_and_season(keys: Any, title: str) -> None:
    """Seasons are named for the Earth alone."""
    ax = long_term.plot_insolation(earthspin.insolation(times=["-9 kyr", "0 kyr"], **keys))
    assert ax.get_title() == title
    assert drawing.INTERVAL not in ax.get_legend_handles_labels()[1]  # thinner than the line


def test_the_line_of_the_path_is_the_path(about_now: xr.Dataset) -> None:
    """Between epochs a thousand years apart, against epochs that the question was asked for."""
    coarse = drawn_path(long_term.plot_pole(about_now))
    fine = drawn_path(long_term.plot_pole(earthspin.long_term("-13 kyr", "13 kyr", "50 yr")))
    assert coarse.shape == fine.shape
    assert np.max(np.abs(coarse - fine)) < 4e-3  # degrees; measured 2.2e-3, at the ends


def test_a_path_that_cannot_be_joined_is_left_out() -> None:
    coarse = earthspin.long_term("-20 kyr", "20 kyr", "5 kyr")
    with pytest.raises(UndefinedError, match="2,500 years apart"):
        long_term.plot_pole(coarse)
    titles = [drawing.title for drawing in drawings_for(coarse)]
    assert "The pole among the stars" not in titles
    far = earthspin.long_term("-100 kyr", "-90 kyr", "1 kyr")
    assert len(drawings_for(far)) == len(titles)


def _boxes(ax: object) -> Iterator[tuple[str, Bbox]]:
    figure = ax.figure  # type: ignore[attr-defined]
    FigureCanvasAgg(figure).draw()
    for text in ax.texts:  # type: ignore[attr-defined]
        assert isinstance(text, Annotation)
        yield text.get_text(), text.get_window_extent()


def test_the_circle_among_the_stars_is_that_of_the_earth() -> None:
    with pytest.raises(earthspin.SceneError, match="sky of the Earth"):
        precession.plot_pole_circle(earthspin.precession(body="mars"))


@pytest.mark.parametrize("which", ["circle", "path"])
def test_labels_cover_neither_one_another_nor_the_line(which: str, about_now: xr.Dataset) -> None:
    ax = (
        precession.plot_pole_circle(shipped.answer("precession"))
        if which == "circle"
        else long_term.plot_pole(about_now)
    )
    boxes = list(_boxes(ax))
    assert len(boxes) > 25
    for (one, of_one), (other, of_other) in combinations(boxes, 2):
        assert not of_one.overlaps(of_other), f"{one} covers {other}"
    path = ax.transData.transform(drawn_path(ax))
    for text, box in boxes:
        assert not any(box.contains(*point) for point in path), f"{text} lies on the line"


def test_periods_of_all_and_of_each(about_now: xr.Dataset) -> None:
    ax = long_term.plot_periods(about_now)
    labels = [row.get_ylabel() for row in ax.figure.axes]
    assert labels == [f"period, {of}\n(1000 years)" for of in ("total", "moon", "sun")]
    for row in ax.figure.axes:
        assert row.get_xlim() == (-13.0, 13.0)
    drawn = ax.lines[0].get_ydata()
    assert np.array_equal(drawn, about_now.precession_period.sel(perturber="total") / 1000)


def test_the_budget_never_falls_and_fills_its_axis() -> None:
    tree = shipped.tree("long-term")
    ax = long_term.plot_budget(tree)
    assert [line.get_label() for line in ax.lines] == ["together", *tree["budget"].cause.values]
    for line in ax.lines:
        assert np.all(np.diff(line.get_ydata()) >= 0)
    assert ax.get_xlim() == (1.0, 1000.0)
    error = float(tree.longitude_of_perihelion_error[0])
    assert ax.lines[0].get_ydata()[-1] >= error * (1 - 1e-12)


def test_years_are_those_of_historians() -> None:
    assert [year_words(year) for year in (-1999, 0, 1, 2000)] == ["2000 BC", "1 BC", "AD 1", "2000"]
