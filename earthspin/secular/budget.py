"""How wrong the axis may be far from the present, cause by cause.

Each cause is a change of what the solution stands on, by its 95 % half-width; the solution is made
again with it, and how far it then lies away is the share of that cause. Up to a few thousand years
the constant of precession and the rate of J2 count; beyond ten thousand years what counts is the
Earth itself: how its tides and its figure were in the past.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import JULIAN_YEAR
from earthspin.secular.orbit import Changed, Orbit, Shape, reference_axes
from earthspin.secular.strength import Numeric, Strength, Tides
from earthspin.secular.trajectory import Trajectory, solve
from earthspin.torque.quadrupole import cross, dot

FloatArray = NDArray[np.float64]

#: Half-widths of an orbit's normal (rad) and eccentricity vector at times in s, shape (2, n).
HalfWidths: TypeAlias = "Callable[[FloatArray], FloatArray]"

#: Share of today's tides by which their mean over the past may differ: an assumption. People sweep
#: factors of 0 to 1.2; 0.2 is the distance of today's from that end.
TIDES_SHARE = 0.2
#: Drift of the mean dynamical ellipticity by mantle convection, relative, s-1: an assumption.
#: People sweep factors of 0.998 to 1.012; half of that width is reached in ten million years.
ELLIPTICITY_DRIFT = 0.007 / (10e6 * JULIAN_YEAR)


@dataclass(frozen=True)
class Setting:
    """All that a solution stands on.

    Attributes
    ----------
    strength : Strength
    orbit : Orbit
    start : ndarray, shape (3,) or (3, ...)
        Unit vector of the axis at J2000.0, or of the axes of members.
    """

    strength: Strength
    orbit: Orbit
    start: FloatArray


@dataclass(frozen=True)
class Solved:
    """The axis in time, and in time again with each cause changed.

    Attributes
    ----------
    path : Trajectory
    setting : Setting
    others : tuple of (str, Trajectory, Setting)
        By cause: the trajectory with that cause changed, and the setting it belongs to.
    """

    path: Trajectory
    setting: Setting
    others: tuple[tuple[str, Trajectory, Setting], ...]

    @property
    def steps(self) -> int:
        """Newton steps of all."""
        return self.path.steps + sum(path.steps for _, path, _ in self.others)


def solved(
    setting: Setting, span: tuple[float, float], causes: tuple[tuple[str, Setting], ...]
) -> Solved:
    """Follow the axis, with each cause changed, and for the method with windows twice as long.

    Parameters
    ----------
    setting : Setting
    span : tuple of float
        s from J2000.0 TDB.
    causes : tuple of (str, Setting)
        As `changes` gives them.
    """
    path = solve(setting.strength, setting.orbit, setting.start, span, pieces=2)
    others = (("method", setting), *causes)
    return Solved(
        path,
        setting,
        tuple(
            (name, solve(of.strength, of.orbit, of.start, span, near=path), of)
            for name, of in others
        ),
    )


def moved(orbit: Orbit, error: HalfWidths, way: int) -> Changed:
    """An orbit tilted and drawn out by its half-widths.

    Parameters
    ----------
    orbit : Orbit
    error : callable
    way : int
        0 or 1: towards either of two directions across the normal of J2000.0.
    """
    direction = reference_axes(orbit.at(np.zeros(1))[0][:, 0])[way][:, np.newaxis]

    def change(times: FloatArray, shape: Shape) -> Shape:
        normal, eccentricity, turning = shape
        along = direction - normal * np.sum(direction * normal, axis=0)
        along = along / np.sqrt(np.sum(along**2, axis=0))
        by_normal, by_shape = error(times)
        tilted = normal + by_normal * along
        tilted = tilted / np.sqrt(np.sum(tilted**2, axis=0))
        return tilted, eccentricity + by_shape * along, turning

    return Changed(orbit, change)


def tilted(setting: Setting, angle: float) -> FloatArray:
    """Return the start tilted by an angle (rad) from the normal of the orbit, same shape."""
    start = setting.start.reshape(3, -1)
    across = cross(cross(setting.orbit.at(np.zeros(1))[0], start), start)
    tilted = start + angle * across / np.maximum(np.sqrt(dot(across, across)), 1e-300)
    return np.asarray((tilted / np.sqrt(dot(tilted, tilted))).reshape(setting.start.shape))


def changes(
    setting: Setting, *, constant: Numeric, pole: float | None, earth: bool, error: HalfWidths
) -> tuple[tuple[str, Setting], ...]:
    """What each cause makes of a setting; the orbit is moved two ways.

    Parameters
    ----------
    setting : Setting
    constant : float
        Relative half-width of the constant of precession.
    pole : float or None
        Half-width of the direction of the pole at J2000.0, rad: the start is tilted by it. None if
        it is not known; the start is then no cause.
    earth : bool
        Whether tides and ellipticity are those of the Earth, and uncertain as hers are.
    error : callable
        Half-widths of the orbit's normal (rad) and eccentricity at times, s, shape (2, n).
    """
    strength = setting.strength
    found = [
        (
            "constant",
            replace(
                setting,
                strength=replace(
                    strength, sun=strength.sun * (1 + constant), moon=strength.moon * (1 + constant)
                ),
            ),
        ),
        *([] if pole is None else [("start", replace(setting, start=tilted(setting, pole)))]),
        *(("orbit", replace(setting, orbit=moved(setting.orbit, error, way))) for way in (0, 1)),
    ]
    if earth:
        tides = strength.tides
        slower = Tides(tides.moon * (1 + TIDES_SHARE), tides.spin * (1 + TIDES_SHARE))
        found += [
            ("J2 rate", replace(setting, strength=replace(strength, j2_band=1.0))),
            ("tides", replace(setting, strength=replace(strength, tides=slower))),
            (
                "ellipticity",
                replace(setting, strength=replace(strength, ellipticity_drift=ELLIPTICITY_DRIFT)),
            ),
        ]
    return tuple(found)
