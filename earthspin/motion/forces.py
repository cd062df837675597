"""Rate of change of the angular momentum, from all perturbers and effects that are switched on.

For an effect that is switched off, no positions and no torque are evaluated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.gauss_windows import Windows
from earthspin.torque.gravity import quadrupole_torque, tidal_tensor, zonal_law

#: Positions by name, each of shape (t, 3), m, at times in s from J2000.0.
Positions = Callable[[FloatArray], Mapping[str, FloatArray]]
#: Rate of the angular momentum in units of C Omega, s-1, from figure axis and angular momentum.
RateLaw = Callable[[FloatArray, FloatArray], FloatArray]
#: Positions at the nodes of windows by name, each of shape (3, w, n), m.
Places = Mapping[str, FloatArray]
#: Contribution of an effect to l', from the forces, the windows and the positions at their nodes.
Torque = Callable[["Forces", Windows, Places], RateLaw]


@dataclass(frozen=True, kw_only=True)
class Figure:
    """Parameters of a rotating body (H, spin, J_n) that determine the motion of its axes.

    Attributes
    ----------
    h : float
        Dynamical flattening (C - A)/C, A the mean equatorial moment.
    spin_rate : float
        Spin rate, rad/s; negative if retrograde.
    inverse_polar_moment : float
        M a2/C = H/J2.
    radius : float
        Equatorial radius a, m.
    zonal : mapping of int to float
        Zonal coefficients J_n beyond J2 that are switched on, by degree.
    j2_trend : float
        Relative rate of J2 and H, s-1; 0 if switched off.
    triaxiality : float
        (B - A)/C; 0 if switched off.
    meridian : float
        Angle at J2000.0 from the x axis, projected on the equator, to the axis of least moment,
        rad.
    """

    h: float
    spin_rate: float
    inverse_polar_moment: float = 0.0
    radius: float = 0.0
    zonal: Mapping[int, float] = field(default_factory=dict)
    j2_trend: float = 0.0
    triaxiality: float = 0.0
    meridian: float = 0.0

    @property
    def tau(self) -> float:
        """Ratio A/(C Omega): tilt of the figure axis per speed of the axis, s."""
        return (1 - self.h) / self.spin_rate


@dataclass(frozen=True, kw_only=True)
class Forces:
    """Perturbers of a body, with all effects on its axes that are switched on.

    Attributes
    ----------
    figure : Figure
    gm : mapping of str to float
        GM of the perturbers, m3 s-2.
    positions : callable
        Positions of the perturbers in `gm`.
    near : tuple of str
        Perturbers that are included in the torques on J3 and J4 and in geodesic precession.
    far : mapping of str to float
        GM of the planets, which an effect may add to `gm`, m3 s-2.
    torques : tuple of callable
        Further contributions to the rate of the angular momentum.
    mean_pole : callable or None
        Function of times (t,) that returns unit vectors (t, 3). If given, torques are evaluated for
        an axis in this direction, so second-order effects are switched off.
    """

    figure: Figure
    gm: Mapping[str, float]
    positions: Positions
    near: tuple[str, ...] = ()
    far: Mapping[str, float] = field(default_factory=dict)
    torques: tuple[Torque, ...] = ()
    mean_pole: Callable[[FloatArray], FloatArray] | None = None

    def over(self, windows: Windows) -> tuple[RateLaw, FloatArray]:
        """Return a function for the angular momentum's rate in time windows, and the tidal tensor.

        Return also the tidal tensor at these nodes.

        Positions of the perturbers are evaluated at the nodes of the windows.

        Returns
        -------
        rate : callable
            Function of figure axis and angular momentum at the nodes, shape (3, w, n), that returns
            l'.
        tensor : ndarray, shape (6, w, n)
            `tidal_tensor` of all perturbers.
        """
        figure = self.figure
        shape = windows.times.shape
        positions = self.positions(windows.times.ravel())
        place = {
            name: np.ascontiguousarray(positions[name].T).reshape(3, *shape) for name in self.gm
        }
        tensor = tidal_tensor((gm, place[name]) for name, gm in self.gm.items())
        scale = figure.h / figure.spin_rate * (1 + figure.j2_trend * windows.times)
        scaled = tensor * scale
        mean = self._mean_pole_at(windows.times)
        zonals = self._zonal_laws(place) if figure.zonal else []
        further = [torque(self, windows, place) for torque in self.torques]

        def on_figure(axis: FloatArray) -> FloatArray:
            total = quadrupole_torque(scaled, axis)
            for zonal in zonals:
                total += zonal(axis)
            return total

        constant = None if mean is None else on_figure(mean)

        def rate(axis: FloatArray, momentum: FloatArray) -> FloatArray:
            total = on_figure(axis) if constant is None else constant.copy()
            for law in further:
                total += law(axis, momentum)
            return total

        return rate, tensor

    def _zonal_laws(self, place: Places) -> list[Callable[[FloatArray], FloatArray]]:
        figure = self.figure
        scale = figure.inverse_polar_moment / figure.spin_rate
        scaled = {degree: scale * coefficient for degree, coefficient in figure.zonal.items()}
        return [zonal_law(scaled, figure.radius, self.gm[name], place[name]) for name in self.near]

    def _mean_pole_at(self, times: FloatArray) -> FloatArray | None:
        if self.mean_pole is None:
            return None
        return np.ascontiguousarray(self.mean_pole(times.ravel()).T).reshape(3, *times.shape)
