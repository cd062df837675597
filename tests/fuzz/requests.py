"""Cheap requests that are carried out: sound ones with some of their numbers changed.

They follow from the keys of the questions and from the parser of the command line, so that a new
key, question, command or option is tried without being listed here.
"""

import argparse
import contextlib
import functools
import random
import re
import tomllib
from pathlib import Path
from typing import Any

import tomli_w

import earthspin
from earthspin.cli import _parser
from earthspin.dates import YearSpan
from earthspin.engine.question import Key, keys_of
from earthspin.scenes import QUESTIONS, load_scene, shipped_scenes
from tests.fuzz.inputs import WORDS, any_word, extreme_number

Random = random.Random

#: Questions that take seconds each: one request in ten of them is carried out.
SLOW = ("nutation", "iau")

#: Spans with their steps, for calendar dates and for millennia.
SHORT = (["2000-01-01", "2000-01-02"], "6 h"), (["2000-01-01", "2000-02-10"], "5 d")
LONG = (["-3 kyr", "0 kyr"], "1 kyr"), (["-50 kyr", "-1 kyr"], "7 kyr")

#: Words that ask for much, which is no defect.
LARGE = {"4000000", "1e18", '"/dev/zero"'}

_NUMBER = re.compile(r"([-+\d.eE]+)( .*)?")


@functools.cache
def _scenes(word: str) -> list[str]:
    """Names of the shipped scenes that ask a question."""
    return [name for name in shipped_scenes() if load_scene(name).word == word]


def sound(rng: Random, word: str) -> dict[str, Any]:
    """Scene of a question that costs little: every key with every number, or only those given."""
    changes: dict[str, Any] = {}
    keys = keys_of(QUESTIONS[word])
    if "span" in keys and "step" in keys:
        spans = LONG if keys["span"].kind is YearSpan else SHORT
        changes["span"], changes["step"] = rng.choice(spans)
    if "points" in keys:
        changes[f"{QUESTIONS[word].table}.points"] = rng.choice((2, 5, 50))
    name = rng.choice(_scenes(word))
    if "ensemble" in name:
        changes["members.n"] = rng.choice((1, 2, 5))
    return load_scene(name, changes).to_table(given=rng.random() < 0.5)


def request(
    rng: Random, words: tuple[str, ...] = tuple(QUESTIONS), odd: float = 0.2
) -> dict[str, Any]:
    """A sound scene with some of its keys changed, a share of them to what is malformed."""
    word = rng.choice(words)
    if word in SLOW and rng.random() < 0.9:
        word = rng.choice([other for other in words if other not in SLOW])
    scene = sound(rng, word)
    question = QUESTIONS[word]
    for key in rng.sample([*keys_of(question).values()], rng.choice((1, 1, 1, 2, 3))):
        table = scene.setdefault(question.table, {}) if key.setting else scene
        if key.name in table and rng.random() < 0.9:
            table[key.name] = changed(rng, table[key.name], odd)
        elif (value := fresh(rng, key, odd)) is not None:
            table[key.name] = value
    if rng.random() < odd / 2:
        scene["members"] = _members(rng, scene)
    return scene


def _members(rng: Random, scene: dict[str, Any]) -> dict[str, Any]:
    """A few members that differ in one or two numbers or words of a scene."""
    names: dict[str, Any] = {}
    for _ in range(rng.choice((1, 1, 2))):
        path, value = "", scene
        while isinstance(value, dict) and value:
            key = rng.choice(list(value))
            path, value = f"{path}.{key}".removeprefix("."), value[key]
        shape = rng.choice(("normal", "uniform", "choice", "grid"))
        names[path] = {shape: [value, changed(rng, value, 0.1)]}
    return {"n": rng.choice((1, 2, 5))} | names


def changed(rng: Random, value: Any, odd: float) -> Any:
    """A value with one of its numbers or words changed, the rest as it was."""
    if rng.random() < odd / 4:
        return malformed(rng)
    if isinstance(value, dict) and value:
        key = rng.choice(list(value))
        return value | {key: changed(rng, value[key], odd)}
    if isinstance(value, list) and value:
        place = rng.randrange(len(value))
        return [*value[:place], changed(rng, value[place], odd), *value[place + 1 :]]
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return rng.choice((-1, 0, 1, 2, 3, 100))
    if isinstance(value, float):
        return _other(rng, value)
    number = _NUMBER.fullmatch(value) if isinstance(value, str) else None
    if number:
        with contextlib.suppress(ValueError):  # a date
            return f"{_other(rng, float(number[1]))!r}{number[2] or ''}"
    return malformed(rng) if rng.random() < odd else value


