"""The resonance form and the frequency analysis on poles that are made up."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.constants import ARCSEC, DAY
from earthspin.interior.named import K_ICB
from earthspin.nutation.analysis import (
    MULTIPLES,
    FrequencyAnalysis,
    on_fixed_ecliptic,
    phases,
    pole_from,
    precession_angles,
    without_line,
)
from earthspin.nutation.response import INNER_CORE_NUTATION, Response, fit_response
from earthspin.sky import iau_models

H, SPIN = 0.0032737949, 7.292115e-5
DAYS = np.arange(-18000.0, 18000.0, 9.7)
ARGUMENTS, RATES = iau_models.delaunay_arguments(DAYS), iau_models.delaunay_rates()


@pytest.fixture(scope="module")
def analysis() -> FrequencyAnalysis:
    return FrequencyAnalysis(DAYS / 36525, ARGUMENTS, RATES)


def test_the_inner_core_nutation_has_the_period_and_the_loss_of_its_authors() -> None:
    """1025 days (Mathews, Herring & Buffett 2002); its damping is that of the coupling K_ICB."""
    days = 1 / (1 + INNER_CORE_NUTATION.real) / 1.00273790935
    assert days == pytest.approx(1025, abs=1.5, rel=0)  # measured: 1023.9
    assert INNER_CORE_NUTATION.imag == pytest.approx(-K_ICB[1].value, rel=1e-9, abs=0)


def test_circles_that_were_put_in_come_out(analysis: FrequencyAnalysis) -> None:
    rng = np.random.default_rng(4)
    every = np.concatenate([MULTIPLES, -MULTIPLES])
    amplitude = rng.normal(size=len(every)) + 1j * rng.normal(size=len(every))
    t = DAYS / 36525
    eta = amplitude @ np.exp(1j * (every @ ARGUMENTS)) + (3 - 2j) * t + 0.5j * t**2
    found = analysis(eta)
    assert np.max(np.abs(found.amplitude - amplitude)) < 5e-15  # measured: 5e-16
    assert np.max(np.abs(found.slow - [0, 3 - 2j, 0.5j, 0, 0])) < 1.5e-13  # measured: 1.5e-14
    wanted = amplitude @ np.exp(1j * (every @ ARGUMENTS))
    assert np.max(np.abs(found.at(ARGUMENTS) - wanted)) < 6e-13  # measured: 8e-14


def test_frequencies_are_those_of_the_arguments(analysis: FrequencyAnalysis) -> None:
    found = analysis(np.zeros(DAYS.size, dtype=complex))
    names = map(tuple, found.multiples.tolist())
    period = dict(zip(names, 2 * np.pi / found.frequency / DAY, strict=True))
    # Mathews, Herring & Buffett 2002, table 1
    for multiple, days in {
        (0, 0, 0, 0, 1): -6798.38,
        (0, 0, 2, -2, 2): 182.62,
        (0, 0, 2, 0, 2): 13.66,
        (0, -1, 0, 0, 0): -365.26,
        (1, 0, 0, 0, 0): 27.55,
    }.items():
        assert abs(period[multiple] - days) < 0.006, multiple


def test_a_response_that_was_put_in_comes_out() -> None:
    """Also where the search does not begin at it: with a core nutation of 420 days."""
    true = Response(
        H, SPIN, -1.0023744 + 3.1e-5j, np.array([-0.14 + 0.03j, -0.93 + 0.07j, 0.049, 2.8e-4])
    )
    rng = np.random.default_rng(8)
    frequency = np.concatenate([MULTIPLES, -MULTIPLES]) @ RATES
    rigid = (rng.normal(size=frequency.size) + 1j * rng.normal(size=frequency.size)) * ARCSEC
    found = fit_response(frequency, rigid, true.transfer(frequency) * rigid, H, SPIN)
    assert abs(found.period - true.period) < 1e-3 * DAY
    assert abs(found.quality / true.quality - 1) < 1e-4
    assert np.max(np.abs(found.transfer(frequency) - true.transfer(frequency))) < 1e-7


def test_period_and_quality_of_the_published_core_nutation() -> None:
    """-430.21 d and 20 000 (Mathews, Herring & Buffett 2002), of s = -1.0023181 + 0.000025 i."""
    published = Response(H, SPIN, -1.0023181 + 2.5e-5j, np.zeros(4, dtype=complex))
    assert abs(published.period / DAY + 430.21) < 5e-4  # measured: 5e-5
    assert abs(published.quality - 20_000) < 300  # 46 measured: the imaginary part has two digits


def test_a_body_without_strengths_answers_like_a_rigid_one_at_rest() -> None:
    rigid = Response(H, SPIN, -1.0023 + 0j, np.zeros(4, dtype=complex))
    assert rigid.transfer(np.array([0.0]))[0] == 1


@given(st.complex_numbers(max_magnitude=10, allow_nan=False))
def test_phases(amplitude: complex) -> None:
    in_phase, out = phases(np.array([amplitude]))
    assert -1j * (in_phase[0] + 1j * out[0]) == amplitude


def test_a_line_is_taken_away_and_nothing_else() -> None:
    t = np.linspace(-1, 1, 2001)
    wave = np.cos(2 * np.pi * 5 * t)
    series = np.stack([3 + 2 * t + wave, wave], axis=1)
    left = without_line(t, series)
    assert np.max(np.abs(left[:, 0] - left[:, 1])) < 1e-12
    assert abs(np.std(left[:, 0]) - np.sqrt(0.5)) < 1e-3


@given(st.floats(-3, 3), st.floats(0.01, 3.1))
def test_pole_and_its_angles(psi: float, omega: float) -> None:
    pole = pole_from(np.array([psi]), np.array([omega]))
    found = on_fixed_ecliptic(pole, np.eye(3))[0]
    assert np.allclose(found, [psi, omega], rtol=0, atol=1e-13)


def test_precession_angles_are_erfas() -> None:
    """psi_A and omega_A of IAU 2006 with its ecliptic give its eps_A, chi_A and p_A."""
    days = np.linspace(-40000, 40000, 41)
    expected = iau_models.precession_angles(days)
    found = precession_angles(expected[:, 0], expected[:, 1], iau_models.ecliptic_of_date(days))
    # 0.9 uas measured in p_A over a century: its polynomial is rounded for itself
    assert np.max(np.abs(found - expected)) / ARCSEC < 5e-6
