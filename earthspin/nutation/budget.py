"""Contributions of all effects to the precession rate, compared with IAU 2006."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.constants import (
    ARCSEC,
    ARCSEC_PER_YEAR,
    EPSILON_0,
    FIRST_ORDER_RATE,
    J2_AND_TILT_RATE,
    NORMAL_95,
    OMEGA_A_RATE,
    PUBLISHED_EFFECTS,
    TIDES_IN_OBLIQUITY,
)

if TYPE_CHECKING:
    from earthspin.nutation.analysis import Secular

Numeric = Any


def published_effects() -> dict[str, float]:
    """Published contributions to the rate of psi_A, rad/s, the largest first.

    Returns
    -------
    dict of str to float
        By effect, for effects other than the torque of Sun and Moon on the mean equator.
    """
    by_size = sorted(PUBLISHED_EFFECTS.items(), key=lambda item: -abs(item[1].value))
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
    """Contribution of each effect to a precession rate: rate with all minus rate without it.

    The remainder is the first-order rate.

    Parameters
    ----------
    total : float
        Rate with all effects.
    without : mapping of str to float
        Rate with one effect switched off, by effect.
    """
    shares = {effect: total - rate for effect, rate in without.items()}
    return {FIRST_ORDER: total - sum(shares.values())} | shares


def published_contributions(effects: Sequence[str]) -> dict[str, float]:
    """Published contribution of each effect to the rate of psi_A, rad/s; 0 if none is published."""
    published = published_effects() | {
        FIRST_ORDER: (
            FIRST_ORDER_RATE.value * math.cos(EPSILON_0.value * ARCSEC) + J2_AND_TILT_RATE.value
        )
        * ARCSEC_PER_YEAR
    }
    return {effect: published.get(effect, 0.0) for effect in effects}


def full_closure(rate: float, iau_rate: float) -> float:
    """Unexplained rate of psi_A: rate computed with all effects minus that of IAU 2006, rad/s.

    The published non-linear term is added to the computed rate.
    """
    return rate + published_effects()["nonrigid"] - iau_rate


def iau_omega_rate() -> float:
    """Rate of omega_A at J2000.0 in IAU 2006, rad/s."""
    return OMEGA_A_RATE.value * ARCSEC_PER_YEAR


@dataclass(frozen=True)
class Budget:
    """Contributions of effects to the rates of psi_A and omega_A at J2000.0, rad/s.

    The first-order rate comes first.

    Attributes
    ----------
    psi, psi_published, omega : dict of str to float
        Computed and published contributions, by effect.
    psi_error, omega_error : dict of str to float
        95 % half-widths: the error of the analysis, from a pole whose rate is known, and for the
        first order also the uncertainty of H.
    psi_total, omega_total : float
        Computed rates.
    psi_total_error, omega_total_error : float
        95 % half-widths.
    psi_iau, omega_iau : float
        Rates of IAU 2006.
    closure, omega_closure : float
        Computed rate plus the published non-linear term, minus the IAU rate.
    omega_closure_with_tides : float
        Closure including the published effect of tides on the obliquity.
    psi_from_h : float
        Standard deviation of the rate of psi_A due to that of H.
    psi_analysis_error, omega_analysis_error : float
        Error of the analysis, from applying it to the IAU pole.
    """

    psi: dict[str, float]
    psi_published: dict[str, float]
    omega: dict[str, float]
    psi_error: dict[str, float]
    omega_error: dict[str, float]
    psi_total: float
    omega_total: float
    psi_total_error: float
    omega_total_error: float
    psi_iau: float
    omega_iau: float
    closure: float
    omega_closure: float
    omega_closure_with_tides: float
    psi_from_h: float
    psi_analysis_error: float
    omega_analysis_error: float


def budget_of(
    ours: Secular,
    theirs: Secular,
    without: Mapping[str, Secular],
    off: Sequence[str],
    psi_iau: float,
    u_h: float,
) -> Budget:
    """Compute the budget of precession rates, from solutions with each effect switched off in turn.

    Parameters
    ----------
    ours, theirs : Secular
        Secular motion of the computed pole with all effects, and of the IAU pole, from the same
        analysis.
    without : mapping of str to Secular
        Computed secular motion with one effect switched off, by effect.
    off : sequence of str
        Effects that are not included or do not affect a rate; their contribution is zero.
    psi_iau : float
        Rate of psi_A at J2000.0 in IAU 2006, rad/s.
    u_h : float
        Relative standard uncertainty of H.
    """
    none = dict.fromkeys(off, 0.0)
    psi = contributions(ours.psi_rate, {e: path.psi_rate for e, path in without.items()}) | none
    omega = (
        contributions(ours.omega_rate, {e: path.omega_rate for e, path in without.items()}) | none
    )
    psi_missed = abs(theirs.psi_rate - psi_iau)
    omega_missed = abs(theirs.omega_rate - iau_omega_rate())

    def errors(shares: Mapping[str, float], missed: float) -> dict[str, float]:
        of_h = {FIRST_ORDER: NORMAL_95 * u_h * abs(shares[FIRST_ORDER])}
        return {e: 0.0 if e in none else math.hypot(missed, of_h.get(e, 0.0)) for e in shares}

    psi_error, omega_error = errors(psi, psi_missed), errors(omega, omega_missed)
    return Budget(
        psi=psi,
        psi_published=published_contributions(list(psi)),
        omega=omega,
        psi_error=psi_error,
        omega_error=omega_error,
        psi_total=ours.psi_rate,
        omega_total=ours.omega_rate,
        psi_total_error=psi_error[FIRST_ORDER],
        omega_total_error=omega_error[FIRST_ORDER],
        psi_iau=psi_iau,
        omega_iau=iau_omega_rate(),
        closure=full_closure(ours.psi_rate, psi_iau),
        omega_closure=ours.omega_rate - iau_omega_rate(),
        omega_closure_with_tides=ours.omega_rate
        + TIDES_IN_OBLIQUITY.value * ARCSEC_PER_YEAR
        - iau_omega_rate(),
        psi_from_h=u_h * abs(psi[FIRST_ORDER]),
        psi_analysis_error=psi_missed,
        omega_analysis_error=omega_missed,
    )
