"""Malformed inputs from fixed seeds: each ends in an answer or in one clear line.

More of them: ``make fuzz``, or ``python -m tests.fuzz SEED COUNT``.
"""

from __future__ import annotations

import random

import pytest

from earthspin import SceneError
from tests.fuzz import inputs
from tests.fuzz.judge import escapes, tried

#: How many of each kind; most are only planned. 20 s together.
COUNTS = {"scenes": 900, "commands": 700, "calls": 900, "answers": 200}


@pytest.mark.parametrize("kind", COUNTS)
def test_nothing_escapes(kind: str) -> None:
    assert tried(kind, seed=0, count=COUNTS[kind]) == {}


def test_two_thousand_are_tried() -> None:
    assert sum(COUNTS.values()) >= 2000


def test_what_escapes_is_seen() -> None:
    """Of each sort: the wrong kind of exception, two lines, an escape, no name of an argument."""

    def raising(error: BaseException) -> str:
        def what() -> None:
            raise error

        return escapes(what, names=("step",))

    assert raising(SceneError("step", "0 h", "too short")) == ""
    assert raising(TypeError("step is of type set")) == ""
    assert raising(TypeError("'int' object is not iterable")).startswith("TypeError")
    assert raising(KeyError("x")).startswith("KeyError")
    assert raising(RuntimeWarning("overflow")).startswith("RuntimeWarning")
    two = SceneError("step", "0 h", "too short")
    for line in ("a\nb", "\x1b[2J", "x" * 2000, ""):
        two.args = (line,)
        assert raising(two).startswith("a message that is not one plain line")


def test_inputs_are_the_same_from_run_to_run() -> None:
    for make in (inputs.scene_text, inputs.extreme):
        assert make(random.Random("x")) == make(random.Random("x"))


def test_most_inputs_are_wrong_and_some_are_sound() -> None:
    """A generator that only ever made sound scenes, or none, would test nothing."""
    import tomllib

    from earthspin import EarthspinError, Scene

    sound = 0
    for number in range(300):
        try:
            table = tomllib.loads(inputs.scene_text(random.Random(number)))
            Scene(**table)
            sound += 1
        except (EarthspinError, ValueError, TypeError, RecursionError):
            continue
    assert 5 <= sound <= 150
