"""Malformed inputs: nonsense, numbers of every size, odd lists, and what no one would give."""

import datetime as dt
import inspect
import random
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cftime
import numpy as np
import pandas as pd
import pint
import tomli_w
import xarray as xr
from astropy import units as u
from astropy.table import Column
from astropy.time import Time

import earthspin
from earthspin.engine.public_calls import arguments_of
from earthspin.engine.question import Question, keys_of
from earthspin.scenes import QUESTIONS, shipped_scenes
from tests import shipped

Random = random.Random


def nested(depth: int) -> list[Any]:
    """Lists in lists."""
    inner: list[Any] = []
    for _ in range(depth):
        inner = [inner]
    return inner


class Odd:
    """Somebody's class, in which nothing works."""

    def __repr__(self) -> str:
        raise ValueError("no words")

    __str__ = __repr__

    def __array__(self, *_: object, **__: object) -> None:
        raise RuntimeError("no array")

    def __len__(self) -> int:
        raise OverflowError("no length")

    def __eq__(self, other: object) -> bool:
        raise ZeroDivisionError("no comparison")

    __hash__ = None  # type: ignore[assignment]


#: What a file of TOML can hold, as it stands there.
WORDS: tuple[str, ...] = (
    '""', '"x"', '"6 h"', '"6 kg"', '"h"', '"1e400 s"', '"nan d"', '"inf"', '"-1 yr"', '"6  h"',
    '"2000-01-01"', '"2000-13-01"', '"0000-01-01"', '"9999-12-31"', '"2000-01-01T25:00"',
    '["2000-01-01", "2001-01-01"]', '["2000-01-01"]', '["2001-01-01", "2000-01-01"]', '[[], [1]]',
    "0", "-1", "1", "3.5", "1e308", "-1e308", "5e-324", "nan", "inf", "-inf", "true", "false",
    "2000-01-01", "2000-01-01T00:00:00Z", "07:30:00", "[]", "[[]]", "[1]", "[1, 2]", "[1, 2, 3]",
    "[[1, 2], [3]]", "[1, [2]]", '[1, "2 m"]', '["a", "b"]', "[true]", "[1.0, nan]", "{}",
    '{a = 1}', '{from = "mars"}', '{from = 3}', '{from = "earth", j2 = "x"}', "{float64 = 1}",
    '{shape = [1], float64 = "AAAA"}', '{shape = [-1], float64 = "AAAAAAAA8D8="}',
    '{from = "nothing"}', '"\\u001b[2J"', '"a\\nb"', '"\\u0000"', '"\\u202e"',
    '"' + "x" * 3000 + '"',
    '"6 378 km"', '"6\u00a0378.137 km"', '"23 26 arcmin"', '"3 myr"', '"20 ka"', '"-20 ka"',
    '"2 kyr BP"',
    "9" * 400, "9" * 5000, "1" + "0" * 400 + ".0", "[" * 100 + "]" * 100, "[" * 3000 + "]" * 3000,
    '"' + "9" * 5000 + ' s"', '"1e5000 s"', '"/dev/zero"', '"/"', '"sun"', '["sun", "sun"]',
    '"earth"', '["moon", 3]', '"1 mas"', '"1e-9"', '"1 us"', '"433 d"', "1e-30", "4000000", "1e18",
)  # fmt: skip


