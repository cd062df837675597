"""Test if a record of polar motion contains a free wobble, from its power spectrum.

A model without a wobble has a smooth spectrum. What it would hold between the periods of `BAND` is
taken from the bands on either side, as a power of the frequency, and the power there is compared
with it by Fisher's ratio.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtri

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.record import BAND, YEAR, in_blocks, without_known_terms

BLOCK = 30.0  # d
#: Periods of the neighbours, slower and faster, d; what the seasons leave is not among them.
SLOWER, FASTER = (780.0, 500.0), (345.0, 230.0)
#: Chance that noise alone passes.
FALSE_ALARM = 1e-2
#: Share of a record that rounding leaves of drift and seasons.
ROUNDING = 1e-9


def need_wobble(time: FloatArray, p: ComplexArray) -> None:
    """Refuse a record of polar motion without a significant peak of the free wobble.

    Parameters
    ----------
    time : array, shape (n,)
        d, evenly spaced.
    p : complex array, shape (n,)

    Raises
    ------
    UndefinedError
        If nothing is left beside drift and seasons, or what is left has no peak.
    """
    t, means, _ = in_blocks(time, p, BLOCK)
    rest = without_known_terms(t, means)
    if np.max(abs(rest)) <= ROUNDING * np.max(abs(p)):
        raise UndefinedError("no free wobble: the pole stands still but for drift and seasons")
    spectrum = Periodogram.of(t, rest)
    ratio, needed = spectrum.ratio()
    if ratio < needed:
        raise UndefinedError(
            f"no free wobble between {BAND[0]:.0f} and {BAND[1]:.0f} d stands out: the power there "
            f"is {ratio:.2g} times that of a smooth spectrum, and {needed:.2g} times could be noise"
        )
    peak = spectrum.peak()
    if not BAND[0] <= peak <= BAND[1]:
        raise UndefinedError(
            f"no free wobble between {BAND[0]:.0f} and {BAND[1]:.0f} d stands out: there is more "
            f"power at {peak:.0f} d"
        )


@dataclass(frozen=True)
class Periodogram:
    """Power spectrum of prograde polar motion; the annual frequency is left out.

    Attributes
    ----------
    frequency, power : array, shape (n,)
        Cycles per day; power in any unit.
    """

    frequency: FloatArray
    power: FloatArray

    @classmethod
    def of(cls, time: FloatArray, rest: ComplexArray) -> Periodogram:
        """Compute the power spectrum of polar motion from which drift and seasons were removed."""
        length = (time[-1] - time[0]) * time.size / (time.size - 1)
        frequency = np.arange(1, int(length / FASTER[1]) + 1) / length
        frequency = frequency[abs(frequency - 1 / YEAR) > 1 / length]
        sums = np.exp(-2j * np.pi * np.outer(frequency, time)) @ rest
        return cls(frequency, np.asarray(abs(sums) ** 2, dtype=float))

    def between(self, longest: float, shortest: float) -> Periodogram:
        """Select the part of the power spectrum between two periods, d."""
        inside = (self.frequency >= 1 / longest) & (self.frequency <= 1 / shortest)
        return Periodogram(self.frequency[inside], self.power[inside])

    def ratio(self) -> tuple[float, float]:
        """Mean power near the wobble frequency over that of noise, and the limit for pure noise.

        Noise alone exceeds the limit with a probability of `FALSE_ALARM`.
        """
        band, slower, faster = (self.between(*ends) for ends in (BAND[::-1], SLOWER, FASTER))
        at, low, high = (np.log(part.frequency).mean() for part in (band, slower, faster))
        weight = (at - low) / (high - low)
        expected = slower.power.mean() ** (1 - weight) * faster.power.mean() ** weight
        # The expected power scatters as the two parts do, each with its weight.
        scatter = (1 - weight) ** 2 / slower.power.size + weight**2 / faster.power.size
        needed = fdtri(2 * band.power.size, 2 / scatter, 1 - FALSE_ALARM)
        return float(band.power.mean() / expected), float(needed)

    def peak(self) -> float:
        """Period at which the power is largest, in the wobble band or at shorter periods, d."""
        part = self.between(BAND[1], FASTER[1])
        return float(1 / part.frequency[np.argmax(part.power)])
