"""Choose the cheapest settings of a method whose measured error is small enough."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Generic, TypeVar

#: File of the measured errors.
DATA = Path(__file__).with_name("error_models.json")

S = TypeVar("S")


@dataclass(frozen=True)
class Choice(Generic[S]):
    """One possible combination of settings of a method, with its error and cost.

    Attributes
    ----------
    words : str
        Description of the settings.
    settings : S
        Settings for the function that computes; each method has its own type.
    error : float
        Bound on the error of the method, in rad or relative.
    evaluations : int
        Number of evaluations of positions, or of terms of the nutation.
    """

    words: str
    settings: S
    error: float
    evaluations: int


@lru_cache
def models() -> dict[str, Any]:
    """Read the table of measured errors, for all settings of all methods, from its data file."""
    table: dict[str, Any] = json.loads(DATA.read_text(encoding="utf-8"))
    return table


def cheapest(choices: Iterable[Choice[S]], allowed: float) -> Choice[S] | None:
    """Choose the cheapest settings with an error of at most `allowed`; None if there are none."""
    valid = [choice for choice in choices if choice.error <= allowed]
    return min(valid, key=lambda choice: (choice.evaluations, choice.error), default=None)
