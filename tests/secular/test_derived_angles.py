"""How far causes move what is read off."""

import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest

from earthspin.secular import derived_angles
from earthspin.secular.derived_angles import AnglesWithErrors, DerivedAngles
from earthspin.secular.error_budget import AxisInputs, Uncertainty, solved
from earthspin.sky.iau_models import fixed_ecliptic
from tests.secular.setting import EARTHS, KYR, POLE, earths

TURN, NOTHING = 2 * np.pi, np.zeros((3, 1))
Solution = Callable[[], list[DerivedAngles]]


def read(perihelion: float, general: float) -> DerivedAngles:
    values = {"longitude_of_perihelion": perihelion, "general_precession": general}
    return DerivedAngles({name: np.array([of]) for name, of in values.items()}, NOTHING, NOTHING)


def varied(cause: str, perihelion: float, general: float) -> tuple[str, Solution]:
    return cause, lambda: [read(perihelion, general)]


def test_whole_turns_of_a_perihelion_are_no_error_and_those_of_the_axis_are() -> None:
    """An orbit that is all but round may pass a circle on the other side."""
    of = AnglesWithErrors(
        read(1.0, 5.0),
        (
            varied("orbit", 1.01 - TURN, 5.0),
            varied("axis", 1.0 + TURN, 5.0 + TURN),
            varied("both", 1.3 + TURN, 5.2),
        ),
    )
    apart = of.changes("longitude_of_perihelion")
    found = {cause: float(share[0]) for cause, share in apart.items()}
    assert found == pytest.approx({"orbit": 0.01, "axis": TURN, "both": 0.3}, rel=1e-9, abs=0)
    assert float(of.changes("general_precession")["both"][0]) == pytest.approx(0.2, rel=1e-9, abs=0)


def test_directions_of_one_cause_count_as_the_root_of_their_squares() -> None:
    of = AnglesWithErrors(read(1.0, 5.0), (varied("orbit", 1.0, 5.3), varied("orbit", 1.0, 4.6)))
    apart = of.changes("general_precession")
    assert list(apart) == ["orbit"]
    assert apart["orbit"] == pytest.approx([0.5], rel=1e-12, abs=0)


def test_angles_do_not_depend_on_the_blocks_in_which_they_are_derived(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Bit for bit, with whole turns of precession and perihelion over the edges of blocks."""
    times = np.arange(-1300.0, 100.0, 7) * KYR
    uncertainty = Uncertainty(1e-6, EARTHS.error, earth=True, start=(1e-8,))
    setting = AxisInputs(earths(), EARTHS, POLE)
    found = []
    for most in (1 << 11, 32, 199):  # one block, blocks with and without a short remainder
        monkeypatch.setattr(derived_angles, "AT_ONCE", most)
        solution = solved(setting, (times[0], times[-1]), uncertainty)
        found.append(derived_angles.derive_all(solution, times, fixed_ecliptic()))
    whole, *others = found
    assert np.any(whole.weight > 0)
    for other in others:
        assert np.array_equal(whole.nominal.pole, other.nominal.pole)
        for name, values in whole.nominal.values.items():
            assert np.array_equal(values, other.nominal.values[name]), name
            assert np.array_equal(whole.half_width(name), other.half_width(name)), name
        shares = (case.changes("pole") for case in (whole, other))
        for share, same in zip(*(case.values() for case in shares), strict=True):
            assert np.array_equal(share, same)


def test_memory_does_not_grow_with_the_causes() -> None:
    """Measured: 1.6 times the 37 numbers of an epoch in an answer; 6.2 times if all are held."""
    times = np.linspace(-900.0, 0.0, 40_000) * KYR
    uncertainty = Uncertainty(1e-6, EARTHS.error, earth=True, start=(1e-8,))
    solution = solved(AxisInputs(earths(), EARTHS, POLE), (times[0], times[-1]), uncertainty)
    tracemalloc.start()
    try:
        found = derived_angles.derive_all(solution, times, fixed_ecliptic())
        assert np.all(found.half_width("obliquity") > 0)
        assert tracemalloc.get_traced_memory()[1] < 3 * 37 * times.nbytes
    finally:
        tracemalloc.stop()
