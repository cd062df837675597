"""J2, H and triaxiality of a body, related through its moments of inertia."""

from __future__ import annotations

import math

import numpy as np

from earthspin.bodies.labelled import Numeric, all_of
from earthspin.constants import Constant
from earthspin.errors import BodyError
from earthspin.numerics.arrays import FloatArray


def flattening_of(j2: Constant, moment: Constant) -> Constant:
    """Dynamical flattening H = J2/(C/(M R2)), with its propagated uncertainty."""
    h = j2.value / moment.value
    u = math.hypot(j2.relative_uncertainty, moment.relative_uncertainty)
    return Constant(
        h,
        "",
        h * u,
        f"J2 over C/(M R2): {j2.source}; {moment.source}",
        f"{j2.read_in}; {moment.read_in}",
    )


def moments_of(j2: float, h: float, triaxiality: float) -> FloatArray:
    """Principal moments of inertia from J2, H and triaxiality, divided by M a2, shape (3,).

    The order is A <= B <= C, with C about the spin axis.

    Parameters
    ----------
    j2, h, triaxiality : float
        J2 = (C - (A + B)/2)/(M a2); H = (C - (A + B)/2)/C, not zero; (B - A)/(M a2).
    """
    polar = j2 / h
    equatorial, half = polar - j2, triaxiality / 2
    return np.array([equatorial - half, equatorial + half, polar])


def figure_of(
    name: str, moments: tuple[Numeric, Numeric, Numeric], scale: Numeric
) -> dict[str, Numeric]:
    """J2, H and triaxiality from three moments of inertia, as a dict with these field names.

    Parameters
    ----------
    name : str
        Name of the body, for messages.
    moments : three floats or labelled arrays
        Principal moments, kg m2, the polar one last.
    scale : float or labelled array
        M a2, kg m2.

    Raises
    ------
    BodyError
        If no body can have such moments.
    """
    try:
        small, middle, polar = moments
    except (TypeError, ValueError):
        raise BodyError(name, "moments", moments, "give three, the polar one last") from None
    if not all_of((small > 0) & (middle > 0) & (polar > 0)):
        raise BodyError(name, "moments", moments, "each moment must be greater than zero")
    if not all_of(abs(small - middle) <= polar):
        raise BodyError(name, "moments", moments, "no moment may exceed the sum of the other two")
    difference = polar - (small + middle) / 2
    return {
        "j2": difference / scale,
        "dynamical_flattening": difference / polar,
        "triaxiality": abs(middle - small) / scale,
    }
