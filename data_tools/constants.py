"""Every cited number of the package, and where it was read: docs/measured/constants.md."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import earthspin
from earthspin.bodies import BODIES, NUMBERS
from earthspin.constants import UNVERIFIED, Constant, Tabulated

PAGE = Path(__file__).parents[1] / "docs" / "measured" / "constants.md"
HEAD = """# Constants and where they were read

`python -m data_tools constants` writes this page. *Read in* names the public copy, abstract or
code in which a value was read; the source is the publication of the value. {count} entries,
{missing} of them **not verified**: no public copy was found. These words are in the source of such
a number, and so in each answer that names the source. Where a copy confirms a number less closely
than the source states it, the uncertainty contains the difference. "±" is one standard deviation.

| number | value | unit | source | read in |
|---|---:|---|---|---|
"""


def cited() -> dict[str, Constant | Tabulated]:
    """Return every constant of the package by module and name; each object once."""
    numbers: dict[str, Constant | Tabulated] = {}
    seen: set[Constant | Tabulated] = set()
    groups = [("constants", vars(importlib.import_module("earthspin.constants")))]
    groups += [(name, NUMBERS[name]) for name in sorted(NUMBERS)]
    groups += [
        (name, {"observed_wobble": body.observed_wobble}) for name, body in sorted(BODIES.items())
    ]
    for module in _modules():
        groups.append((module.removeprefix("earthspin."), vars(importlib.import_module(module))))
    for place, table in groups:
        for name, value in _flat(table.items()):
            if value not in seen:
                seen.add(value)
                numbers[f"{place}: {name}"] = value
    return numbers


def _modules() -> Iterator[str]:
    """Names of the modules that may hold constants."""
    for package in ("bodies", "interior", "nutation", "secular", "motion", "sky"):
        path = Path(earthspin.__file__).parent / package
        for module in pkgutil.walk_packages([str(path)], f"earthspin.{package}."):
            yield module.name


def _flat(items: Iterable[tuple[str, Any]]) -> Iterator[tuple[str, Constant | Tabulated]]:
    """Constants among named objects, in tables and sequences too."""
    for name, value in items:
        if isinstance(value, Constant | Tabulated):
            yield name, value
        elif isinstance(value, Mapping) and not name.startswith("__"):
            yield from _flat((f"{name}, {key}", one) for key, one in value.items())
        elif isinstance(value, tuple):
            yield from _flat((f"{name}, {k}", one) for k, one in enumerate(value))


def row(name: str, number: Constant | Tabulated) -> str:
    """Return a line of the table."""
    if isinstance(number, Tabulated):
        columns = (f"{name} ({number.content})", "", "", number.source, number.read_in)
    else:
        error = f" ± {number.uncertainty:.2g}" if number.uncertainty else ""
        columns = (name, f"{number.value:.12g}{error}", number.unit, number.source, number.read_in)
    marked = (text.replace("|", "\\|").replace(UNVERIFIED, f"**{UNVERIFIED}**") for text in columns)
    return f"| {' | '.join(marked)} |\n"


def page() -> str:
    """Return the page."""
    numbers = cited()
    missing = sum(UNVERIFIED in number.read_in for number in numbers.values())
    head = HEAD.format(count=len(numbers), missing=missing)
    return head + "".join(row(name, number) for name, number in numbers.items())


def main() -> int:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
    return 0
