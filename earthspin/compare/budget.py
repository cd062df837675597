"""What separates the simplest precession rate from the IAU's, effect by effect."""

from __future__ import annotations

from typing import Any

from earthspin.constants import ARCSEC_PER_YEAR, PSI_A_RATE, PUBLISHED_EFFECTS

Numeric = Any


def published_effects() -> dict[str, float]:
    """Published contributions to the rate of psi_A at J2000.0, rad/s, the largest first.

    Returns
    -------
    dict of str to float
        By effect; each is absent from the torque of sun and moon on the mean equator.
    """
    by_size = sorted(PUBLISHED_EFFECTS.items(), key=lambda item: -abs(item[1].value))
    return {effect: constant.value * ARCSEC_PER_YEAR for effect, constant in by_size}


def iau_rate() -> float:
    """Rate of psi_A at J2000.0 in IAU 2006, rad/s."""
    return PSI_A_RATE.value * ARCSEC_PER_YEAR


def difference_from_iau(rate: Numeric) -> Numeric:
    """Our rate minus the IAU's, rad/s."""
    return rate - iau_rate()


def closure(rate: Numeric) -> Numeric:
    """What remains of the difference after every published effect is added to our rate, rad/s."""
    return difference_from_iau(rate) + sum(published_effects().values())
