"""The progress bar: on a terminal, after two seconds, one at a time."""

import io
import sys
import time
from collections.abc import Callable
from typing import Any

import pytest

import earthspin
from earthspin import progress as module
from earthspin.frames import EquatorOfDate
from earthspin.progress import progress


class Screen(io.StringIO):
    def isatty(self) -> bool:
        return True


def watched(monkeypatch: pytest.MonkeyPatch) -> Screen:
    """A terminal in the place of stderr; to be called in the test, after pytest has set its own."""
    there = Screen()
    monkeypatch.setattr(sys, "stderr", there)
    monkeypatch.setattr(module, "PATIENCE", 0.1)
    monkeypatch.setenv("TERM", "xterm")
    return there


def appears(screen: Screen, words: str, after: str = "") -> bool:
    """Whether words are shown within ten seconds: a busy machine imports slowly."""
    end = time.monotonic() + 10
    while words not in screen.getvalue().removeprefix(after) and time.monotonic() < end:
        time.sleep(0.05)
    return words in screen.getvalue().removeprefix(after)


def test_a_first_step_that_lasts_shows_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = watched(monkeypatch)
    with progress("long work", 2) as advance:
        assert appears(screen, "long work")
        advance(1)


def test_quick_work_shows_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = watched(monkeypatch)
    with progress("quick work", 1) as advance:
        advance(1)
    assert "quick work" not in screen.getvalue()


@pytest.mark.parametrize(("total", "inner"), [(1, 1), (1, None), (None, None)])
def test_work_within_work_shows_one_bar(
    monkeypatch: pytest.MonkeyPatch, total: int | None, inner: int | None
) -> None:
    screen = watched(monkeypatch)
    with progress("outer", total), progress("inner", inner) as advance:
        assert appears(screen, "outer")
        time.sleep(0.2)  # in which another bar would appear
        advance(1)
    assert "inner" not in screen.getvalue()


def test_work_of_known_amount_hides_that_of_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = watched(monkeypatch)
    with progress("endless"):
        assert appears(screen, "endless")
        with progress("counted", 1):
            assert appears(screen, "counted")
            before = screen.getvalue()
            time.sleep(0.3)
            assert "endless" not in screen.getvalue().removeprefix(before)
        assert appears(screen, "endless", after=screen.getvalue())


def test_short_steps_of_long_work_are_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = watched(monkeypatch)
    monkeypatch.setattr(module, "PATIENCE", 1.5)
    with progress("whole"):
        assert appears(screen, "whole")
        begun = time.monotonic()
        with progress("step", 1):
            assert appears(screen, "step")
        assert time.monotonic() - begun < 1.2


PAST = earthspin.long_term("-2 kyr", "0 kyr", "1 kyr")
CALLS: dict[str, Callable[[], Any]] = {
    "answer": lambda: earthspin.run("precession"),
    "answer with sections": lambda: earthspin.run_tree("precession", "seasons"),
    "figures": lambda: PAST.earthspin.plot(),
    "insolation": lambda: earthspin.daily_insolation(PAST, "65 deg", "90 deg"),
    "stars near the pole": lambda: earthspin.pole_stars(PAST),
    "axes of the frame": lambda: EquatorOfDate(model=PAST, obstime="2010-01-01").error,
}


@pytest.mark.parametrize("label", CALLS)
def test_each_long_work_is_shown(monkeypatch: pytest.MonkeyPatch, label: str) -> None:
    screen = watched(monkeypatch)
    monkeypatch.setattr(module, "PATIENCE", 0.0)
    CALLS[label]()
    assert label in screen.getvalue()


def test_nothing_is_shown_where_nobody_watches(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = watched(monkeypatch)
    monkeypatch.setattr(screen, "isatty", lambda: False)
    with progress("unwatched", 1):
        time.sleep(0.3)
    assert screen.getvalue() == ""
