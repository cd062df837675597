"""Every public call has an example in its docstring, and it prints what it says.

The examples run where nothing stands; what they write is gone with the folder.
"""

import doctest
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import earthspin
from earthspin._lazy import METHODS, registered
from earthspin.bodies import Body
from earthspin.bodies.orbit import Satellite
from earthspin.engine.accessor import Answer


def public() -> Iterator[tuple[str, Any]]:
    """Whatever can be called by a public name."""
    for name in earthspin.__all__:
        if callable(value := getattr(earthspin, name)):
            yield name, value
    yield "Body.replace", Body.replace
    yield "Body.satellites", Satellite
    yield "Answer", Answer
    for name, value in vars(Answer).items():
        if callable(value) and not name.startswith("_"):
            yield f"Answer.{name}", value
    for name in METHODS:
        yield name, registered(name)


PUBLIC = dict(public())


def run(name: str, text: str) -> tuple[doctest.DocTest, str]:
    """An example, and what is wrong with it; nothing, if it prints what it says."""
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, None)
    told: list[str] = []
    doctest.DocTestRunner().run(test, out=told.append)
    return test, "".join(told)


@pytest.mark.slow
@pytest.mark.parametrize("name", PUBLIC)
def test_it_has_an_example_that_prints_what_it_says(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = inspect.getdoc(PUBLIC[name]) or ""
    test, wrong = run(name, text)
    assert len(test.examples) >= 2, "no example"
    assert wrong == ""
    assert "+SKIP" not in text
    last = name.split(".")[-1]
    shown = "".join(example.source for example in test.examples)
    assert re.search(rf"\b{last.lower()}\b", shown.lower()) or last in ("Answer", "VersionWarning")
    seen = any(example.want for example in test.examples) or list(tmp_path.iterdir())
    assert seen, "an example prints or writes something"
