"""Kind of input for poles: a name, two angles, or a table of rates and periodic terms."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from earthspin.errors import Where
from earthspin.sky.moving_pole import MovingPole
from earthspin.sky.poles import Direction, Pole
from earthspin.units import quantity


class Angles:
    """Kind of input: the pole of a body, as two angles, a name, or a table of a moving pole."""

    words, hint = "right ascension and declination", "tuple[float | str, float | str]"
    form = '["... deg", "... deg"]'

    def read(self, value: object, where: Where) -> object:
        """Read the pole of a body: two angles (rad by default), a name, or a table."""
        if isinstance(value, str) or hasattr(value, "of_the_iau"):
            return value
        if isinstance(value, Mapping):
            return MovingPole.read(value, where)
        angles = value if isinstance(value, (list, tuple)) else (value,)
        if any(getattr(a, "ndim", 0) or isinstance(a, (list, tuple)) for a in angles):
            raise where.error("an array", f"give one direction: {self.words}")
        if not isinstance(value, (list, tuple)) or len(value) != 2:
            raise where.error(value, f"give {self.words}")
        return tuple(quantity(angle, "rad", where, "317.7 deg") for angle in value)

    def write(self, value: Direction | Pole) -> str | list[str] | dict[str, Any]:
        """Form stored in scene files: the name, the two angles, or the table of a moving pole."""
        if isinstance(value, MovingPole):
            return value.write()
        if isinstance(value, Direction):
            return [f"{float(angle)!r} rad" for angle in value]
        return str(value)
