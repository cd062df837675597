"""Contributions of effects to the precession rate, and quantities that follow from this rate."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from earthspin import constants as c
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, NORMAL_95
from earthspin.mass.figure import polar_moment_factor
from earthspin.numerics.arrays import Numeric

if TYPE_CHECKING:
    from earthspin.nutation.analysis import Secular

# --- contributions to the precession rate ---------------------------------------------------------


def published_effects() -> dict[str, float]:
    """Published contributions to the rate of psi_A, rad/s, the largest first.

    Returns
    -------
    dict of str to float
        By effect, for effects other than the torque of Sun and Moon on the mean equator.
    """
    by_size = sorted(c.PUBLISHED_EFFECTS.items(), key=lambda item: -abs(item[1].value))
    return {effect: constant.value * ARCSEC_PER_YEAR for effect, constant in by_size}


def closure(rate: Numeric, iau_rate: float) -> Numeric:
    """Unexplained rate of psi_A: computed rate plus published effects minus IAU rate, rad/s.

    Parameters
    ----------
    rate : float
        Computed rate, rad/s.
    iau_rate : float
        IAU rate of psi_A at the same epoch, rad/s.
    """
    return rate + sum(published_effects().values()) - iau_rate


#: Label of the contribution of Sun and Moon on the mean equator, without any other effect.
FIRST_ORDER = "first-order"


def contributions(total: float, without: Mapping[str, float]) -> dict[str, float]:
    """Contribution of each effect to a precession rate: total rate minus rate without the effect.

    The remainder is the first-order rate.

    Parameters
    ----------
    total : float
        Rate with all effects.
    without : mapping of str to float
        Rate with one effect switched off, by effect.
    """
    effects = {effect: total - rate for effect, rate in without.items()}
    return {FIRST_ORDER: total - sum(effects.values())} | effects


def published_contributions(effects: Sequence[str]) -> dict[str, float]:
    """Published contribution of each effect to the rate of psi_A, rad/s; 0 if none is published."""
    first_order = c.FIRST_ORDER_RATE.value * math.cos(c.EPSILON_0.value * ARCSEC)
    first_order += c.J2_AND_TILT_RATE.value
    published = published_effects() | {FIRST_ORDER: first_order * ARCSEC_PER_YEAR}
    return {effect: published.get(effect, 0.0) for effect in effects}


@dataclass(frozen=True)
class RateBudget:
    """Contributions of effects to the rates of psi_A and omega_A at J2000.0, rad/s.

    The first-order rate comes first.

    Attributes
    ----------
    psi, psi_published, omega : dict of str to float
        Computed and published contributions, by effect.
    psi_error, omega_error : dict of str to float
        95 % half-widths: the error of the analysis, from a pole whose rate is known, and for the
        first order also the uncertainty of H. Those of the first order are those of the totals.
    psi_total, omega_total : float
        Computed rates.
    psi_rate_iau, omega_rate_iau : float
        Rates of IAU 2006.
    closure, omega_closure : float
        Computed rate plus the published non-linear term, minus the IAU rate.
    omega_closure_with_tides : float
        Closure including the published effect of tides on the obliquity.
    psi_from_h : float
        Standard deviation of the rate of psi_A due to that of H.
    psi_rate_analysis_error, omega_rate_analysis_error : float
        Error of the analysis, from applying it to the IAU pole.
    """

    psi: dict[str, float]
    psi_published: dict[str, float]
    omega: dict[str, float]
    psi_error: dict[str, float]
    omega_error: dict[str, float]
    psi_total: float
    omega_total: float
    psi_rate_iau: float
    omega_rate_iau: float
    closure: float
    omega_closure: float
    omega_closure_with_tides: float
    psi_from_h: float
    psi_rate_analysis_error: float
    omega_rate_analysis_error: float


def budget_of(
    computed: Secular,
    iau: Secular,
    without: Mapping[str, Secular],
    omitted: Sequence[str],
    psi_iau: float,
    u_h: float,
) -> RateBudget:
    """Contribution of each effect to the precession rates, from solutions without that effect.

    Parameters
    ----------
    computed, iau : Secular
        Secular motion of the computed pole with all effects, and of the IAU pole, from the same
        analysis.
    without : mapping of str to Secular
        Computed secular motion with one effect switched off, by effect.
    omitted : sequence of str
        Effects that are not included or do not affect a rate; their contribution is zero.
    psi_iau : float
        Rate of psi_A at J2000.0 in IAU 2006, rad/s.
    u_h : float
        Relative standard uncertainty of H.
    """
    zeros = dict.fromkeys(omitted, 0.0)
    omega_iau = c.OMEGA_A_RATE.value * ARCSEC_PER_YEAR
    tides = c.TIDES_IN_OBLIQUITY.value * ARCSEC_PER_YEAR
    psi_without = {e: path.psi_rate for e, path in without.items()}
    omega_without = {e: path.omega_rate for e, path in without.items()}
    psi = contributions(computed.psi_rate, psi_without) | zeros
    omega = contributions(computed.omega_rate, omega_without) | zeros
    psi_deviation = abs(iau.psi_rate - psi_iau)
    omega_deviation = abs(iau.omega_rate - omega_iau)

    def errors(shares: Mapping[str, float], deviation: float) -> dict[str, float]:
        of_h = {FIRST_ORDER: NORMAL_95 * u_h * abs(shares[FIRST_ORDER])}
        return {e: 0.0 if e in zeros else math.hypot(deviation, of_h.get(e, 0.0)) for e in shares}

    return RateBudget(
        psi=psi,
        psi_published=published_contributions(list(psi)),
        omega=omega,
        psi_error=errors(psi, psi_deviation),
        omega_error=errors(omega, omega_deviation),
        psi_total=computed.psi_rate,
        omega_total=computed.omega_rate,
        psi_rate_iau=psi_iau,
        omega_rate_iau=omega_iau,
        closure=computed.psi_rate + published_effects()["nonrigid"] - psi_iau,
        omega_closure=computed.omega_rate - omega_iau,
        omega_closure_with_tides=computed.omega_rate + tides - omega_iau,
        psi_from_h=u_h * abs(psi[FIRST_ORDER]),
        psi_rate_analysis_error=psi_deviation,
        omega_rate_analysis_error=omega_deviation,
    )


# --- H and C that the rate implies ----------------------------------------------------------------
# The published H is inferred from the observed precession, so closure of the rate only tests
# consistency. So does C of PREM, whose data include a moment of inertia from the precession.

#: Effects whose published sizes measure the error of the computed ones.
COMPARED = ("planets", "j4", "geodesic", "second-order")


def prem_polar_moment(radius: Numeric, j2: Numeric) -> Numeric:
    """Polar moment factor C/(M a2) of the Earth model PREM, for reference radius a (m) and J2.

    Its mean moment I = (A + B + C)/3 and C - (A + B)/2 = J2 M a2 give C = I + (2/3) J2 M a2.
    """
    return c.PREM_MEAN_MOMENT.value * (c.PREM_RADIUS.value / radius) ** 2 + 2 / 3 * j2


class Flattening(NamedTuple):
    """Values of H and C/(M a2) from one source, with their standard uncertainties.

    Attributes
    ----------
    h, h_uncertainty : float
    moment, moment_uncertainty : float
    """

    h: float
    h_uncertainty: float
    moment: float
    moment_uncertainty: float


def inferred_h(budget: RateBudget, h: float) -> tuple[float, float]:
    """Value of H that makes computed and IAU precession rates equal, and its standard uncertainty.

    The standard uncertainty follows from the root sum square of the differences between computed
    and published effects, and from the error of the same analysis for a pole whose rate is known.

    Parameters
    ----------
    budget : RateBudget
    h : float
        H used in the budget.
    """
    compared = [effect for effect in budget.psi if effect in COMPARED]
    spread = math.sqrt(sum((budget.psi[e] - budget.psi_published[e]) ** 2 for e in compared))
    # all effects except geodesic precession are proportional to H
    proportional_rate = sum(rate for effect, rate in budget.psi.items() if effect != "geodesic")
    uncertainty = abs(h / proportional_rate) * math.hypot(spread, budget.psi_rate_analysis_error)
    return h * (1 - budget.closure / proportional_rate), uncertainty


def compared_flattenings(
    budget: RateBudget, h: float, j2: float, radius: float, *, u_h: float, u_j2: float
) -> dict[str, Flattening]:
    """Values of H and C/(M a2) by source: published, from the IAU precession rate, and from PREM.

    Parameters
    ----------
    budget : RateBudget
    h, j2 : float
        Values used in the budget.
    radius : float
        Reference radius of `j2`, m.
    u_h, u_j2 : float
        Relative standard uncertainties of `h` and `j2`.
    """

    def from_h(value: float, uncertainty: float) -> Flattening:
        moment = float(polar_moment_factor(j2, value))
        return Flattening(
            value, uncertainty, moment, moment * math.hypot(uncertainty / value, u_j2)
        )

    prem = prem_polar_moment(radius, j2)
    # PREM states no errors: half a unit of its last printed digit is used
    u_prem = c.PREM_MEAN_MOMENT.relative_uncertainty
    return {
        "published": from_h(h, u_h * h),
        "from the IAU's rate": from_h(*inferred_h(budget, h)),
        "PREM": Flattening(j2 / prem, j2 / prem * u_prem, prem, prem * u_prem),
    }


# --- equinox, year and calendar -------------------------------------------------------------------
# Sun and Moon move the equator along the fixed ecliptic; the planets tilt the ecliptic. The sum,
# the general precession, shifts the seasons. The calendar drifts relative to the *tropical* year,
# which includes precession, by one day in 128 years; the source text has 129.4 without a
# derivation.

#: Years in which the Gregorian calendar drops one leap day: three in 400 years (I.8).
DROPPED_LEAP_DAY = 400 / 3
#: Mean Gregorian year: 97 leap days in 400 years, s.
GREGORIAN_YEAR = (365 + 97 / 400) * DAY


def general_precession(rate: Numeric, chi_rate: float, obliquity: float) -> Numeric:
    """General precession in longitude: lunisolar precession minus ecliptic motion, rad/s.

    p_A = psi_A - chi_A cos(epsilon), Capitaine et al. 2003, sect. 6.

    Parameters
    ----------
    rate : float
        Precession of the equator in longitude, rad/s.
    chi_rate : float
        Rate of the ecliptic along the equator, rad/s.
    obliquity : float
        rad.
    """
    return rate - chi_rate * math.cos(obliquity)


def time_per_degree(rate: Numeric) -> Numeric:
    """Time in which a given rate (rad/s) accumulates to one degree, s."""
    return math.radians(1.0) / rate


def tropical_year(rate: Numeric, sidereal_year: float) -> Numeric:
    """Length of the tropical year, s.

    Parameters
    ----------
    rate : float
        General precession, rad/s; the equinox moves towards the Sun.
    sidereal_year : float
        s.
    """
    return 2 * math.pi / (2 * math.pi / sidereal_year + rate)


def time_per_day_of_drift(tropical: Numeric, calendar: float = JULIAN_YEAR) -> Numeric:
    """Time in which a calendar year of given length drifts by one day from the seasons, s.

    Parameters
    ----------
    tropical : float
        Tropical year, s.
    calendar : float
        Mean year of the calendar, s: the Julian one, 365.25 days, by default.
    """
    return DAY / (calendar - tropical) * JULIAN_YEAR
