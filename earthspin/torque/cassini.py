"""Cassini states, in which spin axis and orbit precess together, and locked rotation.

The normal k of an orbit precesses about a fixed pole at the inclination i and the rate -nu (nu > 0
if the node regresses). A spin axis s is in a Cassini state if it precesses together with k, so that
all three are coplanar. Averaged over spin, orbit and pericentre, the energy of a body, divided by
its spin angular momentum C omega, is

    W = -(3/4) [K0 cos^2 eps + Kr (1 + cos eps)^2],
    K0 = (n^2/omega) (J2/c) (1 - e^2)^(-3/2),     Kr = (n^2/omega) (C22/c) |X(e)|,   c = C/(M R^2),

where the second term applies to a spin locked at the ratio p = omega/n, and Hansen's coefficient
X(e) = X^{-3,2}_{2p}(e) is 1 - 5 e^2/2 + ... at 1:1 and 7 e/2 - 123 e^3/16 + ... at 3:2. In a frame
that precesses with the orbit, H = W + nu cos(eps - i), and the states satisfy

    -dH/d(eps) = nu sin(eps - i) - (3/2) [K0 cos eps + Kr (1 + cos eps)] sin eps = 0

(Colombo 1966, AJ 71, 891; Peale 1969, AJ 74, 483; Ward 1975, AJ 80, 64; for a locked spin Peale
1988, in Mercury, 461). eps is positive towards the fixed pole. A state is stable where H has a
maximum or a minimum on the sphere.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.numerics.kepler import true_anomaly

# --- Cassini states -------------------------------------------------------------------------------

#: Quadrature nodes per revolution for Hansen's coefficients.
NODES = 4096
#: Relative tolerance for recognising a spin rate as a multiple of half the mean motion.
LOCKED = 1e-4
#: Tolerance for recognising a root of the quartic as lying on the unit circle.
ON_CIRCLE = 1e-6


@dataclass(frozen=True)
class Precessing:
    """Parameters of a spinning body on a precessing orbit, for its Cassini states.

    Attributes
    ----------
    axial : float
        K0, rad/s.
    locked : float
        Kr, rad/s; 0 for a spin that is not locked.
    inclination : float
        Inclination i of the orbit to the plane on which its node regresses, rad.
    node_rate : float
        nu, rad/s, positive if the node regresses.
    """

    axial: float
    locked: float
    inclination: float
    node_rate: float

    def slope(self, obliquity: FloatArray) -> FloatArray:
        """Minus the derivative of the spin axis's Hamiltonian by obliquity, -dH/d(eps), rad/s."""
        cosine, sine = np.cos(obliquity), np.sin(obliquity)
        torque = 1.5 * (self.axial * cosine + self.locked * (1 + cosine)) * sine
        return np.asarray(self.node_rate * np.sin(obliquity - self.inclination) - torque)

    def curvature(self, obliquity: FloatArray) -> FloatArray:
        """Minus the second derivative of the Hamiltonian by the obliquity, -d2H/d(eps)2, rad/s."""
        cosine, double = np.cos(obliquity), np.cos(2 * obliquity)
        torque = 1.5 * (self.axial * double + self.locked * (cosine + double))
        return np.asarray(self.node_rate * np.cos(obliquity - self.inclination) - torque)


class CassiniSolution(NamedTuple):
    """Cassini states (2 or 4) of a body: number, obliquity and stability, shape (n,) each.

    Attributes
    ----------
    number : ndarray of int
        Numbers of Peale (1969): 1 is inclined away from the fixed pole, 2 towards it, 3 is
        retrograde, 4 is unstable. 1 and 4 do not exist if the orbit precesses too fast.
    obliquity : ndarray
        Obliquity to the orbit, positive towards the fixed pole, rad.
    stable : ndarray of bool
    """

    number: NDArray[np.int64]
    obliquity: FloatArray
    stable: BoolArray


def is_locked(spin_rate: float, motion: float) -> bool:
    """Return True if the spin rate is nearly a positive multiple of half the mean motion."""
    halves = round(2 * spin_rate / motion)
    return halves > 0 and abs(2 * spin_rate / motion / halves - 1) < LOCKED


def strengths(
    motion: float, spin_rate: float, j2: float, c22: float, polar: float, eccentricity: float
) -> tuple[float, float]:
    """Strengths of the mean torque, rad/s: K0 due to J2, and Kr due to C22 for a locked spin.

    Parameters
    ----------
    motion, spin_rate : float
        Mean motion of the orbit and spin rate of the body, rad/s.
    j2, c22 : float
        Unnormalised coefficients.
    polar : float
        C/(M R2), with the reference radius of `j2` and `c22`.
    eccentricity : float
    """
    scale = motion**2 / (spin_rate * polar)
    ratio = round(2 * spin_rate / motion)
    locked = scale * c22 * abs(hansen(ratio, eccentricity))
    return scale * j2 * (1 - eccentricity**2) ** -1.5, locked


