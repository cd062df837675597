"""Precession angles, nutation terms and the Earth's response."""

import numpy as np
import pytest

from earthspin.constants import ARCSEC, DAY, DAYS_PER_CENTURY, SIDEREAL_YEAR, UAS
from earthspin.interior.layers import PREM
from earthspin.interior.love import elastic
from earthspin.interior.modes import parts_of, system, wobble_response
from earthspin.nutation.analysis import (
    MULTIPLES,
    FrequencyAnalysis,
    on_fixed_ecliptic,
    pole_from,
    precession_angles,
)
from earthspin.nutation.rate_budget import contributions, general_precession, tropical_year
from earthspin.nutation.response import Response, fit_response
from earthspin.sky import iau_models
from earthspin.torque.rates import period, period_error, rate_ratio
from tests.extreme import Distances, holds
from tests.reference.sky import SPIN, H

#: Times over a century, days from J2000.0.
DAYS = np.arange(-18000.0, 18000.0, 9.7)


@holds(bound=5e-15)
def test_angles_at_the_pole() -> Distances:
    """longitude and inclination of a pole 1e-12 rad from the ecliptic pole

    Hard because: the longitude is that of a vector of length 1e-12; an arc cosine would give zero
    Compared with: original longitude and inclination, relative, from 0 to 180 degrees
    """
    for omega in (1e-150, 1e-12, 1e-3, np.pi / 2, np.pi - 1e-3):
        psi = np.linspace(-3.1, 3.1, 21)
        result = on_fixed_ecliptic(pole_from(psi, np.full(21, omega)), np.eye(3))
        yield (result[:, 0] - psi) / np.pi
        yield result[:, 1] / omega - 1


@holds(bound=2e-4, unit="uas")
def test_still_ecliptic() -> Distances:
    """precession angles with respect to an ecliptic that does not move

    Hard because: chi_A and p_A are angles between equal directions
    Compared with: eps_A = omega_A, chi_A = 0, p_A = psi_A
    """
    psi, omega = np.linspace(-2.0, 2.0, 41), np.full(41, 0.409)
    result = precession_angles(psi, omega, np.broadcast_to([0.0, 0.0, 1.0], (41, 3)))
    exact = np.column_stack([psi, omega, omega, 0 * psi, psi])
    yield (result - exact) / UAS


@pytest.mark.slow
@holds(bound=1e-7)
def test_faint_line() -> Distances:
    """fit of a nutation term with 1e-9 of the amplitude of the largest term

    Hard because: 153 terms are fitted together, and some have neighbours that a century hardly
        separates
    Compared with: original amplitude, relative
    """
    arguments, rates = iau_models.delaunay_arguments(DAYS), iau_models.delaunay_rates()
    faint = np.exp(-1j * (MULTIPLES[40] @ arguments))
    eta = 1e9 * np.exp(1j * (MULTIPLES[0] @ arguments)) + faint
    result = FrequencyAnalysis(DAYS / DAYS_PER_CENTURY, arguments, rates)(eta)
    yield complex(result.amplitude[len(MULTIPLES) + 40]) - 1


@holds(bound=1e-9, unit="d")
def test_resonance() -> Distances:
    """fit of a free core nutation period close to that of the annual nutation term

    Hard because: a term at a relative distance of 3e-4 from the resonance is amplified a
        thousandfold
    Compared with: original period of the free core nutation
    """
    strengths = np.array([-0.14 + 0.03j, -0.93 + 0.07j, 0.049, 2.8e-4])
    true = Response(H, SPIN, -1.0025 + 1e-6j, strengths)
    frequency = np.concatenate([MULTIPLES, -MULTIPLES]) @ iau_models.delaunay_rates()
    rng = np.random.default_rng(8)
    both = ARCSEC * rng.normal(size=(2, frequency.size))
    rigid = both[0] + 1j * both[1]
    result = fit_response(frequency, rigid, true.transfer(frequency) * rigid, H, SPIN)
    yield (result.period - true.period) / DAY


@holds(bound=5e-15)
def test_budget() -> Distances:
    """budget of the precession rate in which large contributions cancel

    Hard because: effects of both signs are a million times larger than their sum
    Compared with: the rate as the sum of all contributions, relative to the largest one
    """
    without = {"a": 1e6, "b": -1e6 + 0.25, "c": 1.0, "d": 1.0 + 1e-9}
    yield (sum(contributions(1.0, without).values()) - 1.0) / 1e6


@holds(bound=0.0)
def test_at_rest() -> Distances:
    """periods derived from the precession rate of an Earth without precession

    Hard because: periods are infinite, and ratios are 0/0
    Compared with: infinite period and error, ratio 1, tropical year equal to the sidereal year
    """
    year = SIDEREAL_YEAR.value
    yield ~np.isposinf(period(np.zeros(2)))
    yield ~np.isposinf(period_error(np.zeros(2), 1.0))
    yield rate_ratio(np.zeros(3)) - 1
    yield tropical_year(0.0, year) / year - 1
    yield general_precession(0.0, 0.0, 0.4)


@holds(bound=5e-7)
def test_near_resonance() -> Distances:
    """transfer function of nutation at 1e-8 of the spin rate from a resonance

    Hard because: four modes that each grow without limit must be separated
    Compared with: sum of the partial fractions of the system, relative
    """
    parts = parts_of(PREM, SPIN, elastic(PREM).response, H / (1 - H))
    p, q, right, left = system(parts)
    modes, vectors = np.linalg.eig(np.linalg.solve(p, -q))
    for mode in modes.real:
        sigma = mode + np.array([-1e-8, 1e-8])
        forced = np.linalg.solve(p, np.multiply.outer(right, sigma) + left[:, None])
        shares = np.linalg.solve(vectors, forced) / (sigma - modes[:, None])
        yield np.abs((vectors @ shares)[0] / wobble_response(parts, sigma) - 1)
