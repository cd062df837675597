"""The likelihood of a driven wobble: its covariance by other means, and what it finds."""

from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr
from scipy.linalg import expm, solve_continuous_lyapunov, toeplitz

import earthspin
from earthspin import SceneError
from earthspin.views.observed_pole import plot_modelled
from earthspin.wobble import excitation, observed, record
from earthspin.wobble.observed import fit, fit_with_excitation
from earthspin.wobble.state_space import DrivenOscillator, side_by_side
from tests.reference import simulation

MIDDLE, TAU = 2 * np.pi / record.NEAR, 500.0
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)
NODES, WEIGHTS = (NODES + 1) / 2, WEIGHTS / 2


def covariance(free: complex, white: float, red: float, slow: float) -> Callable[[float], complex]:
    """Of p turned back, where p' = free (p - chi), by Lyapunov's equation of the state (p, chi)."""
    state = np.array([[free, -free], [0, -1 / TAU]])
    stationary = solve_continuous_lyapunov(state, -np.diag([white, 2 * red / TAU]))

    def at(lag: float) -> complex:
        if lag < 0:
            return complex(np.conj(at(-lag)))
        moved = (expm(state * lag) @ stationary)[0, 0] + slow * np.exp(-lag / TAU)
        return complex(moved * np.exp(-1j * MIDDLE * lag))

    return at


def of_means(of: Callable[[float], complex], size: float, blocks: int) -> complex:
    """Covariance of two means by quadrature; of one with itself in the triangle of its half."""
    if blocks:
        lags = size * (blocks + NODES[:, None] - NODES)
        return complex(WEIGHTS @ np.vectorize(of)(lags) @ WEIGHTS)
    return complex(2 * (WEIGHTS @ ((1 - NODES) * [of(size * u) for u in NODES])).real)


@pytest.mark.parametrize(
    ("rate", "log_decay", "log_red", "log_background", "log_white"),
    [
        (0.0, -9.5, -30.0, -2.0, -30.0),
        (1e-4, -8.0, 0.5, -4.0, -3.0),
        (-1e-4, -10.0, -1.0, 1.0, -1.0),
    ],
)
def test_against_the_full_covariance(
    rate: float, log_decay: float, log_red: float, log_background: float, log_white: float
) -> None:
    """Five diagonals against the whole matrix, real and imaginary parts as numbers of their own."""
    one = observed.Likelihood(*simulation.simulate(30, seed=5))
    data = one.data(0j)
    free = 1j * (MIDDLE + rate) - np.exp(log_decay)
    flat = abs(1j * free.imag + 1 / TAU) ** 2 / abs(free) ** 2
    red = np.exp(log_red) / record.YEAR * flat * TAU / 2
    of = covariance(free, 1 / record.YEAR, red, np.exp(log_background))
    column = np.array([of_means(of, one.size, k) for k in range(3)])
    column[0] += np.exp(log_white)
    # Beyond two blocks a sum of two powers goes on by its own recurrence.
    a, b = np.exp(np.array([free - 1j * MIDDLE, -1 / TAU - 1j * MIDDLE]) * one.size)
    while column.size < len(data):
        column = np.append(column, (a + b) * column[-1] - a * b * column[-2])
    assert column[5] == pytest.approx(of_means(of, one.size, 5), rel=1e-12, abs=0)
    whole = side_by_side(toeplitz(column)) / 2
    known, seen = side_by_side(data[:, :-1]), np.concatenate([data[:, -1].real, data[:, -1].imag])
    weighted = np.linalg.solve(whole, np.column_stack([known, seen]))
    normal = known.T @ weighted[:, :-1]
    left = seen - known @ np.linalg.solve(normal, known.T @ weighted[:, -1])
    expected = (seen.size - len(normal)) * np.log(left @ np.linalg.solve(whole, left))
    expected += np.linalg.slogdet(whole)[1] + np.linalg.slogdet(normal)[1]
    found = one(rate, log_decay, log_red, log_background, log_white, np.log(TAU))
    assert found == pytest.approx(expected, rel=TOLERANCE, abs=0)


#: Measured: 2e-14.
TOLERANCE = 2e-13


