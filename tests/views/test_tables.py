"""Tables: numbers written with as many digits as they have."""

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH
from earthspin.views.tables import run_times, tables_for, with_error


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (50.4043148, 0.000031, "50.404315 ± 0.000031"),
        (25712.084, 0.0157, "25712.084 ± 0.016"),
        (430.9, 1.372, "430.9 ± 1.4"),
        (1.8046060e22, 7.9e17, "1.804606e22 ± 7.9e17"),
        (123.4, 56.0, "123 ± 56"),
        (5.0, 0.0, "5"),
        (np.inf, np.inf, "none (no motion)"),
        (0.0, 0.02, "0.000 ± 0.020"),
    ],
)
def test_digits(value: float, error: float, text: str) -> None:
    assert with_error(value, error) == text


def test_tables_of_each_question(precession_result: xr.Dataset) -> None:
    titles = [table.title for table in tables_for(precession_result)]
    assert titles == [
        "Precession",
        "What it means in the sky",
        "Three models of the figure",
        "Free wobble",
        "Beside IAU 2006",
        "Lunar standstills",
    ]
    assert [t.title for t in tables_for(earthspin.run("wobble"))] == [
        "Free wobble, rung by rung",
        "What the last rung depends on",
    ]
    assert [t.title for t in tables_for(earthspin.run("torque"))] == ["Torque"]


def test_rows_match_headers_and_parts_are_named(precession_result: xr.Dataset) -> None:
    for table in tables_for(precession_result):
        assert table.rows
        assert all(len(row) == len(table.headers) for row in table.rows)
        assert "ms" in run_times(precession_result, table.parts)


def test_the_first_of_many_bodies_is_shown() -> None:
    h = xr.DataArray([0.0, 0.003], dims="draw")
    result = earthspin.precession(body=EARTH.replace(dynamical_flattening=h))
    table = tables_for(result)[0]
    assert "none (no motion)" in table.rows[0]
