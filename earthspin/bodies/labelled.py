"""Element-wise tests and comparison of numbers and of arrays with named dimensions."""

from __future__ import annotations

import math
from typing import Any

#: A float, or an array with named dimensions (anything numpy can read element by element).
Numeric = Any

#: Largest relative difference between two values that count as the same body's.
SAME_BODY = 0.01


def all_of(condition: Any) -> bool:
    """Return True if a bool is true, or if all elements of a boolean array are true."""
    return bool(condition.all()) if hasattr(condition, "all") else bool(condition)


def is_finite(value: Numeric) -> Numeric:
    """Test element-wise whether a real number is neither infinite nor NaN."""
    return (value == value) & (abs(value) != math.inf)


def are_close(value: Numeric | None, other: Numeric | None) -> Numeric:
    """Test element-wise whether two values agree to within the relative tolerance `SAME_BODY`."""
    if value is None or other is None:
        return value is other
    return abs(value - other) <= SAME_BODY * abs(other)


def is_close(value: Numeric | None, other: Numeric | None) -> bool:
    """Test whether all elements of two values agree to within the tolerance `SAME_BODY`."""
    return all_of(are_close(value, other))


def is_same(value: object, other: object) -> bool:
    """Test whether two values are identical, including the coordinate labels of arrays."""
    if hasattr(value, "identical"):
        return type(value) is type(other) and bool(value.identical(other))
    return not hasattr(other, "identical") and value == other
