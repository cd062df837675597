"""docs/ensembles.md."""

from __future__ import annotations

from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/ensembles.md"

MEASURED: list[Sentence] = []
TOLD = [
    Told(PAGE, "gains the half-width of the central {} % of a sample", "given: what is meant"),
]
