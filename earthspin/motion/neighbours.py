"""A body made ready to be followed: its numbers, what pulls on it, and its neighbours.

A neighbour is the same body with one uncertain number changed by its half-width; what it is away
by after a while is what that uncertainty does. Both go side by side, under one sky.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
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
from earthspin.motion.march import Above
from earthspin.motion.triaxial import equatorial_basis
from earthspin.numerics.gauss_windows import Windows

FloatArray = NDArray[np.float64]


def rigid_bodies(
    forces: Forces,
    unit: float,
    doubts: Mapping[str, float],
    epoch: float = 0.0,
    own: CustomTorque | None = None,
) -> tuple[Rigid, tuple[str, ...]]:
    """A body and its neighbours.

    Parameters
    ----------
    forces : Forces
        Whose figure it is, effects switched on.
    unit : float
        Unit of spin, rad/s.
    doubts : mapping of str to float
        Relative half-widths, by `FLATTENING`, `TRIAXIALITY`, `PULL` (errors of positions) and
        `ROUNDING` (rounding of positions); zero is certain.
    epoch : float
        Start of the motion, s from J2000.0.
    own : callable or None

    Returns
    -------
    Rigid
        The first lane is the body.
    tuple of str
        What each further lane has changed.
    """
    figure = forces.figure
    names = (FLATTENING, TRIAXIALITY, PULL, ROUNDING)
    changed = tuple(name for name in names if doubts.get(name, 0.0) > 0.0)
    factor = {
        name: np.array([1.0, *(1 + doubts[name] if name == one else 1.0 for one in changed)])
        if name in changed
        else np.ones(1 + len(changed))
        for name in names
    }
    # both differences are J2 and (B - A)/(M a2) over C/(M a2) = J2/H
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


def above(forces: Forces, epoch: float = 0.0) -> Above:
    """What pulls, as windows ask for it at times from an epoch, s from J2000.0."""

    def laws(window: Windows, places: Mapping[str, FloatArray]) -> Sequence[SkyLaw]:
        dated = Windows(window.edges + epoch, window.order)
        return [torque(forces, dated, places) for torque in forces.torques]

    near = {name: gm for name, gm in forces.gm.items() if name in forces.near}
    return Above(
        gm=near | dict(forces.gm),
        positions=lambda times: forces.positions(times + epoch),
        near=len(near),
        laws=laws if forces.torques else None,
    )


def doubt_of_pull(distance: float, distance_error: float, angle_error: float) -> float:
    """Bound on the relative error of a tide, GM/r3, from where a mass may be off.

    Parameters
    ----------
    distance, distance_error : float
        m.
    angle_error : float
        rad: a tide that is turned by an angle is off by no more than twice that.
    """
    return 3 * distance_error / distance + 2 * angle_error


def upright(axis: FloatArray, angle: float) -> FloatArray:
    """Attitude of a body whose third axis is given.

    Parameters
    ----------
    axis : ndarray, shape (3,)
        Unit vector along the sky's axes.
    angle : float
        From the sky's x axis, projected on the equator, to the body's first axis, rad.

    Returns
    -------
    ndarray, shape (4,)
    """
    first, second = equatorial_basis(axis)
    x = math.cos(angle) * first + math.sin(angle) * second
    frame = Rotation.from_matrix(np.stack([x, np.cross(axis, x), axis], axis=1))
    return np.asarray(frame.as_quat(scalar_first=True))
