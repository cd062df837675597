"""Methods of the package hold their bounds; the ladders' own truths; no run time is tested."""

import numpy as np
import pytest

from tests.benchmarks.accuracy import (
    LADDERS,
    chandler,
    ensemble,
    excitation,
    spheroid,
)
from tests.reference.stored import load

#: Ladders whose errors are taken from many records, seeds or epochs.
SLOW = {"chandler", "ensemble", "forecast-30", "forecast-90", "precession", "torque"}


@pytest.mark.parametrize(
    "quantity",
    [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in LADDERS],
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


def test_best_scatter_is_that_of_the_page() -> None:
    assert chandler.best_scatter(65.0) == pytest.approx(1.65, abs=0.005)


def test_drawn_half_widths_scatter_as_expected() -> None:
    """400 draws of numpy's own: 0.0351 measured at 1000 members, of 0.0348."""
    drawn = np.random.default_rng(5).normal(1.0, ensemble.UNCERTAINTY, (400, 1000))
    low, high = np.quantile(1 / drawn, ensemble.ENDS, axis=1)
    scatter = np.sqrt(np.mean(((high - low) / 2 / ensemble.HALF_WIDTH - 1) ** 2))
    assert scatter == pytest.approx(ensemble.expected_scatter(1000), rel=0.1, abs=0)


def test_arctangents_lose_their_digits_with_distance() -> None:
    place = spheroid.points()
    true = load("spheroid", spheroid.inputs())
    errors = spheroid.errors(spheroid.arctangents(place), true)["torque"]
    worst = np.log10(errors.reshape(len(spheroid.DISTANCES), -1).max(axis=1))
    powers = dict(zip(spheroid.DISTANCES, worst, strict=True))
    assert -12 < powers[1.05] < -9
    assert -5 < powers[60.0] < -2
    assert powers[1e4] > 1
