"""The table of an orbit over millions of years, for the questions that need one."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from earthspin.bodies import Body
from earthspin.engine.part import part
from earthspin.errors import UndefinedError, Where
from earthspin.units import Plain

if TYPE_CHECKING:
    from earthspin.sky.orbit_table import OrbitTable

#: Word for the table that is shipped with a body.
OWN = "own"


@dataclass(frozen=True)
class OrbitChoice:
    """Kind of an orbit's table: that of the body, a file, or a table that was read."""

    words = '"own", the path of a table, or what read_orbit gives'
    hint = "str | PathLike[str] | OrbitTable"

    def read(self, given: object, where: Where) -> Any:
        """Take the word, a path, or a table."""
        if hasattr(given, "coefficients") and hasattr(given, "edges"):
            return given
        if not isinstance(given, (str, os.PathLike)) or not os.fspath(given).strip():
            raise where.error(given, f"it is {self.words}")
        return os.fspath(given)

    def write(self, value: Any) -> Plain:
        """Give the word or the path; a table by the file it came from."""
        return value if isinstance(value, str) else str(value.path)


@part
def orbit_table(orbit: str | OrbitTable, body: Body) -> OrbitTable:
    """Orbit of the body over millions of years."""
    from earthspin.sky.orbit_table import load, shipped

    if not isinstance(orbit, str):
        return orbit
    if orbit != OWN:
        return load(Path(orbit))
    table = shipped(body.name)
    if table is None:
        raise UndefinedError(
            f"no orbit over millions of years is shipped for {body.name}; give one: orbit = a file"
        )
    return table
