"""The pull of the Sun on the Earth's bulge in plain Skyfield, and the same from the library."""

import numpy as np
import xarray as xr
from skyfield.api import load, load_file
from skyfield.timelib import Time

import earthspin
from earthspin import EARTH, SUN
from earthspin.sky.ephemeris import find_kernel


def plain_skyfield(t: Time) -> tuple[np.ndarray, np.ndarray]:
    """Declination of the Sun (deg) and its torque on the bulge (N m), by (I.8.7)."""
    kernel = load_file(str(find_kernel("de421")))  # or load("de421.bsp")
    sun, earth = kernel["sun"], kernel["earth"]
    ra, dec, distance = (sun - earth).at(t).radec(epoch="date")
    kernel.close()
    bulge = EARTH.j2 * EARTH.mass * EARTH.radius**2  # C - A
    strength = 3 * SUN.gm * bulge / distance.m**3
    torque = strength * np.sin(dec.radians) * np.cos(dec.radians)
    along = np.stack([np.sin(ra.radians), -np.cos(ra.radians), 0 * torque])
    return dec.degrees, (torque * along).T


def with_earthspin(t: Time) -> xr.Dataset:
    """The same in one call, with the errors."""
    return earthspin.torque_series(times=t, perturbers="sun", equator="true", source="skyfield")


if __name__ == "__main__":
    t = load.timescale(builtin=True).tdb(2026, range(1, 13), 1)
    declination, torque = plain_skyfield(t)
    ours = with_earthspin(t).sel(perturber="sun")
    print(np.abs(ours.declination.values - declination).max(), "deg apart")
    print(np.abs(ours.torque.values - torque).max() / np.abs(torque).max(), "of the largest torque")
