"""Tables of settings that belong to one question, read and checked.

A setting is a value with a unit, or a list of such values, or (moments alone) a table of
them. Times are given as a list, in Python, or as a duration and a number of points.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from earthspin import units
from earthspin.errors import SceneError, nearest

if TYPE_CHECKING:
    from earthspin.scene.spec import Scene

#: Settings that every table with times has.
DURATION, POINTS = "20 s", 401


@dataclass(frozen=True)
class Table:
    """What a table may hold.

    Attributes
    ----------
    name : str
    quantities : mapping
        Unit and an example, by key.
    defaults : mapping
        Values in SI for keys that may be left out.
    timed : bool
        Whether it has times.
    """

    name: str
    quantities: Mapping[str, tuple[str, str]]
    defaults: Mapping[str, Any] = field(default_factory=dict)
    timed: bool = True

    @property
    def keys(self) -> tuple[str, ...]:
        """Every key that it may hold."""
        times = ("times", "duration", "points") if self.timed else ()
        return (*self.quantities, *times)


def read_table(table: Table, scene: Scene) -> dict[str, Any]:
    """Settings of a scene's table in SI, defaults filled in.

    Parameters
    ----------
    table : Table
    scene : Scene

    Returns
    -------
    dict
        One entry a key; ``times`` as an array if the table has times.

    Raises
    ------
    SceneError, UnitsError
        If a key is unknown or missing, or a value has the wrong unit.
    """
    given = (scene.tables or {}).get(table.name, {})
    for key in given:
        if key not in table.keys:
            raise SceneError(
                f"{table.name}.{key}", given[key], nearest(key, table.keys), source=scene.source
            )
    settings: dict[str, Any] = {}
    for key, (unit, example) in table.quantities.items():
        if key not in given and key not in table.defaults:
            raise SceneError(
                f"{table.name}.{key}", None, f"give it, like {example!r}", source=scene.source
            )
        where = f"{scene.source}: {table.name}.{key}"
        value = given.get(key, table.defaults.get(key))
        settings[key] = _in_si(value, unit, where, example)
    if table.timed:
        settings["times"] = _times(table, given, scene)
    return settings


def _in_si(value: Any, unit: str, where: str, example: str) -> Any:
    """Convert a value, a list of values, or a table of values."""
    if isinstance(value, Mapping):
        return {key: _in_si(inner, unit, where, example) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_in_si(inner, unit, where, example) for inner in value]
    return units.quantity(value, unit, where, example)


def _times(table: Table, given: Mapping[str, Any], scene: Scene) -> Any:
    """Times in s: those given, or evenly spaced over the duration."""
    import numpy as np

    if "times" in given:
        return np.atleast_1d(np.asarray(given["times"], dtype=np.float64))
    duration = units.seconds(
        given.get("duration", DURATION), f"{scene.source}: {table.name}.duration"
    )
    points = given.get("points", POINTS)
    if not isinstance(points, int) or points < 1:
        raise SceneError(
            f"{table.name}.points", points, "give a whole number, 1 or more", source=scene.source
        )
    return np.linspace(0.0, duration, points)
