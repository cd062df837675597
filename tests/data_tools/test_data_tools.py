"""The tools that measure: on the kernel that comes along, in short."""

import numpy as np
import pytest

from data_tools.__main__ import main
from data_tools.kernels import largest_differences
from data_tools.windows import rates, scatter
from earthspin.constants import DAY
from earthspin.sky.ephemeris import Ephemeris


def test_hashes_are_as_known(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify"]) == 0
    assert "de421" in capsys.readouterr().out


def test_a_kernel_is_not_far_from_itself(de421: Ephemeris) -> None:
    found = largest_differences(de421, de421, [10, 301], step=1000.0)
    assert found == {10: (0.0, 0.0), 301: (0.0, 0.0)}


def test_a_missing_kernel_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["windows", "--kernel", "none.bsp"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_the_claimed_error_holds_in_the_last_century(de421: Ephemeris) -> None:
    rate, times = rates(de421, 19_000)
    centres = np.arange(-8000, 8000, 700) * DAY
    for taper, turns in (("hann", 3), ("sin4", 3)):
        rms, largest, share = scatter(rate, times, taper, turns, centres)
        assert share >= 0.95
        assert 0.05 < rms < 1.5  # mas a century; the smooth curve takes part of the swing here
        assert largest < 5
