"""Simulated celestial pole offsets: noise with memory, and an excited free core nutation."""

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from earthspin.nutation import core_nutation

#: Noise of simulated series: name, size in mas and memory in days of each part of it.
NOISES = {
    "white": ((0.1, 0.0),),
    "memory of 20 d": ((0.12, 20.0),),
    "memory of 60 d": ((0.12, 60.0),),
    "memory of 200 d": ((0.12, 200.0),),
    "memories of 60 and 3 d": ((0.08, 60.0), (0.08, 3.0)),
}


def noise(
    rng: np.random.Generator, count: int, parts: tuple[tuple[float, float], ...]
) -> NDArray[np.complex128]:
    """Complex noise of given sizes and memories."""
    total = np.zeros(count, dtype=complex)
    for size, memory in parts:
        fall = np.exp(-1 / memory) if memory else 0.0
        start = round(10 * memory)
        drive = rng.standard_normal((count + start, 2)) @ [1, 1j] * np.sqrt((1 - fall**2) / 2)
        total += size * lfilter([1.0], [1.0, -fall], drive)[start:]
    return total


def excited(seed: int, years: float = 42.0) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
    """Simulate offsets in mas with a core nutation that random excitation changes.

    The complex amplitude starts at 0.2 mas and walks by 0.05 mas in a year in either coordinate,
    about as observed.
    """
    rng = np.random.default_rng(seed)
    days = np.arange(round(years * 365.25)).astype(float)
    walk = rng.standard_normal((days.size, 2)) @ [1, 1j] * 0.05 / np.sqrt(365.25)
    core = (0.2 + np.cumsum(walk)) * core_nutation.circle(days)
    year = 0.03 * np.exp(2j * np.pi * days / 365.25)
    return days, core + year + noise(rng, days.size, ((0.1, 40.0), (0.08, 3.0)))
