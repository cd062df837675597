"""Tables: numbers written with as many digits as they have."""

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH
from earthspin.scenes import QUESTIONS
from earthspin.views.rendering import run_time_tables, scene_page, tables_for
from earthspin.views.result_contents import answer_of, section
from earthspin.views.tables import (
    MOST_ROWS,
    SAMPLE,
    label,
    quantity,
    table_along,
    tables,
    tables_of,
    with_error,
)
from tests import shipped


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (50.4043148, 0.000031, "50.404315(31)"),
        (25712.084, 0.0157, "25712.084(16)"),
        (430.9, 1.372, "430.9(1.4)"),
        (1.8046060e22, 7.9e17, "1.804606(79)e22"),
        (123.4, 56.0, "123(56)"),
        (5.0, 0.0, "5"),
        (np.inf, np.inf, "none (no motion)"),
        (0.0, 0.02, "0.000(20)"),
        (0.0, 5.2e17, "0.0(5.2)e17"),
        (-3e16, 5.2e17, "-0.3(5.2)e17"),
        (0.0, 1e-13, "0.0(1.0)e-13"),
        (-0.004, 0.2, "0.00(20)"),
    ],
)
def test_digits(value: float, error: float, text: str) -> None:
    assert with_error(value, error) == text


def test_rows_match_headers_and_what_ran_is_named(precession_tree: xr.DataTree) -> None:
    (ran,) = run_time_tables(precession_tree)
    for table in [*tables_for(precession_tree), ran]:
        assert table.rows
        assert all(len(row) == len(table.headers) for row in table.rows)
    cost = {row[0]: row[2] for row in ran.rows}
    assert float(cost["figure-models"]) > 0
    assert float(ran.cost.split()[0]) > 0


def test_the_first_of_many_bodies_is_shown() -> None:
    h = xr.DataArray([0.0, 0.003], dims="draw")
    result = earthspin.precession(body=EARTH.replace(dynamical_flattening=h))
    table = tables_for(result)[0]
    assert "none (no motion)" in table.rows[0]


def test_a_plain_answer_has_the_tables_of_no_section(precession_tree: xr.DataTree) -> None:
    answer = precession_tree.to_dataset()
    (table,) = tables_for(answer)
    assert table.rows == tables_for(precession_tree)[1].rows
    assert run_time_tables(answer) == []


@pytest.mark.parametrize("word", ["precession", "torque", "wobble", "free-rotor", "polar-motion"])
def test_what_is_left_out_stands_under_the_errors_of_the_headline(word: str) -> None:
    answer = earthspin.run(word)
    left_out = f"Left out: {answer.attrs['neglected']}."
    shown = [table for table in tables_for(answer) if left_out in table.note.splitlines()]
    assert shown
    headline = label(answer_of(answer)[QUESTIONS[word].headline])
    quantity, _, unit = headline.partition(", ")
    if word in ("torque", "polar-motion"):
        tables = [
            table
            for table in tables_for(answer)
            if any(head.startswith(quantity) and unit in head for head in table.headers)
        ]
        assert tables
        assert all(table in shown for table in tables)


def test_another_earth_says_so_and_shows_nothing_observed() -> None:
    slow = earthspin.run_tree(earthspin.load_scene("precession", {"body.spin_period": "12 h"}))
    tables = {table.title: table for table in tables_for(slow)}
    assert "earth with spin_period = 43200.0 s" in tables["Precession"].note
    assert not any("observed" in row[0] for row in tables["Free wobble"].rows)
    page = scene_page(slow)
    assert "43200.0 s" in page
    assert "Nastula" not in page  # the source of the observed period


def test_headers_are_the_declared_labels_with_their_units() -> None:
    data = xr.Dataset(
        {
            "rate": ("planet", [1.0, 2.0], {"units": "arcsec/yr", "short": "rate of the axis"}),
            "rate_error": ("planet", [0.1, 0.2], {"units": "arcsec/yr"}),
            "iau_ratio": ("planet", [1e-5, 2e-5], {"units": "1"}),
        },
        {"planet": ["earth", "mars"]},
    )
    table = table_along(data, "planet", "Rates", ["rate", "iau_ratio:.1e"])
    assert table.headers == ("planet", "rate of the axis, arcsec/yr", "IAU ratio")
    assert table.rows == [("earth", "1.00(10)", "1.0e-5"), ("mars", "2.00(20)", "2.0e-5")]
    assert quantity(data.isel(planet=0), "rate") == ("rate of the axis, arcsec/yr", "1.00(10)")


