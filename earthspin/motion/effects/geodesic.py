r"""Geodesic precession and nutation: relativistic rotation of the local inertial frame.

A gyroscope that orbits a mass precesses with respect to the stars (de Sitter 1916). For several
masses, with positions and velocities in the barycentric frame (Brumberg, Bretagnon &
Francou 1992; IERS Conventions 2010, eq. 10.12 for the same term in a satellite's motion),

    \Omega_g = sum_A GM_A / (c2 r_A3) (x - x_A) x ((3/2) v - 2 v_A)

It is 1.92 arcsec per century, prograde, with half a milliarcsecond from the Moon. The axes of the
GCRS do not rotate with the local frame, so that an angular momentum in the GCRS has the rate
N + Omega_g x L. The rotation is faster at perihelion, which causes geodesic nutation.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from earthspin.constants import SPEED_OF_LIGHT
from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.forces import Forces, Places, RateLaw, Torque
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.gauss_windows import Windows
from earthspin.torque.gravity import cross, dot


def geodesic_rate(
    gm: Mapping[str, float],
    position: Mapping[str, FloatArray],
    velocity: Mapping[str, FloatArray],
    primary: str,
) -> FloatArray:
    """Angular velocity of the body's local inertial frame relative to the stars, rad/s.

    Parameters
    ----------
    gm : mapping of str to float
        GM of the masses, m3 s-2.
    position, velocity : mapping of str to ndarray, shape (3, ...)
        Positions (m) and velocities (m/s) of the masses relative to the body.
    primary : str
        Mass that is used as the barycentre: the Sun moves at 13 m/s, the Earth at 30 km/s.

    Returns
    -------
    ndarray, shape (3, ...)
    """
    own = -velocity[primary]
    total = np.zeros_like(own)
    for name, mass in gm.items():
        place = position[name]
        distance = np.sqrt(dot(place, place))
        scale = mass / (SPEED_OF_LIGHT.value**2 * distance**3)
        its_own = velocity[name] + own
        total += scale * cross(2 * its_own - 1.5 * own, -place)
    return total


def geodesic_torque(primary: str) -> Torque:
    """Make a function that gives geodesic precession about a mass as an equivalent torque.

    Parameters
    ----------
    primary : str
        See `geodesic_rate`.
    """

    def over(forces: Forces, windows: Windows, place: Places) -> RateLaw:
        near = {name: forces.gm[name] for name in {primary, *forces.near}}
        velocity = {name: windows.derivative(place[name]) for name in near}
        rate = geodesic_rate(near, place, velocity, primary)
        return lambda axis, momentum: cross(rate, momentum)

    return over


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    # The effect needs the Sun among the perturbers.
    if "sun" not in forces.gm:
        return forces
    return replace(forces, torques=(*forces.torques, geodesic_torque("sun")))


GEODESIC = Effect("geodesic", _switch_on)
