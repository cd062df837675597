"""Lists of the built-in bodies and of their cited numbers as text, for the terminal."""

from __future__ import annotations

import math

from earthspin.bodies.body import BODIES, NUMBERS, body
from earthspin.errors import Where

#: Fields that the question precession needs, in the order of the list.
_ASKED = ("radius", "j2", "dynamical_flattening", "spin_period", "pole")


def all_in_words() -> str:
    """Table of all built-in bodies as text: whether each can rotate, and which numbers it lacks."""
    width = max(map(len, BODIES))
    lines = []
    for name, world in BODIES.items():
        missing = [field for field in _ASKED if getattr(world, field) is None]
        status = "pulls and spins" if not missing else "pulls"
        if 0 < len(missing) < len(_ASKED) - 1:
            status = f"pulls and spins; not known: {', '.join(missing)}"
        lines.append(f"{name:<{width}}  {status}")
    return "\n".join([*lines, "", "each number with its source: earthspin info bodies NAME"])


def in_words(name: str) -> str:
    """List every number of a body with its unit, standard deviation and source.

    Raises
    ------
    SceneError
        If there is no such body.
    """
    world = body(name, Where("bodies"))
    lines = [f"{world.name}: {world.reference}"]
    for field, number in NUMBERS.get(world.name, {}).items():
        error = f" ± {number.uncertainty:.2g}" if number.uncertainty else ""
        lines.append(f"  {field} = {number.value:.9g}{error} {number.unit}".rstrip())
        lines.append(f"      {number.source}")
    for moon in world.satellites:
        error = f" ± {moon.gm_uncertainty:.2g}" if moon.gm_uncertainty else ""
        inclination = math.degrees(moon.i)
        lines.append(
            f"  satellite {moon.name}: gm = {moon.gm:.9g}{error} m3 s-2, a = {moon.a:.9g} m, "
            f"i = {inclination:.4g} deg"
        )
        lines.append(f"      {moon.reference}")
    if world.pole is not None:
        lines.append(f"  pole: {world.pole}")
    return "\n".join(lines)
