"""Numbers that may be arrays with named dimensions: what they are compared by."""

from __future__ import annotations

import math
from typing import Any

#: A float, or an array with named dimensions (anything numpy can read element by element).
Numeric = Any

#: How far two numbers of one body may be apart, relative.
SAME_BODY = 0.01


def all_of(condition: Any) -> bool:
    """Truth of a bool, or of every element of an array."""
    return bool(condition.all()) if hasattr(condition, "all") else bool(condition)


def is_finite(value: Numeric) -> Numeric:
    """Elementwise: a real number that is neither infinite nor NaN."""
    return (value == value) & (abs(value) != math.inf)


def are_close(value: Numeric | None, other: Numeric | None) -> Numeric:
    """Elementwise: whether two numbers may belong to the same body."""
    if value is None or other is None:
        return value is other
    return abs(value - other) <= SAME_BODY * abs(other)


def is_close(value: Numeric | None, other: Numeric | None) -> bool:
    """Whether two numbers may belong to the same body, all of them."""
    return all_of(are_close(value, other))


def is_same(value: object, other: object) -> bool:
    """Whether two values are equal, arrays with their labels."""
    if hasattr(value, "identical"):
        return type(value) is type(other) and bool(value.identical(other))
    return not hasattr(other, "identical") and value == other
