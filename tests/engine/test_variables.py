"""Answers as classes: a variable is declared once, and laid out as it was declared."""

import numpy as np
import pytest
import xarray as xr

from earthspin.engine.part import part
from earthspin.engine.variables import (
    Labels,
    Pair,
    SchemaError,
    Value,
    Variables,
    amplitude,
    labels,
    measured,
    number,
    words,
)
from earthspin.numerics.arrays import Estimate


class Turns(Variables, along=("body",), no_error="it is counted"):
    """Declarations of every kind."""

    angle: Pair = measured("deg", "an angle", split=True, comment="as seen")
    period: Pair = measured("d", "a period")
    turns: Value = number("1", "turns", along=())
    bound: Value = number("1", "a number with its error elsewhere", error="period_error")
    swing: Pair = amplitude("mas", "a swing")
    kind: Value = words("kind of the body")
    extra: Value | None = number("m", "a length", along=(), default=None)
    body: Labels = labels("name of the body")


@part
def turning() -> Turns:
    """Turns of a body."""
    return Turns(
        angle=Estimate(np.array([np.pi]), np.array([0.03]), np.array([0.04])),
        period=([86400.0], [864.0]),
        turns=2.0,
        bound=[1.0],
        swing=([0.0], [0.0]),
        kind=["round"],
        body=["earth"],
    )


def test_a_part_gives_what_the_class_declares() -> None:
    laid = turning().dataset()
    assert list(laid.data_vars) == [*turning.gives][:-1]
    assert list(laid.data_vars)[:4] == [
        "angle", "angle_error", "angle_error_method", "angle_error_input"
    ]  # fmt: skip
    assert list(turning.gives)[-1] == "extra"


def test_a_half_width_comes_with_its_number() -> None:
    laid = turning().dataset()
    assert laid.angle.values == pytest.approx([180.0], rel=1e-15, abs=0)
    assert laid.angle_error.values == pytest.approx(np.degrees([0.05]), rel=1e-15, abs=0)
    assert laid.angle_error_input.values == pytest.approx(np.degrees([0.04]), rel=1e-15, abs=0)
    assert laid.period_error.values == pytest.approx([0.01], rel=1e-15, abs=0)
    companions = "angle_error angle_error_method angle_error_input"
    assert laid.angle.attrs["ancillary_variables"] == companions
    assert laid.angle.attrs["comment"] == "as seen"


def test_a_class_says_what_holds_for_all_its_numbers() -> None:
    laid = turning().dataset()
    assert laid.turns.attrs["no_error"] == "it is counted"
    assert laid.swing_in_phase.attrs["no_error"] == "it is counted"
    for name in ("period", "bound", "period_error", "kind"):
        assert "no_error" not in laid[name].attrs
    assert laid.bound.attrs["ancillary_variables"] == "period_error"
    assert laid.turns.dims == ()
    assert laid.kind.dims == laid.swing_out_of_phase.dims == ("body",)
    assert laid.body.attrs == {"long_name": "name of the body"}


def test_attributes_and_unknown_errors_are_noted() -> None:
    noted = turning().with_attributes(no_error="nobody knows", angle={"window": "a year"})
    assert noted.dataset().angle.attrs["window"] == "a year"

    class Plain(Variables):
        """One number."""

        length: Pair = measured("m", "a length")

    unknown = Plain(length=(1.0, np.nan)).with_attributes(no_error="nobody knows").dataset()
    assert unknown.length_error.attrs["no_error"] == "nobody knows"


def test_a_class_adds_to_another() -> None:
    class More(Turns, error="mass_error"):
        """One number more."""

        mass: Value = number("1", "a mass")
        mass_error: Value = number("1", "its error", along=())

    assert More.schema["mass"].dims == ("body",)
    assert More.schema["mass_error"].dims == ()
    assert list(More.schema)[:2] == ["angle", "angle_error"]
    assert More.schema["turns"].no_error == "it is counted"


def test_wrong_names_are_refused() -> None:
    with pytest.raises(SchemaError, match=r"unknown \['lenght'\], missing \['angle', 'body'"):
        Turns(lenght=1.0)  # type: ignore[call-arg]


def test_labelled_arrays_keep_their_labels() -> None:
    class Along(Variables, along=("day",)):
        """Numbers by day."""

        length: Value = number("m", "a length")
        day: Labels = labels()

    days = xr.DataArray([1.0, 2.0], dims="day", attrs={"units": "d"})
    days = days.assign_coords(day=days)
    assert Along(length=[3.0, 4.0], day=days).dataset().day.attrs == {"units": "d"}
