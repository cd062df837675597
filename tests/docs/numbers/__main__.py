"""Measure again the values that pages print but do not compute: ``python -m tests.docs.numbers``.

``python -m tests.docs.numbers [PAGE ...]`` writes docs/measured/values.json; without names, for all
pages. A page computes what takes a second or two when it is built, and reads the rest from there.
"""

from __future__ import annotations

import json
import sys
from importlib import import_module

from tests.docs.numbers import PAGES, STORED


def main(pages: list[str]) -> None:
    """Write the values of some pages and leave those of the others."""
    values = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    for page in pages or PAGES:
        measurements = getattr(import_module(f"tests.docs.numbers.{page}"), "VALUES", {})
        if measurements:
            values[page] = {name: measure() for name, measure in measurements.items()}
    STORED.write_text(json.dumps(values, indent=1, sort_keys=True) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
