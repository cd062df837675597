"""Input checks for `earthspin.mass`; each raises an error with a one-line message."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError, UndefinedError
from earthspin.numerics.arrays import BoolArray, FloatArray


def positive(body: str, field: str, value: ArrayLike) -> FloatArray:
    """Return numbers as an array; raise an error unless all are finite and positive."""
    values = np.asarray(value, dtype=float)
    wrong = ~(np.isfinite(values) & (values > 0))
    if np.any(wrong):
        raise BodyError(body, field, first(values, wrong), "it must be finite and above zero")
    return values


def vectors(name: str, value: ArrayLike) -> FloatArray:
    """Return vectors as an array whose last axis is x, y, z; refuse infinite and missing values."""
    values = np.asarray(value, dtype=float)
    if values.ndim == 0 or values.shape[-1] != 3:
        raise UndefinedError(
            f"{name} has the shape {values.shape}; its last axis must hold x, y and z"
        )
    wrong = ~np.isfinite(values)
    if np.any(wrong):
        raise UndefinedError(f"{name} holds {first(values, wrong)}; give finite numbers of metres")
    return values


def degree(name: str, value: Any) -> int:
    """Return the degree or order of a harmonic as an integer; refuse negative and other values."""
    if not isinstance(value, int | np.integer) or value < 0:
        raise UndefinedError(f"{name} = {value!r} is not possible; give an integer of 0 or more")
    return int(value)


def first(values: FloatArray, wrong: BoolArray) -> float:
    """Return the first element of `values` for which `wrong` is true."""
    return float(values[wrong].flat[0])