def hansen(multiple: int, eccentricity: float) -> float:
    """Hansen's coefficient X^{-3,2}_k(e): mean of (a/r)^3 cos(2 v - k M).

    Parameters
    ----------
    multiple : int
        k, twice the number of rotations per revolution.
    eccentricity : float
    """
    mean = 2 * np.pi * (np.arange(NODES) + 0.5) / NODES
    true = true_anomaly(mean, np.asarray(eccentricity))
    nearness = (1 + eccentricity * np.cos(true)) / (1 - eccentricity**2)
    return float(np.mean(nearness**3 * np.cos(2 * true - multiple * mean)))


def cassini_states(body: Precessing) -> CassiniSolution:
    """Compute obliquity and stability of all Cassini states of a body.

    Parameters
    ----------
    body : Precessing
        Body and orbit.

    Raises
    ------
    UndefinedError
        If the orbit does not precess, or is perpendicular to the plane of precession.
    """
    i, nu = body.inclination, body.node_rate
    if nu == 0 or np.sin(i) == 0:
        raise UndefinedError(
            "an orbit whose plane does not move has no Cassini states; give it an inclination and "
            "a period of its node"
        )
    # with z = exp(i eps), the slope is a quartic polynomial in z
    c1 = nu * np.cos(i) - 1.5 * body.locked
    c2 = -0.75 * (body.axial + body.locked)
    roots = np.roots([c2, c1 - 1j * nu * np.sin(i), 0, -c1 - 1j * nu * np.sin(i), -c2])
    angles = np.angle(roots[np.abs(np.abs(roots) - 1) < ON_CIRCLE])
    for _ in range(3):  # Newton steps to full precision
        angles = angles - body.slope(angles) / body.curvature(angles)
    stable = body.curvature(angles) * nu * np.sin(i) / np.sin(angles) > 0
    number = _numbers(angles * np.sign(nu), stable)
    order = np.argsort(number)
    return CassiniSolution(number[order], angles[order], stable[order])


def _numbers(angles: FloatArray, stable: BoolArray) -> NDArray[np.int64]:
    """Conventional numbers 1 to 4 of Cassini states, from their obliquities and stability."""
    number = np.where(angles < 0, 1, 2)
    number[~stable] = 4
    number[np.argmax(np.where(stable, np.abs(angles), -1.0))] = 3
    return number


# --- detection of resonances ----------------------------------------------------------------------
# A body that rotates p/2 times per orbit (the Moon once, Mercury one and a half times) has the same
# orientation at the same position of each orbit. The torque on its equatorial ellipticity then does
# not average to zero, and is as large as the mean torque on the bulge.

#: Largest number of half turns per orbit of a resonance, tolerance of the ratio, and number of
#: orbits. Over `ORBITS` an eccentricity of 0.2 changes the mean ratio by less than half of the
#: tolerance.
MOST_HALF_TURNS, CLOSENESS, ORBITS = 6, 0.01, 20
#: Rotation period, s, below which a body is far from resonance with orbits of days or longer.
SLOW = 5 * DAY


def locked_ratio(
    times: FloatArray, position: FloatArray, axis: FloatArray, spin_rate: float
) -> float | None:
    """Rotations per orbit in spin-orbit resonance, from positions; None without resonance.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Times, s, with a spacing much shorter than the orbit, over about 20 orbits.
    position : ndarray, shape (n, 3)
        From the body to the other body.
    axis : ndarray, shape (3,)
        Unit vector of the spin, in the same frame.
    spin_rate : float
        rad/s, not negative, about that axis.
    """
    across = np.cross(axis, position[0])
    x_axis, y_axis = np.cross(across, axis), across
    angle = np.unwrap(np.arctan2(position @ y_axis, position @ x_axis))
    mean_motion = (angle[-1] - angle[0]) / (times[-1] - times[0])
    if mean_motion <= 0:
        return None
    return locked_turns(spin_rate, mean_motion)


def locked_turns(spin_rate: float, mean_motion: float) -> float | None:
    """Rotations per orbit in spin-orbit resonance, from two rates; None without resonance.

    Parameters
    ----------
    spin_rate : float
        rad/s.
    mean_motion : float
        Mean motion of the orbit about the spin axis, rad/s; negative if retrograde.
    """
    ratio = spin_rate / mean_motion
    half_turns = round(2 * ratio)
    if not 1 <= half_turns <= MOST_HALF_TURNS:
        return None
    return half_turns / 2 if abs(2 * ratio / half_turns - 1) < CLOSENESS else None
