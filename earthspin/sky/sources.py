"""Open sources of positions by name, and read positions of single bodies given by the user."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal

from earthspin.errors import Where
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.sky.protocol import Place, Source, Trajectory, words

if TYPE_CHECKING:
    from skyfield.vectorlib import VectorFunction

#: Reader of the kernel: jplephem, which is fast, or Skyfield's public calls.
SourceName = Literal["jplephem", "skyfield"]
#: Sources that compute an equator of date.
OF_DATE = ("skyfield",)

_GIVE = "give a vector function of Skyfield's, or an object with centre, coverage and positions()"
#: Key that marks an object that a scene cannot store.
_LIVE = "live"


def open_source(word: SourceName, ephemeris: str | PathLike[str]) -> Source:
    """Open an ephemeris kernel with the named reader, "jplephem" or "skyfield".

    Parameters
    ----------
    word : str
    ephemeris : str or path
        Kernel, as for `open_ephemeris`.

    Raises
    ------
    SceneError, MissingExtraError, KernelError
        If there is no such kernel, or it is invalid.
    """
    if word == "jplephem":
        return open_ephemeris(ephemeris)
    from earthspin.sky.skyfield import Skyfield

    return open_ephemeris(ephemeris, Skyfield)


def describe_source(word: SourceName, ephemeris: object) -> str:
    """Describe in words how positions are computed, for example "read from de421 with jplephem"."""
    how = {
        "jplephem": f"read from {ephemeris} with jplephem",
        "skyfield": f"and directions by Skyfield from {ephemeris}: "
        "(body - centre).at(t).frame_latlon(equator)",
    }
    return how[word]


# --- position of one body -----------------------------------------------------------------------


def is_vector_function(value: object) -> bool:
    """Return True if an object is a Skyfield vector function; Skyfield is not imported."""
    return any(
        kind.__module__ == "skyfield.vectorlib" and kind.__name__ == "VectorFunction"
        for kind in type(value).__mro__
    )


def trajectory(position: Any) -> Trajectory:
    """Return a body's trajectory; a Skyfield vector function is wrapped as a `VectorTrajectory`."""
    if is_vector_function(position):
        from earthspin.sky.skyfield import VectorTrajectory

        return VectorTrajectory(position)
    custom: Trajectory = position
    return custom


def read_position(value: Any, where: Where) -> VectorFunction | Trajectory:
    """Check a body's source of positions; return it as a vector function or as a trajectory.

    Parameters
    ----------
    value : vector function, Trajectory, or table
        A table gives a segment of a kernel, ``{kernel = "de421", centre = 0, target = 5}``; a list
        of such tables gives their sum.

    Raises
    ------
    SceneError
        If `value` is none of these, or was an object that a scene cannot store.
    KernelError
        If a kernel in a table is invalid, or has changed.
    """
    if is_vector_function(value):
        if type(value.center) is not int:
            raise where.error(value, "its center is no NAIF code; add what leads to a planet")
        return value
    tables = [value] if isinstance(value, Mapping) else value
    if isinstance(tables, list) and tables and all(isinstance(table, Mapping) for table in tables):
        if _LIVE in tables[0]:
            problem = "it was a Python object, which a scene cannot store; pass it again in Python"
            raise where.error(tables[0][_LIVE], problem)
        from earthspin.sky.skyfield import read_segments

        return read_segments(tables, where)
    parts = (getattr(value, "centre", None), getattr(value, "coverage", None))
    callable_ = callable(getattr(value, "positions", None))
    if type(parts[0]) is not int or parts[1] is None or not callable_:
        raise where.error(value, _GIVE)
    try:
        hash(value)
    except TypeError:
        raise where.error(value, "it cannot be hashed; make it a frozen dataclass") from None
    return value


def describe_position(position: object) -> str:
    """Describe a body's source of positions in one line of text, without memory addresses."""
    return words(repr(position))


def write_position(position: Any) -> Any:
    """Describe a body's position source for scene files: kernel segments, or else a text."""
    if is_vector_function(position):
        from earthspin.sky.skyfield import write_segments

        tables = write_segments(position)
        if tables is not None:
            return tables
    return {_LIVE: describe_position(position)}


def is_measured(position: Any) -> bool:
    """Return True if the position error of a body is known (only for positions from kernels)."""
    return getattr(trajectory(position), "code", None) is not None


def place_of(source: Source, name: str, codes: tuple[int, ...], position: Any = None) -> Place:
    """Return the trajectory of a body, or else the NAIF code by which a source finds the body.

    Raises
    ------
    KernelError
        If the source has none of the body's codes.
    """
    return source.code(codes, name) if position is None else trajectory(position)
