"""The equation map is true and whole: each function can be imported, each test is there."""

import ast
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MAP = tomllib.loads((ROOT / "docs" / "equations.toml").read_text(encoding="utf-8"))["equation"]

#: Highest number of each section of the source; equations and figures count through together.
LAST = {"I.1": 9, "I.2": 7, "I.3": 1, "I.4": 4, "I.5": 9, "I.6": 32, "I.7": 20, "I.8": 7, "I.9": 52}


@pytest.mark.parametrize("entry", MAP, ids=[e["number"] for e in MAP])
def test_entry(entry: dict[str, str]) -> None:
    assert entry["what"]
    if "why_not" in entry:
        assert entry["why_not"]
        assert not {"function", "test"} & set(entry)
        return
    module, name = entry["function"].rsplit(".", 1)
    assert callable(getattr(import_module(module), name))
    file, test = entry["test"].split("::")
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    assert test in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def test_numbers_stand_once() -> None:
    numbers = [entry["number"] for entry in MAP]
    assert len(set(numbers)) == len(numbers)


def test_the_map_is_whole() -> None:
    """Every number of the source is there, beside its exercises and what has a letter or a word."""
    plain = {f"{section}.{k}" for section, last in LAST.items() for k in range(1, last + 1)}
    assert plain <= {entry["number"] for entry in MAP}
