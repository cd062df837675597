"""Import modules of the documentation."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

DOCS = Path(__file__).parents[2] / "docs"
RUNNER = DOCS / "_ext" / "lessons.py"


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
