"""What is tried, and its sky: the Earth under Sun and Moon of the kernel that comes along."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import DAY
from earthspin.motion.forces import Figure, Forces
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris

FloatArray = NDArray[np.float64]

#: What spins, and is pulled.
BODY = EARTH
#: Its dynamical flattening, J2, and spin rate in rad/s.
H, J2 = float(BODY.needed("dynamical_flattening")), float(BODY.needed("j2"))
SPIN = float(BODY.spin_rate)
#: What pulls: GM (m3 s-2) and code of each; and the code of what is pulled.
GM = {"sun": float(SUN.gm), "moon": float(MOON.gm)}
CODES = {"sun": SUN.naif[0], "moon": MOON.naif[0]}
CENTRE = BODY.naif[0]


@cache
def kernel() -> Ephemeris:
    """DE421, opened once."""
    return open_ephemeris("de421")


def positions(days: FloatArray) -> dict[str, FloatArray]:
    """Sun and Moon as seen from the body at days from J2000.0 TDB, m, shape (n, 3) each."""
    return kernel().positions(CODES, CENTRE, days)


#: Sun and Moon on the round body.
FORCES = Forces(
    figure=Figure(h=H, spin_rate=SPIN), gm=GM, positions=lambda times: positions(times / DAY)
)


def unit_vectors(longitude: FloatArray, latitude: FloatArray) -> FloatArray:
    """Directions of angles in rad, shape (n, 3)."""
    across = np.cos(latitude)
    return np.stack(
        [across * np.cos(longitude), across * np.sin(longitude), np.sin(latitude)], axis=-1
    )


def eccentric_anomaly(
    mean: FloatArray, e: float, steps: int, start: FloatArray | None = None
) -> FloatArray:
    """Solve Kepler's equation by Newton's method as one would type it, rad.

    Parameters
    ----------
    mean : ndarray
        Mean anomaly, rad.
    e : float
        Eccentricity.
    steps : int
    start : ndarray, optional
        By default the mean anomaly.
    """
    anomaly = mean if start is None else start
    for _ in range(steps):
        off = anomaly - e * np.sin(anomaly) - mean
        anomaly = anomaly - off / (1 - e * np.cos(anomaly))
    return anomaly


def chebyshev_pieces(
    of: Callable[[FloatArray], FloatArray], first: float, length: float, count: int, nodes: int
) -> FloatArray:
    """Chebyshev series of a function over pieces of equal length, shape (count, nodes, k).

    Parameters
    ----------
    of : callable
        From times, shape (n,), to k values at each, of any shape (n, ...).
    first, length : float
        Where the first piece begins, and how long each is, in units of those times.
    count, nodes : int
        Pieces, and terms of each.
    """
    x = np.cos(np.pi * (np.arange(nodes) + 0.5) / nodes)
    times = first + length * (np.arange(count)[:, np.newaxis] + (x + 1) / 2)
    values = of(times.ravel()).reshape(count, nodes, -1)
    return np.asarray(np.linalg.solve(chebyshev.chebvander(x, nodes - 1), values))


class Tide:
    """Tidal tensor of Sun and Moon at any time, for solvers that go step by step.

    It is made of Chebyshev series over pieces of two days, and shares no node, rule or formula
    with the windows of the pole's solver.

    Parameters
    ----------
    end : float
        Time up to which it is known, from J2000.0, s.
    gm : mapping
        Of Sun and Moon, m3 s-2.

    Attributes
    ----------
    calls : int
        How often it was asked.
    """

    PIECE, NODES = 2 * DAY, 16

    def __init__(self, end: float, gm: Mapping[str, float] = GM) -> None:
        self.calls = 0
        self._gm = gm
        self._degrees = np.arange(self.NODES)
        count = int(end / self.PIECE) + 2
        self._series = chebyshev_pieces(self._tensor, 0.0, self.PIECE, count, self.NODES)

    def _tensor(self, times: FloatArray) -> FloatArray:
        """Sum of GM r r^T / r^5 from the kernel, s-2, shape (n, 3, 3)."""
        tensor = np.zeros((times.size, 3, 3))
        for name, r in positions(times / DAY).items():
            scale = self._gm[name] / np.linalg.norm(r, axis=1) ** 5
            tensor += scale[:, np.newaxis, np.newaxis] * r[:, :, np.newaxis] * r[:, np.newaxis, :]
        return tensor

    def __call__(self, time: float) -> FloatArray:
        """Tensor at a time in s, shape (3, 3)."""
        self.calls += 1
        piece = int(time / self.PIECE)
        angle = np.arccos(min(max(2 * (time / self.PIECE - piece) - 1, -1.0), 1.0))
        return np.asarray(np.cos(self._degrees * angle) @ self._series[piece]).reshape(3, 3)
