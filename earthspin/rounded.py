"""Format numbers and durations as short text with two digits, and units with a space."""

from __future__ import annotations

import math


def shown_unit(unit: str) -> str:
    """Return a unit with a space before it; for a pure number, return an empty text."""
    return "" if unit == "1" else f" {unit.replace('uas', 'µas')}"


def plain(value: float) -> str:
    """Format a number as short text with two digits: 0.05, 920, 1e-6, 2.3e5."""
    value = float(f"{value:.1e}")
    if 1e-3 <= abs(value) <= 1e4 or value == 0:
        return f"{value:g}"
    digits, power = f"{value:.1e}".split("e")
    return f"{digits.removesuffix('.0')}e{int(power)}"


def duration(seconds: float) -> str:
    """Format a duration as text with two digits and a unit, from microseconds to years."""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= 0.9995 * size:
            return f"{_two_digits(seconds / size)} {unit}"
    return f"{_two_digits(seconds * 1e6)} µs"


def _two_digits(value: float) -> str:
    if not value > 0:
        return "0"
    digits = max(0, 1 - math.floor(math.log10(float(f"{value:.1e}"))))
    return f"{value:.{digits}f}"