def values() -> list[Any]:
    """What a call may be given, sound and unsound."""
    times = pd.date_range("2000-01-01", periods=3)
    labelled = xr.DataArray([1.0, 2.0], dims="member", coords={"member": ["a", "b"]})
    vector = xr.DataArray([1.0, 2.0, 3.0], {"component": ["z", "x", "y"]}, "component")
    pints = pint.UnitRegistry().Quantity(np.array([1.0, 2.0]), "hour")
    return [
        None, True, False, 0, 1, -1, 3, 10**400, 10**5000, -(10**18), 0.0, -0.0, 1e308, -1e308,
        5e-324, float("nan"), float("inf"), 1 + 2j, "", " ", "x", "6 h", "6 kg", "1e400 s",
        "9" * 5000 + " s",
        "x" * 10_000, "\x1b[2J", "a\nb", "\0", "\ud800", "2000-01-01", "2000-02-30", "NaT", b"x",
        bytearray(b"6 h"), [], [[]], (), {}, set(), {1, 2}, frozenset(), [1], [1, 2], [1, 2, 3],
        [[1, 2], [3]], [1, [2]], [None], [True], ["a"], ["a", None], [float("nan")], [1, "2 m"],
        nested(50), nested(3000), list(range(1000)), "earth", "sun", ["sun", "sun"], ["sun", 3],
        {"a": 1}, {"from": "mars"}, {"from": 3}, {"from": []}, {"from": "earth", "j2": "x"},
        {"from": "earth", "name": 3}, {3: 4}, {"float64": 1}, {"shape": [1], "float64": "AAAA"},
        range(3), iter([1]), (n for n in range(2)), map(str, [1]), object(), object, int, len, ...,
        NotImplemented, Odd(), Path("/dev/zero"), Path("/"), Path("x.nc"), Exception("x"),
        dt.date(2000, 1, 1), dt.datetime(1, 1, 1, tzinfo=dt.UTC), dt.timedelta(days=1), dt.time(1),
        np.float64(3), np.float32("nan"), np.int8(3), np.bool_(True), np.str_("6 h"), np.array([]),
        np.array(3.0), np.zeros((2, 3)), np.zeros((3, 3)), np.zeros((0, 3)), np.array(["a"]),
        np.array([1 + 1j]), np.array([None]), np.array([1, "a", None], dtype=object),
        np.array([[1], [2]], dtype=object), np.ma.masked_array([1.0, 2.0], [0, 1]),
        np.datetime64("2000-01-01"), np.datetime64("NaT", "D"), np.timedelta64(1, "D"),
        "-2559-01-01T12:00", "+12025-06-15", "10 000 B.C.", "AD 1", "2016-12-31T23:59:60Z",
        "12 hours", "2000-01-01T00:00:00.123456789", np.datetime64("-2559-01-01"),
        np.datetime64("12025", "Y"), np.datetime64(2**62, "Y"), np.datetime64(-(2**62), "as"),
        Time(1e9, format="jyear"),
        *[cftime.datetime(2000, 1, 2, calendar=name) for name in ("standard", "julian", "noleap")],
        np.timedelta64("NaT", "D"), np.array(["2000-01-01", "NaT"], "M8[us]"),
        np.rec.array([(1, 2.0)]),
        3 * u.h, 3 * u.kg, [1, 2] * u.m, u.h, float("nan") * u.s, [[1, 2, 3]] * u.rad,
        Time("2000-01-01"), Time(["2000-01-01", "2001-01-01"]), Time("2000-01-01", scale="tdb"),
        times, times[0], pd.NaT, pd.NA, pd.Series([1, 2]), pd.DataFrame({"x": [1, 2]}),
        pd.Series(["a", "b"]), pd.Timedelta(1, "D"), times.tz_localize("Europe/Berlin"),
        labelled, labelled * np.nan, labelled.astype(object), xr.DataArray(3), xr.DataArray("x"),
        xr.DataArray([1.0, 2.0], attrs={"units": "kg"}), xr.DataArray([1.0], attrs={"units": 3}),
        xr.DataArray(np.zeros((2, 3)), dims=("member", "component")), xr.Dataset(),
        xr.Dataset({"x": 3}), xr.Dataset(attrs={"scene": "compute = 3"}), xr.DataTree(),
        xr.Dataset(attrs={"scene": 3}), xr.Dataset({"x": ("time", [1.0]), "y": ("time", [1.0])}),
        xr.Dataset({"x": ("time", [1.0]), "y": ("time", [1.0])}, {"time": times[:1]}),
        "6 378 km", "6\u202f378.137 km", "6 37 km", "3 myr", "20 ka", "-20 ka", "2 kyr BP", 266.86,
        pints, pints[0], [*pints], np.array([*pints, 3 * u.h], dtype=object), pd.Series([*pints]),
        xr.DataArray(pints, dims="member"), Column([1.0, 2.0], unit="h"), vector, vector[:2],
        vector.rename(component="quaternion"), pd.DataFrame([[1, 2, 3]], columns=["z", "x", "y"]),
        earthspin.EARTH, earthspin.SUN, (earthspin.SUN, 3), earthspin.Body, earthspin.load_scene,
        earthspin.load_scene("torque"), ("2000-01-01", "2000-02-01"), ("2000-01-01", None),
        ["2000-01-01", 3], ("2000-01-01", "2000-02-01", "2000-03-01"),
    ]  # fmt: skip


VALUES = values()


def _letters(rng: Random) -> str:
    return "".join(
        chr(rng.choice((rng.randrange(32, 127), rng.randrange(0x3000)))) for _ in range(5)
    )


def any_word(rng: Random) -> str:
    """A value as a scene has it."""
    if rng.random() < 0.1:
        return f"[{any_word(rng)}, {any_word(rng)}]"
    return rng.choice(WORDS)


