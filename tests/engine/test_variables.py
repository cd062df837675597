"""Answers as classes: a variable is declared once, and laid out as it was declared."""

import numpy as np
import pytest

from earthspin.engine.variables import Variables, measured
from earthspin.numerics.arrays import Estimate


class Turns(Variables, along=("body",)):
    """Numbers with half-widths."""

    angle = measured("deg", "an angle", split=True, comment="as seen")
    period = measured("d", "a period")


def turning() -> Turns:
    """Turns of a body."""
    angle = Estimate(np.array([np.pi]), np.array([0.03]), np.array([0.04]))
    return Turns(angle=angle, period=([86400.0], [864.0]))


def test_a_half_width_comes_with_its_number() -> None:
    laid = turning().dataset()
    assert laid.angle.values == pytest.approx([180.0], rel=1e-15, abs=0)
    assert laid.angle_error.values == pytest.approx(np.degrees([0.05]), rel=1e-15, abs=0)
    assert laid.angle_error_input.values == pytest.approx(np.degrees([0.04]), rel=1e-15, abs=0)
    assert laid.period_error.values == pytest.approx([0.01], rel=1e-15, abs=0)
    companions = "angle_error angle_error_method angle_error_input"
    assert laid.angle.attrs["ancillary_variables"] == companions
    assert laid.angle.attrs["comment"] == "as seen"


def test_attributes_and_unknown_errors_are_noted() -> None:
    noted = turning().with_attributes(no_error="nobody knows", angle={"window": "a year"})
    assert noted.dataset().angle.attrs["window"] == "a year"

    class Plain(Variables):
        """One number."""

        length = measured("m", "a length")

    unknown = Plain(length=(1.0, np.nan)).with_attributes(no_error="nobody knows").dataset()
    assert unknown.length_error.attrs["no_error"] == "nobody knows"