def _other(rng: Random, number: float) -> float:
    """Another number: near, a few times as large, or of any size."""
    factor = rng.choice((1 + 1e-12, 1.001, 10 ** rng.uniform(-3, 1), -1.0))
    return rng.choice((number * factor, number * factor, extreme_number(rng)))


def fresh(rng: Random, key: Key, odd: float) -> Any:
    """A value for a key that a scene leaves out, by its kind; None if a sound one is not known."""
    kind = key.kind
    several = getattr(kind, "of", None)
    if several is not None:
        value = fresh(rng, Key(key.name, several, "", None, key.setting), odd)
        return None if value is None else [value] * rng.choice((1, 2))
    if rng.random() < odd:
        return malformed(rng)
    if hasattr(kind, "allowed"):
        return rng.choice(list(kind.allowed))
    if hasattr(kind, "example"):
        sizes = [rng.choice((1, 2, 3)) if n is None else n for n in getattr(kind, "shape", ())]
        return _filled(rng, kind, sizes)
    return None


def _filled(rng: Random, kind: Any, sizes: list[int]) -> Any:
    """A number of a kind, or lists of lists of them."""
    if sizes:
        return [_filled(rng, kind, sizes[1:]) for _ in range(sizes[0])]
    first = _NUMBER.fullmatch(kind.example)
    number = _other(rng, float(first[1]) if first else 1.0)
    return f"{number!r} {kind.unit}" if kind.unit else number


def malformed(rng: Random) -> Any:
    """A value that a file of TOML can hold, sound or not."""
    while (word := any_word(rng)) in LARGE:
        pass
    try:
        return tomllib.loads(f"x = {word}")["x"]
    except (ValueError, RecursionError):
        return "x"


# --- commands ------------------------------------------------------------------------------------


def written(scene: dict[str, Any], folder: Path) -> str:
    """Write a request to a scene file, and give its path; that of no scene if TOML has none."""
    path = folder / "request.toml"
    try:
        path.write_text(tomli_w.dumps(scene), encoding="utf-8", errors="surrogatepass")
    except (TypeError, ValueError, RecursionError):
        return "no.toml"
    return str(path)


def command(rng: Random, folder: Path) -> list[str]:
    """Words of any command with options that it has, over requests that cost little."""
    (commands,) = (a for a in _parser()._actions if isinstance(a, argparse._SubParsersAction))
    name = rng.choice([*commands.choices, *["run", "ensemble"] * 10])
    scene = request(rng)
    words = [name]
    for action in commands.choices[name]._actions:
        optional = bool(action.option_strings)
        needed = action.required or action.dest in LIMITS.get(name, ())
        if action.dest in ("help", "traceback") or not (needed or rng.random() < 0.3):
            continue
        if optional:
            words.append(action.option_strings[-1])
        if action.nargs != 0:
            words.append(_argument(rng, action, scene, folder))
    return words


#: Options that keep a command cheap, always given.
LIMITS = {
    "ensemble": ("members",),
    "report": ("no_figures",),
}  # fmt: skip


def _argument(rng: Random, action: Any, scene: dict[str, Any], folder: Path) -> str:
    """A value of an option, most often of the sort that it takes."""
    if rng.random() < 0.1:
        return rng.choice((*WORDS[:20], "", "-1", "nonsense", "\x1b[2J", str(folder)))
    if action.choices:
        return str(rng.choice(list(action.choices)))
    files = [str(path) for path in sorted(folder.iterdir())]
    sections = QUESTIONS[scene["compute"]].graph.sections
    values: dict[str, list[str]] = {
        "scene": [written(scene, folder)] if rng.random() < 0.9 else files or ["x.nc"],
        "out": ["x.nc", "y.zarr", "new.zarr", "y.zarr"] + ["page"] * (rng.random() < 0.2),
        "sections": ["all", *sections],
        "members": ["1", "2", "3"],
        "seed": ["0", "1", "99999999999999999999"],
        "block": ["1", "2", "0"],
        "ephemeris": ["de421", "de440", "x.bsp"],
        "file": files or ["x.nc"],
        "question": list(QUESTIONS),
        "name": list(earthspin.BODIES),
        "settings": [_setting(rng, scene)],
    }
    return rng.choice(values.get(action.dest, ["nonsense", "", "0"]))


def _setting(rng: Random, scene: dict[str, Any]) -> str:
    """A change of one key, as ``--set`` takes it."""
    question = QUESTIONS[scene["compute"]]
    key = rng.choice([*keys_of(question).values()])
    name = f"{question.table}.{key.name}" if key.setting else key.name
    try:
        return tomli_w.dumps({"x": fresh(rng, key, 0.3)}).replace("x = ", f"{name}=", 1).strip()
    except (TypeError, ValueError, RecursionError):
        return f"{name}="
