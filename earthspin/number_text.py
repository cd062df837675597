"""Format numbers and durations as short text with two digits, and units with a space."""

from __future__ import annotations


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
