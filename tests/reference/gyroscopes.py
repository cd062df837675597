"""Spin of a planet and orbit normals of its satellites as gyroscopes, integrated in time.

Energies after averaging over orbits: -k (p.q)2 for each two axes p and q, with k from the
quadrupoles of bulge and orbits; each axis turns by the torque divided by its angular momentum.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipe, ellipk

from earthspin.bodies import Body
from earthspin.constants import JULIAN_YEAR


def laplace_coefficient(ratio: float) -> float:
    """Laplace coefficient b_3/2^(1) by complete elliptic integrals."""
    square = 4 * ratio / (1 + ratio) ** 2
    first, second = ellipk(square), ellipe(square)
    scale = 2 / (np.pi * ratio * (1 + ratio))
    return scale * ((1 + ratio**2) / (1 - ratio) ** 2 * second - first)


def path(
    body: Body, pull: float, axes: np.ndarray, normal: np.ndarray, years: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Spin axis and total angular momentum in time, unit vectors of shape (t, 3).

    Parameters
    ----------
    body : Body
    pull : float
        GM/(a3 (1 - e2)^1.5) of the Sun, s-2.
    axes : ndarray, shape (axis, 3)
        At the first time: the spin, then the normals of the orbits.
    normal : ndarray, shape (3,)
        Normal of the planet's orbit.
    years : ndarray, shape (t,)
    """
    gm = np.array([moon.gm for moon in body.satellites])
    a = np.array([moon.a for moon in body.satellites])
    bulge = body.gm * body.j2 * body.radius**2
    polar = body.j2 / body.dynamical_flattening
    momentum = np.append(
        polar * body.gm * body.radius**2 * body.spin_rate, gm * np.sqrt((body.gm + gm) * a)
    )
    sun = np.append(0.75 * pull * bulge, 0.375 * pull * gm * a**2)
    pairs = np.zeros((gm.size + 1, gm.size + 1))
    pairs[0, 1:] = pairs[1:, 0] = 0.75 * bulge * gm / a**3
    for i in range(gm.size):
        for j in range(i):
            inner, outer = sorted((a[i], a[j]))
            size = gm[i] * gm[j] * inner / outer**2 * laplace_coefficient(inner / outer) / 8
            pairs[i + 1, j + 1] = pairs[j + 1, i + 1] = size

    def rate(_: float, flat: np.ndarray) -> np.ndarray:
        own = flat.reshape(-1, 3)
        cosines = own @ own.T
        pulls = (pairs * cosines) @ own + (sun * (own @ normal))[:, np.newaxis] * normal
        turned = np.cross(own, 2 * pulls) / momentum[:, np.newaxis]
        return (turned * JULIAN_YEAR).ravel()

    found = solve_ivp(
        rate, (years[0], years[-1]), axes.ravel(), "DOP853", years, rtol=1e-9, atol=1e-12
    )
    moved = found.y.T.reshape(years.size, -1, 3)
    total = np.einsum("j,tjk->tk", momentum, moved)
    return moved[:, 0], total / np.linalg.norm(total, axis=1)[:, np.newaxis]
