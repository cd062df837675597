"""Precession from declinations in plain Skyfield, and the same from the library."""

import numpy as np
import xarray as xr
from skyfield.api import load, load_file
from skyfield.framelib import mean_equator_and_equinox_of_date

import earthspin
from earthspin import EARTH, MOON, SUN
from earthspin.sky.ephemeris import find_kernel

OBLIQUITY = np.radians(23.439279)  # of J2000.0


def plain_skyfield() -> dict[str, float]:
    """Rate of precession in longitude by perturber, arcsec a year."""
    kernel = load_file(str(find_kernel("de421")))  # or load("de421.bsp")
    days = np.arange(-16_996.0, 16_997.0)  # five turns of the Moon's node, about J2000.0
    t = load.timescale(builtin=True).tdb_jd(2451545.0 + days)
    rates = {}
    for name, body in (("sun", SUN), ("moon", MOON)):
        position = (kernel[name] - kernel["earth"]).at(t)
        declination, right_ascension, distance = position.frame_latlon(
            mean_equator_and_equinox_of_date
        )
        alpha, delta, b = right_ascension.radians, declination.radians, distance.m
        # torque along the equinox over C - A (I.8.7), its average, and the rate that follows
        torque = 3 * body.gm / b**3 * np.sin(delta) * np.cos(delta) * np.sin(alpha)
        mean = np.average(torque, weights=np.cos(np.pi * days / (2 * 16_997)) ** 4)
        rate = EARTH.dynamical_flattening / EARTH.spin_rate * mean / np.sin(OBLIQUITY)
        rates[name] = np.degrees(rate) * 3600 * 365.25 * 86400
    kernel.close()
    return rates


def with_earthspin() -> xr.Dataset:
    """The same in one call, with the errors."""
    return earthspin.precession()


if __name__ == "__main__":
    rates = plain_skyfield()
    answer = with_earthspin()
    for name, rate in rates.items():
        print(name, rate, "and", answer.precession_rate.sel(perturber=name).item(), "arcsec/yr")
    print("period", 360 * 3600 / sum(rates.values()), "years")
