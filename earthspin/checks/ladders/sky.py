"""The sky of the ladders: the default body, and Sun and Moon from the kernel that comes along."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from earthspin.bodies import MOON, SUN

if TYPE_CHECKING:
    from earthspin.bodies import Body
    from earthspin.sky.ephemeris import Ephemeris

#: What pulls.
GM = {"sun": SUN.gm, "moon": MOON.gm}
CODES = {"sun": SUN.naif[0], "moon": MOON.naif[0]}


def body() -> Body:
    """What is pulled: the body that a scene has by default."""
    from earthspin.scene.spec import Scene

    default: Body = Scene(compute="pole").body
    return default


def centre() -> int:
    """Its NAIF code."""
    return body().naif[0]


@cache
def kernel() -> Ephemeris:
    """DE421, opened once."""
    from earthspin.sky.ephemeris import open_ephemeris

    return open_ephemeris("de421")