def any_value(rng: Random) -> Any:
    """A value as a call has it."""
    chance = rng.random()
    if chance < 0.08:
        return [any_value(rng) for _ in range(rng.randrange(1, 4))]
    if chance < 0.12:
        return {rng.choice(("from", "j2", "name", "gm", "x")): any_value(rng)}
    return rng.choice(VALUES)


# --- scenes and commands -------------------------------------------------------------------------


def _keys(question: type[Question]) -> list[str]:
    keys = [f"{question.table}.{n}" if one.setting else n for n, one in keys_of(question).items()]
    if "body" in keys:
        numbers = ("j2", "name", "pole", "gm", "spin_period", "from", "moments", "x")
        keys += [f"body.{name}" for name in numbers]
    return keys


def scene_text(rng: Random) -> str:
    """Text of a scene: a shipped one with keys changed, or something else altogether."""
    from importlib import resources

    name = rng.choice(list(shipped_scenes()))
    file = resources.files("earthspin") / "shipped" / f"{name}.toml"
    text = file.read_text(encoding="utf-8")
    chance = rng.random()
    if chance < 0.1:  # bytes that were changed on the way
        place = rng.randrange(len(text))
        return (
            text[:place] + rng.choice(("", "\0", "=", "[", '"', _letters(rng))) + text[place + 1 :]
        )
    table = {} if chance < 0.2 else _flat(tomllib.loads(text))
    word = tomllib.loads(text)["compute"]
    table["compute"] = f'"{word}"'
    for key in rng.sample(_keys(QUESTIONS[word]), rng.choice((1, 1, 1, 2, 3))):
        table[key] = any_word(rng)
    return "\n".join(f"{key} = {value}" for key, value in table.items())


def _flat(table: dict[str, Any], above: str = "") -> dict[str, str]:
    """Values as they stand in a scene, by dotted keys."""
    found = {}
    for key, value in table.items():
        if isinstance(value, dict):
            found |= _flat(value, f"{above}{key}.")
        else:
            found[f"{above}{key}"] = tomli_w.dumps({"x": value}).removeprefix("x = ").strip()
    return found


def command(rng: Random, folder: Path) -> list[str]:
    """Words of a command that computes nothing."""
    files = [str(p) for p in sorted(folder.iterdir())]
    names = [*shipped_scenes(), "torqe", "", ".", "/", "x.toml", "x.nc", "/dev/null", *files]
    verb = rng.choice(("plan", "plan", "plan", "plan", "keys", "verify", "frob", "--version"))
    words = [verb] if rng.random() < 0.97 else []
    if verb in ("plan", "verify"):
        words.append(rng.choice(names))
    for _ in range(rng.randrange(4)):
        what = rng.choice(("set", "set", "set", "sections", "ephemeris", "other"))
        if what == "set":
            key = rng.choice(_keys(rng.choice(list(QUESTIONS.values()))))
            words += ["--set", f"{key}={rng.choice((any_word(rng), _letters(rng), ''))}"]
        elif what == "other":
            words.append(
                rng.choice(("--json", "--script", "-x", "--", "", _letters(rng), "torque"))
            )
        else:
            words += [f"--{what}", rng.choice((_letters(rng), "all", "", ",", "de421", *files))]
    return words


# --- calls ---------------------------------------------------------------------------------------


def call(rng: Random) -> tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]:
    """A public call with its arguments; most of them are wrong."""
    if rng.random() < 0.75:
        question = rng.choice(list(QUESTIONS.values()))
        function = getattr(earthspin, question.call)
        names = list(arguments_of(question))
        given = _required(question)
    else:
        name = rng.choice(list(OTHERS))
        function = OTHERS[name]
        names, given = arguments(name), dict(SOUND.get(name, {}))
    for name in rng.sample(names, min(len(names), rng.choice((1, 1, 2, 3)))):
        given[name] = any_value(rng)
    if rng.random() < 0.02:
        given[rng.choice(("nonsense", "bdy", "spam"))] = any_value(rng)
    places = tuple(any_value(rng) for _ in range(rng.choice((0,) * 20 + (1, 2))))
    if places:
        given = dict(list(given.items())[len(places) :])
    return function, places, given


def _required(question: type[Question]) -> dict[str, Any]:
    """What a sound call gives, so that one wrong argument is met by itself."""
    keys = shipped.table(question.word)
    keys |= keys.pop(question.table, {}) if question.table else {}
    if "span" in keys:
        keys["start"], keys["stop"] = keys["span"]
    return {name: value for name, value in keys.items() if name in arguments_of(question)}


