"""A sky for the tests of this folder: Sun and Moon from the kernel, tides on demand."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BarycentricInterpolator

from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import ARCSEC, DAY
from earthspin.motion.forces import Figure, Forces
from earthspin.sky.ephemeris import Ephemeris

FloatArray = NDArray[np.float64]
UAS = 1e-6 * ARCSEC
GM = {"sun": SUN.gm, "moon": MOON.gm}
CODES = {"sun": 10, "moon": 301}
#: The pole of the GCRS is near enough to the Earth's.
NORTH = np.array([2e-5, -3e-5, 1.0]) / np.linalg.norm([2e-5, -3e-5, 1.0])


def figure(**changes: float) -> Figure:
    """The round Earth, or one with some numbers changed."""
    numbers = {"h": EARTH.dynamical_flattening, "spin_rate": float(EARTH.spin_rate)} | changes
    return Figure(**numbers)  # type: ignore[arg-type]


def forces(kernel: Ephemeris, body: Figure | None = None, **changes: object) -> Forces:
    """Sun and Moon on a body."""
    return Forces(
        figure=body or figure(),
        gm=GM,
        positions=lambda times: kernel.positions(CODES, 399, times / DAY),
        **changes,  # type: ignore[arg-type]
    )


def tide(kernel: Ephemeris, end: float) -> Callable[[float], FloatArray]:
    """Tidal tensor at any time from 0 to `end`, from pieces of 2 d on Chebyshev nodes.

    It shares no node, rule or formula with the windows of the solver.
    """
    piece = 2 * DAY
    x = np.cos(np.pi * (np.arange(16) + 0.5) / 16)
    weights = BarycentricInterpolator(x, np.zeros(16)).wi
    count = int(end / piece) + 2
    times = piece * (np.arange(count)[:, np.newaxis] + (x + 1) / 2)
    found = kernel.positions(CODES, 399, times.ravel() / DAY)
    tensor = sum(
        GM[name]
        * (r / (np.linalg.norm(r, axis=1) ** 5)[:, np.newaxis])[:, :, np.newaxis]
        * r[:, np.newaxis, :]
        for name, r in found.items()
    )
    values = np.asarray(tensor).reshape(count, 16, 9)

    def at(time: float) -> FloatArray:
        index = int(time / piece)
        share = weights / (2 * (time / piece - index) - 1 - x)
        return np.asarray(share @ values[index] / share.sum()).reshape(3, 3)

    return at
