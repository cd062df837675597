"""What the IAU's rate of precession says about H and C, and what the Earth's inside says.

H is itself inferred from observed precession, so that our rate with that H must come out
right: closure tests consistency. Only a model of the inside gives C on its own.
"""

from __future__ import annotations

import math

from earthspin.mass.inertia import polar_moment_factor

#: Effects whose published sizes tell how sure our own are.
COMPARED = ("planets", "j4", "geodesic", "second-order")


def inferred_h(h: float, torque_rate: float, excess: float) -> float:
    """H that would bring our rate to the IAU's.

    Parameters
    ----------
    h : float
        H that was used.
    torque_rate : float
        The part of our rate that grows with H.
    excess : float
        Our rate less the IAU's, all effects counted, in the same unit.
    """
    return h * (1 - excess / torque_rate)


def inferred_h_uncertainty(h: float, torque_rate: float, effects: float, method: float) -> float:
    """One standard deviation of the inferred H.

    Parameters
    ----------
    h, torque_rate : float
    effects : float
        Root sum square of what our effects differ by from the published ones.
    method : float
        By what the same analysis misses the rate of a pole whose rate is known.
    """
    return abs(h / torque_rate) * math.hypot(effects, method)


def polar_moment_from_mean(
    mean_moment: float, mean_radius: float, equatorial_radius: float, j2: float
) -> float:
    """C/(M a2) of a body whose mean moment of inertia a spherical model gives.

    I = (A + B + C)/3 and C - (A + B)/2 = J2 M a2 give C = I + (2/3) J2 M a2.

    Parameters
    ----------
    mean_moment : float
        I/(M R2).
    mean_radius, equatorial_radius : float
        R and a, m.
    j2 : float
    """
    return mean_moment * (mean_radius / equatorial_radius) ** 2 + 2 / 3 * j2


def polar_moment_from_h(j2: float, h: float) -> float:
    """C/(M a2) from the bulge and the dynamical flattening."""
    return float(polar_moment_factor(j2, h))
