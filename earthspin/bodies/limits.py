"""Refuse bodies that overlap, spin too fast to hold together, or precess too fast to be averaged.

A body itself may be extreme. Each question applies the limits that its formulas need.
"""

from __future__ import annotations

import math
from typing import Any

from earthspin.bodies.labelled import Numeric, all_of
from earthspin.constants import SPEED_OF_LIGHT, G
from earthspin.errors import BodyError, UndefinedError

#: Upper bound on the tensile strength of any material, Pa: a small rock or a flywheel may spin
#: faster than gravity alone allows, up to this tension.
STRONGEST = 1e10
#: Largest precession per radian of the orbit or of the spin, rad.
SLOW = 0.01
#: Bound on the relative error of a first-order average, divided by the sum of the two ratios of
#: precession rate to orbital and spin rate. Measured values are 0.3 to 1.8, against the rotation
#: under the Sun's torque, at two obliquities and ratios up to 0.05.
OF_AVERAGE = 2.0


def largest(value: Numeric) -> float:
    """Return the largest element of an array, or a plain number unchanged."""
    return float(value.max() if hasattr(value, "max") else value)


def extent(body: Any) -> float:
    """Radius inside which a body cannot be treated as a Newtonian point mass, m.

    Parameters
    ----------
    body : Body
        Its radius, or its Schwarzschild radius 2 GM/c2 if that is larger, is returned.
    """
    radius = 0.0 if body.radius is None else largest(body.radius)
    return max(radius, 2 * largest(body.gm) / SPEED_OF_LIGHT.value**2)


def overlap(distance: float, reach: float, name: str, centre: str) -> str | None:
    """Return an error message if two bodies overlap at a given distance, otherwise None.

    Parameters
    ----------
    distance : float
        Between their centres, m.
    reach : float
        Sum of their extents, m.
    name, centre : str
        Names of the two bodies, for the message.
    """
    if distance > reach:
        return None
    return (
        f"at a distance of {distance:.4g} m {name} lies inside {centre}: their radii, or 2 GM/c2 "
        f"if that is larger, add up to {reach:.4g} m"
    )


def refuse_break_up(body: Any) -> None:
    """Raise an error if neither gravity nor material strength can hold a spinning body together.

    Parameters
    ----------
    body : Body
        Body to check. Nothing is checked without a radius, a rotation period or a positive mass.

    Raises
    ------
    BodyError
    """
    if body.radius is None or body.spin_period is None or not all_of(body.gm > 0):
        return
    period = abs(body.spin_period)
    by_gravity = 2 * math.pi * body.radius * (body.radius / body.gm) ** 0.5
    # from density * (equatorial speed)^2 = STRONGEST
    by_strength = (3 * math.pi / (G.value * STRONGEST) * body.gm / body.radius) ** 0.5
    if all_of((period >= by_gravity) | (period >= by_strength)):
        return
    shortest = float(period.min()) if hasattr(period, "dims") else float(period)
    hours = largest(by_gravity) / 3600
    allowed = f"it would break up: gravity holds it together at {hours:.3g} h or more"
    raise BodyError(body.name, "spin_period", f"{shortest:g} s", allowed)


def refuse_fast_axis(by_orbit: Numeric, by_spin: Numeric) -> None:
    """Raise an error if an axis precesses too fast for averages over orbits and rotations.

    Parameters
    ----------
    by_orbit : float or array
        Precession rate of the axis or of the orbit, divided by the mean motion and summed over the
        perturbers.
    by_spin : float or array
        The same precession rate divided by the rate of the spin.

    Raises
    ------
    UndefinedError
    """
    if all_of((by_orbit <= SLOW) & (by_spin <= SLOW)):
        return
    orbits, spin = largest(by_orbit), largest(by_spin)
    word, share = ("orbit", orbits) if orbits > spin else ("rotation", spin)
    raise UndefinedError(
        f"an average over orbits needs a slow precession: this axis makes {share:.2g} turns per "
        f"{word}, and at most {SLOW:g} is allowed; use the question rotation for the full motion"
    )
