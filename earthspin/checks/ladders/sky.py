"""The sky of the ladders: the default body, and Sun and Moon from the kernel that comes along."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from earthspin.bodies import MOON, SUN
from earthspin.checks.default_body import default_body

if TYPE_CHECKING:
    from earthspin.sky.ephemeris import Ephemeris

#: What pulls.
GM = {"sun": SUN.gm, "moon": MOON.gm}
CODES = {"sun": SUN.naif[0], "moon": MOON.naif[0]}


def centre() -> int:
    """NAIF code of what is pulled: the body that a question has by default."""
    return default_body().naif[0]


@cache
def kernel() -> Ephemeris:
    """DE421, opened once."""
    from earthspin.sky.ephemeris import open_ephemeris

    return open_ephemeris("de421")
