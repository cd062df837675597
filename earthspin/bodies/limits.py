"""Limits of the formulas: bodies that are apart, spins that hold together, axes that turn slowly.

A body itself may be extreme. Each question applies the rules that its formulas need, and each rule
stands here once.
"""

from __future__ import annotations

import math
from typing import Any

from earthspin.bodies.labelled import Numeric, all_of
from earthspin.constants import SPEED_OF_LIGHT, G
from earthspin.errors import BodyError, UndefinedError

#: Tension that no material bears, Pa: a spin below it may exceed what gravity alone holds, as
#: that of a small rock or a flywheel does.
STRONGEST = 1e10
#: Largest precession in one radian of an orbit, or of the spin, rad.
SLOW = 0.01
#: Bound on the relative error of a first-order average, over the sum of both shares: 0.3 to 1.8
#: measured against the rotation under the Sun, at two obliquities and shares up to 0.05.
OF_AVERAGE = 2.0


def largest(value: Numeric) -> float:
    """Return a number, or the largest of an array."""
    return float(value.max() if hasattr(value, "max") else value)


def extent(body: Any) -> float:
    """Distance inside which a body is no point mass of Newton's law, m.

    Parameters
    ----------
    body : Body
        Its radius counts, or that of its horizon, 2 GM/c2, if that is larger.
    """
    radius = 0.0 if body.radius is None else largest(body.radius)
    return max(radius, 2 * largest(body.gm) / SPEED_OF_LIGHT.value**2)


def overlap(distance: float, reach: float, name: str, centre: str) -> str | None:
    """Say that two bodies overlap at a distance, if they do.

    Parameters
    ----------
    distance : float
        Between their centres, m.
    reach : float
        Sum of their extents, m.
    name, centre : str
        Of the bodies, as they stand in the message.
    """
    if distance > reach:
        return None
    return (
        f"at a distance of {distance:.4g} m {name} lies inside {centre}: their radii, or 2 GM/c2 "
        f"if that is larger, add up to {reach:.4g} m"
    )


def refuse_break_up(body: Any) -> None:
    """Refuse a spin that neither gravity nor any material holds together.

    Parameters
    ----------
    body : Body
        With a mass; without a radius or a spin nothing is checked.

    Raises
    ------
    BodyError
    """
    if body.radius is None or body.spin_period is None or not all_of(body.gm > 0):
        return
    period = abs(body.spin_period)
    by_gravity = 2 * math.pi * body.radius * (body.radius / body.gm) ** 0.5
    # density times the square of the equator's speed is STRONGEST
    by_strength = (3 * math.pi / (G.value * STRONGEST) * body.gm / body.radius) ** 0.5
    if all_of((period >= by_gravity) | (period >= by_strength)):
        return
    shortest = float(period.min()) if hasattr(period, "dims") else float(period)
    allowed = (
        f"its equator flies off: gravity holds it at {largest(by_gravity) / 3600:.3g} h or more"
    )
    raise BodyError(body.name, "spin_period", f"{shortest:g} s", allowed)


def refuse_fast_axis(by_orbit: Numeric, by_spin: Numeric) -> None:
    """Refuse an axis that turns too fast for an average over orbits and spin.

    Parameters
    ----------
    by_orbit : float or array
        Rate of precession, of the axis or the orbit, over the mean motion; summed over what pulls.
    by_spin : float or array
        The same over the rate of the spin.

    Raises
    ------
    UndefinedError
    """
    if all_of((by_orbit <= SLOW) & (by_spin <= SLOW)):
        return
    orbits, spin = largest(by_orbit), largest(by_spin)
    word, share = ("orbit", orbits) if orbits > spin else ("rotation", spin)
    raise UndefinedError(
        f"an average over orbits needs a slow precession: this one makes {share:.2g} turns in each "
        f"{word}, and at most {SLOW:g} is allowed; ask rotation for the motion itself"
    )
