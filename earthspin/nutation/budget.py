"""What separates the simplest precession rate from the IAU's, effect by effect."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from earthspin.constants import (
    ARCSEC,
    ARCSEC_PER_YEAR,
    EPSILON_0,
    FIRST_ORDER_RATE,
    J2_AND_TILT_RATE,
    OMEGA_A_RATE,
    PUBLISHED_EFFECTS,
)

Numeric = Any


def published_effects() -> dict[str, float]:
    """Published contributions to the rate of psi_A, rad/s, the largest first.

    Returns
    -------
    dict of str to float
        By effect; each is absent from the torque of sun and moon on the mean equator.
    """
    by_size = sorted(PUBLISHED_EFFECTS.items(), key=lambda item: -abs(item[1].value))
    return {effect: constant.value * ARCSEC_PER_YEAR for effect, constant in by_size}


def closure(rate: Numeric, iau_rate: float) -> Numeric:
    """What remains of the difference after every published effect is added to our rate.

    Parameters
    ----------
    rate : float
        Ours, rad/s.
    iau_rate : float
        That of psi_A at the same epoch, rad/s.
    """
    return rate + sum(published_effects().values()) - iau_rate


#: Label of what Sun and Moon do on the mean equator, before any effect is switched on.
FIRST_ORDER = "first-order"


def contributions(total: float, without: Mapping[str, float]) -> dict[str, float]:
    """Share of each effect in a rate, measured by switching it off; the first order is the rest.

    Parameters
    ----------
    total : float
        With everything switched on.
    without : mapping of str to float
        With one effect switched off, by effect.
    """
    shares = {effect: total - rate for effect, rate in without.items()}
    return {FIRST_ORDER: total - sum(shares.values())} | shares


def published_contributions(effects: Sequence[str]) -> dict[str, float]:
    """Published shares of the rate of psi_A at J2000.0, rad/s; 0 for what is not in the table."""
    published = published_effects() | {
        FIRST_ORDER: (
            FIRST_ORDER_RATE.value * math.cos(EPSILON_0.value * ARCSEC) + J2_AND_TILT_RATE.value
        )
        * ARCSEC_PER_YEAR
    }
    return {effect: published.get(effect, 0.0) for effect in effects}


def full_closure(rate: float, iau_rate: float) -> float:
    """Our rate with all effects, plus the published non-linear term, less the IAU's, rad/s."""
    return rate + published_effects()["nonrigid"] - iau_rate


def iau_omega_rate() -> float:
    """Rate of omega_A at J2000.0 in IAU 2006, rad/s."""
    return OMEGA_A_RATE.value * ARCSEC_PER_YEAR
