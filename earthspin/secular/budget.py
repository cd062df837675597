"""How wrong the axis may be far from the present, cause by cause.

Each cause is a change of what the solution stands on, by its 95 % half-width; the solution is made
again with it, and how far it then lies away is the share of that cause. Up to a few thousand years
the constant of precession and the rate of J2 count; beyond ten thousand years what counts is the
Earth itself: how its tides and its figure were in the past. Where that makes changes large, all
causes are changed at once (`sample`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
#: Causes that are known of the Earth alone.
OF_THE_EARTH = ("J2 rate", "tides", "ellipticity")


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
class Uncertainty:
    """95 % half-widths of what a solution stands on, each of one cause.

    Attributes
    ----------
    constant : float
        Relative, of the constant of precession.
    orbit : callable
        Of the orbit's normal (rad) and eccentricity vector at times, s, shape (2, n).
    earth : bool
        Whether tides and ellipticity are those of the Earth, and uncertain as hers are.
    start : tuple of float
        Of the axis at J2000.0, rad: towards the normal of the orbit, and across if there are two;
        empty if the start is no cause.
    """

    constant: Numeric
    orbit: HalfWidths
    earth: bool
    start: tuple[float, ...]

    @property
    def causes(self) -> tuple[str, ...]:
        """Causes, each as often as there are ways to move what it changes."""
        moved = ("constant", *(("start",) * len(self.start)), "orbit", "orbit")
        return moved + OF_THE_EARTH if self.earth else moved


@dataclass(frozen=True)
class Solved:
    """The axis in time, and in time again with each cause changed.

    Attributes
    ----------
    path : Trajectory
    setting : Setting
    uncertainty : Uncertainty
    others : tuple of (str, Trajectory, Setting)
        By cause: the trajectory with that cause changed, and the setting it belongs to.
    """

    path: Trajectory
    setting: Setting
    uncertainty: Uncertainty
    others: tuple[tuple[str, Trajectory, Setting], ...]

    @property
    def steps(self) -> int:
        """Newton steps of all."""
        return self.path.steps + sum(path.steps for _, path, _ in self.others)


def solved(setting: Setting, span: tuple[float, float], uncertainty: Uncertainty) -> Solved:
    """Follow the axis, with each cause changed, and for the method with windows twice as long.

    Parameters
    ----------
    setting : Setting
    span : tuple of float
        s from J2000.0 TDB.
    uncertainty : Uncertainty
    """
    path = solve(setting.strength, setting.orbit, setting.start, span, pieces=2)
    others = (("method", setting), *changes(setting, uncertainty))
    return Solved(
        path,
        setting,
        uncertainty,
        tuple(
            (name, solve(of.strength, of.orbit, of.start, span, near=path), of)
            for name, of in others
        ),
    )


def moved(orbit: Orbit, error: HalfWidths, ways: Sequence[float]) -> Changed:
    """An orbit tilted and drawn out by multiples of its half-widths.

    Parameters
    ----------
    orbit : Orbit
    error : callable
    ways : sequence of float
        By how many half-widths, towards each of two directions across the normal of J2000.0.
    """
    directions = reference_axes(orbit.at(np.zeros(1))[0][:, 0])[:2]

    def change(times: FloatArray, shape: Shape) -> Shape:
        normal, eccentricity, turning = shape
        towards = np.zeros_like(normal)
        for direction, amount in zip(directions[:, :, np.newaxis], ways, strict=True):
            along = direction - normal * np.sum(direction * normal, axis=0)
            towards += amount * along / np.sqrt(np.sum(along**2, axis=0))
        by_normal, by_shape = error(times)
        tilted = normal + by_normal * towards
        tilted = tilted / np.sqrt(np.sum(tilted**2, axis=0))
        return tilted, eccentricity + by_shape * towards, turning

    return Changed(orbit, change)


def leaning(setting: Setting, angles: Sequence[float]) -> FloatArray:
    """Return the start moved by small angles, same shape.

    Parameters
    ----------
    setting : Setting
    angles : sequence of float
        Towards the normal of the orbit or away from it, and across if there are two, rad.
    """
    start = setting.start.reshape(3, -1)
    across = cross(setting.orbit.at(np.zeros(1))[0], start)
    other = start
    for angle, direction in zip(angles, (cross(across, start), across), strict=False):
        other = other + angle * direction / np.maximum(np.sqrt(dot(direction, direction)), 1e-300)
    return np.asarray((other / np.sqrt(dot(other, other))).reshape(setting.start.shape))


def changes(setting: Setting, uncertainty: Uncertainty) -> tuple[tuple[str, Setting], ...]:
    """What each cause makes of a setting by its half-width; the orbit is moved two ways."""
    causes = uncertainty.causes
    return tuple(
        (cause, changed(setting, uncertainty, amounts))
        for cause, amounts in zip(causes, np.eye(len(causes)), strict=True)
    )


def changed(setting: Setting, uncertainty: Uncertainty, amounts: FloatArray) -> Setting:
    """A setting with all its causes changed at once.

    Parameters
    ----------
    setting : Setting
    uncertainty : Uncertainty
    amounts : ndarray, shape (k,)
        By how many half-widths, in the order of `Uncertainty.causes`.
    """
    given = iter(float(amount) for amount in amounts)
    constant = next(given)
    angles = [next(given) * half_width for half_width in uncertainty.start]
    ways = [next(given), next(given)]
    j2, tides, drift = given if uncertainty.earth else (0.0, 0.0, 0.0)
    strength, start, orbit = setting.strength, setting.start, setting.orbit
    if any(angles):
        start = leaning(setting, angles)
    if any(ways):
        orbit = moved(orbit, uncertainty.orbit, ways)
    stronger, faster = 1 + constant * uncertainty.constant, 1 + tides * TIDES_SHARE
    strength = replace(
        strength,
        sun=strength.sun * stronger,
        moon=strength.moon * stronger,
        tides=Tides(strength.tides.moon * faster, strength.tides.spin * faster),
        j2_band=j2,
        ellipticity_drift=drift * ELLIPTICITY_DRIFT,
    )
    return Setting(strength, orbit, start)
