"""Prepare a body, its variants with changed inputs, and its perturbers for the attitude solver.

A neighbour is the same body with one uncertain number changed by its half-width. The difference of
its motion is the effect of this uncertainty. All are integrated together with the same masses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from earthspin.motion.equations import (
    FLATTENING,
    PULL,
    ROUNDING,
    TRIAXIALITY,
    CustomTorque,
    Rigid,
    SkyLaw,
)
from earthspin.motion.forces import Forces
from earthspin.motion.march import Masses
from earthspin.motion.triaxial import equatorial_basis
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.gauss_windows import Windows


def rigid_bodies(
    forces: Forces,
    unit: float,
    doubts: Mapping[str, float],
    epoch: float = 0.0,
    own: CustomTorque | None = None,
) -> tuple[Rigid, tuple[str, ...]]:
    """Make a rigid body, and copies of it that each have one uncertain input changed.

    Parameters
    ----------
    forces : Forces
        Forces with the figure of the body and the effects that are switched on.
    unit : float
        Unit of spin, rad/s.
    doubts : mapping of str to float
        Relative half-widths by `FLATTENING`, `TRIAXIALITY`, `PULL` (errors of positions) and
        `ROUNDING` (rounding of positions); an input with zero has no neighbour.
    epoch : float
        Start of the motion, s from J2000.0.
    own : callable or None
        Custom torque.

    Returns
    -------
    Rigid
        The body in the first lane, and its neighbours.
    tuple of str
        Input that is changed in each further lane.
    """
    figure = forces.figure
    names = (FLATTENING, TRIAXIALITY, PULL, ROUNDING)
    changed = tuple(name for name in names if doubts.get(name, 0.0) > 0.0)
    factor = {
        name: np.array([1.0, *(1 + doubts[name] if name == other else 1.0 for other in changed)])
        if name in changed
        else np.ones(1 + len(changed))
        for name in names
    }
    # J2 and (B - A)/(M a2) are divided by C/(M a2) = J2/H, so both differences scale with H.
    h = figure.h * factor[FLATTENING]
    triaxiality = figure.triaxiality * factor[FLATTENING] * factor[TRIAXIALITY]
    body = Rigid(
        c_minus_a=h + triaxiality / 2,
        c_minus_b=h - triaxiality / 2,
        tide=factor[PULL] * factor[ROUNDING],
        unit=unit,
        zonal=[(n, j * figure.inverse_polar_moment) for n, j in figure.zonal.items()],
        radius=figure.radius,
        trend=figure.j2_trend,
        epoch=epoch,
        own=own,
    )
    return body, changed


def masses(forces: Forces, epoch: float = 0.0) -> Masses:
    """Convert `Forces` to the `Masses` of the attitude solver, with times counted from `epoch`."""

    def laws(window: Windows, places: Mapping[str, FloatArray]) -> Sequence[SkyLaw]:
        dated = Windows(window.edges + epoch, window.order)
        return [torque(forces, dated, places) for torque in forces.torques]

    near = {name: gm for name, gm in forces.gm.items() if name in forces.near}
    return Masses(
        gm=near | dict(forces.gm),
        positions=lambda times: forces.positions(times + epoch),
        near=len(near),
        laws=laws if forces.torques else None,
    )


def relative_tide_error(distance: float, distance_error: float, angle_error: float) -> float:
    """Bound on the relative error of a tide GM/r3 due to the position error of its mass.

    Parameters
    ----------
    distance, distance_error : float
        Distance and its error, m.
    angle_error : float
        Error of the direction, rad; the relative error of the tide is at most twice this.
    """
    return 3 * distance_error / distance + 2 * angle_error


def upright(axis: FloatArray, angle: float) -> FloatArray:
    """Attitude quaternion of a body from its third axis and the rotation angle about this axis.

    Parameters
    ----------
    axis : ndarray, shape (3,)
        Third axis of the body, a unit vector along the sky's axes.
    angle : float
        Angle from the sky's x axis, projected on the equator, to the body's first axis, rad.

    Returns
    -------
    ndarray, shape (4,)
    """
    first, second = equatorial_basis(axis)
    x = math.cos(angle) * first + math.sin(angle) * second
    frame = Rotation.from_matrix(np.stack([x, np.cross(axis, x), axis], axis=1))
    return np.asarray(frame.as_quat(scalar_first=True))