def test_samples_have_the_covariance_of_the_state() -> None:
    """Variance of p and its change in 30 days, of a quick oscillator, within four errors."""
    s = excitation.chandler_frequency(433.0, 5.0)
    oscillator = DrivenOscillator(s, TAU, white=3.0, red=400.0, background=50.0)
    of = covariance(1j * s, 3.0, 400.0, 50.0)
    p = simulation.sampled(oscillator, 40_000, 30.0, np.random.default_rng(7))
    back = np.exp(-1j * MIDDLE * 30.0)
    for lag in (0, 1, 6):
        seen = np.mean(p[lag:] * p[: p.size - lag].conj()) * back**lag
        expected = of(30.0 * lag)
        # The record holds some 40000 * 30 d / (2 * 345 d) independent pieces.
        assert abs(seen - expected) < 4 * of(0.0).real / np.sqrt(1700)


def best_period(given: tuple[np.ndarray, np.ndarray]) -> float:
    """Where the likelihood is largest, without the ends of its interval."""
    at, _ = observed.maximum_likelihood(observed.Likelihood(*given))
    return float(2 * np.pi / (MIDDLE + at[0]))


@pytest.mark.slow
def test_red_excitation_biases_no_period() -> None:
    """Half of what drives it red; in pairs, for the white part is the same.

    Measured in 60 pairs: +1.6 d without a term for it, +0.3 +- 0.2 with it.
    """
    seeds = range(24)
    red = [best_period(simulation.simulate(65, red=25.0, seed=seed)) for seed in seeds]
    white = [best_period(simulation.simulate(65, seed=seed)) for seed in seeds]
    assert abs(np.mean(red) - np.mean(white)) < 0.8
    assert abs(np.mean(red) - 433) < 1.0


@pytest.mark.slow
@pytest.mark.parametrize("memory", [100.0, 1826.0])
def test_intervals_hold_for_other_memories(memory: float) -> None:
    """The red excitation has most of the power; how long it remembers is fitted.

    Measured shares are in docs/measured/free-wobble.inc.
    """
    red = simulation.red_size(433.0, 50.0, 0.6, memory)
    fits = [
        fit(*simulation.simulate(130, 433.0, 50.0, red=red, memory=memory, seed=k), "likelihood")
        for k in range(24)
    ]
    assert np.mean([abs(one.period - 433.0) <= one.period_error for one in fits]) > 0.9


# --- with an excitation that is known ------------------------------------------------------------


