"""Orbits over millions of years: the table in the library, a file, or an `OrbitTable`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from earthspin.bodies import Body
from earthspin.engine.part import part
from earthspin.errors import UndefinedError, Where
from earthspin.sky.columns import is_table
from earthspin.sky.orbit_files import read_orbit
from earthspin.sky.orbit_table import OrbitTable, shipped
from earthspin.units import FileName, Plain, pack, unpack

#: Name of the table that is shipped for the body.
OWN = "own"


#: Names of the arrays of a table in a scene.
_ARRAYS = ("edges", "coefficients", "axes", "errors")


class OrbitChoice(FileName):
    """Kind of input: an orbit table, which is the body's own, a file, or an `OrbitTable`."""

    words = '"own", the path of a table, or the result of read_orbit'
    hint = "str | PathLike[str] | OrbitTable"
    known = (OWN,)
    content = "the table of an orbit"

    def read(self, value: object, where: Where) -> Any:
        """Read the choice of orbit: "own", a file, an `OrbitTable`, or the result of `write`."""
        if isinstance(value, OrbitTable):
            return value
        if isinstance(value, Mapping):
            return _table_of(value, where)
        return super().read(value, where)

    def write(self, value: str | OrbitTable) -> Plain:
        """Return a word or path unchanged; convert an `OrbitTable` to a dict of all its numbers."""
        if isinstance(value, str):
            return value
        numbers = {name: pack(getattr(value, name)) for name in _ARRAYS}
        return {"name": value.name, "source": value.source, "sha256": value.sha256} | numbers

    def begins(self, head: bytes) -> bool:
        """Return True if the first bytes `head` begin a NumPy archive or a text table."""
        return head[:2] == b"PK" or is_table(head)


def _table_of(table: Mapping[str, Any], where: Where) -> OrbitTable:
    """Build an `OrbitTable` from the dict in which a scene file stores it."""
    wanted = {"name", "source", "sha256", *_ARRAYS}
    if set(table) != wanted:
        raise where.error(sorted(table), f"an orbit table needs {', '.join(sorted(wanted))}")
    edges, coefficients, axes, errors = (unpack(table[name], where) for name in _ARRAYS)
    windows = len(edges) - 1
    shapes = coefficients.shape[:2] == (4, windows) and errors.shape == (2, windows)
    if not shapes or axes.shape != (3, 3) or coefficients.ndim != 3:
        raise where.error("a table", "the shapes of its arrays do not fit together")
    return OrbitTable(
        name=str(table["name"]),
        edges=edges,
        coefficients=coefficients,
        axes=axes,
        source=str(table["source"]),
        errors=errors,
        sha256=str(table["sha256"]),
    )


@part
def orbit_table(orbit: str | OrbitTable, body: Body) -> OrbitTable:
    """Return the table of the body's orbit over millions of years."""
    if not isinstance(orbit, str):
        return orbit
    if orbit != OWN:
        return read_orbit(orbit, body=body.name)
    table = shipped(body.name)
    if table is None:
        raise UndefinedError(
            f"no orbit over millions of years is shipped for {body.name}; give a file as orbit"
        )
    return table