_TIMES = pd.date_range("2000-01-01", periods=200)
_SERIES = ("time", np.sin(np.arange(200.0)), {"units": "mas"})
_YEARS = np.arange(-100.0, 1.0)
_ROWS = pd.DataFrame({"t": _YEARS, "k": 0.01 * np.cos(_YEARS), "h": 0.01, "q": 0.0, "p": 0.0})
_CORNERS = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]]
ORBIT = earthspin.read_orbit(_ROWS)
ANSWER = earthspin.long_term("-2 kyr", "0 kyr", "1 kyr")
#: What a sound call of them gives, where it computes little.
SOUND: dict[str, dict[str, Any]] = {
    "Body": {"name": "x", "gm": 1e14},
    "Body.from_density": {
        "density": np.ones((1, 2, 3)),
        "x": [1.0, 2.0],
        "y": [1.0, 2.0, 3.0],
        "z": [1.0, 2.0, 3.0, 4.0],
    },
    "Body.from_layers": {"layers": "prem", "spin_period": "1 d"},
    "Body.from_masses": {"masses": [1.0, 2.0, 3.0, 4.0], "positions": _CORNERS},
    "Body.from_mesh": {
        "mesh": (_CORNERS, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
        "density": 1.0,
    },
    "Orbit": {"a": "384399 km"},
    "Scene": {"compute": "precession"},
    "daily_insolation": {"result": ANSWER, "latitude": "65 deg", "longitude": "90 deg"},
    "ensemble": {"question": "precession", "members": 2},
    "orbit.to_file": {"path": "orbit.npz"},
    "read_orbit": {"path": _ROWS},
    "load_scene": {"scene": "torque"},
    "plan": {"scene": "torque"},
    "run_tree": {"scene": "torque"},
    "write_series": {"scene": "torque"},
    "write": {"result": xr.Dataset({"x": 3.0}), "path": "x.nc"},
    "fit_chandler": {"ds": xr.Dataset({"x": _SERIES, "y": _SERIES}, {"time": _TIMES})},
    "excitation": {"ds": xr.Dataset({"x": _SERIES, "y": _SERIES}, {"time": _TIMES})},
    "polar_motion_from": {
        "chi": xr.Dataset({"chi1": _SERIES, "chi2": _SERIES}, {"time": _TIMES}),
        "period": 433.0,
        "quality_factor": 100.0,
    },
}


def _others() -> dict[str, Callable[..., Any]]:
    """Public calls that are no questions, and public methods of what they give, by name."""
    found = {
        name: getattr(earthspin, name)
        for name in earthspin.__all__
        if name not in {question.call for question in QUESTIONS.values()}
    }
    for owner, holder, prefix in (
        ("Body", earthspin.Body, "from_"),
        ("EARTH", earthspin.EARTH, "replace"),
        ("orbit", ORBIT, "to_file"),
        ("answer.earthspin", ANSWER.earthspin, ""),
    ):
        public = [n for n in dir(holder) if n.startswith(prefix) and not n.startswith("_")]
        # figures need answers, which calls that are only planned do not give
        public = [name for name in public if name != "plot"]
        found |= {f"{owner}.{name}": getattr(holder, name) for name in public}
    return {
        name: call
        for name, call in found.items()
        if callable(call) and not (isinstance(call, type) and issubclass(call, BaseException))
    }


def arguments(name: str) -> list[str]:
    """Arguments of a public call that is no question; free ones are the fields of a body."""
    parameters = inspect.signature(OTHERS[name]).parameters.values()
    names = [
        one.name for one in parameters if one.kind not in (one.VAR_KEYWORD, one.VAR_POSITIONAL)
    ]
    free = any(one.kind == one.VAR_KEYWORD for one in parameters)
    return names + [*earthspin.Body.KINDS, "mass", "moments", "span", "step"] * free


#: Public calls that are no questions.
OTHERS = _others()


# --- numbers -------------------------------------------------------------------------------------


def extreme_number(rng: Random) -> float:
    """A number of any size: zero, an end of what floats hold, or anything between."""
    ends = (0.0, -0.0, 1.0, -1.0, 5e-324, 2.2e-308, 1e-160, 1e160, 1.7e308, 1e-16, 1 + 2.3e-16, 3.2)
    size = rng.choice((rng.choice(ends), 10 ** rng.uniform(-20, 20), 10 ** rng.uniform(-300, 300)))
    return -size if rng.random() < 0.2 else size
