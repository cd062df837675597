"""Earth, Sun and Moon from the ephemeris DE421, as common test problem of the self-checks."""

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np
from numpy.polynomial import chebyshev

from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import DAY
from earthspin.motion.forces import DynamicalFigure, Forces
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris

#: The rotating body.
BODY = EARTH
#: Dynamical flattening and J2 of the body, and its spin rate in rad/s.
H, J2 = float(BODY.needed("dynamical_flattening")), float(BODY.needed("j2"))
SPIN = float(BODY.spin_rate)
#: GM (m3 s-2) and kernel code of each perturber, and the kernel code of the body.
GM = {"sun": float(SUN.gm), "moon": float(MOON.gm)}
CODES = {"sun": SUN.naif[0], "moon": MOON.naif[0]}
CENTRE = BODY.naif[0]


@cache
def kernel() -> Ephemeris:
    """Ephemeris DE421, which is opened once and then reused."""
    return open_ephemeris("de421")


def positions(days: FloatArray) -> dict[str, FloatArray]:
    """Positions of Sun and Moon relative to the Earth's centre at given days, m, shape (n, 3)."""
    return kernel().positions(CODES, CENTRE, days)


#: Torques of Sun and Moon on the axisymmetric body.
FORCES = Forces(
    figure=DynamicalFigure(h=H, spin_rate=SPIN),
    gm=GM,
    positions=lambda times: positions(times / DAY),
)


def unit_vectors(longitude: FloatArray, latitude: FloatArray) -> FloatArray:
    """Unit vectors from longitude and latitude in rad, shape (n, 3)."""
    across = np.cos(latitude)
    return np.stack(
        [across * np.cos(longitude), across * np.sin(longitude), np.sin(latitude)], axis=-1
    )


def eccentric_anomaly(
    mean: FloatArray, e: float, steps: int, start: FloatArray | None = None
) -> FloatArray:
    """Eccentric anomaly (rad) from Kepler's equation, by a fixed number of Newton steps.

    Parameters
    ----------
    mean : ndarray
        Mean anomaly, rad.
    e : float
        Eccentricity.
    steps : int
        Number of Newton steps.
    start : ndarray, optional
        First estimate; the mean anomaly by default.
    """
    anomaly = mean if start is None else start
    for _ in range(steps):
        residual = anomaly - e * np.sin(anomaly) - mean
        anomaly = anomaly - residual / (1 - e * np.cos(anomaly))
    return anomaly


def chebyshev_pieces(
    function: Callable[[FloatArray], FloatArray],
    first: float,
    length: float,
    count: int,
    nodes: int,
) -> FloatArray:
    """Chebyshev coefficients of a function in intervals of equal length, shape (count, nodes, k).

    Parameters
    ----------
    function : callable
        Function of times, shape (n,), that returns k values at each time, of any shape (n, ...).
    first, length : float
        Start of the first piece and length of each piece, in the unit of the times.
    count, nodes : int
        Number of pieces, and of terms in each piece.
    """
    x = np.cos(np.pi * (np.arange(nodes) + 0.5) / nodes)
    times = first + length * (np.arange(count)[:, np.newaxis] + (x + 1) / 2)
    values = function(times.ravel()).reshape(count, nodes, -1)
    return np.asarray(np.linalg.solve(chebyshev.chebvander(x, nodes - 1), values))


class Tide:
    """Tidal tensor of Sun and Moon at any time, for integrators that call it at each step.

    It is evaluated from Chebyshev series over pieces of two days, and shares no node, quadrature
    rule or formula with the windows of the axis solver.

    Parameters
    ----------
    end : float
        Last time for which the tensor is available, from J2000.0, s.
    gm : mapping
        GM of Sun and Moon, m3 s-2.

    Attributes
    ----------
    calls : int
        Number of evaluations so far.
    """

    PIECE, NODES = 2 * DAY, 16

    def __init__(self, end: float, gm: Mapping[str, float] = GM) -> None:
        self.calls = 0
        self._gm = gm
        self._degrees = np.arange(self.NODES)
        count = int(end / self.PIECE) + 2
        self._series = chebyshev_pieces(self._tensor, 0.0, self.PIECE, count, self.NODES)

    def _tensor(self, times: FloatArray) -> FloatArray:
        """Tidal tensor: sum of GM r r^T / r^5 over Sun and Moon, s-2, shape (n, 3, 3)."""
        tensor = np.zeros((times.size, 3, 3))
        for name, r in positions(times / DAY).items():
            scale = self._gm[name] / np.linalg.norm(r, axis=1) ** 5
            tensor += scale[:, np.newaxis, np.newaxis] * r[:, :, np.newaxis] * r[:, np.newaxis, :]
        return tensor

    def __call__(self, time: float) -> FloatArray:
        """Tidal tensor of Sun and Moon at a time in s, s-2, shape (3, 3)."""
        self.calls += 1
        piece = int(time / self.PIECE)
        angle = np.arccos(min(max(2 * (time / self.PIECE - piece) - 1, -1.0), 1.0))
        return np.asarray(np.cos(self._degrees * angle) @ self._series[piece]).reshape(3, 3)
