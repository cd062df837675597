"""What may come of an input: an answer, or one clear line; nothing else."""

import contextlib
import gc
import inspect
import io
import logging
import os
import random
import signal
import sys
import tempfile
import traceback
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

import earthspin
from earthspin import EarthspinError, UndefinedError, process
from earthspin.cli import main
from earthspin.engine import public_calls, run
from earthspin.views.rendering import scene_page, tables_for
from tests.fuzz import borders, inputs, requests, tables
from tests.processes import OLD_TABLE

#: Longest message: `LONGEST_MESSAGE` and what a command puts around it.
LONGEST = 1100

#: Processor time that a case may take, s.
MOST_SECONDS = 20.0


@contextlib.contextmanager
def elsewhere() -> Iterator[None]:
    """Work in a folder of its own, where warnings are errors and no browser opens."""
    before = Path.cwd()
    with (
        tempfile.TemporaryDirectory() as folder,
        mock.patch("webbrowser.open", return_value=False),
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", OLD_TABLE)
        os.chdir(folder)
        gc.freeze()  # what there is already needs no search after each case
        try:
            yield
        finally:
            gc.unfreeze()
            os.chdir(before)


@contextlib.contextmanager
def only_planned() -> Iterator[None]:
    """Read and plan whatever is asked, and compute nothing."""
    planned = mock.Mock(side_effect=lambda question, *_: run.Run(question).plan())

    def plan_sections(question: Any, *_: object) -> None:
        run.Run(question).plan()
        raise UndefinedError("not tried")

    with (
        elsewhere(),
        mock.patch.object(public_calls, "answer", planned),
        mock.patch.object(public_calls, "answer_tree", plan_sections),
        mock.patch("earthspin.scenes.warn_of_versions"),
        mock.patch.object(run.Run, "__getitem__", side_effect=UndefinedError("not tried")),
    ):
        yield


class TooSlowError(BaseException):
    """A case takes longer than any of them should; no `except Exception` hides it."""


@contextlib.contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise an error after so many seconds of processor time, which other processes do not use."""

    def end(number: int, frame: object) -> None:
        raise TooSlowError(f"more than {seconds} s")

    before = signal.signal(signal.SIGPROF, end)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@contextlib.contextmanager
def heard_from(logger: str) -> Iterator[io.StringIO]:
    """Collect what a logger says."""
    said = io.StringIO()
    handler = logging.StreamHandler(said)
    logging.getLogger(logger).addHandler(handler)
    try:
        yield said
    finally:
        logging.getLogger(logger).removeHandler(handler)


def escapes(what: Callable[[], Any], names: tuple[str, ...] = ()) -> str:
    """What comes out that should not; empty if it ends as it should.

    Parameters
    ----------
    what : callable
    names : tuple of str
        Arguments, one of which a TypeError must name; with none, a TypeError is an escape.
    """
    with heard_from("asyncio") as said:
        ended = _escapes(what, names)
        if "zarr" in sys.modules:  # it starts tasks
            gc.collect()  # a task is reported when it is deleted
    return ended or (said.getvalue() and f"asyncio says: {said.getvalue()[:200]}")


def _escapes(what: Callable[[], Any], names: tuple[str, ...]) -> str:
    try:
        with limited(MOST_SECONDS):
            what()
    except EarthspinError as error:
        line = str(error)
        sound = line.isprintable() and 0 < len(line) <= LONGEST
        return "" if sound else f"a message that is not one plain line: {line[:200]!r}"
    except TypeError as error:
        line = str(error)
        named = any(name in line for name in names) and "\n" not in line
        return "" if named else f"TypeError: {line[:200]} ({_place(error)})"
    except BaseException as error:
        return f"{type(error).__name__}: {str(error)[:200]} ({_place(error)})"
    return ""


def _place(error: BaseException) -> str:
    """Module of earthspin in which an exception arose, and the line."""
    package = str(Path(earthspin.__file__).parent)
    frames = [
        f for f in traceback.extract_tb(error.__traceback__) if f.filename.startswith(package)
    ]
    return (
        f"{frames[-1].filename.removeprefix(package + '/')}, {frames[-1].lineno}" if frames else ""
    )


def scene(rng: random.Random) -> tuple[str, str]:
    """Read and plan a scene of a file: what it was, and what escaped."""
    text = inputs.scene_text(rng)
    path = Path("scene.toml")
    path.write_text(text, encoding="utf-8", errors="surrogatepass")

    def plan() -> None:
        str(earthspin.plan(path))

    return text[-300:], escapes(plan)


def command(rng: random.Random) -> tuple[str, str]:
    """Give a command that computes nothing: what it was, and what escaped."""
    return _given(inputs.command(rng, Path(".")))


def executed(rng: random.Random) -> tuple[str, str]:
    """Give a command over a request that is carried out: what it was, and what escaped."""
    words = requests.command(rng, Path("."))
    shown, escaped = _given(words)
    scene = Path("request.toml")
    text = f" of {scene.read_text()[:1500]!r}" if scene.exists() and escaped else ""
    return shown + text, escaped


def _given(words: list[str]) -> tuple[str, str]:
    """A command as it was given, and what escaped."""
    out, err = io.StringIO(), io.StringIO()

    def give() -> None:
        with (
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(err),
            mock.patch.object(process, "_outcome", side_effect=process._outcome) as judged,
        ):
            try:
                status = main(words)
            except SystemExit as end:
                status = int(end.code or 0)
        said = err.getvalue().removesuffix("\n")
        if status == process.DEFECT:
            raise judged.call_args.args[0]
        if status not in (0, 2):
            raise AssertionError(f"status {status}: {said}")
        if status == 2 and not (said.isprintable() and 0 < len(said) <= LONGEST):
            raise AssertionError(f"not one line: {said!r}")
        if status == 2 and out.getvalue() and "--json" not in words:
            raise AssertionError(f"printed before it failed: {out.getvalue()!r}")

    return str(words)[:300], escapes(give)


def call(rng: random.Random) -> tuple[str, str]:
    """Make a call: what it was, and what escaped."""
    function, places, given = inputs.call(rng)
    names = (*given, *inspect.signature(function).parameters, "argument", function.__name__)

    def make() -> None:
        function(*places, **given)

    try:
        shown = f"{function.__name__}(*{places!r}, **{given!r})"[:300]
    except Exception:
        shown = f"{function.__name__}({', '.join(given)}) of what has no words"
    return shown, escapes(make, names)


def answer(rng: random.Random) -> tuple[str, str]:
    """Ask for an answer with its sections and tables: what escaped, or is not finite."""
    scene, all_sections, drawn = requests.request(rng), rng.random() < 0.3, rng.random() < 0.05

    def ask() -> None:
        tree = earthspin.run_tree(earthspin.Scene(**scene), "all" if all_sections else ())
        tables_for(tree)
        if drawn:
            scene_page(tree)
        for name, field in tree.data_vars.items():
            sound = field.dtype.kind != "f" or np.isfinite(field).all()
            if not sound and name not in UNDEFINED:
                raise AssertionError(f"{name} is not finite")

    return str(scene), escapes(ask)


def border(rng: random.Random) -> tuple[str, str]:
    """Execute a call with an input of one of the kinds of `borders`: what it was, what escaped."""
    kinds = (borders.date, borders.odd, borders.quantity, borders.components)
    shown, ask = rng.choice(kinds)(rng)
    return shown[:300], escapes(ask)


def table(rng: random.Random) -> tuple[str, str]:
    """Read a table with a foreign header or shuffled columns: what it was, and what escaped."""
    shown, ask = rng.choice((tables.solution, tables.pole))(rng)
    return shown, escapes(ask)


#: Numbers that some sound answers do not have: of a rigid body, and of a top on the separatrix.
UNDEFINED = ("quality_factor", "nutation_period")


KINDS = {
    "scenes": scene,
    "commands": command,
    "calls": call,
    "executed": executed,
    "answers": answer,
    "borders": border,
    "tables": table,
}
#: Kinds that are carried out, with the share of the count of the others that is tried of them.
EXECUTED = {"executed": 0.05, "answers": 0.05, "borders": 0.05, "tables": 0.05}


def tried(kind: str, seed: int, count: int) -> dict[str, str]:
    """Try many inputs of a kind; what escaped, by input."""
    found = {}
    with elsewhere() if kind in EXECUTED else only_planned():
        for number in range(count):
            shown, escaped = KINDS[kind](random.Random(f"{kind} {seed} {number}"))
            if escaped:
                found[f"{number}: {shown}"] = escaped
    return found
