"""Shipped scenes: one of each question, its table, and answers that no test may change."""

import tomllib
from functools import cache
from importlib import resources
from typing import Any

import xarray as xr

import earthspin
from earthspin.scenes import load_scene, shipped_scenes

#: The first shipped scene of each question that asks about one body.
SCENES = {scene.word: name for name in reversed(shipped_scenes())
          if not (scene := load_scene(name)).members}  # fmt: skip


def table(word: str) -> dict[str, Any]:
    """Keys of the shipped scene of a question, as its file has them."""
    file = resources.files("earthspin") / "shipped" / f"{SCENES[word]}.toml"
    keys = tomllib.loads(file.read_text(encoding="utf-8"))
    return {key: value for key, value in keys.items() if key not in ("compute", "title")}


@cache
def tree(scene: str) -> xr.DataTree:
    """The answer to a shipped scene with all its sections, made once in a process."""
    return earthspin.run_tree(scene)


@cache
def answer(scene: str) -> xr.Dataset:
    """The answer alone, as a call of its own gives it."""
    return earthspin.run(scene)
