"""Tidal friction tilts the axis of the Earth: an effect that the package does not have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from earthspin.constants import MAS
from earthspin.motion.effects import BodyNumbers, Effect, add
from earthspin.motion.forces import Forces, Places, RateLaw
from earthspin.numerics.polynomials import Windows
from earthspin.torque.gravity import FloatArray, cross

#: Obliquity grows by 2.4 mas a century (Williams 1994, AJ 108, 711, as quoted by Capitaine, Wallace
#: & Chapront 2003, A&A 412, 567), rad/s.
RATE = 2.4 * MAS / (36525.0 * 86400.0)
#: Pole of the ecliptic of J2000.0, mean equator and equinox of J2000.0.
ECLIPTIC = np.array([0.0, -np.sin(0.40909260), np.cos(0.40909260)])


def friction(forces: Forces, windows: Windows, place: Places) -> RateLaw:
    """Turn the angular momentum away from the pole of the ecliptic."""

    def rate(axis: FloatArray, momentum: FloatArray) -> FloatArray:
        normal = ECLIPTIC[:, np.newaxis, np.newaxis] * np.ones_like(axis)
        sideways = cross(normal, axis)
        away = cross(sideways / np.sqrt(np.sum(sideways * sideways, axis=0)), axis)
        return np.asarray(RATE * away)

    return rate


def switch_on(forces: Forces, body: BodyNumbers) -> Forces:
    """Add the torque of friction to the others."""
    return replace(forces, torques=(*forces.torques, friction))


TIDAL_TILT = Effect("tidal-tilt", switch_on)

add(TIDAL_TILT)
