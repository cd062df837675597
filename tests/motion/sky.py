"""A sky for the tests of this folder: Sun and Moon from the kernel."""

import numpy as np

from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import ARCSEC, DAY
from earthspin.motion.forces import DynamicalFigure, Forces
from earthspin.sky.ephemeris import Ephemeris

UAS = 1e-6 * ARCSEC
GM = {"sun": SUN.gm, "moon": MOON.gm}
CODES = {"sun": 10, "moon": 301}
#: The pole of the GCRS is near enough to the Earth's.
NORTH = np.array([2e-5, -3e-5, 1.0]) / np.linalg.norm([2e-5, -3e-5, 1.0])


def figure(**changes: float) -> DynamicalFigure:
    """The round Earth, or one with some numbers changed."""
    numbers = {"h": EARTH.dynamical_flattening, "spin_rate": float(EARTH.spin_rate)} | changes
    return DynamicalFigure(**numbers)  # type: ignore[arg-type]


def forces(kernel: Ephemeris, body: DynamicalFigure | None = None, **changes: object) -> Forces:
    """Sun and Moon on a body."""
    return Forces(
        figure=body or figure(),
        gm=GM,
        positions=lambda times: kernel.positions(CODES, 399, times / DAY),
        **changes,  # type: ignore[arg-type]
    )
