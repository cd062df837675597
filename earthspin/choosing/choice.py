"""A choice of settings: one typed shape for all that can be chosen."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Generic, TypeVar

#: What was measured.
DATA = Path(__file__).with_name("error_models.json")

S = TypeVar("S")


@dataclass(frozen=True)
class Choice(Generic[S]):
    """Settings that meet what was asked, and what they cost.

    Attributes
    ----------
    words : str
        For people.
    settings : S
        For the function that computes; each method has its own type.
    error : float
        Bound on the error of the method, SI: rad, or relative.
    evaluations : int
        How often the sky (or a term of the nutation) will be evaluated.
    """

    words: str
    settings: S
    error: float
    evaluations: int


@lru_cache
def models() -> dict[str, Any]:
    """Read what was measured."""
    table: dict[str, Any] = json.loads(DATA.read_text(encoding="utf-8"))
    return table


def cheapest(choices: Iterable[Choice[S]], allowed: float) -> Choice[S] | None:
    """Choose the cheapest within the error allowed; of equally cheap ones the most accurate."""
    good = [choice for choice in choices if choice.error <= allowed]
    return min(good, key=lambda choice: (choice.evaluations, choice.error), default=None)
