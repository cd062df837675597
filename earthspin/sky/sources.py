"""Sources of positions by their words, and what may be given for the place of one body."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal

from earthspin.errors import Where
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.sky.protocol import Place, Source, Trajectory, words

if TYPE_CHECKING:
    from skyfield.vectorlib import VectorFunction

#: Reader of the kernel: jplephem, which is fast, or Skyfield by its public calls.
SourceName = Literal["jplephem", "skyfield"]
#: Sources with an equator of date of their own.
OF_DATE = ("skyfield",)

_GIVE = "give a vector function of Skyfield's, or an object with centre, coverage and positions()"
#: Word for what a scene cannot hold.
_LIVE = "live"


def open_source(word: SourceName, ephemeris: str | PathLike[str]) -> Source:
    """Open a kernel with one of the sources.

    Parameters
    ----------
    word : str
    ephemeris : str or path
        As `open_ephemeris` takes it.

    Raises
    ------
    SceneError, MissingExtraError, KernelError
        If there is no such kernel, or it cannot be used.
    """
    kernel = open_ephemeris(ephemeris)
    if word == "jplephem":
        return kernel
    from earthspin.sky.skyfield import Skyfield

    return Skyfield(kernel)


def describe_source(word: SourceName, ephemeris: object) -> str:
    """Say for people where the positions come from."""
    how = {
        "jplephem": f"read from {ephemeris} with jplephem",
        "skyfield": f"and directions by Skyfield from {ephemeris}: "
        "(body - centre).at(t).frame_latlon(equator)",
    }
    return how[word]


# --- the place of one body -----------------------------------------------------------------------


def is_vector_function(value: object) -> bool:
    """Recognise a vector function of Skyfield's without importing Skyfield."""
    return any(
        kind.__module__ == "skyfield.vectorlib" and kind.__name__ == "VectorFunction"
        for kind in type(value).__mro__
    )


def trajectory(position: Any) -> Trajectory:
    """Trajectory of what was given for the place of a body, as `read_position` left it."""
    if is_vector_function(position):
        from earthspin.sky.vector_functions import VectorTrajectory

        return VectorTrajectory(position)
    own: Trajectory = position
    return own


def read_position(value: Any, where: Where) -> VectorFunction | Trajectory:
    """Read the place of one body.

    Parameters
    ----------
    value : vector function, Trajectory, or table
        A table names segments of kernels, ``{kernel = "de421", centre = 0, target = 5}``, or a
        list of them that are added.

    Raises
    ------
    SceneError
        If it is none of these, or was an object that a scene cannot hold.
    KernelError
        If a kernel that a table names cannot be used, or has changed.
    """
    if is_vector_function(value):
        if type(value.center) is not int:
            raise where.error(value, "its center is no NAIF code; add what leads to a planet")
        return value
    tables = [value] if isinstance(value, Mapping) else value
    if isinstance(tables, list) and tables and all(isinstance(table, Mapping) for table in tables):
        if _LIVE in tables[0]:
            problem = "it was a live object, which no scene can hold; give it again in Python"
            raise where.error(tables[0][_LIVE], problem)
        from earthspin.sky.vector_functions import read_segments

        return read_segments(tables, where)
    parts = (getattr(value, "centre", None), getattr(value, "coverage", None))
    callable_ = callable(getattr(value, "positions", None))
    if type(parts[0]) is not int or parts[1] is None or not callable_:
        raise where.error(value, _GIVE)
    try:
        hash(value)
    except TypeError:
        raise where.error(value, "it cannot be hashed; make it a frozen dataclass") from None
    own: Trajectory = value
    return own


def describe_position(position: object) -> str:
    """What gives the place of a body, for people: on one line, the same in every run."""
    return words(repr(position))


def write_position(position: Any) -> Any:
    """Give the place of one body as a scene holds it: by its segments if kernels are all it is."""
    if is_vector_function(position):
        from earthspin.sky.vector_functions import write_segments

        tables = write_segments(position)
        if tables is not None:
            return tables
    return {_LIVE: describe_position(position)}


def is_measured(position: Any) -> bool:
    """Whether the error of a place was measured: it stands on kernels alone."""
    return getattr(trajectory(position), "code", None) is not None


def place_of(source: Source, name: str, codes: tuple[int, ...], position: Any = None) -> Place:
    """Place of a body in a source: its own trajectory if it has one, else its NAIF code.

    Raises
    ------
    KernelError
        If the source cannot place any of its codes.
    """
    return source.code(codes, name) if position is None else trajectory(position)
