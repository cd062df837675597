"""Poles, rates and obliquities of other worlds beside those of others."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import xarray as xr

import earthspin
from data_tools.coverage import Row
from data_tools.worlds import PUBLISHED, locked, worlds
from earthspin.bodies import BODIES, MARS
from earthspin.bodies.earth_moon_sun import MOON_OBLIQUITY
from earthspin.bodies.moons import TITAN_OBLIQUITY
from earthspin.constants import NORMAL_95
from earthspin.numerics.arrays import FloatArray

#: Obliquity of Mars by La2004: kyr from J2000.0, rad.
LA2004 = Path(__file__).parents[2] / "tests" / "data" / "la2004-mars-excerpt.txt"
#: Start of La2004, deg, and the rate of precession that it then has, arcsec/yr: the first as its
#: file has it, the second fitted (docs/worlds.md).
LA2004_START, LA2004_RATE = 25.189417, 7.58347

#: Poles at J2000.0 without nutation: right ascension and declination, deg.
OTHER_POLES = {
    "mars": {
        "IAU 2009": (317.68143, 52.88650),
        "Konopliv et al. 2006, 2011": (317.6811175, 52.8863315),
        "Konopliv et al. 2016": (317.6811150, 52.8863528),
    },
    "saturn": {"Jacobson 2007": (40.584857, 83.537661)},
}
#: Rates of Mars as observed by others, with one standard deviation, arcsec/yr: Konopliv et al. 2016
#: and 2011, Folkner et al. 1997.
RATES_OF_MARS = ((7.6083, 0.0021), (7.594, 0.010), (7.576, 0.035))


def vector(angles: tuple[float, float]) -> FloatArray:
    """Return the unit vector of a right ascension and declination, deg."""
    ra, dec = np.radians(angles)
    return np.array([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra), np.sin(dec)])


def poles() -> Iterator[Row]:
    """Compare the poles of J2000.0 with other solutions."""
    for name, others in OTHER_POLES.items():
        pole = BODIES[name].needed("pole").without_nutation().mean(np.zeros(1))[0]
        half = NORMAL_95 * (BODIES[name].pole_uncertainty or math.nan)
        off = [float(np.linalg.norm(pole - vector(other))) for other in others.values()]
        yield Row.comparing(
            "start of the pole", name.capitalize(), "; ".join(others), off, [half] * len(off)
        )


def like_la2004(start: float | None = None, rate: float | None = None) -> xr.Dataset:
    """Return our obliquity of Mars at the epochs of La2004, the latest first.

    Parameters
    ----------
    start : float, optional
        Obliquity at J2000.0, deg; ours if not given.
    rate : float, optional
        Rate of precession then, geodesic precession included, arcsec/yr; ours if not given.
    """
    now = earthspin.long_term(times=["0 kyr"], body="mars")
    torques, own = (float(rate) for rate in now.precession_rate[:, 0])
    h = MARS.number("dynamical_flattening") * (1 + ((rate or own) - own) / torques)
    body = MARS.replace(dynamical_flattening=h, relative_uncertainty=MARS.relative_uncertainty)
    shift = (start or float(now.obliquity[0])) - float(now.obliquity[0])
    ours = earthspin.long_term(
        "-1 Myr", "0 kyr", "10 kyr", body=body, obliquity_shift=f"{shift} deg"
    )
    return ours.isel(epoch=slice(None, None, -1))


def la2004() -> FloatArray:
    """Return the obliquity of Mars by La2004 from J2000.0 back to 1 Myr, deg."""
    return np.asarray(np.degrees(np.loadtxt(LA2004)[:, 1]))


def obliquity_of_mars() -> Iterator[Row]:
    """Compare the obliquity of Mars with the Viking landers and with La2004."""
    then = earthspin.long_term(times=["1980-01-01"], body="mars")
    yield Row.comparing(
        "obliquity of Mars",
        "1980",
        "Yoder & Standish 1997",
        then.obliquity.values - 25.1894,
        then.obliquity_error.values,
    )
    for ours, counterpart in (
        (like_la2004(), "La2004, other constants"),
        (like_la2004(LA2004_START, LA2004_RATE), "La2004, with its start and its rate"),
    ):
        off, half = ours.obliquity.values - la2004(), ours.obliquity_error.values
        for words, inside in (
            ("0 to 100 kyr back", ours.epoch.values >= -1e5),
            ("100 kyr to 1 Myr back", ours.epoch.values < -1e5),
        ):
            yield Row.comparing("obliquity of Mars", words, counterpart, off[inside], half[inside])


def rates() -> Iterator[Row]:
    """Compare rates with observed ones: half-widths hold what is left out, and theirs."""
    for world in worlds():
        if world.refused or math.isnan(world.left_out):
            continue
        number = PUBLISHED[world.name].number
        known = (number and number.uncertainty) or 0.0
        others = RATES_OF_MARS if world.name == "mars" else ((world.published, known),)
        yield Row.comparing(
            "rate of precession",
            world.name.capitalize(),
            "published rates",
            [world.rate - rate for rate, _ in others],
            [math.hypot(world.error + world.left_out, NORMAL_95 * u) for _, u in others],
        )


def cassini_states() -> Iterator[Row]:
    """Compare obliquities of locked spins with observed ones: half-widths hold what is left out."""
    observed = {"moon": MOON_OBLIQUITY, "titan": TITAN_OBLIQUITY}
    for world in locked():
        if world.name in observed:
            yield Row.comparing(
                "obliquity in a Cassini state",
                world.name.capitalize(),
                "observed",
                [world.obliquity - observed[world.name].value],
                [world.error + world.left_out],
            )


def rows() -> list[Row]:
    """Return all rows of the topic."""
    return [*poles(), *obliquity_of_mars(), *rates(), *cassini_states()]