def driven_pole(
    period: float, q: float, left: float, seed: int, years: float = 60.0
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Days, a pole, and what drives it but for a part that is left out; synthetic, all white."""
    generator = np.random.default_rng(seed)
    days = np.arange(0.0, years * 365.25, 2.0)
    chi, rest = generator.standard_normal((2, days.size - 1, 2)) @ [1, 1j]
    s = excitation.chandler_frequency(period, q)
    p = excitation.polar_motion_from(40 * chi + left * rest, 2.0, s, 100 - 60j)
    p += 94 * record.turning(days, record.YEAR) + 30 - 300j
    return days, p, 40 * chi


@pytest.mark.slow
def test_a_known_excitation_sharpens_the_fit() -> None:
    """A tenth of the excitation is not known: ten times less scatter than without."""
    found, plain, inside = [], [], []
    for seed in range(4):
        days, p, chi = driven_pole(431.0, 90.0, 4.0, seed)
        one = fit_with_excitation(days, p, chi)
        found.append((one.period, one.quality_factor))
        inside.append(abs(one.period - 431.0) < one.period_error)
        inside.append(one.quality_bounds[0] < 90.0 < one.quality_bounds[1])
        plain.append(fit(days, p).period)
    period, q = np.array(found).T
    assert np.std(period) < 0.35 < 0.8 < np.std(plain)
    assert abs(period.mean() - 431.0) < 0.35
    assert abs(np.median(q) - 90.0) < 9
    assert np.mean(inside) > 0.75


def test_the_start_is_found() -> None:
    """Exactly, where all of the excitation is known; drift and seasons stay out of it."""
    days, p, chi = driven_pole(431.0, 90.0, 0.0, 1)
    s = excitation.chandler_frequency(431.0, 90.0)
    assert excitation.fitted_start(days, p, chi, s) == pytest.approx(100 - 60j, rel=1e-10, abs=0)


@pytest.fixture(scope="module")
def synthetic() -> tuple[xr.Dataset, xr.Dataset]:
    """A synthetic pole since 1962, in arcseconds at 0h, and its daily excitation, mas at noon."""
    generator = np.random.default_rng(3)
    count = 60 * 365
    chi, rest = generator.standard_normal((2, count, 2)) @ [1, 1j]
    s = excitation.chandler_frequency(431.0, 90.0)
    p = excitation.polar_motion_from(30 * chi + 6 * rest, 1.0, s, 100 - 60j)
    midnights = np.datetime64("1962-01-01", "ns") + np.arange(count + 1) * np.timedelta64(1, "D")
    noons = midnights[:-1] + np.timedelta64(12, "h")
    pole = xr.Dataset({"x": ("time", p.real / 1e3), "y": ("time", -p.imag / 1e3)})
    driving = xr.Dataset({"chi1": ("time", 30 * chi.real), "chi2": ("time", 30 * chi.imag)})
    for name in pole:
        pole[name].attrs["units"] = "arcsec"
    for name in driving:
        driving[name].attrs["units"] = "mas"
    driving.attrs["source"] = "a synthetic excitation"
    return pole.assign_coords(time=midnights), driving.assign_coords(time=noons)


def test_pole_and_excitation_together(synthetic: tuple[xr.Dataset, xr.Dataset]) -> None:
    """The excitation begins later and ends later; the span that both cover counts."""
    pole, chi = synthetic
    found = earthspin.fit_chandler(
        pole.isel(time=slice(0, -500)), excitation=chi[{"time": slice(100, None)}]
    )
    assert abs(float(found.chandler_period) - 431.0) < float(found.chandler_period_error) < 1.5
    low, high = found.chandler_quality_factor_low, found.chandler_quality_factor_high
    assert float(low) < 90 < float(high) < 2 * float(low)
    assert found.chandler_period.attrs["method"] == "likelihood with excitation"


def test_the_modelled_amplitude_follows_the_observed(
    synthetic: tuple[xr.Dataset, xr.Dataset],
) -> None:
    pole, chi = synthetic
    model = earthspin.polar_motion_from(chi, period=431.0, quality_factor=90.0, fitted_to=pole)
    assert model.attrs["source"] == "driven by a synthetic excitation"
    off = np.hypot(model.x.values - pole.x.values, model.y.values - pole.y.values) * 1e3
    size = np.hypot(pole.x.values, pole.y.values) * 1e3
    # what is left out drives a fifth of the wobble
    assert np.sqrt(np.mean(off**2)) < 0.35 * np.sqrt(np.mean(size**2))
    seen, modelled = earthspin.fit_chandler(pole), earthspin.fit_chandler(model)
    ax = plot_modelled(seen, modelled)
    words = {text.get_text() for text in ax.get_legend().get_texts()}
    assert words > {"observed", "driven by a synthetic excitation"}
    assert np.array_equal(ax.lines[1].get_ydata(), modelled.chandler_amplitude)
    assert np.corrcoef(ax.lines[0].get_ydata(), ax.lines[1].get_ydata())[0, 1] > 0.9


def test_what_does_not_go_together_is_refused(synthetic: tuple[xr.Dataset, xr.Dataset]) -> None:
    pole, chi = synthetic
    with pytest.raises(SceneError, match="'likelihood'"):
        earthspin.fit_chandler(pole, excitation=chi, method="burg")
    late = chi.assign_coords(time=chi.time + np.timedelta64(3, "h"))
    with pytest.raises(SceneError, match="steps of the pole"):
        earthspin.fit_chandler(pole, excitation=late)
    far = chi.assign_coords(time=chi.time + np.timedelta64(40_000, "D"))
    with pytest.raises(SceneError, match="no span in common"):
        earthspin.fit_chandler(pole, excitation=far)
    with pytest.raises(SceneError, match="fitted_to determines it"):
        earthspin.polar_motion_from(
            chi, period=431.0, quality_factor=90.0, start=(0.0, 0.0), fitted_to=pole
        )
    backwards = chi.isel(time=slice(None, None, -1))
    with pytest.raises(SceneError, match="times are not ascending"):
        earthspin.polar_motion_from(backwards, period=431.0, quality_factor=90.0)


def test_the_end_of_an_interval_if_a_search_at_the_best_value_fails() -> None:
    """A search at the best value once followed a first step beyond the limit; it is not needed."""

    def profile(value: float) -> float:
        return abs(value) if value else 5.0

    assert abs(observed._bound(profile, 0.0, 4.0, reach=8.0, target=1.96) - 1.96) < 0.1
    assert observed._bound(profile, 0.0, -1.0, reach=8.0, target=1.96) == -1.0
