"""What may come of an input: an answer, or one clear line; nothing else."""

from __future__ import annotations

import contextlib
import io
import os
import random
import tempfile
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import earthspin
from earthspin import EarthspinError, UndefinedError
from earthspin.cli import main
from earthspin.engine import answering, asking, run
from tests.fuzz import inputs

#: Longest message: `LONGEST_MESSAGE` and what a command puts around it.
LONGEST = 1100


@contextlib.contextmanager
def only_planned() -> Iterator[None]:
    """Read and plan whatever is asked, and compute nothing; work in a folder of its own."""
    planned = mock.Mock(side_effect=lambda question, *_: run.plan(question))
    before = Path.cwd()
    with (
        tempfile.TemporaryDirectory() as folder,
        mock.patch.object(asking, "run", planned),
        mock.patch.object(answering, "run", planned),
        mock.patch.object(answering, "run_tree", planned),
        mock.patch("earthspin.checks.gauntlet.judge", side_effect=UndefinedError("not tried")),
        mock.patch("earthspin.scenes._say_what_differs"),
        mock.patch.object(run.Again, "__init__", side_effect=UndefinedError("not tried")),
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("error")
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir(before)


def escapes(what: Callable[[], Any], names: tuple[str, ...] = ()) -> str:
    """What comes out that should not; empty if it ends as it should.

    Parameters
    ----------
    what : callable
    names : tuple of str
        Arguments, one of which a TypeError must name; with none, a TypeError is an escape.
    """
    try:
        what()
    except EarthspinError as error:
        line = str(error)
        sound = line.isprintable() and 0 < len(line) <= LONGEST
        return "" if sound else f"a message that is not one plain line: {line[:200]!r}"
    except TypeError as error:
        line = str(error)
        named = any(name in line for name in names) and "\n" not in line
        return "" if named else f"TypeError: {line[:200]}"
    except BaseException as error:
        return f"{type(error).__name__}: {str(error)[:200]}"
    return ""


def scene(rng: random.Random) -> tuple[str, str]:
    """Read and plan a scene of a file: what it was, and what escaped."""
    text = inputs.scene_text(rng)
    path = Path("scene.toml")
    path.write_text(text, encoding="utf-8", errors="surrogatepass")

    def plan() -> None:
        str(earthspin.plan(path))

    return text[-300:], escapes(plan)


def command(rng: random.Random) -> tuple[str, str]:
    """Give a command: what it was, and what escaped."""
    words = inputs.command(rng, Path("."))
    out, err = io.StringIO(), io.StringIO()

    def give() -> None:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                status = main(words)
            except SystemExit as end:
                status = int(end.code or 0)
        said = err.getvalue().removesuffix("\n")
        if status not in (0, 2):
            raise AssertionError(f"status {status}: {said}")
        if status == 2 and not (said.isprintable() and 0 < len(said) <= LONGEST):
            raise AssertionError(f"not one line: {said!r}")
        if status == 2 and out.getvalue():
            raise AssertionError(f"printed before it failed: {out.getvalue()!r}")

    return str(words)[:300], escapes(give)


def call(rng: random.Random) -> tuple[str, str]:
    """Make a call: what it was, and what escaped."""
    function, places, given = inputs.call(rng)
    names = (*given, *inputs.OTHERS.get(function.__name__, ()), "argument", function.__name__)

    def make() -> None:
        function(*places, **given)

    try:
        shown = f"{function.__name__}(*{places!r}, **{given!r})"[:300]
    except Exception:
        shown = f"{function.__name__}({', '.join(given)}) of what has no words"
    return shown, escapes(make, names)


def answer(rng: random.Random) -> tuple[str, str]:
    """Ask for an answer that costs little, with numbers of every size: what escaped."""
    question, given = inputs.extreme(rng)
    with mock.patch.object(asking, "run", COMPUTE):
        escaped = escapes(lambda: getattr(earthspin, question)(**given))
    return f"{question}(**{given})", escaped


COMPUTE = run.run
KINDS = {"scenes": scene, "commands": command, "calls": call, "answers": answer}


def tried(kind: str, seed: int, count: int) -> dict[str, str]:
    """Try many inputs of a kind; what escaped, by input."""
    found = {}
    with only_planned():
        for number in range(count):
            shown, escaped = KINDS[kind](random.Random(f"{kind} {seed} {number}"))
            if escaped:
                found[f"{number}: {shown}"] = escaped
    return found
