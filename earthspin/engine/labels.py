"""Units of results: conversion factors from SI, and how units are spelled in files."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, MAS
from earthspin.errors import SceneError, nearest

if TYPE_CHECKING:
    import xarray as xr

CONVENTIONS = "CF-1.11"

#: Units that are SI themselves; "1" for pure numbers, "" for text and dates.
_SI = (
    "", "1", "m", "s", "J", "rad", "N m", "kg m2", "kg m2 / s", "rad/s", "rad2 / s2", "1/s",
    "m/s2", "J/kg",
)  # fmt: skip

#: Factor from SI to each unit of results.
FROM_SI: dict[str, float] = {
    "arcsec/yr": 1 / ARCSEC_PER_YEAR,
    "arcsec": 1 / ARCSEC,
    "mas": 1 / MAS,
    "deg": 180 / math.pi,
    "uas": 1e6 / ARCSEC,
    "d": 1 / DAY,
    "yr": 1 / JULIAN_YEAR,
    **dict.fromkeys(_SI, 1.0),
}


#: Spelling of units in files, which UDUNITS and astropy read as the same number. UDUNITS reads `a`
#: as the are, and its `yr` is 2e-5 shorter than the Julian year.
IN_FILES: dict[str, str] = {
    "arcsec/yr": f"{1 / JULIAN_YEAR!r} arcsec s-1",
    "yr": "365.25 d",
    "deg": "degree",
    "mas": "marcsec",
    "uas": "uarcsec",
    "kg m2 / s": "kg m2 s-1",
    "rad/s": "rad s-1",
    "rad2 / s2": "rad2 s-2",
    "1/s": "s-1",
    "m/s2": "m s-2",
    "J/kg": "J kg-1",
}


def from_si(unit: str) -> float:
    """Return the factor that converts a value from SI to a given unit.

    Raises
    ------
    SceneError
        If the unit is not among those of results.
    """
    if unit not in FROM_SI:
        raise SceneError("units", unit, nearest(unit, [u for u in FROM_SI if u]))
    return FROM_SI[unit]


def si(array: xr.DataArray) -> xr.DataArray:
    """Convert a variable of a result from its unit to SI.

    Raises
    ------
    SceneError
        If its unit is not among those of results.
    """
    return array / from_si(array.attrs.get("units", ""))
