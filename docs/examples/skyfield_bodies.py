"""A comet from its elements and a sum of vectors among the perturbers."""

import pandas as pd
import xarray as xr
from skyfield.api import load, load_file
from skyfield.constants import GM_SUN_Pitjeva_2005_km3_s2 as GM_SUN
from skyfield.data import mpc

import earthspin
from earthspin import SUN, Body
from earthspin.sky.ephemeris import find_kernel

ts = load.timescale(builtin=True)
kernel = load_file(str(find_kernel("de421")))  # or load("de421.bsp")

#: A comet that grazes the Sun, as a row of the Minor Planet Center's file gives one.
row = pd.Series(
    {
        "designation": "made up",
        "perihelion_year": 2026, "perihelion_month": 2, "perihelion_day": 5.0,
        "perihelion_distance_au": 0.2, "eccentricity": 0.999,
        "argument_of_perihelion_degrees": 130.0, "inclination_degrees": 89.0,
        "longitude_of_ascending_node_degrees": 282.0,
    }
)  # fmt: skip
orbit = mpc.comet_orbit(row, ts, GM_SUN)
comet = Body(name="comet", gm=1e5, position=kernel["sun"] + orbit)


def series() -> xr.Dataset:
    """Torques of the Sun as Skyfield's sum of vectors, of the Moon's segment, and of the comet."""
    perturbers = [SUN.replace(position=kernel["sun"]), kernel["moon"], comet]
    return earthspin.torque_series(
        ts.utc(2026, 1, 1), ts.utc(2026, 3, 1), "1 d", perturbers=perturbers
    )
