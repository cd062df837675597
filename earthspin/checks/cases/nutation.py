"""Stiff and extreme cases of our pole beside the IAU's."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.case import Cases
from earthspin.checks.default_body import default_body
from earthspin.constants import ARCSEC, DAY, SIDEREAL_YEAR
from earthspin.nutation.angles import on_fixed_ecliptic, pole_from, precession_angles
from earthspin.nutation.budget import contributions
from earthspin.nutation.nutation import MULTIPLES, FrequencyAnalysis
from earthspin.nutation.response import Response, fit_response
from earthspin.nutation.seasons import general_precession, tropical_year
from earthspin.sky import iau
from earthspin.torque.rates import period, period_error, rate_ratio

FloatArray = NDArray[np.float64]

CASES = Cases("nutation")

UAS = 1e-6 * ARCSEC
#: A century of days.
DAYS = np.arange(-18000.0, 18000.0, 9.7)


@CASES.hold(
    "angles of a pole a picoradian from the ecliptic's",
    because="the longitude is that of a vector of 1e-12; an arc cosine would see nothing",
    against="the longitude and inclination that made it, relative, at 0, 90 and 180 degrees",
    bound=5e-15,
)
def _angles_at_the_pole() -> float:
    worst = 0.0
    for omega in (1e-150, 1e-12, 1e-3, np.pi / 2, np.pi - 1e-3):
        psi = np.linspace(-3.1, 3.1, 21)
        found = on_fixed_ecliptic(pole_from(psi, np.full(21, omega)), np.eye(3))
        worst = max(worst, float(np.max(np.abs(found[:, 0] - psi))) / np.pi)
        worst = max(worst, float(np.max(np.abs(found[:, 1] / omega - 1))))
    return worst


@CASES.hold(
    "ecliptic of date that has not moved",
    because="chi_A and p_A are angles between directions that agree",
    against="eps_A = omega_A, chi_A = 0, p_A = psi_A",
    unit="uas",
    bound=2e-4,
)
def _still_ecliptic() -> float:
    psi, omega = np.linspace(-2.0, 2.0, 41), np.full(41, 0.409)
    found = precession_angles(psi, omega, np.broadcast_to([0.0, 0.0, 1.0], (41, 3)))
    exact = np.column_stack([psi, omega, omega, 0 * psi, psi])
    return float(np.max(np.abs(found - exact)) / UAS)


@CASES.hold(
    "precession angles from 1550 to 2650",
    because="five angles by vectors, against five polynomials far from their epoch",
    against="IAU 2006 (ERFA p06e): its own p_A and eps_A from its psi_A, omega_A and ecliptic",
    unit="uas",
    bound=2000.0,
)
def _angles_of_eleven_centuries() -> float:
    days = np.linspace(-164_000.0, 237_000.0, 60)
    exact = iau.precession_angles(days)
    found = precession_angles(exact[:, 0], exact[:, 1], iau.ecliptic_of_date(days))
    return float(np.max(np.abs(found - exact)) / UAS)


@CASES.hold(
    "a nutation of 1e-9 of the largest",
    because="153 circles at once, some with neighbours that a century hardly parts",
    against="the amplitude that was put in, over itself",
    bound=1e-7,
    slow=True,
)
def _faint_line() -> float:
    arguments, rates = iau.delaunay_arguments(DAYS), iau.delaunay_rates()
    faint = np.exp(-1j * (MULTIPLES[40] @ arguments))
    eta = 1e9 * np.exp(1j * (MULTIPLES[0] @ arguments)) + faint
    found = FrequencyAnalysis(DAYS / 36525, arguments, rates)(eta)
    return abs(complex(found.amplitude[len(MULTIPLES) + 40]) - 1)


@CASES.hold(
    "a response whose core resonates next to the annual term",
    because="a term within 3e-4 of the resonance is amplified a thousandfold",
    against="the period of the free core nutation that was put in",
    unit="d",
    bound=1e-9,
)
def _resonance() -> float:
    body = default_body()
    h, spin = float(body.needed("dynamical_flattening")), float(body.spin_rate)
    true = Response(
        h, spin, -1.0025 + 1e-6j, np.array([-0.14 + 0.03j, -0.93 + 0.07j, 0.049, 2.8e-4])
    )
    frequency = np.concatenate([MULTIPLES, -MULTIPLES]) @ iau.delaunay_rates()
    rng = np.random.default_rng(8)
    both = ARCSEC * rng.normal(size=(2, frequency.size))
    rigid = both[0] + 1j * both[1]
    found = fit_response(frequency, rigid, true.transfer(frequency) * rigid, h, spin)
    return abs(found.period - true.period) / DAY


@CASES.hold(
    "a budget whose shares cancel",
    because="effects of either sign a million times their sum",
    against="the sum of all shares is the rate, over the largest share",
    bound=5e-15,
)
def _budget() -> float:
    without = {"a": 1e6, "b": -1e6 + 0.25, "c": 1.0, "d": 1.0 + 1e-9}
    return abs(sum(contributions(1.0, without).values()) - 1.0) / 1e6


@CASES.hold(
    "no precession at all",
    because="periods are infinite, and ratios 0/0",
    against="infinite period and error, ratio 1, tropical year equal to the sidereal one",
    bound=0.0,
)
def _at_rest() -> float:
    year = SIDEREAL_YEAR.value
    infinite = np.isposinf(period(np.zeros(2))) & np.isposinf(period_error(np.zeros(2), 1.0))
    same = float(np.max(np.abs(rate_ratio(np.zeros(3)) - 1)))
    drift = abs(float(tropical_year(0.0, year)) / year - 1)
    slide = abs(float(general_precession(0.0, 0.0, 0.4)))
    return float(np.sum(~infinite)) + same + drift + slide
