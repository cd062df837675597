"""All that turns the angular momentum, as one function of the axis; only what is switched on.

An effect that is off costs nothing: its masses are not looked up, its torque not evaluated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from earthspin.numerics.gauss_windows import Windows
from earthspin.torque.harmonics import zonal_law
from earthspin.torque.quadrupole import quadrupole_torque, tidal_tensor

FloatArray = NDArray[np.float64]

#: Positions by name, each of shape (t, 3), m, at times in s from J2000.0.
Positions = Callable[[FloatArray], Mapping[str, FloatArray]]
#: Rate of the angular momentum in units of C Omega, s-1, from figure axis and angular momentum.
RateLaw = Callable[[FloatArray, FloatArray], FloatArray]
#: Positions at the nodes of windows by name, each of shape (3, w, n), m.
Places = Mapping[str, FloatArray]
#: What an effect adds to l': the forces, the windows and the positions at their nodes to a rate.
Torque = Callable[["Forces", Windows, Places], RateLaw]


@dataclass(frozen=True, kw_only=True)
class Figure:
    """The numbers of a spinning body that its motion depends on.

    Attributes
    ----------
    h : float
        Dynamical flattening (C - A)/C, A the mean equatorial moment.
    spin_rate : float
        rad/s; negative if retrograde.
    inverse_polar_moment : float
        M a2/C = H/J2.
    radius : float
        Equatorial radius a, m.
    zonal : mapping of int to float
        Coefficients J_n beyond J2 that are switched on, by degree.
    j2_trend : float
        Relative rate of J2, s-1; 0 if switched off. H is taken to follow.
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
        """A/(C Omega), s: what joins figure axis and angular momentum."""
        return (1 - self.h) / self.spin_rate


@dataclass(frozen=True, kw_only=True)
class Forces:
    """What pulls on a body, and how it counts.

    Attributes
    ----------
    figure : Figure
    gm : mapping of str to float
        What pulls, m3 s-2.
    positions : callable
        Where it stands; asked for the names in `gm` alone.
    near : tuple of str
        Those that count for J3, J4 and geodesic precession.
    far : mapping of str to float
        What may pull as well, m3 s-2: the planets.
    torques : tuple of callable
        What else turns the angular momentum.
    mean_pole : callable or None
        Times (t,) to unit vectors (t, 3). Given, torques are those on an axis that points
        there: second-order effects are switched off.
    """

    figure: Figure
    gm: Mapping[str, float]
    positions: Positions
    near: tuple[str, ...] = ()
    far: Mapping[str, float] = field(default_factory=dict)
    torques: tuple[Torque, ...] = ()
    mean_pole: Callable[[FloatArray], FloatArray] | None = None

    def over(self, windows: Windows) -> tuple[RateLaw, FloatArray]:
        """Evaluate the sky at the nodes of windows.

        Returns
        -------
        rate : callable
            Figure axis and angular momentum at the nodes, shape (3, w, n), to l'.
        tensor : ndarray, shape (6, w, n)
            `tidal_tensor` of all that pulls.
        """
        figure = self.figure
        shape = windows.times.shape
        found = self.positions(windows.times.ravel())
        place = {name: np.ascontiguousarray(found[name].T).reshape(3, *shape) for name in self.gm}
        tensor = tidal_tensor((gm, place[name]) for name, gm in self.gm.items())
        scale = figure.h / figure.spin_rate * (1 + figure.j2_trend * windows.times)
        scaled = tensor * scale
        mean = self._mean_pole_at(windows.times)
        zonals = self._zonal_laws(place) if figure.zonal else []
        added = [torque(self, windows, place) for torque in self.torques]

        def on_figure(axis: FloatArray) -> FloatArray:
            total = quadrupole_torque(scaled, axis)
            for zonal in zonals:
                total += zonal(axis)
            return total

        known = None if mean is None else on_figure(mean)

        def rate(axis: FloatArray, momentum: FloatArray) -> FloatArray:
            total = on_figure(axis) if known is None else known.copy()
            for of in added:
                total += of(axis, momentum)
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
