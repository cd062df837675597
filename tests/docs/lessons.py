"""Run pages of lessons, and hold what they print of one thing in two ways."""

from __future__ import annotations

import importlib.util
import json
import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType

import pytest

DOCS = Path(__file__).parents[2] / "docs"
RUNNER = DOCS / "_ext" / "lessons.py"
NUMBER = r"([-+]?\d[\d,.]*(?:e[-+]?\d+)?)"


def built(path: Path, monkeypatch: pytest.MonkeyPatch | None = None) -> ModuleType:
    """Import a module of the documentation; a patch makes its name known while it lasts."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    if monkeypatch is not None:
        monkeypatch.setitem(sys.modules, path.stem, module)
    spec.loader.exec_module(module)
    return module


def results_of(pages: Iterable[Path]) -> dict[str, dict[str, str]]:
    """What came of each page, in a process of its own: what else is tested needs no pyplot."""
    out = subprocess.run(
        [sys.executable, "-X", "utf8", str(RUNNER), *map(str, pages)],
        capture_output=True,
        encoding="utf-8",
    )
    assert out.returncode == 0, out.stderr
    found = [json.loads(line) for line in out.stdout.splitlines()]
    return {line["lesson"]: line for line in found}


def hold(printed: str, words: str, nearness: float) -> None:
    """Two numbers of one thing agree, or the one that is printed is as small as that."""
    found = re.findall(words, printed)
    assert found, f"{words} in\n{printed}"
    for numbers in found:
        if isinstance(numbers, str):
            assert abs(read(numbers)) <= nearness, words
        else:
            one, other = map(read, numbers)
            assert one == pytest.approx(other, rel=nearness, abs=0), words


def read(number: str) -> float:
    """A number as it is printed."""
    return float(number.rstrip(",.").replace(",", ""))
