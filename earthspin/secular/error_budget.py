"""Error of the spin axis far from the present, with the contribution of each error source.

Each cause is an input changed by its 95 % half-width; the solution is repeated with the change, and
its difference is the contribution of that cause. Up to a few thousand years the constant of
precession and the rate of J2 dominate; beyond ten thousand years the past tides and figure of the
Earth. If the changes become large, all causes are varied together (`draws`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from earthspin.constants import JULIAN_YEAR
from earthspin.numerics.arrays import FloatArray, Numeric
from earthspin.secular.averaged_torque import (
    ChangingOrbit,
    ModifiedOrbit,
    PrecessionConstant,
    Shape,
    Tides,
    reference_axes,
)
from earthspin.secular.trajectory import AxisTrajectory, solve
from earthspin.torque.gravity import cross, dot

# If the phase of precession is uncertain by a large fraction of a turn, a solution with one cause
# changed may coincide with the nominal one, so its deviation is no half-width. Then the half-width
# is a quantile of the deviations of many solutions, each with all causes drawn independently
# (`draws` and `Quantiles` of `earthspin.numerics.varied_inputs`).

#: Half-widths of an orbit's normal (rad) and eccentricity vector at times in s, shape (2, n).
HalfWidths: TypeAlias = "Callable[[FloatArray], FloatArray]"

#: Relative half-width of the mean tidal dissipation in the past: an assumption. Published studies
#: vary the factor from 0 to 1.2; 0.2 is the distance of the present value from 1.2.
TIDES_SHARE = 0.2
#: Drift of the mean dynamical ellipticity by mantle convection, relative, s-1: an assumption.
#: Published studies vary the factor from 0.998 to 1.012; half of that width is reached in ten
#: million years.
ELLIPTICITY_DRIFT = 0.007 / (10e6 * JULIAN_YEAR)
#: Causes that apply only to the Earth.
OF_THE_EARTH = ("J2 rate", "tides", "ellipticity")


@dataclass(frozen=True)
class AxisInputs:
    """Inputs of one integration of the spin axis: torque, orbit and initial axis.

    Attributes
    ----------
    precession : PrecessionConstant
    orbit : ChangingOrbit
    start : ndarray, shape (3,) or (3, ...)
        Unit vector of the axis at J2000.0, or of the axes of all members.
    """

    precession: PrecessionConstant
    orbit: ChangingOrbit
    start: FloatArray


@dataclass(frozen=True)
class Uncertainty:
    """95 % half-widths of the inputs of an integration of the spin axis, by error source.

    Attributes
    ----------
    constant : float
        Relative half-width of the constant of precession.
    orbit : callable
        Half-widths of the orbit's normal (rad) and eccentricity vector at times in s, shape (2, n).
    earth : bool
        Whether tides and ellipticity are those of the Earth, with their uncertainties.
    start : tuple of float
        Half-widths of the axis at J2000.0, rad: towards the normal of the orbit, and, if there are
        two, perpendicular to that; empty if the start is not a cause.
    """

    constant: Numeric
    orbit: HalfWidths
    earth: bool
    start: tuple[float, ...]

    @property
    def causes(self) -> tuple[str, ...]:
        """Names of the error sources; a source with two directions is listed twice."""
        sources = ("constant", *(("start",) * len(self.start)), "orbit", "orbit")
        return sources + OF_THE_EARTH if self.earth else sources


@dataclass(frozen=True)
class AxisFamily:
    """Nominal trajectory of the spin axis, and one trajectory for each varied error source.

    Attributes
    ----------
    path : AxisTrajectory
    setting : AxisInputs
    uncertainty : Uncertainty
    varied : tuple of (str, AxisTrajectory, AxisInputs)
        Trajectory with one cause changed, and its setting, by cause.
    """

    path: AxisTrajectory
    setting: AxisInputs
    uncertainty: Uncertainty
    varied: tuple[tuple[str, AxisTrajectory, AxisInputs], ...]

    @property
    def steps(self) -> int:
        """Number of Newton steps, summed over the nominal and all varied trajectories."""
        return self.path.steps + sum(path.steps for _, path, _ in self.varied)


def solved(setting: AxisInputs, span: tuple[float, float], uncertainty: Uncertainty) -> AxisFamily:
    """Integrate the spin axis with nominal inputs, and again with each error source varied.

    A further integration with windows of twice the length gives the error of the method.

    Parameters
    ----------
    setting : AxisInputs
    span : tuple of float
        s from J2000.0 TDB.
    uncertainty : Uncertainty
    """
    path = solve(setting.precession, setting.orbit, setting.start, span, pieces=2)
    others = []
    for cause, varied in (("method", setting), *changes(setting, uncertainty)):
        varied_path = solve(varied.precession, varied.orbit, varied.start, span, guess=path)
        others.append((cause, varied_path, varied))
    return AxisFamily(path, setting, uncertainty, tuple(others))


def shifted_orbit(
    orbit: ChangingOrbit, error: HalfWidths, amounts: Sequence[float]
) -> ModifiedOrbit:
    """Orbit whose normal and eccentricity are shifted by multiples of their half-widths.

    Parameters
    ----------
    orbit : ChangingOrbit
    error : callable
    amounts : sequence of float
        Shifts in half-widths along each of two directions perpendicular to the normal of J2000.0.
    """
    directions = reference_axes(orbit.at(np.zeros(1))[0][:, 0])[:2]

    def change(times: FloatArray, shape: Shape) -> Shape:
        normal, eccentricity, normal_rate = shape
        shift = np.zeros_like(normal)
        for direction, amount in zip(directions[:, :, np.newaxis], amounts, strict=True):
            tangent = direction - normal * np.sum(direction * normal, axis=0)
            shift += amount * tangent / np.sqrt(np.sum(tangent**2, axis=0))
        normal_error, eccentricity_error = error(times)
        tilted = normal + normal_error * shift
        tilted = tilted / np.sqrt(np.sum(tilted**2, axis=0))
        return tilted, eccentricity + eccentricity_error * shift, normal_rate

    return ModifiedOrbit(orbit, change)


def inclined_axis(setting: AxisInputs, angles: Sequence[float]) -> FloatArray:
    """Initial spin axis rotated by small angles towards and perpendicular to the orbit normal.

    Parameters
    ----------
    setting : AxisInputs
    angles : sequence of float
        Angles towards the normal of the orbit and, if there are two, perpendicular to that, rad.
    """
    start = setting.start.reshape(3, -1)
    node = cross(setting.orbit.at(np.zeros(1))[0], start)
    axis = start
    for angle, direction in zip(angles, (cross(node, start), node), strict=False):
        axis = axis + angle * direction / np.maximum(np.sqrt(dot(direction, direction)), 1e-300)
    return np.asarray((axis / np.sqrt(dot(axis, axis))).reshape(setting.start.shape))


def changes(setting: AxisInputs, uncertainty: Uncertainty) -> tuple[tuple[str, AxisInputs], ...]:
    """Return, for each error source, the inputs with only this source varied by its half-width.

    The orbit is varied in two directions.
    """
    causes = uncertainty.causes
    return tuple(
        (cause, changed(setting, uncertainty, amounts))
        for cause, amounts in zip(causes, np.eye(len(causes)), strict=True)
    )


def changed(setting: AxisInputs, uncertainty: Uncertainty, amounts: FloatArray) -> AxisInputs:
    """Inputs with every error source varied by a given multiple of its half-width.

    Parameters
    ----------
    setting : AxisInputs
    uncertainty : Uncertainty
    amounts : ndarray, shape (k,)
        Changes in half-widths, in the order of `Uncertainty.causes`.
    """
    remaining = iter(float(amount) for amount in amounts)
    constant = next(remaining)
    angles = [next(remaining) * half_width for half_width in uncertainty.start]
    shifts = [next(remaining), next(remaining)]
    j2, tides, convection = remaining if uncertainty.earth else (0.0, 0.0, 0.0)
    precession, start, orbit = setting.precession, setting.start, setting.orbit
    if any(angles):
        start = inclined_axis(setting, angles)
    if any(shifts):
        orbit = shifted_orbit(orbit, uncertainty.orbit, shifts)
    torque_factor, tidal_factor = 1 + constant * uncertainty.constant, 1 + tides * TIDES_SHARE
    precession = replace(
        precession,
        sun=precession.sun * torque_factor,
        moon=precession.moon * torque_factor,
        tides=Tides(precession.tides.moon * tidal_factor, precession.tides.spin * tidal_factor),
        j2_band=j2,
        ellipticity_drift=convection * ELLIPTICITY_DRIFT,
    )
    return AxisInputs(precession, orbit, start)
