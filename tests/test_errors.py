"""Every error is one line and carries its data."""

import copy
import inspect
import pickle
from collections.abc import Callable
from pathlib import Path

import pytest

from earthspin import errors

EXAMPLES = [
    errors.SceneError("step", "0 h", "a step is greater than zero", source="x.toml"),
    errors.SceneError("a\nb", "0\nh", "two\nlines", source="c\nd.toml"),
    errors.BodyError("earth", "gm", -1.0, "a mass is zero or more"),
    errors.UnitsError("step", "6", "s", "6 h"),
    errors.KernelError("x.bsp", "the file is empty", "fetch it again"),
    errors.CoverageError("de421", ("1800-01-01", "1801-01-01"), ("1899-07-29", "2053-10-09")),
    errors.UndefinedError("it has no longitude"),
    errors.ApartError("they do not settle at once"),
    errors.ArgumentError("run() missing a required argument"),
    errors.SeriesError("pole.txt", "it ends early", "is the file cut off?", line=7),
    errors.AccuracyError(1e-9, 6e-7, "(relative)", "give a longer span"),
    errors.OutputError("/x", "it cannot be written"),
    errors.MissingExtraError("zarr", "zarr", "a result in chunks"),
]


@pytest.mark.parametrize("error", EXAMPLES, ids=lambda e: type(e).__name__)
def test_one_line_that_names_what_was_given(error: errors.EarthspinError) -> None:
    text = str(error)
    assert text
    assert "\n" not in text
    assert isinstance(error, errors.EarthspinError)


def test_no_class_is_without_an_example() -> None:
    classes = {
        c
        for c in vars(errors).values()
        if inspect.isclass(c) and issubclass(c, errors.EarthspinError)
    }
    assert classes - {type(e) for e in EXAMPLES} == {errors.EarthspinError}


def test_the_nearest_word_comes_first() -> None:
    assert errors.nearest("torqe", ["torque", "wobble"]).startswith("did you mean 'torque'?")
    fields = ["body.triaxiality", "body.j2"]
    assert errors.nearest("body.obliquity", fields).startswith("allowed")  # one table, no more
    assert errors.nearest("body.j_2", fields).startswith("did you mean 'body.j2'?")
    assert errors.nearest("xyz", ["torque", "wobble"]) == "allowed: torque, wobble"


@pytest.mark.parametrize("error", EXAMPLES, ids=lambda e: type(e).__name__)
@pytest.mark.parametrize(
    "again", [lambda e: pickle.loads(pickle.dumps(e)), copy.copy, copy.deepcopy],
    ids=["pickle", "copy", "deepcopy"],
)  # fmt: skip
def test_a_copy_has_the_message_and_the_facts(
    error: errors.EarthspinError, again: Callable[[Exception], Exception]
) -> None:
    same = again(error)
    assert type(same) is type(error)
    assert str(same) == str(error)
    assert vars(same) == vars(error)


def test_ipython_shows_the_lines_of_the_user_and_the_message(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    interactive = pytest.importorskip("IPython.core.interactiveshell")
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    shell = interactive.InteractiveShell()
    shell.run_cell("import earthspin\nearthspin.precession('mars')")
    shown = capsys.readouterr().out
    assert "line 2" in shown
    assert "precession(body='mars')" in shown
    assert "errors.py" not in shown
