"""Zonal tides of the Earth from positions of Sun and Moon, for several questions."""

from __future__ import annotations

import math

import numpy as np

from earthspin.bodies import EARTH, MOON, SUN, Body
from earthspin.constants import DAY
from earthspin.numerics.arrays import FloatArray
from earthspin.sky import iau_models
from earthspin.sky.eop import MJD
from earthspin.sky.poles import rotate, spherical
from earthspin.sky.sun_and_moon import moon, sun
from earthspin.sky.universal_time import tai_minus_utc
from earthspin.sky.ut1 import TT_MINUS_TAI
from earthspin.torque.zonal_tides import (
    DELAY,
    MEAN_FACTORS,
    NODE_STEP,
    ZonalTides,
    change_of_moment,
    spline,
)

#: Time between positions of the Sun, which moves slowly, d.
_SUN_STEP = 5.0


def nodes(first: float, last: float, step: float = NODE_STEP) -> FloatArray:
    """Evenly spaced days on which the tides of a span are computed, from the delay before it on."""
    first -= DELAY.value
    return np.linspace(first, last, max(4, math.ceil((last - first) / step) + 1))


def change_by(
    perturber: Body, body: Body, declination: FloatArray, distance: FloatArray
) -> FloatArray:
    """Change of C/(M a2) of a body, for a Love number of 1, by the tide of one perturber."""
    ratio, radius = float(perturber.gm_on(body) / body.gm), float(body.needed("radius"))
    mean = MEAN_FACTORS[perturber.known_as] * (radius / float(EARTH.needed("radius"))) ** 3
    return change_of_moment(ratio, radius, declination, distance, mean)


def days_tdb(mjd: FloatArray) -> FloatArray:
    """Days from J2000.0 TDB of modified Julian dates (UTC), within 2 ms."""
    return np.asarray(mjd - MJD + (tai_minus_utc(mjd) + TT_MINUS_TAI) / DAY)


def without_kernel(first: float, last: float) -> ZonalTides:
    """Zonal tides of Sun and Moon together over a span of days from J2000.0 TDB, from ERFA.

    From those of DE421 they differ by up to 6e-4 ms in the length of day, and 0.014 ms in UT1.
    """
    days, changes = nodes(first, last), []
    for body, position, step in ((SUN, sun, _SUN_STEP), (MOON, moon, NODE_STEP)):
        some = nodes(first, last, step)
        _, *place = spherical(rotate(iau_models.mean_equator(some), position(some)))
        changes.append(spline(some, change_by(body, EARTH, *place))(days))
    return ZonalTides.through(["total"], days, np.sum(changes, axis=0, keepdims=True))