@pytest.mark.slow
@pytest.mark.parametrize("scene", shipped.SCENES.values())
def test_every_variable_of_every_section_stands_in_a_table(scene: str) -> None:
    tree = shipped.tree(scene)
    shown = tables(tree)
    heads = {head for table in shown for row in (table.headers, *table.rows) for head in row[:1]}
    heads |= {head for table in shown for head in table.headers}
    for name, node in tree.children.items():
        if name != "plan":
            for variable, values in node.to_dataset().data_vars.items():
                words = label(section(tree, name)[variable]).rpartition(", ")
                quantity = words[0] or words[2]
                hidden = "_error" in str(variable) or not values.size
                assert hidden or any(head.startswith(quantity) for head in heads), variable
    for table in shown:
        assert len(table.rows) <= MOST_ROWS
        assert all(len(row) == len(table.headers) for row in table.rows)


def small(count: int) -> xr.Dataset:
    """A series with errors, and a quality factor whose interval is not symmetric."""
    days = np.datetime64("2000-01-01") + np.arange(count)
    return xr.Dataset(
        {
            "x": ("time", np.arange(count), {"units": "mas", "ancillary_variables": "x_error"}),
            "x_error": ("time", np.full(count, 0.5), {"units": "mas", "not_modelled": "tides: 1"}),
            "axis": (
                ("time", "component"),
                np.full((count, 2), 0.25),
                {"units": "1", "ancillary_variables": "axis_error", "comment": "a unit vector"},
            ),
            "axis_error": ("time", np.full(count, 1e3), {"units": "mas"}),
            "loss": ("time", np.ones(count), {"units": "1", "ancillary_variables": "scatter"}),
            "scatter": ("time", np.ones(count), {"units": "1"}),
            "quality": ((), 101.0, {"units": "1", "ancillary_variables": "quality_low"}),
            "quality_low": ((), 39.0, {"units": "1"}),
            "sure": ((), True),
            "wide": (("time", "column"), np.zeros((count, 9)), {"units": "1"}),
        },
        {"time": days.astype("M8[us]"), "component": ["x", "y"]},
    )


def test_a_table_follows_from_labels_errors_and_units() -> None:
    single, series = tables_of(small(10), "Small")
    assert single.rows == [
        ("quality", "101"),  # the lower end of an interval is no half-width
        ("quality low", "39"),
        ("sure", "yes"),
        ("wide", "10 x 9 values"),
    ]
    assert series.headers == ("time", "x, mas", "axis x", "axis y", "loss", "scatter")
    # 1000 mas are 4.848e-6 rad
    assert series.rows[1] == (
        *("2000-01-02", "1.00(50)", "0.2500000(48)", "0.2500000(48)", "1", "1"),
    )
    assert series.note.splitlines() == ["axis: a unit vector.", "Left out: tides: 1."]


def test_long_series_are_sampled_from_first_to_last() -> None:
    _, series = tables_of(small(1000), "Small")
    assert len(series.rows) == SAMPLE
    assert series.rows[0][0] == "2000-01-01"
    assert series.rows[-1][:2] == ("2002-09-26", "999.00(50)")
    assert series.note.startswith(f"{SAMPLE} of 1000 rows.")
    _, all_rows = tables_of(small(MOST_ROWS), "Small")
    assert len(all_rows.rows) == MOST_ROWS


def test_numbers_of_an_ensemble_are_medians_with_half_of_the_central_interval() -> None:
    many = earthspin.ensemble("precession", 100)
    low, middle, high = np.quantile(many.precession_rate.isel(perturber=-1), (0.025, 0.5, 0.975))
    spread, *_ = tables_for(many)
    rate = spread.headers.index("precession rate, arcsec/yr")
    assert spread.rows[-1][0] == "total"
    assert spread.rows[-1][rate] == with_error(middle, (high - low) / 2)
