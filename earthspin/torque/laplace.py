r"""Precession of a planet together with its satellites, each near its own Laplace plane.

Spin, satellites and Sun act on each other as gyroscopes. The mean plane of a satellite, its Laplace
plane, lies between the equator of the planet and the plane of its orbit, tilted by theta from the
equator, and all of these planes precess together (Goldreich 1966, Rev. Geophys. 4, 411; Ward 1975,
AJ 80, 64; torques of the satellites on one another after Laplace). With GM for masses, M those of
the planet, m_j of a satellite with the mean motion n_j, and S = GMsun <1/r3>:

    K_j  = (3/8) S m_j a_j2                  torque of the Sun on a satellite
    P_j  = (3/4) M m_j J2 R2 / a_j3          torque of the bulge on a satellite
    P_ij = m_i m_j \alpha b(\alpha) / (8 a)  torque of two satellites, a of the outer one
    P_j sin 2\theta_j + sum_i P_ij sin 2(\theta_j - \theta_i) + h_j w sin(\epsilon - \theta_j)
        = K_j sin 2(\epsilon - \theta_j)

    J2' = J2 + q,  q = (1/2) sum (m/M) (a/R)2 sin 2(\epsilon - \theta) / sin 2\epsilon
    C'  = C + l,   l = sum (m/M) (a/R)2 (n/Omega) sin(\epsilon - \theta) / sin \epsilon

with C in M R2, the angular momentum h_j of an orbit, and the common rate w, which follows from J2'
and C'. Averaged over its node, an orbit inclined by i to the Laplace plane contributes
(3 cos2 i - 1)/2 of its torques and cos i of its angular momentum. `omitted` estimates the rest.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from earthspin.numerics.arrays import FloatArray

#: Largest number of Newton's steps; five are usual.
_MOST_STEPS = 50
#: Newton step, rad, after which the error, of the order of its square, is below rounding.
_LAST_STEP = 1e-9
#: Longest Newton step, rad: a longer one may lead to another balance, an unstable one.
_LONGEST_STEP = 0.2
#: Eccentricity that the orbits of satellites are taken to have at most; Titan has 0.029.
ECCENTRICITY = 0.03
#: Least |sin 2 epsilon|: q and l have a limit at 0 and 90 deg, where their formulas are 0/0.
_LEAST_SINE = 1e-6


def laplace_coefficient(ratio: float) -> float:
    """Laplace coefficient b_3/2^(1) of a ratio of semi-major axes below 1."""
    angle = np.linspace(0.0, 2 * np.pi, 2001)[:-1]
    return float(2 * np.mean(np.cos(angle) / (1 - 2 * ratio * np.cos(angle) + ratio**2) ** 1.5))


@dataclass(frozen=True)
class Satellites:
    """Masses and orbits of the satellites of a planet.

    Attributes
    ----------
    gm, a : ndarray, shape (n,)
        GM and semi-major axis, m3 s-2 and m.
    i : ndarray, shape (n,)
        Inclination to the Laplace plane, rad; above 90 deg if opposite to the spin of the planet.
    """

    gm: FloatArray
    a: FloatArray
    i: FloatArray

    @property
    def node_factor(self) -> FloatArray:
        """Mean over the node, (3 cos2 i - 1)/2, of the torques on an inclined orbit; shape (n,)."""
        return np.asarray(1.5 * np.cos(self.i) ** 2 - 0.5)

    @cached_property
    def mutual(self) -> FloatArray:
        """Torques P_ij between pairs of satellites, m5 s-4, shape (n, n), 0 on the diagonal."""
        torque = np.zeros((self.gm.size, self.gm.size))
        for i in range(self.gm.size):
            for j in range(i):
                inner, outer = sorted((self.a[i], self.a[j]))
                ratio = inner / outer
                size = self.gm[i] * self.gm[j] * ratio * laplace_coefficient(ratio)
                torque[i, j] = torque[j, i] = size / (8 * outer)
        return torque


@dataclass(frozen=True)
class Planet:
    """Parameters of m planets with the same obliquity, as arrays of shape (m, 1); m may be 1.

    Attributes
    ----------
    gm, radius, j2, polar_moment, spin_rate : ndarray
        GM (m3 s-2), equatorial radius (m), J2, C/(M R2), and spin rate without its sign (rad/s).
    tide : ndarray
        Sum of GM <1/r3> of the perturbers, s-2.
    obliquity : float
        rad.
    """

    gm: FloatArray
    radius: FloatArray
    j2: FloatArray
    polar_moment: FloatArray
    spin_rate: FloatArray
    tide: FloatArray
    obliquity: float

    def torques(self, satellites: Satellites) -> tuple[FloatArray, FloatArray]:
        """Torques K of the perturbers and P of the bulge on satellites, shape (m, n), m5 s-4."""
        sun = 0.375 * self.tide * satellites.gm * satellites.a**2
        bulge = 0.75 * self.gm * satellites.gm * self.j2 * self.radius**2 / satellites.a**3
        return sun, bulge

    def momenta(self, satellites: Satellites) -> FloatArray:
        """Angular momenta of the orbits, m5 s-3, shape (m, n), for the torques of `torques`.

        Averaged over the node they are h cos i; they are divided by the factor of the torques, at
        least 1/2.
        """
        momentum = satellites.gm * np.sqrt((self.gm + satellites.gm) * satellites.a)
        return momentum * np.cos(satellites.i) / np.maximum(satellites.node_factor, 0.5)


def laplace_tilts(planet: Planet, satellites: Satellites) -> FloatArray:
    """Tilts of the Laplace planes from the equator towards the orbit, shape (m, n), rad."""
    sun, bulge = planet.torques(satellites)
    h, size = planet.momenta(satellites), planet.gm * planet.radius**2
    spin, own = planet.polar_moment * size * planet.spin_rate, 0.75 * planet.tide * size * planet.j2
    eps, twice = planet.obliquity, 2 * planet.obliquity
    pairs = satellites.mutual * satellites.node_factor  # of the other of two satellites
    # without precession: all in one plane, then each in its stable balance with the others
    sine, cosine = sun * np.sin(twice), bulge + sun * np.cos(twice)
    tilt = np.arctan2(sine.sum(-1, keepdims=True), cosine.sum(-1, keepdims=True)) / 2
    tilt = np.broadcast_to(tilt, bulge.shape).copy()
    for place in range(tilt.shape[1]):
        others = np.sin(2 * tilt) @ pairs[place], np.cos(2 * tilt) @ pairs[place]
        tilt[:, place] = np.arctan2(sine[:, place] + others[0], cosine[:, place] + others[1]) / 2
    for _ in range(_MOST_STEPS):
        delta = 2 * (tilt[:, :, np.newaxis] - tilt[:, np.newaxis])
        free = eps - tilt
        level = spin * np.sin(eps) + (h * np.sin(free)).sum(-1, keepdims=True)
        level = np.where(level == 0, 1.0, level)  # an upright planet
        torque = own * np.sin(twice) + (sun * np.sin(2 * free)).sum(-1, keepdims=True)
        turn = torque / level
        residual = bulge * np.sin(2 * tilt) + (pairs * np.sin(delta)).sum(-1)
        residual += turn * h * np.sin(free) - sun * np.sin(2 * free)
        # change of the rate `turn` with each tilt
        slope = (turn * h * np.cos(free) - 2 * sun * np.cos(2 * free)) / level
        stiffness = 2 * pairs * np.cos(delta)
        each = 2 * bulge * np.cos(2 * tilt) + stiffness.sum(-1) + 2 * sun * np.cos(2 * free)
        each -= turn * h * np.cos(free)
        jacobian = each[:, :, np.newaxis] * np.eye(tilt.shape[1]) - stiffness
        jacobian += (h * np.sin(free))[:, :, np.newaxis] * slope[:, np.newaxis]
        step = np.linalg.solve(jacobian, residual[:, :, np.newaxis])[:, :, 0]
        tilt = tilt - np.clip(step, -_LONGEST_STEP, _LONGEST_STEP)
        if np.max(np.abs(step), initial=0.0) < _LAST_STEP:
            break
    return np.asarray(tilt)


def shares(planet: Planet, satellites: Satellites) -> tuple[FloatArray, FloatArray]:
    """Terms q and l that satellites add to J2 and to C/(M R2) in the precession rate.

    Returns
    -------
    q, l : ndarray, shape (m, n)
        One value for each planet and satellite.
    """
    obliquity = planet.obliquity
    if abs(np.sin(2 * obliquity)) < _LEAST_SINE:
        obliquity += _LEAST_SINE if np.cos(2 * obliquity) > 0 else -_LEAST_SINE
        planet = Planet(**{**vars(planet), "obliquity": obliquity})
    free = obliquity - laplace_tilts(planet, satellites)
    spread = satellites.gm / planet.gm * (satellites.a / planet.radius) ** 2
    motion = np.sqrt((planet.gm + satellites.gm) / satellites.a**3)
    cosine = np.cos(satellites.i)
    q = spread / 2 * satellites.node_factor * np.sin(2 * free) / np.sin(2 * obliquity)
    moment = spread * motion / planet.spin_rate * cosine * np.sin(free) / np.sin(obliquity)
    return q, moment


def omitted(
    planet: Planet, satellites: Satellites, q: FloatArray, moment: FloatArray
) -> FloatArray:
    """Relative half-width of the torque due to what q and l leave out, shape (m,).

    It contains `uneven`, and in the share of each satellite, with S1 = sqrt(S), eccentricity up to
    `ECCENTRICITY`, 3/2 e2, and the period of the Sun, (3/8) S1/n, as in the lunar theory.
    """
    motion2 = (planet.gm + satellites.gm) / satellites.a**3
    squares = (1.5 * ECCENTRICITY**2) ** 2 + 0.375**2 * planet.tide / motion2
    rest = squares * (q / (planet.j2 + q.sum(-1, keepdims=True))) ** 2
    return np.asarray(np.hypot(np.sqrt(rest.sum(-1)), uneven(planet, satellites, q, moment)))


def uneven(planet: Planet, satellites: Satellites, q: FloatArray, moment: FloatArray) -> FloatArray:
    """Relative half-width of the torque as inclined orbits do not circle evenly, shape (m,).

    All parts are in proportion to sin2 i: a precession that is not slow beside the node; circles
    that are ellipses, which are stiffer across the tilt (`bend`) than along it (`stretch`); the
    axis of the planet, which circles with each node; and torques of two satellites, which do not
    cancel where the Sun takes unequal parts of them. The factors were chosen on 90 random planets.
    """
    sun, bulge = planet.torques(satellites)
    tilt, pairs = laplace_tilts(planet, satellites), satellites.mutual
    free, delta = planet.obliquity - tilt, tilt[:, :, np.newaxis] - tilt[:, np.newaxis]
    torque = planet.j2 + q.sum(-1, keepdims=True)
    level = planet.polar_moment + moment.sum(-1, keepdims=True)
    turn = 1.5 * planet.tide * np.cos(planet.obliquity) * torque / (level * planet.spin_rate)
    bend = bulge * np.cos(tilt) ** 2 + sun * np.cos(free) ** 2
    bend += (pairs * np.cos(delta) ** 2).sum(-1)
    sun = sun * np.cos(2 * free)
    stretch = bulge * np.cos(2 * tilt) + sun + (pairs * np.cos(2 * delta)).sum(-1)
    size, sine2 = planet.gm * planet.radius**2, np.sin(satellites.i) ** 2
    h, spin = np.abs(planet.momenta(satellites)), planet.polar_moment * size * planet.spin_rate
    squares = (3 * turn * h / bend) ** 2 + (bend / stretch - 1) ** 2
    circles = (h / spin * bulge / bend) ** 2 * planet.polar_moment / level / 2
    each = (sine2 * q / torque) ** 2 * squares + (sine2 * circles) ** 2
    share = sun / stretch
    unequal = np.abs(share[:, :, np.newaxis] - share[:, np.newaxis])
    pull = (pairs * (sine2 + sine2[:, np.newaxis]) * unequal).sum((1, 2)) / 2
    pull /= (0.75 * planet.tide * size * torque)[:, 0]
    return np.asarray(np.sqrt(each.sum(-1) + (1.5 * pull) ** 2))


@dataclass(frozen=True)
class Node:
    """Rate of a satellite's node, and amplitude of the nutation of the planet due to the node.

    Attributes
    ----------
    rate : float
        Rate of the node, without its sign, rad/s.
    swing : float
        Radius of the circle that the planet's spin axis describes, rad.
    """

    rate: float
    swing: float


def nodes(planet: Planet, satellites: Satellites) -> list[Node]:
    """Node rate, and resulting nutation of the planet, for each satellite; one planet (m = 1).

    Small inclinations are the normal modes of spin and satellites about their common state, with
    normals displaced in the plane of tilt (x) and across it (y): h x' = Sy y, h y' = -Sx x. Each
    mode is scaled to the inclination of the satellite that moves most in it. The normal of a
    retrograde orbit counts reversed, with h < 0. For a large inclination, the torque has the
    further factor cosine of the angle from the equator.
    """
    sun, bulge = (torque[0] for torque in planet.torques(satellites))
    tilt = np.append(0.0, laplace_tilts(planet, satellites)[0])
    gm, size, retrograde = satellites.gm, satellites.a, np.cos(satellites.i) < 0
    momentum = gm * np.sqrt((planet.gm[0] + gm) * size) * np.where(retrograde, -1.0, 1.0)
    spin = planet.polar_moment * planet.gm * planet.radius**2 * planet.spin_rate
    h = np.append(spin[0], momentum)

    pairs = np.zeros((h.size, h.size))
    pairs[1:, 1:] = satellites.mutual
    pairs[0, 1:] = pairs[1:, 0] = bulge
    delta = tilt[:, np.newaxis] - tilt
    free = planet.obliquity - tilt[1:]
    stretch = np.diag(np.append(0.0, 2 * sun * np.cos(2 * free)))
    stretch += np.diag((2 * pairs * np.cos(2 * delta)).sum(1)) - 2 * pairs * np.cos(2 * delta)
    bend = np.diag(np.append(0.0, 2 * sun * np.cos(free) ** 2))
    bend += np.diag((2 * pairs * np.cos(delta) ** 2).sum(1)) - 2 * pairs * np.cos(delta)
    squares, modes = np.linalg.eig((bend / h[:, np.newaxis]) @ (stretch / h[:, np.newaxis]))

    inclination = np.where(retrograde, np.pi - satellites.i, satellites.i)
    # in the slowest mode, the precession, all move together
    shares_of_modes = np.abs(modes[1:]) / np.abs(modes[1:]).max(0)
    shares_of_modes[:, np.argmin(np.abs(squares))] = 0.0
    result = []
    for satellite in range(gm.size):
        mode = int(np.argmax(shares_of_modes[satellite]))
        ratio = float(np.real(modes[0, mode] / modes[1 + satellite, mode]))
        sine = ratio * np.sin(inclination[satellite])
        rate = np.sqrt(abs(squares[mode])) * np.cos(inclination[satellite] - np.arcsin(sine))
        result.append(Node(abs(float(rate)), float(np.arcsin(abs(sine)))))
    return result
