"""What a top may be, and its constants."""

import re
from typing import Any

import numpy as np
import pytest

from earthspin.errors import BodyError
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.start import HeavyTop, top_constants

TOP: dict[str, Any] = {
    "transverse_moment": 2.0,
    "axial_moment": 1.0,
    "weight_moment": 3.0,
    "theta": 0.6,
    "spin": 5.0,
}


@pytest.mark.parametrize(
    ("field", "value", "allowed"),
    [
        ("transverse_moment", 0.0, "positive"),
        ("transverse_moment", -2.0, "positive"),
        ("axial_moment", -1.0, "positive"),
        ("axial_moment", 4.1, "twice its transverse moment"),
        ("theta", -0.1, "from 0 to pi"),
        ("theta", 3.2, "from 0 to pi"),
        ("spin", np.inf, "finite"),
        ("spin", 1e200, "1e+100"),
        ("phi", np.nan, "finite"),
        ("weight_moment", np.nan, "finite"),
    ],
)
def test_what_no_top_can_be_is_named_in_one_line(field: str, value: float, allowed: str) -> None:
    with pytest.raises(BodyError) as caught:
        HeavyTop(**TOP | {field: value})
    message = str(caught.value)
    assert field in message
    assert repr(value) in message
    assert allowed in message
    assert "\n" not in message


def test_the_first_wrong_top_of_a_batch_is_named() -> None:
    with pytest.raises(BodyError, match=re.escape("theta = 4.0")):
        HeavyTop(**TOP | {"theta": [1.0, 4.0]})


def test_fields_that_do_not_broadcast_are_refused() -> None:
    with pytest.raises(BodyError, match=r"theta \(2,\), spin \(3,\)"):
        HeavyTop(**TOP | {"theta": [1.0, 2.0], "spin": [1.0, 2.0, 3.0]})


@pytest.mark.parametrize("times", [np.nan, [0.0, np.inf], 1e300])
def test_times_that_are_none_are_refused(times: Any) -> None:
    with pytest.raises(BodyError, match="times"):
        heavy_top_motion(HeavyTop(**TOP), times)


def test_a_disc_about_its_centre_has_the_greatest_axial_moment() -> None:
    assert HeavyTop(**TOP | {"axial_moment": 4.0}).axial_moment == 4.0


def test_a_top_does_not_change_with_the_arrays_it_was_made_of() -> None:
    theta = np.array([0.3, 0.4])
    top = HeavyTop(**TOP | {"theta": theta})
    theta[0] = 9.0
    assert top.theta[0] == 0.3
    with pytest.raises(ValueError, match="read-only"):
        top.theta[0] = 1.0


def test_constants_are_those_of_the_source() -> None:
    """I.7.7: b I1 = phi' (sin^2 I1 + cos^2 I3) + psi' cos I3; I.7.14 from the energy I.7.11."""
    phi_rate, theta_rate = 0.7, -0.4
    top = HeavyTop(**TOP, phi_rate=phi_rate, theta_rate=theta_rate)
    i1, i3, weight, theta, spin = TOP.values()
    sine, cosine = np.sin(theta), np.cos(theta)
    psi_rate = spin - phi_rate * cosine
    kinetic = 0.5 * i1 * (phi_rate**2 * sine**2 + theta_rate**2) + 0.5 * i3 * spin**2
    energy = kinetic + weight * cosine
    a, b, alpha, beta = top_constants(top)
    assert a == pytest.approx(i3 * spin / i1, rel=1e-15, abs=0)
    along_z = phi_rate * (sine**2 * i1 + cosine**2 * i3) + psi_rate * cosine * i3
    assert b == pytest.approx(along_z / i1, rel=1e-15, abs=0)
    assert alpha == pytest.approx(2 * (energy - a**2 * i1**2 / (2 * i3)) / i1, rel=1e-15, abs=0)
    assert beta == pytest.approx(2 * weight / i1, rel=1e-15, abs=0)
