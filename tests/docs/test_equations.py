"""The equation map is true: each function can be imported, each test is there."""

import ast
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MAP = tomllib.loads((ROOT / "docs" / "equations.toml").read_text(encoding="utf-8"))["equation"]


@pytest.mark.parametrize("entry", MAP, ids=[e["number"] for e in MAP])
def test_entry(entry: dict[str, str]) -> None:
    assert entry["what"]
    if "why_not" in entry:
        assert "function" not in entry
        return
    module, name = entry["function"].rsplit(".", 1)
    assert callable(getattr(import_module(module), name))
    file, test = entry["test"].split("::")
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    assert test in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def test_numbers_stand_once() -> None:
    numbers = [entry["number"] for entry in MAP]
    assert len(set(numbers)) == len(numbers)
