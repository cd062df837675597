"""Methods of the package hold their bounds; the ladders' own truths; no run time is tested."""

import numpy as np
import pytest

from tests.benchmarks.accuracy import LADDERS, excitation

#: Ladders whose errors are taken from many records, seeds or epochs.
SLOW = {"chandler", "ensemble", "forecast-30", "forecast-90", "precession", "torque"}


@pytest.mark.parametrize(
    "quantity", [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in LADDERS]
)
def test_finest_settings_hold_their_bounds(quantity: str) -> None:
    methods = LADDERS[quantity]()
    assert methods.bounds.keys() < methods.runs.keys()
    for method, bound in methods.bounds.items():
        *_, finest = methods.runs[method].values()
        assert methods.error_of(finest) <= bound, method
        assert 100 * methods.floor <= bound, method


def test_known_polar_motion_solves_its_equation() -> None:
    """p' = i s (p - chi), by central differences of the closed form, away from steps."""
    t, step = np.linspace(3000, 9000, 400), 0.05
    before, here, after = (excitation.true_polar_motion(t + d) for d in (-step, 0, step))
    chi = here - (after - before) / (2 * step) / (1j * excitation.FREQUENCY)
    mean = excitation.true_mean(t - 1e-3, 2e-3)
    assert np.max(np.abs(chi - mean)) < 1e-3  # 2e-4 mas measured, of 25
    assert excitation.true_polar_motion(np.zeros(1))[0] == excitation.START


def test_exact_pair_on_steps_alone_is_exact(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(excitation, "WAVES", ())
    # 1.5e-12 mas measured for the excitation, 2.2e-13 for polar motion
    for exact, bound in (
        (excitation.to_excitation(), 1e-11),
        (excitation.from_excitation(), 2e-12),
    ):
        for method in exact.bounds:
            assert exact.error_of(exact.runs[method]["10 d"]) < bound
