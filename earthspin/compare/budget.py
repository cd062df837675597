"""What separates the simplest precession rate from the IAU's, effect by effect."""

from __future__ import annotations

from typing import Any

from earthspin.constants import ARCSEC_PER_YEAR, PUBLISHED_EFFECTS

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
