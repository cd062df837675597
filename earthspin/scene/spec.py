"""A scene: one question, read from a small TOML file or built in Python, and checked here.

Everything is checked before anything is computed. Whatever is wrong is one line that
names the file, the key, what was read and what is allowed.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from dataclasses import replace as _replace
from importlib import resources
from numbers import Real
from pathlib import Path
from typing import Any

from earthspin import units
from earthspin.bodies import BODY_KEYS, Body, all_of, body
from earthspin.errors import EarthspinError, SceneError, nearest
from earthspin.scene.questions import EFFECTS, QUESTIONS, TABLES

EQUATORS = ("mean", "true")

_BODY_UNITS = {
    "mass": ("kg", "5.97e24 kg"),
    "radius": ("m", "6378 km"),
    "j2": ("", "1.08e-3"),
    "dynamical_flattening": ("", "3.27e-3"),
    "flattening": ("", "3.35e-3"),
    "triaxiality": ("", "7.26e-6"),
    "spin_period": ("s", "23.93 h"),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """One question.

    Attributes
    ----------
    compute : str
        What is asked: a word of `earthspin.scene.questions`.
    title : str
        Words for headings.
    body : Body or str
        What spins.
    perturbers : sequence of Body or str
        What pulls on it.
    effects : sequence of str or None
        Effects beside the main one; None takes all that the question has on by default.
    equator : str
        ``"mean"`` or ``"true"``: equator of date.
    ephemeris : str, path, or Skyfield kernel
        A named kernel or any .bsp file.
    span : pair of dates or None
        TDB; None takes what the question needs.
    step : duration or None
        Spacing of a series; None leaves the choice to the question.
    times : list of times or None
        Instead of `span` and `step`, the very times that are wanted (Python only).
    accuracy : float, str or None
        What the result must meet, for a question that takes it: a relative error, or an angle
        such as ``"1 mas"``.
    tables : mapping
        Settings of one question alone, by table name.
    source : str
        File that it was read from, for messages.

    Raises
    ------
    SceneError, BodyError, UnitsError
        If a key, word, unit or value is not possible.
    """

    compute: str
    title: str = ""
    body: Any = "earth"  # a Body once checked
    perturbers: Any = ("sun", "moon")  # a tuple of Body once checked
    effects: Sequence[str] | None = None
    equator: Any = "mean"  # a word once checked
    ephemeris: Any = "de421"
    span: tuple[Any, Any] | None = None
    step: Any = None
    times: Any = None
    accuracy: Any = None
    tables: Mapping[str, Mapping[str, Any]] | None = None
    source: str = "scene"

    def __post_init__(self) -> None:
        if not isinstance(self.compute, str) or self.compute not in QUESTIONS:
            raise self._error("compute", self.compute, nearest(self.compute, QUESTIONS))
        self._set(
            title=self._text("title") or self.compute,
            times=self._times(),
            body=self._spinning_body(),
            perturbers=self._perturbers(),
            effects=self._effects(),
            accuracy=self._accuracy(),
            tables=self._tables(),
        )
        if self.equator is True:  # TOML, and a shell that takes the quotes away
            self._set(equator="true")
        if self.equator not in EQUATORS:
            raise self._error("equator", self.equator, nearest(self.equator, EQUATORS))
        if self.span is not None:
            self._set(span=self._checked_span())
        if self.step is not None:
            units.time_grid("2000-01-01", "2000-01-01", self.step, self.source)
        if self.times is not None and (self.span is not None or self.step is not None):
            raise self._error("times", "...", "give either times, or span and step")

    # --- checks, one key each ------------------------------------------------------------------

    def _text(self, key: str) -> str:
        value = getattr(self, key)
        if not isinstance(value, str):
            raise self._error(key, value, "it is a line of text")
        return value

    def _times(self) -> units.TimeList | None:
        if self.times is None or isinstance(self.times, units.TimeList):
            return self.times
        return units.TimeList(units.days(self.times).copy())

    def _one_body(self, key: str, value: Any) -> Body:
        if isinstance(value, Body):
            return value
        if isinstance(value, Mapping):
            return _body_from_table(value, self.source)
        return body(value, key=key, source=self.source)

    def _spinning_body(self) -> Body:
        found = self._one_body("body", self.body)
        if not all_of(found.gm > 0):
            raise self._error("body", found.name, "the mass of a body that spins is not zero")
        return found

    def _perturbers(self) -> tuple[Body, ...]:
        given = self.perturbers
        if isinstance(given, (str, Body)):
            given = (given,)
        if not isinstance(given, Sequence) or not given:
            raise self._error("perturbers", given, "name one body or more, like ['sun', 'moon']")
        found = tuple(self._one_body("perturbers", p) for p in given)
        names = [p.name for p in found]
        for one in found:
            if hasattr(one.gm, "dims"):
                raise self._error("perturbers", one.name, "the mass of what pulls is one number")
        for name in names:
            if names.count(name) > 1:
                raise self._error("perturbers", names, f"'{name}' is named twice")
            if name == "total":
                raise self._error("perturbers", names, "'total' stands for the sum of all")
        if self._one_body("body", self.body).name in names:
            raise self._error("perturbers", names, "a body does not pull on itself")
        return found

    def _effects(self) -> tuple[str, ...]:
        modelled = QUESTIONS[self.compute].effects
        if self.effects is None:
            off = QUESTIONS[self.compute].unless_named
            return tuple(word for word in modelled if word not in off)
        if not isinstance(self.effects, (str, list, tuple)):
            raise self._error("effects", self.effects, f"it is a list of {', '.join(EFFECTS)}")
        given = (self.effects,) if isinstance(self.effects, str) else tuple(self.effects)
        for word in given:
            if word not in EFFECTS:
                raise self._error("effects", word, nearest(word, EFFECTS))
            if word not in modelled:
                raise self._error(
                    "effects",
                    word,
                    f"compute = '{self.compute}' does not model it; allowed: "
                    f"{', '.join(modelled) or 'none'}",
                )
        return given

    def _tables(self) -> dict[str, Any]:
        if self.tables is not None and not isinstance(self.tables, Mapping):
            raise self._error("tables", self.tables, "it maps names of tables to their settings")
        return dict(self.tables or {})

    def _accuracy(self) -> Any:
        """The accuracy asked for, as given: a relative error, or an angle with its unit."""
        value, kind = self.accuracy, QUESTIONS[self.compute].accuracy
        if value is None:
            return None
        if kind is None:
            raise self._error("accuracy", value, f"compute = '{self.compute}' takes none")
        plain = isinstance(value, Real) and not isinstance(value, bool)
        where = f"{self.source}: accuracy"
        if kind == "relative":
            if isinstance(value, (str, bool)):
                raise self._error(
                    "accuracy", value, "give a relative error, a number without quotes, like 1e-6"
                )
            size = value = float(value) if plain else units.number(value, "", where, "1e-6")
        elif plain or isinstance(value, bool):
            raise self._error("accuracy", value, "give an angle, like '1 mas'")
        else:
            size = units.number(value, "rad", where, "1 mas")
        if not 0 < size < math.inf:
            raise self._error("accuracy", value, "an accuracy is greater than zero")
        return value

    def _checked_span(self) -> tuple[Any, Any]:
        given = self.span
        if not isinstance(given, (list, tuple)) or len(given) != 2:
            raise self._error("span", given, "give two dates, like ['2000-01-01', '2001-01-01']")
        units.time_grid(given[0], given[1], 1.0, self.source)
        return given[0], given[1]

    def _error(self, key: str, given: Any, problem: str) -> SceneError:
        return SceneError(key, given, problem, source=self.source)

    def _set(self, **values: Any) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    # --- use ------------------------------------------------------------------------------------

    def replace(self, **changes: Any) -> Scene:
        """Return a scene with some keys changed, checked again."""
        if "compute" in changes and "effects" not in changes:
            changes["effects"] = None
        return _replace(self, **changes)


def load_scene(scene: str | Path, changes: Mapping[str, Any] | None = None) -> Scene:
    """Read a scene from a file, or a shipped one by name.

    Parameters
    ----------
    scene : str or Path
        ``"precession"``, or the path of a TOML file.
    changes : mapping, optional
        Keys to set instead of what the file says; ``"body.j2"`` reaches into a table.

    Raises
    ------
    SceneError
        If there is no such scene, it is not TOML, or a key is unknown or wrong.
    """
    text, source, name = _read(scene)
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise SceneError("file", source, f"it is not TOML: {error}") from None
    for key, value in (changes or {}).items():
        _set_key(table, key, value, source)
    return scene_from_table(table, source=source, title=name)


def scene_from_table(
    table: Mapping[str, Any], source: str = "scene", title: str | None = None
) -> Scene:
    """Check the keys of a scene table and build the scene.

    Parameters
    ----------
    table : mapping
        As TOML gives it.
    source : str
        File, for messages.
    title : str, optional
        Title if the table has none.

    Raises
    ------
    SceneError
        If a key is unknown or `compute` is missing.
    """
    if "compute" not in table:
        raise SceneError("compute", None, f"it is missing; {nearest('', QUESTIONS)}", source=source)
    keys = {f.name for f in fields(Scene)} - {"source", "times", "tables"}
    settings: dict[str, Any] = {"title": title or ""}
    tables: dict[str, Any] = {}
    for key, value in table.items():
        if key in TABLES:
            if not isinstance(value, Mapping):
                raise SceneError(key, value, f"it is a table: [{key}]", source=source)
            tables[key] = value
        elif key in keys:
            settings[key] = value
        else:
            raise SceneError(key, value, f"unknown key; {nearest(key, keys)}", source=source)
    word = table["compute"]
    if not isinstance(word, str) or word not in QUESTIONS:
        raise SceneError("compute", word, nearest(word, QUESTIONS), source=source)
    allowed = QUESTIONS[word].tables
    for name in tables:
        if name not in allowed:
            raise SceneError(name, "[...]", f"compute = '{word}' has no such table", source=source)
    return Scene(**settings, tables=tables, source=source)


def shipped_scenes() -> dict[str, str]:
    """Names of the shipped scenes, with the title of each."""
    folder = resources.files("earthspin.scene") / "library"
    found = {}
    for file in sorted(folder.iterdir(), key=lambda f: f.name):
        if file.name.endswith(".toml"):
            table = tomllib.loads(file.read_text(encoding="utf-8"))
            found[file.name.removesuffix(".toml")] = table.get("title", "")
    return found


def _read(scene: str | Path) -> tuple[str, str, str]:
    """Text of a scene, the file to name in messages, and a title."""
    text = str(scene)
    if "/" not in text and not text.endswith(".toml"):
        names = shipped_scenes()
        if text not in names:
            raise SceneError("scene", text, f"no such scene; {nearest(text, names)}, or a file")
        file = resources.files("earthspin.scene") / "library" / f"{text}.toml"
        return file.read_text(encoding="utf-8"), f"{text}.toml", text
    path = Path(scene)
    try:
        return path.read_text(encoding="utf-8-sig"), text, path.stem
    except FileNotFoundError:
        raise SceneError(
            "scene", text, f"there is no such file; shipped: {', '.join(shipped_scenes())}"
        ) from None
    except OSError as error:
        raise SceneError("scene", text, f"it cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise SceneError("scene", text, "it cannot be read: it is not text in UTF-8") from None


def _set_key(table: dict[str, Any], key: str, value: Any, source: str) -> None:
    """Set a key, dotted or not, in a table as read."""
    *path, last = key.split(".")
    for step in path:
        inner = table.get(step, {})
        # `body = "earth"` with body.j2 set means: start from that body.
        table[step] = inner = (
            {"from": inner} if step == "body" and isinstance(inner, str) else inner
        )
        if not isinstance(inner, dict):
            raise SceneError(key, value, f"'{step}' is not a table", source=source)
        table = inner
    table[last] = value


def _body_from_table(table: Mapping[str, Any], source: str) -> Body:
    """Build the body that a [body] table describes."""
    start = body(table.get("from", "earth"), key="body.from", source=source)
    changes: dict[str, Any] = {}
    for key, value in table.items():
        where = f"{source}: body.{key}"
        if key == "from":
            continue
        if key == "moments":
            if not isinstance(value, (list, tuple)) or len(value) != 3:
                raise SceneError("body.moments", value, "give three moments", source=source)
            changes[key] = [units.number(v, "kg m2", where, "8.03e37 kg m2") for v in value]
        elif key in ("pole", "orbit_pole") and not isinstance(value, str):
            if not isinstance(value, (list, tuple)) or len(value) != 2:
                raise SceneError(
                    f"body.{key}", value, "give right ascension and declination", source=source
                )
            changes[key] = tuple(units.number(v, "rad", where, "317.7 deg") for v in value)
        elif key in ("pole", "orbit_pole", "interior"):
            changes[key] = value
        elif key in _BODY_UNITS:
            changes[key] = units.number(value, _BODY_UNITS[key][0], where, _BODY_UNITS[key][1])
        else:
            raise SceneError(
                f"body.{key}", value, nearest(key, ("from", *BODY_KEYS)), source=source
            )
    try:
        return start.replace(**changes)
    except EarthspinError as error:
        raise SceneError("body", dict(table), str(error), source=source) from None
