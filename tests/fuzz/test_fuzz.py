"""Malformed inputs from fixed seeds: each ends in an answer or in one clear line.

More of them: ``make fuzz``, or ``python -m tests.fuzz SEED COUNT``.
"""

from __future__ import annotations

import contextlib
import random
from pathlib import Path

import pytest

import earthspin
from earthspin import EarthspinError, Scene, SceneError
from earthspin.engine.question import keys_of
from earthspin.scenes import QUESTIONS
from tests.fuzz import inputs, judge, requests
from tests.fuzz.judge import escapes, only_planned, tried

#: How many of each kind; the first three are only planned. 5 s together.
COUNTS = {
    "scenes": 400,
    "commands": 300,
    "calls": 350,
    "executed": 20,
    "answers": 30,
}


@pytest.mark.parametrize("kind", COUNTS)
def test_nothing_escapes(kind: str) -> None:
    assert tried(kind, seed=0, count=COUNTS[kind]) == {}


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


WRONG = {
    "ORBIT.to_file": lambda: inputs.ORBIT.to_file([1]),
    "ensemble": lambda: earthspin.ensemble("precession", 2, path=[1]),
    "to_skycoord": lambda: inputs.ANSWER.earthspin.to_skycoord([1]),
    "rotation": lambda: earthspin.rotation(start_omega=[1e200, 0, 0]),
    "attitude": lambda: earthspin.rotation(start_attitude=[1e200, 0, 0, 0]),
    "quantiles": lambda: inputs.ANSWER.earthspin.quantiles([10**400]),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_types_and_sizes_end_in_one_line(name: str) -> None:
    with only_planned():
        assert escapes(WRONG[name], names=("path",)) == ""


def test_a_case_without_end_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judge, "MOST_SECONDS", 0.1)

    def endless() -> None:
        while True:
            pass

    assert escapes(endless).startswith("TooSlowError")


def test_every_command_and_public_call_is_tried(tmp_path: Path) -> None:
    """Their names come from the package; a generator that leaves some out would not be seen."""
    commands = {requests.command(random.Random(n), tmp_path)[0] for n in range(150)}
    assert {"report", "play", "run", "ensemble", "plan", "verify", "info"} <= commands
    assert {"Orbit", "Body.from_masses", "read_orbit", "daily_insolation"} <= set(inputs.OTHERS)


def test_every_key_is_given_values() -> None:
    for question in QUESTIONS.values():
        for key in keys_of(question).values():
            values = [requests.fresh(random.Random(n), key, odd=0.2) for n in range(20)]
            assert len(set(map(str, values))) > 1, (question.word, key.name)


def test_requests_that_are_carried_out_are_sound_in_most_cases() -> None:
    """A generator whose requests are all refused would execute nothing."""
    sound = 0
    for number in range(200):
        with contextlib.suppress(EarthspinError):
            Scene(**requests.request(random.Random(number)))
            sound += 1
    assert 80 <= sound <= 190


def test_inputs_are_the_same_from_run_to_run() -> None:
    for make in (inputs.scene_text, requests.request):
        assert make(random.Random("x")) == make(random.Random("x"))


def test_most_inputs_are_wrong_and_some_are_sound() -> None:
    """A generator that only ever made sound scenes, or none, would test nothing."""
    import tomllib

    sound = 0
    for number in range(300):
        try:
            table = tomllib.loads(inputs.scene_text(random.Random(number)))
            Scene(**table)
            sound += 1
        except (EarthspinError, ValueError, TypeError, RecursionError):
            continue
    assert 5 <= sound <= 150
