"""Numbers of the page on the whole attitude."""

from __future__ import annotations

import numpy as np

import earthspin
from data_tools import lunar_rotation
from data_tools.coverage.rotation import moon
from earthspin.constants import ARCSEC, DAY
from tests.docs.numbers.sentence import Sentence, Told
from tests.questions.test_rotation import libration, moonlet

PAGE = "docs/rotation.md"


def phobos() -> list[float]:
    """Amplitude of the libration (deg), the axes (km) and what was observed (deg)."""
    period, eccentricity, axes = 0.31891, 0.0151, (13.0e3, 11.4e3, 9.1e3)
    sigma = (axes[0] ** 2 - axes[1] ** 2) / (axes[0] ** 2 + axes[1] ** 2)
    amplitude = 2 * eccentricity / (1 / (3 * sigma) - 1)
    found = earthspin.rotation(
        "2000-01-01T12:00",
        "2000-01-31T12:00",
        "20 min",
        body=moonlet("mars", axes, period, eccentricity),
        perturbers=["mars"],
        start_attitude=[1, 0, 0, 0],
        start_omega=[0, 0, 2 * np.pi / (period * DAY) * (1 - amplitude)],
    )
    # the forced part alone: what goes with the mean anomaly
    days = np.arange(found.sizes["time"]) / 72
    forced = np.mean(libration(found, period) * np.exp(-2j * np.pi * days / period))
    return [2 * abs(forced), *(axis / 1e3 for axis in axes), 1.14]


J2000 = 2451545.0


def moon_of_de421() -> list[float]:
    """Days after the start, and how far the Moon is then from DE421, arcsec."""
    days = (10.0, 360.0)
    apart = moon(J2000, days)[0]
    return [apart[0], days[0], apart[1], days[1]]


def moon_with_all_effects() -> list[float]:
    """The same by an independent integration with all effects."""
    found = lunar_rotation.attitudes(J2000, [360.0], lunar_rotation.EFFECTS)[0]
    away = (lunar_rotation.librations()[J2000 + 360.0][0].inv() * found).magnitude()
    return [float(away) / ARCSEC, 360.0]


MEASURED = [
    Sentence(
        PAGE,
        "is {}″ away from DE421 after {} days and {}″ after {} days",
        moon_of_de421,
    ),
    Sentence(
        PAGE,
        "the independent integration is {}″ away after {} days",
        moon_with_all_effects,
    ),
    Sentence(
        PAGE,
        "by {}° for a homogeneous ellipsoid of its axes\n({} × {} × {} km, the IAU's), "
        "where {}° was observed",
        phobos,
        slow=True,
    ),
]

TOLD = [
    Told(PAGE, "# {} kg, C = {} kg m2", "given: what the cell begins with"),
    Told(PAGE, "(360 × 266 × {} km", "Tarnopolski 2015, Astrophys. Space Sci. 357, 160"),
]
